//! The Markov chain that a policy makes of a process, and linear equations in it.

use crate::MdpError;
use crate::limits::MAX_GAMMA_LARGE;
use crate::linear::banded::Banded;
use crate::linear::order::narrow_order;
use crate::linear::sweeps::Sweeps;
use crate::model::Mdp;
use crate::policy::Policy;

/// Largest number of multiplications that factors are taken without asking whether sweeps cost less.
const CHEAP: f64 = 2e5;
/// Largest number of numbers that factors may take.
const MAX_FACTORS: usize = 50_000_000;

/// I − γP_π, ready for equations.
#[derive(Debug, Clone)]
pub(crate) enum Chain {
    /// Factored.
    Factors(Banded),
    /// Laid out for sweeps.
    Sweeps(Sweeps),
}

/// γP_π by rows; targets may be repeated.
struct Rows {
    gamma: f64,
    starts: Vec<u32>,
    targets: Vec<u32>,
    weights: Vec<f64>,
}

impl Rows {
    fn new(mdp: &Mdp, policy: &Policy) -> Self {
        let mut rows = Self { gamma: mdp.gamma(), starts: vec![0], targets: vec![], weights: vec![] };
        for state in 0..mdp.n_states() {
            policy.for_each_action(mdp.n_actions(), state, |action, share| {
                let (targets, probabilities) = mdp.row(state, action);
                rows.targets.extend_from_slice(targets);
                rows.weights.extend(probabilities.iter().map(|p| mdp.gamma() * (share * p)));
            });
            rows.starts.push(rows.targets.len() as u32);
        }
        rows
    }

    fn row(&self, state: usize) -> (&[u32], &[f64]) {
        let range = self.starts[state] as usize..self.starts[state + 1] as usize;
        (&self.targets[range.clone()], &self.weights[range])
    }

    /// No order of the states is narrower than this: states that are reached within d steps all lie within d bandwidths of where the
    /// steps began, so there are at most 2 d bandwidths and one of them.
    fn least_bandwidth(&self) -> usize {
        let n = self.starts.len() - 1;
        let mut seen = vec![false; n];
        let (mut states, mut least) = (vec![0_u32], 0);
        seen[0] = true;
        let (mut from, mut steps) = (0, 0);
        while from < states.len() {
            steps += 1;
            let to = states.len();
            for i in from..to {
                for &target in self.row(states[i] as usize).0 {
                    if !seen[target as usize] {
                        seen[target as usize] = true;
                        states.push(target);
                    }
                }
            }
            from = to;
            least = least.max((states.len() - 1).div_ceil(2 * steps));
        }
        least
    }

    fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> + Clone {
        (0..self.starts.len() - 1).flat_map(|state| {
            let (targets, weights) = self.row(state);
            targets.iter().zip(weights).map(move |(&target, &weight)| (state, target as usize, weight))
        })
    }
}

impl Chain {
    /// The chain of a valid policy; `width` right-hand sides are to be expected.
    pub(crate) fn new(mdp: &Mdp, policy: &Policy, width: usize) -> Self {
        let (n, rows) = (mdp.n_states(), Rows::new(mdp, policy));
        // Sweeps shrink the error by γ each at least, mostly by far more.
        let sweeping = rows.weights.len() as f64 * width as f64 * 10.0 / (1.0 - rows.gamma);
        let affordable = |bandwidth: usize| {
            let work = Banded::work(n, bandwidth);
            Banded::size(n, bandwidth) <= MAX_FACTORS && (work <= CHEAP || work <= sweeping)
        };
        let always = rows.gamma > MAX_GAMMA_LARGE;
        if always || affordable(rows.least_bandwidth()) {
            let order = narrow_order(n, rows.entries().map(|(state, target, _)| (state, target)));
            if always || affordable(order.bandwidth) {
                return Self::Factors(Banded::new(&order, rows.entries()));
            }
        }
        Self::Sweeps(Sweeps::new(n, rows.gamma, 1.0, |state| rows.row(state)))
    }

    /// Solves (I − γP) x = b in place for `width` right-hand sides, S × `width` row by row.
    ///
    /// # Errors
    /// Sweeps that stop helping before the solution is good enough.
    pub(crate) fn solve(&self, x: &mut [f64], width: usize) -> Result<(), MdpError> {
        match self {
            Self::Factors(factors) => factors.solve(x, width),
            Self::Sweeps(sweeps) => return sweeps.solve(x, width),
        }
        Ok(())
    }

    /// Solves (I − γPᵀ) y = b in place: discounted visits of each state that start as b.
    pub(crate) fn visits(&self, b: &mut [f64]) {
        match self {
            Self::Factors(factors) => factors.solve_transposed(b),
            Self::Sweeps(sweeps) => sweeps.visits(b),
        }
    }
}
