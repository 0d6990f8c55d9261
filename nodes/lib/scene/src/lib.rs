//! What stands on a table, and the radial-basis-function rewards of placing one more thing on it.
//!
//! Lengths are metres in the table's frame: x to the right, y away from the robot, origin at the table's near left corner.
//! Rewards live on normalised coordinates (x / width, y / depth), so that a scenario means the same on tables of any size.

mod climb;
mod exp;
mod field;
mod geometry;
mod global;
mod hill;
mod listed;
mod object;
mod optimum;
mod rbf;
mod region;
mod scene;

pub use climb::climb;
pub use exp::exp;
pub use field::{Field, Grid};
pub use geometry::Point;
pub use global::{GlobalOptimum, global_placement};
pub use hill::Basis;
pub use listed::{ListError, Listed, listed_target};
pub use object::{Object, Shape};
pub use optimum::{Optimum, best_placement};
pub use rbf::{FIXED_CENTRES, Rbf, SIGMA_SQUARED};
pub use region::Region;
pub use scene::{MAX_OBJECTS, Obstruction, Occupied, Scene, SceneError};
