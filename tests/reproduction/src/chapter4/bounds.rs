//! Levels, the bound as printed, and what counts as accurate.

/// Levels α of the bounds on the value at risk.
pub const ALPHAS: [f64; 3] = [0.99, 0.95, 0.90];
/// The bounds hold with confidence 1 − δ.
pub const DELTA: f64 = 0.05;
/// A bound below the loss by no more than this counts as accurate.
const TOLERANCE: f64 = 1e-4;

/// Algorithms 1 and 2 as they are printed: the order statistic of index ppf(1 − δ; n, α), which is one too low, of draws that
/// are taken for independent.
pub fn printed_bound(losses: &[f64], alpha: f64) -> f64 {
    let mut sorted = losses.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let index = risk::quantile(1.0 - DELTA, sorted.len() as u64, alpha) as usize;
    sorted[index.clamp(1, sorted.len()) - 1]
}

/// Whether a bound is one: not below the true loss by more than 1e-4.
pub fn accurate(bound: f64, loss: f64) -> bool {
    bound >= loss - TOLERANCE
}

#[cfg(test)]
mod tests {
    use super::printed_bound;

    #[test]
    fn the_printed_index_is_one_below_the_safe_one() {
        // Method notes section 2: n = 495, α = .95, δ = .05 wants the 479th.
        let losses: Vec<f64> = (1..=495).rev().map(f64::from).collect();
        assert_eq!(printed_bound(&losses, 0.95), 478.0);
    }
}
