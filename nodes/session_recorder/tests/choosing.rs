//! What the recorder decides from what is on the graph, without a graph.

use std::fs;

use bus::{Durability, EndpointInfo, QosProfile, RawMessage, Reliability, Time, TopicInfo};
use session_recorder::{Definitions, Event, Output, RecorderNode, Settings};

fn endpoint(reliability: Reliability, durability: Durability) -> EndpointInfo {
    EndpointInfo { node: None, gid: [0; 16], qos: QosProfile::new(reliability, durability, 0) }
}

fn topic(name: &str, type_name: &str, publishers: Vec<EndpointInfo>) -> TopicInfo {
    let reliability = publishers.iter().map(|p| p.qos.reliability).min().unwrap_or(Reliability::Reliable);
    let durability = publishers.iter().map(|p| p.qos.durability).min().unwrap_or(Durability::Volatile);
    TopicInfo {
        name: name.to_owned(),
        type_name: type_name.to_owned(),
        qos: QosProfile::new(reliability, durability, 0),
        publishers,
        subscriptions: Vec::new(),
    }
}

fn reliable() -> EndpointInfo {
    endpoint(Reliability::Reliable, Durability::TransientLocal)
}

fn node() -> RecorderNode {
    RecorderNode::new(&Settings::default(), Definitions::default()).expect("the defaults are valid")
}

#[test]
fn a_topic_is_described_then_subscribed_to_once() {
    let mut node = node();
    let graph = Event::Graph(vec![topic("/a", "std_msgs/msg/String", vec![reliable(), reliable()])]);
    let outputs = node.step(Time::default(), graph.clone());
    let [Output::Describe(described), Output::Subscribe { qos, .. }, Output::Info(line)] = &outputs[..] else {
        panic!("got {outputs:?}");
    };
    assert_eq!(described.offered_qos().expect("we wrote it").len(), 1, "two publishers with the same QoS are one");
    assert_eq!((qos.reliability, qos.durability), (Reliability::Reliable, Durability::TransientLocal));
    assert!(qos.depth >= 1_000, "a burst is kept");
    assert_eq!(line, "recording /a (std_msgs/msg/String)");
    assert_eq!(node.step(Time::default(), graph), []);
}

#[test]
fn a_topic_nobody_publishes_is_not_recorded() {
    let graph = Event::Graph(vec![topic("/a", "std_msgs/msg/String", Vec::new())]);
    assert_eq!(node().step(Time::default(), graph), []);
}

#[test]
fn hidden_topics_are_not_recorded() {
    let feedback = "/apprentice/place_object/_action/feedback";
    let of_type = "apprentice_msgs/action/PlaceObject_FeedbackMessage";
    assert_eq!(node().step(Time::default(), Event::Graph(vec![topic(feedback, of_type, vec![reliable()])])), []);
}

#[test]
fn a_publisher_that_offers_less_makes_the_recorder_ask_for_less() {
    let mut node = node();
    node.step(Time::default(), Event::Graph(vec![topic("/a", "std_msgs/msg/String", vec![reliable()])]));
    let weaker = endpoint(Reliability::BestEffort, Durability::Volatile);
    let graph = Event::Graph(vec![topic("/a", "std_msgs/msg/String", vec![reliable(), weaker])]);
    let outputs = node.step(Time::default(), graph.clone());
    assert!(matches!(&outputs[..], [Output::Subscribe { qos, .. }] if qos.reliability == Reliability::BestEffort));
    assert_eq!(node.step(Time::default(), graph), []);
}

#[test]
fn a_second_type_on_a_topic_is_told_once_and_left_out() {
    let mut node = node();
    node.step(Time::default(), Event::Graph(vec![topic("/a", "std_msgs/msg/String", vec![reliable()])]));
    let graph = Event::Graph(vec![
        topic("/a", "std_msgs/msg/String", vec![reliable()]),
        topic("/a", "std_msgs/msg/Bool", vec![reliable()]),
    ]);
    let outputs = node.step(Time::default(), graph.clone());
    assert!(matches!(&outputs[..], [Output::Warn(text)] if text.contains("Bool") && text.contains("String")));
    assert_eq!(node.step(Time::default(), graph), []);
}

#[test]
fn an_unknown_type_is_warned_of_once_and_recorded_all_the_same() {
    let mut node = node();
    let graph = ["/a", "/b"].map(|name| topic(name, "nobody_msgs/msg/Secret", vec![reliable()]));
    let outputs = node.step(Time::default(), Event::Graph(graph.to_vec()));
    let warnings: Vec<_> = outputs.iter().filter(|output| matches!(output, Output::Warn(_))).collect();
    assert_eq!(warnings.len(), 1);
    assert!(format!("{:?}", warnings[0]).contains("message_definition_path"));
    assert_eq!(outputs.iter().filter(|output| matches!(output, Output::Subscribe { .. })).count(), 2);
}

#[test]
fn a_schema_is_put_together_from_definitions_on_disk() {
    let root = tempfile::tempdir().expect("a temporary folder");
    let share = root.path().join("share/shop_msgs/msg");
    fs::create_dir_all(&share).expect("the folder is writable");
    fs::write(share.join("Order.msg"), "std_msgs/Header header\nItem[] items\n").expect("it is writable");
    let extra = root.path().join("extra");
    fs::create_dir_all(extra.join("shop_msgs/msg")).expect("the folder is writable");
    fs::write(extra.join("shop_msgs/msg/Item.msg"), "string name\n").expect("it is writable");

    let definitions = Definitions::new(&[extra.display().to_string()], &root.path().display().to_string());
    let schema = definitions.schema("shop_msgs/msg/Order").expect("all parts are there");
    let rule = "=".repeat(80);
    let parts: Vec<_> =
        schema.split(&format!("\n{rule}\n")).map(|part| part.lines().next().unwrap_or_default()).collect();
    let expected =
        ["std_msgs/Header header", "MSG: std_msgs/Header", "MSG: builtin_interfaces/Time", "MSG: shop_msgs/Item"];
    assert_eq!(parts, expected);
    assert!(definitions.schema("../../etc/passwd").is_err());
    assert!(definitions.schema("shop_msgs/msg/Missing").is_err());
}

#[test]
fn times_a_message_lacks_are_filled_in() {
    let now = Time { sec: 9, nanosec: 1 };
    let write = |received: Time, source_timestamp| {
        let message = RawMessage { received, source_timestamp, cdr: vec![0, 1, 0, 0] };
        match node().step(now, Event::Message { topic: "/a".to_owned(), message }).remove(0) {
            Output::Write { log_time, publish_time, .. } => (log_time, publish_time),
            other => panic!("got {other:?}"),
        }
    };
    let received = Time { sec: 3, nanosec: 5 };
    assert_eq!(write(received, Some(Time { sec: 2, nanosec: 0 })), (3_000_000_005, 2_000_000_000));
    assert_eq!(write(received, None), (3_000_000_005, 3_000_000_005));
    assert_eq!(write(Time::default(), None), (9_000_000_001, 9_000_000_001));
}
