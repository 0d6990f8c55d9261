//! Schema texts in the `ros2msg` form that MCAP files carry.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

use thiserror::Error;

use crate::generated::{ACTIONS, DEFINITIONS, MESSAGES, SERVICES};
use crate::interface::{Base, InterfaceError, parse_message};

/// Most types that one schema may consist of.
const MAX_TYPES: usize = 1024;
/// Deepest nesting of one message in another.
const MAX_DEPTH: usize = 64;
/// Longest schema text, bytes.
const MAX_SCHEMA_BYTES: usize = 4 << 20;

/// Why no schema can be put together.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum SchemaError {
    /// Not of the form `package/msg/Name`.
    #[error("got type `{got}`, expected `package/msg/Name`")]
    Name {
        /// The name given.
        got: String,
    },
    /// Nobody has the text of this type.
    #[error("no definition of `{got}` was found, expected one because `{root}` needs it")]
    Missing {
        /// The type without a definition.
        got: String,
        /// The type whose schema was asked for.
        root: String,
    },
    /// The text of one of the types cannot be read.
    #[error(transparent)]
    Interface(#[from] InterfaceError),
    /// More types, deeper nesting or more text than this reader accepts.
    #[error("schema of `{root}`: got more than {expected}, expected at most that")]
    TooLarge {
        /// The type whose schema was asked for.
        root: String,
        /// The limit, in words.
        expected: &'static str,
    },
}

/// Names of all messages that this crate knows, `package/msg/Name`, sorted.
pub fn all_types() -> &'static [&'static str] {
    MESSAGES
}

/// Names of all services that this crate knows, `package/srv/Name`, sorted.
pub fn all_services() -> &'static [&'static str] {
    SERVICES
}

/// Names of all actions that this crate knows, `package/action/Name`, sorted.
pub fn all_actions() -> &'static [&'static str] {
    ACTIONS
}

/// Text of the definition of a message (`package/msg/Name`), a service (`package/srv/Name`) or an action
/// (`package/action/Name`).
pub fn definition(type_name: &str) -> Option<&'static str> {
    let at = DEFINITIONS.binary_search_by_key(&type_name, |(name, _)| name).ok()?;
    Some(DEFINITIONS[at].1)
}

/// Schema of a message that this crate knows, with all that it depends on.
pub fn schema(type_name: &str) -> Option<&'static str> {
    static SCHEMAS: OnceLock<BTreeMap<&'static str, String>> = OnceLock::new();
    let schemas = SCHEMAS.get_or_init(|| {
        let known = |name: &str| definition(name).map(str::to_owned);
        MESSAGES.iter().filter_map(|name| Some((*name, compose_schema(name, known).ok()?))).collect()
    });
    schemas.get(type_name).map(String::as_str)
}

/// Puts a schema together: the text of `root_type` (`package/msg/Name`), then that of every type it
/// depends on, depth first and once, each after a newline, a line of 80 `=` and a line
/// `MSG: package/Name` (byte for byte as rosbag2 writes it).
///
/// `lookup` gives the text for a name `package/msg/Name`, from wherever it is found.
pub fn compose_schema(root_type: &str, lookup: impl FnMut(&str) -> Option<String>) -> Result<String, SchemaError> {
    let mut composer = Composer { root: root_type, lookup, seen: BTreeSet::new(), text: String::new() };
    let (package, name) = split_name(root_type).ok_or_else(|| SchemaError::Name { got: root_type.to_owned() })?;
    composer.append(package, name, 0)?;
    Ok(composer.text)
}

fn split_name(type_name: &str) -> Option<(&str, &str)> {
    let (package, name) = type_name.split_once("/msg/")?;
    let plain = |part: &str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_');
    (plain(package) && plain(name)).then_some((package, name))
}

struct Composer<'a, F> {
    root: &'a str,
    lookup: F,
    seen: BTreeSet<String>,
    text: String,
}

impl<F: FnMut(&str) -> Option<String>> Composer<'_, F> {
    fn append(&mut self, package: &str, name: &str, depth: usize) -> Result<(), SchemaError> {
        let type_name = format!("{package}/msg/{name}");
        if !self.seen.insert(type_name.clone()) {
            return Ok(());
        }
        if self.seen.len() > MAX_TYPES {
            return Err(self.too_large("1024 types"));
        }
        if depth > MAX_DEPTH {
            return Err(self.too_large("64 levels of nesting"));
        }
        let text = (self.lookup)(&type_name)
            .ok_or_else(|| SchemaError::Missing { got: type_name.clone(), root: self.root.to_owned() })?;
        let message = parse_message(package, name, &type_name, &text)?;
        if self.text.len() + text.len() > MAX_SCHEMA_BYTES {
            return Err(self.too_large("4 MiB of text"));
        }
        if depth > 0 {
            self.text.push('\n');
            self.text.push_str(&"=".repeat(80));
            self.text.push_str(&format!("\nMSG: {package}/{name}\n"));
        }
        self.text.push_str(&text);
        for field in &message.fields {
            if let Base::Message { package, name } = &field.ty.base {
                self.append(package, name, depth + 1)?;
            }
        }
        Ok(())
    }

    fn too_large(&self, expected: &'static str) -> SchemaError {
        SchemaError::TooLarge { root: self.root.to_owned(), expected }
    }
}
