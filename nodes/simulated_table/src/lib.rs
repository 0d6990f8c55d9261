//! A simulated world: a table with things on it, and an arm that follows joint trajectories.

mod follower;
mod layout;
mod node;
mod robot;
mod run;
mod settings;
mod target;

pub use follower::{Follower, TrajectoryError};
pub use layout::{LayoutError, task_scene};
pub use node::{Event, Output, SimulatedTableNode, TableError};
pub use robot::{BUILT_IN_URDF, JointModel, RobotError, RobotModel};
pub use run::run;
pub use settings::Settings;
