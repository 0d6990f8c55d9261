//! What is written is read back, byte for byte and in the right order.

mod common;

use std::io::Cursor;

use bag::{BagError, BagReader, BagWriter, Compression, Limits, Topic, WriterOptions, recover};
use common::{SECOND, attachment, messages, metadata, topics, write};
use proptest::prelude::{ProptestConfig, any, prop, prop_assert_eq, proptest};

#[test]
fn every_message_comes_back_in_the_order_of_log_times_with_its_bytes() {
    for compression in [Compression::None, Compression::Lz4] {
        let mut reader =
            BagReader::open(Cursor::new(write(compression, true)), Limits::default()).expect("it is whole");
        let read: Vec<_> = reader.messages().collect::<Result<_, _>>().expect("it is whole");
        // A stable sort by time is what "log time, then file order" means.
        let mut expected = messages();
        expected.sort_by_key(|(_, time, _)| *time);
        assert_eq!(read.len(), expected.len());
        for (message, (topic, time, cdr)) in read.iter().zip(&expected) {
            assert_eq!(*message.topic, topics()[*topic]);
            assert_eq!((message.log_time, message.publish_time), (*time, *time));
            assert_eq!(&message.data, cdr);
        }
        assert_eq!(reader.attachments().expect("it is whole"), [attachment()]);
        assert_eq!(reader.metadata(), [metadata()]);
        assert!(reader.damage().is_empty());
    }
}

#[test]
fn the_contents_count_topics_messages_and_times() {
    let reader = BagReader::open(Cursor::new(write(Compression::None, true)), Limits::default()).expect("it is whole");
    let contents = reader.contents();
    assert_eq!(contents.profile, "ros2");
    assert_eq!(contents.message_count, 6);
    assert_eq!((contents.start, contents.end), (Some(10 * SECOND), Some(13 * SECOND)));
    assert_eq!(contents.duration(), 3 * SECOND);
    let counts: Vec<_> = contents.topics.iter().map(|t| (t.topic.name.as_str(), t.message_count)).collect();
    assert_eq!(counts, [("/chatter", 4), ("/latched", 1), ("/unknown", 1)]);
    let latched = contents.topics[1].topic.offered_qos().expect("we wrote it");
    assert_eq!(latched[0].durability, bag::Durability::TransientLocal);
}

#[test]
fn the_writer_knows_what_it_wrote() {
    let mut writer = BagWriter::new(Vec::new(), &WriterOptions::default()).expect("a vector takes everything");
    let id = writer.add_topic(&topics()[0]).expect("it fits");
    writer.write(id, 5, 4, &[0, 1, 0, 0]).expect("it fits");
    let (file, contents) = writer.finish().expect("a vector takes everything");
    let reader = BagReader::open(Cursor::new(file), Limits::default()).expect("it is whole");
    assert_eq!(*reader.contents(), contents);
}

#[test]
fn an_empty_bag_has_no_times() {
    let writer = BagWriter::new(Vec::new(), &WriterOptions::default()).expect("a vector takes everything");
    let (file, _) = writer.finish().expect("a vector takes everything");
    let mut reader = BagReader::open(Cursor::new(file), Limits::default()).expect("it is whole");
    assert_eq!((reader.contents().start, reader.contents().end, reader.contents().duration()), (None, None, 0));
    assert_eq!(reader.messages().count(), 0);
}

#[test]
fn the_same_topic_twice_is_one_channel_and_another_type_is_refused() {
    let mut writer = BagWriter::new(Vec::new(), &WriterOptions::default()).expect("a vector takes everything");
    let first = writer.add_topic(&topics()[0]).expect("it fits");
    assert_eq!(writer.add_topic(&topics()[0]).expect("it is the same"), first);
    let other = Topic::ros2("/chatter", "std_msgs/msg/Bool", "bool data", &[]);
    let error = writer.add_topic(&other).expect_err("it has another type");
    assert!(matches!(&error, BagError::TopicConflict { got, expected, .. }
        if got == "std_msgs/msg/Bool" && expected == "std_msgs/msg/String"));
    writer.write(first, 1, 1, &[0, 1, 0, 0]).expect("a refused topic does not break the writer");
}

#[test]
fn the_mcap_crates_own_reader_reads_the_same() {
    let file = write(Compression::Lz4, true);
    let read: Vec<_> = mcap::MessageStream::new(&file)
        .expect("it is MCAP")
        .map(|message| message.map(|m| (m.channel.topic.clone(), m.log_time, m.data.to_vec())))
        .collect::<Result<_, _>>()
        .expect("it is whole");
    let names = topics();
    let expected: Vec<_> = messages().into_iter().map(|(t, time, cdr)| (names[t].name.clone(), time, cdr)).collect();
    assert_eq!(read, expected);
}

#[test]
fn a_bag_of_others_without_chunks_or_statistics_is_read() {
    let mut file = Cursor::new(Vec::new());
    let mut writer = mcap::WriteOptions::new()
        .use_chunks(false)
        .emit_summary_records(false)
        .create(&mut file)
        .expect("a vector takes everything");
    let schema = writer.add_schema("std_msgs/msg/String", "ros2msg", b"string data").expect("it fits");
    let channel = writer.add_channel(schema, "/loose", "cdr", &Default::default()).expect("it fits");
    for time in [3_u64, 1, 2] {
        let header = mcap::records::MessageHeader { channel_id: channel, sequence: 0, log_time: time, publish_time: 0 };
        writer.write_to_known_channel(&header, &[time as u8]).expect("it fits");
    }
    writer.finish().expect("a vector takes everything");
    drop(writer);
    let mut reader = BagReader::open(file, Limits::default()).expect("it is whole");
    assert_eq!((reader.contents().start, reader.contents().end), (Some(1), Some(3)));
    let read: Vec<_> = reader.messages().map(|m| m.map(|m| m.data)).collect::<Result<_, _>>().expect("it is whole");
    assert_eq!(read, [[1], [2], [3]]);
}

#[test]
fn recovering_a_whole_bag_changes_no_message() {
    let file = write(Compression::None, true);
    let mut output = Vec::new();
    let report =
        recover(Cursor::new(&file), &mut output, Limits::default(), &WriterOptions::default()).expect("it is whole");
    assert!(report.damage.is_empty() && report.complete());
    let all = |bytes: &[u8]| -> Vec<_> {
        let mut reader = BagReader::open(Cursor::new(bytes), Limits::default()).expect("it is whole");
        let messages: Vec<_> = reader.messages().collect::<Result<_, _>>().expect("it is whole");
        (messages, reader.attachments().expect("it is whole")).0
    };
    assert_eq!(all(&file), all(&output));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Any messages at any times, in chunks of any size: a stable sort by log time.
    #[test]
    fn any_messages_come_back_sorted_by_time_then_file_order(
        sent in prop::collection::vec((0..3_usize, 0..50_u64, prop::collection::vec(any::<u8>(), 0..40)), 0..60),
        chunk_bytes in 1..400_u64,
        lz4 in any::<bool>(),
    ) {
        let compression = if lz4 { Compression::Lz4 } else { Compression::None };
        let options = WriterOptions { compression, chunk_bytes, ..WriterOptions::default() };
        let mut writer = BagWriter::new(Vec::new(), &options).expect("a vector takes everything");
        let ids: Vec<_> = topics().iter().map(|topic| writer.add_topic(topic).expect("they fit")).collect();
        for (topic, time, cdr) in &sent {
            writer.write(ids[*topic], *time, *time, cdr).expect("it fits");
        }
        let (file, _) = writer.finish().expect("a vector takes everything");
        let mut reader = BagReader::open(Cursor::new(file), Limits::default()).expect("it is whole");
        let read: Vec<_> = reader
            .messages()
            .map(|m| m.map(|m| (m.topic.name.clone(), m.log_time, m.data)))
            .collect::<Result<_, _>>()
            .expect("it is whole");
        let mut expected: Vec<_> =
            sent.into_iter().map(|(topic, time, cdr)| (topics()[topic].name.clone(), time, cdr)).collect();
        expected.sort_by_key(|(_, time, _)| *time);
        prop_assert_eq!(read, expected);
    }
}

/// Takes so many bytes, then is full.
struct Disk(usize);

impl std::io::Write for Disk {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let taken = bytes.len().min(self.0);
        self.0 -= taken;
        if taken == 0 { Err(std::io::Error::from(std::io::ErrorKind::StorageFull)) } else { Ok(taken) }
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_an_error_at_any_byte_and_nothing_is_written_after_it() {
    let whole = write(Compression::None, true).len();
    for room in 0..whole {
        let Ok(mut writer) = BagWriter::new(Disk(room), &WriterOptions::default()) else { continue };
        let mut write_all = || -> Result<(), BagError> {
            for (topic, time, cdr) in messages() {
                let id = writer.add_topic(&topics()[topic])?;
                writer.write(id, time, time, &cdr)?;
                writer.flush()?;
            }
            Ok(())
        };
        match write_all() {
            Ok(()) => assert!(matches!(writer.finish(), Ok(_) | Err(BagError::Write(_)))),
            Err(error) => {
                assert!(matches!(&error, BagError::Write(e) if e.kind() == std::io::ErrorKind::StorageFull), "{error}");
                assert!(matches!(writer.flush(), Err(BagError::WriterBroken)));
            }
        }
    }
}
