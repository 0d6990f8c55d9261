//! What is optimal under each draw of the weights of a decision process, solved once and used by every score.

use std::thread;

use mdp::{Mdp, Solver};

use crate::InquiryError;
use crate::error::{check_length, check_numbers};

/// Draws that share a solver: what a solver remembers never depends on the number of threads.
const BLOCK: usize = 32;

/// V*, Q*, the optimal policy and its feature counts under n draws.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnOptima {
    n_states: usize,
    n_actions: usize,
    n_features: usize,
    /// n × k.
    draws: Vec<f64>,
    /// n × S.
    values: Vec<f64>,
    /// n × S × A.
    q: Vec<f64>,
    /// n × S.
    policies: Vec<usize>,
    /// n × k.
    counts: Vec<f64>,
}

impl DrawnOptima {
    /// Solves `mdp` for every one of `draws`, n × k row by row. The same for any number of threads.
    ///
    /// # Errors
    /// No draws, rows of another length, weights that are not finite.
    pub fn new(mdp: &Mdp, draws: &[f64], threads: usize) -> Result<Self, InquiryError> {
        let (n_states, n_actions, k) = (mdp.n_states(), mdp.n_actions(), mdp.n_features());
        if draws.is_empty() {
            return Err(InquiryError::Empty { what: "draws" });
        }
        let n = draws.len() / k;
        check_length("weights of draws", draws.len(), n * k)?;
        check_numbers("weight", draws, "finite", f64::is_finite)?;
        let (mut values, mut q) = (vec![0.0; n * n_states], vec![0.0; n * n_states * n_actions]);
        let (mut policies, mut counts) = (vec![0; n * n_states], vec![0.0; n * k]);
        let blocks: Vec<_> = values
            .chunks_mut(BLOCK * n_states)
            .zip(q.chunks_mut(BLOCK * n_states * n_actions))
            .zip(policies.chunks_mut(BLOCK * n_states))
            .zip(counts.chunks_mut(BLOCK * k))
            .zip(draws.chunks(BLOCK * k))
            .collect();
        let solve = |((((values, q), policies), counts), draws): Block<'_>| {
            let mut solver = Solver::new(mdp);
            for (i, w) in draws.chunks(k).enumerate() {
                let optimum = solver.solve(w);
                policies[i * n_states..][..n_states].copy_from_slice(optimum.policy());
                counts[i * k..][..k].copy_from_slice(optimum.feature_counts());
                for state in 0..n_states {
                    values[i * n_states + state] = optimum.state_value(state);
                    for action in 0..n_actions {
                        q[(i * n_states + state) * n_actions + action] = optimum.q(state, action);
                    }
                }
            }
        };
        let threads = threads.clamp(1, blocks.len());
        if threads == 1 {
            blocks.into_iter().for_each(solve);
        } else {
            let mut shares: Vec<Vec<Block<'_>>> = (0..threads).map(|_| Vec::new()).collect();
            for (index, block) in blocks.into_iter().enumerate() {
                shares[index % threads].push(block);
            }
            thread::scope(|scope| {
                for share in shares {
                    scope.spawn(|| share.into_iter().for_each(solve));
                }
            });
        }
        Ok(Self { n_states, n_actions, n_features: k, draws: draws.to_vec(), values, q, policies, counts })
    }

    /// Draws.
    pub fn n(&self) -> usize {
        self.draws.len() / self.n_features
    }

    /// Weights of a draw: k numbers.
    pub fn weights(&self, draw: usize) -> &[f64] {
        &self.draws[draw * self.n_features..][..self.n_features]
    }

    /// V*(s) under a draw.
    pub fn value(&self, draw: usize, state: usize) -> f64 {
        self.values[draw * self.n_states + state]
    }

    /// Q*(s, ·) under a draw: A numbers.
    pub fn q(&self, draw: usize, state: usize) -> &[f64] {
        &self.q[(draw * self.n_states + state) * self.n_actions..][..self.n_actions]
    }

    /// The optimal action in every state under a draw.
    pub fn policy(&self, draw: usize) -> &[usize] {
        &self.policies[draw * self.n_states..][..self.n_states]
    }

    /// Φ of that policy over the initial distribution: k numbers.
    pub fn feature_counts(&self, draw: usize) -> &[f64] {
        &self.counts[draw * self.n_features..][..self.n_features]
    }
}

/// Values, Q, policies, counts and draws of a block.
type Block<'a> = ((((&'a mut [f64], &'a mut [f64]), &'a mut [usize]), &'a mut [f64]), &'a [f64]);
