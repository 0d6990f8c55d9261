//! Apprenticeship by projection (Abbeel and Ng 2004, section 3.1): policies whose mixture has nearly the feature counts of
//! an expert. The dissertation evaluates its policies in Table 4.1.

use crate::error::{MdpError, check_finite};
use crate::evaluate::{feature_counts, occupancy};
use crate::model::Mdp;
use crate::policy::Policy;
use crate::solver::Solver;

/// Steps shorter than this share of the distance to the expert no longer get anywhere.
const STALLED: f64 = 1e-12;

/// What projection found.
#[derive(Debug, Clone, PartialEq)]
pub struct Projection {
    /// The start, then the optimal policy under each guess of the weights; each different policy once.
    pub policies: Vec<Policy>,
    /// Their expected feature counts: k numbers each.
    pub feature_counts: Vec<Vec<f64>>,
    /// Shares, summing to 1, in which the policies mix to feature counts nearest to the expert's.
    pub mixture: Vec<f64>,
    /// Distance ‖μ_E − μ̄‖₂ between expert and mixture.
    pub distance: f64,
    /// The last guess of the weights, μ_E − μ̄.
    pub weights: Vec<f64>,
    /// The policy found last, an index into `policies`: the one the author's program evaluates.
    pub last: usize,
}

impl Projection {
    /// Index of the policy whose own feature counts are nearest to `expert`.
    pub fn closest(&self, expert: &[f64]) -> usize {
        let mut best = (0, f64::INFINITY);
        for (index, counts) in self.feature_counts.iter().enumerate() {
            let distance = distance(expert, counts);
            if distance < best.1 {
                best = (index, distance);
            }
        }
        best.0
    }

    /// One stochastic policy with the feature counts of the mixture: its visits are the mixed visits of the policies.
    ///
    /// # Errors
    /// Policies that are not of `mdp`.
    pub fn mixed_policy(&self, mdp: &Mdp) -> Result<Policy, MdpError> {
        let mut visits = vec![0.0; mdp.n_states() * mdp.n_actions()];
        for (policy, share) in self.policies.iter().zip(&self.mixture).filter(|(_, share)| **share > 0.0) {
            for (sum, x) in visits.iter_mut().zip(occupancy(mdp, policy)?) {
                *sum += share * x;
            }
        }
        for row in visits.chunks_mut(mdp.n_actions()) {
            let total: f64 = row.iter().sum();
            // Where none of them ever comes, any distribution will do.
            let uniform = 1.0 / row.len() as f64;
            row.iter_mut().for_each(|x| *x = if total > 0.0 { *x / total } else { uniform });
        }
        Ok(Policy::Stochastic(visits))
    }
}

/// Projects from the feature counts of `start` towards those of an `expert` (k numbers) until they are within `epsilon`,
/// no policy leads closer, or `max_iterations` policies were optimised. Estimated counts may lie where no mixture reaches;
/// then the nearest mixture comes out.
///
/// # Errors
/// A start that is not a policy of `mdp`; counts of the wrong number or not finite.
pub fn projection(
    mdp: &Mdp,
    expert: &[f64],
    start: &Policy,
    epsilon: f64,
    max_iterations: usize,
) -> Result<Projection, MdpError> {
    if expert.len() != mdp.n_features() {
        let (name, got, expected) = ("expert feature counts", expert.len(), mdp.n_features());
        return Err(MdpError::Length { name, got, expected, why: "one per feature" });
    }
    check_finite("expert feature counts", expert)?;
    let mut mean = feature_counts(mdp, start)?;
    let mut found = Projection {
        policies: vec![start.clone()],
        feature_counts: vec![mean.clone()],
        mixture: vec![1.0],
        distance: distance(expert, &mean),
        weights: difference(expert, &mean),
        last: 0,
    };
    let mut solver = Solver::new(mdp);
    for _ in 0..max_iterations {
        if found.distance <= epsilon {
            break;
        }
        let optimum = solver.solve(&found.weights);
        found.last = found.remember(optimum.policy(), optimum.feature_counts());
        let towards = difference(&found.feature_counts[found.last], &mean);
        // The step along μ_i − μ̄ that comes nearest; beyond μ_i it would no longer be a mixture.
        let share = (dot(&towards, &found.weights) / dot(&towards, &towards)).min(1.0);
        // Not a number where the optimal policy is the mixture already.
        if share.is_nan() || share <= STALLED {
            break;
        }
        mean.iter_mut().zip(&towards).for_each(|(mean, step)| *mean += share * step);
        found.mixture.iter_mut().for_each(|x| *x *= 1.0 - share);
        found.mixture[found.last] += share;
        let before = found.distance;
        (found.distance, found.weights) = (distance(expert, &mean), difference(expert, &mean));
        if before - found.distance <= STALLED * before {
            break;
        }
    }
    Ok(found)
}

impl Projection {
    /// Index of the policy, added if it is new.
    fn remember(&mut self, actions: &[usize], counts: &[f64]) -> usize {
        let same = |policy: &Policy| matches!(policy, Policy::Deterministic(known) if known == actions);
        self.policies.iter().position(same).unwrap_or_else(|| {
            self.policies.push(Policy::Deterministic(actions.to_vec()));
            self.feature_counts.push(counts.to_vec());
            self.mixture.push(0.0);
            self.policies.len() - 1
        })
    }
}

fn difference(x: &[f64], y: &[f64]) -> Vec<f64> {
    x.iter().zip(y).map(|(x, y)| x - y).collect()
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

fn distance(x: &[f64], y: &[f64]) -> f64 {
    let gap = difference(x, y);
    libm::sqrt(dot(&gap, &gap))
}
