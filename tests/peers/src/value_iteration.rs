//! Value iteration as the dissertation's chapter-4 program does it: in place, to a tolerance, from the last values on.

use mdp::Mdp;

/// The world's sparse transitions and the last values.
#[derive(Debug, Clone)]
pub struct ValueIteration {
    gamma: f64,
    n_actions: usize,
    n_features: usize,
    /// Features of each state.
    features: Vec<f64>,
    /// Successors of state s under action a: `successors[starts[s * A + a]..starts[s * A + a + 1]]`.
    successors: Vec<(usize, f64)>,
    starts: Vec<usize>,
    rewards: Vec<f64>,
    values: Vec<f64>,
}

impl ValueIteration {
    /// Starts from values of zero.
    pub fn new(mdp: &Mdp) -> Self {
        let (n_states, n_actions) = (mdp.n_states(), mdp.n_actions());
        let mut successors = Vec::new();
        let mut starts = vec![0];
        for state in 0..n_states {
            for action in 0..n_actions {
                successors.extend(mdp.successors(state, action));
                starts.push(successors.len());
            }
        }
        let features = (0..n_states).flat_map(|state| mdp.features(state, 0).to_vec()).collect();
        let zeros = vec![0.0; n_states];
        Self {
            gamma: mdp.gamma(),
            n_actions,
            n_features: mdp.n_features(),
            features,
            successors,
            starts,
            rewards: zeros.clone(),
            values: zeros,
        }
    }

    /// Values to go on from.
    pub fn start_from(&mut self, values: &[f64]) {
        self.values.copy_from_slice(values);
    }

    /// V after the last sweep.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Sweeps until no value changes by more than `tolerance`; gives the number of sweeps.
    pub fn solve(&mut self, w: &[f64], tolerance: f64) -> usize {
        for (reward, features) in self.rewards.iter_mut().zip(self.features.chunks_exact(self.n_features)) {
            *reward = features.iter().zip(w).map(|(feature, w)| feature * w).sum();
        }
        let mut sweeps = 0;
        loop {
            let mut change = 0.0_f64;
            for state in 0..self.values.len() {
                let mut best = f64::NEG_INFINITY;
                for action in 0..self.n_actions {
                    best = best.max(self.expected(state, action));
                }
                let value = self.rewards[state] + self.gamma * best;
                change = change.max((value - self.values[state]).abs());
                self.values[state] = value;
            }
            sweeps += 1;
            if change <= tolerance {
                return sweeps;
            }
        }
    }

    /// Q of the last values.
    pub fn q(&self, state: usize, action: usize) -> f64 {
        self.rewards[state] + self.gamma * self.expected(state, action)
    }

    fn expected(&self, state: usize, action: usize) -> f64 {
        let row = state * self.n_actions + action;
        let successors = &self.successors[self.starts[row]..self.starts[row + 1]];
        successors.iter().map(|&(next, probability)| probability * self.values[next]).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::ValueIteration;
    use mdp::worlds::chapter4::{REP_0_WEIGHTS, STARTS, rep_0};

    #[test]
    fn values_of_rep_0_are_the_known_ones_up_to_the_tolerance() {
        let mdp = rep_0().mdp().expect("a good world");
        let mut iteration = ValueIteration::new(&mdp);
        // A last change below 1e-3 leaves at most γ/(1 − γ) times as much to come.
        for (tolerance, error) in [(1e-3, 9e-3), (1e-12, 1e-8)] {
            iteration.solve(&REP_0_WEIGHTS, tolerance);
            let mean = STARTS.iter().map(|&s| iteration.values()[s]).sum::<f64>() / 9.0;
            assert!((mean - 1.442_905_98).abs() < error, "{mean}");
            assert!((iteration.values()[40] - 1.355_526_92).abs() < error);
        }
        assert_eq!(iteration.solve(&REP_0_WEIGHTS, 1e-3), 1, "warm: nothing left to do");
    }
}
