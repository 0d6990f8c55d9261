//! A first pass over the text of a URDF: caps, well-formedness, numbers and names, each problem with its line.
//!
//! The parser proper recurses, takes entities and skips what it cannot read as a number, so nothing reaches it unseen.

use crate::UrdfError;
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use std::collections::{BTreeMap, BTreeSet};

/// Longest description read, bytes.
pub const MAX_BYTES: usize = 10_000_000;
/// Deepest nesting of elements.
pub const MAX_DEPTH: usize = 64;
/// Most links, and most joints.
pub const MAX_LINKS: usize = 1_000;
/// Most collision shapes: each is tested against each.
pub const MAX_SOLIDS: usize = 256;
/// Most elements in all.
pub const MAX_ELEMENTS: usize = 100_000;
const MAX_ATTRIBUTES: usize = 32;

const JOINT_TYPES: [&str; 6] = ["revolute", "continuous", "prismatic", "fixed", "floating", "planar"];

/// Where things stand in the text.
#[derive(Debug, Default)]
pub(crate) struct Scan {
    pub links: BTreeMap<String, usize>,
    pub joints: BTreeMap<String, usize>,
    /// Joints with a `<limit>`.
    pub limited: BTreeSet<String>,
    /// Of every link, where its `<collision>` elements start.
    pub collisions: BTreeMap<String, Vec<usize>>,
}

/// One link or joint that is being read.
struct Owner {
    kind: &'static str,
    name: String,
    line: usize,
    joint_type: String,
    seen: Vec<&'static str>,
}

impl Owner {
    fn words(&self) -> String {
        format!("{} '{}'", self.kind, shorten(&self.name))
    }
}

/// Counts lines up to byte positions that only grow.
struct Lines<'a> {
    text: &'a [u8],
    at: usize,
    line: usize,
}

impl Lines<'_> {
    fn at(&mut self, position: u64) -> usize {
        let end = usize::try_from(position).unwrap_or(usize::MAX).min(self.text.len());
        if end > self.at {
            self.line += self.text[self.at..end].iter().filter(|&&b| b == b'\n').count();
            self.at = end;
        }
        self.line
    }
}

/// Checks a text and tells where its links and joints are.
pub(crate) fn scan(text: &str) -> Result<Scan, UrdfError> {
    if text.len() > MAX_BYTES {
        return Err(UrdfError::TooLarge { got: text.len(), max: MAX_BYTES });
    }
    let mut reader = Reader::from_str(text);
    let mut lines = Lines { text: text.as_bytes(), at: 0, line: 1 };
    let mut pass = Pass::default();
    loop {
        let line = lines.at(reader.buffer_position());
        match reader.read_event() {
            Err(error) => {
                let line = lines.at(reader.error_position());
                return Err(UrdfError::Xml { line, problem: shorten(&error.to_string()) });
            }
            Ok(Event::Eof) => break,
            Ok(Event::DocType(_)) => return Err(UrdfError::Doctype { line }),
            Ok(Event::Start(start)) => pass.start(&start, line)?,
            Ok(Event::Empty(start)) => {
                pass.start(&start, line)?;
                pass.end()?;
            }
            Ok(Event::End(_)) => pass.end()?,
            Ok(_) => {}
        }
    }
    if let Some(open) = pass.path.last() {
        let problem = format!("<{open}> is not closed");
        return Err(UrdfError::Xml { line: lines.at(text.len() as u64), problem });
    }
    if pass.scan.links.is_empty() {
        return Err(UrdfError::Empty);
    }
    Ok(pass.scan)
}

#[derive(Default)]
struct Pass {
    scan: Scan,
    path: Vec<String>,
    n_elements: usize,
    roots: usize,
    owner: Option<Owner>,
}

impl Pass {
    fn start(&mut self, start: &BytesStart, line: usize) -> Result<(), UrdfError> {
        self.n_elements += 1;
        if self.n_elements > MAX_ELEMENTS {
            return Err(UrdfError::TooMany { line, what: "elements", max: MAX_ELEMENTS });
        }
        if self.path.len() >= MAX_DEPTH {
            return Err(UrdfError::TooDeep { line, max: MAX_DEPTH });
        }
        let element = String::from_utf8_lossy(start.name().as_ref()).into_owned();
        let attributes = attributes(start, line)?;
        if element.starts_with("xacro:") {
            return Err(UrdfError::Xacro { line, element });
        }
        match self.path.len() {
            0 if element != "robot" => return Err(UrdfError::NotARobot { line, got: shorten(&element) }),
            0 if self.roots > 0 => {
                return Err(UrdfError::Xml { line, problem: "a second <robot> after the first".into() });
            }
            0 => self.roots += 1,
            _ if ["mesh", "texture"].contains(&element.as_str()) && self.is_read() => {
                required(&attributes, &element, "filename", line)?;
                self.inside(self.path.len(), &element, &attributes, line)?;
            }
            1 if element == "link" => self.open("link", &attributes, line)?,
            1 if element == "joint" => self.open("joint", &attributes, line)?,
            1 => {}
            depth => self.inside(depth, &element, &attributes, line)?,
        }
        self.path.push(element);
        Ok(())
    }

    /// Whether what stands here is read: extensions of other tools are not.
    fn is_read(&self) -> bool {
        self.path.get(1).is_some_and(|element| ["link", "material"].contains(&element.as_str()))
    }

    fn open(&mut self, kind: &'static str, attributes: &[(String, String)], line: usize) -> Result<(), UrdfError> {
        let name = required(attributes, kind, "name", line)?;
        let names = if kind == "link" { &mut self.scan.links } else { &mut self.scan.joints };
        if let Some(&first) = names.get(&name) {
            return Err(UrdfError::Duplicate { line, what: kind, name: shorten(&name), first });
        }
        if names.len() == MAX_LINKS {
            let what = if kind == "link" { "links" } else { "joints" };
            return Err(UrdfError::TooMany { line, what, max: MAX_LINKS });
        }
        names.insert(name.clone(), line);
        let joint_type = if kind == "joint" { required(attributes, kind, "type", line)? } else { String::new() };
        if kind == "joint" && !JOINT_TYPES.contains(&joint_type.as_str()) {
            return Err(UrdfError::JointType { line, joint: shorten(&name), got: shorten(&joint_type) });
        }
        self.owner = Some(Owner { kind, name, line, joint_type, seen: Vec::new() });
        Ok(())
    }

    /// An element somewhere inside a link or joint; anything elsewhere (`<gazebo>`, `<transmission>`) is of no concern.
    fn inside(
        &mut self,
        depth: usize,
        element: &str,
        attributes: &[(String, String)],
        line: usize,
    ) -> Result<(), UrdfError> {
        let Some(owner) = &mut self.owner else { return Ok(()) };
        if depth == 2 && owner.kind == "link" && element == "collision" {
            self.scan.collisions.entry(owner.name.clone()).or_default().push(line);
        }
        if depth == 2 && owner.kind == "joint" {
            match element {
                "parent" => {
                    required(attributes, element, "link", line)?;
                    owner.seen.push("parent");
                }
                "child" => {
                    required(attributes, element, "link", line)?;
                    owner.seen.push("child");
                }
                "mimic" => {
                    required(attributes, element, "joint", line)?;
                }
                "limit" => {
                    required(attributes, element, "velocity", line)?;
                    owner.seen.push("limit");
                    self.scan.limited.insert(owner.name.clone());
                }
                _ => {}
            }
        }
        for (attribute, value) in attributes {
            if let Some((count, bound)) = numbers(element, attribute) {
                check_numbers(value, count, bound).map_err(|expected| UrdfError::Number {
                    line,
                    element: element.into(),
                    attribute: attribute.as_str().into(),
                    owner: owner.words().into(),
                    got: shorten(value).into(),
                    expected: expected.into(),
                })?;
            }
        }
        Ok(())
    }

    fn end(&mut self) -> Result<(), UrdfError> {
        self.path.pop();
        if self.path.len() != 1 {
            return Ok(());
        }
        let Some(owner) = self.owner.take() else { return Ok(()) };
        if owner.kind == "joint" {
            let limited = ["revolute", "prismatic"].contains(&owner.joint_type.as_str());
            for (element, wanted) in [("parent", true), ("child", true), ("limit", limited)] {
                if wanted && !owner.seen.contains(&element) {
                    return Err(UrdfError::MissingElement { line: owner.line, parent: owner.words(), element });
                }
            }
        }
        Ok(())
    }
}

fn attributes(start: &BytesStart, line: usize) -> Result<Vec<(String, String)>, UrdfError> {
    let mut found = Vec::new();
    for attribute in start.attributes() {
        let xml = |problem: String| UrdfError::Xml { line, problem: shorten(&problem) };
        let attribute = attribute.map_err(|error| xml(error.to_string()))?;
        if found.len() == MAX_ATTRIBUTES {
            return Err(UrdfError::TooMany { line, what: "attributes on one element", max: MAX_ATTRIBUTES });
        }
        let value = attribute.unescape_value().map_err(|error| xml(error.to_string()))?;
        found.push((String::from_utf8_lossy(attribute.key.as_ref()).into_owned(), value.into_owned()));
    }
    Ok(found)
}

fn required(
    attributes: &[(String, String)],
    element: &str,
    attribute: &'static str,
    line: usize,
) -> Result<String, UrdfError> {
    match attributes.iter().find(|(key, _)| key == attribute) {
        Some((_, value)) if !value.trim().is_empty() => Ok(value.clone()),
        _ => Err(UrdfError::MissingAttribute { line, element: element.into(), attribute }),
    }
}

/// How many numbers an attribute of an element holds and how large they may be; `None` where it holds none.
fn numbers(element: &str, attribute: &str) -> Option<(usize, f64)> {
    const LENGTH: f64 = 1e3;
    const ANY: f64 = 1e12;
    // Some write 1e16 where they mean that there is no limit.
    const ENDLESS: f64 = 1e18;
    Some(match (element, attribute) {
        ("origin", "xyz" | "rpy") | ("box", "size") | ("mesh", "scale") | ("axis", "xyz") => (3, LENGTH),
        ("cylinder" | "capsule", "radius" | "length") | ("sphere", "radius") => (1, LENGTH),
        ("color", "rgba") => (4, ANY),
        ("limit", "lower" | "upper") => (1, ENDLESS),
        ("limit", "effort" | "velocity" | "acceleration" | "deceleration" | "jerk")
        | ("mimic", "multiplier" | "offset")
        | ("mass", "value")
        | ("inertia", "ixx" | "ixy" | "ixz" | "iyy" | "iyz" | "izz")
        | ("dynamics", "damping" | "friction")
        | ("safety_controller", "soft_lower_limit" | "soft_upper_limit" | "k_position" | "k_velocity")
        | ("calibration", "rising" | "falling") => (1, ANY),
        _ => return None,
    })
}

fn check_numbers(value: &str, count: usize, bound: f64) -> Result<(), String> {
    let good = |word: &str| word.parse::<f64>().is_ok_and(|v| v.is_finite() && v.abs() <= bound);
    if value.split_whitespace().count() == count && value.split_whitespace().all(good) {
        return Ok(());
    }
    let what = if count == 1 { "one finite number".into() } else { format!("{count} finite numbers") };
    Err(format!("{what} of at most {bound}"))
}

/// Foreign text for a message: one line, at most 80 characters.
pub(crate) fn shorten(text: &str) -> String {
    let mut short: String = text.chars().take(80).map(|c| if c.is_control() { ' ' } else { c }).collect();
    if text.chars().nth(80).is_some() {
        short.push('…');
    }
    short
}
