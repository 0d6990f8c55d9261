//! Messages of Apprentice and the standard ROS 2 ones that it uses, their CDR encoding and their schemas.
//!
//! The types are generated from `msg/`, `srv/` and `standard/` by
//! `cargo run --release -p apprentice_msgs --example generate`.

mod bounded;
mod cdr;
#[rustfmt::skip]
mod generated;
pub mod generator;
pub mod interface;
mod schema;
mod time;

pub use cdr::{CdrError, from_cdr, to_cdr};
pub use generated::{
    action_msgs, builtin_interfaces, diagnostic_msgs, geometry_msgs, msg, rcl_interfaces, rosgraph_msgs, sensor_msgs,
    srv, std_msgs, std_srvs, tf2_msgs, trajectory_msgs, unique_identifier_msgs, visualization_msgs,
};
pub use schema::{SchemaError, all_services, all_types, compose_schema, definition, schema};

use serde::Serialize;
use serde::de::DeserializeOwned;

/// A type that travels on a topic, or as a half of a service.
pub trait Message: Serialize + DeserializeOwned + Clone + Send + 'static {
    /// Name of the type: `package/msg/Name`, or `package/srv/Name_Request` for a half of a service.
    const TYPE: &'static str;
}

/// A question with an answer.
pub trait Service {
    /// What the client sends.
    type Request: Message;
    /// What the server answers.
    type Response: Message;
    /// Name of the type: `package/srv/Name`.
    const TYPE: &'static str;
}

/// Compiles and runs the code of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
