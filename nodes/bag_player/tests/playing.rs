//! The player on an in-memory graph: exact bytes, recorded QoS, pause over service and topic, clear errors.
#![expect(clippy::disallowed_methods, reason = "tests wait in real time")]

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use apprentice_msgs::srv::{SetPaused, SetPausedRequest};
use apprentice_msgs::std_msgs::Bool;
use bag::{BagWriter, Durability, OfferedQos, Topic, WriterOptions};
use bus::{Arguments, Bus, Graph, MemoryGraph, Next, NodeError, NodeSettings, ParameterSpec, Qos, RawMessage};
use serde::{Deserialize, Serialize};

#[derive(Debug, Clone, Default, Serialize, Deserialize)]
struct Listener {}

impl NodeSettings for Listener {
    const NODE: &'static str = "listener";
    const ABOUT: &'static str = "Hears what a test wants to hear.";
    const PARAMETERS: &'static [ParameterSpec] = &[];
}

fn arguments(parameters: &[(&str, &str)]) -> Arguments {
    let none = Arguments::parse(&[]).expect("there are none");
    parameters.iter().fold(none, |arguments, (name, value)| {
        arguments.with_parameter(name, value).expect("the parameter is well formed")
    })
}

/// A bag with a latched message and a burst of others, 1 ms apart.
fn write_bag(folder: &Path) -> (PathBuf, Vec<Vec<u8>>) {
    let latched = OfferedQos { durability: Durability::TransientLocal, depth: 1, ..OfferedQos::default() };
    let topics = [
        Topic::ros2("/latched", "std_msgs/msg/String", "string data\n", &[latched]),
        Topic::ros2("/secret", "nobody_msgs/msg/Secret", "", &[OfferedQos::default()]),
    ];
    let mut writer = BagWriter::new(Vec::new(), &WriterOptions::default()).expect("a vector takes everything");
    let ids = topics.map(|topic| writer.add_topic(&topic).expect("it fits"));
    writer.write(ids[0], 1_000, 1_000, &[0, 1, 0, 0, 2, 0, 0, 0, b'x', 0]).expect("it fits");
    let burst: Vec<Vec<u8>> = (0..20_u8).map(|i| vec![0, 1, 0, 0, i, 255 - i, 3]).collect();
    for (i, cdr) in burst.iter().enumerate() {
        writer.write(ids[1], 1_000_000 * (i as u64 + 1), 0, cdr).expect("it fits");
    }
    let path = folder.join("some.mcap");
    std::fs::write(&path, writer.finish().expect("a vector takes everything").0).expect("the folder is writable");
    (path, burst)
}

fn play(graph: &MemoryGraph, bag: &Path, more: &[(&str, &str)]) -> std::thread::JoinHandle<Result<(), NodeError>> {
    let bag = bag.display().to_string();
    let mut parameters = vec![("bag", bag.as_str()), ("delay_s", "0.1")];
    parameters.extend_from_slice(more);
    let (graph, arguments) = (Graph::Memory(graph.clone()), arguments(&parameters));
    std::thread::spawn(move || bag_player::run(&graph, &arguments))
}

fn listener(graph: &MemoryGraph) -> Bus<(String, RawMessage)> {
    Bus::open(&Graph::Memory(graph.clone()), &arguments(&[]), &Listener {}).expect("the graph is in memory")
}

/// The next `count` messages; fails the test when they do not come.
fn hear(bus: &mut Bus<(String, RawMessage)>, count: usize) -> Vec<(String, Vec<u8>)> {
    let mut heard = Vec::new();
    while heard.len() < count {
        match bus.next_timeout(Duration::from_secs(10)) {
            Next::Event(_, (topic, message)) => heard.push((topic, message.cdr)),
            other => panic!("got {other:?} after {} of {count} messages", heard.len()),
        }
    }
    heard
}

fn subscribe(
    bus: &mut Bus<(String, RawMessage)>,
    topic: &'static str,
    type_name: &str,
    qos: Qos,
) -> bus::RawSubscription {
    bus.subscribe_raw(topic, type_name, qos.profile(), move |message| (topic.to_owned(), message))
        .expect("a fine topic")
}

#[test]
fn a_bag_is_played_byte_for_byte_also_of_unknown_types() {
    let root = tempfile::tempdir().expect("a temporary folder");
    let (bag, burst) = write_bag(root.path());
    let graph = MemoryGraph::new();
    let mut bus = listener(&graph);
    let _secret = subscribe(&mut bus, "/secret", "nobody_msgs/msg/Secret", Qos::Event);
    let player = play(&graph, &bag, &[]);
    let heard: Vec<_> = hear(&mut bus, burst.len()).into_iter().map(|(_, cdr)| cdr).collect();
    assert_eq!(heard, burst);
    player.join().expect("it does not panic").expect("it ends by itself");
}

#[test]
fn a_latched_topic_reaches_a_late_subscription_that_asks_for_it() {
    let root = tempfile::tempdir().expect("a temporary folder");
    let (bag, burst) = write_bag(root.path());
    let graph = MemoryGraph::new();
    let mut bus = listener(&graph);
    let _secret = subscribe(&mut bus, "/secret", "nobody_msgs/msg/Secret", Qos::Event);
    let player = play(&graph, &bag, &[]);
    hear(&mut bus, burst.len());
    // The latched message is long gone out; the player lingers.
    let _latched = subscribe(&mut bus, "/latched", "std_msgs/msg/String", Qos::State);
    assert_eq!(hear(&mut bus, 1)[0].0, "/latched");
    player.join().expect("it does not panic").expect("it ends by itself");
}

#[test]
fn service_and_topic_pause_and_resume() {
    let root = tempfile::tempdir().expect("a temporary folder");
    let (bag, burst) = write_bag(root.path());
    let graph = MemoryGraph::new();
    let mut bus = listener(&graph);
    let _secret = subscribe(&mut bus, "/secret", "nobody_msgs/msg/Secret", Qos::Event);
    let pause = bus.publisher("/apprentice/bag_player/paused", Qos::Event).expect("a fine topic");
    let player = play(&graph, &bag, &[("paused", "true"), ("delay_s", "0.0")]);
    let limit = Instant::now() + Duration::from_secs(10);
    while pause.subscriptions() == 0 {
        assert!(Instant::now() < limit, "the player does not listen");
        std::thread::sleep(Duration::from_millis(5));
    }
    assert_eq!(bus.next_timeout(Duration::from_millis(200)), Next::Timeout, "it starts paused");
    pause.publish(&Bool { data: false }).expect("it is a bool");
    assert_eq!(hear(&mut bus, burst.len()).len(), burst.len());
    player.join().expect("it does not panic").expect("it ends by itself");

    let graph = MemoryGraph::new();
    let player = play(&graph, &bag, &[("loop", "true"), ("paused", "true")]);
    let resumed = loop {
        assert!(Instant::now() < limit, "the player offers no service");
        match graph.call::<SetPaused>("/apprentice/bag_player/set_paused", &SetPausedRequest { paused: false }) {
            Some(answer) => break answer,
            None => std::thread::sleep(Duration::from_millis(5)),
        }
    };
    assert!(!resumed.paused && resumed.message == "playing");
    graph.shutdown();
    player.join().expect("it does not panic").expect("an asked-for end is a good one");
}

#[test]
fn a_bag_that_cannot_be_played_is_one_clear_error_and_exit_code_2() {
    let root = tempfile::tempdir().expect("a temporary folder");
    let text = root.path().join("text.mcap");
    std::fs::write(&text, "no bag at all").expect("the folder is writable");
    let (bag, _) = write_bag(root.path());
    let (missing, good) = (root.path().join("missing"), bag.display().to_string());
    /// What to play, with which other parameters, and words of the error.
    type Case<'a> = (&'a Path, &'a [(&'a str, &'a str)], &'a str);
    let cases: [Case<'_>; 4] = [
        (&missing, &[], "there is no bag at"),
        (&text, &[], "not an MCAP file"),
        (Path::new(""), &[], "`bag` is empty"),
        (Path::new(&good), &[("topics", "['/nothing']")], "has no topic"),
    ];
    for (path, more, words) in cases {
        let error =
            play(&MemoryGraph::new(), path, more).join().expect("it does not panic").expect_err("it cannot play");
        assert_eq!(error.exit_code(), 2, "{error}");
        assert!(error.to_string().contains(words) && error.to_string().lines().count() == 1, "{error}");
    }
}

#[test]
fn a_cut_bag_is_played_up_to_the_cut() {
    let root = tempfile::tempdir().expect("a temporary folder");
    let (bag, burst) = write_bag(root.path());
    let whole = std::fs::read(&bag).expect("we wrote it");
    std::fs::write(&bag, &whole[..whole.len() - 20]).expect("the folder is writable");
    let graph = MemoryGraph::new();
    let mut bus = listener(&graph);
    let _secret = subscribe(&mut bus, "/secret", "nobody_msgs/msg/Secret", Qos::Event);
    let player = play(&graph, &bag, &[]);
    assert_eq!(hear(&mut bus, burst.len()).len(), burst.len());
    player.join().expect("it does not panic").expect("it ends by itself");
}
