//! A small garden and draws about it: flowers may be very good or rather bad.

#![allow(dead_code, reason = "each test file uses its part")]

use apprentice_msgs::msg::{ActionDemonstration, EvidenceRecord, Posterior, TabularWorld};
use exchange::{Picture, World, world_from_message, world_to_message};
use mdp::worlds::GridWorld;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Path, flowers and a gate: 2 × 3 cells from the top left, an end at the gate in the bottom right.
pub fn message() -> TabularWorld {
    let cells = [0, 1, 0, 0, 1, 2];
    let grid = GridWorld { starts: vec![0], terminals: vec![5], slip: 0.05, ..GridWorld::one_hot(2, 3, &cells, 3) };
    let names = ["path", "flowers", "gate"].map(String::from);
    let mdp = grid.mdp().expect("a good garden");
    world_to_message("garden", &names, &mdp, Picture::Cells { rows: 2, columns: 3 })
}

pub fn world() -> World {
    world_from_message(&message()).expect("a good garden")
}

/// 4 chains of 150 draws each: flowers are liked on average, and hated by some.
pub fn posterior(revision: u64) -> Posterior {
    let mut rng = ChaCha8Rng::seed_from_u64(100 + revision);
    let mut draw = || {
        let flowers = if rng.random_range(0.0..1.0) < 0.15 { -0.7 } else { 0.25 };
        let noise = |rng: &mut ChaCha8Rng| rng.random_range(-0.05..0.05);
        [-0.1 + noise(&mut rng), flowers + noise(&mut rng), 0.3 + noise(&mut rng)].map(|w: f64| w as f32)
    };
    Posterior {
        revision,
        evidence_hash: format!("hash {revision}"),
        world: world().reference(),
        feature_names: message().feature_names,
        n_chains: 4,
        n_draws: 600,
        draws: (0..600).flat_map(|_| draw()).collect(),
        map_weights: vec![-0.1, 0.25, 0.3],
        seed: 5,
        version: "v".into(),
        ..Posterior::default()
    }
}

/// A demonstration of (state, action) pairs.
pub fn demonstration(id: &str, steps: &[(u32, u32)]) -> ActionDemonstration {
    ActionDemonstration {
        id: id.into(),
        world_id: "garden".into(),
        states: steps.iter().map(|step| step.0).collect(),
        actions: steps.iter().map(|step| step.1).collect(),
        ..ActionDemonstration::default()
    }
}

/// Its record.
pub fn shown(sequence: u64, demonstration: &ActionDemonstration) -> EvidenceRecord {
    let actions = vec![demonstration.clone()];
    EvidenceRecord { sequence, kind: EvidenceRecord::ACTIONS, actions, ..EvidenceRecord::default() }
}
