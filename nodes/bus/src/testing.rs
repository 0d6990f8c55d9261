//! Checks that node crates run in their tests.

use serde_json::Value;

use crate::{
    parameter::{NodeSettings, Range},
    settings::{self, settings_from_yaml, settings_to_yaml},
};

/// Asserts that a node's parameter table and its settings agree: the same names in the same order, a text for each,
/// defaults inside their ranges and of types that ROS has, and that the defaults survive the way through YAML.
///
/// # Panics
/// When they do not, with what and where.
#[expect(clippy::panic, reason = "an assertion for tests")]
pub fn check_parameters<S: NodeSettings>() {
    let defaults = S::default();
    let fields = match settings::fields(&defaults) {
        Ok(fields) => fields,
        Err(error) => panic!("{error}"),
    };
    let mut in_table: Vec<&str> = S::PARAMETERS.iter().map(|spec| spec.name).collect();
    let mut in_struct: Vec<&str> = fields.keys().map(String::as_str).collect();
    in_table.sort_unstable();
    in_struct.sort_unstable();
    assert_eq!(in_table, in_struct, "{}: PARAMETERS and fields differ", S::NODE);
    for spec in S::PARAMETERS {
        let what = format!("{}: parameter `{}`", S::NODE, spec.name);
        assert!(!spec.about.is_empty(), "{what} has no text");
        let value = &fields[spec.name];
        let values = match value {
            Value::Array(items) => items.as_slice(),
            one => std::slice::from_ref(one),
        };
        for value in values {
            let good = match (spec.range, value) {
                (Range::Any, Value::Bool(_) | Value::String(_)) => true,
                (Range::Any, Value::Number(number)) => number.is_i64() || number.is_f64(),
                (Range::Integer { min, max }, Value::Number(number)) => {
                    number.as_i64().is_some_and(|integer| (min..=max).contains(&integer))
                }
                (Range::Float { min, max }, Value::Number(number)) => {
                    number.is_f64() && number.as_f64().is_some_and(|double| (min..=max).contains(&double))
                }
                (Range::Choice(choices), Value::String(text)) => choices.contains(&text.as_str()),
                _ => false,
            };
            assert!(good, "{what}: default {value} is not in {:?}", spec.range);
        }
    }
    if let Err(reason) = defaults.check() {
        panic!("{}: the defaults do not fit together: {reason}", S::NODE);
    }
    let text = settings_to_yaml(&defaults);
    match settings_from_yaml::<S>(&text) {
        Ok(again) => {
            assert_eq!(settings_to_yaml(&again), text, "{}: the defaults change on their way through YAML", S::NODE)
        }
        Err(error) => panic!("{}: the defaults written as YAML are refused: {error}\n{text}", S::NODE),
    }
}
