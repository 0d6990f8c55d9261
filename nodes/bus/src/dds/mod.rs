//! The graph over DDS. Only the files in this folder name RustDDS and `ros2-client`.

mod bytes;
mod client;
mod discovery;
mod environment;
mod mangle;
mod node_info;
mod participant;
mod policies;
mod reader;
mod service;
mod writer;

pub(crate) use environment::{Environment, Range};
pub(crate) use participant::DdsTransport;
