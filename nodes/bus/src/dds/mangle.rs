//! How ROS 2 names look on DDS.

use crate::{error::BusError, transport::split_type};

/// `/a/b` → `rt/a/b`.
pub(crate) fn topic(name: &str) -> String {
    format!("rt{name}")
}

/// `rt/a/b` → `/a/b`; `None` for what is no ROS topic.
pub(crate) fn ros_topic(dds: &str) -> Option<&str> {
    dds.strip_prefix("rt").filter(|name| name.starts_with('/'))
}

/// Names of the request and the reply topic of a service.
pub(crate) fn service(name: &str) -> (String, String) {
    (format!("rq{name}Request"), format!("rr{name}Reply"))
}

/// `pkg/msg/Name` → `pkg::msg::dds_::Name_`.
pub(crate) fn type_name(ros: &str) -> Result<String, BusError> {
    let (package, kind, name) = split_type(ros, &["msg", "srv", "action"])?;
    Ok(format!("{package}::{kind}::dds_::{name}_"))
}

/// `pkg::msg::dds_::Name_` → `pkg/msg/Name`; anything else stays as it is.
pub(crate) fn ros_type(dds: &str) -> String {
    let parts: Vec<&str> = dds.split("::").collect();
    match parts.as_slice() {
        [package, kind, "dds_", name] => {
            format!("{package}/{kind}/{}", name.strip_suffix('_').unwrap_or(name))
        }
        _ => dds.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_there_and_back() {
        assert_eq!(topic("/a/b"), "rt/a/b");
        assert_eq!(ros_topic("rt/a/b"), Some("/a/b"));
        assert_eq!(ros_topic("rq/a/bRequest"), None);
        assert_eq!(ros_topic("rtx/a"), None);
        assert_eq!(service("/n/get").0, "rq/n/getRequest");
        assert_eq!(service("/n/get").1, "rr/n/getReply");
        assert_eq!(type_name("std_msgs/msg/String").ok().as_deref(), Some("std_msgs::msg::dds_::String_"));
        assert_eq!(ros_type("std_msgs::msg::dds_::String_"), "std_msgs/msg/String");
        assert_eq!(ros_type("HelloWorld"), "HelloWorld");
        for bad in ["", "a/b", "std_msgs/message/String", "a/msg/B/c", "a::msg/B", "a/msg/é"] {
            assert!(type_name(bad).is_err(), "{bad} was taken");
        }
    }
}
