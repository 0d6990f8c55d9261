//! A simulated world to teach: a grid of cells, or the road of the dissertation's section 4.5.4. It says what there is and
//! where each action leads, and nothing of what is good.

mod build;
mod node;
mod run;
mod settings;

pub use build::{WorldSettingsError, world};
pub use node::{Event, Output, SimulatedWorldNode};
pub use run::run;
pub use settings::{Kind, Settings};
