//! Baselines that a robust policy is held against.

use mdp::{Mdp, Policy, feature_counts};
use robust::{
    Convergence, Horizon, MaxEntropySettings, Problem, Risk, Settings, Signs, WeightNorm, climb_value_at_risk, lpal,
    max_entropy, optimal_policy,
};

use super::Arguments;
use super::inputs::Inputs;
use crate::OfflineError;
use crate::answer::tell;

/// Most changes of hill climbing.
const MAX_CHANGES: usize = 1000;
/// Most numbers that one step of hill climbing goes through: states × actions × draws.
const MAX_CLIMB: usize = 400_000_000;

/// A baseline and its risk.
#[derive(Debug)]
pub(super) struct Baseline {
    pub(super) name: &'static str,
    /// For people.
    pub(super) title: &'static str,
    /// `optimal`, `converged` …
    pub(super) outcome: &'static str,
    pub(super) policy: Policy,
    pub(super) feature_counts: Vec<f64>,
    pub(super) risk: Risk,
}

/// All that what was given allows; `warnings` tell what was left out.
pub(super) fn baselines(
    arguments: &Arguments,
    inputs: &Inputs,
    problem: &Problem<'_>,
    settings: &Settings,
    warnings: &mut Vec<String>,
) -> Result<Vec<Baseline>, OfflineError> {
    let mdp = &inputs.mdp;
    let (alpha, lambda) = (arguments.alpha, arguments.lambda);
    let judged = |name, title, outcome, policy: Policy| -> Result<Baseline, OfflineError> {
        let counts = feature_counts(mdp, &policy).map_err(robust::RobustError::from)?;
        let risk = problem.risk_of(&counts, alpha, lambda)?;
        Ok(Baseline { name, title, outcome, policy, feature_counts: counts, risk })
    };
    let mut found = vec![];
    let mean = optimal_policy(mdp, problem.mean_weights())?.policy;
    found.push(judged("mean_reward", "best for the mean reward", "optimal", mean.clone())?);
    match &inputs.map {
        Some(map) => {
            let policy = optimal_policy(mdp, map)?.policy;
            found.push(judged("map_reward", "best for the most probable reward", "optimal", policy)?);
        }
        None => {
            warnings.push("no --map: the best policy for the most probable reward is not among the baselines".into())
        }
    }
    let work = mdp.n_states().saturating_mul(mdp.n_actions()).saturating_mul(problem.n_draws());
    if work <= MAX_CLIMB {
        tell("apprentice optimize: hill climbing on the VaR");
        let climbed = climb_value_at_risk(mdp, problem, &mean, alpha, MAX_CHANGES)?;
        let outcome = if climbed.n_changes < MAX_CHANGES { "local_optimum" } else { "iteration_limit" };
        found.push(judged("var_hill_climbing", "hill climbing on the VaR", outcome, climbed.policy)?);
    } else {
        warnings.push(format!(
            "hill climbing on the VaR is left out: {work} numbers a step (states × actions × draws), at most {MAX_CLIMB}"
        ));
    }
    match &inputs.expert {
        Some(expert) => with_expert(arguments, mdp, expert, settings, &judged, &mut found)?,
        None => warnings.push(
            "no --expert-features and no --demonstrations: LPAL and Maximum Entropy IRL are not among the baselines"
                .into(),
        ),
    }
    Ok(found)
}

type Judge<'a> = &'a dyn Fn(&'static str, &'static str, &'static str, Policy) -> Result<Baseline, OfflineError>;

/// Those that imitate somebody.
fn with_expert(
    arguments: &Arguments,
    mdp: &Mdp,
    expert: &[f64],
    settings: &Settings,
    judged: Judge<'_>,
    found: &mut Vec<Baseline>,
) -> Result<(), OfflineError> {
    for (name, title, signs) in [
        ("lpal", "LPAL, signs unknown", Signs::Unknown),
        ("lpal_positive", "LPAL, every feature good", Signs::Positive),
    ] {
        let apprentice = lpal(mdp, expert, signs, settings)?;
        found.push(judged(name, title, apprentice.outcome.name(), apprentice.policy)?);
    }
    tell("apprentice optimize: Maximum Entropy IRL");
    let settings = MaxEntropySettings {
        rationality: arguments.maxent_beta,
        horizon: Horizon::Discounted,
        norm: WeightNorm::Unit,
        ..MaxEntropySettings::dissertation(mdp)
    };
    let learned = max_entropy(mdp, expert, &settings)?;
    let outcome = match learned.outcome {
        Convergence::Converged => "converged",
        Convergence::NotConverged => "not_converged",
    };
    found.push(judged("max_entropy", "Maximum Entropy IRL", outcome, learned.policy)?);
    Ok(())
}
