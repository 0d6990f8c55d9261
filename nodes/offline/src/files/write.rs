//! Files that are whole or not there: written under another name, then renamed.

use std::fs::{File, OpenOptions, Permissions};
use std::io::{self, BufWriter, Write};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};

use crate::OfflineError;

/// Writes rows of `n_columns` numbers, each with the fewest digits that read back as the same bits, without a header line.
/// A signal to end leaves no part of it behind.
///
/// # Errors
/// What cannot be written; [`OfflineError::Interrupted`] after a signal.
pub fn write_table(path: &Path, values: &[f64], n_columns: usize) -> Result<(), OfflineError> {
    whole(path, &|file, stop| rows(file, values, n_columns, stop))
}

/// Writes a text, such as a picture.
///
/// # Errors
/// As [`write_table`].
pub fn write_text(path: &Path, text: &str) -> Result<(), OfflineError> {
    whole(path, &|mut file, _| file.write_all(text.as_bytes()))
}

/// Writes the content of a file, until told to stop.
type Content<'a> = &'a dyn Fn(&File, &AtomicBool) -> io::Result<()>;

fn whole(path: &Path, content: Content<'_>) -> Result<(), OfflineError> {
    let failed = |source| OfflineError::Unwritable { file: path.display().to_string(), source };
    let stop = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM, SIGHUP] {
        signal_hook::flag::register(signal, Arc::clone(&stop)).map_err(failed)?;
    }
    write(path, content, &stop).map_err(|source| match stop.load(Ordering::Relaxed) {
        true => OfflineError::Interrupted,
        false => failed(source),
    })
}

fn write(path: &Path, content: Content<'_>, stop: &AtomicBool) -> io::Result<()> {
    let target = match std::fs::canonicalize(path) {
        // A link stays one.
        Ok(target) => target,
        Err(error) if error.kind() == io::ErrorKind::NotFound => path.to_owned(),
        Err(error) => return Err(error),
    };
    match std::fs::metadata(&target) {
        Ok(held) if held.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
        // A pipe or a device cannot be replaced.
        Ok(held) if !held.is_file() => {
            return content(&OpenOptions::new().write(true).open(&target)?, stop);
        }
        _ => {}
    }
    let folder = match target.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    };
    let part = tempfile::Builder::new()
        .prefix(".apprentice-")
        .suffix(".part")
        .permissions(Permissions::from_mode(0o666))
        .tempfile_in(folder)?;
    content(part.as_file(), stop)?;
    part.persist(&target)?;
    Ok(())
}

fn rows(file: &File, values: &[f64], n_columns: usize, stop: &AtomicBool) -> io::Result<()> {
    let mut to = BufWriter::with_capacity(1 << 18, file);
    for row in values.chunks(n_columns) {
        for (column, value) in row.iter().enumerate() {
            write!(to, "{}{value:?}", if column == 0 { "" } else { "," })?;
        }
        to.write_all(b"\n")?;
        if stop.load(Ordering::Relaxed) {
            return Err(io::ErrorKind::Interrupted.into());
        }
    }
    to.flush()
}

#[cfg(test)]
mod tests {
    use super::{rows, write_table, write_text};
    use crate::files::{Table, Wanted};
    use std::io::ErrorKind;
    use std::sync::atomic::AtomicBool;

    #[test]
    fn what_is_written_reads_back_and_nothing_else_is_left() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("draws.csv");
        let values = [0.1, -1e-300, 1.0 / 3.0, f64::MAX, 5e-324, -0.0];
        for _ in 0..2 {
            write_table(&path, &values, 3).expect("written");
        }
        let wanted = Wanted { name: "weight", columns: Some((3, "")), largest: f64::MAX };
        let table = Table::read(&path, &wanted).expect("a table");
        let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&table.values), bits(&values));
        assert_eq!(std::fs::read_dir(folder.path()).expect("a folder").count(), 1);
        write_text(&path, "<svg/>").expect("written");
        assert_eq!(std::fs::read_to_string(&path).expect("a text"), "<svg/>");
        assert_eq!(std::fs::read_dir(folder.path()).expect("a folder").count(), 1);
        assert!(write_table(folder.path(), &values, 3).is_err());
        assert!(write_table(&folder.path().join("no/where.csv"), &values, 3).is_err());
    }

    #[test]
    fn a_stop_ends_the_writing() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = std::fs::File::create(folder.path().join("part")).expect("a file");
        let error = rows(&file, &[1.0; 100], 2, &AtomicBool::new(true)).expect_err("stopped");
        assert_eq!(error.kind(), ErrorKind::Interrupted);
    }
}
