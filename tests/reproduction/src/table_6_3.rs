//! Table 6.3: ranked random rollouts for both; Bayesian IRL takes them for demonstrations.

use crate::chapter4::choices;
use crate::chapter6::{Comparison, Printed, Shown, World, ranked_by_return, repeated_starts};
use crate::harness::{Estimate, ReproductionError};
use crate::table_6_2::{NAMES, SHOWN};
use rand_chacha::ChaCha8Rng;

/// The table.
pub const TABLE: Comparison = Comparison {
    name: "table-6.3",
    title: "ranked suboptimal demonstrations only",
    axis: "demonstrations",
    columns: &NAMES,
    irl: Printed {
        dissertation: &[3.512, 3.319, 2.791, 3.078, 3.158],
        author: &[(3.5121, 0.2519), (3.3189, 0.2462), (2.7910, 0.2074), (3.0777, 0.1308), (3.1583, 0.1233)],
    },
    rex: Printed {
        dissertation: &[1.796, 0.393, 0.026, 0.006, 0.006],
        author: &[(1.7960, 0.2078), (0.392_686, 0.1022), (0.0263, 0.0123), (0.0058, 0.0002), (0.0058, 0.0002)],
    },
    note: "both see the same random rollouts, ranked by true return; Bayesian IRL takes them for demonstrations, the joint posterior takes them for both and learns how little the actions mean",
    show,
    claim: ("Bayesian REX is better at every number", better),
};

fn show(world: &World, column: usize, generator: &mut ChaCha8Rng) -> Result<Shown, ReproductionError> {
    let random: Vec<_> =
        repeated_starts(world, SHOWN[column]).map(|start| world.random(start, generator)).collect::<Result<_, _>>()?;
    Ok(Shown { actions: choices(&random), ranked: ranked_by_return(world, &random) })
}

fn better(losses: &[(Estimate, Estimate)]) -> bool {
    losses.iter().all(|(irl, rex)| irl.mean - rex.mean > 2.0 * libm::hypot(rex.standard_error, irl.standard_error))
}
