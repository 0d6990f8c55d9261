//! `apprentice robot`: checks a robot description with its meshes, and says where its links are and what they touch.

mod answer;
mod error;
mod inputs;
mod json;
mod report;
mod tree;

pub use answer::{Answer, Posture, answer};
pub use error::RobotError;

use clap::Parser;
use std::io::{ErrorKind, Write};
use std::path::PathBuf;
use std::process::ExitCode;

/// Checks a robot description (URDF) with its collision meshes: its tree, limits, meshes, what is odd about it, where every link
/// is at given joint positions and which links touch.
///
/// Exit code 0: answered, whatever the answer; 2: the description or another input cannot be used, and a message says
/// where and what to do; 1: the answer could not be written.
#[derive(Debug, Clone, Parser)]
#[command(
    name = "apprentice robot",
    after_help = "Example:\n  apprentice robot panda.urdf --package-path ~/ws/src --srdf panda.srdf --joints poses.json"
)]
pub struct Robot {
    /// The URDF; expand a xacro file first
    pub urdf: PathBuf,
    /// Folders that hold packages, or are packages, for package:// names and for relative names that lead upwards
    #[arg(long, value_name = "DIR")]
    pub package_path: Vec<PathBuf>,
    /// Semantic description with the pairs of links that may touch; without it they are found by sampling
    #[arg(long, value_name = "FILE")]
    pub srdf: Option<PathBuf>,
    /// JSON: one object of joint names and positions (radians, metres), or a list of them; what is absent is 0
    #[arg(long, value_name = "FILE")]
    pub joints: Option<PathBuf>,
    /// Go on without meshes that cannot be used: a box around the link's inertia and joints stands in for each
    #[arg(long)]
    pub bounding_shapes: bool,
    /// Several convex pieces for a mesh whose convex hull is much larger: slower to read, closer to the mesh
    #[arg(long)]
    pub pieces: bool,
    /// Test every pair of links that can move against each other, neighbours and disabled ones too
    #[arg(long)]
    pub all_pairs: bool,
    /// Seed of the sampling
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// One JSON object on standard output
    #[arg(long)]
    pub json: bool,
}

/// Runs the command.
pub fn run(arguments: &Robot) -> ExitCode {
    let (text, code) = match answer(arguments) {
        Ok(answer) if arguments.json => (format!("{}\n", json::answer(&answer)), 0),
        Ok(answer) => (report::answer(&answer), 0),
        Err(error) => {
            // A closed standard error is no reason to stop.
            let _ = writeln!(std::io::stderr(), "error: apprentice robot: {error}");
            (if arguments.json { format!("{}\n", json::refusal(&error)) } else { String::new() }, 2)
        }
    };
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            let _ = writeln!(std::io::stderr(), "error: apprentice robot: the answer could not be written: {error}");
            ExitCode::from(1)
        }
        // Whoever reads has read enough.
        _ => ExitCode::from(code),
    }
}
