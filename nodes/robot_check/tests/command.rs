//! `apprentice robot` on files: what it says, in words and as JSON, and what it refuses.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use clap::Parser;
use robot_check::{Robot, RobotError, answer};
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const ARM: &str = include_str!("../../../config/urdf/table_arm_7.urdf");

/// The command as a process: the executable of this test runs it when asked to.
fn apprentice_robot(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "as_a_process", "--nocapture", "--quiet"])
        .env("ROBOT_CHECK_ARGUMENTS", serde_json::to_string(arguments).unwrap())
        .current_dir(folder)
        .output()
        .unwrap()
}

/// Not a test of its own: runs the command with the arguments of [`apprentice_robot`], and ends with its exit code.
#[test]
fn as_a_process() {
    if let Ok(arguments) = std::env::var("ROBOT_CHECK_ARGUMENTS") {
        let arguments: Vec<String> = serde_json::from_str(&arguments).unwrap();
        let arguments = Robot::try_parse_from(std::iter::once("apprentice robot".into()).chain(arguments)).unwrap();
        let code = robot_check::run(&arguments);
        std::process::exit(i32::from(code != std::process::ExitCode::SUCCESS) * 2);
    }
}

fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    folder
}

/// The JSON on standard output: what the test harness prints stands around it.
fn json(output: &Output) -> serde_json::Value {
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    let line = text.lines().find(|line| line.starts_with('{')).unwrap_or_else(|| panic!("no JSON in {text}"));
    serde_json::from_str(line).unwrap()
}

fn arguments(folder: &Path, rest: &[&str]) -> Robot {
    let urdf = folder.join("arm.urdf").display().to_string();
    let mut all = vec!["apprentice robot".to_owned(), urdf];
    all.extend(rest.iter().map(|word| {
        let path = folder.join(word);
        if word.starts_with("--") || !path.exists() { (*word).to_owned() } else { path.display().to_string() }
    }));
    Robot::try_parse_from(all).unwrap()
}

#[test]
fn the_shipped_arm_is_answered_for_in_words() {
    let folder = folder(&[("arm.urdf", ARM)]);
    let output = apprentice_robot(folder.path(), &["arm.urdf"]);
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    assert_eq!(output.status.code(), Some(0), "{text}");
    for line in [
        "table_arm_7: 13 links, 12 joints (7 revolute, 0 continuous, 2 prismatic, 3 fixed), 8 of them driven",
        "  table",
        "  └ table_to_base fixed → base_link",
        "[-2.9000, 2.9000] rad, 1.7 rad/s",
        "= 1 · finger_left + 0",
        "cylinder r 0.06 l 0.26",
        "  tool0: 7 joints, reaches at most 1.440 m",
        "Nothing odd was found.",
        "In this posture no links touch; nearest are ",
    ] {
        assert!(text.contains(line), "no '{line}' in\n{text}");
    }
}

#[test]
fn json_has_what_the_format_promises() {
    let joints = r#"{"shoulder_pitch": 1.5707963267948966, "finger_left": 0.05}"#;
    let folder = folder(&[
        ("arm.urdf", ARM),
        ("q.json", joints),
        ("list.json", &format!("[{joints}, {{\"elbow\": 2.5}}, {{}}]")),
    ]);
    let one = json(&apprentice_robot(folder.path(), &["arm.urdf", "--json", "--joints", "q.json"]));
    assert_eq!((&one["robot"], &one["root"]), (&"table_arm_7".into(), &"table".into()));
    assert_eq!(one["problems"], serde_json::json!([]));
    let elbow = &one["joints"]["elbow"];
    assert_eq!(elbow["type"], "revolute");
    assert_eq!(elbow["limits"], serde_json::json!({"lower": -2.5, "upper": 2.5, "velocity": 2.0, "effort": 150.0}));
    assert_eq!(one["joints"]["finger_right"]["mimic"]["joint"], "finger_left");
    // Stretched out over the table: position and rotation of the tool, the mimicking finger where it follows to.
    let number = |link: &str, i: usize| one["links"][link][i].as_f64().unwrap();
    let tool: Vec<f64> = (0..3).map(|i| number("tool0", i)).collect();
    assert!((tool[0] - 0.5).abs() + (tool[1] - 1.11).abs() + (tool[2] - 0.33).abs() < 1e-12, "{tool:?}");
    let norm: f64 = (3..7).map(|i| number("tool0", i).powi(2)).sum();
    assert!((norm - 1.0).abs() < 1e-12);
    assert!((number("finger_left_link", 0) - number("finger_right_link", 0)).abs() > 0.11);
    assert!(one["collisions"].as_array().unwrap().is_empty() && one.get("poses").is_none());
    let list = json(&apprentice_robot(folder.path(), &["arm.urdf", "--json", "--joints", "list.json"]));
    assert_eq!((list["poses"].as_array().unwrap().len(), list["collisions"].as_array().unwrap().len()), (3, 3));
    assert_eq!(list["poses"][0], one["links"]);
    assert!(list.get("links").is_none());
}

#[test]
fn missing_meshes_are_listed_with_both_remedies() {
    let arm = r#"<robot name="m"><link name="a"><collision><geometry><mesh filename="package://p/a.stl"/></geometry></collision></link>
<link name="b"><collision><geometry><mesh filename="b.obj"/></geometry></collision></link>
<joint name="j" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint></robot>"#;
    let folder = folder(&[("arm.urdf", arm), ("pkg/p/readme", "")]);
    let refused = apprentice_robot(folder.path(), &["arm.urdf", "--json"]);
    assert_eq!(refused.status.code(), Some(2));
    let said = String::from_utf8(refused.stderr.clone()).unwrap();
    for words in [
        "arm.urdf: 2 of its collision meshes cannot be used:",
        "line 1: the collision mesh of link 'a' cannot be used: package://p/a.stl: no folder was given",
        "line 2: the collision mesh of link 'b' cannot be used: b.obj:",
        "--package-path DIR",
        "--bounding-shapes",
    ] {
        assert!(said.contains(words), "no '{words}' in {said}");
    }
    let problems = json(&refused)["problems"].as_array().unwrap().clone();
    assert_eq!((problems.len(), &problems[1]["line"]), (2, &2.into()));
    // With the package's folder the first is looked for there.
    let looked = answer(&arguments(folder.path(), &["--package-path", "pkg"])).unwrap_err().to_string();
    assert!(looked.contains("not found; looked at ") && looked.contains("p/a.stl"), "{looked}");
    // Going on with guesses is possible, and says so.
    let guessed = answer(&arguments(folder.path(), &["--bounding-shapes"])).unwrap();
    assert!(guessed.problems.len() == 2 && guessed.problems[0].what.contains("a guess"));
    // A mesh that is there is used.
    let cube = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    fs::write(folder.path().join("b.obj"), cube).unwrap();
    let one = answer(&arguments(folder.path(), &[])).unwrap_err();
    assert!(matches!(&one, RobotError::Meshes { problems, .. } if problems.len() == 1), "{one}");
}

#[test]
fn what_is_wrong_is_said_with_file_and_line() {
    let broken = ARM.replace("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 0 0\"/>");
    let folder = folder(&[
        ("arm.urdf", ARM),
        ("broken.urdf", &broken),
        ("typo.json", r#"{"elbov": 1.0}"#),
        ("nan.json", r#"{"elbow": "high"}"#),
        ("none.json", "[]"),
        ("text.json", "elbow = 1"),
        ("bad.srdf", "<robot>\n<disable_collisions link1='a'/></robot>"),
        ("other.srdf", "<robot>\n<disable_collisions link1='base_link' link2='gripper'/></robot>"),
        ("far.json", r#"{"elbow": 9.0, "finger_left": 0.01, "finger_right": 0.02}"#),
    ]);
    let refused = apprentice_robot(folder.path(), &["broken.urdf"]);
    let said = String::from_utf8(refused.stderr).unwrap();
    assert_eq!(refused.status.code(), Some(2));
    assert!(
        said.starts_with("error: apprentice robot: broken.urdf: line ") && said.contains("has the axis (0, 0, 0)"),
        "{said}"
    );
    for (file, expected) in [
        ("typo.json", "typo.json: the robot has no moving joint 'elbov'; did you mean 'elbow'?"),
        ("nan.json", "nan.json: the position of 'elbow' is no finite number"),
        ("none.json", "none.json: 0 postures; 1 to"),
        ("text.json", "text.json: no JSON"),
        ("nowhere.json", "nowhere.json: No such file"),
    ] {
        let error = answer(&arguments(folder.path(), &["--joints", file])).unwrap_err().to_string();
        assert!(error.contains(expected), "{error}");
    }
    let error = answer(&arguments(folder.path(), &["--srdf", "bad.srdf"])).unwrap_err().to_string();
    assert!(error.contains("bad.srdf: line 2: the semantic robot description"), "{error}");
    // What can be used all the same is answered, and noted.
    let noted = |rest: &[&str]| -> Vec<String> {
        answer(&arguments(folder.path(), rest)).unwrap().problems.iter().map(ToString::to_string).collect()
    };
    assert!(noted(&["--srdf", "other.srdf"])[0].starts_with("line 2: the SRDF names the link 'gripper'"));
    let far = noted(&["--joints", "far.json"]);
    assert!(far[0].starts_with("joint 'elbow' is outside of its limits [-2.5, 2.5]"), "{far:?}");
    assert!(far[1].starts_with("joint 'finger_right' mimics another"), "{far:?}");
}
