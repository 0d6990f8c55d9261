//! What the person at the terminal sees: whole lines, in colour where the terminal takes it.

use crate::log_line::Level;
use std::io::{IsTerminal, Write};

const DIM: &str = "2";
const BOLD: &str = "1";
const RED: &str = "31";
const YELLOW: &str = "33";
const GREEN: &str = "32";
const CYAN: &str = "36";

/// The kind of a line of the story, in its first column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Where things are.
    Info(&'static str),
    /// The robot asks.
    Question,
    /// The person answers.
    Answer,
    /// What the robot may get wrong.
    Bound,
    /// The lesson's state changed.
    Lesson,
    /// Where the robot would put it.
    Plan,
    /// A node died or came back.
    Node,
}

/// Standard output for the story, standard error for the nodes' logs.
#[derive(Debug, Clone, Copy)]
pub struct Console {
    colour_out: bool,
    colour_err: bool,
}

impl Console {
    /// Colours only where a terminal shows them, and neither the flag nor NO_COLOR forbids them.
    pub fn new(no_color: bool) -> Self {
        let allowed = !no_color && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
        Self {
            colour_out: allowed && std::io::stdout().is_terminal(),
            colour_err: allowed && std::io::stderr().is_terminal(),
        }
    }

    /// One line of the story. A closed standard output is no reason to end a lesson.
    pub fn say(&self, kind: Kind, text: &str) {
        let (word, colour) = match kind {
            Kind::Info(word) => (word, DIM),
            Kind::Question => ("question", CYAN),
            Kind::Answer => ("answer", GREEN),
            Kind::Bound => ("bound", YELLOW),
            Kind::Lesson => ("lesson", BOLD),
            Kind::Plan => ("plan", BOLD),
            Kind::Node => ("node", RED),
        };
        let word = paint(&format!("{word:<9}"), colour, self.colour_out);
        let _ = writeln!(std::io::stdout().lock(), "{word} {text}");
    }

    /// One line that a node printed.
    pub fn log(&self, node: &str, level: Level, text: &str) {
        let (word, colour) = match level {
            Level::Debug => ("debug: ", DIM),
            Level::Info => ("", DIM),
            Level::Warn => ("warning: ", YELLOW),
            Level::Error => ("", RED),
        };
        let node = paint(&format!("[{node}]"), DIM, self.colour_err);
        let word = paint(word, colour, self.colour_err);
        let _ = writeln!(std::io::stderr().lock(), "{node} {word}{text}");
    }
}

fn paint(text: &str, code: &str, colour: bool) -> String {
    if colour && !text.is_empty() { format!("\u{1b}[{code}m{text}\u{1b}[0m") } else { text.to_owned() }
}
