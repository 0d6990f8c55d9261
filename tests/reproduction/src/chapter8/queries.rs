//! How many questions it takes to get somewhere, and how many fewer than another method takes.

use mdp::random::index;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// Resamples of a bootstrap.
const RESAMPLES: usize = 2000;

/// Questions until the curve is at most `level` for the first time, straight lines between questions; `None` when it never is.
/// `curve` starts before the first question.
pub fn queries_to(curve: &[f64], level: f64) -> Option<f64> {
    let first = curve.iter().position(|y| *y <= level)?;
    if first == 0 {
        return Some(0.0);
    }
    let (before, after) = (curve[first - 1], curve[first]);
    Some(first as f64 - (level - after) / (before - after))
}

/// Mean of curves, question by question; shorter ones stay where they end.
fn mean(curves: &[&[f64]]) -> Vec<f64> {
    let longest = curves.iter().map(|curve| curve.len()).max().unwrap_or(0);
    let at = |i: usize| {
        let sum: f64 = curves.iter().map(|curve| curve[i.min(curve.len() - 1)]).fold(0.0, |sum, y| sum + y);
        sum / curves.len() as f64
    };
    (0..longest).map(at).collect()
}

/// Questions that `ours` needs on average to the mean loss that `other` has after `n` questions, as a share of n, and its 95 %
/// bootstrap interval over the pairs of lessons. A curve that never gets there counts as one question more than it has.
pub fn fewer_queries(ours: &[Vec<f64>], other: &[Vec<f64>], n: usize, seed: u64) -> (f64, [f64; 2]) {
    let share = |pick: &dyn Fn(usize) -> usize| {
        let of = |curves: &'_ [Vec<f64>]| -> Vec<f64> {
            mean(&(0..ours.len()).map(|i| curves[pick(i)].as_slice()).collect::<Vec<_>>())
        };
        let (own, theirs) = (of(ours), of(other));
        let level = theirs[n.min(theirs.len() - 1)];
        queries_to(&own, level).unwrap_or(own.len() as f64) / n as f64
    };
    let found = share(&|i| i);
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut shares: Vec<f64> = (0..RESAMPLES)
        .map(|_| {
            let picked: Vec<usize> = (0..ours.len()).map(|_| index(ours.len(), &mut rng)).collect();
            share(&|i| picked[i])
        })
        .collect();
    shares.sort_unstable_by(f64::total_cmp);
    let at = |share: f64| shares[(share * (RESAMPLES - 1) as f64).round() as usize];
    (found, [at(0.025), at(0.975)])
}

#[cfg(test)]
mod tests {
    use super::{fewer_queries, queries_to};

    #[test]
    fn crossings_are_interpolated() {
        assert_eq!(queries_to(&[4.0, 2.0, 1.0], 3.0), Some(0.5));
        assert_eq!(queries_to(&[4.0, 2.0, 1.0], 2.0), Some(1.0));
        assert_eq!(queries_to(&[4.0, 2.0], 5.0), Some(0.0));
        assert_eq!(queries_to(&[4.0, 2.0], 1.0), None);
    }

    #[test]
    fn twice_as_fast_takes_half() {
        let curve = |rate: f64| (0..20).map(|i| (-rate * f64::from(i)).exp()).collect::<Vec<f64>>();
        let (ours, other) = (vec![curve(0.4); 5], vec![curve(0.2); 5]);
        let (share, [low, high]) = fewer_queries(&ours, &other, 10, 1);
        assert!((share - 0.5).abs() < 1e-12 && (low - 0.5).abs() < 1e-12 && (high - 0.5).abs() < 1e-12);
        assert_eq!(fewer_queries(&other, &ours, 10, 1).0, 2.0);
    }
}
