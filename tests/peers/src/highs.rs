//! SciPy's HiGHS on the linear program of a robust policy, in a Python process of its own.

use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use mdp::Mdp;
use serde::{Deserialize, Serialize};

use crate::error::PeersError;

/// How the program is written down.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// With the reward of every state and action in the row of each draw, as in equation F.2.
    Dense,
    /// With the k feature counts as variables.
    Factors,
}

impl Form {
    /// As the Python program calls it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Dense => "dense",
            Self::Factors => "factors",
        }
    }
}

/// A problem.
#[derive(Debug, Clone, Copy)]
pub struct Data<'a> {
    /// The process.
    pub mdp: &'a Mdp,
    /// N × k.
    pub draws: &'a [f64],
    /// b of every draw: ψ = wᵀμ − b.
    pub offsets: &'a [f64],
    /// α.
    pub alpha: f64,
    /// λ.
    pub lambda: f64,
}

/// What the Python program reports.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Report {
    /// Of the packages.
    pub versions: std::collections::BTreeMap<String, String>,
    /// Which form.
    pub form: Form,
    /// Numbers other than 0 in the program.
    pub n_nonzeros: u64,
    /// One per method.
    pub runs: Vec<Run>,
    /// Most memory of the process.
    pub peak_mib: f64,
}

/// One method of HiGHS.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Run {
    /// `highs-ds` or `highs-ipm`.
    pub method: String,
    /// Whether it ended with an optimum.
    pub optimal: bool,
    /// What it said.
    pub message: String,
    /// The optimum.
    pub objective: Option<f64>,
    /// CPU seconds of the solver alone.
    pub cpu_seconds: f64,
    /// Seconds on the wall.
    pub seconds: f64,
}

impl Report {
    /// The faster method that ended with an optimum.
    pub fn best(&self) -> Option<&Run> {
        let ended = self.runs.iter().filter(|run| run.objective.is_some());
        ended.min_by(|a, b| a.cpu_seconds.total_cmp(&b.cpu_seconds))
    }
}

/// Solves the problem, each method within `limit` seconds.
pub fn run(data: &Data<'_>, form: Form, limit: f64) -> Result<Report, PeersError> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let python =
        std::env::var_os("APPRENTICE_PEERS_PYTHON").map_or_else(|| folder.join(".venv/bin/python"), PathBuf::from);
    let script = folder.join("python/broil_highs.py");
    let failed = |source| PeersError::File { path: std::env::temp_dir(), source };
    let mut file = tempfile::NamedTempFile::new().map_err(failed)?;
    file.write_all(json(data)?.as_bytes()).and_then(|()| file.flush()).map_err(failed)?;
    let output = Command::new(&python)
        .arg(&script)
        .arg(file.path())
        .args(["--form", form.name(), "--limit", &limit.to_string()])
        .stderr(Stdio::inherit())
        .output()
        .map_err(|source| PeersError::NoPython { python, source })?;
    if !output.status.success() {
        return Err(PeersError::Script { script, status: output.status });
    }
    parse(&output.stdout)
}

fn json(data: &Data<'_>) -> Result<String, PeersError> {
    let wrong = |source| PeersError::Json { what: "the process", source };
    let mdp: serde_json::Value = serde_json::from_str(&data.mdp.to_json()).map_err(wrong)?;
    let rows: Vec<&[f64]> = data.draws.chunks(data.mdp.n_features()).collect();
    let problem = serde_json::json!({
        "mdp": mdp, "draws": rows, "offsets": data.offsets, "alpha": data.alpha, "lambda": data.lambda,
    });
    Ok(problem.to_string())
}

fn parse(json: &[u8]) -> Result<Report, PeersError> {
    serde_json::from_slice(json).map_err(|source| PeersError::Json { what: "the report of HiGHS's run", source })
}

#[cfg(test)]
mod tests {
    use super::{Form, parse};

    /// As the Python program printed it for a tiny problem.
    const REPORT: &str = r#"{"versions": {"scipy": "1.17.1", "numpy": "2.4.6"}, "form": "dense", "n_nonzeros": 3000, "runs": [
        {"method": "highs-ds", "optimal": true, "message": "Optimization terminated successfully.", "objective": 1.5, "cpu_seconds": 0.2,
        "seconds": 0.3}, {"method": "highs-ipm", "optimal": false, "message": "Time limit reached.", "objective": null,
        "cpu_seconds": 0.1, "seconds": 0.1}], "peak_mib": 120.5}"#;

    #[test]
    fn only_a_method_that_ended_counts() {
        let report = parse(REPORT.as_bytes()).expect("a report");
        assert_eq!(report.form, Form::Dense);
        assert_eq!(report.best().map(|run| run.method.as_str()), Some("highs-ds"));
        assert!(parse(b"{}").is_err());
    }
}
