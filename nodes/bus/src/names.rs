//! ROS names: what is allowed, and how a relative name becomes an absolute one.
//!
//! Rules: <https://design.ros2.org/articles/topic_and_service_names.html>.

use thiserror::Error;

/// Longest name taken, in bytes; the DDS limit less the `rt/` prefix.
pub const MAX_NAME_BYTES: usize = 250;

/// A name that ROS would refuse.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("the {kind} name `{got}` is not allowed: {reason}")]
pub struct NameError {
    /// What was named: "topic", "node", ….
    pub kind: &'static str,
    /// The name as given.
    pub got: String,
    /// The broken rule.
    pub reason: &'static str,
}

/// A node's base name and namespace.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct NodeName {
    /// Base name, such as `reward_posterior`.
    pub name: String,
    /// Absolute namespace, such as `/apprentice`; the root is `/`.
    pub namespace: String,
}

impl NodeName {
    /// Checks both parts; a namespace without a leading slash gets one.
    ///
    /// # Errors
    /// When a part breaks the naming rules.
    pub fn new(name: &str, namespace: &str) -> Result<NodeName, NameError> {
        check_token("node", name, name)?;
        let namespace = if namespace.starts_with('/') { namespace.to_owned() } else { format!("/{namespace}") };
        if namespace != "/" {
            check_absolute("namespace", &namespace)?;
        }
        Ok(NodeName { name: name.to_owned(), namespace })
    }

    /// The fully qualified name, such as `/apprentice/reward_posterior`.
    pub fn full(&self) -> String {
        join(&self.namespace, &self.name)
    }

    /// The logger's name, such as `apprentice.reward_posterior`.
    pub fn logger(&self) -> String {
        self.full().trim_start_matches('/').replace('/', ".")
    }

    /// Expands a topic or service name: `/a` is absolute, `a` lies in the namespace, `~/a` under the node.
    ///
    /// # Errors
    /// When the name breaks the naming rules.
    pub fn expand(&self, kind: &'static str, name: &str) -> Result<String, NameError> {
        let absolute = if let Some(rest) = name.strip_prefix("~/") {
            join(&self.full(), rest)
        } else if name == "~" {
            self.full()
        } else if name.starts_with('/') {
            name.to_owned()
        } else {
            join(&self.namespace, name)
        };
        check_absolute(kind, &absolute).map_err(|error| NameError { got: name.to_owned(), ..error })?;
        Ok(absolute)
    }
}

/// `namespace` and `name` with exactly one slash between them.
fn join(namespace: &str, name: &str) -> String {
    if namespace == "/" { format!("/{name}") } else { format!("{namespace}/{name}") }
}

/// Refuses an absolute name that ROS would refuse.
fn check_absolute(kind: &'static str, name: &str) -> Result<(), NameError> {
    let refuse = |reason| Err(NameError { kind, got: name.to_owned(), reason });
    if name.len() > MAX_NAME_BYTES {
        return refuse("it is longer than 250 bytes");
    }
    let Some(rest) = name.strip_prefix('/') else {
        return refuse("it must start with `/`");
    };
    if rest.is_empty() {
        return refuse("it is empty");
    }
    for token in rest.split('/') {
        check_token(kind, name, token)?;
    }
    Ok(())
}

/// Refuses one part of a name (between slashes) that ROS would refuse.
fn check_token(kind: &'static str, whole: &str, token: &str) -> Result<(), NameError> {
    let refuse = |reason| Err(NameError { kind, got: whole.to_owned(), reason });
    match token.as_bytes().first() {
        None => return refuse("a part between slashes is empty"),
        Some(first) if first.is_ascii_digit() => {
            return refuse("a part must not start with a digit");
        }
        Some(_) => {}
    }
    if !token.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_') {
        return refuse("only letters, digits, `_` and `/` are allowed");
    }
    if token.contains("__") {
        return refuse("`__` is reserved");
    }
    if token.len() > MAX_NAME_BYTES {
        return refuse("it is longer than 250 bytes");
    }
    Ok(())
}

/// Whether a fully qualified node name fits a pattern of a parameter file or a node prefix of an option:
/// a bare `name` fits the node in any namespace; `*` stands for one part, `**` for any number of parts.
pub(crate) fn node_matches(pattern: &str, node: &NodeName) -> bool {
    if !pattern.contains('/') && !pattern.contains('*') {
        return pattern == node.name;
    }
    let full = node.full();
    let parts: Vec<&str> = full.split('/').filter(|part| !part.is_empty()).collect();
    let wanted: Vec<&str> = pattern.split('/').filter(|part| !part.is_empty()).collect();
    parts_match(&wanted, &parts)
}

/// Matches parts against a pattern; the table is `reachable[i]` = "the first `i` parts are matched".
fn parts_match(pattern: &[&str], parts: &[&str]) -> bool {
    let mut reachable = vec![false; parts.len() + 1];
    reachable[0] = true;
    for wanted in pattern {
        let mut next = vec![false; parts.len() + 1];
        for (index, here) in reachable.iter().enumerate() {
            if !here {
                continue;
            }
            if *wanted == "**" {
                next[index..].fill(true);
            } else if parts.get(index).is_some_and(|part| *wanted == "*" || part == wanted) {
                next[index + 1] = true;
            }
        }
        reachable = next;
    }
    reachable[parts.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn node() -> NodeName {
        NodeName::new("planner", "/a/b").expect("a legal name")
    }

    #[test]
    fn names_expand_as_ros_does() {
        let node = node();
        for (given, wanted) in
            [("scene", "/a/b/scene"), ("/scene", "/scene"), ("~/scene", "/a/b/planner/scene"), ("x/y", "/a/b/x/y")]
        {
            assert_eq!(node.expand("topic", given).as_deref(), Ok(wanted));
        }
        let root = NodeName::new("planner", "").expect("a legal name");
        assert_eq!(root.full(), "/planner");
        assert_eq!(root.expand("topic", "scene").as_deref(), Ok("/scene"));
        assert_eq!(node.logger(), "a.b.planner");
    }

    #[test]
    fn illegal_names_are_refused() {
        for name in ["", "a//b", "a/", "1a", "a b", "a__b", "ä", "/", "a/~/b", "~x"] {
            assert!(node().expand("topic", name).is_err(), "{name:?} was taken");
        }
        assert!(node().expand("topic", &"x".repeat(300)).is_err());
        assert!(NodeName::new("a/b", "/").is_err());
    }

    #[test]
    fn patterns_of_parameter_files() {
        let node = node();
        for pattern in ["/**", "/a/b/planner", "planner", "/a/*/planner", "/**/planner", "/a/**", "/*/*/*"] {
            assert!(node_matches(pattern, &node), "{pattern} did not match");
        }
        for pattern in ["/*", "/planner", "other", "/a/planner", "/a/b/planner/c", "/*/*"] {
            assert!(!node_matches(pattern, &node), "{pattern} matched");
        }
    }
}
