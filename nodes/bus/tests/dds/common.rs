//! What the claims share: settings, events, and waiting.

use std::time::{Duration, Instant};

use apprentice_msgs::{rcl_interfaces::Log, std_msgs::String as Text};
use bus::{Arguments, Bus, Graph, Next, NodeSettings, ParameterSpec, Range, RawMessage};
use serde::{Deserialize, Serialize};

use crate::PATIENCE;

/// Settings of a node under test.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    pub speed: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Settings { speed: 0.1 }
    }
}

impl NodeSettings for Settings {
    const NODE: &'static str = "tested";
    const ABOUT: &'static str = "A node under test.";
    const PARAMETERS: &'static [ParameterSpec] =
        &[ParameterSpec { name: "speed", about: "metres per second", range: Range::Float { min: 0.0, max: 1.0 } }];
}

/// What reaches a node under test.
#[derive(Debug, Clone, PartialEq)]
pub enum Event {
    Text(String),
    Log(Log),
    Raw(RawMessage),
    Tick,
}

/// A node on the real graph.
pub fn open(args: &[&str]) -> Bus<Event> {
    let args: Vec<String> = args.iter().map(|arg| (*arg).to_owned()).collect();
    let arguments = Arguments::parse(&args).expect("good arguments");
    let settings: Settings = arguments.settings().expect("good settings");
    Bus::open(&Graph::Dds, &arguments, &settings).expect("a DDS participant")
}

/// A text message.
pub fn text(data: &str) -> Text {
    Text { data: data.to_owned() }
}

/// Waits for an event that `pick` takes; others are thrown away.
#[expect(clippy::disallowed_methods, reason = "a test gives up some time")]
pub fn wait_for<T>(bus: &mut Bus<Event>, what: &str, mut pick: impl FnMut(Event) -> Option<T>) -> T {
    let until = Instant::now() + PATIENCE;
    loop {
        match bus.next_timeout(until.saturating_duration_since(Instant::now())) {
            Next::Event(_, event) => {
                if let Some(found) = pick(event) {
                    return found;
                }
            }
            Next::Timeout => panic!("waited in vain for {what}"),
            Next::Shutdown => panic!("the node was asked to end while waiting for {what}"),
        }
    }
}

/// Waits until something holds.
pub fn until(what: &str, holds: impl FnMut() -> bool) {
    until_within(PATIENCE, what, holds);
}

/// Waits until a node has left the graph. Its goodbye is one datagram that a busy machine may drop; then its lease of
/// 50 s has to run out.
pub fn until_gone(what: &str, holds: impl FnMut() -> bool) {
    until_within(Duration::from_secs(90), what, holds);
}

#[expect(clippy::disallowed_methods, reason = "a test gives up some time")]
fn until_within(patience: Duration, what: &str, mut holds: impl FnMut() -> bool) {
    let until = Instant::now() + patience;
    while !holds() {
        assert!(Instant::now() < until, "waited in vain until {what}");
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
}
