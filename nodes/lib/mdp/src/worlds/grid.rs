//! Grids of cells with moves up, down, left and right; a move off the grid stays in place.

use rand_chacha::ChaCha8Rng;

use crate::error::check_sizes;
use crate::parts::{Features, MdpParts};
use crate::random::index;
use crate::{Mdp, MdpError};

/// Action 0.
pub const UP: usize = 0;
/// Action 1.
pub const DOWN: usize = 1;
/// Action 2.
pub const LEFT: usize = 2;
/// Action 3.
pub const RIGHT: usize = 3;
/// Names of the actions, in order.
pub const ACTIONS: [&str; 4] = ["up", "down", "left", "right"];

/// A grid; its states are the cells, row by row from the top left.
#[derive(Debug, Clone, PartialEq)]
pub struct GridWorld {
    /// Rows.
    pub rows: usize,
    /// Columns.
    pub columns: usize,
    /// Features k.
    pub n_features: usize,
    /// φ(s): rows·columns × k, row by row.
    pub features: Vec<f64>,
    /// Probability of slipping to each of the two directions at right angles to the chosen one; 0 is deterministic.
    pub slip: f64,
    /// Discount factor.
    pub gamma: f64,
    /// States to start in, all equally probable.
    pub starts: Vec<usize>,
    /// States where it ends.
    pub terminals: Vec<usize>,
}

impl GridWorld {
    /// A grid of one active feature per cell, whose index `cells` holds row by row; deterministic moves, γ = 0.9, every cell a
    /// start, no terminals. Change what should differ.
    ///
    /// # Panics
    /// When a feature is not below `n_features`.
    pub fn one_hot(rows: usize, columns: usize, cells: &[usize], n_features: usize) -> Self {
        let mut features = vec![0.0; cells.len() * n_features];
        for (row, &cell) in features.chunks_mut(n_features).zip(cells) {
            row[cell] = 1.0;
        }
        let (starts, terminals) = ((0..rows * columns).collect(), vec![]);
        Self { rows, columns, n_features, features, slip: 0.0, gamma: 0.9, starts, terminals }
    }

    /// The same with a feature drawn for every cell.
    pub fn random(rows: usize, columns: usize, n_features: usize, rng: &mut ChaCha8Rng) -> Self {
        let cells: Vec<usize> = (0..rows * columns).map(|_| index(n_features, rng)).collect();
        Self::one_hot(rows, columns, &cells, n_features)
    }

    /// The process.
    ///
    /// # Errors
    /// Numbers that make no process: features not finite, slips outside [0, ½], starts or terminals off the grid …
    pub fn mdp(&self) -> Result<Mdp, MdpError> {
        let n_states = self.rows.saturating_mul(self.columns);
        check_sizes(n_states, ACTIONS.len(), self.n_features)?;
        for (name, states) in [("start", &self.starts), ("terminal", &self.terminals)] {
            if let Some(index) = states.iter().position(|&state| state >= n_states) {
                return Err(MdpError::OutOfRange { name, index, what: "state", got: states[index], below: n_states });
            }
        }
        if !(0.0..=0.5).contains(&self.slip) {
            return Err(MdpError::Probability { name: "slip", index: 0, got: self.slip });
        }
        let mut initial = vec![0.0; n_states];
        for &start in &self.starts {
            initial[start] += 1.0 / self.starts.len() as f64;
        }
        let mut transitions = Vec::with_capacity(n_states * ACTIONS.len() * 3);
        for state in (0..n_states).filter(|state| !self.terminals.contains(state)) {
            for action in 0..ACTIONS.len() {
                let aside = if action == UP || action == DOWN { [LEFT, RIGHT] } else { [UP, DOWN] };
                let moves = [(action, 1.0 - 2.0 * self.slip), (aside[0], self.slip), (aside[1], self.slip)];
                let first = transitions.len();
                for (direction, p) in moves.into_iter().filter(|(_, p)| *p > 0.0) {
                    let target = self.neighbour(state, direction);
                    match transitions[first..].iter_mut().find(|(_, _, other, _)| *other == target) {
                        Some((_, _, _, sum)) => *sum += p,
                        None => transitions.push((state, action, target, p)),
                    }
                }
            }
        }
        Mdp::new(MdpParts {
            gamma: self.gamma,
            n_states,
            n_actions: ACTIONS.len(),
            n_features: self.n_features,
            initial,
            transitions,
            features: Features::State(self.features.clone()),
            actions: ACTIONS.map(String::from).to_vec(),
            shape: Some([self.rows, self.columns]),
        })
    }

    /// The cell next to `state` in a direction, or `state` itself at the edge.
    fn neighbour(&self, state: usize, direction: usize) -> usize {
        let (row, column) = (state / self.columns, state % self.columns);
        match direction {
            UP if row > 0 => state - self.columns,
            DOWN if row + 1 < self.rows => state + self.columns,
            LEFT if column > 0 => state - 1,
            RIGHT if column + 1 < self.columns => state + 1,
            _ => state,
        }
    }
}
