//! The states that can be visited at all.

use mdp::Mdp;

/// States that some policy visits, ascending, and the place of each state among them.
#[derive(Debug, Clone)]
pub(crate) struct Reachable {
    pub(crate) states: Vec<usize>,
    /// `usize::MAX` where no policy comes.
    places: Vec<usize>,
}

impl Reachable {
    pub(crate) fn new(mdp: &Mdp) -> Self {
        let mut open: Vec<usize> = (0..mdp.n_states()).filter(|&state| mdp.initial()[state] > 0.0).collect();
        let mut reached = vec![false; mdp.n_states()];
        open.iter().for_each(|&state| reached[state] = true);
        while let Some(state) = open.pop() {
            if mdp.gamma() == 0.0 {
                continue;
            }
            for action in 0..mdp.n_actions() {
                for (target, _) in mdp.successors(state, action) {
                    if !reached[target] {
                        reached[target] = true;
                        open.push(target);
                    }
                }
            }
        }
        let states: Vec<usize> = (0..mdp.n_states()).filter(|&state| reached[state]).collect();
        let mut places = vec![usize::MAX; mdp.n_states()];
        for (place, &state) in states.iter().enumerate() {
            places[state] = place;
        }
        Self { states, places }
    }

    /// max |φ_j(s, a)| of every feature: k numbers.
    pub(crate) fn largest_features(&self, mdp: &Mdp) -> Vec<f64> {
        let mut largest = vec![0.0_f64; mdp.n_features()];
        for &state in &self.states {
            for action in 0..mdp.n_actions() {
                largest.iter_mut().zip(mdp.features(state, action)).for_each(|(most, phi)| *most = most.max(phi.abs()));
            }
        }
        largest
    }

    /// Column of u(s, a) in the flow Σ_a u(s′, a) − γ Σ P(s′|s, a) u(s, a) = p₀(s′): (place of s′, coefficient), ascending.
    pub(crate) fn flow(&self, mdp: &Mdp, place: usize, state: usize, action: usize) -> Vec<(usize, f64)> {
        let mut flow = vec![(place, 1.0)];
        for (target, p) in mdp.successors(state, action).filter(|_| mdp.gamma() > 0.0) {
            let target = self.places[target];
            if target == place {
                flow[0].1 -= mdp.gamma() * p;
            } else {
                flow.push((target, -mdp.gamma() * p));
            }
        }
        flow.sort_unstable_by_key(|(row, _)| *row);
        flow
    }
}
