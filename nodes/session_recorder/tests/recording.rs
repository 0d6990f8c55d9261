//! The recorder on an in-memory graph: any topic, byte for byte, with its QoS, schema and what explains it.

mod common;

use std::fs;

use apprentice_msgs::{std_msgs, to_cdr};
use bag::{Durability, Reliability};
use bag_files::{METADATA_FILE, open_bag};
use bus::{MemoryGraph, Qos};
use common::{arguments, record, recorded, talker, wait_for_messages, wait_for_recorder};

#[test]
fn any_topic_is_recorded_byte_for_byte_with_its_qos_and_schema() {
    let root = tempfile::tempdir().expect("a temporary folder");
    let folder = root.path().join("session");
    let graph = MemoryGraph::new();
    let mut talker = talker(&graph);
    let latched = talker.publisher_raw("/latched", "std_msgs/msg/String", Qos::State.profile()).expect("a fine topic");
    let before = to_cdr(&std_msgs::String { data: "published before the recorder started".to_owned() });
    latched.publish(&before).expect("it is CDR");
    let secret =
        talker.publisher_raw("/secret", "nobody_msgs/msg/Secret", Qos::Stream.profile()).expect("a fine topic");

    let recorder = record(&graph, &folder, &[]);
    wait_for_recorder(&secret);
    let bytes: Vec<Vec<u8>> = (0..50_u8).map(|i| vec![0, 1, 0, 0, i, 255 - i, 7]).collect();
    bytes.iter().for_each(|cdr| secret.publish(cdr).expect("it is CDR"));

    // A topic that appears while recording.
    let late = talker.publisher_raw("/late", "std_msgs/msg/Bool", Qos::Event.profile()).expect("a fine topic");
    wait_for_recorder(&late);
    late.publish(&[0, 1, 0, 0, 1]).expect("it is CDR");
    wait_for_messages(&folder, "/late", 1);
    wait_for_messages(&folder, "/secret", bytes.len());
    wait_for_messages(&folder, "/latched", 1);
    graph.shutdown();
    recorder.join().expect("it does not panic").expect("it ends well");

    assert_eq!(recorded(&folder, "/secret").into_iter().map(|m| m.data).collect::<Vec<_>>(), bytes);
    assert_eq!(recorded(&folder, "/latched")[0].data, before);
    assert_eq!(recorded(&folder, "/late")[0].data, [0, 1, 0, 0, 1]);

    let bag = open_bag(&folder).expect("it is whole");
    assert_eq!(bag.damage().count(), 0, "the bag is finished");
    let topic = |name: &str| bag.topics().into_iter().find(|t| t.topic.name == name).expect("it is recorded").topic;
    let qos = topic("/latched").offered_qos().expect("we wrote it")[0].clone();
    assert_eq!((qos.durability, qos.reliability), (Durability::TransientLocal, Reliability::Reliable));
    assert_eq!(topic("/secret").offered_qos().expect("we wrote it")[0].reliability, Reliability::BestEffort);
    assert_eq!(topic("/latched").schema, apprentice_msgs::schema("std_msgs/msg/String").expect("known").as_bytes());
    assert!(topic("/secret").schema.is_empty(), "nobody knows the type");
    assert_eq!(topic("/secret").type_name, "nobody_msgs/msg/Secret");
}

#[test]
fn settings_and_robot_are_attached_and_versions_are_noted() {
    let root = tempfile::tempdir().expect("a temporary folder");
    let folder = root.path().join("session");
    let graph = MemoryGraph::new();
    let mut talker = talker(&graph);
    let robot = talker.publisher("/robot_description", Qos::State).expect("a fine topic");
    robot.publish(&std_msgs::String { data: "<robot name=\"r\"/>".to_owned() }).expect("it is a string");
    let recorder = record(&graph, &folder, &[]);
    wait_for_messages(&folder, "/robot_description", 1);
    wait_for_messages(&folder, "/apprentice/settings", 2);
    graph.shutdown();
    recorder.join().expect("it does not panic").expect("it ends well");

    let bag = open_bag(&folder).expect("it is whole");
    let attached = bag.attachments().expect("they are whole");
    let names: Vec<_> = attached.iter().map(|attachment| attachment.name.as_str()).collect();
    let expected = ["parameters/apprentice.session_recorder.yaml", "parameters/apprentice.talker.yaml", "robot.urdf"];
    assert_eq!(names, expected);
    assert!(String::from_utf8_lossy(&attached[0].data).contains("flush_period_s: 0.05"));
    assert_eq!(attached[2].data, b"<robot name=\"r\"/>");
    let records = &bag.files[0].metadata;
    assert_eq!(records[0].values["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(records[1].values["/apprentice/talker seed"], "0");
}

#[test]
fn only_chosen_topics_are_recorded() {
    let root = tempfile::tempdir().expect("a temporary folder");
    let folder = root.path().join("session");
    let graph = MemoryGraph::new();
    let mut talker = talker(&graph);
    let publishers = ["/a/one", "/a/two", "/b/one"].map(|topic| {
        let publisher = talker.publisher_raw(topic, "std_msgs/msg/Bool", Qos::Log.profile()).expect("a fine topic");
        publisher.publish(&[0, 1, 0, 0, 1]).expect("it is CDR");
        publisher
    });
    let recorder = record(&graph, &folder, &[("topics", "['/a/.*', '/b/one']"), ("exclude", "['.*/two']")]);
    wait_for_messages(&folder, "/a/one", 1);
    wait_for_messages(&folder, "/b/one", 1);
    graph.shutdown();
    recorder.join().expect("it does not panic").expect("it ends well");
    let bag = open_bag(&folder).expect("it is whole");
    assert_eq!(bag.topics().iter().map(|t| t.topic.name.as_str()).collect::<Vec<_>>(), ["/a/one", "/b/one"]);
    assert_eq!(publishers.map(|publisher| publisher.subscriptions()), [0, 0, 0], "the recorder is gone");
}

#[test]
fn a_recorder_that_starts_again_on_its_folder_continues_in_a_new_file() {
    let root = tempfile::tempdir().expect("a temporary folder");
    let folder = root.path().join("session");
    for round in 0..3_u8 {
        let graph = MemoryGraph::new();
        let mut talker = talker(&graph);
        let publisher = talker.publisher_raw("/round", "std_msgs/msg/UInt8", Qos::Log.profile()).expect("a fine topic");
        publisher.publish(&[0, 1, 0, 0, round]).expect("it is CDR");
        let recorder = record(&graph, &folder, &[]);
        wait_for_messages(&folder, "/round", usize::from(round) + 1);
        graph.shutdown();
        recorder.join().expect("it does not panic").expect("it ends well");
    }
    let rounds: Vec<_> = recorded(&folder, "/round").into_iter().map(|message| message.data[4]).collect();
    assert_eq!(rounds, [0, 1, 2]);
    let bag = open_bag(&folder.join(METADATA_FILE)).expect("it is whole");
    let names: Vec<_> = bag.metadata.files.iter().map(|file| file.path.as_str()).collect();
    assert_eq!(names, ["session_0.mcap", "session_1.mcap", "session_2.mcap"]);
}

#[test]
fn a_folder_that_cannot_be_used_is_one_clear_error_and_exit_code_2() {
    let root = tempfile::tempdir().expect("a temporary folder");
    let occupied = root.path().join("occupied");
    fs::create_dir(&occupied).expect("the folder is writable");
    fs::write(occupied.join("thesis.txt"), "months of work").expect("the folder is writable");
    let below_a_file = occupied.join("thesis.txt").join("bag");
    for (folder, word) in [(&occupied, "thesis.txt"), (&below_a_file, "create the folder")] {
        let graph = MemoryGraph::new();
        let error = record(&graph, folder, &[]).join().expect("it does not panic").expect_err("it cannot record there");
        assert_eq!(error.exit_code(), 2);
        assert!(error.to_string().contains(word), "{error}");
        assert_eq!(error.to_string().lines().count(), 1);
    }
    assert_eq!(fs::read_to_string(occupied.join("thesis.txt")).expect("it is untouched"), "months of work");
}

#[test]
fn wrong_parameters_are_refused_by_name() {
    for (name, value) in [("compression", "brotli"), ("topics", "['(']"), ("flush_period_s", "0.0"), ("outptu", "x")] {
        let graph = bus::Graph::Memory(MemoryGraph::new());
        let error = session_recorder::run(&graph, &arguments(&[(name, value)])).expect_err("it is wrong");
        assert_eq!(error.exit_code(), 2);
        assert!(error.to_string().contains(name), "{error}");
    }
}
