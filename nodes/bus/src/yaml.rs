//! YAML as a tree with line numbers, read under tight limits.

use std::collections::HashSet;

use serde::de::{Deserialize, Deserializer, Error as _, MapAccess, SeqAccess, Visitor};
use serde_saphyr::Spanned;

/// Most bytes of YAML that are read.
pub(crate) const MAX_YAML_BYTES: u64 = 1_000_000;

/// One node of a YAML document.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Yaml {
    /// Nothing, `~` or `null`.
    Null,
    /// A boolean.
    Bool(bool),
    /// An integer that fits.
    Integer(i64),
    /// A number with a point or an exponent.
    Double(f64),
    /// Any other scalar.
    Text(String),
    /// A sequence.
    List(Vec<Yaml>),
    /// A mapping in document order; each value with its line, from 1.
    Map(Vec<(String, u64, Yaml)>),
}

impl Yaml {
    /// What this is, for error messages.
    pub(crate) fn describe(&self) -> String {
        match self {
            Yaml::Null => "nothing".to_owned(),
            Yaml::Bool(value) => format!("bool {value}"),
            Yaml::Integer(value) => format!("integer {value}"),
            Yaml::Double(value) => format!("double {value:?}"),
            Yaml::Text(value) => format!("string {:?}", shorten(value)),
            Yaml::List(items) => format!("a list of {}", items.len()),
            Yaml::Map(entries) => format!("a mapping of {}", entries.len()),
        }
    }
}

/// At most 60 characters of a text.
pub(crate) fn shorten(text: &str) -> String {
    if text.chars().count() <= 60 {
        return text.to_owned();
    }
    text.chars().take(59).chain(['…']).collect()
}

/// Parses one YAML document.
///
/// # Errors
/// The parser's words on one line, with the line number (0 when unknown).
pub(crate) fn parse(text: &str) -> Result<Yaml, (u64, String)> {
    if text.len() as u64 > MAX_YAML_BYTES {
        return Err((0, format!("{} bytes; at most {MAX_YAML_BYTES} are read", text.len())));
    }
    let options = serde_saphyr::options! {
        budget: serde_saphyr::budget! {
            max_depth: 32,
            max_documents: 1,
            max_nodes: 100_000,
            max_events: 400_000,
            max_aliases: 100,
            max_anchors: 100,
        },
        with_snippet: false,
        non_finite_float_policy: serde_saphyr::NonFiniteFloatPolicy::PassThrough,
    };
    serde_saphyr::from_str_with_options::<Yaml>(text, options).map_err(|error| {
        let line = error.location().map_or(0, |location| location.line());
        let reason = error.to_string();
        (line, reason.split_whitespace().collect::<Vec<_>>().join(" "))
    })
}

impl<'de> Deserialize<'de> for Yaml {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(YamlVisitor)
    }
}

/// Builds the tree.
struct YamlVisitor;

impl<'de> Visitor<'de> for YamlVisitor {
    type Value = Yaml;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("a YAML value")
    }

    fn visit_unit<E>(self) -> Result<Yaml, E> {
        Ok(Yaml::Null)
    }

    fn visit_none<E>(self) -> Result<Yaml, E> {
        Ok(Yaml::Null)
    }

    fn visit_bool<E>(self, value: bool) -> Result<Yaml, E> {
        Ok(Yaml::Bool(value))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Yaml, E> {
        Ok(Yaml::Integer(value))
    }

    fn visit_u64<E: serde::de::Error>(self, value: u64) -> Result<Yaml, E> {
        i64::try_from(value)
            .map(Yaml::Integer)
            .map_err(|_| E::custom(format!("the integer {value} does not fit into 64 bits with a sign")))
    }

    fn visit_i128<E: serde::de::Error>(self, value: i128) -> Result<Yaml, E> {
        Err(E::custom(format!("the integer {value} does not fit into 64 bits with a sign")))
    }

    fn visit_u128<E: serde::de::Error>(self, value: u128) -> Result<Yaml, E> {
        Err(E::custom(format!("the integer {value} does not fit into 64 bits with a sign")))
    }

    fn visit_f64<E>(self, value: f64) -> Result<Yaml, E> {
        Ok(Yaml::Double(value))
    }

    fn visit_str<E>(self, value: &str) -> Result<Yaml, E> {
        Ok(Yaml::Text(value.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Yaml, A::Error> {
        let mut items = Vec::new();
        while let Some(item) = seq.next_element::<Yaml>()? {
            items.push(item);
        }
        Ok(Yaml::List(items))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Yaml, A::Error> {
        let mut entries: Vec<(String, u64, Yaml)> = Vec::new();
        let mut seen = HashSet::new();
        while let Some(key) = map.next_key::<Spanned<String>>()? {
            let line = key.referenced.line();
            if !seen.insert(key.value.clone()) {
                return Err(A::Error::custom(format!("the key `{}` is there twice", key.value)));
            }
            entries.push((key.value, line, map.next_value::<Yaml>()?));
        }
        Ok(Yaml::Map(entries))
    }
}
