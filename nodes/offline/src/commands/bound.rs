//! `apprentice bound`: a high-confidence bound on a risk measure of losses.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, ValueEnum};
use diagnostics::{Series, Smoothed, pareto_smooth_correlated};
use risk::{Measure, Tail};
use serde_json::json;

use crate::OfflineError;
use crate::answer::{Answer, aligned, finish, level, short, tell};
use crate::evidence::flag;
use crate::files::{Table, Wanted};
use crate::judgement::{Draws, Judgement, LevelArguments, Levels, TailName, n_chains};

/// Bounds a risk measure of a loss, or of a return, of which a file holds posterior draws.
///
/// The bound on the value at risk is an order statistic, chosen by how many independent draws the chains are worth, so that
/// it holds with confidence 1 - delta. Answers `bound`, `not_enough_samples`, `not_mixed` (R-hat above 1.01),
/// `unreliable_weights` or `unbounded`, always with a reason. Draws must be neither thinned nor made unique.
///
/// Exit code 0: answered, also where there is no bound; 2: bad input, named with file and line.
#[derive(Debug, Parser)]
#[command(
    name = "apprentice bound",
    after_help = "\
Examples:
  apprentice bound --losses config/examples/losses.csv --alpha 0.95 --delta 0.05
  apprentice bound --losses config/examples/losses.csv --measure cvar --worst 2 --json

CSV: one number a line, header line optional. nodes/offline/README.md describes every file."
)]
pub struct Arguments {
    /// Draws of the loss (of the return with --tail lower), one a line; chains of equal length, one after another
    #[arg(long, value_name = "CSV")]
    losses: PathBuf,
    /// Column of --losses that counts, from 0, where it has several
    #[arg(long, value_name = "N")]
    column: Option<usize>,
    /// Chains in the file [default: 4]
    #[arg(long, value_name = "M")]
    chains: Option<usize>,
    /// Importance weights of the draws, one a line, not negative
    #[arg(long, value_name = "CSV", conflicts_with = "log_weights")]
    weights: Option<PathBuf>,
    /// Natural logarithms of the weights, one a line
    #[arg(long, value_name = "CSV")]
    log_weights: Option<PathBuf>,
    #[command(flatten)]
    levels: LevelArguments,
    /// Which end is bad
    #[arg(long, value_name = "TAIL", default_value = "upper", help_heading = "Claim")]
    tail: TailName,
    /// What is bounded
    #[arg(long, value_name = "MEASURE", default_value = "var", help_heading = "Claim")]
    measure: MeasureName,
    /// Largest loss, or smallest return, that there can be; needed for every measure but var
    #[arg(long, alias = "support-max", value_name = "X", allow_negative_numbers = true, help_heading = "Claim")]
    worst: Option<f64>,
    /// Risk aversion of the entropic risk, above 0, in one over the unit of the losses
    #[arg(long, value_name = "X", default_value_t = 1.0, help_heading = "Claim")]
    aversion: f64,
    /// Weight of the semideviation, from 0 to 1
    #[arg(long, value_name = "X", default_value_t = 1.0, help_heading = "Claim")]
    coefficient: f64,
    /// Taken, as every command does; nothing here is random
    #[arg(long, value_name = "SEED", help_heading = "Answer")]
    seed: Option<u64>,
    /// One JSON object on standard output
    #[arg(long, help_heading = "Answer")]
    json: bool,
}

/// A risk measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum MeasureName {
    /// Value at risk: the alpha-quantile of the loss, the (1 - alpha)-quantile of the return
    Var,
    /// Conditional value at risk: the mean of the worst share 1 - alpha
    Cvar,
    /// (1/aversion) ln E exp(aversion loss)
    Entropic,
    /// Mean plus coefficient times the mean excess over it
    Semideviation,
    /// The mean
    Mean,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> ExitCode {
    finish("bound", arguments.json, answer(arguments))
}

fn answer(arguments: &Arguments) -> Result<Answer, OfflineError> {
    let levels = arguments.levels.check()?;
    let (file, losses) = read_losses(arguments)?;
    let n_chains = n_chains(&file, losses.len(), arguments.chains, levels.alpha, levels.delta_spent)?;
    let weights = read_weights(arguments, &losses, n_chains)?;
    let tail = arguments.tail.tail();
    let measure = match arguments.measure {
        MeasureName::Var => Measure::ValueAtRisk { alpha: levels.alpha },
        MeasureName::Cvar => Measure::ConditionalValueAtRisk { alpha: levels.alpha },
        MeasureName::Entropic => Measure::Entropic { aversion: arguments.aversion },
        MeasureName::Semideviation => Measure::Semideviation { coefficient: arguments.coefficient },
        MeasureName::Mean => Measure::Mean,
    };
    let draws = Draws { values: &losses, n_chains, weights: weights.as_ref(), tail };
    let judgement = draws.judge(measure, levels.alpha, levels.delta_spent, arguments.worst)?;
    let (tail_word, measure_word) = (word(arguments.tail), word(arguments.measure));
    let mut json = judgement.json();
    for (key, value) in [
        ("alpha", json!(levels.alpha)),
        ("delta", json!(levels.delta)),
        ("delta_spent", json!(levels.delta_spent)),
        ("look", json!(levels.look)),
        ("n_chains", json!(n_chains)),
        ("tail", json!(tail_word)),
        ("measure", json!(measure_word)),
        ("worst", json!(arguments.worst)),
        ("version", json!(env!("CARGO_PKG_VERSION"))),
    ] {
        json[key] = value;
    }
    Ok(Answer { json, text: text(&judgement, &levels, n_chains, measure, tail) })
}

/// Name of the file and the column that counts.
fn read_losses(arguments: &Arguments) -> Result<(String, Vec<f64>), OfflineError> {
    let columns = arguments.column.is_none().then_some((1, "one number a line; --column chooses among several"));
    let table = Table::read(&arguments.losses, &Wanted { name: "loss", columns, largest: 1e300 })?;
    if let Some(suspicion) = table.suspicion() {
        tell(&format!("apprentice bound: warning: {suspicion}"));
    }
    let column = arguments.column.unwrap_or(0);
    if column >= table.n_columns {
        let problem = format!("got {column}, expected 0 to {}, the columns of {}", table.n_columns - 1, table.file);
        return Err(flag("--column", problem));
    }
    let values = table.values.iter().skip(column).step_by(table.n_columns).copied().collect();
    Ok((table.file, values))
}

/// The weights, smoothed as draws that are worth as many independent ones as the losses are.
fn read_weights(arguments: &Arguments, losses: &[f64], n_chains: usize) -> Result<Option<Smoothed>, OfflineError> {
    let (path, are_logarithms) = match (&arguments.weights, &arguments.log_weights) {
        (Some(path), _) => (path, false),
        (None, Some(path)) => (path, true),
        (None, None) => return Ok(None),
    };
    let wanted = Wanted { name: "weight", columns: Some((1, "one weight a line")), largest: f64::MAX };
    let table = Table::read(path, &wanted)?;
    if table.n_rows() != losses.len() {
        let other = arguments.losses.display().to_string();
        let (what, got, expected) = ("weights", table.n_rows(), losses.len());
        return Err(OfflineError::Widths { file: table.file, what, got, other, expected });
    }
    let log_weights: Vec<f64> = if are_logarithms {
        table.values
    } else {
        if let Some(row) = table.values.iter().position(|weight| *weight < 0.0) {
            let problem = format!("got {} as weight {row} of {}, expected 0 or more", table.values[row], table.file);
            return Err(flag("--weights", problem));
        }
        table.values.iter().map(|weight| libm::log(*weight)).collect()
    };
    let n = losses.len() as f64;
    let efficiency = Series::new(losses, n_chains).map_or(1.0, |series| (series.ess_bulk() / n).clamp(1.0 / n, 1.0));
    Ok(Some(pareto_smooth_correlated(&log_weights, efficiency)?))
}

fn text(judgement: &Judgement, levels: &Levels, n_chains: usize, measure: Measure, tail: Tail) -> String {
    let (side, what) = match tail {
        Tail::Upper => ("Upper", "loss"),
        Tail::Lower => ("Lower", "return"),
    };
    let name = match measure {
        Measure::ValueAtRisk { alpha } => {
            format!("{}-quantile of the {what}", level(if tail == Tail::Upper { alpha } else { 1.0 - alpha }))
        }
        Measure::ConditionalValueAtRisk { alpha } => format!("mean of the worst {} of the {what}", level(1.0 - alpha)),
        Measure::Entropic { aversion } => format!("entropic risk of the {what}, aversion {aversion}"),
        Measure::Semideviation { coefficient } => {
            format!("mean-semideviation of the {what}, coefficient {coefficient}")
        }
        Measure::Mean => format!("mean {what}"),
    };
    let bound = judgement.bound.map_or_else(|| "none".to_owned(), short);
    let unknown = || "unknown".to_owned();
    let figure = |name: &str, value: String| vec![name.to_owned(), value];
    let mut rows = vec![
        figure("outcome", judgement.outcome.to_owned()),
        figure("confidence", level(1.0 - levels.delta_spent)),
        figure("point estimate", short(judgement.point_estimate)),
        figure("mean", short(judgement.mean)),
        figure(&format!("mean of the worst {}", level(1.0 - levels.alpha)), short(judgement.cvar)),
        figure("draws", format!("{} in {n_chains} chains", judgement.n)),
        figure(
            "effective draws, of those needed",
            match judgement.ess {
                Some(ess) => format!("{ess:.0} of {}", judgement.needed),
                None => unknown(),
            },
        ),
        figure("R-hat", judgement.rhat.map_or_else(unknown, |rhat| format!("{rhat:.4}"))),
    ];
    rows.extend(judgement.index.map(|index| figure("order statistic, from 1", index.to_string())));
    rows.extend(judgement.weights.map(|weights| figure("Pareto k-hat of the weights", format!("{:.3}", weights.khat))));
    format!("{side} bound on the {name}: {bound}\n  {}\n\n{}", judgement.reason, aligned(&rows))
}

fn word(value: impl ValueEnum) -> String {
    value.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
}
