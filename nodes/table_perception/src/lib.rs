//! What detectors see of a table, as the scene that a lesson is about: detections of `vision_msgs` and poses of single things come
//! in, in any frame that tf connects with the table's, and one scene goes out, which changes only when something really moved.

mod frames;
mod node;
mod run;
mod settings;
mod sighting;

pub use frames::Frames;
pub use node::{Event, Output, TablePerceptionNode};
pub use run::run;
pub use settings::Settings;
