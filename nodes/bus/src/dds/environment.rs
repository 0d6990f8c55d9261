//! What the environment variables of ROS 2 ask for.

use crate::{error::BusError, suggest::did_you_mean};

/// How far this node looks for others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Range {
    /// Every network interface.
    Subnet,
    /// This machine.
    Localhost,
    /// Nobody.
    Off,
}

/// How services travel over DDS.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ServiceMapping {
    /// The request's identity is beside the data: rmw_fastrtps_cpp.
    Enhanced,
    /// The request's identity is in front of the data: rmw_cyclonedds_cpp.
    Cyclone,
}

/// Everything that the environment says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Environment {
    /// The DDS domain.
    pub(crate) domain: u16,
    /// How far this node looks for others.
    pub(crate) range: Range,
    /// How services travel.
    pub(crate) mapping: ServiceMapping,
    /// What the user should know.
    pub(crate) warnings: Vec<String>,
}

impl Environment {
    /// Reads the process's environment; `mapping` is the parameter `service_mapping`.
    ///
    /// # Errors
    /// On a value that cannot be honoured.
    pub(crate) fn read(mapping: &str) -> Result<Environment, BusError> {
        Environment::from(mapping, &|name| {
            std::env::var_os(name)
                .map(|value| value.to_string_lossy().trim().to_owned())
                .filter(|value| !value.is_empty())
        })
    }

    /// The same from any source of variables.
    fn from(mapping: &str, get: &dyn Fn(&'static str) -> Option<String>) -> Result<Environment, BusError> {
        let mut warnings = Vec::new();
        refuse_security(get)?;
        if get("ROS_STATIC_PEERS").is_some() {
            warnings.push("ROS_STATIC_PEERS is not supported and has no effect".to_owned());
        }
        Ok(Environment {
            domain: domain(get)?,
            range: range(get)?,
            mapping: service_mapping(mapping, get, &mut warnings),
            warnings,
        })
    }
}

/// The domain; participants of domains above 232 would need port numbers that do not exist.
fn domain(get: &dyn Fn(&'static str) -> Option<String>) -> Result<u16, BusError> {
    let Some(text) = get("ROS_DOMAIN_ID") else {
        return Ok(0);
    };
    text.parse::<u16>().ok().filter(|domain| *domain <= 232).ok_or(BusError::Environment {
        variable: "ROS_DOMAIN_ID",
        got: text,
        expected: "an integer from 0 to 232".to_owned(),
    })
}

/// The discovery range; the older `ROS_LOCALHOST_ONLY=1` goes first, as in ROS 2 Jazzy.
fn range(get: &dyn Fn(&'static str) -> Option<String>) -> Result<Range, BusError> {
    match get("ROS_LOCALHOST_ONLY").as_deref() {
        None | Some("0") => {}
        Some("1") => return Ok(Range::Localhost),
        Some(other) => {
            return Err(BusError::Environment {
                variable: "ROS_LOCALHOST_ONLY",
                got: other.to_owned(),
                expected: "0 or 1".to_owned(),
            });
        }
    }
    match get("ROS_AUTOMATIC_DISCOVERY_RANGE").as_deref() {
        None | Some("SUBNET" | "SYSTEM_DEFAULT") => Ok(Range::Subnet),
        Some("LOCALHOST") => Ok(Range::Localhost),
        Some("OFF") => Ok(Range::Off),
        Some(other) => {
            let choices = ["SUBNET", "LOCALHOST", "OFF", "SYSTEM_DEFAULT"];
            Err(BusError::Environment {
                variable: "ROS_AUTOMATIC_DISCOVERY_RANGE",
                got: other.to_owned(),
                expected: format!("one of {}{}", choices.join(", "), did_you_mean(other, choices)),
            })
        }
    }
}

/// The mapping, from the parameter or from the middleware of the ROS 2 installation.
fn service_mapping(
    parameter: &str,
    get: &dyn Fn(&'static str) -> Option<String>,
    warnings: &mut Vec<String>,
) -> ServiceMapping {
    let rmw = get("RMW_IMPLEMENTATION").unwrap_or_default();
    if rmw.starts_with("rmw_zenoh") {
        warnings.push(format!(
            "RMW_IMPLEMENTATION={rmw}: these nodes speak DDS and cannot be heard by nodes on Zenoh; \
             use rmw_fastrtps_cpp or rmw_cyclonedds_cpp"
        ));
    }
    match parameter {
        "enhanced" => ServiceMapping::Enhanced,
        "cyclone" => ServiceMapping::Cyclone,
        _ if rmw.contains("cyclonedds") => ServiceMapping::Cyclone,
        _ => ServiceMapping::Enhanced,
    }
}

/// DDS security is not built in; where it is demanded, starting without it would be worse than not starting.
fn refuse_security(get: &dyn Fn(&'static str) -> Option<String>) -> Result<(), BusError> {
    let enabled = get("ROS_SECURITY_ENABLE").is_some_and(|value| value.eq_ignore_ascii_case("true"));
    match get("ROS_SECURITY_STRATEGY") {
        Some(strategy) if enabled && strategy == "Enforce" => Err(BusError::Environment {
            variable: "ROS_SECURITY_STRATEGY",
            got: strategy,
            expected: "Permissive or ROS_SECURITY_ENABLE=false, because DDS security is not built into these nodes"
                .to_owned(),
        }),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(variables: &[(&str, &str)]) -> Result<Environment, BusError> {
        Environment::from("auto", &|name| {
            variables.iter().find(|(other, _)| *other == name).map(|(_, value)| (*value).to_owned())
        })
    }

    #[test]
    fn without_variables_it_is_what_ros_does() {
        let environment = read(&[]).expect("an empty environment");
        assert_eq!(environment.domain, 0);
        assert_eq!(environment.range, Range::Subnet);
        assert_eq!(environment.mapping, ServiceMapping::Enhanced);
        assert!(environment.warnings.is_empty());
    }

    #[test]
    fn domains_have_limits() {
        assert_eq!(read(&[("ROS_DOMAIN_ID", "232")]).map(|e| e.domain).ok(), Some(232));
        for bad in ["233", "-1", "x", "99999999999"] {
            let error = read(&[("ROS_DOMAIN_ID", bad)]).expect_err("a bad domain");
            assert!(error.to_string().contains("0 to 232"), "{error}");
        }
    }

    #[test]
    fn ranges() {
        for (variables, wanted) in [
            (vec![("ROS_LOCALHOST_ONLY", "1")], Range::Localhost),
            (vec![("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")], Range::Localhost),
            (vec![("ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF")], Range::Off),
            (vec![("ROS_LOCALHOST_ONLY", "1"), ("ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET")], Range::Localhost),
        ] {
            assert_eq!(read(&variables).map(|e| e.range).ok(), Some(wanted));
        }
        let error = read(&[("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOSTT")]).expect_err("a typo");
        assert!(error.to_string().contains("did you mean `LOCALHOST`?"), "{error}");
    }

    #[test]
    fn the_service_mapping_follows_the_middleware() {
        let cyclone = [("RMW_IMPLEMENTATION", "rmw_cyclonedds_cpp")];
        assert_eq!(read(&cyclone).map(|e| e.mapping).ok(), Some(ServiceMapping::Cyclone));
        let zenoh = read(&[("RMW_IMPLEMENTATION", "rmw_zenoh_cpp")]).expect("a warning only");
        assert_eq!(zenoh.warnings.len(), 1);
    }

    #[test]
    fn enforced_security_is_refused() {
        let error =
            read(&[("ROS_SECURITY_ENABLE", "true"), ("ROS_SECURITY_STRATEGY", "Enforce")]).expect_err("no security");
        assert!(error.to_string().contains("not built into"), "{error}");
        assert!(read(&[("ROS_SECURITY_STRATEGY", "Enforce")]).is_ok());
    }
}
