//! What was found as one JSON object.

use mdp::Policy;
use robust::{OutOfSample, Solution};
use serde_json::{Map, Value, json};

use super::Arguments;
use super::compare::Baseline;
use super::found::Found;
use super::inputs::Inputs;
use super::words;

/// One object.
pub(super) fn json(arguments: &Arguments, inputs: &Inputs, found: &Found, seconds: f64, cpu_seconds: f64) -> Value {
    let solution = &found.solution;
    let n_actions = inputs.mdp.n_actions();
    let frontier = arguments.frontier.then(|| found.frontier.iter().map(point).collect::<Vec<_>>());
    let baselines =
        found.baselines.as_ref().map(|all| all.iter().map(|one| baseline(one, n_actions)).collect::<Vec<_>>());
    let fresh = found.fresh.as_ref().map(|(fresh, n_chains)| out_of_sample(fresh, *n_chains, arguments.confidence));
    let mut object = Map::new();
    for (key, value) in [
        ("outcome", json!(solution.outcome.name())),
        ("reason", json!(words::reason(solution))),
        ("words", json!(words::risk(arguments, solution, &found.neutral))),
        ("kind", json!(super::text::kind(arguments))),
        ("alpha", json!(solution.alpha)),
        ("lambda", json!(solution.lambda)),
        ("objective", json!(solution.objective)),
        ("upper_bound", json!(solution.upper_bound)),
        ("gap", json!(solution.gap())),
        ("unit", json!(solution.unit)),
        ("tolerance", json!(arguments.tolerance)),
        ("expected_return", json!(solution.expected_return)),
        ("var", json!(solution.value_at_risk)),
        ("cvar", json!(solution.conditional_value_at_risk)),
        ("policy", rows(&probabilities(&solution.policy, n_actions), n_actions)),
        ("occupancy", rows(&solution.occupancy, n_actions)),
        ("feature_counts", json!(solution.feature_counts)),
        ("unvisited", json!(solution.unvisited)),
        ("unreachable", json!(found.unreachable)),
        ("method", json!(solution.method.name())),
        ("status", json!(solution.status.name())),
        ("rounds", json!(solution.rounds)),
        ("solver_iterations", json!(solution.solver_iterations)),
        (
            "checks",
            json!({
                "hold": solution.checks.hold(),
                "flow_residual": solution.checks.flow_residual,
                "smallest_visit": solution.checks.smallest_visit,
                "objective_difference": solution.checks.objective_difference,
            }),
        ),
        ("frontier", json!(frontier)),
        ("baselines", json!(baselines)),
        ("out_of_sample", json!(fresh)),
        ("expert_feature_counts", json!(inputs.expert)),
        ("n_draws", json!(inputs.draws.n_rows())),
        ("n_distinct_draws", json!(found.n_distinct)),
        ("n_states", json!(inputs.mdp.n_states())),
        ("n_actions", json!(n_actions)),
        ("n_features", json!(inputs.mdp.n_features())),
        ("seed", json!(arguments.seed)),
        ("warnings", json!(found.warnings)),
        ("seconds", json!(seconds)),
        ("cpu_seconds", json!(cpu_seconds)),
        ("version", json!(env!("CARGO_PKG_VERSION"))),
    ] {
        object.insert(key.to_owned(), value);
    }
    Value::Object(object)
}

fn rows(values: &[f64], n_actions: usize) -> Value {
    json!(values.chunks(n_actions).collect::<Vec<_>>())
}

/// π(a|s): S × A.
pub(super) fn probabilities(policy: &Policy, n_actions: usize) -> Vec<f64> {
    match policy {
        Policy::Stochastic(probabilities) => probabilities.clone(),
        Policy::Deterministic(actions) => {
            let mut probabilities = vec![0.0; actions.len() * n_actions];
            for (row, &action) in probabilities.chunks_mut(n_actions).zip(actions) {
                row[action] = 1.0;
            }
            probabilities
        }
    }
}

fn point(solution: &Solution) -> Value {
    json!({
        "lambda": solution.lambda,
        "outcome": solution.outcome.name(),
        "objective": solution.objective,
        "gap": solution.gap(),
        "expected_return": solution.expected_return,
        "var": solution.value_at_risk,
        "cvar": solution.conditional_value_at_risk,
        "feature_counts": solution.feature_counts,
        "method": solution.method.name(),
        "rounds": solution.rounds,
    })
}

fn baseline(baseline: &Baseline, n_actions: usize) -> Value {
    json!({
        "name": baseline.name,
        "outcome": baseline.outcome,
        "objective": baseline.risk.objective,
        "expected_return": baseline.risk.expected_return,
        "var": baseline.risk.value_at_risk,
        "cvar": baseline.risk.conditional_value_at_risk,
        "feature_counts": baseline.feature_counts,
        "policy": rows(&probabilities(&baseline.policy, n_actions), n_actions),
    })
}

fn out_of_sample(fresh: &OutOfSample, n_chains: usize, confidence: f64) -> Value {
    json!({
        "n": fresh.n,
        "n_chains": n_chains,
        "ess": fresh.effective_size,
        "mean": fresh.mean,
        "var": fresh.value_at_risk,
        "cvar": fresh.conditional_value_at_risk,
        "standard_error": fresh.standard_error,
        "interval": fresh.interval,
        "confidence": confidence,
    })
}
