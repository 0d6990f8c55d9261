//! The other process: publishes a state and a log once, and answers `ping` on `pong`.

use std::process::ExitCode;

use apprentice_msgs::std_msgs::String as Text;
use bus::Qos;

use crate::common::{Event, open, text};

/// Runs until it is asked to end.
pub fn run() -> ExitCode {
    let mut bus = open(&["--ros-args", "-r", "__node:=peer"]);
    let state = bus.publisher::<Text>("peer_state", Qos::State).expect("a publisher");
    let history = bus.publisher::<Text>("peer_log", Qos::Log).expect("a publisher");
    let pong = bus.publisher::<Text>("pong", Qos::Event).expect("a publisher");
    bus.subscribe("ping", Qos::Event, |message: Text| Event::Text(message.data)).expect("a subscription");
    for index in 0..5 {
        state.publish(&text(&format!("state {index}"))).expect("published");
        history.publish(&text(&format!("log {index}"))).expect("published");
    }
    while let Some((_, event)) = bus.next() {
        if let Event::Text(data) = event {
            pong.publish(&text(&format!("{data} back"))).expect("published");
        }
    }
    ExitCode::SUCCESS
}
