//! A small tree of an XML text, capped in depth and number of elements.

use super::MeshError;
use crate::scan::shorten;
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

/// Deepest nesting.
const MAX_DEPTH: usize = 64;
/// Most elements.
const MAX_ELEMENTS: usize = 200_000;

/// An element with all that is in it.
#[derive(Debug, Default)]
pub(super) struct Element {
    /// Without a namespace's prefix.
    pub name: String,
    pub attributes: Vec<(String, String)>,
    pub text: String,
    pub children: Vec<Element>,
}

impl Element {
    pub fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
    }

    pub fn child<'a>(&'a self, name: &'a str) -> Option<&'a Self> {
        self.children_named(name).next()
    }

    pub fn children_named<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Self> {
        self.children.iter().filter(move |child| child.name == name)
    }

    /// For messages: `<source id="x">`.
    pub fn place(&self) -> String {
        match self.attribute("id") {
            Some(id) => format!("<{} id=\"{}\">", shorten(&self.name), shorten(id)),
            None => format!("<{}>", shorten(&self.name)),
        }
    }
}

/// The outermost element of a text.
pub(super) fn parse(text: &str) -> Result<Element, MeshError> {
    let at = |reader: &Reader<&[u8]>, problem: String| MeshError::Syntax {
        place: format!("byte {}", reader.buffer_position()),
        problem: shorten(&problem),
    };
    let mut reader = Reader::from_str(text);
    let mut open: Vec<Element> = Vec::new();
    let mut root = None;
    let mut n_elements = 0;
    loop {
        let event = reader.read_event().map_err(|error| at(&reader, format!("not well-formed: {error}")))?;
        match event {
            Event::Eof => break,
            Event::DocType(_) => return Err(at(&reader, "a document type declaration is not allowed".into())),
            Event::Start(ref start) | Event::Empty(ref start) => {
                n_elements += 1;
                if n_elements > MAX_ELEMENTS {
                    return Err(MeshError::TooMany { what: "elements", max: MAX_ELEMENTS });
                }
                if open.len() >= MAX_DEPTH {
                    return Err(at(&reader, format!("elements nested more than {MAX_DEPTH} deep")));
                }
                let element = element(start).map_err(|problem| at(&reader, problem))?;
                if matches!(event, Event::Start(_)) {
                    open.push(element);
                } else {
                    close(element, &mut open, &mut root);
                }
            }
            Event::End(_) => {
                let element = open.pop().ok_or_else(|| at(&reader, "an end without a start".into()))?;
                close(element, &mut open, &mut root);
            }
            Event::Text(words) => {
                if let Some(element) = open.last_mut() {
                    element.text.push_str(&words.decode().map_err(|error| at(&reader, error.to_string()))?);
                }
            }
            _ => {}
        }
    }
    match (open.last(), root) {
        (None, Some(root)) => Ok(root),
        (Some(element), _) => Err(at(&reader, format!("cut off: <{}> is not closed", element.name))),
        (None, None) => Err(MeshError::Empty),
    }
}

fn close(element: Element, open: &mut [Element], root: &mut Option<Element>) {
    match open.last_mut() {
        Some(parent) => parent.children.push(element),
        None if root.is_none() => *root = Some(element),
        None => {}
    }
}

fn element(start: &BytesStart) -> Result<Element, String> {
    let mut attributes = Vec::new();
    for attribute in start.attributes() {
        let attribute = attribute.map_err(|error| error.to_string())?;
        let value = attribute.unescape_value().map_err(|error| error.to_string())?;
        attributes
            .push((String::from_utf8_lossy(attribute.key.local_name().as_ref()).into_owned(), value.into_owned()));
    }
    let name = String::from_utf8_lossy(start.local_name().as_ref()).into_owned();
    Ok(Element { name, attributes, text: String::new(), children: Vec::new() })
}
