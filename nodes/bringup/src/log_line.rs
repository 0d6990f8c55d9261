//! A line that a node printed, made safe and short for a terminal.

/// Longest line that is kept, bytes; the rest is the next line's.
pub const MAX_LINE_BYTES: usize = 8192;

/// How much a line matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// For developers.
    Debug,
    /// What happens.
    Info,
    /// Something to look at.
    Warn,
    /// Something is wrong; also every line that is not from the logger, a panic for one.
    Error,
}

impl Level {
    /// The level of that name, in any case.
    pub fn from_name(name: &str) -> Option<Self> {
        match name.to_ascii_lowercase().as_str() {
            "trace" | "debug" => Some(Self::Debug),
            "info" => Some(Self::Info),
            "warn" | "warning" => Some(Self::Warn),
            "error" | "fatal" => Some(Self::Error),
            _ => None,
        }
    }
}

/// Splits `[LEVEL] [node]: text`; what does not look like it is all text, and an error.
pub fn parse(line: &str) -> (Level, &str) {
    let parsed = || {
        let (level, rest) = line.strip_prefix('[')?.split_once(']')?;
        let level = Level::from_name(level.trim())?;
        let (_, text) = rest.trim_start().strip_prefix('[')?.split_once("]: ")?;
        Some((level, text))
    };
    parsed().unwrap_or((Level::Error, line))
}

/// The text without characters that command a terminal.
pub fn harmless(text: &str) -> String {
    text.chars().map(|c| if c.is_control() && c != '\t' { '\u{fffd}' } else { c }).collect()
}

/// Hands every line of a stream to `take`, overlong ones in pieces, until the stream ends.
pub fn each_line(stream: impl std::io::Read, mut take: impl FnMut(&str)) {
    use std::io::{BufRead, BufReader, Read};
    let mut reader = BufReader::new(stream);
    let mut line = Vec::new();
    loop {
        line.clear();
        match reader.by_ref().take(MAX_LINE_BYTES as u64).read_until(b'\n', &mut line) {
            Ok(0) | Err(_) => return,
            Ok(_) => {
                let text = String::from_utf8_lossy(&line);
                take(&harmless(text.trim_end_matches(['\n', '\r'])));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Level, MAX_LINE_BYTES, each_line, harmless, parse};

    #[test]
    fn lines_of_the_logger_are_split_and_all_others_count_as_errors() {
        assert_eq!(parse("[INFO] [apprentice.demonstrator]: hello [x]: y"), (Level::Info, "hello [x]: y"));
        assert_eq!(parse("[WARN] [a]: b"), (Level::Warn, "b"));
        for odd in ["thread 'main' panicked", "[INFO] no node", "[LOUD] [a]: b", "[", ""] {
            assert_eq!(parse(odd), (Level::Error, odd));
        }
    }

    #[test]
    fn a_terminal_gets_no_commands_and_no_endless_lines() {
        assert_eq!(harmless("a\u{1b}[2Jb\tc"), "a\u{fffd}[2Jb\tc");
        let long = "x".repeat(2 * MAX_LINE_BYTES + 1);
        let mut lines = Vec::new();
        each_line(format!("{long}\nlast\r\n\nrest").as_bytes(), |line| lines.push(line.to_owned()));
        let lengths: Vec<usize> = lines.iter().map(String::len).collect();
        assert_eq!(lengths, [MAX_LINE_BYTES, MAX_LINE_BYTES, 1, 4, 0, 4]);
        let mut odd = Vec::new();
        each_line(&[0xff, b'\n'][..], |line| odd.push(line.to_owned()));
        assert_eq!(odd, ["\u{fffd}"]);
    }
}
