//! Values of constants and defaults.

use super::error::{Problem, excerpt};
use super::{Arity, Base, FieldType, Literal, Primitive};

/// Most elements in the default of an array.
const MAX_ELEMENTS: usize = 4096;

/// Splits what follows a name (or `=`) into a value and a comment.
/// A quoted value may contain `#`; any other ends at it. Array defaults are cut outside quotes.
pub(super) fn split_comment(text: &str) -> (&str, &str) {
    let quoted = text.starts_with(['"', '\'', '[']);
    let mut quote = None;
    let mut escaped = false;
    for (at, c) in text.char_indices() {
        match quote {
            Some(q) => {
                if !escaped && c == q {
                    quote = None;
                }
                escaped = !escaped && c == '\\';
            }
            None if quoted && (c == '"' || c == '\'') => quote = Some(c),
            None if c == '#' => return (text[..at].trim(), text[at + 1..].trim()),
            None => {}
        }
    }
    (text.trim(), "")
}

/// Reads the default value of a field of type `ty`, written `written`.
pub(super) fn default_value(ty: &FieldType, written: &str, text: &str) -> Result<Literal, Problem> {
    let wrong = || Problem::Value { got: excerpt(text), expected: written.to_owned() };
    if ty.arity == Arity::One {
        return scalar(&ty.base, text).ok_or_else(wrong);
    }
    let inner = text.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')).ok_or_else(wrong)?.trim();
    let mut elements = Vec::new();
    if !inner.is_empty() {
        for part in split_elements(inner) {
            if elements.len() == MAX_ELEMENTS {
                return Err(wrong());
            }
            elements.push(scalar(&ty.base, part.trim()).ok_or_else(wrong)?);
        }
    }
    let fits = match ty.arity {
        Arity::Fixed(n) => elements.len() == n,
        Arity::Bounded(n) => elements.len() <= n,
        Arity::One | Arity::Unbounded => true,
    };
    if fits { Ok(Literal::List(elements)) } else { Err(wrong()) }
}

/// Reads one value of type `base`; `None` when the type cannot hold it.
pub(super) fn scalar(base: &Base, text: &str) -> Option<Literal> {
    match base {
        Base::Primitive(Primitive::Bool) => match text.to_ascii_lowercase().as_str() {
            "true" | "1" => Some(Literal::Bool(true)),
            "false" | "0" => Some(Literal::Bool(false)),
            _ => None,
        },
        Base::Primitive(Primitive::Float32) => {
            let value: f64 = text.parse().ok()?;
            (value.is_finite() && value.abs() <= f64::from(f32::MAX)).then_some(Literal::Float(value))
        }
        Base::Primitive(Primitive::Float64) => {
            let value: f64 = text.parse().ok()?;
            value.is_finite().then_some(Literal::Float(value))
        }
        Base::Primitive(primitive) => {
            let (least, greatest) = primitive.integer_range()?;
            let value = integer(text)?;
            (least..=greatest).contains(&value).then_some(Literal::Integer(value))
        }
        Base::String { bound } => {
            let value = unquote(text)?;
            bound.is_none_or(|bound| value.len() <= bound).then_some(Literal::Text(value))
        }
        Base::WString { bound } => {
            let value = unquote(text)?;
            bound.is_none_or(|bound| value.encode_utf16().count() <= bound).then_some(Literal::Text(value))
        }
        Base::Message { .. } => None,
    }
}

fn integer(text: &str) -> Option<i128> {
    let (negative, digits) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    if !digits.starts_with(|c: char| c.is_ascii_digit()) {
        return None;
    }
    let magnitude = match digits.get(..2) {
        Some("0x" | "0X") => i128::from_str_radix(&digits[2..], 16),
        Some("0o" | "0O") => i128::from_str_radix(&digits[2..], 8),
        Some("0b" | "0B") => i128::from_str_radix(&digits[2..], 2),
        _ => digits.parse(),
    }
    .ok()?;
    if magnitude < 0 {
        return None;
    }
    Some(if negative { -magnitude } else { magnitude })
}

/// Removes one pair of quotes and the escapes inside; text without quotes stays as it is.
fn unquote(text: &str) -> Option<String> {
    let Some(quote) = text.chars().next().filter(|c| *c == '"' || *c == '\'') else {
        return Some(text.to_owned());
    };
    let mut out = String::new();
    let mut chars = text[1..].chars();
    while let Some(c) = chars.next() {
        if c == quote {
            return chars.as_str().is_empty().then_some(out);
        }
        if c != '\\' {
            out.push(c);
            continue;
        }
        match chars.next()? {
            'n' => out.push('\n'),
            't' => out.push('\t'),
            'r' => out.push('\r'),
            other @ ('\\' | '"' | '\'') => out.push(other),
            other => out.extend(['\\', other]),
        }
    }
    None
}

/// Splits at commas outside quotes.
fn split_elements(text: &str) -> Vec<&str> {
    let mut parts = Vec::new();
    let mut start = 0;
    let mut quote = None;
    let mut escaped = false;
    for (at, c) in text.char_indices() {
        match quote {
            Some(q) => {
                if !escaped && c == q {
                    quote = None;
                }
                escaped = !escaped && c == '\\';
            }
            None if c == '"' || c == '\'' => quote = Some(c),
            None if c == ',' => {
                parts.push(&text[start..at]);
                start = at + 1;
            }
            None => {}
        }
    }
    parts.push(&text[start..]);
    parts
}
