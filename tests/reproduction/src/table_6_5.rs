//! Table 6.5: perfect demonstrations only; Bayesian REX prefers them to random rollouts.

use crate::chapter4::choices;
use crate::chapter6::{Comparison, Printed, Ranked, Shown, World, repeated_starts};
use crate::harness::{Estimate, ReproductionError};
use crate::table_6_2::{NAMES, SHOWN};
use rand_chacha::ChaCha8Rng;

/// Random rollouts for every demonstration.
const WORSE: usize = 10;

/// The table.
pub const TABLE: Comparison = Comparison {
    name: "table-6.5",
    title: "perfect demonstrations only",
    axis: "demonstrations",
    columns: &NAMES,
    irl: Printed {
        dissertation: &[0.045, 0.034, 0.018, 0.009, 0.006],
        author: &[(0.0450, 0.0060), (0.0345, 0.0055), (0.0185, 0.0025), (0.0087, 0.0008), (0.0063, 0.0003)],
    },
    rex: Printed {
        dissertation: &[0.051, 0.045, 0.040, 0.034, 0.034],
        author: &[(0.0509, 0.0060), (0.0449, 0.0054), (0.0399, 0.0046), (0.0339, 0.0038), (0.0337, 0.0035)],
    },
    note: "both see perfect demonstrations; Bayesian REX prefers each to 10 random rollouts from its start, the joint posterior takes actions and preferences",
    show,
    claim: ("Bayesian IRL is better from 10 demonstrations on", better),
};

fn show(world: &World, column: usize, generator: &mut ChaCha8Rng) -> Result<Shown, ReproductionError> {
    let (mut perfect, mut ranked) = (Vec::new(), Ranked::default());
    for (d, start) in repeated_starts(world, SHOWN[column]).enumerate() {
        let demonstration = world.perfect(start, generator)?;
        ranked.features.extend(world.features(&demonstration));
        perfect.push(demonstration);
        let better = d * (WORSE + 1);
        for worse in better + 1..=better + WORSE {
            ranked.features.extend(world.features(&world.random(start, generator)?));
            ranked.pairs.push((worse, better));
        }
    }
    Ok(Shown { actions: choices(&perfect), ranked })
}

fn better(losses: &[(Estimate, Estimate)]) -> bool {
    losses[2..].iter().all(|(irl, rex)| irl.mean < rex.mean)
}
