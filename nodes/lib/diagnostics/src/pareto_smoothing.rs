//! Importance weights with their largest ones smoothed, and how far they may be trusted (Vehtari, Simpson, Gelman, Yao and
//! Gabry 2024, "Pareto smoothed importance sampling").

use super::generalised_pareto::GeneralisedPareto;

/// Fewer weights above the cut say nothing about the tail.
const MIN_TAIL: usize = 5;
/// Largest weights that differ by no more than this share are equal for every purpose.
const EQUAL: f64 = 1e-12;

/// Why weights cannot be smoothed.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum WeightsError {
    /// No weights.
    #[error("no log weights given, but at least one is needed")]
    Empty,
    /// A log weight is NaN or +∞.
    #[error("log weight {index} is {value}, but it must be a finite number or -inf")]
    NotAWeight {
        /// Its place in the slice.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// Every log weight is −∞.
    #[error("all {n} weights are 0, but at least one must be positive")]
    AllZero {
        /// Weights given.
        n: usize,
    },
    /// A relative efficiency that is not positive and finite.
    #[error("the relative efficiency is {got}, but must be positive and finite")]
    Efficiency {
        /// Its value.
        got: f64,
    },
}

/// Smoothed importance weights.
#[derive(Debug, Clone, PartialEq)]
pub struct Smoothed {
    /// Logarithms of weights that sum to 1, in the order given; −∞ is weight 0.
    pub log_weights: Vec<f64>,
    /// Shape k̂ of the generalised Pareto distribution fitted to the largest weights: above [`khat_threshold`] the
    /// weights are not to be trusted. −∞ when the largest weights are all equal (no tail), ∞ when there are too few
    /// above the cut to fit one.
    pub khat: f64,
    /// (ΣW)²/ΣW²: how many independent, equally weighted draws the weights leave, were the draws independent.
    pub effective_size: f64,
}

impl Smoothed {
    /// The weights themselves; they sum to 1.
    pub fn weights(&self) -> Vec<f64> {
        self.log_weights.iter().map(|&w| libm::exp(w)).collect()
    }

    /// Whether k̂ is at most [`khat_threshold`] for that many draws.
    pub fn is_reliable(&self) -> bool {
        self.khat <= khat_threshold(self.log_weights.len())
    }
}

/// Largest k̂ with which `n` weighted draws give estimates of finite and useful error: min(1 − 1/log₁₀ n, 0.7).
pub fn khat_threshold(n: usize) -> f64 {
    (1.0 - 1.0 / libm::log10(n as f64)).min(0.7)
}

/// [`pareto_smooth_correlated`] of independent draws.
///
/// # Errors
/// No weights, NaN or +∞ among them, or none positive.
pub fn pareto_smooth(log_weights: &[f64]) -> Result<Smoothed, WeightsError> {
    pareto_smooth_correlated(log_weights, 1.0)
}

/// Replaces the largest weights by the expected order statistics of a generalised Pareto distribution fitted to them, cuts
/// them off at the largest raw weight, and normalises all to sum to 1.
///
/// The tail is the largest min(n/5, 3√(n/r)) weights, where r = `relative_efficiency` is ESS / n of the draws.
///
/// # Errors
/// No weights, NaN or +∞ among them, none positive, or an efficiency that is not positive.
pub fn pareto_smooth_correlated(log_weights: &[f64], relative_efficiency: f64) -> Result<Smoothed, WeightsError> {
    if let Some(index) = log_weights.iter().position(|&w| w.is_nan() || w == f64::INFINITY) {
        return Err(WeightsError::NotAWeight { index, value: log_weights[index] });
    }
    if !(relative_efficiency > 0.0 && relative_efficiency < f64::INFINITY) {
        return Err(WeightsError::Efficiency { got: relative_efficiency });
    }
    let n = log_weights.len();
    let largest = log_weights.iter().copied().reduce(f64::max).ok_or(WeightsError::Empty)?;
    if largest == f64::NEG_INFINITY {
        return Err(WeightsError::AllZero { n });
    }
    let mut relative: Vec<f64> = log_weights.iter().map(|w| w - largest).collect();
    let khat = smooth_tail(&mut relative, relative_efficiency);

    let log_total = libm::log(relative.iter().map(|&w| libm::exp(w)).sum());
    relative.iter_mut().for_each(|w| *w -= log_total);
    let effective_size = 1.0 / relative.iter().map(|&w| libm::exp(2.0 * w)).sum::<f64>();
    Ok(Smoothed { log_weights: relative, khat, effective_size })
}

/// Smooths the tail of log weights of which the largest is 0, and says its shape.
fn smooth_tail(relative: &mut [f64], relative_efficiency: f64) -> f64 {
    let n = relative.len() as f64;
    let tail_length = libm::ceil((n / 5.0).min(3.0 * libm::sqrt(n / relative_efficiency))) as usize;
    let mut descending: Vec<u32> = (0..relative.len() as u32).collect();
    descending.sort_unstable_by(|&a, &b| relative[b as usize].total_cmp(&relative[a as usize]).then(a.cmp(&b)));
    let Some(&at_cut) = descending.get(tail_length) else {
        return f64::INFINITY;
    };
    // Weights that vanish beside the largest are no part of the tail.
    let cut = relative[at_cut as usize].max(libm::log(f64::MIN_POSITIVE));
    if cut > -EQUAL {
        return f64::NEG_INFINITY;
    }
    let mut tail: Vec<u32> =
        descending[..tail_length].iter().copied().filter(|&index| relative[index as usize] > cut).collect();
    tail.reverse();
    if tail.len() < MIN_TAIL {
        return f64::INFINITY;
    }
    let weight_at_cut = libm::exp(cut);
    let excesses: Vec<f64> = tail.iter().map(|&index| libm::exp(relative[index as usize]) - weight_at_cut).collect();
    let fit = if excesses[0] > 0.0 { GeneralisedPareto::fit(&excesses) } else { None };
    let Some(fit) = fit else {
        return f64::INFINITY;
    };
    for (rank, &index) in tail.iter().enumerate() {
        let smoothed = fit.quantile((rank as f64 + 0.5) / tail.len() as f64);
        relative[index as usize] = libm::log(smoothed + weight_at_cut).min(0.0);
    }
    fit.shape
}
