//! Our samplers and solvers beside other programs, ratios in one run: `cargo run --release -p peers -- NAME`.

mod arm;
mod birl;
mod bound;
mod broil;
mod clock;
mod clutter;
mod effective;
mod error;
mod highs;
mod joint_space;
mod l2_walk;
mod large_world;
mod memory;
mod numpyro;
mod ompl;
mod plans;
mod preference_data;
mod preferences;
mod published_walk;
mod transfers;
mod value_iteration;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use error::PeersError;

/// Measures our programs beside others in one run and prints the ratios.
#[derive(Parser)]
#[command(
    version,
    after_help = "Example: cargo run --release -p peers -- preferences --seconds 5 --json preferences.json"
)]
struct Arguments {
    #[command(subcommand)]
    what: What,
    /// CPU seconds to spend on each program that is measured, roughly.
    #[arg(long, global = true, default_value_t = 5.0)]
    seconds: f64,
    /// Seed of the data and of our draws.
    #[arg(long, global = true, default_value_t = 1)]
    seed: u64,
    /// Where to write the figures as one JSON object.
    #[arg(long, global = true)]
    json: Option<PathBuf>,
}

#[derive(Subcommand)]
enum What {
    /// Preferences over 64 features: ours, NumPyro's NUTS (set up by tests/peers/setup) and the dissertation's walk.
    Preferences,
    /// Demonstrations in the 9 x 9 world: ours and the dissertation's walk with a value iteration per proposal.
    Birl,
    /// A world of 10,000 states: seconds for a posterior.
    LargeWorld,
    /// A Panda among 20 objects: kinematics and collision checks, ours and those of Pinocchio with Coal.
    Arm,
    /// Placements in 200 cluttered scenes with a Panda and with our own arm: success, time, length.
    Plans,
    /// Motions of a Panda among 8 objects: ours and OMPL's RRT-Connect (set up by tests/peers/setup) with Coal's checks.
    Ompl,
    /// How long a bound from 10,000 draws takes.
    Bound,
    /// Robust policies: ours and SciPy's HiGHS (set up by tests/peers/setup) on the same linear programs.
    Broil {
        /// Leave HiGHS out, which takes minutes for the largest
        #[arg(long)]
        ours: bool,
    },
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("peers: {error}");
            ExitCode::from(2)
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), PeersError> {
    let (seconds, seed) = (arguments.seconds, arguments.seed);
    if !(seconds > 0.0 && seconds <= 3600.0) {
        return Err(PeersError::Seconds { got: seconds });
    }
    let json = match arguments.what {
        What::Preferences => serde_json::to_value(preferences::compare(seconds, seed)?),
        What::Birl => serde_json::to_value(birl::compare(seconds, seed)?),
        What::LargeWorld => serde_json::to_value(large_world::measure(seed)?),
        What::Arm => serde_json::to_value(arm::compare(seconds, seed)?),
        What::Plans => serde_json::to_value(plans::measure(seed)?),
        What::Ompl => serde_json::to_value(ompl::compare(seconds, seed)?),
        What::Bound => serde_json::to_value(bound::measure(seconds, seed)?),
        What::Broil { ours } => serde_json::to_value(broil::compare(seed, !ours)?),
    }
    .map_err(|source| PeersError::Json { what: "the figures", source })?;
    match &arguments.json {
        Some(path) => std::fs::write(path, format!("{json:#}\n"))
            .map_err(|source| PeersError::File { path: path.clone(), source }),
        None => Ok(()),
    }
}
