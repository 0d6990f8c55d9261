//! Effective sample size and potential scale reduction of equally long chains, one after another in a slice.

/// n / τ̂ with Geyer's initial monotone positive sequence, over all chains of `per_chain` draws (Vehtari et al. eq. 10–13).
///
/// A constant series has no autocorrelation to speak of and counts in full.
pub(super) fn effective_size(draws: &[f64], per_chain: usize) -> f64 {
    let n = draws.len() as f64;
    let (low, high) = draws.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &x| (l.min(x), h.max(x)));
    if high == low {
        return n;
    }
    let means: Vec<f64> = draws.chunks_exact(per_chain).map(mean).collect();
    let centred: Vec<f64> = draws
        .chunks_exact(per_chain)
        .zip(&means)
        .flat_map(|(chain, mean)| chain.iter().map(move |x| x - mean))
        .collect();
    let (m, length) = (means.len() as f64, per_chain as f64);
    // Mean over the chains of the autocovariance at one lag, each divided by the chain's length.
    let autocovariance = |lag: usize| {
        centred.chunks_exact(per_chain).map(|chain| dot(&chain[lag..], &chain[..per_chain - lag])).sum::<f64>()
            / length
            / m
    };
    let within = autocovariance(0) * length / (length - 1.0);
    let total = within * (length - 1.0) / length + sample_variance(&means);
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

/// √(V̂ / W) (Vehtari et al. eq. 1–4): 1 for constant draws, ∞ for chains that are each constant but differ.
pub(super) fn scale_reduction(draws: &[f64], per_chain: usize) -> f64 {
    let means: Vec<f64> = draws.chunks_exact(per_chain).map(mean).collect();
    let within = draws.chunks_exact(per_chain).map(sample_variance).sum::<f64>() / means.len() as f64;
    let between = sample_variance(&means);
    let length = per_chain as f64;
    if between == 0.0 && within == 0.0 {
        return 1.0;
    }
    libm::sqrt((length - 1.0) / length + between / within)
}

pub(super) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Variance with n − 1 in the denominator; 0 for a single value and exactly 0 for equal ones.
pub(super) fn sample_variance(values: &[f64]) -> f64 {
    if values.len() < 2 || values.iter().all(|&x| x == values[0]) {
        return 0.0;
    }
    let mean = mean(values);
    values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (values.len() - 1) as f64
}

/// Inner product in eight fixed lanes, so that it vectorises and its bits do not depend on the vector width.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; 8];
    let (a_lanes, b_lanes) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f64 = a_lanes.remainder().iter().zip(b_lanes.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in a_lanes.zip(b_lanes) {
        for ((lane, a), b) in lanes.iter_mut().zip(a).zip(b) {
            *lane += a * b;
        }
    }
    lanes.iter().sum::<f64>() + rest
}
