//! `apprentice evaluate`: policies judged under the draws of a posterior.

mod arguments;
mod expert;
mod judge;
mod policies;
mod report;
mod standing;
mod worst;

pub use arguments::Arguments;

use std::process::ExitCode;

use judge::Evaluation;

use crate::OfflineError;
use crate::answer::{Answer, finish, tell};
use crate::clock::Stopwatch;
use crate::files::write_table;

/// Runs the command.
pub fn run(arguments: &Arguments) -> ExitCode {
    let stopwatch = Stopwatch::start();
    finish("evaluate", arguments.json, answer(arguments, &stopwatch))
}

fn answer(arguments: &Arguments, stopwatch: &Stopwatch) -> Result<Answer, OfflineError> {
    let evaluation = Evaluation::of(arguments)?;
    for warning in &evaluation.warnings {
        tell(&format!("apprentice evaluate: warning: {warning}"));
    }
    let (seconds, cpu_seconds) = (stopwatch.seconds(), Stopwatch::cpu_seconds());
    if let Some(path) = &arguments.losses {
        let losses: Vec<&[f64]> = evaluation.policies.iter().filter_map(|policy| policy.losses.as_deref()).collect();
        let rows: Vec<f64> =
            (0..evaluation.n_draws).flat_map(|draw| losses.iter().map(move |losses| losses[draw])).collect();
        write_table(path, &rows, losses.len())?;
    }
    Ok(Answer {
        json: report::json(&evaluation, seconds, cpu_seconds),
        text: report::text(&evaluation, seconds, arguments.losses.as_deref()),
    })
}
