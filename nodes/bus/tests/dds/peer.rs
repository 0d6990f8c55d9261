//! The other process: publishes a state and a log once, and answers `ping` on `pong`.

use std::process::ExitCode;

use apprentice_msgs::std_msgs::String as Text;
use bus::{Arguments, Bus, Graph, NodeError, Qos};

use crate::common::{Settings, text};

/// Runs until it is asked to end.
pub fn run() -> ExitCode {
    match answer() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => ExitCode::from(u8::try_from(error.report("peer")).unwrap_or(1)),
    }
}

/// Answers.
fn answer() -> Result<(), NodeError> {
    let arguments = Arguments::parse(&["-r".to_owned(), "__node:=peer".to_owned()])?;
    let mut bus: Bus<String> = Bus::open(&Graph::Dds, &arguments, &arguments.settings::<Settings>()?)?;
    let state = bus.publisher::<Text>("peer_state", Qos::State)?;
    let history = bus.publisher::<Text>("peer_log", Qos::Log)?;
    let pong = bus.publisher::<Text>("pong", Qos::Event)?;
    bus.subscribe("ping", Qos::Event, |message: Text| message.data)?;
    for index in 0..5 {
        state.publish(&text(&format!("state {index}")))?;
        history.publish(&text(&format!("log {index}")))?;
    }
    while let Some((_, data)) = bus.next() {
        pong.publish(&text(&format!("{data} back")))?;
    }
    Ok(())
}
