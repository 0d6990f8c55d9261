//! ROS parameter files: which sections are for which node, and the values they give.

use std::{fs::File, io::Read, path::Path};

use crate::{
    parameter::ParameterValue,
    parameter_error::{ParameterError, Place},
    yaml::{self, MAX_YAML_BYTES, Yaml, shorten},
};

/// The key under which a node's parameters lie.
const PARAMETERS_KEY: &str = "ros__parameters";

/// Deepest nesting of namespaces and of dotted parameter names.
const MAX_NESTING: usize = 16;

/// One parameter as it was given.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Given {
    /// Dotted name.
    pub(crate) name: String,
    /// The value.
    pub(crate) value: ParameterValue,
    /// Where.
    pub(crate) place: Place,
}

/// One section: the nodes it is for, and its parameters in order.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Section {
    /// Node pattern, such as `/**`, `/ns/name` or `name`.
    pub(crate) pattern: String,
    /// Its parameters.
    pub(crate) parameters: Vec<Given>,
}

/// Reads a parameter file.
pub(crate) fn read(path: &Path) -> Result<Vec<Section>, ParameterError> {
    let unreadable = |error: std::io::Error| ParameterError::Read { path: path.to_owned(), reason: error.to_string() };
    let file = File::open(path).map_err(unreadable)?;
    let mut bytes = Vec::new();
    file.take(MAX_YAML_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > MAX_YAML_BYTES {
        return Err(ParameterError::TooLarge {
            path: path.to_owned(),
            got: std::fs::metadata(path).map_or(bytes.len() as u64, |data| data.len()),
            limit: MAX_YAML_BYTES,
        });
    }
    let text = String::from_utf8(bytes).map_err(|error| ParameterError::Yaml {
        place: Place::File(path.to_owned(), 0).into(),
        reason: format!("it is no UTF-8 text (byte {})", error.utf8_error().valid_up_to()),
    })?;
    parse(&text, &|line| Place::File(path.to_owned(), line))
}

/// Parses the text of a parameter file; `place` says where a line is.
pub(crate) fn parse(text: &str, place: &dyn Fn(u64) -> Place) -> Result<Vec<Section>, ParameterError> {
    let tree =
        yaml::parse(text).map_err(|(line, reason)| ParameterError::Yaml { place: place(line).into(), reason })?;
    let mut sections = Vec::new();
    match tree {
        Yaml::Null => {}
        Yaml::Map(entries) => sections_in("", entries, place, 0, &mut sections)?,
        other => {
            return Err(ParameterError::Structure {
                place: place(1).into(),
                got: other.describe(),
                expected: "`<node>:` with `ros__parameters:` under it".to_owned(),
            });
        }
    }
    Ok(sections)
}

/// Which nodes a parameter file's text is for: the pattern of each section, such as `/**/name`, in their order.
///
/// # Errors
/// Text that is no parameter file.
pub fn sections_of(text: &str) -> Result<Vec<String>, ParameterError> {
    Ok(parse(text, &Place::Text)?.into_iter().map(|section| section.pattern).collect())
}

/// Walks namespaces and nodes down to each `ros__parameters`.
fn sections_in(
    path: &str,
    entries: Vec<(String, u64, Yaml)>,
    place: &dyn Fn(u64) -> Place,
    depth: usize,
    sections: &mut Vec<Section>,
) -> Result<(), ParameterError> {
    for (key, line, value) in entries {
        let structure = |got: String, expected: &str| ParameterError::Structure {
            place: place(line).into(),
            got,
            expected: expected.to_owned(),
        };
        if key == PARAMETERS_KEY {
            if path.is_empty() {
                return Err(structure(
                    "`ros__parameters` at the top".to_owned(),
                    "a node's name above it, such as `/**:`",
                ));
            }
            let mut parameters = Vec::new();
            match value {
                Yaml::Null => {}
                Yaml::Map(entries) => parameters_in("", entries, place, 0, &mut parameters)?,
                other => return Err(structure(other.describe(), "a mapping of parameters")),
            }
            sections.push(Section { pattern: path.to_owned(), parameters });
            continue;
        }
        let below = match path {
            "" => key.clone(),
            _ => format!("{}/{}", path.trim_end_matches('/'), key.trim_start_matches('/')),
        };
        match value {
            Yaml::Map(entries) if depth < MAX_NESTING => {
                sections_in(&below, entries, place, depth + 1, sections)?;
            }
            other => {
                return Err(structure(
                    format!("`{}: {}`", shorten(&key), other.describe()),
                    "`<node>:` with `ros__parameters:` under it",
                ));
            }
        }
    }
    Ok(())
}

/// Flattens nested mappings to dotted names.
fn parameters_in(
    prefix: &str,
    entries: Vec<(String, u64, Yaml)>,
    place: &dyn Fn(u64) -> Place,
    depth: usize,
    parameters: &mut Vec<Given>,
) -> Result<(), ParameterError> {
    for (key, line, value) in entries {
        let name = match prefix {
            "" => key,
            _ => format!("{prefix}.{key}"),
        };
        match value {
            Yaml::Map(entries) if depth < MAX_NESTING => {
                parameters_in(&name, entries, place, depth + 1, parameters)?;
            }
            value => {
                let value = to_value(value).map_err(|got| ParameterError::Structure {
                    place: place(line).into(),
                    got: format!("`{}` = {got}", shorten(&name)),
                    expected: "a bool, a number, a string, or a list of one of these".to_owned(),
                })?;
                parameters.push(Given { name, value, place: place(line) });
            }
        }
    }
    Ok(())
}

/// A parameter value from YAML, typed as ROS does; integers among doubles become doubles.
///
/// # Errors
/// What was got instead.
pub(crate) fn to_value(value: Yaml) -> Result<ParameterValue, String> {
    Ok(match value {
        Yaml::Bool(value) => ParameterValue::Bool(value),
        Yaml::Integer(value) => ParameterValue::Integer(value),
        Yaml::Double(value) => ParameterValue::Double(value),
        Yaml::Text(value) => ParameterValue::String(value),
        Yaml::List(items) => {
            let mut values = Vec::with_capacity(items.len());
            for item in items {
                match item {
                    Yaml::List(_) | Yaml::Map(_) | Yaml::Null => {
                        return Err(format!("a list that holds {}", item.describe()));
                    }
                    item => values.push(to_value(item)?),
                }
            }
            if values.iter().any(|value| matches!(value, ParameterValue::Double(_))) {
                for value in &mut values {
                    if let ParameterValue::Integer(integer) = value {
                        *value = ParameterValue::Double(*integer as f64);
                    }
                }
            }
            if let [first, rest @ ..] = values.as_slice()
                && let Some(other) = rest.iter().find(|value| value.type_name() != first.type_name())
            {
                return Err(format!("a list of mixed types ({} and {})", first.type_name(), other.type_name()));
            }
            ParameterValue::Array(values)
        }
        other @ (Yaml::Null | Yaml::Map(_)) => return Err(other.describe()),
    })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn sections(text: &str) -> Result<Vec<Section>, ParameterError> {
        parse(text, &Place::Text)
    }

    #[test]
    fn sections_nested_names_and_lines() {
        let text = "/**:\n  ros__parameters:\n    a: 1\n    b:\n      c: [1, 2.5]\n      d: 'on'\n/ns:\n  node:\n    ros__parameters:\n      e: true\n";
        let sections = sections(text).expect("a good file");
        assert_eq!(sections.len(), 2);
        assert_eq!(sections[0].pattern, "/**");
        assert_eq!(sections[1].pattern, "/ns/node");
        let names: Vec<_> =
            sections[0].parameters.iter().map(|given| (given.name.as_str(), given.place.clone())).collect();
        assert_eq!(names, [("a", Place::Text(3)), ("b.c", Place::Text(5)), ("b.d", Place::Text(6))]);
        assert_eq!(
            sections[0].parameters[1].value,
            ParameterValue::Array(vec![ParameterValue::Double(1.0), ParameterValue::Double(2.5)])
        );
        assert_eq!(sections[0].parameters[2].value, ParameterValue::String("on".to_owned()));
    }

    #[test]
    fn broken_files_name_the_line() {
        for (text, line) in [
            ("a: 1\n", 1),
            ("/**:\n  ros__parameters: 3\n", 2),
            ("/**:\n  ros__parameters:\n    x: null\n", 3),
            ("/**:\n  ros__parameters:\n    x: [1, a]\n", 3),
            ("/**:\n  ros__parameters:\n    x: [[1]]\n", 3),
        ] {
            let Err(ParameterError::Structure { place, .. }) = sections(text) else {
                panic!("{text:?} was taken");
            };
            assert_eq!(*place, Place::Text(line), "{text:?}");
        }
        assert!(matches!(sections("/**:\n  ros__parameters:\n    x: 1\n    x: 2\n"), Err(ParameterError::Yaml { .. })));
        assert!(matches!(sections("a: [1"), Err(ParameterError::Yaml { .. })));
    }

    #[test]
    fn bombs_are_refused() {
        let deep = "[".repeat(10_000);
        assert!(sections(&deep).is_err());
        let mut laughs = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n".to_owned();
        for level in 1..12 {
            let previous = format!("*a{}, ", level - 1).repeat(10);
            laughs.push_str(&format!("a{level}: &a{level} [{previous}]\n"));
        }
        assert!(sections(&laughs).is_err());
        assert!(sections(&" ".repeat(1_000_001)).is_err());
    }

    proptest! {
        #[test]
        fn no_text_makes_it_panic(text in ".{0,200}") {
            let _ = sections(&text);
        }

        #[test]
        fn no_yaml_like_text_makes_it_panic(text in "[-a:\\[\\]{}&*!|>'\"0-9.e \n_/,?#%@~]{0,120}") {
            let _ = sections(&text);
        }
    }
}
