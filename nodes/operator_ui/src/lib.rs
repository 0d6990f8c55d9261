//! The operator's page: the question on the table, the person's answer, and how sure the robot is.
//!
//! [`OperatorUi`] is a pure state machine between the topics and the pages; [`run`] wires it to the bus and to a small
//! web server that is bound to the loopback interface and guarded by a token. What travels between server and page is
//! [`protocol`].

mod access;
mod answers;
mod arm_picture;
mod assets;
mod early;
mod event;
mod evidence;
mod hub;
mod loading;
mod markers;
mod node;
mod presence;
pub mod protocol;
mod question;
mod recordings;
mod run;
mod rviz;
mod server;
mod settings;
mod socket;
mod tabular;
mod tabular_view;
mod view;
mod world_answers;

pub use access::{Access, AccessError};
pub use event::{Event, Output, Recorded, Told};
pub use hub::{Hub, PageId};
pub use node::OperatorUi;
pub use run::run;
pub use server::{Limits, Server};
pub use settings::Settings;
