//! The node that says what to do while the reward is uncertain: from the draws of the posterior the policy that balances the
//! mean against the worst case (BROIL, dissertation chapter 7), and what every other balance would buy.
//!
//! What is published is a function of the settings, the posterior, its world, the demonstrations in force and the newest
//! [`apprentice_msgs::msg::RiskPreference`]: [`policy`] and [`frontier`] compute it, here and in a replay.

mod inputs;
mod message;
mod node;
mod run;
mod settings;
mod solve;
mod words;

pub use inputs::{Inputs, MissingInput};
pub use node::{Event, Output, PolicyOptimizer};
pub use run::run;
pub use settings::{Objective, Settings};
pub use solve::{Policies, frontier, policy};
