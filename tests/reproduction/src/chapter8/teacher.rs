//! A simulated person who knows the true reward and never errs.

use crate::harness::ReproductionError;
use likelihood::actions::{Choice, ChoiceVerdict};
use mdp::{Mdp, Policy, Solver, successor_features};

/// Actions this much worse than the best, as a share of the largest value, are still good: rounding.
const TIE: f64 = 1e-9;

/// Values of the true reward.
#[derive(Debug, Clone)]
pub struct Teacher<'a> {
    mdp: &'a Mdp,
    weights: Vec<f64>,
    policy: Vec<usize>,
    values: Vec<f64>,
    q: Vec<f64>,
    tie: f64,
}

impl<'a> Teacher<'a> {
    /// One with the given weights.
    pub fn new(mdp: &'a Mdp, weights: &[f64]) -> Self {
        let mut solver = Solver::new(mdp);
        let optimum = solver.solve(weights);
        let states = 0..mdp.n_states();
        let values: Vec<f64> = states.clone().map(|state| optimum.state_value(state)).collect();
        let q = states.flat_map(|state| (0..mdp.n_actions()).map(move |action| (state, action)));
        let tie = TIE * values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        Self {
            mdp,
            weights: weights.to_vec(),
            policy: optimum.policy().to_vec(),
            q: q.map(|(state, action)| optimum.q(state, action)).collect(),
            values,
            tie,
        }
    }

    /// The action shown in a state: the first of the best.
    pub fn action(&self, state: usize) -> usize {
        self.policy[state]
    }

    /// Whether an action is one of the best.
    pub fn is_good(&self, state: usize, action: usize) -> bool {
        self.q[state * self.mdp.n_actions() + action] >= self.values[state] - self.tie
    }

    /// What is said about a trajectory: every step good or bad.
    pub fn critique(&self, trajectory: &[(usize, usize)]) -> Vec<Choice> {
        let say = |&(state, action): &(usize, usize)| {
            let verdict = if self.is_good(state, action) { ChoiceVerdict::Good } else { ChoiceVerdict::Bad };
            Choice { verdict, ..Choice::taken(state, action) }
        };
        inquiry::tabular::distinct(trajectory).iter().map(say).collect()
    }

    /// True losses V*(s) − V^π(s) of a policy: the mean over the initial distribution, and the largest over its states.
    ///
    /// # Errors
    /// A policy of another world.
    pub fn losses(&self, policy: &Policy) -> Result<(f64, f64), ReproductionError> {
        let k = self.mdp.n_features();
        let psi = successor_features(self.mdp, policy)?;
        let (mut mean, mut worst) = (0.0, 0.0_f64);
        for (state, &p) in self.mdp.initial().iter().enumerate().filter(|(_, p)| **p > 0.0) {
            let own: f64 = psi[state * k..][..k].iter().zip(&self.weights).map(|(psi, w)| psi * w).sum();
            let loss = self.values[state] - own;
            let loss = if loss > self.tie { loss } else { 0.0 };
            mean += p * loss;
            worst = worst.max(loss);
        }
        Ok((mean, worst))
    }
}

#[cfg(test)]
mod tests {
    use super::Teacher;
    use likelihood::actions::ChoiceVerdict;
    use mdp::Policy;
    use mdp::worlds::{DOWN, GridWorld, LEFT, RIGHT, UP};

    /// One row of three cells, the right one worth 1 a step: to the right is best, and at the right end whatever stays there.
    #[test]
    fn a_person_knows_what_is_best() {
        let mdp = GridWorld::one_hot(1, 3, &[0, 0, 1], 2).mdp().expect("a world");
        let teacher = Teacher::new(&mdp, &[0.0, 1.0]);
        assert_eq!((teacher.action(0), teacher.action(1)), (RIGHT, RIGHT));
        assert!(
            teacher.is_good(2, UP)
                && teacher.is_good(2, DOWN)
                && teacher.is_good(2, RIGHT)
                && !teacher.is_good(2, LEFT)
        );
        let said = teacher.critique(&[(0, RIGHT), (1, LEFT), (0, RIGHT)]);
        let verdicts: Vec<ChoiceVerdict> = said.iter().map(|choice| choice.verdict).collect();
        assert_eq!(verdicts, [ChoiceVerdict::Good, ChoiceVerdict::Bad]);
        // γ = .9: from the cells 0, 1, 2 the best is worth .81/.1, .9/.1 and 1/.1; going left nothing but the first step at 2.
        let (mean, worst) = teacher.losses(&Policy::Deterministic(vec![LEFT; 3])).expect("a policy");
        assert!((mean - (8.1 + 9.0 + 9.0) / 3.0).abs() < 1e-9 && (worst - 9.0).abs() < 1e-9, "{mean} {worst}");
        assert_eq!(teacher.losses(&Policy::Deterministic(vec![RIGHT; 3])).expect("a policy"), (0.0, 0.0));
    }
}
