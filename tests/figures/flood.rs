//! How much the recorder takes from DDS without losing any: a publisher at rising rates, for several sizes.

use crate::recorded::Recorded;
use crate::suite::{Process, Turn, apprentice, fresh_domain, fresh_folder, now};
use apprentice_msgs::std_msgs;
use bus::{Arguments, Bus, Durability, Graph, NodeSettings, ParameterSpec, Qos, QosProfile, Reliability};
use rustix::process::{Signal, kill_process};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::process::Command;
use std::time::Duration;

/// Bytes of a message, and the rates that are tried, messages a second.
const SIZES: [(usize, &[usize]); 3] = [
    (100, &[5_000, 10_000, 20_000, 40_000, 80_000]),
    (4_000, &[2_000, 5_000, 10_000, 20_000]),
    (60_000, &[200, 500, 1_000, 2_000]),
];
/// How long each rate is held, seconds.
const SPAN_S: usize = 3;
const LIMIT: Duration = Duration::from_secs(120);

/// The publisher has no parameters.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
struct NoSettings {}

impl NodeSettings for NoSettings {
    const NODE: &'static str = "flood";
    const ABOUT: &'static str = "Publishes as fast as it can";
    const PARAMETERS: &'static [ParameterSpec] = &[];
}

/// The highest rate of each size at which nothing is lost.
pub fn measure() -> Value {
    let _turn = Turn::take();
    let mut figures = serde_json::Map::new();
    for (bytes, rates) in SIZES {
        let mut best = json!({ "messages/s": 0 });
        for rate in rates {
            let got = record(bytes, *rate);
            if got["lost"] != 0 {
                best["lost at the next rate"] = json!({ "messages/s": rate, "lost": got["lost"] });
                break;
            }
            best = got;
        }
        figures.insert(format!("{bytes} B"), best);
    }
    Value::Object(figures)
}

fn record(bytes: usize, rate: usize) -> Value {
    let n = rate * SPAN_S;
    let (domain, bag) = (fresh_domain(), fresh_folder(&format!("figures-flood-{bytes}")).join("bag"));
    let output = format!("output:={}", bag.display());
    let arguments = ["session_recorder", "--ros-args", "-p", &output, "-p", "topics:=[/flood]"];
    let mut recorder = Process::start(apprentice(domain, &arguments), "session_recorder");
    let mut publisher = Command::new(std::env::current_exe().expect("this program has a file"));
    publisher
        .args(["flood", &bytes.to_string(), &rate.to_string()])
        .env("ROS_DOMAIN_ID", domain.to_string())
        .env("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST");
    let status = Process::start(publisher, "flood").wait(LIMIT);
    let _ = kill_process(recorder.pid(), Signal::INT);
    recorder.wait(LIMIT);
    let times: Vec<u64> = match Recorded::read(&bag) {
        Ok(bag) => bag.messages.iter().filter(|m| m.topic.name == "/flood").map(|m| m.log_time).collect(),
        Err(error) => return json!({ "error": error.to_string() }),
    };
    let span_s = match (times.first(), times.last()) {
        (Some(first), Some(last)) if last > first => (last - first) as f64 / 1e9,
        _ => f64::NAN,
    };
    json!({
        "sent": if status.success() { n } else { 0 },
        "lost": n.saturating_sub(times.len()),
        "messages/s": times.len() as f64 / span_s,
        "MB/s": crate::megabytes((times.len() * bytes) as u64) / span_s,
    })
}

/// What the publishing process does: waits for the recorder, sends, and waits until all is delivered.
pub fn publish(arguments: &[String]) {
    let numbers: Vec<usize> = arguments.iter().filter_map(|word| word.parse().ok()).collect();
    let [bytes, rate] = numbers[..] else { panic!("flood BYTES RATE") };
    let arguments = Arguments::parse(&[]).expect("no arguments are good");
    let mut bus: Bus<()> = Bus::open(&Graph::Dds, &arguments, &NoSettings {}).expect("DDS starts");
    let qos = Qos::Custom(QosProfile::new(Reliability::Reliable, Durability::Volatile, 100_000));
    let publisher = bus.publisher("/flood", qos).expect("a good name");
    let start = now();
    while publisher.subscriptions() == 0 {
        assert!(start.elapsed() < Duration::from_secs(20), "nobody records");
        std::thread::sleep(Duration::from_millis(20));
    }
    let message = std_msgs::String { data: "x".repeat(bytes.saturating_sub(9)) };
    let (start, n) = (now(), rate * SPAN_S);
    let mut sent = 0;
    while sent < n {
        let due = (start.elapsed().as_secs_f64() * rate as f64) as usize;
        while sent < due.min(n) {
            publisher.publish(&message).expect("DDS takes it");
            sent += 1;
        }
        std::thread::sleep(Duration::from_micros(500));
    }
    // What is still on its way is sent again as long as the publisher is there.
    std::thread::sleep(Duration::from_secs(2));
}
