//! What an evaluation found, as JSON and as tables.

use std::path::Path;

use serde_json::{Map, Value, json};

use super::judge::{Evaluation, Found};
use crate::answer::{aligned, level, short};
use crate::judgement::Judgement;

/// More feature counts than this are left to the JSON.
const SHOWN: usize = 12;

/// One object. With a single policy, all that is told of it stands at the top as well.
pub(super) fn json(evaluation: &Evaluation, seconds: f64, cpu_seconds: f64) -> Value {
    let policies: Vec<Map<String, Value>> =
        evaluation.policies.iter().map(|found| of_policy(found, evaluation)).collect();
    let mut object = match policies.as_slice() {
        [only] => only.clone(),
        _ => Map::new(),
    };
    let outcome = evaluation.policies.iter().map(outcome).find(|word| *word != "bound").unwrap_or("bound");
    let ranked = in_order(evaluation).into_iter().map(|found| found.judged.name.as_str()).collect::<Vec<_>>();
    for (key, value) in [
        ("outcome", json!(outcome)),
        ("policies", json!(policies)),
        ("ranking", json!(ranked)),
        ("n_draws", json!(evaluation.n_draws)),
        ("n_chains", json!(evaluation.n_chains)),
        ("n_features", json!(evaluation.n_features)),
        ("alpha", json!(evaluation.levels.alpha)),
        ("delta", json!(evaluation.levels.delta)),
        ("look", json!(evaluation.levels.look)),
        ("delta_spent", json!(evaluation.levels.delta_spent)),
        ("delta_each", json!(evaluation.delta_each)),
        ("expert_feature_counts", json!(evaluation.expert.as_ref().map(|expert| &expert.counts))),
        ("n_demonstrations", json!(evaluation.n_demonstrations)),
        ("hoeffding_bound", json!(evaluation.hoeffding)),
        ("warnings", json!(evaluation.warnings)),
        ("seconds", json!(seconds)),
        ("cpu_seconds", json!(cpu_seconds)),
        ("version", json!(env!("CARGO_PKG_VERSION"))),
    ] {
        object.insert(key.to_owned(), value);
    }
    Value::Object(object)
}

fn of_policy(found: &Found, evaluation: &Evaluation) -> Map<String, Value> {
    let standing = &found.standing;
    let mut bounds = Map::new();
    bounds.insert("return_var".to_owned(), found.returns.var.json());
    bounds.insert("return_cvar".to_owned(), found.returns.cvar.json());
    if let Some(loss) = &found.loss {
        bounds.insert("loss_var".to_owned(), loss.var.json());
        bounds.insert("loss_cvar".to_owned(), loss.cvar.json());
    }
    if let (Some(normalised), Some((floor, n_floored))) = (&found.normalised_loss, evaluation.floor) {
        let mut object = normalised.json();
        object["reference"] = json!(Evaluation::reference());
        object["floor"] = json!(floor);
        object["n_floored"] = json!(n_floored);
        bounds.insert("normalised_loss_var".to_owned(), object);
    }
    let summary = |judgement: &Judgement| json!({ "mean": judgement.mean, "var": judgement.point_estimate, "cvar": judgement.cvar });
    let fields = [
        ("name", json!(found.judged.name)),
        ("form", json!(found.judged.form.name())),
        ("n_rollouts", json!(found.judged.n_rollouts())),
        ("expected_feature_counts", json!(found.judged.counts)),
        ("return", summary(&found.returns.var)),
        ("return_standard_error", json!(found.standard_error)),
        ("loss", found.loss.as_ref().map_or(Value::Null, |loss| summary(&loss.var))),
        ("losses", json!(found.losses)),
        ("bounds", Value::Object(bounds)),
        ("worst_case_feature_count_bound", json!(found.worst_case)),
        ("rank", json!(standing.rank)),
        ("rank_by_mean", json!(standing.rank_by_mean)),
        ("rank_by_loss", json!(found.rank_by_loss)),
        ("probability_best", json!(standing.probability_best)),
        ("warning", json!(standing.warning)),
    ];
    fields.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
}

/// How the bound that matters most came out: on the loss, or without a process on the return.
fn outcome(found: &Found) -> &'static str {
    found.loss.as_ref().map_or(found.returns.var.outcome, |loss| loss.var.outcome)
}

/// The policies, the best first.
fn in_order(evaluation: &Evaluation) -> Vec<&Found> {
    let mut order: Vec<&Found> = evaluation.policies.iter().collect();
    order.sort_by_key(|found| found.standing.rank);
    order
}

pub(super) fn text(evaluation: &Evaluation, seconds: f64, losses: Option<&Path>) -> String {
    let levels = &evaluation.levels;
    let with_losses = evaluation.policies.iter().any(|found| found.loss.is_some());
    let mut text = format!(
        "{} under {} draws in {} of {} weights ({seconds:.2} s)\n",
        crate::judgement::counted(evaluation.policies.len(), "policy").replace("policys", "policies"),
        evaluation.n_draws,
        crate::judgement::counted(evaluation.n_chains, "chain"),
        evaluation.n_features
    );
    for warning in &evaluation.warnings {
        text += &format!("  warning: {warning}\n");
    }
    let (percent, confidence) = (level(100.0 * levels.alpha), level(100.0 * (1.0 - levels.delta_spent)));
    text += &format!(
        "\nReturns: bounds hold for {percent} % of the rewards, all together with {confidence} % confidence\n"
    );
    text += &table(evaluation, "lower bound", |found| Some(&found.returns), true);
    if with_losses {
        text += "\nLosses: what a policy falls short of the best one, bounds as above\n";
        text += &table(evaluation, "upper bound", |found| found.loss.as_ref(), false);
        text += &normalised(evaluation);
    }
    text += &baselines(evaluation);
    if evaluation.n_features <= SHOWN {
        text += "\nExpected feature counts\n";
        let rows: Vec<Vec<String>> = in_order(evaluation)
            .into_iter()
            .map(|found| {
                std::iter::once(found.judged.name.clone())
                    .chain(found.judged.counts.iter().map(|x| short(*x)))
                    .collect()
            })
            .collect();
        text += &aligned(&rows);
    }
    if let Some(losses) = losses {
        text += &format!("\nLosses written to {}\n", losses.display());
    }
    text
}

fn table(
    evaluation: &Evaluation,
    bound: &str,
    of: impl Fn(&Found) -> Option<&super::judge::Bounds>,
    ranked: bool,
) -> String {
    let mut head = vec!["policy", "mean", "VaR", "VaR bound", "CVaR", "CVaR bound", "R-hat", "ESS", "best in"];
    if !ranked {
        head.truncate(8);
    }
    let mut rows = vec![head.into_iter().map(str::to_owned).collect::<Vec<_>>()];
    let mut reasons = String::new();
    for found in in_order(evaluation) {
        let Some(bounds) = of(found) else { continue };
        let value = |judgement: &Judgement| judgement.bound.map_or_else(|| judgement.outcome.to_owned(), short);
        let (var, cvar) = (&bounds.var, &bounds.cvar);
        let mut row = vec![
            found.judged.name.clone(),
            short(var.mean),
            short(var.point_estimate),
            value(var),
            short(var.cvar),
            value(cvar),
            var.rhat.map_or_else(|| "–".to_owned(), |rhat| format!("{rhat:.4}")),
            var.ess.map_or_else(|| "–".to_owned(), |ess| format!("{ess:.0}")),
        ];
        if ranked {
            row.push(format!("{:.1} %", 100.0 * found.standing.probability_best));
        }
        rows.push(row);
        if var.bound.is_none() {
            reasons += &format!("  {}: no {bound}: {}\n", found.judged.name, var.reason);
        }
    }
    aligned(&rows) + &reasons
}

fn normalised(evaluation: &Evaluation) -> String {
    let Some((floor, n_floored)) = evaluation.floor else { return String::new() };
    let mut text = format!(
        "\nLosses as shares of those of the {} policy (at least {}, which divides {n_floored} draws)\n",
        Evaluation::reference(),
        short(floor)
    );
    let mut rows = vec![["policy", "mean", "VaR", "VaR bound"].map(str::to_owned).to_vec()];
    for found in in_order(evaluation) {
        let Some(share) = &found.normalised_loss else { continue };
        let bound = share.bound.map_or_else(|| share.outcome.to_owned(), short);
        rows.push(vec![found.judged.name.clone(), short(share.mean), short(share.point_estimate), bound]);
    }
    text += &aligned(&rows);
    text
}

/// The bounds that need no posterior.
fn baselines(evaluation: &Evaluation) -> String {
    let mut text = String::new();
    if evaluation.expert.is_some() {
        text += "\nWorst-case feature count bounds, for rewards whose weights' sizes sum to at most 1\n";
        let rows: Vec<Vec<String>> = in_order(evaluation)
            .into_iter()
            .filter_map(|found| Some(vec![found.judged.name.clone(), short(found.worst_case?)]))
            .collect();
        text += &aligned(&rows);
    }
    if let (Some(bound), Some(n)) = (evaluation.hoeffding, evaluation.n_demonstrations) {
        let demonstrations = crate::judgement::counted(usize::try_from(n).unwrap_or(usize::MAX), "demonstration");
        text += &format!(
            "\nHoeffding bound on the loss of the projection algorithm from {demonstrations}: {}\n",
            short(bound)
        );
    }
    text
}
