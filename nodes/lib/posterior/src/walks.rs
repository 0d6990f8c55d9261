//! The dissertation's own samplers, kept as a reference: the walk on the L1 sphere of chapter 4 (Algorithms 8 and 9) and the
//! Gaussian walk on the L2 sphere of chapter 6 (appendix E.1).

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;

use crate::random::{standard_normal, uniform};

/// Which way round the circle ‖(w1, w2)‖₁ = const.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// (+,+) → (+,−) → (−,−) → (−,+).
    Clockwise,
    /// The other way.
    Counterclockwise,
}

/// In which order a proposal of the L1 walk visits the pairs of weights.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PairOrder {
    /// Shuffled anew for every proposal: as probable forwards as backwards.
    Shuffled,
    /// (0, 1), (0, 2), … as printed. Not reversible: only to repeat what was published.
    Printed,
}

/// What a walk visited.
#[derive(Debug, Clone, PartialEq)]
pub struct Walk {
    /// Weights after every step, row-major; the start is not among them.
    pub values: Vec<f64>,
    /// Their log-likelihoods.
    pub log_likelihood: Vec<f64>,
    /// Share of accepted proposals.
    pub acceptance: f64,
}

/// Moves (w1, w2) by `step` along ‖(w1, w2)‖₁ = const (Algorithm 9; its slack is |w1| + |w2|). `step` ≥ 0.
pub fn l1_manifold_step(w1: f64, w2: f64, direction: Direction, step: f64) -> (f64, f64) {
    let size = w1.abs() + w2.abs();
    if size == 0.0 {
        return (w1, w2);
    }
    // Quarters counted clockwise from (+,+); |w1| grows in the even ones, which begin where it is 0.
    let mut quarter = match (w1 >= 0.0, w2 >= 0.0) {
        (true, true) => 0,
        (true, false) => 1,
        (false, false) => 2,
        (false, true) => 3,
    };
    let clockwise = direction == Direction::Clockwise;
    let mut length = w1.abs();
    // Whole turns lead back.
    let mut left = libm::fmod(step, 4.0 * size);
    loop {
        let grows = (quarter % 2 == 0) == clockwise;
        let room = if grows { size - length } else { length };
        let moved = left.min(room);
        length += if grows { moved } else { -moved };
        left -= moved;
        if left <= 0.0 {
            break;
        }
        quarter = (quarter + if clockwise { 1 } else { 3 }) % 4;
    }
    let length = length.clamp(0.0, size);
    let (sign1, sign2) = [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)][quarter];
    (sign1 * length, sign2 * (size - length))
}

/// A proposal of the L1 walk: one manifold step along every pair of weights (Algorithm 8), in place.
pub fn l1_proposal(w: &mut [f64], step: f64, order: PairOrder, generator: &mut ChaCha8Rng) {
    let mut pairs: Vec<(usize, usize)> = (0..w.len()).flat_map(|i| (i + 1..w.len()).map(move |j| (i, j))).collect();
    if order == PairOrder::Shuffled {
        for i in (1..pairs.len()).rev() {
            let j = (uniform(generator) * (i + 1) as f64) as usize;
            pairs.swap(i, j);
        }
    }
    for (i, j) in pairs {
        let clockwise = generator.next_u32() & 1 == 0;
        let direction = if clockwise { Direction::Clockwise } else { Direction::Counterclockwise };
        (w[i], w[j]) = l1_manifold_step(w[i], w[j], direction, step);
    }
}

/// A proposal of the L2 walk: independent normal noise of standard deviation `sigma`, then division by ‖·‖₂; in place.
/// Symmetric on the sphere, so it needs no Hastings term.
pub fn l2_proposal(w: &mut [f64], sigma: f64, generator: &mut ChaCha8Rng) {
    w.iter_mut().for_each(|w| *w += sigma * standard_normal(generator));
    let norm = libm::sqrt(w.iter().map(|w| w * w).sum::<f64>()).max(f64::MIN_POSITIVE);
    w.iter_mut().for_each(|w| *w /= norm);
}

/// Random-walk Metropolis from `start` with a symmetric proposal. A `log_density` of −∞ is never moved to; a start that
/// has it is left at the first proposal with another.
pub fn metropolis(
    mut log_density: impl FnMut(&[f64]) -> f64,
    start: Vec<f64>,
    n_steps: usize,
    mut propose: impl FnMut(&mut [f64], &mut ChaCha8Rng),
    generator: &mut ChaCha8Rng,
) -> Walk {
    let mut w = start;
    let mut height = log_density(&w);
    let mut proposal = w.clone();
    let mut walk = Walk {
        values: Vec::with_capacity(n_steps * w.len()),
        log_likelihood: Vec::with_capacity(n_steps),
        acceptance: 0.0,
    };
    let mut accepted = 0_usize;
    for _ in 0..n_steps {
        proposal.copy_from_slice(&w);
        propose(&mut proposal, generator);
        let there = log_density(&proposal);
        let threshold = libm::log(uniform(generator));
        // From a place of density zero any other is better.
        let gain = if height == f64::NEG_INFINITY && there > height { f64::INFINITY } else { there - height };
        if gain >= threshold {
            std::mem::swap(&mut w, &mut proposal);
            height = there;
            accepted += 1;
        }
        walk.values.extend_from_slice(&w);
        walk.log_likelihood.push(height);
    }
    walk.acceptance = accepted as f64 / n_steps.max(1) as f64;
    walk
}

#[cfg(test)]
mod tests {
    use super::{Direction, PairOrder, l1_manifold_step, l1_proposal, l2_proposal, metropolis};
    use proptest::prelude::{prop_assert, proptest};
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;

    #[test]
    fn manifold_steps_are_those_of_the_method_notes() {
        let cases = [
            (0.3, 0.2, Direction::Clockwise, 0.01, 0.31, 0.19),
            (0.005, 0.2, Direction::Counterclockwise, 0.01, -0.005, 0.2),
            (-0.3, 0.2, Direction::Clockwise, 0.05, -0.25, 0.25),
            (0.5, 0.0, Direction::Counterclockwise, 0.01, 0.49, 0.01),
        ];
        for (w1, w2, direction, step, want1, want2) in cases {
            let got = l1_manifold_step(w1, w2, direction, step);
            assert!((got.0 - want1).abs() < 1e-15 && (got.1 - want2).abs() < 1e-15, "{got:?}, ({want1}, {want2})");
        }
        assert_eq!(l1_manifold_step(0.0, 0.0, Direction::Clockwise, 0.1), (0.0, 0.0));
    }

    proptest! {
        #[test]
        fn a_step_keeps_the_norm_and_can_be_taken_back(w1 in -1.0..1.0_f64, w2 in -1.0..1.0_f64, step in 0.0..3.0_f64) {
            let (a, b) = l1_manifold_step(w1, w2, Direction::Clockwise, step);
            prop_assert!((a.abs() + b.abs() - w1.abs() - w2.abs()).abs() < 1e-12);
            let (c, d) = l1_manifold_step(a, b, Direction::Counterclockwise, step);
            prop_assert!((c - w1).abs() < 1e-9 && (d - w2).abs() < 1e-9);
        }
    }

    /// Under a flat likelihood a walk must give back the prior: uniform on the L1 sphere of 8 weights E|w| = 1/8 and
    /// E w² = 1/36, on the L2 sphere E w² = 1/8 and E w⁴ = 3/80.
    #[test]
    fn flat_likelihoods_give_the_prior_back() {
        let mut generator = ChaCha8Rng::seed_from_u64(3);
        let start = vec![-1.0 / 8.0; 8];
        let walk = metropolis(
            |_| 0.0,
            start.clone(),
            400_000,
            |w, generator| l1_proposal(w, 0.05, PairOrder::Shuffled, generator),
            &mut generator,
        );
        let n = walk.values.len() as f64;
        let mean = |power: i32| walk.values.iter().map(|w| w.abs().powi(power)).sum::<f64>() / n;
        assert!((mean(1) - 0.125).abs() < 1e-9, "all steps stay on the sphere: {}", mean(1));
        assert!((mean(2) - 1.0 / 36.0).abs() < 4e-4, "{}", mean(2));

        let norm = (8.0_f64).sqrt() / 8.0;
        let start = start.iter().map(|w| w / norm).collect();
        let walk = metropolis(|_| 0.0, start, 400_000, |w, generator| l2_proposal(w, 0.2, generator), &mut generator);
        let mean = |power: i32| walk.values.iter().map(|w| w.powi(power)).sum::<f64>() / n;
        assert!((mean(2) - 0.125).abs() < 1e-9);
        assert!((mean(4) - 3.0 / 80.0).abs() < 8e-4, "{}", mean(4));
    }

    #[test]
    fn a_start_of_probability_zero_is_left() {
        let mut generator = ChaCha8Rng::seed_from_u64(1);
        let inside = |w: &[f64]| if w[0] >= 0.0 { 0.0 } else { f64::NEG_INFINITY };
        let walk = metropolis(
            inside,
            vec![-0.01, 0.99],
            2000,
            |w, generator| l1_proposal(w, 0.05, PairOrder::Printed, generator),
            &mut generator,
        );
        let outside = walk.log_likelihood.iter().take_while(|value| **value == f64::NEG_INFINITY).count();
        assert!(outside < 100, "{outside} steps outside");
        assert!(walk.log_likelihood[outside..].iter().all(|value| *value == 0.0));
    }
}
