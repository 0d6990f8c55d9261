//! One node on the ROS 2 graph: arguments, parameters, topics, services, time, logging, diagnostics and shutdown.
//!
//! This is the only crate that names `ros2-client` and RustDDS. A node opens a [`Bus`] on a [`Graph`] (DDS, or one
//! within the process for tests and replays), makes its endpoints, and takes everything that happens from
//! [`Bus::next`] as one enum of its own.
//!
//! What holds on both graphs:
//! - Both carry CDR bytes, and one decoder reads them. A message that cannot be decoded is counted, reported and left
//!   out; so are messages of another type than the one subscribed to.
//! - Messages of one publisher on one topic arrive in order. A reliable subscription waits when the node's queue is
//!   full; a best-effort one loses its oldest messages, counted.
//! - Settings, heartbeat (2 Hz), `/diagnostics` (1 Hz), `/rosout` and the parameter services come with
//!   [`Bus::open`]; the node does nothing for them.
//! - SIGINT, SIGTERM, the death of the process named in `APPRENTICE_PARENT_PID`, [`MemoryGraph::shutdown`] and
//!   [`Stopper::stop`] all have [`Bus::next`] return `None`; a SIGINT after 10 s of that ends the process at once.

mod action;
mod arguments;
mod bus;
mod clock;
mod dds;
mod error;
mod health;
mod help;
mod housekeeping;
mod logging;
mod memory;
mod names;
mod parameter;
mod parameter_error;
mod parameter_file;
mod parameter_services;
mod publisher;
mod qos;
mod queue;
mod settings;
mod signals;
mod stop;
mod suggest;
pub mod testing;
mod transport;
mod yaml;

pub use action::{ActionClient, ActionEvent, ActionRequest, ActionServer, End, GoalId};
pub use apprentice_msgs::builtin_interfaces::Time;
pub use arguments::{ArgumentError, Arguments, DEFAULT_NAMESPACE};
pub use bus::{Bus, EventSender, Graph, Next, RawSubscription};
pub use error::{BusError, NodeError};
pub use health::Level;
pub use memory::MemoryGraph;
pub use names::{NameError, NodeName};
pub use parameter::{NodeSettings, ParameterSpec, ParameterValue, Range};
pub use parameter_error::{ParameterError, Place};
pub use parameter_file::sections_of;
pub use publisher::{Publisher, RawPublisher};
pub use qos::{Durability, Qos, QosProfile, Reliability};
pub use settings::{settings_from_yaml, settings_to_yaml};
pub use stop::Stopper;
pub use transport::{EndpointInfo, RawMessage, TopicInfo};
