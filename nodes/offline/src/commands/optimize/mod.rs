//! `apprentice optimize`: a policy that is robust to what is not known of the reward.

mod arguments;
mod compare;
mod found;
mod inputs;
mod pictures;
mod report;
mod text;
mod words;

pub use arguments::Arguments;

use std::process::ExitCode;

use found::Found;
use inputs::Inputs;

use crate::OfflineError;
use crate::answer::{Answer, finish, tell};
use crate::clock::Stopwatch;
use crate::files::write_text;

/// Runs the command.
pub fn run(arguments: &Arguments) -> ExitCode {
    let stopwatch = Stopwatch::start();
    finish("optimize", arguments.json, answer(arguments, &stopwatch))
}

fn answer(arguments: &Arguments, stopwatch: &Stopwatch) -> Result<Answer, OfflineError> {
    let inputs = Inputs::read(arguments)?;
    if let Some(path) = &arguments.policy_svg {
        // Known to be impossible before the work rather than after it.
        pictures::directions(&inputs.mdp, path)?;
    }
    let found = Found::of(arguments, &inputs)?;
    for warning in &found.warnings {
        tell(&format!("apprentice optimize: warning: {warning}"));
    }
    let (seconds, cpu_seconds) = (stopwatch.seconds(), Stopwatch::cpu_seconds());
    let drawn = [
        (&arguments.svg, pictures::frontier as pictures::Draw),
        (&arguments.policy_svg, pictures::policies as pictures::Draw),
    ];
    for (path, draw) in drawn {
        if let Some(path) = path {
            write_text(path, &draw(arguments, &inputs, &found, path)?)?;
        }
    }
    Ok(Answer {
        json: report::json(arguments, &inputs, &found, seconds, cpu_seconds),
        text: text::text(arguments, &inputs, &found, seconds),
    })
}
