//! Descriptions that are wrong, each with the message a person gets, and text that is anything at all.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use arm::{Robot, UrdfError};
use proptest::prelude::{any, prop, prop_assert, proptest};

const TABLE_ARM: &str = include_str!("../../../../config/urdf/table_arm.urdf");
const LIMIT: &str = "<limit lower='-1' upper='1' effort='1' velocity='1'/>";

fn refusal(text: &str) -> String {
    let message = Robot::from_urdf(text).expect_err("should be refused").to_string();
    assert!(!message.contains('\n'), "one line: {message}");
    message
}

/// A robot of two links whose joint, on line 2, is given.
fn with_joint(attributes: &str, inside: &str) -> String {
    format!(
        "<robot name='r'><link name='a'/><link name='b'/>\n<joint name='j' {attributes}>\
         <parent link='a'/><child link='b'/>{inside}</joint></robot>"
    )
}

#[test]
fn each_problem_has_its_message() {
    let revolute = |inside: &str| with_joint("type='revolute'", inside);
    let cases: Vec<(String, &str)> = vec![
        (String::new(), "the robot description holds no link; add at least one <link name=\"…\"/> inside <robot>"),
        ("<robot name='r'/>".into(), "the robot description holds no link"),
        ("hello".into(), "the robot description holds no link"),
        ("<sdf><link name='a'/></sdf>".into(), "line 1: the outermost element is <sdf>, expected <robot>"),
        ("<robot>\n<link name='a'></robot>".into(), "line 2: not well-formed XML"),
        ("<robot>\n<link name='a'/>".into(), "line 2: not well-formed XML: <robot> is not closed"),
        ("<!DOCTYPE r [<!ENTITY x 'y'>]><robot/>".into(), "line 1: a document type declaration is not allowed"),
        (
            "<robot xmlns:xacro='x'>\n<xacro:macro name='m'/></robot>".into(),
            "line 2: <xacro:macro> is a xacro macro; expand the file first: xacro FILE > robot.urdf",
        ),
        ("<robot>\n\n<link/></robot>".into(), "line 3: <link> lacks the attribute 'name'"),
        (
            "<robot><link name='a'/>\n<link name='a'/></robot>".into(),
            "line 2: the link name 'a' is used twice (first on line 1); rename one of them",
        ),
        (
            "<robot><link name='a'/><link name='b'/><joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>\
             \n<joint name='j' type='fixed'/></robot>"
                .into(),
            "line 2: the joint name 'j' is used twice (first on line 1)",
        ),
        (with_joint("", ""), "line 2: <joint> lacks the attribute 'type'"),
        (
            with_joint("type='ball'", ""),
            "line 2: joint 'j' has the type 'ball'; expected revolute, continuous, prismatic, fixed, floating or planar",
        ),
        (revolute(""), "line 2: joint 'j' lacks <limit>"),
        (
            "<robot><link name='a'/>\n<joint name='j' type='fixed'><parent link='a'/></joint></robot>".into(),
            "line 2: joint 'j' lacks <child>",
        ),
        (
            revolute(&format!("{LIMIT}\n<origin xyz='0 NaN 0'/>")),
            "line 3: xyz=\"0 NaN 0\" of <origin> in joint 'j': expected 3 finite numbers of at most 1000",
        ),
        (
            revolute(&format!("{LIMIT}<origin xyz='0 0'/>")),
            "line 2: xyz=\"0 0\" of <origin> in joint 'j': expected 3 finite numbers",
        ),
        (
            revolute("<limit lower='-inf' upper='1' velocity='1'/>"),
            "line 2: lower=\"-inf\" of <limit> in joint 'j': expected one finite number",
        ),
        (
            "<robot><link name='a'/><joint name='j&#10;k' type='fixed'><origin xyz='x'/></joint></robot>".into(),
            "line 1: xyz=\"x\" of <origin> in joint 'j k': expected 3 finite numbers",
        ),
        (
            "<robot><link name='a'><visual><geometry><mesh/></geometry></visual></link></robot>".into(),
            "line 1: <mesh> lacks the attribute 'filename'",
        ),
        (revolute(&format!("{LIMIT}<axis xyz='0 0 0'/>")), "line 2: joint 'j' has the axis (0, 0, 0)"),
        (
            revolute("<limit lower='2' upper='1' effort='1' velocity='1'/>"),
            "line 2: joint 'j' has lower limit 2 above upper limit 1; swap them",
        ),
        (
            revolute("<limit lower='0' upper='1' effort='1' velocity='-1'/>"),
            "line 2: joint 'j' has the velocity limit -1; it must not lie below 0",
        ),
        (revolute(&format!("{LIMIT}<mimic joint='k'/>")), "line 2: joint 'j' mimics 'k', which is no moving joint"),
        (revolute(&format!("{LIMIT}<mimic joint='j'/>")), "line 2: joint 'j' mimics, joint by joint, itself"),
        (
            "<robot><link name='a'/>\n<joint name='j' type='fixed'><parent link='a'/><child link='z'/></joint></robot>"
                .into(),
            "line 2: joint 'j' has the child link 'z', which does not exist; add it or correct the name",
        ),
        (
            "<robot><link name='a'/><link name='b'/></robot>".into(),
            "the robot has 2 roots ('a' and 'b' among them); join all links by joints into one tree",
        ),
        (
            "<robot><link name='a'/><link name='b'/><link name='c'/>\
             <joint name='i' type='fixed'><parent link='a'/><child link='c'/></joint>\
             \n<joint name='j' type='fixed'><parent link='b'/><child link='c'/></joint></robot>"
                .into(),
            "line 2: link 'c' is the child of joint 'i' and of joint 'j'; a URDF must be a tree",
        ),
        (
            "<robot><link name='root'/>\n<link name='a'/><link name='b'/>\
             <joint name='i' type='fixed'><parent link='a'/><child link='b'/></joint>\
             <joint name='j' type='fixed'><parent link='b'/><child link='a'/></joint></robot>"
                .into(),
            "line 2: link 'a' hangs, joint by joint, on itself",
        ),
        (
            "<robot>\n<link name='a'><collision><geometry><sphere radius='-1'/></geometry></collision></link></robot>".into(),
            "line 2: the <sphere> of link 'a' has a size of -1; every extent must lie above 0",
        ),
        (
            "<robot>\n<link name='a'><collision><geometry><mesh filename='arm.stl'/></geometry></collision></link></robot>"
                .into(),
            "line 2: the collision mesh of link 'a' cannot be used: arm.stl: no place to look for meshes was given; give it, or accept",
        ),
        (
            "<robot><link name='a'><collision><geometry/></collision></link></robot>".into(),
            "the robot description does not follow the URDF format",
        ),
    ];
    for (text, expected) in cases {
        let message = refusal(&text);
        assert!(message.starts_with(expected), "{text}\n   got: {message}\nwanted: {expected}");
    }
}

#[test]
fn a_loop_without_a_root_is_a_loop() {
    let text = "<robot><link name='a'/><link name='b'/>\
                <joint name='i' type='fixed'><parent link='a'/><child link='b'/></joint>\
                <joint name='j' type='fixed'><parent link='b'/><child link='a'/></joint></robot>";
    assert!(matches!(Robot::from_urdf(text), Err(UrdfError::Loop { .. })));
}

#[test]
fn size_depth_and_counts_are_capped_before_parsing() {
    let large = format!("<robot>{}</robot>", " ".repeat(arm::MAX_BYTES));
    assert!(matches!(Robot::from_urdf(&large), Err(UrdfError::TooLarge { .. })));
    let deep = format!("<robot>{}", "<x>".repeat(200_000));
    assert!(matches!(Robot::from_urdf(&deep), Err(UrdfError::TooDeep { line: 1, max: 64 })));
    let links: String = (0..=arm::MAX_LINKS).map(|i| format!("<link name='l{i}'/>")).collect();
    let many = Robot::from_urdf(&format!("<robot>{links}</robot>"));
    assert!(matches!(many, Err(UrdfError::TooMany { what: "links", .. })), "{many:?}");
    let elements = format!("<robot><link name='a'/>{}</robot>", "<y/>".repeat(arm::MAX_ELEMENTS));
    assert!(matches!(Robot::from_urdf(&elements), Err(UrdfError::TooMany { what: "elements", .. })));
    let shape = "<collision><geometry><sphere radius='1'/></geometry></collision>";
    let solids =
        Robot::from_urdf(&format!("<robot><link name='a'>{}</link></robot>", shape.repeat(arm::MAX_SOLIDS + 1)));
    assert!(matches!(solids, Err(UrdfError::TooMany { line: 1, what: "collision shapes", .. })), "{solids:?}");
    let attributes: String = (0..10_000).map(|i| format!(" a{i}=''")).collect();
    let wide = Robot::from_urdf(&format!("<robot{attributes}/>"));
    assert!(matches!(wide, Err(UrdfError::TooMany { what: "attributes on one element", .. })));
}

#[test]
fn extensions_of_other_tools_are_of_no_concern() {
    let text = "<robot name='r'><link name='a'/><gazebo reference='a'><origin xyz='x y z'/><plugin name='p'/></gazebo>\
                <transmission name='t'><joint name='nowhere'/></transmission></robot>";
    let robot = Robot::from_urdf(text).unwrap();
    assert_eq!((robot.links.len(), robot.dof()), (1, 0));
}

proptest! {
    #[test]
    fn random_text_never_panics(text in ".{0,400}") {
        let _ = Robot::from_urdf(&text);
    }

    #[test]
    fn random_elements_never_panic(parts in prop::collection::vec(0_usize..14, 0..40)) {
        const PIECES: [&str; 14] = [
            "<robot>", "</robot>", "<link name='a'>", "</link>", "<link name='b'/>", "<joint name='j' type='fixed'>",
            "</joint>", "<parent link='a'/>", "<child link='b'/>", "<collision>", "</collision>",
            "<geometry><box size='1 1 1'/></geometry>", "<!-- -->", "&lt;",
        ];
        let text: String = parts.iter().map(|&p| PIECES[p]).collect();
        let _ = Robot::from_urdf(&text);
        let _ = Robot::from_urdf(&format!("<robot>{text}</robot>"));
    }

    #[test]
    fn a_damaged_arm_is_read_or_refused(at in 0.0..1.0_f64, length in 0_usize..40, with in any::<[u8; 3]>()) {
        let bytes = TABLE_ARM.as_bytes();
        let start = (at * bytes.len() as f64) as usize;
        let end = (start + length).min(bytes.len());
        let damaged = [&bytes[..start], &with[..], &bytes[end..]].concat();
        if let Err(error) = Robot::from_urdf(&String::from_utf8_lossy(&damaged)) {
            prop_assert!(!error.to_string().contains('\n'));
        }
    }
}
