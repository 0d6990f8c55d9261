//! How an answer is shown: one JSON object, or tables to read.

use std::io::{ErrorKind, Write};
use std::process::ExitCode;

use serde_json::Value;

use crate::OfflineError;

/// What a command found, in both forms.
#[derive(Debug)]
pub(crate) struct Answer {
    /// One object.
    pub(crate) json: Value,
    /// Lines to read.
    pub(crate) text: String,
}

/// Shows an answer or an error, and gives the exit code that goes with it.
pub(crate) fn finish(command: &str, as_json: bool, answer: Result<Answer, OfflineError>) -> ExitCode {
    let shown = answer.and_then(|answer| {
        let text = if as_json { format!("{}\n", answer.json) } else { answer.text };
        let mut out = std::io::stdout().lock();
        match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
            // Whoever reads has read enough.
            Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
            written => written.map_err(OfflineError::Output),
        }
    });
    match shown {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            tell(&format!("apprentice {command}: {error}"));
            ExitCode::from(error.exit_code())
        }
    }
}

/// A message on standard error; nobody there is no reason to stop.
pub(crate) fn tell(message: &str) {
    let _ = writeln!(std::io::stderr(), "{message}");
}

/// Columns side by side: the first to the left, the others to the right.
pub(crate) fn aligned(rows: &[Vec<String>]) -> String {
    let n_columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max();
    let widths: Vec<usize> = (0..n_columns).map(|column| width(column).unwrap_or(0)).collect();
    let mut text = String::new();
    for row in rows {
        let mut line = String::from("  ");
        for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
            let padding = " ".repeat(width - cell.chars().count());
            line += &if column == 0 { format!("{cell}{padding}") } else { format!("  {padding}{cell}") };
        }
        text += line.trim_end();
        text.push('\n');
    }
    text
}

/// Six significant digits, as short as they get.
pub(crate) fn short(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let size = libm::log10(x.abs());
    if !(-4.0..9.0).contains(&size) {
        return format!("{x:.4e}");
    }
    let decimals = (5 - libm::floor(size) as i32).clamp(0, 8) as usize;
    format!("{x:.decimals$}")
}

/// A level, a share or a confidence as people write it: 0.95, 99.9.
pub(crate) fn level(x: f64) -> String {
    let text = format!("{x:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A row of a table.
pub(crate) fn cells<const N: usize>(cells: [&str; N]) -> Vec<String> {
    cells.map(str::to_owned).to_vec()
}

#[cfg(test)]
mod tests {
    use super::{aligned, cells, level, short};

    #[test]
    fn columns_are_aligned() {
        let table = aligned(&[cells(["weight", "β"]), cells(["1", "0.25"])]);
        assert_eq!(table, "  weight     β\n  1       0.25\n");
    }

    #[test]
    fn numbers_keep_six_digits() {
        assert_eq!(short(0.0), "0");
        assert_eq!(short(1.0 / 3.0), "0.333333");
        assert_eq!(short(-1234.5678), "-1234.57");
        assert_eq!(short(123_456_789.0), "123456789");
        assert_eq!(short(1.5e-7), "1.5000e-7");
        assert_eq!(short(f64::INFINITY), "inf");
        assert_eq!(short(f64::NAN), "NaN");
        assert_eq!([level(0.95), level(1.0 - 0.95), level(99.9), level(100.0)], ["0.95", "0.05", "99.9", "100"]);
    }
}
