//! What is optimal under the weights last solved for.

use std::sync::Arc;

use crate::linear::{Sweeps, dot};
use crate::model::Mdp;
use crate::policy::Policy;
use crate::solver::evaluated::{Evaluated, Help};

/// The optimal policy, its values and their derivatives by the weights.
#[derive(Debug, Clone)]
pub struct Optimum<'a> {
    mdp: &'a Mdp,
    starts: Vec<(usize, f64)>,
    value: f64,
    /// How close actions come to tie.
    tie: f64,
    pub(super) evaluated: Arc<Evaluated>,
    pub(super) help: Help,
    pub(super) values: Vec<f64>,
    /// Q, all states of an action together.
    pub(super) q: Vec<f64>,
}

impl<'a> Optimum<'a> {
    pub(super) fn new(mdp: &'a Mdp, evaluated: Arc<Evaluated>) -> Self {
        let n = mdp.n_states();
        let starts = mdp.initial().iter().copied().enumerate().filter(|(_, p)| *p > 0.0).collect();
        let (values, q) = (vec![0.0; n], vec![0.0; n * mdp.n_actions()]);
        Self { mdp, starts, value: 0.0, tie: 0.0, evaluated, help: Help::default(), values, q }
    }

    /// Takes over values that were found.
    pub(super) fn finish(&mut self, tie: f64) {
        self.tie = tie;
        self.value = self.starts.iter().map(|&(state, p)| p * self.values[state]).sum();
    }

    /// Sets all values to `x`.
    pub(super) fn fill(&mut self, x: f64) {
        self.values.fill(x);
        self.q.fill(x);
        self.value = x;
    }

    /// The optimal action in each state; the first of those that tie.
    pub fn policy(&self) -> &[usize] {
        &self.evaluated.policy
    }

    /// The optimal policy that takes all actions that tie equally often.
    pub fn indifferent_policy(&self) -> Policy {
        let (n, n_actions) = (self.values.len(), self.mdp.n_actions());
        let mut probabilities = vec![0.0; n * n_actions];
        for (state, row) in probabilities.chunks_mut(n_actions).enumerate() {
            let q = || self.q[state..].iter().step_by(n);
            let best = q().fold(f64::NEG_INFINITY, |best, q| best.max(*q));
            // NaN ties with everything.
            let ties = |q: &f64| q.is_nan() || *q >= best - self.tie;
            let n_ties = q().filter(|q| ties(q)).count();
            for (p, q) in row.iter_mut().zip(q()) {
                *p = if ties(q) { 1.0 / n_ties as f64 } else { 0.0 };
            }
        }
        Policy::Stochastic(probabilities)
    }

    /// V*: mean over the initial distribution.
    pub fn value(&self) -> f64 {
        self.value
    }

    /// V*(s).
    pub fn state_value(&self, state: usize) -> f64 {
        self.values[state]
    }

    /// Q*(s, a).
    pub fn q(&self, state: usize, action: usize) -> f64 {
        self.q[action * self.values.len() + state]
    }

    /// By how much V*(s) may be off in any state: the largest Bellman residual / (1 − γ).
    pub fn error_bound(&self) -> f64 {
        let n = self.values.len();
        let residual = self.values.iter().enumerate().fold(0.0_f64, |most, (state, value)| {
            let best = self.q[state..].iter().step_by(n).fold(f64::NEG_INFINITY, |best, q| best.max(*q));
            most.max((best - value).abs())
        });
        residual / (1.0 - self.mdp.gamma())
    }

    /// ψ(s, a) = ∂Q*(s, a)/∂w into `out`: k numbers. In a large process the first call for a policy evaluates it in every
    /// state; [`Optimum::add_gradient`] does not.
    pub fn action_features(&self, state: usize, action: usize, out: &mut [f64]) {
        let psi = self.evaluated.psi(self.mdp);
        out.copy_from_slice(self.mdp.features(state, action));
        for (target, p) in self.mdp.successors(state, action) {
            let weight = self.mdp.gamma() * p;
            for (out, psi) in out.iter_mut().zip(psi[target..].iter().step_by(self.values.len())) {
                *out += weight * psi;
            }
        }
    }

    /// Adds Σ c ψ(s, a) over the given (s, a, c) to `out`: k numbers. This is how the gradient of any function of Q* is
    /// made, c being its derivative by Q*(s, a).
    pub fn add_gradient(&self, coefficients: &[(usize, usize, f64)], out: &mut [f64]) {
        // Σ c ψ(s, a) = Σ c φ(s, a) + yᵀΨ, y being what starts in s′: the sum of c γ p.
        let mut visits = vec![0.0; self.values.len()];
        for &(state, action, c) in coefficients {
            for (target, p) in self.mdp.successors(state, action) {
                visits[target] += c * (self.mdp.gamma() * p);
            }
        }
        for same in coefficients.chunk_by(|x, y| x.0 == y.0 && !self.mdp.features_depend_on_action()) {
            let c: f64 = same.iter().map(|coefficient| coefficient.2).sum();
            add_scaled(out, c, self.mdp.features(same[0].0, same[0].1));
        }
        if let Some(psi) = self.evaluated.known_psi() {
            for (out, psi) in out.iter_mut().zip(psi.chunks_exact(visits.len())) {
                *out += dot(&visits, psi);
            }
            return;
        }
        // yᵀΨ = (all discounted visits that start as y)ᵀ φ: one solution instead of k.
        match &self.help.sweeps {
            Some(sweeps) => sweeps.visits(&mut visits),
            None => {
                let gamma = self.mdp.gamma();
                let row = |state: usize| self.mdp.row(state, self.policy()[state]);
                Sweeps::new(visits.len(), gamma, gamma, row).visits(&mut visits);
            }
        }
        for (state, (y, &action)) in visits.iter().zip(self.policy()).enumerate() {
            if *y != 0.0 {
                add_scaled(out, *y, self.mdp.features(state, action));
            }
        }
    }

    /// Discounted visits of every state by the optimal policy, S numbers, where [`Self::feature_counts`] was computed from them.
    pub fn known_visits(&self) -> Option<&[f64]> {
        self.evaluated.known_visits().map(|visits| &visits[..])
    }

    /// Φ of the optimal policy: k numbers.
    pub fn feature_counts(&self) -> &[f64] {
        self.evaluated.counts(self.mdp, &self.help)
    }
}

/// out += c · x.
fn add_scaled(out: &mut [f64], c: f64, x: &[f64]) {
    for (out, x) in out.iter_mut().zip(x) {
        *out += c * x;
    }
}
