//! The tape on disk: flushed messages survive a kill, files are split, and every topic is described in each of them.

use std::path::Path;

use bag::{Compression, OfferedQos, Topic};
use bag_files::{METADATA_FILE, list_files, open_bag};
use session_recorder::{Tape, TapeError, TapeSettings};

fn settings(folder: &Path, max_bytes_per_file: u64) -> TapeSettings {
    TapeSettings {
        folder: folder.to_owned(),
        compression: Compression::Lz4,
        max_bytes_per_file,
        commit: "abc".to_owned(),
        start_ns: 0,
    }
}

fn topic(name: &str) -> Topic {
    Topic::ros2(name, "std_msgs/msg/String", "string data\n", &[OfferedQos::default()])
}

fn times(folder: &Path) -> Vec<u64> {
    let bag = open_bag(folder).expect("it is a bag");
    bag.messages().map(|message| message.expect("it is readable").log_time).collect()
}

#[test]
fn what_was_flushed_survives_a_kill_and_the_next_tape_continues() {
    let root = tempfile::tempdir().expect("a temporary folder");
    let folder = root.path().join("killed");
    let (mut tape, notes) = Tape::start(settings(&folder, 0)).expect("the folder is writable");
    assert!(notes.is_empty());
    assert!(folder.join(METADATA_FILE).exists(), "the folder opens from the start");
    assert_eq!(times(&folder), [0_u64; 0]);
    tape.describe(&topic("/a")).expect("the disk has room");
    for time in 1..=3 {
        tape.write("/a", time, time, &[0, 1, 0, 0, 9]).expect("the disk has room");
    }
    tape.flush().expect("the disk has room");
    tape.write("/a", 4, 4, &[0, 1, 0, 0, 9]).expect("the disk has room");
    // Killed: no destructor runs, and what was not flushed is lost.
    std::mem::forget(tape);
    assert_eq!(times(&folder), [1, 2, 3]);

    let (mut tape, notes) = Tape::start(settings(&folder, 0)).expect("the folder is writable");
    assert_eq!(notes, ["finished killed_0.mcap of an earlier recording: 3 messages"]);
    tape.describe(&topic("/a")).expect("the disk has room");
    tape.write("/a", 5, 5, &[0, 1, 0, 0, 9]).expect("the disk has room");
    let metadata = tape.finish().expect("the disk has room");
    assert_eq!(metadata.message_count, 4);
    assert_eq!(times(&folder), [1, 2, 3, 5]);
    assert_eq!(open_bag(&folder).expect("it is whole").damage().count(), 0);
}

#[test]
fn a_full_file_is_followed_by_one_that_describes_the_same_topics() {
    let root = tempfile::tempdir().expect("a temporary folder");
    let (mut tape, _) = Tape::start(settings(root.path(), 4_000)).expect("the folder is writable");
    tape.describe(&topic("/a")).expect("the disk has room");
    tape.describe(&topic("/silent")).expect("the disk has room");
    for time in 1..=40 {
        tape.write("/a", time, time, &[7; 500]).expect("the disk has room");
    }
    let metadata = tape.finish().expect("the disk has room");
    assert!(metadata.files.len() >= 4, "20 kB in files of about 4 kB, got {}", metadata.files.len());
    assert!(metadata.files.iter().all(|file| file.message_count > 0));
    assert_eq!(metadata.message_count, 40);
    assert_eq!(times(root.path()), (1..=40).collect::<Vec<_>>());
    for path in list_files(root.path()).expect("it is readable") {
        let file = open_bag(&path).expect("each file is a bag");
        assert_eq!(file.topics().len(), 2, "{}", path.display());
    }
}

#[test]
fn a_message_without_a_description_is_refused_by_topic() {
    let root = tempfile::tempdir().expect("a temporary folder");
    let (mut tape, _) = Tape::start(settings(root.path(), 0)).expect("the folder is writable");
    let error = tape.write("/b", 1, 1, &[0, 1, 0, 0]).expect_err("it was not described");
    assert!(matches!(&error, TapeError::Undescribed { topic } if topic == "/b"));
}

#[test]
fn a_damaged_bag_is_saved_and_told_before_recording_continues() {
    let root = tempfile::tempdir().expect("a temporary folder");
    let folder = root.path().join("cut");
    let (mut tape, _) = Tape::start(settings(&folder, 0)).expect("the folder is writable");
    tape.describe(&topic("/a")).expect("the disk has room");
    for time in 1..=3 {
        tape.write("/a", time, time, &[0, 1, 0, 0, 9]).expect("the disk has room");
        tape.flush().expect("the disk has room");
    }
    std::mem::forget(tape);
    let path = folder.join("cut_0.mcap");
    let whole = std::fs::read(&path).expect("we wrote it");
    std::fs::write(&path, &whole[..whole.len() - 5]).expect("the folder is writable");

    let (tape, notes) = Tape::start(settings(&folder, 0)).expect("the folder is writable");
    assert_eq!(notes.len(), 1);
    assert!(notes[0].starts_with("saved ") && notes[0].contains("cut_0.mcap.damaged"), "{}", notes[0]);
    tape.finish().expect("the disk has room");
    assert!(times(&folder).starts_with(&[1, 2]));
}
