//! Motion of a mechanism in joint space: find a way, shorten it, round its corners, time it.
//!
//! The crate knows no robot: a [`Space`] says how many joints there are, how far each goes, and which straight edges are
//! free. [`connect`] finds corners joined by free edges (RRT-Connect), [`shorten`] takes detours out of them, [`time`]
//! rounds the corners where there is room and moves along the result as fast as the limits of velocity, acceleration and
//! jerk of every joint let it. Joints are radians or metres, times seconds. Everything is a function of its arguments and a
//! seed.
//!
//! The `rrt` crate of OpenRR was looked at and draws from the thread's own generator, which no seed reaches; the speed along
//! straight sections comes from `rsruckig`.

mod blend;
mod limits;
mod metric;
mod path;
mod rrt;
mod shorten;
mod space;
mod speed;
mod timing;
mod trajectory;

pub use limits::{Limits, LimitsError};
pub use metric::Metric;
pub use path::Path;
pub use rrt::{NoPath, Search, connect};
pub use shorten::shorten;
pub use space::Space;
pub use timing::{TimingError, time};
pub use trajectory::{Trajectory, TrajectoryPoint};
