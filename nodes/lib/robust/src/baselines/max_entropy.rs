//! Maximum-entropy inverse reinforcement learning (Ziebart et al. 2008; dissertation section F.3): the weights under which
//! demonstrations are most probable, which are those whose expected feature counts match the demonstrations'.

use mdp::{Mdp, Policy};

use super::soft::{Soft, discounted, over_steps};
use crate::error::{RobustError, check_length, check_numbers};
use crate::scenarios::dot;

/// Most numbers that the policies of all steps may be.
const MAX_POLICIES: usize = 50_000_000;
/// Part of the gain foreseen that a step must bring (Armijo 1966).
const SUFFICIENT: f64 = 1e-4;
/// Halvings of a step after which only rounding is left.
const MAX_HALVINGS: usize = 60;

/// How long trajectories are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Horizon {
    /// So many steps, undiscounted, or up to a terminal state: the number of states in section F.3.
    Steps(usize),
    /// Without an end, discounted by γ.
    Discounted,
}

/// What weights w may be; θ = βw.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WeightNorm {
    /// ‖w‖₂ = 1, as in section F.3: feature counts match only as far as that allows.
    Unit,
    /// Anything: feature counts match if any policy's do.
    Free,
}

/// How weights are looked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MaxEntropySettings {
    /// β > 0.
    pub rationality: f64,
    /// How long trajectories are.
    pub horizon: Horizon,
    /// What weights may be.
    pub norm: WeightNorm,
    /// Converged when no direction that is allowed has a slope by w above this share of ‖μ_E‖₂ + 1, times β.
    pub tolerance: f64,
    /// Most steps of the ascent.
    pub max_iterations: usize,
}

impl MaxEntropySettings {
    /// Those of section F.3: β = 10, unit weights, as many steps as states.
    pub fn dissertation(mdp: &Mdp) -> Self {
        Self {
            rationality: 10.0,
            horizon: Horizon::Steps(mdp.n_states()),
            norm: WeightNorm::Unit,
            tolerance: 1e-7,
            max_iterations: 2000,
        }
    }
}

/// Whether the weights are the most probable ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Convergence {
    /// They are, to the tolerance.
    Converged,
    /// They are not: the iterations did not suffice, or there are none, as for feature counts that no policy has.
    NotConverged,
}

/// What was learned.
#[derive(Debug, Clone, PartialEq)]
pub struct MaxEntropy {
    /// Whether the weights are the most probable ones.
    pub outcome: Convergence,
    /// w: k numbers. All 0 where acting at random matches the demonstrations.
    pub weights: Vec<f64>,
    /// π(a|s) of the first step: S × A.
    pub policy: Policy,
    /// Feature counts expected over the horizon: k numbers.
    pub feature_counts: Vec<f64>,
    /// Mean log likelihood of a demonstration, but for what does not depend on w.
    pub log_likelihood: f64,
    /// Largest slope by w in a direction that is allowed.
    pub slope: f64,
    /// Steps made.
    pub iterations: usize,
}

/// Weights for demonstrations with mean feature counts `expert` (k numbers, of the same horizon and discount: see
/// [`crate::expert_feature_counts`]), by gradient ascent with steps after Barzilai and Borwein (1988).
///
/// # Errors
/// Counts of the wrong number or not finite; settings out of range; a horizon too long for so large a process.
pub fn max_entropy(mdp: &Mdp, expert: &[f64], settings: &MaxEntropySettings) -> Result<MaxEntropy, RobustError> {
    check_length("expert feature counts", expert.len(), mdp.n_features(), "one per feature")?;
    check_numbers("expert feature counts", expert)?;
    check(mdp, settings)?;
    let mut ascent = Ascent { mdp, expert, settings, values: vec![] };
    let beta = settings.rationality;
    let enough = settings.tolerance * (norm(expert) + 1.0);
    let mut at = ascent.point(vec![0.0; expert.len()])?;
    let start = norm(&at.gradient);
    if settings.norm == WeightNorm::Unit && start > enough {
        let along = at.gradient.iter().map(|x| beta * x / start).collect();
        at = ascent.point(along)?;
    }
    let mut step = beta / norm(&at.gradient).max(enough);
    let mut iterations = 0;
    while norm(&at.slope) > enough && iterations < settings.max_iterations {
        iterations += 1;
        let Some(next) = ascent.step(&at, step)? else { break };
        // The inverse of how fast the slope changes along the step.
        let moved = difference(&next.theta, &at.theta);
        let bent = -dot(&moved, &difference(&next.slope, &at.slope));
        step = if bent > 0.0 { dot(&moved, &moved) / bent } else { 2.0 * step };
        at = next;
    }
    let converged = norm(&at.slope) <= enough && at.soft.settled;
    Ok(MaxEntropy {
        outcome: if converged { Convergence::Converged } else { Convergence::NotConverged },
        weights: at.theta.iter().map(|theta| theta / beta).collect(),
        slope: beta * norm(&at.slope),
        log_likelihood: at.likelihood,
        policy: Policy::Stochastic(at.soft.policy),
        feature_counts: at.soft.counts,
        iterations,
    })
}

fn check(mdp: &Mdp, settings: &MaxEntropySettings) -> Result<(), RobustError> {
    let positive = |x: f64| x > 0.0 && x <= 1e12;
    if !positive(settings.rationality) {
        let (name, got) = ("rationality", settings.rationality);
        return Err(RobustError::Range { name, got, expected: "above 0 and at most 1e12" });
    }
    if !(settings.tolerance > 0.0 && settings.tolerance < 1.0) {
        let (name, got) = ("tolerance", settings.tolerance);
        return Err(RobustError::Range { name, got, expected: "between 0 and 1" });
    }
    let Horizon::Steps(steps) = settings.horizon else { return Ok(()) };
    if steps == 0 {
        return Err(RobustError::Range { name: "horizon", got: 0.0, expected: "at least 1 step" });
    }
    let got = steps.saturating_mul(mdp.n_states()).saturating_mul(mdp.n_actions());
    if got > MAX_POLICIES {
        return Err(RobustError::Size { what: "steps × states × actions", got, most: MAX_POLICIES });
    }
    Ok(())
}

/// The likelihood of demonstrations as a function of θ.
struct Ascent<'a> {
    mdp: &'a Mdp,
    expert: &'a [f64],
    settings: &'a MaxEntropySettings,
    /// Values last found, to start from.
    values: Vec<f64>,
}

struct Point {
    theta: Vec<f64>,
    likelihood: f64,
    /// μ_E − μ.
    gradient: Vec<f64>,
    /// The part of it along which θ may move.
    slope: Vec<f64>,
    soft: Soft,
}

impl Ascent<'_> {
    fn point(&mut self, theta: Vec<f64>) -> Result<Point, RobustError> {
        let soft = match self.settings.horizon {
            Horizon::Steps(steps) => over_steps(self.mdp, &theta, steps),
            Horizon::Discounted => discounted(self.mdp, &theta, &mut self.values)?,
        };
        let likelihood = dot(&theta, self.expert) - soft.value;
        let gradient = difference(self.expert, &soft.counts);
        let mut slope = gradient.clone();
        let length = dot(&theta, &theta);
        if self.settings.norm == WeightNorm::Unit && length > 0.0 {
            let outward = dot(&theta, &slope) / length;
            slope.iter_mut().zip(&theta).for_each(|(x, theta)| *x -= outward * theta);
        }
        Ok(Point { theta, likelihood, gradient, slope, soft })
    }

    /// A step that brings enough, the longest of `length`, `length` / 2, …; `None` if none does.
    fn step(&mut self, from: &Point, mut length: f64) -> Result<Option<Point>, RobustError> {
        let squared = dot(&from.slope, &from.slope);
        for _ in 0..MAX_HALVINGS {
            let mut theta: Vec<f64> = from.theta.iter().zip(&from.slope).map(|(x, d)| x + length * d).collect();
            let size = norm(&theta);
            if self.settings.norm == WeightNorm::Unit && size > 0.0 {
                theta.iter_mut().for_each(|x| *x *= self.settings.rationality / size);
            }
            if theta.iter().all(|x| x.is_finite()) {
                let to = self.point(theta)?;
                // Rounding may hide what the last steps bring; then a smaller slope is enough.
                let wanted = from.likelihood + SUFFICIENT * length * squared;
                let flat = (to.likelihood - from.likelihood).abs() <= 1e-13 * from.likelihood.abs().max(1.0);
                if to.likelihood >= wanted || (flat && dot(&to.slope, &to.slope) < squared) {
                    return Ok(Some(to));
                }
            }
            length *= 0.5;
        }
        Ok(None)
    }
}

fn difference(x: &[f64], y: &[f64]) -> Vec<f64> {
    x.iter().zip(y).map(|(x, y)| x - y).collect()
}

fn norm(x: &[f64]) -> f64 {
    libm::sqrt(dot(x, x))
}
