//! `apprentice likelihood`: how probable evidence is under given weights.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use posterior::{Model, Prior};
use serde_json::json;

use crate::OfflineError;
use crate::answer::{Answer, aligned, cells, finish, tell};
use crate::evidence::{Evidence, EvidenceArguments, flag};
use crate::files::{Table, Wanted};

/// Computes the log-likelihood of evidence under reward weights, in nats: one number for each row of --weights.
///
/// Preferences by Bradley-Terry (equation 6.4): ln P(less < more) = -ln(1 + exp(-beta w.(Phi_more - Phi_less))); actions
/// by a Boltzmann-rational person (equation 3.5): ln P(a in s) = beta Q*(s, a) - ln sum_b exp(beta Q*(s, b)), with Q* of the
/// optimal policy under w, solved exactly.
///
/// Exit code 0: answered; 2: bad input, named with file, line and column; 1: the answer could not be written.
#[derive(Debug, Parser)]
#[command(
    name = "apprentice likelihood",
    after_help = "\
Examples:
  apprentice likelihood --features config/examples/trajectories.csv \\
    --preferences config/examples/preferences.csv --weights config/examples/weights.csv
  apprentice likelihood --mdp config/examples/kitchen.json --demonstrations config/examples/demonstrations.csv \\
    --weights config/examples/weights.csv --beta 10 --json

CSV: comma-separated, '.' decimals, header line optional. nodes/offline/README.md describes every file."
)]
pub struct Arguments {
    #[command(flatten)]
    evidence: EvidenceArguments,
    /// Weights to judge, one vector a row
    #[arg(long, value_name = "CSV", help_heading = "Answer")]
    weights: PathBuf,
    /// Taken, as every command does; nothing here is random
    #[arg(long, value_name = "SEED", help_heading = "Answer")]
    seed: Option<u64>,
    /// One JSON object on standard output
    #[arg(long, help_heading = "Answer")]
    json: bool,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> ExitCode {
    finish("likelihood", arguments.json, answer(arguments))
}

fn answer(arguments: &Arguments) -> Result<Answer, OfflineError> {
    let evidence = Evidence::read(&arguments.evidence)?;
    let cycles = evidence.cycles();
    let mut warnings = evidence.warnings(&cycles);
    let columns = Some((evidence.n_features, "one weight for each feature"));
    let weights = Table::read(&arguments.weights, &Wanted { name: "weight", columns, largest: 1e100 })?;
    warnings.extend(weights.suspicion());
    let model = Model {
        n_features: evidence.n_features,
        prior: Prior::L2Sphere,
        nonnegative_return: None,
        terms: evidence.terms()?,
    };
    model.check()?;
    if let Some(term) = model.terms.iter().find(|term| term.rationality.is_learned()) {
        let name = term.kind.name();
        return Err(flag(
            "--beta",
            format!("got learn for the {name}, expected a number: a likelihood is of one beta"),
        ));
    }
    for warning in &warnings {
        tell(&format!("apprentice likelihood: warning: {warning}"));
    }
    let betas = model.median_betas();
    let mut evaluator = model.evaluator();
    let values: Vec<f64> =
        (0..weights.n_rows()).map(|row| evaluator.log_likelihood(weights.row(row), &betas)).collect();
    let mut rows = vec![cells(["row", "log-likelihood (nats)"])];
    rows.extend(values.iter().enumerate().map(|(row, value)| vec![row.to_string(), format!("{value:?}")]));
    let by_kind = |of: &dyn Fn(usize) -> serde_json::Value| {
        let kinds = model.terms.iter().enumerate().map(|(i, term)| (term.kind.name().to_owned(), of(i)));
        kinds.collect::<serde_json::Map<_, _>>()
    };
    let counts = evidence.counts();
    let json = json!({
        "log_likelihood": values,
        "n_features": evidence.n_features,
        "betas": by_kind(&|i| json!(betas[i])),
        "evidence": by_kind(&|i| json!(counts[i].1)),
        "answer_model": evidence.answer_model_json(),
        "cycles": cycles,
        "warnings": warnings,
        "version": env!("CARGO_PKG_VERSION"),
    });
    Ok(Answer { json, text: aligned(&rows) })
}
