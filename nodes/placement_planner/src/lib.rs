//! The node that plans: where the robot would put the target, in the open question's scene (its guess) and on the table as
//! it is (its plan), free of the other objects and within reach of the arm; once the lesson is taught, it moves.

mod asked;
mod carrying;
mod convert;
mod node;
mod reaching;
mod robot;
mod run;
mod settings;
mod sharing;
mod target;

pub use carrying::{Deed, Fingers, Heard, Limb};
pub use node::{Event, Output, PlacementPlanner, Request, is_task};
pub use robot::{RobotFiles, RobotFilesError, RobotRefused};
pub use run::run;
pub use settings::Settings;
