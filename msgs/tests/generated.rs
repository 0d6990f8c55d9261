//! The generated files, `CMakeLists.txt` and `package.xml` agree with the definitions.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use apprentice_msgs::generator::{COMMAND, GenerateError, Kind, OWN_PACKAGE, Source, generate, generate_from, load};
use apprentice_msgs::interface::{Base, parse_action, parse_message, parse_service};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn file(name: &str) -> String {
    fs::read_to_string(root().join(name)).expect(name)
}

#[test]
fn the_checked_in_types_are_those_of_the_definitions() {
    let files = generate_from(root()).expect("good definitions");
    let present: BTreeSet<String> = fs::read_dir(root().join("src/generated"))
        .expect("src/generated")
        .map(|entry| entry.expect("entry").file_name().to_string_lossy().into_owned())
        .collect();
    assert!(files.keys().eq(&present), "msgs/src/generated has other files than the definitions give; run `{COMMAND}`");
    for (name, text) in &files {
        assert!(
            *text == file(&format!("src/generated/{name}")),
            "msgs/src/generated/{name} differs from the definitions; run `{COMMAND}`"
        );
    }
}

fn own_sources() -> Vec<Source> {
    let sources = load(root()).expect("good definitions");
    sources.into_iter().filter(|source| source.package == OWN_PACKAGE).collect()
}

#[test]
fn cmake_lists_every_file() {
    let text = file("CMakeLists.txt");
    let listed: Vec<&str> = text.lines().filter_map(|line| line.trim().strip_prefix('"')?.strip_suffix('"')).collect();
    let sources = own_sources();
    let present: Vec<&str> = sources.iter().map(|source| source.path.as_str()).collect();
    assert_eq!(listed, present, "list the files of msgs/ in msgs/CMakeLists.txt");
}

/// Other packages whose messages ours contain.
fn dependencies() -> BTreeSet<String> {
    let mut packages = BTreeSet::new();
    for source in own_sources() {
        let messages = match source.kind {
            Kind::Message => {
                vec![parse_message(OWN_PACKAGE, &source.name, &source.path, &source.text).expect("good")]
            }
            Kind::Service => {
                let service = parse_service(OWN_PACKAGE, &source.name, &source.path, &source.text);
                let service = service.expect("good");
                vec![service.request, service.response]
            }
            Kind::Action => {
                let action = parse_action(OWN_PACKAGE, &source.name, &source.path, &source.text).expect("good");
                packages.insert("action_msgs".to_owned());
                vec![action.goal, action.result, action.feedback]
            }
        };
        for field in messages.iter().flat_map(|message| &message.fields) {
            if let Base::Message { package, .. } = &field.ty.base
                && package != OWN_PACKAGE
            {
                packages.insert(package.clone());
            }
        }
    }
    packages
}

#[test]
fn both_build_files_name_every_dependency() {
    let dependencies = dependencies();
    let package = file("package.xml");
    let named: BTreeSet<String> = package
        .lines()
        .filter_map(|line| line.trim().strip_prefix("<depend>")?.strip_suffix("</depend>"))
        .map(str::to_owned)
        .collect();
    assert_eq!(named, dependencies, "name them in msgs/package.xml");
    let cmake = file("CMakeLists.txt");
    let line = cmake.lines().find_map(|line| line.trim().strip_prefix("DEPENDENCIES ")).expect("DEPENDENCIES");
    let named: BTreeSet<String> = line.split(' ').map(str::to_owned).collect();
    assert_eq!(named, dependencies, "name them in msgs/CMakeLists.txt");
    for name in named {
        assert!(cmake.contains(&format!("find_package({name} REQUIRED)")), "{name}");
    }
}

#[test]
fn the_readme_lists_every_message_and_service() {
    let readme = file("README.md");
    for source in own_sources() {
        let row = format!("| `{}` |", source.name);
        assert!(readme.contains(&row), "msgs/README.md lacks a row `{row}`");
    }
}

fn source(package: &str, kind: Kind, name: &str, text: &str) -> Source {
    Source {
        package: package.to_owned(),
        kind,
        name: name.to_owned(),
        path: format!("{name}.{}", kind.directory()),
        text: text.to_owned(),
    }
}

#[test]
fn an_action_gives_its_three_messages_and_those_that_ros_derives() {
    let sources = [
        source("builtin_interfaces", Kind::Message, "Time", "int32 sec\nuint32 nanosec\n"),
        source("unique_identifier_msgs", Kind::Message, "UUID", "uint8[16] uuid\n"),
        source(
            OWN_PACKAGE,
            Kind::Action,
            "Place",
            "# Puts it there.\nfloat64 x_m\n---\nbool done\n---\nfloat64 left_m\n",
        ),
    ];
    let files = generate(&sources).expect("good");
    let action = &files["action.rs"];
    for expected in [
        "/// Puts it there.\n#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]\npub struct PlaceGoal {",
        "pub struct PlaceResult {",
        "pub struct PlaceFeedback {",
        "    pub goal_id: super::unique_identifier_msgs::UUID,\n",
        "    pub goal: super::action::PlaceGoal,\n",
        "const TYPE: &'static str = \"apprentice_msgs/action/Place_SendGoal_Request\";",
        "impl crate::Service for PlaceGetResult {",
        "pub struct PlaceFeedbackMessage {",
    ] {
        assert!(action.contains(expected), "{expected}");
    }
}

#[test]
fn defaults_large_arrays_and_keywords_become_rust() {
    let text = "uint8[40] data\nstring type \"a\\\"b\"\nint8[] few [1, 2]\nbyte[<=2] self\n";
    let files = generate(&[source("pkg", Kind::Message, "Odd", text)]).expect("good");
    for expected in [
        "#[serde(with = \"serde_big_array::BigArray\")]\n    pub data: [u8; 40],",
        "pub r#type: std::string::String,",
        "data: std::array::from_fn(|_| Default::default()),",
        "r#type: \"a\\\"b\".to_owned(),",
        "few: vec![1, 2],",
        "#[serde(deserialize_with = \"crate::bounded::at_most::<_, _, 2>\")]\n    pub self_: Vec<u8>,",
    ] {
        assert!(files["pkg.rs"].contains(expected), "{expected}");
    }
}

#[test]
fn what_cannot_become_rust_is_refused_by_name() {
    let fail = |text: &str| generate(&[source("pkg", Kind::Message, "A", text)]).expect_err(text);
    assert!(matches!(fail("A a"), GenerateError::Cycle { .. }));
    assert!(matches!(fail("Nowhere a"), GenerateError::Unknown { .. }));
    assert_eq!(
        fail("uint8[5000] big").to_string(),
        "pkg/A: got field `big` with an array of 5000, expected at most 4096 elements in a fixed array"
    );
    assert!(matches!(fail("wstring w"), GenerateError::Unsupported { .. }));
    assert!(matches!(fail("int32 1"), GenerateError::Interface(_)));
}
