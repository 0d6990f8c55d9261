//! Planning for one reward: the best reply to a distribution over draws, and a bound that no policy exceeds.

use mdp::{Mdp, MdpError, Optimum, Policy, Solver, feature_counts, values};

use crate::level::Level;
use crate::scenarios::{Scenarios, dot};

/// Errors of optimal values up to this share of their size do not matter yet.
const ROUGH: f64 = 1e-9;
/// Values within ε of the best, and the greedy policy of such values, are at most about 3 ε apart.
const LOOSE: f64 = 4.0;
/// Most steps of policy iteration.
const MAX_IMPROVEMENTS: usize = 100;
/// Most times that one optimum is looked for.
const MAX_TRIES: usize = 20;

/// A distribution q over draws as far as it matters: Σ q_i ψ_i(μ) = weightsᵀμ − offset.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Price {
    /// Σ q_i w_i: k numbers.
    pub(crate) weights: Vec<f64>,
    /// Σ q_i b_i.
    pub(crate) offset: f64,
}

impl Price {
    /// Of `shares`: N numbers.
    pub(crate) fn new(scenarios: &Scenarios, shares: &[f64]) -> Self {
        let (mut weights, mut offset) = (vec![0.0; scenarios.n_features], 0.0);
        for (i, share) in shares.iter().enumerate().filter(|(_, share)| **share > 0.0) {
            weights.iter_mut().zip(scenarios.draw(i)).for_each(|(sum, w)| *sum += share * w);
            offset += share * scenarios.offsets[i];
        }
        Self { weights, offset }
    }

    /// (1 − share) · this + share · other.
    pub(crate) fn towards(&self, other: &Self, share: f64) -> Self {
        let mix = |x: f64, y: f64| x + share * (y - x);
        let weights = self.weights.iter().zip(&other.weights).map(|(x, y)| mix(*x, *y)).collect();
        Self { weights, offset: mix(self.offset, other.offset) }
    }
}

/// An optimal deterministic policy.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Plan {
    pub(crate) actions: Vec<u32>,
    /// Its feature counts: k numbers.
    pub(crate) counts: Vec<f64>,
    /// Its discounted visits of every state, where they are known already.
    pub(crate) visits: Option<Vec<f64>>,
}

impl Plan {
    /// The policy.
    pub(crate) fn policy(&self) -> Policy {
        Policy::Deterministic(self.actions.iter().map(|&action| action as usize).collect())
    }
}

/// Plans again and again.
#[derive(Debug, Clone)]
pub(crate) struct Planner<'a> {
    mdp: &'a Mdp,
    solver: Solver<'a>,
    /// w̄: k numbers.
    mean: Vec<f64>,
    /// Errors below this do not matter.
    precision: f64,
}

impl<'a> Planner<'a> {
    /// Returns are at least about `unit` in size.
    pub(crate) fn new(mdp: &'a Mdp, scenarios: &Scenarios, unit: f64) -> Self {
        Self { mdp, solver: Solver::new(mdp), mean: scenarios.mean.clone(), precision: ROUGH * unit }
    }

    /// The optimal policy for the mean reward w̄, and what no policy's expected return exceeds.
    ///
    /// # Errors
    /// A process in which policies cannot be evaluated.
    pub(crate) fn plan_for_mean(&mut self) -> Result<(f64, Plan), MdpError> {
        let nothing = Price { weights: vec![0.0; self.mean.len()], offset: 0.0 };
        self.plan(Level { alpha: 0.0, lambda: 1.0 }, &nothing, 0.0)
    }

    /// The optimal policy for the reward (1 − λ) Σ q_i w_i + λ w̄, and what no policy's objective exceeds, for
    /// CVaR_α(ψ) ≤ Σ q_i ψ_i for every q with 0 ≤ q_i ≤ p_i / (1 − α) and Σ q = 1. Of a large process both are only within about
    /// `error` of the best.
    ///
    /// # Errors
    /// A process in which policies cannot be evaluated.
    pub(crate) fn plan(&mut self, level: Level, price: &Price, error: f64) -> Result<(f64, Plan), MdpError> {
        let mixed = price.weights.iter().zip(&self.mean);
        let weights: Vec<f64> = mixed.map(|(w, mean)| level.risk() * w + level.lambda * mean).collect();
        let (mut bound, mut plan) = optimum(self.mdp, &mut self.solver, &weights, error, |optimum| {
            let actions = optimum.policy().iter().map(|&action| action as u32).collect();
            let counts = optimum.feature_counts().to_vec();
            let visits = optimum.known_visits().map(<[f64]>::to_vec);
            (optimum.value() + optimum.error_bound(), Plan { actions, counts, visits })
        });
        // At a long horizon the solver takes actions for ties that are not.
        if bound - dot(&weights, &plan.counts) > self.precision.max(LOOSE * error) {
            let (polished, better) = polish(self.mdp, &weights, &plan)?;
            bound = bound.min(polished);
            if dot(&weights, &better.counts) > dot(&weights, &plan.counts) {
                plan = better;
            }
        }
        Ok((bound - level.risk() * price.offset, plan))
    }
}

/// What `read` takes from the optimum under `weights` within `error`, which is looked for again from where the search stopped
/// while it is known too roughly.
pub(crate) fn optimum<'m, T>(
    mdp: &Mdp,
    solver: &mut Solver<'m>,
    weights: &[f64],
    error: f64,
    read: impl Fn(&Optimum<'m>) -> T,
) -> T {
    let n_states = mdp.n_states();
    let mut tries = 1;
    loop {
        let optimum = solver.solve_within(weights, error);
        let size = (0..n_states).fold(0.0_f64, |most, state| most.max(optimum.state_value(state).abs()));
        if optimum.error_bound() <= error.max(ROUGH * size) || tries == MAX_TRIES {
            return read(optimum);
        }
        tries += 1;
    }
}

/// V*_w.
pub(crate) fn optimal_value(mdp: &Mdp, solver: &mut Solver<'_>, weights: &[f64]) -> f64 {
    let (value, rough) = optimum(mdp, solver, weights, 0.0, |optimum| {
        let rough = optimum.error_bound() > ROUGH * optimum.value().abs();
        let actions = || optimum.policy().iter().map(|&action| action as u32).collect();
        (
            optimum.value(),
            rough.then(|| Plan { actions: actions(), counts: optimum.feature_counts().to_vec(), visits: None }),
        )
    });
    let polished = rough.and_then(|plan| polish(mdp, weights, &plan).ok());
    polished.map_or(value, |(_, plan)| value.max(dot(weights, &plan.counts)))
}

/// Policy iteration from `plan` until nothing but rounding is left: a bound on the value of every policy, and the last one.
fn polish(mdp: &Mdp, weights: &[f64], plan: &Plan) -> Result<(f64, Plan), MdpError> {
    let mut actions: Vec<usize> = plan.actions.iter().map(|&action| action as usize).collect();
    let mut bound = f64::INFINITY;
    for _ in 0..MAX_IMPROVEMENTS {
        let value = values(mdp, &Policy::Deterministic(actions.clone()), weights)?;
        let q = |state: usize, action: usize| {
            let ahead: f64 = mdp.successors(state, action).map(|(target, p)| p * value[target]).sum();
            dot(weights, mdp.features(state, action)) + mdp.gamma() * ahead
        };
        let rounding = 8.0 * f64::EPSILON * value.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let (mut residual, mut improved) = (0.0_f64, false);
        for (state, action) in actions.iter_mut().enumerate() {
            let present = q(state, *action);
            let (best, gain) = (0..mdp.n_actions())
                .map(|other| (other, q(state, other) - present))
                .fold((*action, 0.0), |best, other| if other.1 > best.1 { other } else { best });
            residual = residual.max(present + gain - value[state]);
            if gain > rounding {
                *action = best;
                improved = true;
            }
        }
        // V + residual / (1 − γ) is what no policy exceeds in any state.
        bound = bound.min(dot(mdp.initial(), &value) + residual / (1.0 - mdp.gamma()));
        if !improved {
            break;
        }
    }
    let counts = feature_counts(mdp, &Policy::Deterministic(actions.clone()))?;
    let actions = actions.into_iter().map(|action| action as u32).collect();
    Ok((bound, Plan { actions, counts, visits: None }))
}
