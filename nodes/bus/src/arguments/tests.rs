//! Claims about the command line.

use log::LevelFilter;
use proptest::prelude::*;

use super::{ArgumentError, Arguments};
use crate::names::NodeName;

fn parse(args: &[&str]) -> Result<Arguments, ArgumentError> {
    let args: Vec<String> = args.iter().map(|arg| (*arg).to_owned()).collect();
    Arguments::parse(&args)
}

fn name(args: &[&str]) -> String {
    parse(args).expect("good arguments").node_name("planner").expect("a good name").full()
}

fn resolve(args: &[&str], topic: &str) -> String {
    let arguments = parse(args).expect("good arguments");
    let node = arguments.node_name("planner").expect("a good name");
    arguments.resolve(&node, "topic", topic).expect("a good topic")
}

#[test]
fn names_and_namespaces() {
    assert_eq!(name(&[]), "/apprentice/planner");
    assert_eq!(name(&["--ros-args", "-r", "__ns:=/", "--"]), "/planner");
    assert_eq!(name(&["-r", "__node:=other", "-r", "__ns:=a/b"]), "/a/b/other");
    assert_eq!(name(&["--ros-args", "--remap", "planner:__node:=mine"]), "/apprentice/mine");
    assert_eq!(name(&["-r", "another:__node:=mine"]), "/apprentice/planner");
}

#[test]
fn topics_are_expanded_on_both_sides_before_they_are_compared() {
    assert_eq!(resolve(&["-r", "scene:=/camera/scene"], "scene"), "/camera/scene");
    assert_eq!(resolve(&["-r", "/apprentice/scene:=other"], "scene"), "/apprentice/other");
    assert_eq!(resolve(&["-r", "~/own:=mine"], "~/own"), "/apprentice/mine");
    assert_eq!(resolve(&["-r", "scene:=a", "-r", "scene:=b"], "scene"), "/apprentice/a");
    assert_eq!(resolve(&["-r", "planner:scene:=a"], "scene"), "/apprentice/a");
    assert_eq!(resolve(&["-r", "other:scene:=a"], "scene"), "/apprentice/scene");
}

#[test]
fn log_levels() {
    let node = NodeName::new("planner", "/apprentice").expect("a good name");
    for (args, wanted) in [
        (vec![], None),
        (vec!["--log-level", "debug"], Some(LevelFilter::Debug)),
        (vec!["--log-level", "WARN"], Some(LevelFilter::Warn)),
        (vec!["--log-level", "planner:=error"], Some(LevelFilter::Error)),
        (vec!["--log-level", "apprentice.planner:=fatal"], Some(LevelFilter::Error)),
        (vec!["--log-level", "other:=debug"], None),
        (vec!["--log-level=debug", "--log-level", "info"], Some(LevelFilter::Info)),
    ] {
        assert_eq!(parse(&args).expect("good arguments").level(&node), wanted, "{args:?}");
    }
}

#[test]
fn what_launch_files_add_is_taken() {
    for args in [
        &["--ros-args", "--disable-external-lib-logs", "-e", "/enclave"][..],
        &["--ros-args", "--log-config-file", "x", "--enable-rosout-logs", "--ros-args"],
        &["--", "--ros-args"],
    ] {
        assert!(parse(args).is_ok(), "{args:?}");
    }
}

#[test]
fn mistakes_are_named_with_what_to_do() {
    for (args, words) in [
        (vec!["--ros-arg"], vec!["`--ros-arg`", "did you mean `--ros-args`?"]),
        (vec!["--params_file", "x"], vec!["did you mean `--params-file`?"]),
        (vec!["speed:=1"], vec!["did you mean `-p speed:=1`?"]),
        (vec!["-p"], vec!["`-p` needs a value", "name:=value"]),
        (vec!["-p", "speed=1"], vec!["speed=1", "name:=value"]),
        (vec!["-p", "speed:={a: 1}"], vec!["a bool, a number"]),
        (vec!["-p", "speed:=[1"], vec!["a YAML value"]),
        (vec!["-p", "speed:=~"], vec!["not nothing"]),
        (vec!["-r", "a=b"], vec!["from:=to"]),
        (vec!["-r", "a b:=c"], vec!["only letters"]),
        (vec!["-r", "__node:=1x"], vec!["node name `1x`", "digit"]),
        (vec!["-r", "__nod:=x"], vec!["__node, __ns"]),
        (vec!["--log-level", "debgu"], vec!["did you mean `debug`?"]),
    ] {
        let text = parse(&args).expect_err("a mistake").to_string();
        for word in words {
            assert!(text.contains(word), "{word:?} is not in {text:?}");
        }
        assert!(!text.contains('\n'), "{text:?} has two lines");
    }
}

proptest! {
    #[test]
    fn no_arguments_make_it_panic(args in proptest::collection::vec(
        prop_oneof![
            Just("-p".to_owned()), Just("-r".to_owned()), Just("--ros-args".to_owned()),
            Just("--log-level".to_owned()), Just("__ns:=".to_owned()), "[a-z_:/~=.\\[\\]{}0-9 -]{0,20}", any::<String>(),
        ],
        0..8,
    )) {
        if let Ok(arguments) = Arguments::parse(&args)
            && let Ok(node) = arguments.node_name("planner")
        {
            let _ = arguments.resolve(&node, "topic", "scene");
            let _ = arguments.level(&node);
        }
    }
}
