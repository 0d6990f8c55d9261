//! What an optimisation starts from, read and checked.

use std::path::Path;

use mdp::Mdp;
use robust::{RobustError, expert_feature_counts};

use super::Arguments;
use super::arguments::ObjectiveName;
use crate::OfflineError;
use crate::evidence::flag;
use crate::files::{Table, Wanted, read_map, read_mdp, read_trajectories};
use crate::judgement::n_chains;
use crate::sampling::available_threads;

/// Largest magnitude of a weight or a feature count: beyond it returns may overflow.
const LARGEST: f64 = 1e100;
/// Confidence that the default number of chains is judged by.
const DELTA: f64 = 0.05;
/// Fewest and most points of a frontier.
const POINTS: std::ops::RangeInclusive<usize> = 2..=1001;

/// The content of all files that were named.
#[derive(Debug)]
pub(super) struct Inputs {
    pub(super) mdp: Mdp,
    pub(super) draws: Table,
    /// Probabilities of the draws.
    pub(super) weights: Option<Vec<f64>>,
    /// Feature counts of the expert.
    pub(super) expert: Option<Vec<f64>>,
    /// The most probable weights.
    pub(super) map: Option<Vec<f64>>,
    /// Other draws, and how many chains they are.
    pub(super) out_of_sample: Option<(Table, usize)>,
    pub(super) threads: usize,
    pub(super) warnings: Vec<String>,
}

impl Inputs {
    /// Reads everything that the arguments name.
    pub(super) fn read(arguments: &Arguments) -> Result<Self, OfflineError> {
        check_levels(arguments)?;
        if arguments.frontier && !POINTS.contains(&arguments.points) {
            let (got, least, most) = (arguments.points, POINTS.start(), POINTS.end());
            return Err(flag("--points", format!("got {got}, expected {least} to {most}")));
        }
        let threads = arguments.threads.unwrap_or_else(available_threads);
        if !posterior::THREADS_RANGE.contains(&threads) {
            let most = posterior::THREADS_RANGE.end();
            return Err(flag("--threads", format!("got {threads}, expected 1 to {most}")));
        }
        let mdp = read_mdp(&arguments.mdp)?;
        let k = mdp.n_features();
        let draws = table(&arguments.draws, "weight", k)?;
        let mut warnings: Vec<String> = draws.suspicion().into_iter().collect();
        let weights = match &arguments.weights {
            Some(path) => Some(read_weights(path, &draws)?),
            None => None,
        };
        let expert = read_expert(arguments, &mdp)?;
        if arguments.objective == ObjectiveName::Regret && expert.is_none() {
            return Err(flag("--objective regret", "got no expert, expected --expert-features or --demonstrations"));
        }
        let map = match &arguments.map {
            Some(path) if path.extension().is_some_and(|end| end == "json") => Some(read_map(path, k)?),
            Some(path) => Some(one_row(table(path, "weight", k)?, "one reward")?),
            None => None,
        };
        let out_of_sample = match &arguments.out_of_sample {
            Some(path) => {
                let fresh = table(path, "weight", k)?;
                warnings.extend(fresh.suspicion());
                let alpha = arguments.alpha.max(f64::MIN_POSITIVE);
                let n_chains = n_chains(&fresh.file, fresh.n_rows(), arguments.chains, alpha, DELTA)?;
                Some((fresh, n_chains))
            }
            None => None,
        };
        Ok(Self { mdp, draws, weights, expert, map, out_of_sample, threads, warnings })
    }
}

/// Refuses what would be refused after the work otherwise.
fn check_levels(arguments: &Arguments) -> Result<(), OfflineError> {
    let Arguments { alpha, lambda, confidence, .. } = *arguments;
    for (name, got, holds, expected) in [
        ("alpha", alpha, (0.0..1.0).contains(&alpha), "at least 0 and less than 1"),
        ("lambda", lambda, (0.0..=1.0).contains(&lambda), "from 0 to 1"),
        ("confidence", confidence, confidence > 0.0 && confidence < 1.0, "strictly between 0 and 1"),
    ] {
        if !holds {
            return Err(RobustError::Range { name, got, expected }.into());
        }
    }
    Ok(())
}

fn table(path: &Path, name: &str, n_features: usize) -> Result<Table, OfflineError> {
    let columns = Some((n_features, "one for each feature of --mdp"));
    Table::read(path, &Wanted { name, columns, largest: LARGEST })
}

fn one_row(table: Table, other: &str) -> Result<Vec<f64>, OfflineError> {
    if table.n_rows() != 1 {
        let (what, got, expected, other) = ("rows", table.n_rows(), 1, other.to_owned());
        return Err(OfflineError::Widths { file: table.file, what, got, other, expected });
    }
    Ok(table.values)
}

/// One weight for each draw; they sum to 1.
fn read_weights(path: &Path, draws: &Table) -> Result<Vec<f64>, OfflineError> {
    let wanted = Wanted { name: "weight", columns: Some((1, "one weight a line")), largest: LARGEST };
    let table = Table::read(path, &wanted)?;
    if table.n_rows() != draws.n_rows() {
        let (what, got, expected) = ("weights", table.n_rows(), draws.n_rows());
        return Err(OfflineError::Widths { file: table.file, what, got, other: draws.file.clone(), expected });
    }
    if let Some(row) = table.values.iter().position(|weight| *weight < 0.0) {
        let problem = format!("got {} as weight {row} of {}, expected 0 or more", table.values[row], table.file);
        return Err(flag("--weights", problem));
    }
    let total: f64 = table.values.iter().sum();
    if total.is_nan() || total <= 0.0 {
        let problem = format!("got weights in {} that sum to {total}, expected a positive sum", table.file);
        return Err(flag("--weights", problem));
    }
    Ok(table.values.iter().map(|weight| weight / total).collect())
}

fn read_expert(arguments: &Arguments, mdp: &Mdp) -> Result<Option<Vec<f64>>, OfflineError> {
    if let Some(path) = &arguments.demonstrations {
        let trajectories = read_trajectories(path, mdp)?;
        return Ok(Some(expert_feature_counts(mdp, &trajectories, mdp.gamma())?));
    }
    match &arguments.expert_features {
        Some(path) => Ok(Some(one_row(table(path, "feature count", mdp.n_features())?, "one expert")?)),
        None => Ok(None),
    }
}
