//! Schema texts, of our own types and of foreign ones.

use std::collections::BTreeMap;

use apprentice_msgs::{SchemaError, all_types, compose_schema, definition, schema};

#[test]
fn the_schema_of_a_header_is_what_rosbag2_writes() {
    let rule = "=".repeat(80);
    let expected = format!(
        "builtin_interfaces/Time stamp\nstring frame_id\n\n{rule}\n\
         MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n"
    );
    assert_eq!(schema("std_msgs/msg/Header"), Some(expected.as_str()));
}

#[test]
fn every_message_has_a_schema_in_which_no_dependency_occurs_twice() {
    for name in all_types() {
        let text = schema(name).expect(name);
        assert!(text.starts_with(definition(name).expect(name)), "{name}");
        let mut parts: Vec<&str> = text.lines().filter(|l| l.starts_with("MSG: ")).collect();
        let count = parts.len();
        parts.sort_unstable();
        parts.dedup();
        assert_eq!(parts.len(), count, "{name}");
    }
}

#[test]
fn dependencies_come_depth_first() {
    let text = schema("apprentice_msgs/msg/TableScene").expect("known");
    let parts: Vec<&str> = text.lines().filter_map(|l| l.strip_prefix("MSG: ")).collect();
    let expected = [
        "std_msgs/Header",
        "builtin_interfaces/Time",
        "apprentice_msgs/SceneObject",
        "geometry_msgs/Vector3",
        "geometry_msgs/Pose",
        "geometry_msgs/Point",
        "geometry_msgs/Quaternion",
    ];
    assert_eq!(parts, expected);
}

#[test]
fn services_have_definitions_and_unknown_types_have_nothing() {
    let text = definition("rcl_interfaces/srv/ListParameters").expect("known");
    assert!(text.contains("DEPTH_RECURSIVE"));
    assert_eq!(definition("std_msgs/msg/Nothing"), None);
    assert_eq!(schema("rcl_interfaces/srv/ListParameters"), None);
}

fn compose(root: &str, texts: &[(&str, &str)]) -> Result<String, SchemaError> {
    let texts: BTreeMap<&str, &str> = texts.iter().copied().collect();
    compose_schema(root, |name| texts.get(name).map(|text| (*text).to_owned()))
}

#[test]
fn foreign_definitions_make_a_schema_too() {
    let texts = [("a/msg/A", "B b # mine"), ("a/msg/B", "c/C[<=3] c\n"), ("c/msg/C", "")];
    let rule = "=".repeat(80);
    let expected = format!("B b # mine\n{rule}\nMSG: a/B\nc/C[<=3] c\n\n{rule}\nMSG: c/C\n");
    assert_eq!(compose("a/msg/A", &texts), Ok(expected));
}

#[test]
fn a_missing_or_broken_definition_is_named() {
    let missing = compose("a/msg/A", &[("a/msg/A", "b/B x")]).expect_err("b is missing");
    assert_eq!(missing.to_string(), "no definition of `b/msg/B` was found, expected one because `a/msg/A` needs it");
    let broken = compose("a/msg/A", &[("a/msg/A", "\nint32")]).expect_err("no name");
    assert!(broken.to_string().starts_with("a/msg/A:2: got `int32`, expected a type"));
    for name in ["A", "a/A", "a/msg/", "../msg/A", "a/msg/B/msg/C", "a/srv/A"] {
        assert!(matches!(compose(name, &[]), Err(SchemaError::Name { .. })), "{name}");
    }
}

#[test]
fn cycles_end_and_endless_nesting_is_refused() {
    assert!(compose("a/msg/A", &[("a/msg/A", "A[] children")]).is_ok());
    let endless = compose_schema("a/msg/A1", |name| {
        let number: u32 = name.strip_prefix("a/msg/A")?.parse().ok()?;
        Some(format!("A{} next\n", number + 1))
    });
    assert!(matches!(endless, Err(SchemaError::TooLarge { .. })));
    let mut next = 0;
    let wide = compose_schema("a/msg/A", |_| {
        next += 20;
        Some((next..next + 20).map(|n| format!("A{n} f{n}\n")).collect())
    });
    assert!(matches!(wide, Err(SchemaError::TooLarge { .. })));
}
