//! What a node's parameters are: the settings trait and the table that describes every field.

use serde::{Serialize, de::DeserializeOwned};

/// The settings of one node: a flat structure whose fields are the node's ROS parameters.
///
/// Fields are `bool`, integers, `f64`, `String`, enums written as strings, and vectors of those.
pub trait NodeSettings: Serialize + DeserializeOwned + Default + Clone + Send + 'static {
    /// The executable's name of the node and its default name on the graph.
    const NODE: &'static str;
    /// One sentence for `--help`.
    const ABOUT: &'static str;
    /// Every field of the structure, in order.
    const PARAMETERS: &'static [ParameterSpec];

    /// Rules that tie several parameters together.
    ///
    /// # Errors
    /// One sentence naming the parameters, what they are and what they should be.
    fn check(&self) -> Result<(), String> {
        Ok(())
    }

    /// The seed that goes into the recorded settings.
    fn seed(&self) -> u64 {
        0
    }
}

/// One parameter: its name, what it means, and which values are taken.
#[derive(Debug, Clone, Copy)]
pub struct ParameterSpec {
    /// The field's name.
    pub name: &'static str,
    /// What it means, with its unit.
    pub about: &'static str,
    /// Which values are taken; for a vector, of each element.
    pub range: Range,
}

/// Which values a parameter takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Range {
    /// Any value of the field's type; floating-point numbers must be finite all the same.
    Any,
    /// Integers, bounds included.
    Integer {
        /// The smallest.
        min: i64,
        /// The largest.
        max: i64,
    },
    /// Floating-point numbers, bounds included.
    Float {
        /// The smallest.
        min: f64,
        /// The largest.
        max: f64,
    },
    /// One of these strings.
    Choice(&'static [&'static str]),
}

impl std::fmt::Display for Range {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Range::Any => f.write_str("any"),
            Range::Integer { min: i64::MIN, max: i64::MAX } => f.write_str("any integer"),
            Range::Integer { min, max: i64::MAX } => write!(f, "{min} or more"),
            Range::Integer { min, max } => write!(f, "{min} to {max}"),
            Range::Float { min, max } if *max == f64::MAX || max.is_infinite() => {
                write!(f, "{min:?} or more")
            }
            Range::Float { min, max } => write!(f, "{min:?} to {max:?}"),
            Range::Choice(choices) => f.write_str(&choices.join(", ")),
        }
    }
}

/// The value of a ROS parameter.
#[derive(Debug, Clone, PartialEq)]
pub enum ParameterValue {
    /// `true` or `false`.
    Bool(bool),
    /// A 64-bit integer.
    Integer(i64),
    /// A 64-bit floating-point number.
    Double(f64),
    /// A text.
    String(String),
    /// A list, all elements of one of the four types above.
    Array(Vec<ParameterValue>),
}

impl ParameterValue {
    /// The type's name as ROS users know it.
    pub fn type_name(&self) -> &'static str {
        match self {
            ParameterValue::Bool(_) => "bool",
            ParameterValue::Integer(_) => "integer",
            ParameterValue::Double(_) => "double",
            ParameterValue::String(_) => "string",
            ParameterValue::Array(items) => match items.first() {
                None => "empty array",
                Some(ParameterValue::Bool(_)) => "bool array",
                Some(ParameterValue::Integer(_)) => "integer array",
                Some(ParameterValue::Double(_)) => "double array",
                Some(_) => "string array",
            },
        }
    }
}

impl std::fmt::Display for ParameterValue {
    /// As YAML, so that the text read back gives the same value, bit for bit.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            ParameterValue::Bool(value) => write!(f, "{value}"),
            ParameterValue::Integer(value) => write!(f, "{value}"),
            ParameterValue::Double(value) => f.write_str(&yaml_double(*value)),
            ParameterValue::String(value) => f.write_str(&yaml_string(value)),
            ParameterValue::Array(items) => {
                f.write_str("[")?;
                for (index, item) in items.iter().enumerate() {
                    if index > 0 {
                        f.write_str(", ")?;
                    }
                    write!(f, "{item}")?;
                }
                f.write_str("]")
            }
        }
    }
}

/// The shortest decimal that reads back as the same double, always with a point so that it stays a double.
fn yaml_double(value: f64) -> String {
    if value.is_nan() {
        return ".nan".to_owned();
    }
    if value.is_infinite() {
        return if value > 0.0 { ".inf" } else { "-.inf" }.to_owned();
    }
    let text = format!("{value:?}");
    match text.split_once('e') {
        Some((mantissa, exponent)) if !mantissa.contains('.') => format!("{mantissa}.0e{exponent}"),
        _ => text,
    }
}

/// A double-quoted YAML string in ASCII escapes where a parser might fold or refuse the character.
fn yaml_string(value: &str) -> String {
    let mut text = String::with_capacity(value.len() + 2);
    text.push('"');
    for character in value.chars() {
        match character {
            '"' => text.push_str("\\\""),
            '\\' => text.push_str("\\\\"),
            '\n' => text.push_str("\\n"),
            '\t' => text.push_str("\\t"),
            ' '..='~' => text.push(character),
            other if other.is_alphanumeric() => text.push(other),
            other if u32::from(other) <= 0xffff => {
                text.push_str(&format!("\\u{:04x}", u32::from(other)));
            }
            other => text.push_str(&format!("\\U{:08x}", u32::from(other))),
        }
    }
    text.push('"');
    text
}
