//! Table 6.4: Bayesian IRL from good and bad demonstrations (Cui and Niekum 2018), the ends of a ranking.

use crate::chapter4::choices;
use crate::chapter6::{Comparison, Printed, Shown, World, ranked_by_return, repeated_starts};
use crate::harness::{Estimate, ReproductionError};
use likelihood::actions::{Choice, ChoiceVerdict};
use rand_chacha::ChaCha8Rng;

/// Random rollouts.
const ROLLOUTS: usize = 20;
/// How many at the top are called good, and as many at the bottom bad.
const ENDS: [usize; 4] = [1, 2, 5, 10];
/// The same in print.
const NAMES: [&str; 4] = ["5 %", "10 %", "25 %", "50 %"];

/// The table.
pub const TABLE: Comparison = Comparison {
    name: "table-6.4",
    title: "good and bad demonstrations from a ranking",
    axis: "top and bottom of 20 ranked rollouts",
    columns: &NAMES,
    irl: Printed {
        dissertation: &[1.283, 0.956, 1.065, 2.096],
        author: &[(1.1196, 0.1665), (0.8429, 0.1561), (1.1241, 0.1770), (2.1107, 0.1871)],
    },
    rex: Printed {
        dissertation: &[0.006, 0.006, 0.006, 0.006],
        author: &[(0.0058, 0.0002), (0.0058, 0.0002), (0.0058, 0.0002), (0.0058, 0.0002)],
    },
    note: "20 random rollouts ranked by true return; Bayesian IRL takes the actions of the best for good and of the worst for bad, Bayesian REX the ranking, the joint posterior all of it",
    show,
    claim: ("Bayesian REX is better at every x", better),
};

fn show(world: &World, column: usize, generator: &mut ChaCha8Rng) -> Result<Shown, ReproductionError> {
    let random: Vec<_> =
        repeated_starts(world, ROLLOUTS).map(|start| world.random(start, generator)).collect::<Result<_, _>>()?;
    let mut order: Vec<usize> = (0..ROLLOUTS).collect();
    let returns: Vec<f64> = random.iter().map(|trajectory| world.true_return(trajectory)).collect();
    order.sort_by(|&a, &b| returns[b].total_cmp(&returns[a]));
    let judged = |which: &[usize], verdict| -> Vec<Choice> {
        let trajectories: Vec<_> = which.iter().map(|&i| random[i].clone()).collect();
        choices(&trajectories).into_iter().map(|choice| Choice { verdict, ..choice }).collect()
    };
    let mut actions = judged(&order[..ENDS[column]], ChoiceVerdict::Good);
    actions.extend(judged(&order[ROLLOUTS - ENDS[column]..], ChoiceVerdict::Bad));
    Ok(Shown { actions, ranked: ranked_by_return(world, &random) })
}

fn better(losses: &[(Estimate, Estimate)]) -> bool {
    losses.iter().all(|(irl, rex)| irl.mean - rex.mean > 2.0 * libm::hypot(rex.standard_error, irl.standard_error))
}
