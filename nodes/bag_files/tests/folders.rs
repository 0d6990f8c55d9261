//! Bag folders: opened by any of their paths, recovered where they are, and refused with the reason.

use std::fs;
use std::path::Path;

use bag::{BagWriter, Contents, OfferedQos, Topic, WriterOptions};
use bag_files::{
    BagFilesError, BagInfo, METADATA_FILE, Recovered, create_folder, file_name, list_files, next_index, open_bag,
    recover_in_place, write_metadata,
};

/// Writes the `index`-th file with messages at these times; gives its contents.
fn write_file(folder: &Path, index: u64, times: &[u64], finish: bool) -> Contents {
    let topic = Topic::ros2("/count", "std_msgs/msg/UInt64", "uint64 data\n", &[OfferedQos::default()]);
    let mut bytes = Vec::new();
    let mut writer = BagWriter::new(&mut bytes, &WriterOptions::default()).expect("a vector takes everything");
    let id = writer.add_topic(&topic).expect("it fits");
    for time in times {
        let mut cdr = vec![0, 1, 0, 0];
        cdr.extend_from_slice(&time.to_le_bytes());
        writer.write(id, *time, *time, &cdr).expect("it fits");
    }
    let contents = writer.contents();
    if finish {
        writer.finish().expect("a vector takes everything");
    } else {
        writer.flush().expect("a vector takes everything");
        // A killed process runs no destructor.
        std::mem::forget(writer);
    }
    fs::write(folder.join(file_name(folder, index)), bytes).expect("the folder is writable");
    contents
}

fn times(path: &Path) -> Vec<u64> {
    let bag = open_bag(path).expect("it is a bag");
    bag.messages().map(|message| message.expect("it is readable").log_time).collect()
}

#[test]
fn a_folder_its_metadata_and_its_bare_file_open_as_the_same_bag() {
    let root = tempfile::tempdir().expect("a temporary folder");
    let folder = root.path().join("session");
    create_folder(&folder).expect("it is new");
    let contents = write_file(&folder, 0, &[3, 1, 2], true);
    let name = file_name(&folder, 0);
    write_metadata(&folder, &bag::BagMetadata::from_files([(name.as_str(), &contents)])).expect("it is writable");
    for path in [folder.clone(), folder.join(METADATA_FILE), folder.join(&name)] {
        assert_eq!(times(&path), [1, 2, 3], "{}", path.display());
    }
    assert_eq!(name, "session_0.mcap");
}

#[test]
fn split_files_are_one_stream_by_time_then_file() {
    let root = tempfile::tempdir().expect("a temporary folder");
    write_file(root.path(), 0, &[1, 5, 9], true);
    write_file(root.path(), 1, &[5, 6], true);
    // Ten follows nine, not one.
    write_file(root.path(), 10, &[20], true);
    write_file(root.path(), 9, &[10], true);
    assert_eq!(times(root.path()), [1, 5, 5, 6, 9, 10, 20]);
    let bag = open_bag(root.path()).expect("it is a bag");
    assert_eq!((bag.metadata.message_count, bag.metadata.start, bag.metadata.duration), (7, Some(1), 19));
    assert_eq!(bag.topics()[0].message_count, 7);
    assert_eq!(next_index(root.path()).expect("it is readable"), 11);
}

#[test]
fn an_unfinished_file_opens_with_a_word_and_recovery_finishes_it() {
    let root = tempfile::tempdir().expect("a temporary folder");
    write_file(root.path(), 0, &[1, 2], true);
    write_file(root.path(), 1, &[3, 4], false);
    fs::write(root.path().join(file_name(root.path(), 2)), b"").expect("the folder is writable");
    assert!(open_bag(root.path()).is_err(), "an empty file is no MCAP file");

    let files = recover_in_place(root.path()).expect("it is a bag");
    let outcomes: Vec<_> = files.iter().map(|file| &file.outcome).collect();
    assert_eq!(outcomes, [&Recovered::Whole, &Recovered::Finished, &Recovered::Finished]);
    assert_eq!(times(&root.path().join(METADATA_FILE)), [1, 2, 3, 4]);
    let bag = open_bag(root.path()).expect("it is a bag");
    assert_eq!(bag.damage().count(), 0);
    assert_eq!(list_files(root.path()).expect("it is readable").len(), 3, "nothing is left beside the bag");
}

#[test]
fn a_cut_file_is_salvaged_and_the_original_is_kept() {
    let root = tempfile::tempdir().expect("a temporary folder");
    write_file(root.path(), 0, &[1, 2], true);
    let path = root.path().join(file_name(root.path(), 0));
    let whole = fs::read(&path).expect("we wrote it");
    fs::write(&path, &whole[..whole.len() / 3]).expect("the folder is writable");
    let cut = open_bag(root.path()).expect("it opens up to the cut");
    assert!(cut.damage().next().expect("it is cut").1.to_string().contains("cut short"));

    let files = recover_in_place(root.path()).expect("it is a bag");
    let Recovered::Salvaged { damage, original } = &files[0].outcome else {
        panic!("got {:?}", files[0].outcome);
    };
    assert_eq!(damage.len(), 1);
    assert_eq!(fs::read(original).expect("it is kept"), &whole[..whole.len() / 3]);
    assert_eq!(open_bag(root.path()).expect("it is whole").damage().count(), 0);
    assert_eq!(next_index(root.path()).expect("it is readable"), 1);
}

#[test]
fn the_description_is_a_table_and_json_of_the_same() {
    let root = tempfile::tempdir().expect("a temporary folder");
    write_file(root.path(), 0, &[1_000_000_000, 3_500_000_000], true);
    let info = BagInfo::of(&open_bag(root.path()).expect("it is a bag"));
    let table = info.to_string();
    assert!(table.contains("duration  2.500 s") && table.contains("start     1970-01-01 00:00:01.000 UTC"), "{table}");
    assert!(table.contains("/count  std_msgs/msg/UInt64         2  Reliable, Volatile"), "{table}");
    let json: serde_json::Value = serde_json::from_str(&info.to_json()).expect("it is JSON");
    assert_eq!(json["message_count"], 2);
    assert_eq!(json["topics"][0]["type_name"], "std_msgs/msg/UInt64");
}

#[test]
fn a_hostile_name_cannot_write_to_the_terminal() {
    let root = tempfile::tempdir().expect("a temporary folder");
    let topic = Topic::ros2("/x\u{1b}[2J\ny", "a/msg/B", "", &[]);
    let mut writer = BagWriter::new(Vec::new(), &WriterOptions::default()).expect("a vector takes everything");
    writer.add_topic(&topic).expect("it fits");
    let path = root.path().join("x.mcap");
    fs::write(&path, writer.finish().expect("a vector takes everything").0).expect("the folder is writable");
    let table = BagInfo::of(&open_bag(&path).expect("it is a bag")).to_string();
    assert!(table.contains("/x\\u{1b}[2J\\ny") && !table.contains('\u{1b}'), "{table}");
}

#[test]
fn what_is_no_bag_is_refused_with_the_reason() {
    let root = tempfile::tempdir().expect("a temporary folder");
    let missing = root.path().join("nowhere");
    assert!(matches!(open_bag(&missing), Err(BagFilesError::Missing { path }) if path == missing));
    assert!(matches!(open_bag(root.path()), Err(BagFilesError::Empty { .. })));

    fs::write(root.path().join("notes.txt"), "hello").expect("the folder is writable");
    let error = create_folder(root.path()).expect_err("it holds other things").to_string();
    assert!(error.contains("notes.txt"), "{error}");

    let text = root.path().join("text.mcap");
    fs::write(&text, "hello, this is no bag").expect("the folder is writable");
    let error = open_bag(&text).map(drop).expect_err("it is text").to_string();
    assert!(error.contains("text.mcap: not an MCAP file"), "{error}");

    let contents = Contents::default();
    write_metadata(root.path(), &bag::BagMetadata::from_files([("gone_0.mcap", &contents)])).expect("it is writable");
    let error = open_bag(root.path()).map(drop).expect_err("the file is not there").to_string();
    assert!(error.contains("gone_0.mcap is missing"), "{error}");

    fs::write(root.path().join(METADATA_FILE), "rosbag2_bagfile_information: [").expect("it is writable");
    let error = open_bag(root.path()).map(drop).expect_err("it is no YAML").to_string();
    assert!(error.contains("metadata.yaml") && error.lines().count() == 1, "{error}");
}
