//! The six services behind `ros2 param`: every parameter with its description and range, none of them changeable.

use std::sync::Arc;

use apprentice_msgs::rcl_interfaces::{
    DescribeParameters, DescribeParametersResponse, FloatingPointRange, GetParameterTypes, GetParameterTypesResponse,
    GetParameters, GetParametersResponse, IntegerRange, ListParameters, ListParametersRequest, ListParametersResponse,
    ListParametersResult, ParameterDescriptor, ParameterType, ParameterValue as RosValue, SetParameters,
    SetParametersAtomically, SetParametersAtomicallyResponse, SetParametersResponse, SetParametersResult,
};

use crate::{
    bus::Bus,
    error::BusError,
    parameter::{NodeSettings, ParameterSpec, ParameterValue, Range},
    settings::{self, BUS_PARAMETERS, BusParameters},
    yaml::shorten,
};

/// One parameter as the services show it.
#[derive(Debug, Clone, PartialEq)]
struct Entry {
    value: RosValue,
    descriptor: ParameterDescriptor,
}

/// Every parameter of a node.
#[derive(Debug, Clone, PartialEq)]
struct Table {
    entries: Vec<Entry>,
}

/// Offers the six services under the node's name.
pub(crate) fn serve<E: Send + 'static, S: NodeSettings>(
    bus: &mut Bus<E>,
    settings: &S,
    bus_parameters: &BusParameters,
) -> Result<(), BusError> {
    let table = Arc::new(Table::new(settings, bus_parameters)?);
    let here = Arc::clone(&table);
    bus.serve::<ListParameters>("~/list_parameters", move |request| ListParametersResponse {
        result: here.list(&request),
    })?;
    let here = Arc::clone(&table);
    bus.serve::<GetParameters>("~/get_parameters", move |request| GetParametersResponse {
        values: here.each(&request.names, |entry| entry.value.clone()),
    })?;
    let here = Arc::clone(&table);
    bus.serve::<GetParameterTypes>("~/get_parameter_types", move |request| GetParameterTypesResponse {
        types: here.each(&request.names, |entry| entry.value.r#type),
    })?;
    let here = Arc::clone(&table);
    bus.serve::<DescribeParameters>("~/describe_parameters", move |request| DescribeParametersResponse {
        descriptors: request.names.iter().map(|name| here.describe(name)).collect(),
    })?;
    let here = Arc::clone(&table);
    bus.serve::<SetParameters>("~/set_parameters", move |request| SetParametersResponse {
        results: request.parameters.iter().map(|parameter| here.refuse(&parameter.name)).collect(),
    })?;
    bus.serve::<SetParametersAtomically>("~/set_parameters_atomically", move |request| {
        SetParametersAtomicallyResponse {
            result: request
                .parameters
                .first()
                .map_or(SetParametersResult { successful: true, reason: String::new() }, |parameter| {
                    table.refuse(&parameter.name)
                }),
        }
    })
}

impl Table {
    /// The node's own parameters and those of the bus.
    fn new<S: NodeSettings>(settings: &S, bus_parameters: &BusParameters) -> Result<Table, BusError> {
        let fields = settings::fields(settings)?;
        let own = S::PARAMETERS.iter().filter_map(|spec| {
            let value = fields.get(spec.name)?;
            Some(entry(spec, &settings::to_parameter(value)))
        });
        let of_bus = BUS_PARAMETERS.iter().zip([
            ParameterValue::Bool(bus_parameters.use_sim_time),
            ParameterValue::String(bus_parameters.service_mapping.clone()),
        ]);
        Ok(Table { entries: own.chain(of_bus.map(|(spec, value)| entry(spec, &value))).collect() })
    }

    /// The parameter of this name.
    fn find(&self, name: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.descriptor.name == name)
    }

    /// Something of each parameter named; the default for those that there are not.
    fn each<T: Default>(&self, names: &[String], get: impl Fn(&Entry) -> T) -> Vec<T> {
        names.iter().map(|name| self.find(name).map(&get).unwrap_or_default()).collect()
    }

    /// The descriptor of a parameter; of the type "not set" when there is none.
    fn describe(&self, name: &str) -> ParameterDescriptor {
        self.find(name).map_or_else(
            || ParameterDescriptor { name: shorten(name), ..ParameterDescriptor::default() },
            |entry| entry.descriptor.clone(),
        )
    }

    /// Names below the prefixes down to a depth, as rclcpp counts it.
    fn list(&self, request: &ListParametersRequest) -> ListParametersResult {
        let shallow = |rest: &str| {
            request.depth == ListParametersRequest::DEPTH_RECURSIVE
                || (rest.matches('.').count() as u64) < request.depth
        };
        let wanted = |name: &str| {
            if request.prefixes.is_empty() {
                return shallow(name);
            }
            request.prefixes.iter().any(|prefix| {
                name == prefix
                    || name.strip_prefix(prefix.as_str()).and_then(|rest| rest.strip_prefix('.')).is_some_and(shallow)
            })
        };
        let mut result = ListParametersResult::default();
        for entry in &self.entries {
            let name = &entry.descriptor.name;
            if !wanted(name) {
                continue;
            }
            result.names.push(name.clone());
            if let Some((prefix, _)) = name.rsplit_once('.')
                && !result.prefixes.iter().any(|known| known == prefix)
            {
                result.prefixes.push(prefix.to_owned());
            }
        }
        result
    }

    /// Why a parameter is not set.
    fn refuse(&self, name: &str) -> SetParametersResult {
        let reason = if self.find(name).is_some() {
            format!("{name} is read-only while the node runs; restart the node with -p {name}:=VALUE")
        } else {
            format!("there is no parameter {}", shorten(name))
        };
        SetParametersResult { successful: false, reason }
    }
}

/// One parameter as the services show it.
fn entry(spec: &ParameterSpec, value: &ParameterValue) -> Entry {
    let value = ros_value(spec, value);
    let mut descriptor = ParameterDescriptor {
        name: spec.name.to_owned(),
        r#type: value.r#type,
        description: spec.about.to_owned(),
        read_only: true,
        ..ParameterDescriptor::default()
    };
    match spec.range {
        Range::Any => {}
        Range::Integer { min, max } => {
            descriptor.integer_range.push(IntegerRange { from_value: min, to_value: max, step: 0 })
        }
        Range::Float { min, max } => {
            descriptor.floating_point_range.push(FloatingPointRange { from_value: min, to_value: max, step: 0.0 })
        }
        Range::Choice(choices) => {
            descriptor.additional_constraints = format!("one of {}", choices.join(", "));
        }
    }
    Entry { value, descriptor }
}

/// A value as the message has it.
fn ros_value(spec: &ParameterSpec, value: &ParameterValue) -> RosValue {
    let mut ros = RosValue::default();
    match value {
        ParameterValue::Bool(value) => {
            ros.r#type = ParameterType::PARAMETER_BOOL;
            ros.bool_value = *value;
        }
        ParameterValue::Integer(value) => {
            ros.r#type = ParameterType::PARAMETER_INTEGER;
            ros.integer_value = *value;
        }
        ParameterValue::Double(value) => {
            ros.r#type = ParameterType::PARAMETER_DOUBLE;
            ros.double_value = *value;
        }
        ParameterValue::String(value) => {
            ros.r#type = ParameterType::PARAMETER_STRING;
            ros.string_value = value.clone();
        }
        ParameterValue::Array(items) => {
            ros.r#type = match (items.first(), spec.range) {
                (Some(ParameterValue::Bool(_)), _) => ParameterType::PARAMETER_BOOL_ARRAY,
                (Some(ParameterValue::Integer(_)), _) | (None, Range::Integer { .. }) => {
                    ParameterType::PARAMETER_INTEGER_ARRAY
                }
                (Some(ParameterValue::Double(_)), _) | (None, Range::Float { .. }) => {
                    ParameterType::PARAMETER_DOUBLE_ARRAY
                }
                _ => ParameterType::PARAMETER_STRING_ARRAY,
            };
            for item in items {
                match item {
                    ParameterValue::Bool(value) => ros.bool_array_value.push(*value),
                    ParameterValue::Integer(value) => ros.integer_array_value.push(*value),
                    ParameterValue::Double(value) => ros.double_array_value.push(*value),
                    ParameterValue::String(value) => ros.string_array_value.push(value.clone()),
                    ParameterValue::Array(_) => {}
                }
            }
        }
    }
    ros
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(names: &[&'static str]) -> Table {
        Table {
            entries: names
                .iter()
                .map(|name| {
                    let spec = ParameterSpec { name, about: "a test", range: Range::Float { min: 0.0, max: 1.0 } };
                    entry(&spec, &ParameterValue::Double(0.5))
                })
                .collect(),
        }
    }

    fn list(prefixes: &[&str], depth: u64) -> ListParametersResult {
        table(&["a", "b.c", "b.d.e", "bx"]).list(&ListParametersRequest {
            prefixes: prefixes.iter().map(|prefix| (*prefix).to_owned()).collect(),
            depth,
        })
    }

    #[test]
    fn listing_counts_depth_and_prefixes_as_rclcpp_does() {
        assert_eq!(list(&[], 0).names, ["a", "b.c", "b.d.e", "bx"]);
        assert_eq!(list(&[], 0).prefixes, ["b", "b.d"]);
        assert_eq!(list(&[], 1).names, ["a", "bx"]);
        assert_eq!(list(&["b"], 0).names, ["b.c", "b.d.e"]);
        assert_eq!(list(&["b"], 1).names, ["b.c"]);
        assert_eq!(list(&["a"], 0).names, ["a"]);
        assert!(list(&["c"], 0).names.is_empty());
    }

    #[test]
    fn descriptors_carry_text_and_range_and_are_read_only() {
        let descriptor = table(&["a"]).describe("a");
        assert!(descriptor.read_only);
        assert_eq!(descriptor.description, "a test");
        assert_eq!(descriptor.floating_point_range[0].to_value, 1.0);
        assert_eq!(descriptor.r#type, ParameterType::PARAMETER_DOUBLE);
        assert_eq!(table(&["a"]).describe("x").r#type, ParameterType::PARAMETER_NOT_SET);
    }

    #[test]
    fn setting_is_refused_with_what_to_do() {
        let refused = table(&["a"]).refuse("a");
        assert!(!refused.successful);
        assert!(refused.reason.contains("restart the node with -p a:="), "{}", refused.reason);
    }
}
