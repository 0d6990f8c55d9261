//! What can go wrong between a node and the graph, and the exit codes.

use thiserror::Error;

use crate::{arguments::ArgumentError, names::NameError, parameter_error::ParameterError};

/// The graph cannot be joined, or an endpoint cannot be made or used.
#[derive(Debug, Error)]
pub enum BusError {
    /// A topic, service or node name is not allowed.
    #[error(transparent)]
    Name(#[from] NameError),
    /// A parameter that the bus itself uses is wrong.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// An environment variable asks for something impossible.
    #[error("{variable}=`{got}`: expected {expected}")]
    Environment {
        /// The variable.
        variable: &'static str,
        /// Its value.
        got: String,
        /// What it may be.
        expected: String,
    },
    /// A type name not of the form `pkg/msg/Name` or `pkg/srv/Name`.
    #[error("`{got}` is no ROS type name; expected pkg/msg/Name, pkg/srv/Name or pkg/action/Name")]
    TypeName {
        /// The name given.
        got: String,
    },
    /// DDS refuses to start or to make an endpoint.
    #[error("cannot {what}: {reason}")]
    Dds {
        /// What was tried.
        what: String,
        /// DDS's words.
        reason: String,
    },
    /// A message cannot be sent.
    #[error("cannot publish on {topic}: {reason}")]
    Publish {
        /// The topic.
        topic: String,
        /// Why.
        reason: String,
    },
    /// Bytes that are no CDR message at all.
    #[error("cannot publish on {topic}: {got} bytes are no CDR message; expected a 4-byte header and a body")]
    NoCdr {
        /// The topic.
        topic: String,
        /// How many bytes.
        got: usize,
    },
    /// An encoding that RustDDS cannot write.
    #[error(
        "cannot publish on {topic}: the message is encoded as {got}; only little-endian CDR (0x00 0x01) can be sent"
    )]
    Encoding {
        /// The topic.
        topic: String,
        /// The first two bytes of the header.
        got: String,
    },
    /// A thread or a signal handler cannot be had.
    #[error("cannot start {what}: {source}")]
    System {
        /// What.
        what: &'static str,
        /// The system's reason.
        source: std::io::Error,
    },
}

/// Why a node ended otherwise than asked.
#[derive(Debug, Error)]
pub enum NodeError {
    /// The command line cannot be taken.
    #[error(transparent)]
    Arguments(#[from] ArgumentError),
    /// The parameters cannot be taken, or help was asked for.
    #[error(transparent)]
    Parameters(#[from] ParameterError),
    /// The graph cannot be joined or used.
    #[error(transparent)]
    Bus(#[from] BusError),
    /// The node cannot start with what it was given.
    #[error("{0}")]
    Start(String),
    /// The node had to give up.
    #[error("{0}")]
    Failed(String),
}

impl NodeError {
    /// 0 for help, 2 for bad input, 1 for a failure.
    pub fn exit_code(&self) -> i32 {
        match self {
            NodeError::Parameters(ParameterError::Help(_)) => 0,
            NodeError::Arguments(_)
            | NodeError::Parameters(_)
            | NodeError::Start(_)
            | NodeError::Bus(
                BusError::Name(_) | BusError::Parameter(_) | BusError::Environment { .. } | BusError::TypeName { .. },
            ) => 2,
            NodeError::Bus(_) | NodeError::Failed(_) => 1,
        }
    }

    /// Tells the person: help on standard output, an error on standard error. Returns the exit code.
    pub fn report(&self, node: &str) -> i32 {
        match self {
            NodeError::Parameters(ParameterError::Help(text)) => print!("{text}"),
            error => eprintln!("error: {node}: {error}"),
        }
        self.exit_code()
    }
}
