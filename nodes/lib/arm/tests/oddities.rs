//! Descriptions that can be used and are odd all the same; mimic chains; positions by name.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use arm::{Drive, Robot};

fn joint(name: &str, kind: &str, parent: &str, child: &str, inside: &str) -> String {
    format!(
        "<link name='{child}'/>\n<joint name='{name}' type='{kind}'><parent link='{parent}'/><child link='{child}'/>\
         <axis xyz='0 0 1'/>{inside}</joint>\n"
    )
}

fn robot(joints: &[String]) -> Robot {
    Robot::from_urdf(&format!("<robot name='r'><link name='a'/>\n{}</robot>", joints.concat())).unwrap()
}

fn limit(lower: f64, upper: f64, velocity: f64) -> String {
    format!("<limit lower='{lower}' upper='{upper}' effort='1' velocity='{velocity}'/>")
}

#[test]
fn each_oddity_is_named_with_line_and_advice() {
    let cases: Vec<(String, &str)> = vec![
        (
            joint("j", "floating", "a", "b", ""),
            "line 3: joint 'j' is floating: it is taken to be fixed where its origin is; describe",
        ),
        (joint("j", "planar", "a", "b", ""), "line 3: joint 'j' is planar: it is taken to be fixed"),
        (
            joint("j", "revolute", "a", "b", &limit(0.0, 0.0, 1.0)),
            "line 3: joint 'j' has both limits at 0: it cannot move; give",
        ),
        (
            joint("j", "prismatic", "a", "b", &limit(-1.0, 1.0, 0.0)),
            "line 3: joint 'j' has the velocity limit 0: no motion of it can be timed; give",
        ),
        (
            joint("j", "revolute", "a", "b", &limit(0.5, 1.0, 1.0)),
            "line 3: position 0 of joint 'j' is outside of its limits [0.5, 1]",
        ),
        (
            joint("j", "revolute", "a", "b", &limit(-1.0, 1.0, 1.0))
                + &joint("k", "revolute", "b", "c", &(limit(-1.0, 1.0, 1.0) + "<mimic joint='j' multiplier='2'/>")),
            "line 5: joint 'k' follows 'j' from -2.0000 to 2.0000, beyond its own limits [-1, 1]; make",
        ),
        (
            "<link name='b'><collision><geometry><box size='200 100 50'/></geometry></collision></link>\
             <joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>"
                .into(),
            "line 2: a collision shape of link 'b' is about 229 m large; if its file is in millimetres, set scale=",
        ),
        (
            "<link name='b'><collision><geometry><sphere radius='0.0001'/></geometry></collision></link>\
             <joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>"
                .into(),
            "line 2: the collision shapes of link 'b' are smaller than 0.5 mm; check",
        ),
    ];
    for (text, expected) in cases {
        let robot = robot(&[text]);
        let problems: Vec<String> = robot.problems.iter().map(ToString::to_string).collect();
        assert_eq!(problems.len(), 1, "{problems:?}");
        assert!(problems[0].starts_with(expected), "got: {}\nwanted: {expected}", problems[0]);
    }
    assert!(robot(&[joint("j", "revolute", "a", "b", &limit(-1.0, 1.0, 1.0))]).problems.is_empty());
}

#[test]
fn a_floating_joint_stands_where_its_origin_is() {
    let robot =
        robot(&[joint("j", "floating", "a", "b", "<origin xyz='1 2 3'/>"), joint("k", "continuous", "b", "c", "")]);
    assert_eq!(robot.dof(), 1);
    let mut poses = Vec::new();
    robot.link_poses(&[0.3], &mut poses);
    assert_eq!(poses[1].translation.vector, arm::Vector3::new(1.0, 2.0, 3.0));
}

#[test]
fn mimics_of_mimics_follow_the_first_leader() {
    let wide = limit(-9.0, 9.0, 1.0);
    let robot = robot(&[
        joint("j", "revolute", "a", "b", &wide),
        joint("k", "revolute", "b", "c", &format!("{wide}<mimic joint='l' multiplier='-2' offset='0.5'/>")),
        joint("l", "revolute", "c", "d", &format!("{wide}<mimic joint='j' multiplier='3' offset='0.1'/>")),
    ]);
    assert_eq!(robot.dof(), 1);
    let position = |name: &str, q: f64| robot.joints.iter().find(|j| j.name == name).unwrap().position(&[q]);
    for q in [-0.7, 0.0, 1.3] {
        assert!((position("l", q) - (3.0 * q + 0.1)).abs() < 1e-15);
        assert!((position("k", q) - (-2.0 * (3.0 * q + 0.1) + 0.5)).abs() < 1e-15);
    }
    assert!(robot.joints.iter().filter(|j| matches!(j.drive, Drive::Mimic { leader: 0, .. })).count() == 2);
    // A follower in a circle has no leader.
    let circle = format!(
        "<robot name='r'><link name='a'/>\n{}{}</robot>",
        joint("j", "revolute", "a", "b", &format!("{wide}<mimic joint='k'/>")),
        joint("k", "revolute", "b", "c", &format!("{wide}<mimic joint='j'/>"))
    );
    assert!(Robot::from_urdf(&circle).unwrap_err().to_string().contains("mimics, joint by joint, itself"));
}

#[test]
fn joint_states_with_missing_or_extra_joints_say_so() {
    let wide = limit(-1.0, 1.0, 1.0);
    let robot = robot(&[
        joint("j", "revolute", "a", "b", &wide),
        joint("k", "revolute", "b", "c", &wide),
        joint("l", "prismatic", "c", "d", &format!("{wide}<mimic joint='j' multiplier='2'/>")),
        joint("m", "fixed", "d", "e", ""),
    ]);
    let found = robot.configuration([("k", 0.5), ("wheel", 1.0), ("m", 0.0), ("l", 0.4), ("j", 0.2)]);
    assert_eq!(found.q, [0.2, 0.5]);
    assert!(found.is_complete() && found.outside.is_empty() && found.astray.is_empty());
    assert_eq!(found.unknown, ["wheel", "m"]);
    let found = robot.configuration([("k", f64::NAN), ("l", 0.4)]);
    assert_eq!((found.q.as_slice(), found.is_complete()), ([0.0, 0.0].as_slice(), false));
    assert_eq!((found.missing, found.not_finite, found.astray), (vec!["j".into()], vec!["k".into()], vec!["l".into()]));
    let found = robot.configuration([("j", 1.5), ("k", -1.0)]);
    assert_eq!((found.q.as_slice(), found.outside), ([1.5, -1.0].as_slice(), vec!["j".to_owned()]));
}
