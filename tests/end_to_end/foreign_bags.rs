//! Bags of ours in the hands of others' readers, and a bag of others in the hands of our player.

use crate::python;
use crate::recorded::Recorded;
use crate::suite::{Process, Turn, apprentice, fresh_domain, fresh_folder, now};
use crate::taught::flowers;
use rustix::process::{Signal, kill_process};
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::Path;
use std::time::Duration;

const LIMIT: Duration = Duration::from_secs(120);

/// SHA-256 over log times and bytes of each topic, as `read_bag.py` makes it.
fn digests(bag: &Recorded) -> BTreeMap<String, String> {
    let mut digests: BTreeMap<String, Sha256> = BTreeMap::new();
    for message in &bag.messages {
        let digest = digests.entry(message.topic.name.clone()).or_default();
        digest.update(message.log_time.to_le_bytes());
        digest.update(&message.data);
    }
    let hex = |digest: Sha256| digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
    digests.into_iter().map(|(topic, digest)| (topic, hex(digest))).collect()
}

#[test]
fn a_bag_of_ours_is_read_by_rosbags_mcap_and_mcap_ros2_support() {
    let folder = flowers().bag;
    let bag = Recorded::read(&folder).expect("the bag opens");
    let ours = digests(&bag);
    let report = python::run(python::script("read_bag.py", &[&folder.to_string_lossy()]), "read_bag.py", LIMIT);
    for reader in ["rosbags", "mcap", "mcap_ros2"] {
        assert_eq!(report[reader]["message_count"], bag.messages.len(), "{reader}");
        let topics = report[reader]["topics"].as_object().expect("topics");
        for (topic, digest) in &ours {
            assert_eq!(topics[topic]["digest"], digest.as_str(), "{reader}: other bytes on {topic}");
        }
        if reader != "mcap" {
            let undecoded: Vec<_> = topics.iter().filter(|(_, topic)| topic["decoded"] != topic["count"]).collect();
            assert!(undecoded.is_empty(), "{reader} could not decode {undecoded:#?}");
        }
    }
    assert_eq!(report["rosbags"]["metadata"]["message_count"], bag.messages.len(), "metadata.yaml");
    let offered = report["rosbags"]["qos_profiles"].as_object().expect("qualities of service");
    for topic in ["/apprentice/posterior", "/apprentice/demonstration"] {
        assert!(offered[topic].as_u64() > Some(0), "{topic} has no quality of service: {offered:?}");
    }
    let attachments = report["mcap"]["attachments"].to_string();
    assert!(attachments.contains("urdf"), "the robot is attached: {attachments}");
}

#[test]
fn a_bag_written_by_rosbags_is_played_and_every_byte_arrives() {
    let _turn = Turn::take();
    let folder = fresh_folder("foreign");
    let (theirs, ours) = (folder.join("theirs"), folder.join("ours"));
    let written = python::run(python::script("write_bag.py", &[&theirs.to_string_lossy()]), "write_bag.py", LIMIT);
    let domain = fresh_domain();
    let output = format!("output:={}", ours.display());
    let recording = ["session_recorder", "--ros-args", "-p", &output];
    let mut recorder = Process::start(apprentice(domain, &recording), "session_recorder");
    wait_until("the recorder records", &recorder, || ours.join("metadata.yaml").is_file());

    let bag = format!("bag:={}", theirs.display());
    let playing = ["bag_player", "--ros-args", "-p", &bag, "-p", "delay_s:=3.0"];
    let mut player = Process::start(apprentice(domain, &playing), "bag_player");
    let status = player.wait(LIMIT);
    assert!(status.success(), "{status}\n{}", player.dump());
    let expected = played(&written);
    let n: usize = expected.values().map(Vec::len).sum();
    wait_until("everything is recorded", &recorder, || received(&ours).values().map(Vec::len).sum::<usize>() >= n);
    kill_process(recorder.pid(), Signal::INT).expect("the recorder runs");
    assert!(recorder.wait(LIMIT).success(), "{}", recorder.dump());
    assert_eq!(unpadded(received(&ours), &expected), expected);
    assert!(Recorded::read(&ours).expect("the bag opens").whole);
}

/// Messages of the foreign bag: for each topic its type and the bytes in order, in hexadecimal.
fn played(written: &Value) -> BTreeMap<String, Vec<String>> {
    let mut topics: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for message in written["messages"].as_array().expect("messages") {
        let [topic, bytes] = ["topic", "cdr"].map(|name| message[name].as_str().expect("text").to_owned());
        topics.entry(topic).or_default().push(bytes);
    }
    topics
}

/// The same of what was recorded, of those topics only.
fn received(bag: &Path) -> BTreeMap<String, Vec<String>> {
    let mut topics: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for message in Recorded::read(bag).map(|bag| bag.messages).unwrap_or_default() {
        if ["/robot_name", "/velocity", "/shop/shelf"].contains(&message.topic.name.as_str()) {
            let bytes = message.data.iter().map(|byte| format!("{byte:02x}")).collect();
            topics.entry(message.topic.name.clone()).or_default().push(bytes);
        }
    }
    topics
}

/// DDS pads a message with zeros to a multiple of four bytes; this takes them off again, and nothing else.
fn unpadded(
    mut got: BTreeMap<String, Vec<String>>,
    expected: &BTreeMap<String, Vec<String>>,
) -> BTreeMap<String, Vec<String>> {
    for (topic, messages) in &mut got {
        for (message, wanted) in messages.iter_mut().zip(&expected[topic]) {
            let padding = message.strip_prefix(wanted.as_str()).unwrap_or_default();
            if ["00", "0000", "000000"].contains(&padding) {
                message.truncate(wanted.len());
            }
        }
    }
    got
}

fn wait_until(what: &str, process: &Process, mut holds: impl FnMut() -> bool) {
    let start = now();
    while !holds() {
        assert!(start.elapsed() < Duration::from_secs(30), "waited in vain until {what}\n{}", process.dump());
        std::thread::sleep(Duration::from_millis(50));
    }
}
