//! The pairs of links that a semantic robot description (SRDF) disables.

use crate::scan::{MAX_BYTES, MAX_DEPTH, MAX_ELEMENTS, shorten};
use crate::{Exclusions, Problem, Robot};
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use thiserror::Error;

/// Why a text is no SRDF. `line` counts from 1.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum SrdfError {
    /// Refused before parsing.
    #[error("the semantic robot description (SRDF) has {got} bytes; at most {MAX_BYTES} are read")]
    TooLarge {
        /// Got.
        got: usize,
    },
    /// It cannot be read.
    #[error("line {line}: the semantic robot description (SRDF) cannot be read: {problem}")]
    Syntax {
        /// Where.
        line: usize,
        /// What is wrong.
        problem: String,
    },
}

/// What to do with which links.
enum Rule {
    Disable(String, String),
    DisableAll(String),
    Enable(String, String),
}

impl Exclusions {
    /// The pairs of an SRDF text: `<disable_default_collisions link>`, then `<disable_collisions link1 link2>`, then
    /// `<enable_collisions link1 link2>`, whatever their order in the text. Rules about links that the robot does not have
    /// change nothing and come back as problems.
    ///
    /// # Errors
    /// Text that is not well-formed, too large or too deep, or a rule without its links.
    pub fn from_srdf(robot: &Robot, text: &str) -> Result<(Self, Vec<Problem>), SrdfError> {
        let rules = rules(text)?;
        let mut exclusions = Self::none();
        let mut problems = Vec::new();
        let mut find = |line: usize, link: &str| {
            let index = robot.link_index(link);
            if index.is_none() {
                problems.push(Problem {
                    line,
                    what: format!("the SRDF names the link '{}', which the robot does not have", shorten(link)),
                    advice: "is it the SRDF of another version of this robot?".into(),
                });
            }
            index
        };
        let mut found: Vec<(u8, usize, Option<usize>)> = Vec::new();
        for (line, rule) in &rules {
            match rule {
                Rule::DisableAll(link) => found.extend(find(*line, link).map(|a| (0, a, None))),
                Rule::Disable(a, b) => {
                    found.extend(find(*line, a).zip(find(*line, b)).map(|(a, b)| (1, a, Some(b))));
                }
                Rule::Enable(a, b) => {
                    found.extend(find(*line, a).zip(find(*line, b)).map(|(a, b)| (2, a, Some(b))));
                }
            }
        }
        found.sort_by_key(|&(order, ..)| order);
        for (order, a, b) in found {
            match b {
                None => (0..robot.links.len()).filter(|&b| b != a).for_each(|b| exclusions.disable_pair(a, b)),
                Some(b) if order == 1 => exclusions.disable_pair(a, b),
                Some(b) => exclusions.enable_pair(a, b),
            }
        }
        Ok((exclusions, problems))
    }
}

fn rules(text: &str) -> Result<Vec<(usize, Rule)>, SrdfError> {
    if text.len() > MAX_BYTES {
        return Err(SrdfError::TooLarge { got: text.len() });
    }
    let mut reader = Reader::from_str(text);
    let mut rules = Vec::new();
    let (mut depth, mut n_elements, mut line, mut at) = (0_usize, 0, 1, 0);
    loop {
        let position = usize::try_from(reader.buffer_position()).unwrap_or(text.len()).min(text.len());
        line += text.as_bytes()[at..position].iter().filter(|&&b| b == b'\n').count();
        at = position;
        let syntax = |problem: String| SrdfError::Syntax { line, problem: shorten(&problem) };
        match reader.read_event().map_err(|error| syntax(error.to_string()))? {
            Event::Eof if depth > 0 => return Err(syntax("it is cut off".into())),
            Event::Eof => return Ok(rules),
            Event::DocType(_) => return Err(syntax("a document type declaration is not allowed".into())),
            Event::End(_) => depth = depth.saturating_sub(1),
            Event::Start(start) => {
                depth += 1;
                n_elements += 1;
                rules.extend(rule(&start).map_err(syntax)?.map(|rule| (line, rule)));
            }
            Event::Empty(start) => {
                n_elements += 1;
                rules.extend(rule(&start).map_err(syntax)?.map(|rule| (line, rule)));
            }
            _ => {}
        }
        if depth > MAX_DEPTH || n_elements > MAX_ELEMENTS {
            return Err(syntax(format!("more than {MAX_ELEMENTS} elements, or nested more than {MAX_DEPTH} deep")));
        }
    }
}

fn rule(start: &BytesStart) -> Result<Option<Rule>, String> {
    let name = start.name();
    let name = String::from_utf8_lossy(name.as_ref());
    let value = |key: &str| {
        let found = start.try_get_attribute(key).map_err(|error| error.to_string())?;
        let found = found.ok_or_else(|| format!("a <{name}> lacks '{key}'"))?;
        found.unescape_value().map(std::borrow::Cow::into_owned).map_err(|error| error.to_string())
    };
    Ok(Some(match name.as_ref() {
        "disable_collisions" => Rule::Disable(value("link1")?, value("link2")?),
        "enable_collisions" => Rule::Enable(value("link1")?, value("link2")?),
        "disable_default_collisions" => Rule::DisableAll(value("link")?),
        _ => return Ok(None),
    }))
}
