//! The optimisation itself, and everything it is compared with.

use robust::{
    Bootstrap, Objective, OutOfSample, Problem, Risk, Settings, Solution, optimal_policy, out_of_sample, performance,
};

use super::Arguments;
use super::arguments::ObjectiveName;
use super::compare::{Baseline, baselines};
use super::inputs::Inputs;
use crate::OfflineError;
use crate::answer::{level, tell};
use crate::judgement::counted;

/// Everything that was found.
#[derive(Debug)]
pub(super) struct Found {
    pub(super) solution: Solution,
    /// λ ascending; empty where none was asked for.
    pub(super) frontier: Vec<Solution>,
    pub(super) baselines: Option<Vec<Baseline>>,
    /// Of the policy that is best for the mean reward.
    pub(super) neutral: Risk,
    pub(super) fresh: Option<(OutOfSample, usize)>,
    pub(super) unreachable: Vec<usize>,
    pub(super) n_distinct: usize,
    pub(super) warnings: Vec<String>,
}

impl Found {
    /// Solves the problem.
    pub(super) fn of(arguments: &Arguments, inputs: &Inputs) -> Result<Self, OfflineError> {
        let mut warnings = inputs.warnings.clone();
        let settings = Settings {
            method: arguments.method.choice(),
            tolerance: arguments.tolerance,
            max_rounds: arguments.max_rounds,
            max_iterations: arguments.max_iterations,
        };
        let objective = objective(arguments, inputs);
        let n_draws = inputs.draws.n_rows();
        if objective == Objective::Loss {
            tell(&format!("apprentice optimize: planning for each of {n_draws} draws"));
        }
        let weights = inputs.weights.as_deref();
        let problem = Problem::new(&inputs.mdp, &inputs.draws.values, weights, objective, inputs.threads)?;
        let lambdas = lambdas(arguments);
        let mut n_solved = 0;
        let mut solutions = problem.frontier_watched(arguments.alpha, &lambdas, &settings, &mut |solution| {
            n_solved += 1;
            let of = if lambdas.len() == 1 { String::new() } else { format!("{n_solved} of {}, ", lambdas.len()) };
            tell(&format!(
                "apprentice optimize: {of}lambda = {}: {} after {}",
                level(solution.lambda),
                solution.outcome.name(),
                counted(solution.rounds, "round")
            ));
        })?;
        let place = lambdas.iter().position(|lambda| *lambda == arguments.lambda).unwrap_or(0);
        let solution = solutions[place].clone();
        if !arguments.frontier {
            solutions.clear();
        }
        solutions.sort_by(|a, b| a.lambda.total_cmp(&b.lambda));
        let unreachable = problem.unreachable();
        if !unreachable.is_empty() {
            warnings.push(format!(
                "{} can be reached by no policy ({}): the action given there is the best one for the mean reward",
                counted(unreachable.len(), "state"),
                first_few(&unreachable)
            ));
        }
        let neutral = optimal_policy(&inputs.mdp, problem.mean_weights())?;
        let neutral = problem.risk_of(&neutral.feature_counts, arguments.alpha, arguments.lambda)?;
        let compared = match arguments.baselines {
            true => Some(baselines(arguments, inputs, &problem, &settings, &mut warnings)?),
            false => None,
        };
        let fresh = fresh(arguments, inputs, objective, &solution)?;
        let n_distinct = problem.n_draws();
        Ok(Self {
            solution,
            frontier: solutions,
            baselines: compared,
            neutral,
            fresh,
            unreachable,
            n_distinct,
            warnings,
        })
    }
}

fn objective<'a>(arguments: &Arguments, inputs: &'a Inputs) -> Objective<'a> {
    match (arguments.objective, &inputs.expert) {
        (ObjectiveName::Robust, _) => Objective::Robust,
        (ObjectiveName::Regret, Some(expert)) => Objective::Regret { expert },
        // Without an expert there is no regret, and the inputs were refused.
        (ObjectiveName::Regret, None) | (ObjectiveName::Evd, _) => Objective::Loss,
    }
}

/// λ asked for, and those of the frontier, each once.
fn lambdas(arguments: &Arguments) -> Vec<f64> {
    let mut lambdas = vec![arguments.lambda];
    if arguments.frontier {
        let last = (arguments.points - 1) as f64;
        lambdas.extend((0..arguments.points).map(|i| i as f64 / last).filter(|lambda| *lambda != arguments.lambda));
    }
    lambdas
}

fn fresh(
    arguments: &Arguments,
    inputs: &Inputs,
    objective: Objective<'_>,
    solution: &Solution,
) -> Result<Option<(OutOfSample, usize)>, OfflineError> {
    let Some((draws, n_chains)) = &inputs.out_of_sample else { return Ok(None) };
    tell(&format!("apprentice optimize: judging by {} other draws", draws.n_rows()));
    let values = performance(&inputs.mdp, &draws.values, objective, &solution.feature_counts, inputs.threads)?;
    let bootstrap = Bootstrap { confidence: arguments.confidence, seed: arguments.seed, ..Bootstrap::default() };
    // A chain must be long enough to judge its memory; the few draws of a short file are taken for independent ones.
    let chains = if *n_chains == 1 && arguments.chains.is_none() { 0 } else { *n_chains };
    let fresh = out_of_sample(&values, chains, None, arguments.alpha, &bootstrap)?;
    Ok(Some((fresh, *n_chains)))
}

/// `3, 4, 7, …`.
pub(super) fn first_few(states: &[usize]) -> String {
    const SHOWN: usize = 8;
    let mut text = states.iter().take(SHOWN).map(usize::to_string).collect::<Vec<_>>().join(", ");
    if states.len() > SHOWN {
        text += ", …";
    }
    text
}
