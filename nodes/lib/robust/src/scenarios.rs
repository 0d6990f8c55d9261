//! The uncertain reward as weighted draws, and what a policy is worth under each of them.

use std::thread;

use mdp::{Mdp, Solver};

use crate::error::{RobustError, check_length, check_numbers};
use crate::objective::Objective;
use crate::planner::optimal_value;

/// How far posterior weights may be from a sum of 1; they are divided by it.
pub const WEIGHT_TOLERANCE: f64 = 1e-6;
/// Most numbers that draws may be.
pub const MAX_NUMBERS: usize = 100_000_000;
/// Draws that products are computed of at a time.
const STRETCH: usize = 1024;
/// Draws that share a solver.
const BLOCK: usize = 256;

/// ψ_i(μ) = w_iᵀμ − b_i for N draws w_i of positive probability p_i.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scenarios {
    pub(crate) n_features: usize,
    /// w: N × k, row by row.
    pub(crate) draws: Vec<f64>,
    /// The same, k × N: all draws of a feature together, for products with all of them.
    by_feature: Vec<f64>,
    /// p: N numbers above 0 that sum to 1.
    pub(crate) masses: Vec<f64>,
    /// b: N numbers.
    pub(crate) offsets: Vec<f64>,
    /// Σ p_i w_i: k numbers.
    pub(crate) mean: Vec<f64>,
}

impl Scenarios {
    /// The draws (N × k, row by row) with `weights` as probabilities, equal ones if there are none; draws of weight 0 are
    /// left out and equal draws are one. `threads` serve [`Objective::Loss`], which plans under every draw.
    pub(crate) fn new(
        mdp: &Mdp,
        draws: &[f64],
        weights: Option<&[f64]>,
        objective: Objective<'_>,
        threads: usize,
    ) -> Result<Self, RobustError> {
        check_draws(mdp, draws, objective)?;
        let k = mdp.n_features();
        let n = draws.len() / k;
        let masses = match weights {
            Some(weights) => distribution(weights, n)?,
            None => vec![1.0 / n as f64; n],
        };
        let (draws, masses) = distinct(draws, &masses, k);
        let offsets = offsets(mdp, &draws, objective, threads);
        let mut mean = vec![0.0; k];
        for (mass, w) in masses.iter().zip(draws.chunks(k)) {
            mean.iter_mut().zip(w).for_each(|(mean, w)| *mean += mass * w);
        }
        let n = masses.len();
        let mut by_feature = vec![0.0; draws.len()];
        for (i, w) in draws.chunks(k).enumerate() {
            w.iter().enumerate().for_each(|(j, w)| by_feature[j * n + i] = *w);
        }
        Ok(Self { n_features: k, draws, by_feature, masses, offsets, mean })
    }

    /// Draws N.
    pub(crate) fn n(&self) -> usize {
        self.masses.len()
    }

    /// w_i: k numbers.
    pub(crate) fn draw(&self, index: usize) -> &[f64] {
        &self.draws[index * self.n_features..][..self.n_features]
    }

    /// ψ of a policy with feature counts μ: N numbers.
    pub(crate) fn values(&self, counts: &[f64]) -> Vec<f64> {
        let mut values = self.products(counts);
        values.iter_mut().zip(&self.offsets).for_each(|(value, b)| *value -= b);
        values
    }

    /// w_iᵀx of every draw: N numbers.
    pub(crate) fn products(&self, x: &[f64]) -> Vec<f64> {
        let n = self.n();
        let mut products = vec![0.0; n];
        // A stretch at a time, which stays where the processor has it at hand.
        for (stretch, sums) in products.chunks_mut(STRETCH).enumerate() {
            for (w, x) in self.by_feature.chunks(n).zip(x) {
                let w = &w[stretch * STRETCH..][..sums.len()];
                sums.iter_mut().zip(w).for_each(|(sum, w)| *sum += w * x);
            }
        }
        products
    }

    /// Expected return Σ p_i w_iᵀμ.
    pub(crate) fn expected_return(&self, counts: &[f64]) -> f64 {
        dot(&self.mean, counts)
    }

    /// How large returns and what they are measured against typically are: Σ p_i (|w_iᵀμ| + |b_i|).
    pub(crate) fn size(&self, counts: &[f64]) -> f64 {
        let sizes = self.draws.chunks(self.n_features).zip(&self.offsets).map(|(w, b)| dot(w, counts).abs() + b.abs());
        sizes.zip(&self.masses).map(|(size, mass)| mass * size).sum()
    }

    /// How large rewards of one step may typically be, for features of at most `largest` in size: Σ p_i Σ |w_ij| largest_j.
    pub(crate) fn step_size(&self, largest: &[f64]) -> f64 {
        let size = |w: &[f64]| w.iter().zip(largest).map(|(w, phi)| w.abs() * phi).sum::<f64>();
        self.draws.chunks(self.n_features).zip(&self.masses).map(|(w, mass)| mass * size(w)).sum()
    }
}

/// Refuses draws, or an expert, that do not belong to `mdp`.
pub(crate) fn check_draws(mdp: &Mdp, draws: &[f64], objective: Objective<'_>) -> Result<(), RobustError> {
    let k = mdp.n_features();
    if draws.is_empty() {
        return Err(RobustError::Empty { what: "draws" });
    }
    if draws.len() > MAX_NUMBERS {
        let (what, got) = ("draws × features", draws.len());
        return Err(RobustError::Size { what, got, most: MAX_NUMBERS });
    }
    if !draws.len().is_multiple_of(k) {
        return Err(RobustError::Ragged { got: draws.len(), n_features: k });
    }
    check_numbers("draws", draws)?;
    if let Objective::Regret { expert } = objective {
        check_length("expert feature counts", expert.len(), k, "one per feature")?;
        check_numbers("expert feature counts", expert)?;
    }
    Ok(())
}

/// b of every draw.
pub(crate) fn offsets(mdp: &Mdp, draws: &[f64], objective: Objective<'_>, threads: usize) -> Vec<f64> {
    match objective {
        Objective::Robust => vec![0.0; draws.len() / mdp.n_features()],
        Objective::Regret { expert } => draws.chunks(mdp.n_features()).map(|w| dot(w, expert)).collect(),
        Objective::Loss => optimal_values(mdp, draws, threads),
    }
}

/// `weights` divided by their sum, which must be nearly 1.
pub(crate) fn distribution(weights: &[f64], n: usize) -> Result<Vec<f64>, RobustError> {
    check_length("posterior weights", weights.len(), n, "one per draw")?;
    check_numbers("posterior weights", weights)?;
    if let Some(index) = weights.iter().position(|weight| *weight < 0.0) {
        return Err(RobustError::NegativeWeight { index, got: weights[index] });
    }
    let sum: f64 = weights.iter().sum();
    if (sum - 1.0).abs() > WEIGHT_TOLERANCE {
        return Err(RobustError::WeightSum { got: sum, tolerance: WEIGHT_TOLERANCE });
    }
    Ok(weights.iter().map(|weight| weight / sum).collect())
}

/// The draws of positive mass, each different one once with all its mass, in the order in which they come first.
fn distinct(draws: &[f64], masses: &[f64], k: usize) -> (Vec<f64>, Vec<f64>) {
    // Adding 0 makes −0 equal to 0 in its bits.
    let draw = |i: usize| draws[i * k..][..k].iter().map(|w| w + 0.0);
    let bits = |i: usize| draw(i).map(f64::to_bits);
    let mut order: Vec<usize> = (0..masses.len()).filter(|&i| masses[i] > 0.0).collect();
    order.sort_by(|&i, &j| bits(i).cmp(bits(j)));
    // (first of its kind, mass)
    let mut kinds: Vec<(usize, f64)> = vec![];
    for i in order {
        match kinds.last_mut() {
            Some((first, mass)) if bits(*first).eq(bits(i)) => *mass += masses[i],
            _ => kinds.push((i, masses[i])),
        }
    }
    kinds.sort_unstable_by_key(|(first, _)| *first);
    (kinds.iter().flat_map(|(first, _)| draw(*first)).collect(), kinds.iter().map(|(_, mass)| *mass).collect())
}

/// V*_w of every draw; the same for any number of threads.
fn optimal_values(mdp: &Mdp, draws: &[f64], threads: usize) -> Vec<f64> {
    let k = mdp.n_features();
    let mut values = vec![0.0; draws.len() / k];
    // Fixed blocks, each with a solver of its own: what a solver remembers never depends on the number of threads.
    let blocks: Vec<_> = values.chunks_mut(BLOCK).zip(draws.chunks(BLOCK * k)).collect();
    let threads = threads.clamp(1, blocks.len());
    let mut shares: Vec<Vec<_>> = (0..threads).map(|_| Vec::new()).collect();
    for (index, block) in blocks.into_iter().enumerate() {
        shares[index % threads].push(block);
    }
    thread::scope(|scope| {
        for share in shares {
            scope.spawn(move || {
                for (values, draws) in share {
                    let mut solver = Solver::new(mdp);
                    for (value, w) in values.iter_mut().zip(draws.chunks(k)) {
                        *value = optimal_value(mdp, &mut solver, w);
                    }
                }
            });
        }
    });
    values
}

/// xᵀy.
pub(crate) fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}
