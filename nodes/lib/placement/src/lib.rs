//! Where to put the target, how wrong that may be, and how an arm gets it there.
//!
//! Everything here is a function of its arguments: no clock, files or global generator, and the same bits for any number
//! of threads. Names that end in `_m` are metres in the table's frame, others normalised coordinates.

mod access;
mod candidate;
mod choice;
mod gripper;
mod losses;
mod manipulator;
mod motion;
mod picking;
mod plan;
mod reach;
mod settings;
mod space;
mod tabulated;
mod tail;
mod trajectory;

pub use candidate::{Candidate, Verdict};
pub use choice::{Choice, NEAR_M};
pub use gripper::{ClosingAxis, Found, Grasp, Gripper};
pub use losses::{LossBatch, SceneLosses, placement_losses, placement_optima};
pub use manipulator::{Manipulator, ManipulatorError, TABLE_THICKNESS_M, resting_height_m};
pub use picking::{Source, Stand};
pub use plan::{CellState, MAP_SIDE, PlacementPlan, PlanOutcome, Planner};
pub use reach::ReachMap;
pub use settings::{MotionSettings, TablePose};
pub use tail::cvar;
pub use trajectory::{Trajectory, TrajectoryPoint};
