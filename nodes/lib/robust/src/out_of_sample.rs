//! What a policy is worth under draws that it was not optimised for: the tail it was chosen by flatters it.

use diagnostics::Series;
use mdp::random::index;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use crate::error::{RobustError, check_length, check_numbers};
use crate::level::Level;
use crate::tail::lower_tail;

/// Blocks are this many times as long as draws take to forget each other.
const MEMORY: f64 = 4.0;
/// Fewest and most bootstrap replicates.
const REPLICATES: std::ops::RangeInclusive<usize> = 100..=100_000;

/// How ψ fares on fresh draws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutOfSample {
    /// Draws.
    pub n: usize,
    /// What they are worth in independent ones, as far as the tail is concerned.
    pub effective_size: f64,
    /// E(ψ).
    pub mean: f64,
    /// VaR_α(ψ).
    pub value_at_risk: f64,
    /// CVaR_α(ψ).
    pub conditional_value_at_risk: f64,
    /// Its standard error.
    pub standard_error: f64,
    /// Lower and upper end of its confidence interval.
    pub interval: [f64; 2],
}

/// How confident an interval is to be, and how it is computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bootstrap {
    /// Coverage in (0, 1): 0.95, say.
    pub confidence: f64,
    /// Times that draws are drawn again, from 100 to 100,000.
    pub replicates: usize,
    /// Seed of the generator.
    pub seed: u64,
}

impl Default for Bootstrap {
    fn default() -> Self {
        Self { confidence: 0.95, replicates: 1000, seed: 0 }
    }
}

/// CVaR_α of `values`, ψ of every draw in the order of the chains (see [`crate::performance`]), with a confidence interval
/// by the studentised bootstrap (Efron 1979; Hall 1988) over blocks that are as long as the chains' memory (Künsch 1989).
/// `n_chains` is 0 for draws that are independent. `weights` are the draws' probabilities if they are not all 1/N.
///
/// # Errors
/// No values or numbers that are not finite; weights that are no distribution; chains of unequal length, or too short to
/// judge their memory; α outside [0, 1), a confidence outside (0, 1), or a number of replicates out of range.
pub fn out_of_sample(
    values: &[f64],
    n_chains: usize,
    weights: Option<&[f64]>,
    alpha: f64,
    bootstrap: &Bootstrap,
) -> Result<OutOfSample, RobustError> {
    let n = values.len();
    if n == 0 {
        return Err(RobustError::Empty { what: "values" });
    }
    check_numbers("values", values)?;
    let level = Level::new(alpha, 0.0)?;
    let Bootstrap { confidence, replicates, seed } = *bootstrap;
    if !(confidence > 0.0 && confidence < 1.0) {
        return Err(RobustError::Range { name: "confidence", got: confidence, expected: "strictly between 0 and 1" });
    }
    if !REPLICATES.contains(&replicates) {
        let (name, got) = ("replicates", replicates as f64);
        return Err(RobustError::Range { name, got, expected: "from 100 to 100000" });
    }
    if let Some(weights) = weights {
        check_length("posterior weights", weights.len(), n, "one per draw")?;
    }
    let masses = match weights {
        Some(weights) => crate::scenarios::distribution(weights, n)?,
        None => vec![1.0 / n as f64; n],
    };
    let tail = lower_tail(values, &masses, level.alpha);
    let (effective_size, block) = match n_chains {
        0 => (n as f64, 1),
        _ => {
            let series = Series::new(values, n_chains)?;
            let size = series.ess_indicator(tail.value_at_risk).clamp(1.0, n as f64);
            let memory = n as f64 / size;
            let block = if memory < 1.5 { 1.0 } else { libm::ceil(MEMORY * memory) };
            (size, (block as usize).clamp(1, n / n_chains))
        }
    };
    let sample = Sample::new(values, &masses, level.alpha, n_chains.max(1), block);
    let mut whole = sample.estimate(&vec![1; n]);
    // Every draw is in as many overlapping blocks as blocks are long.
    whole.error *= libm::sqrt(block as f64);
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut deviations = Vec::with_capacity(replicates);
    let mut times = vec![0_u32; n];
    let n_blocks = n.div_ceil(block);
    for _ in 0..replicates {
        times.fill(0);
        (0..n_blocks).for_each(|_| times[index(n, &mut rng)] += 1);
        let again = sample.estimate(&times);
        if again.error > 0.0 {
            deviations.push((again.cvar - whole.cvar) / again.error);
        }
    }
    deviations.sort_unstable_by(f64::total_cmp);
    let quantile = |p: f64| match deviations.len() {
        0 => 0.0,
        m => deviations[((p * m as f64) as usize).min(m - 1)],
    };
    let beyond = 0.5 * (1.0 - confidence);
    let mean = values.iter().zip(&masses).map(|(x, mass)| mass * x).sum();
    let cvar = tail.conditional_value_at_risk;
    Ok(OutOfSample {
        n,
        effective_size,
        mean,
        value_at_risk: tail.value_at_risk,
        conditional_value_at_risk: cvar,
        standard_error: whole.error,
        interval: [cvar - quantile(1.0 - beyond) * whole.error, cvar - quantile(beyond) * whole.error],
    })
}

/// Draws, ready to be drawn again.
struct Sample<'a> {
    values: &'a [f64],
    masses: &'a [f64],
    alpha: f64,
    /// Draws by value, ascending.
    order: Vec<u32>,
    /// Length of blocks, of which one starts at every draw; they wrap around within their chain.
    block: usize,
    per_chain: usize,
}

struct Estimate {
    cvar: f64,
    error: f64,
}

impl<'a> Sample<'a> {
    fn new(values: &'a [f64], masses: &'a [f64], alpha: f64, n_chains: usize, block: usize) -> Self {
        let mut order: Vec<u32> = (0..values.len() as u32).collect();
        order.sort_unstable_by(|&i, &j| values[i as usize].total_cmp(&values[j as usize]).then(i.cmp(&j)));
        Self { values, masses, alpha, order, block, per_chain: values.len() / n_chains }
    }

    /// The draw `step` draws after `start` in its chain.
    fn after(&self, start: usize, step: usize) -> usize {
        let chain = start - start % self.per_chain;
        chain + (start - chain + step) % self.per_chain
    }

    /// CVaR and its standard error when the block from each start is taken so many `times`.
    fn estimate(&self, times: &[u32]) -> Estimate {
        let n = self.values.len();
        // How often each draw is there.
        let mut counts = vec![0_u32; n];
        for (start, &times) in times.iter().enumerate().filter(|(_, times)| **times > 0) {
            (0..self.block).for_each(|step| counts[self.after(start, step)] += times);
        }
        let total: f64 = counts.iter().zip(self.masses).map(|(&count, mass)| f64::from(count) * mass).sum();
        let wanted = (1.0 - self.alpha) * total;
        // As differences from the smallest, so that equal values give exactly that value.
        let smallest = self.values[self.order[0] as usize];
        let (mut taken, mut sum, mut edge) = (0.0, 0.0, self.values[self.order[n - 1] as usize]);
        for &i in &self.order {
            let i = i as usize;
            let mass = (f64::from(counts[i]) * self.masses[i]).min(wanted - taken);
            if mass > 0.0 {
                taken += mass;
                sum += mass * (self.values[i] - smallest);
                edge = self.values[i];
            }
            if taken >= wanted * (1.0 - 1e-12) {
                break;
            }
        }
        let cvar = smallest + sum / taken;
        // Influence of each draw: edge − (edge − x)₊ / (1 − α) − CVaR, summed over blocks, which hardly know of each other.
        let influence =
            |i: usize| self.masses[i] * (edge - (edge - self.values[i]).max(0.0) / (1.0 - self.alpha) - cvar);
        let mut squares = 0.0;
        for (start, &times) in times.iter().enumerate().filter(|(_, times)| **times > 0) {
            let sum: f64 = (0..self.block).map(|step| influence(self.after(start, step))).sum();
            squares += f64::from(times) * sum * sum;
        }
        Estimate { cvar, error: libm::sqrt(squares) / total }
    }
}
