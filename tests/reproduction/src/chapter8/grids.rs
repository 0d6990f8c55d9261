//! The grids of sections 8.2.1 and 8.2.2, as the author's program makes them (the text gives their size only).

use super::Teacher;
use crate::harness::ReproductionError;
use likelihood::actions::Choice;
use mdp::Mdp;
use mdp::random::{index, uniform};
use mdp::worlds::GridWorld;
use rand_chacha::ChaCha8Rng;

/// Cells along a side.
const SIDE: usize = 8;
/// Features.
const N_FEATURES: usize = 48;

/// An 8 × 8 grid with 48 features uniform in [0, 1) in every cell, deterministic moves, γ = 0.95, every cell a start; weights of
/// uniform size and random sign, ‖w‖₁ = 1.
///
/// # Errors
/// Never for these sizes.
pub fn dense_world(rng: &mut ChaCha8Rng) -> Result<(Mdp, Vec<f64>), ReproductionError> {
    let features = (0..SIDE * SIDE * N_FEATURES).map(|_| uniform(rng)).collect();
    let grid = GridWorld {
        rows: SIDE,
        columns: SIDE,
        n_features: N_FEATURES,
        features,
        slip: 0.0,
        gamma: 0.95,
        starts: (0..SIDE * SIDE).collect(),
        terminals: vec![],
    };
    let mut weights: Vec<f64> = (0..N_FEATURES)
        .map(|_| {
            let size = uniform(rng);
            if uniform(rng) < 0.5 { size } else { -size }
        })
        .collect();
    let norm: f64 = weights.iter().map(|w| w.abs()).sum();
    weights.iter_mut().for_each(|w| *w /= norm);
    Ok((grid.mdp()?, weights))
}

/// Two steps of an optimal trajectory from a random start, and another random start where it stands still.
pub fn first_demonstration(mdp: &Mdp, teacher: &Teacher<'_>, rng: &mut ChaCha8Rng) -> Vec<Choice> {
    let mut state = index(mdp.n_states(), rng);
    let mut shown = Vec::new();
    for _ in 0..2 {
        let action = teacher.action(state);
        shown.push(Choice::taken(state, action));
        let next = mdp.successors(state, action).next().map_or(state, |(target, _)| target);
        state = if next == state { index(mdp.n_states(), rng) } else { next };
    }
    shown
}
