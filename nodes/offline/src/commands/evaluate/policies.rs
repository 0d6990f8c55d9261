//! The policies to judge, in any of their three forms, as expected feature counts.

use std::path::{Path, PathBuf};

use mdp::{Mdp, feature_counts};

use crate::OfflineError;
use crate::files::{Table, Wanted, read_policy};

/// Largest magnitude of a feature count: beyond it returns may overflow.
const MAX_COUNT: f64 = 1e100;

/// How a policy was given.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Form {
    /// What it does in each state of the decision process.
    Tabular,
    /// What it is expected to collect.
    FeatureCounts,
    /// What it collected when it was run: a row of features for each time.
    Rollouts(Table),
}

/// A policy to judge.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Judged {
    /// Name of its file, with the row where the file holds several.
    pub(super) name: String,
    pub(super) form: Form,
    /// Expected feature counts Φ(π), one for each feature.
    pub(super) counts: Vec<f64>,
}

impl Form {
    pub(super) fn name(&self) -> &'static str {
        match self {
            Self::Tabular => "tabular",
            Self::FeatureCounts => "feature_counts",
            Self::Rollouts(_) => "rollouts",
        }
    }
}

impl Judged {
    /// Standard error of the mean return of its rollouts under `weights`; `None` where the counts are exact, or one
    /// rollout says nothing about its spread.
    pub(super) fn return_standard_error(&self, weights: &[f64]) -> Option<f64> {
        let Form::Rollouts(rollouts) = &self.form else { return None };
        let n = rollouts.n_rows() as f64;
        let returns: Vec<f64> = (0..rollouts.n_rows()).map(|row| dot(rollouts.row(row), weights)).collect();
        let mean = returns.iter().sum::<f64>() / n;
        let variance = returns.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0);
        (n > 1.0).then(|| libm::sqrt(variance / n))
    }

    /// Rollouts behind the counts; 0 when those are exact.
    pub(super) fn n_rollouts(&self) -> usize {
        match &self.form {
            Form::Rollouts(rollouts) => rollouts.n_rows(),
            _ => 0,
        }
    }
}

/// ⟨a, b⟩.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// A policy for each file, in the order given.
///
/// # Errors
/// What cannot be read or is no policy of the process.
pub(super) fn of_policies(files: &[PathBuf], mdp: &Mdp) -> Result<Vec<Judged>, OfflineError> {
    files
        .iter()
        .map(|file| {
            let policy = read_policy(file, mdp)?;
            let wrong = |error| OfflineError::Mdp { file: file.display().to_string(), error };
            Ok(Judged { name: stem(file), form: Form::Tabular, counts: feature_counts(mdp, &policy).map_err(wrong)? })
        })
        .collect()
}

/// A policy for each row of each file.
///
/// # Errors
/// What is no table, or of another number of features.
pub(super) fn of_feature_counts(files: &[PathBuf], n_features: usize) -> Result<Vec<Judged>, OfflineError> {
    let mut policies = Vec::new();
    for file in files {
        let table = read_counts(file, "feature count", n_features)?;
        for row in 0..table.n_rows() {
            let name = if table.n_rows() == 1 { stem(file) } else { format!("{}:{row}", stem(file)) };
            policies.push(Judged { name, form: Form::FeatureCounts, counts: table.row(row).to_vec() });
        }
    }
    Ok(policies)
}

/// A policy for each file of rollouts: what it collects on average (dissertation eq. E.4).
///
/// # Errors
/// What is no table, or of another number of features.
pub(super) fn of_rollouts(files: &[PathBuf], n_features: usize) -> Result<Vec<Judged>, OfflineError> {
    files
        .iter()
        .map(|file| {
            let table = read_counts(file, "feature", n_features)?;
            let n = table.n_rows() as f64;
            let mean = |feature| table.values.iter().skip(feature).step_by(n_features).sum::<f64>() / n;
            let counts = (0..n_features).map(mean).collect();
            Ok(Judged { name: stem(file), form: Form::Rollouts(table), counts })
        })
        .collect()
}

/// A table of as many columns as there are weights.
///
/// # Errors
/// What is no such table.
pub(super) fn read_counts(file: &Path, name: &str, n_features: usize) -> Result<Table, OfflineError> {
    let columns = Some((n_features, "one for each weight of --draws"));
    Table::read(file, &Wanted { name, columns, largest: MAX_COUNT })
}

/// Name of a file without folder and extension.
fn stem(file: &Path) -> String {
    file.file_stem().unwrap_or(file.as_os_str()).to_string_lossy().into_owned()
}
