//! Table 6.2: perfect demonstrations for Bayesian IRL, ranked random rollouts for Bayesian REX.

use crate::chapter4::choices;
use crate::chapter6::{Comparison, Printed, Shown, World, ranked_by_return, repeated_starts};
use crate::harness::{Estimate, ReproductionError};
use rand_chacha::ChaCha8Rng;

/// Numbers of demonstrations.
pub const SHOWN: [usize; 5] = [2, 5, 10, 20, 30];
/// Their names.
pub const NAMES: [&str; 5] = ["2", "5", "10", "20", "30"];

/// The table.
pub const TABLE: Comparison = Comparison {
    name: "table-6.2",
    title: "ranked suboptimal against perfect demonstrations",
    axis: "demonstrations",
    columns: &NAMES,
    irl: Printed {
        dissertation: &[0.044, 0.033, 0.020, 0.009, 0.006],
        author: &[(0.0443, 0.0057), (0.0329, 0.0051), (0.0200, 0.0026), (0.0086, 0.0008), (0.0065, 0.0004)],
    },
    rex: Printed {
        dissertation: &[1.779, 0.421, 0.019, 0.006, 0.006],
        author: &[(1.7795, 0.2148), (0.4211, 0.0993), (0.0186, 0.0053), (0.0062, 0.0003), (0.0056, 0.0002)],
    },
    note: "Bayesian IRL sees perfect demonstrations, Bayesian REX as many random rollouts from the same starts, ranked by true return; the joint posterior sees both",
    show,
    claim: ("Bayesian REX is on a par or better from 10 demonstrations on", on_a_par),
};

fn show(world: &World, column: usize, generator: &mut ChaCha8Rng) -> Result<Shown, ReproductionError> {
    let (mut perfect, mut random) = (Vec::new(), Vec::new());
    for start in repeated_starts(world, SHOWN[column]) {
        perfect.push(world.perfect(start, generator)?);
        random.push(world.random(start, generator)?);
    }
    Ok(Shown { actions: choices(&perfect), ranked: ranked_by_return(world, &random) })
}

fn on_a_par(losses: &[(Estimate, Estimate)]) -> bool {
    losses[2..]
        .iter()
        .all(|(irl, rex)| rex.mean - irl.mean <= 2.0 * libm::hypot(rex.standard_error, irl.standard_error))
}
