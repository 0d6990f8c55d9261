//! A small bag of three topics for the tests.
#![allow(dead_code, reason = "each test file uses a part")]

use std::collections::BTreeMap;

use bag::{Attachment, BagWriter, Compression, Durability, MetadataRecord, OfferedQos, Topic, WriterOptions};

pub const SECOND: u64 = 1_000_000_000;

/// CDR of a std_msgs/msg/String, with its header.
pub fn string_cdr(text: &str) -> Vec<u8> {
    let mut cdr = vec![0, 1, 0, 0];
    cdr.extend_from_slice(&(text.len() as u32 + 1).to_le_bytes());
    cdr.extend_from_slice(text.as_bytes());
    cdr.push(0);
    cdr
}

pub fn topics() -> Vec<Topic> {
    let latched = OfferedQos { durability: Durability::TransientLocal, depth: 1, ..OfferedQos::default() };
    vec![
        Topic::ros2("/chatter", "std_msgs/msg/String", "string data\n", &[OfferedQos::default()]),
        Topic::ros2("/latched", "std_msgs/msg/String", "string data\n", &[latched]),
        Topic::ros2("/unknown", "nobody_msgs/msg/Secret", "", &[]),
    ]
}

/// (topic, log time, bytes) in file order.
pub fn messages() -> Vec<(usize, u64, Vec<u8>)> {
    vec![
        (1, 10 * SECOND, string_cdr("latched once")),
        (0, 11 * SECOND, string_cdr("a")),
        (0, 12 * SECOND, string_cdr("b")),
        (2, 12 * SECOND, vec![0, 1, 0, 0, 255]),
        // Late: it was received before the two above.
        (0, 11 * SECOND + 1, string_cdr("late")),
        (0, 13 * SECOND, string_cdr(&"long ".repeat(20))),
    ]
}

pub fn attachment() -> Attachment {
    Attachment {
        log_time: 10 * SECOND,
        create_time: 0,
        name: "robot.urdf".to_owned(),
        media_type: "application/xml".to_owned(),
        data: b"<robot name=\"r\"/>".to_vec(),
    }
}

pub fn metadata() -> MetadataRecord {
    MetadataRecord { name: "apprentice".to_owned(), values: BTreeMap::from([("seed".to_owned(), "7".to_owned())]) }
}

/// Writes the bag; a chunk is closed after every second message.
pub fn write(compression: Compression, finish: bool) -> Vec<u8> {
    let mut file = Vec::new();
    let options = WriterOptions { compression, ..WriterOptions::default() };
    let mut writer = BagWriter::new(&mut file, &options).expect("a vector takes everything");
    let ids: Vec<_> = topics().iter().map(|topic| writer.add_topic(topic).expect("they fit")).collect();
    for (i, (topic, time, cdr)) in messages().iter().enumerate() {
        writer.write(ids[*topic], *time, *time, cdr).expect("it fits");
        if i % 2 == 1 {
            writer.flush().expect("a vector takes everything");
        }
    }
    writer.attach(&attachment()).expect("it fits");
    writer.add_metadata(&metadata()).expect("it fits");
    if finish {
        writer.finish().expect("a vector takes everything");
    } else {
        writer.flush().expect("a vector takes everything");
        // A killed process runs no destructor.
        std::mem::forget(writer);
    }
    file
}
