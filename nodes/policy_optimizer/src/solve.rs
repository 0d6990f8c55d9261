//! Policies and frontiers: functions of the settings, the inputs and the preference alone.

use crate::inputs::{Halves, Inputs, MissingInput, expert};
use crate::message::{has_policy, method_number, objective_number, outcome_number};
use crate::settings::Objective;
use crate::{Settings, words};
use apprentice_msgs::msg::{
    FrontierPoint, PolicyFrontier, PolicySet, PolicyToJudge, Posterior, RiskPreference, RobustPolicy,
};
use bus::NodeSettings;
use exchange::{ROBUST_POLICY, robust_set_id};
use mdp::Policy;
use robust::{Bootstrap, OutOfSample, Problem, Solution, optimal_policy, out_of_sample, performance};

/// Said of a policy that [`by_return`] judges.
const BY_RETURN: &str = "; by its return, for nothing was shown that regret could be measured against";
/// Bootstrap replicates of the interval.
const REPLICATES: usize = 1000;
/// A frontier's policies are sent when they are no more numbers than this.
const MAX_FRONTIER_NUMBERS: usize = 10_000;
/// A policy is sent to be judged as a table when it has no more numbers than this, else as feature counts.
const MAX_TABLE: usize = 4096;

/// The robust policy, and what is to be judged of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Policies {
    /// The policy, or why there is none.
    pub policy: RobustPolicy,
    /// The policy and the one that is best for the mean reward; none without a policy that is proved the best.
    pub set: Option<PolicySet>,
}

/// The robust policy of a posterior under a preference; none: the λ of the settings.
pub fn policy(settings: &Settings, inputs: &Inputs<'_>, preference: Option<&RiskPreference>) -> Policies {
    if let Some(settings) = by_return(settings, inputs) {
        let mut found = policy(&settings, inputs, preference);
        found.policy.reason += BY_RETURN;
        return found;
    }
    let lambda = preference.map_or(settings.lambda, |preference| preference.lambda);
    let bare = RobustPolicy {
        lambda,
        preference_number: preference.map_or(0, |preference| preference.number),
        preference_id: preference.map_or_else(String::new, |preference| preference.id.clone()),
        ..without_policy(settings, inputs)
    };
    let solved = problem(settings, inputs).and_then(|(problem, halves, expert)| {
        let solution = problem.solve(settings.alpha, lambda, &settings.solver())?;
        let held_out = judged(settings, inputs, &halves, expert.as_deref(), &solution);
        let set = if settings.judge { set(inputs, &bare, &halves, &problem, &solution)? } else { None };
        Ok((solution, held_out, halves, set))
    });
    match solved {
        Ok((solution, held_out, halves, set)) => {
            Policies { policy: whole(settings, bare, &solution, held_out, &halves, inputs), set }
        }
        Err(missing) => Policies { policy: RobustPolicy { reason: missing.to_string(), ..bare }, set: None },
    }
}

/// Settings that judge a policy by its return, where regret has nothing yet to be measured against: the first question comes from some
/// policy, and what answers it may be the first demonstration.
fn by_return(settings: &Settings, inputs: &Inputs<'_>) -> Option<Settings> {
    let is_alone = settings.objective == Objective::Regret && inputs.demonstrations.is_empty();
    is_alone.then(|| Settings { objective: Objective::Robust, ..settings.clone() })
}

/// What every λ buys under a posterior.
pub fn frontier(settings: &Settings, inputs: &Inputs<'_>) -> PolicyFrontier {
    if let Some(settings) = by_return(settings, inputs) {
        let mut found = frontier(&settings, inputs);
        found.reason += BY_RETURN;
        return found;
    }
    let posterior = inputs.posterior;
    let mut message = PolicyFrontier {
        header: posterior.header.clone(),
        revision: posterior.revision,
        evidence_hash: posterior.evidence_hash.clone(),
        world: inputs.world.reference(),
        outcome: RobustPolicy::NOT_COMPUTED,
        objective: objective_number(settings.objective),
        alpha: settings.alpha,
        n_states: count(inputs.world.mdp.n_states()),
        n_actions: count(inputs.world.mdp.n_actions()),
        seed: settings.seed(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        ..PolicyFrontier::default()
    };
    let solved = problem(settings, inputs).and_then(|(problem, halves, _)| {
        let solutions = problem.frontier(settings.alpha, &settings.lambdas(), &settings.solver())?;
        Ok((solutions, problem.n_draws(), halves))
    });
    match solved {
        Err(missing) => message.reason = missing.to_string(),
        Ok((solutions, _, halves)) => {
            message.n_draws = n_draws(&halves, posterior);
            message.draws_used = halves.draws_used;
            message.points = solutions.iter().map(point).collect();
            message.outcome = message.points.iter().map(|point| point.outcome).max().unwrap_or(message.outcome);
            message.reason = match solutions.iter().find(|solution| outcome_number(solution.outcome) == message.outcome)
            {
                Some(worst) if has_policy(worst.outcome) => {
                    let tail =
                        if message.outcome == RobustPolicy::OPTIMAL { "" } else { ", not all of them proved the best" };
                    format!("{} balances between the worst case and the mean{tail}", solutions.len())
                }
                Some(worst) => words::no_policy(worst.outcome),
                None => String::new(),
            };
            let cells = inputs.world.mdp.n_states() * inputs.world.mdp.n_actions();
            let all = solutions.iter().all(|solution| has_policy(solution.outcome));
            if all && cells.saturating_mul(solutions.len()) <= MAX_FRONTIER_NUMBERS {
                let tables = solutions.iter().map(|solution| table(&solution.policy, inputs));
                message.policies = tables.flatten().map(|p| p as f32).collect();
            }
        }
    }
    message
}

/// The problem, its draws, and what the demonstrations collect.
fn problem<'a>(
    settings: &Settings,
    inputs: &Inputs<'a>,
) -> Result<(Problem<'a>, Halves, Option<Vec<f64>>), MissingInput> {
    let Inputs { posterior, world, .. } = *inputs;
    if posterior.outcome != Posterior::READY {
        return Err(MissingInput::NotMixed { reason: posterior.reason.clone() });
    }
    let (of_world, of_posterior) = (world.mdp.n_features(), posterior.feature_names.len());
    if of_world != of_posterior {
        return Err(MissingInput::Features { world: of_world, posterior: of_posterior });
    }
    let expert = expert(settings, inputs)?;
    let halves = Halves::new(settings, posterior);
    let objective = objective(settings, expert.as_deref());
    let problem = Problem::new(&world.mdp, &halves.chosen_by, None, objective, settings.n_threads())?;
    Ok((problem, halves, expert))
}

fn objective<'e>(settings: &Settings, expert: Option<&'e [f64]>) -> robust::Objective<'e> {
    match settings.objective {
        Objective::Robust => robust::Objective::Robust,
        Objective::Regret => robust::Objective::Regret { expert: expert.unwrap_or_default() },
        Objective::Evd => robust::Objective::Loss,
    }
}

/// How the policy fares on the draws that did not choose it; none when there are none, or too few to say.
fn judged(
    settings: &Settings,
    inputs: &Inputs<'_>,
    halves: &Halves,
    expert: Option<&[f64]>,
    solution: &Solution,
) -> Option<OutOfSample> {
    if halves.held_out.is_empty() || !has_policy(solution.outcome) {
        return None;
    }
    let objective = objective(settings, expert);
    let counts = &solution.feature_counts;
    let values = performance(&inputs.world.mdp, &halves.held_out, objective, counts, settings.n_threads()).ok()?;
    let bootstrap = Bootstrap { confidence: settings.confidence, replicates: REPLICATES, seed: settings.seed() };
    out_of_sample(&values, halves.n_chains, None, settings.alpha, &bootstrap).ok()
}

/// The message without a policy.
fn without_policy(settings: &Settings, inputs: &Inputs<'_>) -> RobustPolicy {
    let posterior = inputs.posterior;
    RobustPolicy {
        header: posterior.header.clone(),
        revision: posterior.revision,
        evidence_hash: posterior.evidence_hash.clone(),
        world: inputs.world.reference(),
        outcome: RobustPolicy::NOT_COMPUTED,
        objective: objective_number(settings.objective),
        alpha: settings.alpha,
        objective_value: f64::NAN,
        gap: f64::NAN,
        expected_return: f64::NAN,
        value_at_risk: f64::NAN,
        conditional_value_at_risk: f64::NAN,
        held_out_mean: f64::NAN,
        held_out_cvar: f64::NAN,
        held_out_cvar_low: f64::NAN,
        held_out_cvar_high: f64::NAN,
        confidence: f64::NAN,
        n_states: count(inputs.world.mdp.n_states()),
        n_actions: count(inputs.world.mdp.n_actions()),
        seed: settings.seed(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        ..RobustPolicy::default()
    }
}

fn whole(
    settings: &Settings,
    bare: RobustPolicy,
    solution: &Solution,
    held_out: Option<OutOfSample>,
    halves: &Halves,
    inputs: &Inputs<'_>,
) -> RobustPolicy {
    let mut message = RobustPolicy {
        outcome: outcome_number(solution.outcome),
        method: method_number(solution.method),
        status: solution.status.name().to_owned(),
        rounds: solution.rounds as u64,
        n_draws: n_draws(halves, inputs.posterior),
        draws_used: halves.draws_used,
        ..bare
    };
    if !has_policy(solution.outcome) {
        message.reason = words::no_policy(solution.outcome);
        return message;
    }
    message.reason = words::claim(settings, solution, held_out.as_ref());
    message.objective_value = solution.objective;
    message.gap = solution.gap();
    message.expected_return = solution.expected_return;
    message.value_at_risk = solution.value_at_risk;
    message.conditional_value_at_risk = solution.conditional_value_at_risk;
    if let Some(fresh) = held_out {
        message.held_out = fresh.n as u64;
        message.held_out_mean = fresh.mean;
        message.held_out_cvar = fresh.conditional_value_at_risk;
        [message.held_out_cvar_low, message.held_out_cvar_high] = fresh.interval;
        message.confidence = settings.confidence;
    }
    message.action_probabilities = table(&solution.policy, inputs);
    let rows = solution.occupancy.chunks_exact(inputs.world.mdp.n_actions());
    message.visits = rows.map(|row| row.iter().sum::<f64>() as f32).collect();
    message.feature_counts = solution.feature_counts.clone();
    message
}

/// The set to be judged: the policy and the best one for the mean reward. Its number grows with the revision and with the
/// preference, and is the same however often they are said.
fn set(
    inputs: &Inputs<'_>,
    bare: &RobustPolicy,
    halves: &Halves,
    problem: &Problem<'_>,
    solution: &Solution,
) -> Result<Option<PolicySet>, MissingInput> {
    if solution.outcome != robust::Outcome::Optimal {
        return Ok(None);
    }
    let mean = optimal_policy(&inputs.world.mdp, problem.mean_weights())?;
    let policies = vec![
        to_judge(ROBUST_POLICY, &solution.policy, &solution.feature_counts, inputs),
        to_judge("mean", &mean.policy, &mean.feature_counts, inputs),
    ];
    Ok(Some(PolicySet {
        header: bare.header.clone(),
        id: robust_set_id(bare.revision, bare.preference_number),
        number: bare.revision.saturating_add(bare.preference_number).saturating_add(1),
        world_id: inputs.world.id.clone(),
        draws_used: halves.draws_used,
        policies,
    }))
}

fn to_judge(id: &str, policy: &Policy, feature_counts: &[f64], inputs: &Inputs<'_>) -> PolicyToJudge {
    let bare = PolicyToJudge { id: id.to_owned(), ..PolicyToJudge::default() };
    if inputs.world.mdp.n_states() * inputs.world.mdp.n_actions() > MAX_TABLE {
        let feature_counts = feature_counts.to_vec();
        return PolicyToJudge { form: PolicyToJudge::FEATURE_COUNTS, feature_counts, ..bare };
    }
    PolicyToJudge { form: PolicyToJudge::TABULAR, action_probabilities: table(policy, inputs), ..bare }
}

fn point(solution: &Solution) -> FrontierPoint {
    let known = |value: f64| if has_policy(solution.outcome) { value } else { f64::NAN };
    FrontierPoint {
        lambda: solution.lambda,
        outcome: outcome_number(solution.outcome),
        gap: known(solution.gap()),
        expected_return: known(solution.expected_return),
        value_at_risk: known(solution.value_at_risk),
        conditional_value_at_risk: known(solution.conditional_value_at_risk),
    }
}

/// π(a|s), S × A.
fn table(policy: &Policy, inputs: &Inputs<'_>) -> Vec<f64> {
    let (n_states, n_actions) = (inputs.world.mdp.n_states(), inputs.world.mdp.n_actions());
    let cells = (0..n_states).flat_map(|s| (0..n_actions).map(move |a| (s, a)));
    cells.map(|(s, a)| policy.probability(n_actions, s, a)).collect()
}

fn n_draws(halves: &Halves, posterior: &Posterior) -> u64 {
    (halves.chosen_by.len() / posterior.feature_names.len().max(1)) as u64
}

fn count(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}
