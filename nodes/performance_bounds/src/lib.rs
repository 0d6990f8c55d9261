//! The node that says how wrong the robot may still be: high-confidence bounds on the placement loss of the MAP reward,
//! with everything needed to check them, or why there is none.

mod node;
mod run;
mod settings;

pub use node::{Event, Output, PerformanceBoundsNode};
pub use run::run;
pub use settings::Settings;
