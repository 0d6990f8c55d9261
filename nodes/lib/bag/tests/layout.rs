//! The claims about rosbag2's layout, checked with the `mcap` crate's own reader.

mod common;

use bag::{BagMetadata, Compression, Contents, MetadataError, OfferedQos};
use common::{SECOND, topics, write};
use mcap::records::Record;

#[test]
fn the_file_is_laid_out_as_rosbag2_does() {
    let file = write(Compression::Lz4, true);
    let summary = mcap::Summary::read(&file).expect("it is whole").expect("it has a summary");

    assert_eq!(summary.channels.len(), topics().len(), "one channel per topic");
    for channel in summary.channels.values() {
        assert_eq!(channel.message_encoding, "cdr");
        let schema = channel.schema.as_ref().expect("every channel has a schema, if only an empty text");
        assert_eq!(schema.encoding, "ros2msg");
        assert_eq!(schema.name.split('/').count(), 3, "pkg/msg/Type");
        assert!(channel.metadata.contains_key("offered_qos_profiles"));
    }
    let statistics = summary.stats.expect("statistics are written");
    assert_eq!(statistics.message_count, 6);
    assert_eq!(statistics.chunk_count as usize, summary.chunk_indexes.len());
    assert_eq!((statistics.attachment_count, statistics.metadata_count), (1, 1));
    for index in &summary.chunk_indexes {
        assert_eq!(index.compression, "lz4");
        assert!(!index.message_index_offsets.is_empty(), "every chunk has message indexes");
    }
    let header = mcap::read::LinearReader::new(&file).expect("it is MCAP").next().expect("it has records");
    assert!(matches!(header, Ok(Record::Header(header)) if header.profile == "ros2"));
}

fn contents() -> Contents {
    let file = write(Compression::None, true);
    let reader = bag::BagReader::open(std::io::Cursor::new(file), bag::Limits::default()).expect("it is whole");
    reader.contents().clone()
}

#[test]
fn metadata_yaml_is_version_5_and_says_what_is_in_the_files() {
    let metadata = BagMetadata::from_files([("a_0.mcap", &contents()), ("a_1.mcap", &contents())]);
    let text = metadata.to_yaml();
    assert!(text.starts_with("rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: mcap\n  duration:\n"));
    let parsed = BagMetadata::parse(&text).expect("we wrote it");
    assert_eq!(parsed, metadata);
    assert_eq!(parsed.message_count, 12);
    assert_eq!((parsed.start, parsed.duration), (Some(10 * SECOND), 3 * SECOND));
    assert_eq!(parsed.topics.len(), 3);
    let latched = OfferedQos::list_from_yaml(&parsed.topics[1].offered_qos_profiles).expect("we wrote it");
    assert_eq!(latched[0].depth, 1);
    assert_eq!(parsed.files.iter().map(|f| f.path.as_str()).collect::<Vec<_>>(), ["a_0.mcap", "a_1.mcap"]);
}

#[test]
fn metadata_of_an_empty_bag_and_of_hostile_names_survives_the_way_there_and_back() {
    let empty = BagMetadata::from_files([("empty_0.mcap", &Contents::default())]);
    assert_eq!(BagMetadata::parse(&empty.to_yaml()).expect("we wrote it"), empty);

    let mut hostile = BagMetadata::from_files([("x_0.mcap", &contents())]);
    for name in ["a: b", "\"", "- x", "\\n", "#", "true", "null", "\u{0}", "ünï", "{}", "~", "1e5", ""] {
        hostile.topics[0].name = name.to_owned();
        hostile.topics[0].type_name = format!("{name}\n  version: 9");
        assert_eq!(BagMetadata::parse(&hostile.to_yaml()).as_ref(), Ok(&hostile), "{name:?}");
    }
}

/// As Jazzy and later write it: version 9, QoS as a list with words, more keys.
const VERSION_9: &str = "rosbag2_bagfile_information:
  version: 9
  storage_identifier: mcap
  duration:
    nanoseconds: 2000
  starting_time:
    nanoseconds_since_epoch: 1000
  message_count: 2
  topics_with_message_count:
    - topic_metadata:
        name: /chatter
        type: std_msgs/msg/String
        serialization_format: cdr
        offered_qos_profiles:
          - history: unknown
            depth: 0
            reliability: reliable
            durability: volatile
            deadline:
              sec: 9223372036
              nsec: 854775807
            lifespan:
              sec: 9223372036
              nsec: 854775807
            liveliness: automatic
            liveliness_lease_duration:
              sec: 9223372036
              nsec: 854775807
            avoid_ros_namespace_conventions: false
        type_description_hash: RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18
      message_count: 2
  compression_format: \"\"
  compression_mode: \"\"
  relative_file_paths:
    - other_0.mcap
  files:
    - path: other_0.mcap
      starting_time:
        nanoseconds_since_epoch: 1000
      duration:
        nanoseconds: 2000
      message_count: 2
  custom_data: ~
  ros_distro: jazzy
";

#[test]
fn metadata_of_later_versions_is_read() {
    let metadata = BagMetadata::parse(VERSION_9).expect("it is what Jazzy writes");
    assert_eq!((metadata.start, metadata.duration, metadata.message_count), (Some(1000), 2000, 2));
    let qos = OfferedQos::list_from_yaml(&metadata.topics[0].offered_qos_profiles).expect("it is a list");
    assert_eq!((qos.len(), qos[0].reliability), (1, bag::Reliability::Reliable));
}

#[test]
fn metadata_that_cannot_be_used_says_why() {
    let with = |from: &str, to: &str| BagMetadata::parse(&VERSION_9.replace(from, to));
    for path in ["/etc/passwd", "../other_0.mcap", "a/../../b.mcap", "\"\"", "\"..\\\\x\""] {
        let error = with("- other_0.mcap", &format!("- {path}"));
        assert!(matches!(error, Err(MetadataError::PathOutside { .. })), "{path}: {error:?}");
    }
    assert_eq!(with("version: 9", "version: 10"), Err(MetadataError::Version { got: 10 }));
    let sqlite = with("storage_identifier: mcap", "storage_identifier: sqlite3").expect_err("not ours").to_string();
    assert!(sqlite.contains("sqlite3") && sqlite.contains("ros2 bag convert"), "{sqlite}");
    assert!(matches!(with("compression_mode: \"\"", "compression_mode: FILE"), Err(MetadataError::Compressed { .. })));
    let error = BagMetadata::parse("hello: [").expect_err("not YAML").to_string();
    assert_eq!(error.lines().count(), 1, "{error}");
    assert!(matches!(BagMetadata::parse(&" ".repeat(5 << 20)), Err(MetadataError::TooLong { .. })));
}
