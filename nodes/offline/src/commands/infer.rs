//! `apprentice infer`: the posterior of reward weights given evidence in files.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;

use super::infer_report::{Inference, Verdict};
use crate::OfflineError;
use crate::answer::{Answer, finish, tell};
use crate::clock::Stopwatch;
use crate::evidence::{Evidence, EvidenceArguments};
use crate::files::write_table;
use crate::sampling::{Parameter, SamplingArguments, sample, summaries};

/// Draws reward weights from their posterior given evidence of any kinds: answers which of two trajectories is better,
/// rankings, attempts of a learner, demonstrated actions, actions judged good or bad. All kinds share one weight vector;
/// each has its own rationality beta, fixed or learned.
///
/// Answers `ready`, `not_mixed` (R-hat above 1.01: the chains disagree) or `not_enough_samples` (fewer than 100 effective
/// draws a chain); the draws are written in any case. Same seed, same draws, whatever the number of threads.
///
/// Exit code 0: answered; 2: bad input, named with file, line and column; 1: a file could not be written.
#[derive(Debug, Parser)]
#[command(
    name = "apprentice infer",
    after_help = "\
Examples:
  apprentice infer --features config/examples/trajectories.csv --preferences config/examples/preferences.csv
  apprentice infer --features config/examples/trajectories.csv --preferences config/examples/preferences.csv \\
    --mdp config/examples/kitchen.json --demonstrations config/examples/demonstrations.csv \\
    --beta learn --beta-actions 10 --out draws.csv --json

CSV: comma-separated, '.' decimals, header line optional. nodes/offline/README.md describes every file."
)]
pub struct Arguments {
    #[command(flatten)]
    evidence: EvidenceArguments,
    #[command(flatten)]
    sampling: SamplingArguments,
    /// File for the draws: a row per draw, a column per weight, chains one after another
    #[arg(long, value_name = "CSV", help_heading = "Answer")]
    out: Option<PathBuf>,
    /// One JSON object on standard output
    #[arg(long, help_heading = "Answer")]
    json: bool,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> ExitCode {
    let stopwatch = Stopwatch::start();
    finish("infer", arguments.json, answer(arguments, &stopwatch))
}

fn answer(arguments: &Arguments, stopwatch: &Stopwatch) -> Result<Answer, OfflineError> {
    let evidence = Evidence::read(&arguments.evidence)?;
    let cycles = evidence.cycles();
    let mut warnings = evidence.warnings(&cycles);
    for warning in &warnings {
        warn(warning);
    }
    tell(&format!("apprentice infer: sampling {} weights", evidence.n_features));
    let sample = sample(&evidence, &arguments.sampling, arguments.evidence.reproduce())?;
    let draws = &sample.draws;
    let n_terms = draws.betas.len();
    let parameters: Vec<Parameter> = (0..draws.n_features)
        .map(Parameter::Weight)
        .chain((0..n_terms).filter(|term| draws.betas[*term].is_learned()).map(Parameter::Beta))
        .collect();
    let summaries = summaries(draws, &parameters, sample.threads);
    let inference = Inference {
        evidence: &evidence,
        sample: &sample,
        summaries: &summaries,
        verdict: Verdict::of(draws),
        seed: arguments.sampling.seed(),
        sampler: arguments.sampling.sampler_name(),
    };
    if let Some(warning) = inference.no_better_than_chance() {
        warn(warning);
        warnings.push(warning.to_owned());
    }
    let (seconds, cpu_seconds) = (stopwatch.seconds(), Stopwatch::cpu_seconds());
    if let Some(out) = &arguments.out {
        write_table(out, &draws.values, draws.n_features)?;
    }
    Ok(Answer {
        json: inference.json(&cycles, &warnings, seconds, cpu_seconds),
        text: inference.text(&warnings, seconds, arguments.out.as_deref()),
    })
}

fn warn(warning: &str) {
    tell(&format!("apprentice infer: warning: {warning}"));
}
