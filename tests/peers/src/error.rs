//! Why a comparison could not be made.

use std::path::PathBuf;

/// What went wrong, and where.
#[derive(Debug, thiserror::Error)]
pub enum PeersError {
    /// A budget out of range.
    #[error("--seconds is {got}, expected a number above 0 and at most 3600")]
    Seconds {
        /// Got.
        got: f64,
    },
    /// A file that cannot be written.
    #[error("{}: {source}", path.display())]
    File {
        /// Which.
        path: PathBuf,
        /// Why not.
        source: std::io::Error,
    },
    /// Something that is not the JSON it should be.
    #[error("{what}: {source}")]
    Json {
        /// What was read or written.
        what: &'static str,
        /// Why not.
        source: serde_json::Error,
    },
    /// Python could not be started.
    #[error("{} cannot be started ({source}): run tests/peers/setup, or set APPRENTICE_PEERS_PYTHON", python.display())]
    NoPython {
        /// The interpreter.
        python: PathBuf,
        /// Why not.
        source: std::io::Error,
    },
    /// The other program failed; it said why on standard error.
    #[error("{} failed: {status}", script.display())]
    Script {
        /// The Python program.
        script: PathBuf,
        /// How it ended.
        status: std::process::ExitStatus,
    },
    /// Our own sampler refused.
    #[error(transparent)]
    Posterior(#[from] posterior::PosteriorError),
    /// Our own likelihood refused the data.
    #[error(transparent)]
    Preferences(#[from] likelihood::preferences::PreferenceError),
    /// The same for actions.
    #[error(transparent)]
    Actions(#[from] likelihood::actions::ActionError),
    /// A world that does not hold together.
    #[error(transparent)]
    World(#[from] mdp::MdpError),
    /// Draws that cannot be judged.
    #[error(transparent)]
    Diagnostics(#[from] diagnostics::SeriesError),
    /// A bound that cannot be asked for.
    #[error(transparent)]
    Risk(#[from] risk::RiskError),
    /// A robust policy that cannot be asked for.
    #[error(transparent)]
    Robust(#[from] robust::RobustError),
    /// A robot, or what belongs to it, that cannot be used.
    #[error("the robot cannot be used: {problem}")]
    Robot {
        /// What is wrong.
        problem: String,
    },
}
