//! Parser of the interface language, as rosidl reads it.

use std::collections::BTreeSet;

use super::error::{InterfaceError, Problem, excerpt};
use super::literal::{default_value, scalar, split_comment};
use super::{
    Action, Arity, Base, Constant, Field, FieldType, MAX_MEMBERS, MAX_TEXT_BYTES, Message, Primitive, Service,
};

/// Largest array size or string bound: lengths are 32-bit on the wire.
const MAX_COUNT: usize = u32::MAX as usize;

/// Reads the `.msg` text of message `package/name`; errors cite `file`.
pub fn parse_message(package: &str, name: &str, file: &str, text: &str) -> Result<Message, InterfaceError> {
    let [message] = parse_sections(package, file, text, [name.to_owned()])?;
    Ok(message)
}

/// Reads the `.srv` text of service `package/name`; errors cite `file`.
pub fn parse_service(package: &str, name: &str, file: &str, text: &str) -> Result<Service, InterfaceError> {
    let names = ["Request", "Response"].map(|part| format!("{name}_{part}"));
    let [request, response] = parse_sections(package, file, text, names)?;
    Ok(Service { request, response })
}

/// Reads the `.action` text of action `package/name`; errors cite `file`.
pub fn parse_action(package: &str, name: &str, file: &str, text: &str) -> Result<Action, InterfaceError> {
    let names = ["Goal", "Result", "Feedback"].map(|part| format!("{name}_{part}"));
    let [goal, result, feedback] = parse_sections(package, file, text, names)?;
    Ok(Action { goal, result, feedback })
}

fn parse_sections<const N: usize>(
    package: &str,
    file: &str,
    text: &str,
    names: [String; N],
) -> Result<[Message; N], InterfaceError> {
    let fail = |line, problem| InterfaceError { file: file.to_owned(), line, problem };
    if text.len() > MAX_TEXT_BYTES {
        return Err(fail(0, Problem::TooLong { got: text.len(), expected: MAX_TEXT_BYTES }));
    }
    let is_separator = |line: &str| line.trim_end() == "---";
    let got = 1 + text.lines().filter(|line| is_separator(line)).count();
    if got != N {
        return Err(fail(0, Problem::Sections { got, expected: N }));
    }
    let mut messages = names.map(|name| Message {
        package: package.to_owned(),
        name,
        comment: Vec::new(),
        fields: Vec::new(),
        constants: Vec::new(),
    });
    let mut section = 0;
    let mut names_seen = BTreeSet::new();
    let mut heading = true;
    for (index, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        if is_separator(line) {
            section += 1;
            names_seen.clear();
            heading = true;
            continue;
        }
        let message = &mut messages[section];
        let line = line.replace('\t', " ");
        let line = line.trim();
        if let Some(comment) = line.strip_prefix('#') {
            if heading {
                message.comment.push(comment.trim_start_matches('#').trim().to_owned());
            }
            continue;
        }
        heading = heading && line.is_empty() && message.comment.is_empty();
        if !line.is_empty() {
            let name = parse_member(package, line, message).map_err(|problem| fail(index + 1, problem))?;
            if !names_seen.insert(name.clone()) {
                return Err(fail(index + 1, Problem::Duplicate { got: name }));
            }
        }
    }
    Ok(messages)
}

/// Reads one line with a field or a constant into `message`; returns the member's name.
fn parse_member(package: &str, line: &str, message: &mut Message) -> Result<String, Problem> {
    let expected = "a type, a name and perhaps a value, such as `float64 x 0.5` or `uint8 OK=0`";
    let syntax = |got: &str, expected| Problem::Syntax { got: excerpt(got), expected };
    let (written_type, rest) = line.split_once(' ').ok_or_else(|| syntax(line, expected))?;
    let ty = parse_type(package, written_type)?;
    let rest = rest.trim_start();
    let name_length = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(rest.len());
    let (name, rest) = rest.split_at(name_length);
    let after_name = rest.trim_start();
    if message.fields.len() >= MAX_MEMBERS || message.constants.len() >= MAX_MEMBERS {
        return Err(Problem::TooManyMembers { expected: MAX_MEMBERS });
    }
    if let Some(value) = after_name.strip_prefix('=') {
        let (value, comment) = split_comment(value.trim());
        if !is_constant_name(name) {
            return Err(syntax(name, "a constant's name, such as `UPPER_CASE`"));
        }
        if ty.arity != Arity::One || matches!(ty.base, Base::Message { .. }) {
            return Err(syntax(written_type, "a primitive type or string for a constant"));
        }
        let value = scalar(&ty.base, value)
            .ok_or_else(|| Problem::Value { got: excerpt(value), expected: written_type.to_owned() })?;
        message.constants.push(Constant { name: name.to_owned(), base: ty.base, value, comment: comment.to_owned() });
        return Ok(name.to_owned());
    }
    if !is_field_name(name) {
        return Err(syntax(if name.is_empty() { after_name } else { name }, "a field's name, such as `snake_case`"));
    }
    if rest.len() == after_name.len() && !rest.is_empty() && !rest.starts_with('#') {
        return Err(syntax(rest, "a space, `=` or the end of the line after a name"));
    }
    let (value, comment) = split_comment(after_name);
    let default = if value.is_empty() { None } else { Some(default_value(&ty, written_type, value)?) };
    message.fields.push(Field {
        name: name.to_owned(),
        ty,
        written_type: written_type.to_owned(),
        default,
        comment: comment.to_owned(),
    });
    Ok(name.to_owned())
}

fn parse_type(package: &str, text: &str) -> Result<FieldType, Problem> {
    let syntax = |expected| Problem::Syntax { got: excerpt(text), expected };
    let (base, arity) = match text.strip_suffix(']') {
        None => (text, Arity::One),
        Some(open) => {
            let (base, size) = open.rsplit_once('[').ok_or_else(|| syntax("a type, such as `float64[3]`"))?;
            let count = |digits: &str| {
                parse_count(digits).ok_or_else(|| syntax("an array size of 1 or more, such as `[3]` or `[<=3]`"))
            };
            let arity = if size.is_empty() {
                Arity::Unbounded
            } else if let Some(bound) = size.strip_prefix("<=") {
                Arity::Bounded(count(bound)?)
            } else {
                Arity::Fixed(count(size)?)
            };
            (base, arity)
        }
    };
    let base = parse_base(package, base)
        .ok_or_else(|| syntax("a type: a primitive, `string`, `wstring`, `Name` or `package/Name`"))?;
    Ok(FieldType { base, arity })
}

fn parse_base(package: &str, text: &str) -> Option<Base> {
    if let Some((_, primitive)) = Primitive::ALL.iter().find(|(name, _)| *name == text) {
        return Some(Base::Primitive(*primitive));
    }
    let (word, bound) = match text.split_once("<=") {
        Some((word, digits)) => (word, Some(parse_count(digits)?)),
        None => (text, None),
    };
    match word {
        "string" => return Some(Base::String { bound }),
        "wstring" => return Some(Base::WString { bound }),
        _ if bound.is_some() => return None,
        _ => {}
    }
    let (package, name) = match text.split_once('/') {
        Some((package, name)) => (package, name.strip_prefix("msg/").unwrap_or(name)),
        None => (package, text),
    };
    (is_field_name(package) && is_message_name(name))
        .then(|| Base::Message { package: package.to_owned(), name: name.to_owned() })
}

fn parse_count(digits: &str) -> Option<usize> {
    let all_digits = digits.bytes().all(|b| b.is_ascii_digit());
    let count: usize = digits.parse().ok().filter(|_| all_digits)?;
    (1..=MAX_COUNT).contains(&count).then_some(count)
}

/// Lower case, digits and single underscores between them; for packages and fields.
pub(crate) fn is_field_name(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_lowercase())
        && name.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'_')
        && !name.ends_with('_')
        && !name.contains("__")
}

/// Camel case, as message names are.
pub(crate) fn is_message_name(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_uppercase()) && name.bytes().all(|b| b.is_ascii_alphanumeric())
}

fn is_constant_name(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_uppercase())
        && name.bytes().all(|b| b.is_ascii_uppercase() || b.is_ascii_digit() || b == b'_')
        && !name.ends_with('_')
        && !name.contains("__")
}
