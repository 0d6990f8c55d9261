//! Cut, damaged and hostile files: never a panic, never lost without a word, never more memory than the limits.

mod common;

use std::io::Cursor;

use bag::{BagError, BagReader, Compression, Limits, Message, WriterOptions, recover};
use common::{messages, write};
use proptest::prelude::{ProptestConfig, any, prop, proptest};

/// Small limits, so that a test would notice a reader that ignores them.
const LIMITS: Limits = Limits { record_bytes: 1 << 16, loaded_bytes: 1 << 18 };

fn read_tolerant(file: &[u8]) -> Result<(Vec<Message>, bool), BagError> {
    let mut reader = BagReader::open_tolerant(Cursor::new(file), LIMITS)?;
    let damaged = !reader.damage().is_empty();
    let messages = reader.messages().collect::<Result<Vec<_>, _>>()?;
    reader.attachments()?;
    Ok((messages, damaged))
}

#[test]
fn an_unfinished_file_keeps_every_flushed_message_and_says_that_it_is_unfinished() {
    let file = write(Compression::Lz4, false);
    let error = BagReader::open(Cursor::new(&file), LIMITS).map(drop).expect_err("it has no summary");
    assert!(matches!(error, BagError::Unfinished { offset } if offset == file.len() as u64));
    assert!(error.to_string().contains("apprentice bag recover"));
    let (read, damaged) = read_tolerant(&file).expect("its records are whole");
    assert_eq!(read.len(), messages().len());
    assert!(damaged);
    let report = recover(Cursor::new(&file), Vec::new(), LIMITS, &WriterOptions::default()).expect("it can be read");
    assert!(report.complete(), "nothing that was flushed is lost");
}

#[test]
fn a_file_cut_at_any_byte_gives_its_whole_chunks_and_recovers_to_a_good_bag() {
    for compression in [Compression::None, Compression::Lz4] {
        let file = write(compression, true);
        let mut most = 0;
        for cut in 0..file.len() {
            let part = &file[..cut];
            let strict = BagReader::open(Cursor::new(part), LIMITS);
            assert!(strict.is_err(), "a file cut at byte {cut} is not whole");
            if cut < 8 {
                assert!(matches!(read_tolerant(part), Err(BagError::NotMcap { .. })));
                continue;
            }
            let (read, damaged) = read_tolerant(part).expect("a cut file is readable up to the cut");
            assert!(damaged, "cut at byte {cut}");
            assert!(read.len() >= most, "a longer part holds no less");
            most = read.len();

            let mut recovered = Vec::new();
            let report = recover(Cursor::new(part), &mut recovered, LIMITS, &WriterOptions::default())
                .expect("a cut file can be recovered");
            assert_eq!(report.contents.message_count, read.len() as u64);
            let mut reader = BagReader::open(Cursor::new(&recovered), LIMITS).expect("a recovered file is whole");
            let again: Vec<_> = reader.messages().collect::<Result<_, _>>().expect("a recovered file is whole");
            let bytes = |messages: &[Message]| messages.iter().map(|m| m.data.clone()).collect::<Vec<_>>();
            assert_eq!(bytes(&again), bytes(&read));
        }
        assert_eq!(most, messages().len());
    }
}

#[test]
fn a_flipped_byte_is_never_a_panic_and_never_a_changed_message() {
    let originals: Vec<_> = messages().into_iter().map(|(_, _, cdr)| cdr).collect();
    for compression in [Compression::None, Compression::Lz4] {
        let file = write(compression, true);
        for at in 0..file.len() {
            for flip in [0x01, 0x80, 0xff] {
                let mut bytes = file.clone();
                bytes[at] ^= flip;
                if let Ok(mut reader) = BagReader::open(Cursor::new(&bytes), LIMITS) {
                    for message in reader.messages().map_while(Result::ok) {
                        assert!(originals.contains(&message.data), "byte {at} changed a message unseen");
                    }
                    let _ = reader.attachments();
                }
                if let Ok((read, _)) = read_tolerant(&bytes) {
                    assert!(read.iter().all(|m| originals.contains(&m.data)), "byte {at} changed a message unseen");
                }
            }
        }
    }
}

#[test]
fn a_damaged_chunk_is_named_and_the_others_are_kept() {
    let mut file = write(Compression::None, true);
    let at = file.windows(4).position(|w| w == b"long").expect("the text is in the last chunk uncompressed");
    file[at] ^= 0xff;
    let mut strict = BagReader::open(Cursor::new(&file), LIMITS).expect("its structure is whole");
    let error = strict.messages().find_map(Result::err).expect("the chunk is damaged");
    assert!(matches!(error, BagError::Checksum { what: "chunk", offset, .. } if offset < at as u64));
    let reader = BagReader::open_tolerant(Cursor::new(&file), LIMITS).expect("it can be read");
    assert_eq!(reader.contents().message_count, 4, "two of three chunks are left");
    assert_eq!(reader.damage().len(), 1);
    assert!(reader.damage()[0].loses_messages());
}

#[test]
fn a_record_that_claims_too_much_is_refused_before_anything_is_reserved() {
    let mut file = mcap::MAGIC.to_vec();
    file.push(0x01);
    file.extend_from_slice(&u64::MAX.to_le_bytes());
    let error = BagReader::open(Cursor::new(&file), LIMITS).map(drop).expect_err("no file is that long");
    assert!(matches!(error, BagError::Truncated { offset: 8, needed: u64::MAX, .. }), "{error}");

    let mut file = mcap::MAGIC.to_vec();
    file.push(0x03);
    let length = LIMITS.record_bytes + 1;
    file.extend_from_slice(&length.to_le_bytes());
    file.resize(file.len() + length as usize, 0);
    let error = BagReader::open(Cursor::new(&file), LIMITS).map(drop).expect_err("it is over the limit");
    assert!(matches!(error, BagError::TooLong { offset: 8, opcode: 3, .. }), "{error}");
}

#[test]
fn a_text_file_is_called_what_it_is() {
    let error = BagReader::open(Cursor::new(b"hello, bag"), LIMITS).map(drop).expect_err("it is text").to_string();
    assert!(error.starts_with("not an MCAP file: it starts with the bytes [68, 65, 6c"), "{error}");
    assert_eq!(error.lines().count(), 1);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn random_bytes_after_the_magic_are_never_a_panic(noise in prop::collection::vec(any::<u8>(), 0..2_000)) {
        let mut file = mcap::MAGIC.to_vec();
        file.extend_from_slice(&noise);
        let _ = read_tolerant(&file);
        let _ = BagReader::open(Cursor::new(&file), LIMITS).map(|mut r| r.messages().count());
    }

    #[test]
    fn random_records_are_never_a_panic(
        records in prop::collection::vec((1..16_u8, prop::collection::vec(any::<u8>(), 0..80)), 0..20),
    ) {
        let mut file = mcap::MAGIC.to_vec();
        for (opcode, contents) in records {
            file.push(opcode);
            file.extend_from_slice(&(contents.len() as u64).to_le_bytes());
            file.extend_from_slice(&contents);
        }
        let _ = read_tolerant(&file);
        let _ = recover(Cursor::new(&file), Vec::new(), LIMITS, &WriterOptions::default());
    }

    #[test]
    fn a_chunk_of_random_bytes_is_never_a_panic(
        name in prop::sample::select(vec!["", "lz4", "zstd"]),
        data in prop::collection::vec(any::<u8>(), 0..300),
        frame in any::<bool>(),
        size in prop::sample::select(vec![0, 1, 100, 60_000, u64::MAX]),
    ) {
        // Most random bytes fail at the frame's magic; `frame` gets them past it.
        let magic: &[u8] = match (frame, name) {
            (true, "lz4") => &[0x04, 0x22, 0x4d, 0x18],
            (true, "zstd") => &[0x28, 0xb5, 0x2f, 0xfd],
            _ => &[],
        };
        let mut chunk = vec![0; 16];
        chunk.extend_from_slice(&size.to_le_bytes());
        chunk.extend_from_slice(&[0; 4]);
        chunk.extend_from_slice(&(name.len() as u32).to_le_bytes());
        chunk.extend_from_slice(name.as_bytes());
        chunk.extend_from_slice(&((magic.len() + data.len()) as u64).to_le_bytes());
        chunk.extend_from_slice(magic);
        chunk.extend_from_slice(&data);
        let mut file = mcap::MAGIC.to_vec();
        file.push(0x06);
        file.extend_from_slice(&(chunk.len() as u64).to_le_bytes());
        file.extend_from_slice(&chunk);
        let _ = read_tolerant(&file);
    }
}
