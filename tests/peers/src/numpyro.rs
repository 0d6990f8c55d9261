//! NumPyro's NUTS on the same posterior, in a Python process of its own.

use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use serde::Deserialize;

use crate::effective::Effective;
use crate::error::PeersError;

/// What the Python program reports.
#[derive(Debug, Clone, Deserialize)]
pub struct Report {
    /// Of the packages.
    pub versions: std::collections::BTreeMap<String, String>,
    /// Chains of every run.
    pub chains: usize,
    /// One per configuration.
    pub runs: Vec<NutsRun>,
}

/// NUTS in one configuration.
#[derive(Debug, Clone, Deserialize)]
pub struct NutsRun {
    /// `sequential`, one after another, or `vectorized`, all in one program.
    pub chains: String,
    /// Whether the mass matrix is dense.
    pub dense_mass: bool,
    /// Not counted against it.
    pub compile_seconds: f64,
    /// CPU seconds of the warm-up.
    pub warmup_seconds: f64,
    /// CPU seconds of all draws.
    pub sampling_seconds: f64,
    /// CPU seconds of the first draws, which with the warm-up make one ordinary job.
    pub job_sampling_seconds: f64,
    /// All draws.
    pub n_draws: usize,
    /// Mean length of a trajectory.
    pub leapfrogs_per_draw: f64,
    /// ArviZ on all draws.
    pub all: Effective,
    /// ArviZ on those of the job.
    pub job: Effective,
    /// Posterior mean of the log-likelihood.
    pub log_likelihood_mean: f64,
    /// Its standard error.
    pub log_likelihood_mcse: f64,
    /// Log-likelihoods of the job's draws, chains one after another.
    pub job_log_likelihood: Vec<f64>,
}

impl NutsRun {
    /// Smallest effective samples per CPU second, warm-up left out.
    pub fn rate(&self) -> f64 {
        self.all.ess_bulk_min / self.sampling_seconds
    }

    /// The same of one job with its warm-up.
    pub fn job_rate(&self) -> f64 {
        self.job.ess_bulk_min / (self.warmup_seconds + self.job_sampling_seconds)
    }

    /// As printed.
    pub fn name(&self) -> String {
        format!("NUTS, {} chains, {} mass", self.chains, if self.dense_mass { "dense" } else { "diagonal" })
    }
}

/// Runs NUTS on `data` for about `seconds` CPU seconds per configuration.
pub fn run(data: &str, seconds: f64, seed: u64) -> Result<Report, PeersError> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let python =
        std::env::var_os("APPRENTICE_PEERS_PYTHON").map_or_else(|| folder.join(".venv/bin/python"), PathBuf::from);
    let script = folder.join("python/preferences_numpyro.py");
    let failed = |source| PeersError::File { path: std::env::temp_dir(), source };
    let mut file = tempfile::NamedTempFile::new().map_err(failed)?;
    file.write_all(data.as_bytes()).and_then(|()| file.flush()).map_err(failed)?;
    let output = Command::new(&python)
        .arg(&script)
        .arg(file.path())
        .args(["--seconds", &seconds.to_string(), "--seed", &seed.to_string()])
        // They make OpenBLAS slow, which the other side should not suffer from.
        .env_remove("OPENBLAS_CORETYPE")
        .env_remove("OPENBLAS_L2_SIZE")
        .stderr(Stdio::inherit())
        .output()
        .map_err(|source| PeersError::NoPython { python, source })?;
    if !output.status.success() {
        return Err(PeersError::Script { script, status: output.status });
    }
    parse(&output.stdout)
}

fn parse(json: &[u8]) -> Result<Report, PeersError> {
    serde_json::from_slice(json).map_err(|source| PeersError::Json { what: "the report of NumPyro's run", source })
}

#[cfg(test)]
mod tests {
    use super::parse;

    /// As the Python program printed it for a tiny run, its chains shortened.
    const REPORT: &str = r#"{"versions": {"numpyro": "0.22.0", "jax": "0.10.2", "arviz": "0.23.4"}, "chains": 4, "warmup": 500, "runs":
        [{"chains": "sequential", "dense_mass": false, "compile_seconds": 7.9, "warmup_seconds": 0.25, "sampling_seconds": 2.0,
        "job_sampling_seconds": 0.25, "n_draws": 14000, "n_job_draws": 4000, "leapfrogs_per_draw": 13.75,
        "all": {"ess_bulk_min": 10000.0, "ess_bulk_median": 24082.7, "ess_bulk_log_likelihood": 9878.2, "ess_tail_log_likelihood":
        11007.5, "rhat_max": 1.0013}, "job": {"ess_bulk_min": 2500.0, "ess_bulk_median": 6808.4, "ess_bulk_log_likelihood": 2592.0,
        "ess_tail_log_likelihood": 3169.1, "rhat_max": 1.005}, "log_likelihood_mean": -30.3, "log_likelihood_mcse": 0.02,
        "log_likelihood_sd": 2.2, "job_log_likelihood": [-30.0, -31.5]}]}"#;

    #[test]
    fn reports_parse_and_rates_leave_compilation_out() {
        let report = parse(REPORT.as_bytes()).expect("a report");
        assert_eq!((report.chains, report.versions["numpyro"].as_str()), (4, "0.22.0"));
        assert_eq!((report.runs[0].rate(), report.runs[0].job_rate()), (5000.0, 5000.0));
        assert_eq!(report.runs[0].name(), "NUTS, sequential chains, diagonal mass");
        assert!(parse(b"{}").is_err());
    }
}
