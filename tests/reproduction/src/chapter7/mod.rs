//! Robust policies from an uncertain reward (chapter 7): the machines of figure 7.2 and the red corridor of figure 7.4.

mod compared;
mod corridor;
mod pictures;

pub use compared::{Compared, Judged, POLICIES, Posterior, compare};
pub use corridor::Corridor;
pub use pictures::{demonstration_grid, grid, legend};

/// Points of every frontier.
pub const POINTS: usize = 21;

/// λ of every frontier: 0, .05, …, 1.
pub fn lambdas() -> Vec<f64> {
    (0..POINTS).map(|i| i as f64 / (POINTS - 1) as f64).collect()
}

/// What the random numbers of a replicate are for.
pub mod purpose {
    /// Draws that policies are chosen by.
    pub const DRAWS: u32 = 0;
    /// Draws that they are judged by.
    pub const FRESH: u32 = 1;
    /// The dissertation's walk.
    pub const WALK: u32 = 2;
}

/// Mean of the worst share 1 − α of equally probable values.
pub fn lower_mean(values: &[f64], alpha: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let worst = ((1.0 - alpha) * sorted.len() as f64).round().max(1.0) as usize;
    crate::harness::sum_in_order(&sorted[..worst]) / worst as f64
}

/// Points of a chart of sorted values: at most about 200 of them, (share of draws, value).
pub fn quantiles(values: &[f64]) -> Vec<(f64, f64)> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let every = sorted.len().div_ceil(200);
    let at = |i: usize| ((i as f64 + 0.5) / sorted.len() as f64, sorted[i]);
    (0..sorted.len()).step_by(every).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::{lower_mean, quantiles};

    #[test]
    fn the_tail_is_the_worst_share() {
        // Method notes, section 7: of 2000 draws at .99 the worst 20, of 300 at .95 the worst 15.
        for (n, alpha, worst) in [(2000_u32, 0.99, 20_u32), (300, 0.95, 15)] {
            let values: Vec<f64> = (1..=n).rev().map(f64::from).collect();
            let mean = (1..=worst).map(f64::from).sum::<f64>() / f64::from(worst);
            assert!((lower_mean(&values, alpha) - mean).abs() < 1e-12);
        }
    }

    #[test]
    fn charts_have_few_points_in_order() {
        let values: Vec<f64> = (0..5000).map(|i| f64::from((i * 7919) % 5000)).collect();
        let points = quantiles(&values);
        assert!(points.len() <= 200 && points.is_sorted_by(|a, b| a.0 < b.0 && a.1 < b.1));
    }
}
