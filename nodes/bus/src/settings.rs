//! From given parameters to a node's settings and back.

use serde_json::{Map, Value};

use crate::{
    parameter::{NodeSettings, ParameterSpec, ParameterValue, Range},
    parameter_error::{ParameterError, Place},
    parameter_file::{self, Given},
    suggest::did_you_mean,
};

/// Parameters that every node takes because the bus itself uses them.
pub(crate) const BUS_PARAMETERS: &[ParameterSpec] = &[
    ParameterSpec { name: "use_sim_time", about: "take the time from the topic /clock", range: Range::Any },
    ParameterSpec {
        name: "service_mapping",
        about: "how services travel over DDS: enhanced suits rmw_fastrtps_cpp, cyclone suits rmw_cyclonedds_cpp, auto follows RMW_IMPLEMENTATION",
        range: Range::Choice(&["auto", "enhanced", "cyclone"]),
    },
];

/// Whether the bus, not the node, takes this parameter.
fn is_bus_parameter(name: &str) -> bool {
    name.starts_with("qos_overrides.") || BUS_PARAMETERS.iter().any(|spec| spec.name == name)
}

/// What the bus itself takes from the parameters.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct BusParameters {
    /// Time comes from `/clock`.
    pub(crate) use_sim_time: bool,
    /// "auto", "enhanced" or "cyclone".
    pub(crate) service_mapping: String,
    /// Names of the QoS overrides given, which are taken but not applied.
    pub(crate) qos_overrides: Vec<String>,
}

impl BusParameters {
    /// Picks them out of everything given.
    pub(crate) fn from_given(given: &[Given]) -> Result<BusParameters, ParameterError> {
        let mut parameters = BusParameters { service_mapping: "auto".to_owned(), ..BusParameters::default() };
        for one in given {
            match one.name.as_str() {
                "use_sim_time" => {
                    parameters.use_sim_time =
                        convert(one, &BUS_PARAMETERS[0], &Value::Bool(false))? == Value::Bool(true);
                }
                "service_mapping" => {
                    let value = convert(one, &BUS_PARAMETERS[1], &Value::String(String::new()))?;
                    if let Value::String(value) = value {
                        parameters.service_mapping = value;
                    }
                }
                name if name.starts_with("qos_overrides.") => {
                    parameters.qos_overrides.push(name.to_owned());
                }
                _ => {}
            }
        }
        Ok(parameters)
    }
}

/// The default settings as a map from field to value.
pub(crate) fn fields<S: NodeSettings>(settings: &S) -> Result<Map<String, Value>, ParameterError> {
    match serde_json::to_value(settings) {
        Ok(Value::Object(map)) => Ok(map),
        Ok(other) => Err(ParameterError::Definition {
            node: S::NODE.to_owned(),
            reason: format!("the settings are no structure but {other}"),
        }),
        Err(error) => Err(ParameterError::Definition { node: S::NODE.to_owned(), reason: error.to_string() }),
    }
}

/// The defaults, changed by what was given, later ones over earlier ones, checked.
pub(crate) fn build<S: NodeSettings>(given: &[Given]) -> Result<S, ParameterError> {
    let defaults = fields(&S::default())?;
    let mut map = defaults.clone();
    for one in given {
        if let Some(spec) = S::PARAMETERS.iter().find(|spec| spec.name == one.name) {
            let default = defaults.get(spec.name).ok_or_else(|| ParameterError::Definition {
                node: S::NODE.to_owned(),
                reason: format!("`{}` is in the table but is no field", spec.name),
            })?;
            map.insert(spec.name.to_owned(), convert(one, spec, default)?);
        } else if !is_bus_parameter(&one.name) {
            return Err(unknown::<S>(one));
        }
    }
    let settings: S = serde_json::from_value(Value::Object(map))
        .map_err(|error| ParameterError::Together { node: S::NODE.to_owned(), reason: error.to_string() })?;
    settings.check().map_err(|reason| ParameterError::Together { node: S::NODE.to_owned(), reason })?;
    Ok(settings)
}

/// The error for a parameter that the node does not have.
fn unknown<S: NodeSettings>(given: &Given) -> ParameterError {
    let names = || S::PARAMETERS.iter().chain(BUS_PARAMETERS).map(|spec| spec.name);
    let mut suggestion = did_you_mean(&given.name, names());
    if suggestion.is_empty() {
        suggestion = format!("; it has {}", names().collect::<Vec<_>>().join(", "));
    }
    ParameterError::Unknown {
        place: given.place.clone().into(),
        node: S::NODE.to_owned(),
        name: crate::yaml::shorten(&given.name),
        suggestion,
    }
}

/// Converts a given value to the type of the default and checks the range.
fn convert(given: &Given, spec: &ParameterSpec, default: &Value) -> Result<Value, ParameterError> {
    let expected = match default {
        Value::Bool(_) => "a bool (true or false)".to_owned(),
        Value::Number(number) if number.is_f64() => "a double".to_owned(),
        Value::Number(_) => "an integer".to_owned(),
        Value::Array(_) => format!("a list, elements {}", spec.range),
        _ if matches!(spec.range, Range::Choice(_)) => format!("one of {}", spec.range),
        _ => "a string".to_owned(),
    };
    let wrong = || ParameterError::Type {
        place: given.place.clone().into(),
        name: spec.name.to_owned(),
        got: match &given.value {
            ParameterValue::Array(_) => given.value.type_name().to_owned(),
            value => format!("{} {}", value.type_name(), crate::yaml::shorten(&value.to_string())),
        },
        expected: match (default, &given.value) {
            (Value::String(_), value) if !matches!(value, ParameterValue::Array(_)) => {
                format!("{expected}; quote it: '\"{value}\"'")
            }
            _ => expected.clone(),
        },
    };
    match (default, &given.value) {
        (Value::Array(items), ParameterValue::Array(values)) => {
            let model = items.first().cloned().unwrap_or(match spec.range {
                Range::Float { .. } => Value::from(0.0),
                Range::Integer { .. } => Value::from(0),
                Range::Choice(_) => Value::from(""),
                Range::Any => match values.first() {
                    Some(ParameterValue::Bool(_)) => Value::Bool(false),
                    Some(ParameterValue::Integer(_)) => Value::from(0),
                    Some(ParameterValue::Double(_)) => Value::from(0.0),
                    _ => Value::from(""),
                },
            });
            let converted: Result<Vec<Value>, ParameterError> =
                values.iter().map(|value| scalar(given, value, spec, &model).unwrap_or_else(|| Err(wrong()))).collect();
            Ok(Value::Array(converted?))
        }
        (default, value) => scalar(given, value, spec, default).unwrap_or_else(|| Err(wrong())),
    }
}

/// Converts one scalar; `None` when the type is wrong.
fn scalar(
    given: &Given,
    value: &ParameterValue,
    spec: &ParameterSpec,
    default: &Value,
) -> Option<Result<Value, ParameterError>> {
    let out_of_range = |expected: String, suggestion: String| {
        Some(Err(ParameterError::OutOfRange {
            place: given.place.clone().into(),
            name: spec.name.to_owned(),
            got: crate::yaml::shorten(&value.to_string()),
            expected,
            suggestion,
        }))
    };
    match (default, value) {
        (Value::Bool(_), ParameterValue::Bool(value)) => Some(Ok(Value::Bool(*value))),
        (Value::Number(number), ParameterValue::Integer(integer)) if !number.is_f64() => match spec.range {
            Range::Integer { min, max } if !(min..=max).contains(integer) => {
                out_of_range(spec.range.to_string(), String::new())
            }
            _ => Some(Ok(Value::from(*integer))),
        },
        (Value::Number(number), ParameterValue::Integer(_) | ParameterValue::Double(_)) if number.is_f64() => {
            let double = match value {
                ParameterValue::Integer(integer) => *integer as f64,
                ParameterValue::Double(double) => *double,
                _ => return None,
            };
            if !double.is_finite() {
                return out_of_range("a finite number".to_owned(), String::new());
            }
            match spec.range {
                Range::Float { min, max } if !(min..=max).contains(&double) => {
                    out_of_range(spec.range.to_string(), String::new())
                }
                _ => Some(Ok(Value::from(double))),
            }
        }
        (Value::String(_), ParameterValue::String(text)) => match spec.range {
            Range::Choice(choices) if !choices.contains(&text.as_str()) => {
                out_of_range(format!("one of {}", spec.range), did_you_mean(text, choices.iter().copied()))
            }
            _ => Some(Ok(Value::String(text.clone()))),
        },
        _ => None,
    }
}

/// A field's value as a ROS parameter.
pub(crate) fn to_parameter(value: &Value) -> ParameterValue {
    match value {
        Value::Bool(value) => ParameterValue::Bool(*value),
        Value::Number(number) => match number.as_i64() {
            Some(integer) => ParameterValue::Integer(integer),
            None => ParameterValue::Double(number.as_f64().unwrap_or(f64::NAN)),
        },
        Value::String(text) => ParameterValue::String(text.clone()),
        Value::Array(items) => ParameterValue::Array(items.iter().map(to_parameter).collect()),
        Value::Null => ParameterValue::Double(f64::NAN),
        Value::Object(_) => ParameterValue::String(value.to_string()),
    }
}

/// The settings as a ROS parameter file (section `/**`), fields in the table's order.
/// Read back by [`settings_from_yaml`] they are the same, bit for bit.
pub fn settings_to_yaml<S: NodeSettings>(settings: &S) -> String {
    let fields = fields(settings).unwrap_or_default();
    let mut text = "/**:\n  ros__parameters:\n".to_owned();
    for spec in S::PARAMETERS {
        if let Some(value) = fields.get(spec.name) {
            text.push_str(&format!("    {}: {}\n", spec.name, to_parameter(value)));
        }
    }
    text
}

/// Settings from a ROS parameter file's text; every section counts, whatever node it is for.
///
/// # Errors
/// As for parameters given to a node.
pub fn settings_from_yaml<S: NodeSettings>(text: &str) -> Result<S, ParameterError> {
    let given: Vec<Given> =
        parameter_file::parse(text, &Place::Text)?.into_iter().flat_map(|section| section.parameters).collect();
    build(&given)
}

#[cfg(test)]
mod tests;
