//! The summary section at the end of a finished file.

use std::io::{Read, Seek};

use crate::record::{Channel, FOOTER_BYTES, Footer, PREFIX_BYTES, Schema, Statistics, opcode};
use crate::scan::{Source, malformed};
use crate::table::Table;
use crate::{BagError, Limits};

/// Checks footer and checksum, adds the summary's channels to `table`, and gives the statistics if there are any.
///
/// `start` is the byte after the data-end record.
///
/// # Errors
/// When the section is cut, malformed or damaged.
pub(crate) fn read_summary<R: Read + Seek>(
    source: &mut Source<R>,
    start: u64,
    table: &mut Table,
    limits: &Limits,
) -> Result<Option<Statistics>, BagError> {
    let mut statistics = None;
    let mut hasher = crc32fast::Hasher::new();
    source.seek(start)?;
    loop {
        let (code, span) = source.record()?;
        let contents = source.contents(code, span, limits)?;
        let bad = |error| malformed(span.offset, code, &error);
        hasher.update(&[code]);
        hasher.update(&span.length.to_le_bytes());
        match code {
            opcode::SCHEMA => table.add_schema(Schema::parse(&contents).map_err(bad)?),
            opcode::CHANNEL => table.add_channel(Channel::parse(&contents).map_err(bad)?),
            opcode::STATISTICS => statistics = Some(Statistics::parse(&contents).map_err(bad)?),
            opcode::FOOTER => {
                let footer = Footer::parse(&contents).map_err(bad)?;
                hasher.update(contents.get(..FOOTER_BYTES as usize - 4).unwrap_or_default());
                let computed = hasher.finalize();
                if footer.summary_crc != 0 && footer.summary_crc != computed {
                    let stored = footer.summary_crc;
                    return Err(BagError::Checksum { what: "summary", offset: start, stored, computed });
                }
                let expected_start = if span.offset == start { 0 } else { start };
                if footer.summary_start != expected_start {
                    let got = footer.summary_start;
                    let why = format!("it says that the summary starts at byte {got}, expected {expected_start}");
                    return Err(BagError::Malformed { offset: span.offset, opcode: code, why });
                }
                return check_end(source, span.offset + PREFIX_BYTES + span.length, statistics);
            }
            _ => {}
        }
        hasher.update(&contents);
    }
}

/// After the footer there is the magic once more.
fn check_end<R: Read + Seek>(
    source: &mut Source<R>,
    offset: u64,
    statistics: Option<Statistics>,
) -> Result<Option<Statistics>, BagError> {
    let magic = source.read(mcap::MAGIC.len() as u64)?;
    if magic != mcap::MAGIC {
        let why = "the file does not end with MCAP's magic bytes".to_owned();
        return Err(BagError::Malformed { offset, opcode: opcode::FOOTER, why });
    }
    Ok(statistics)
}
