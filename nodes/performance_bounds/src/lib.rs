//! The node that says how wrong the robot may still be: high-confidence bounds on the placement loss of the MAP reward and on
//! the return and the loss of any policy sent to it, with everything needed to check them, or why there is none.

mod node;
mod policies;
mod policy_bounds;
mod policy_loss;
mod risk_message;
mod run;
mod settings;

pub use node::{Event, Output, PerformanceBoundsNode};
pub use policy_bounds::judge_policies;
pub use run::run;
pub use settings::Settings;
