//! Effective sample size and potential scale reduction of equally long chains, one after another in a slice.

/// n / τ̂ with Geyer's initial monotone positive sequence (Vehtari et al. eq. 10–13), of `n_chains` chains of `per_chain`
/// draws whose means have the sample variance `between`.
///
/// `autocovariance(lag)` is the mean over the chains of Σ (x_t − x̄)(x_{t+lag} − x̄) / `per_chain`; lags are asked for in
/// ascending order, and only as far as they matter.
pub(super) fn geyer_size(
    n_chains: usize,
    per_chain: usize,
    between: f64,
    autocovariance: impl Fn(usize) -> f64,
) -> f64 {
    let length = per_chain as f64;
    let n = n_chains as f64 * length;
    let within = autocovariance(0) * length / (length - 1.0);
    let total = within * (length - 1.0) / length + between;
    let rho = |lag: usize| 1.0 - (within - autocovariance(lag)) / total;

    let mut pairs = vec![(1.0, rho(1))];
    let (mut even, mut odd) = pairs[0];
    let mut t = 1;
    while t + 3 < per_chain && even + odd > 0.0 {
        (even, odd) = (rho(t + 1), rho(t + 2));
        pairs.push(if even + odd >= 0.0 { (even, odd) } else { (0.0, 0.0) });
        t += 2;
    }
    // The pair that ended the search is left out, but for its even half where that is positive.
    let (stored_even, _) = pairs.pop().expect("lag 0 is always there");
    let mut tau = if even > 0.0 { even } else { stored_even } - 1.0;
    let mut previous = f64::INFINITY;
    for (even, odd) in pairs {
        previous = f64::min(even + odd, previous);
        tau += 2.0 * previous;
    }
    n / tau.max(1.0 / libm::log10(n))
}

/// Effective sample size of the mean of `draws`, chains of `per_chain`.
///
/// A constant series has no autocorrelation to speak of and counts in full.
pub(super) fn effective_size(draws: &[f64], per_chain: usize) -> f64 {
    let (low, high) = draws.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &x| (l.min(x), h.max(x)));
    if high == low {
        return draws.len() as f64;
    }
    let means: Vec<f64> = draws.chunks_exact(per_chain).map(mean).collect();
    let centred: Vec<f64> = draws
        .chunks_exact(per_chain)
        .zip(&means)
        .flat_map(|(chain, mean)| chain.iter().map(move |x| x - mean))
        .collect();
    let n_values = draws.len() as f64;
    geyer_size(means.len(), per_chain, sample_variance(&means), |lag| {
        centred.chunks_exact(per_chain).map(|chain| dot(&chain[lag..], &chain[..per_chain - lag])).sum::<f64>()
            / n_values
    })
}

/// √(V̂ / W) (Vehtari et al. eq. 1–4): 1 for constant draws, ∞ for chains that are each constant but differ.
pub(super) fn scale_reduction(draws: &[f64], per_chain: usize) -> f64 {
    let means: Vec<f64> = draws.chunks_exact(per_chain).map(mean).collect();
    let variances = draws.chunks_exact(per_chain).zip(&means).map(|(chain, mean)| variance_about(chain, *mean));
    let within = variances.sum::<f64>() / means.len() as f64;
    let between = sample_variance(&means);
    let length = per_chain as f64;
    if between == 0.0 && within == 0.0 {
        return 1.0;
    }
    libm::sqrt((length - 1.0) / length + between / within)
}

pub(super) fn mean(values: &[f64]) -> f64 {
    lane_sum(values, |x| x) / values.len() as f64
}

/// Variance with n − 1 in the denominator; 0 for a single value and exactly 0 for equal ones.
pub(super) fn sample_variance(values: &[f64]) -> f64 {
    variance_about(values, mean(values))
}

fn variance_about(values: &[f64], mean: f64) -> f64 {
    if values.len() < 2 || values.iter().all(|&x| x == values[0]) {
        return 0.0;
    }
    lane_sum(values, |x| (x - mean) * (x - mean)) / (values.len() - 1) as f64
}

/// Lanes of every sum: it vectorises, and its bits do not depend on the width of the vectors.
const LANES: usize = 8;

/// Σ f(x).
fn lane_sum(values: &[f64], f: impl Fn(f64) -> f64) -> f64 {
    let mut lanes = [0.0; LANES];
    let chunks = values.chunks_exact(LANES);
    let rest: f64 = chunks.remainder().iter().map(|&x| f(x)).sum();
    for chunk in chunks {
        for (lane, &x) in lanes.iter_mut().zip(chunk) {
            *lane += f(x);
        }
    }
    lanes.iter().sum::<f64>() + rest
}

/// Inner product.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let (a_lanes, b_lanes) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let rest: f64 = a_lanes.remainder().iter().zip(b_lanes.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in a_lanes.zip(b_lanes) {
        for ((lane, a), b) in lanes.iter_mut().zip(a).zip(b) {
            *lane += a * b;
        }
    }
    lanes.iter().sum::<f64>() + rest
}
