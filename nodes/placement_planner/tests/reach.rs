//! What the arm reaches of the table: told once it is known, again when it is asked for or the robot or the table is another.

mod support;

use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{TableReach, TableScene};
use placement_planner::{Event, Output, PlacementPlanner, Settings};
use support::{URDF, scene};

/// What is told of the reach after an event.
fn told(node: &mut PlacementPlanner, event: Event) -> Option<TableReach> {
    let reach = |output| if let Output::Reach(reach) = output { Some(*reach) } else { None };
    node.step(Time::default(), event).into_iter().find_map(reach)
}

#[test]
fn it_is_told_when_robot_and_table_are_there_and_objects_play_no_part() {
    let mut node = PlacementPlanner::new(Settings::default());
    assert_eq!(told(&mut node, Event::Scene(Box::new(scene()))), None);
    let first = told(&mut node, Event::RobotDescription(URDF.into())).expect("both are there");
    assert_eq!((first.side, first.reachable.len(), first.robot_hash.len()), (32, 1024, 64));
    assert_eq!((first.width_m, first.depth_m, first.target_id.as_str(), first.reason.as_str()), (1.0, 1.0, "vase", ""));
    // The middle is in reach, the far corners are not, and the edge is where the target does not stand.
    assert!(first.reachable[16 * 32 + 16] && first.reachable[2 * 32 + 2]);
    assert!(!first.reachable[30 * 32 + 1] && !first.reachable[30 * 32 + 30] && !first.reachable[0]);
    let bare = TableScene { objects: Vec::new(), ..scene() };
    assert_eq!(told(&mut node, Event::Scene(Box::new(bare))), None, "the table and the target are the same");
    assert_eq!(told(&mut node, Event::Republish), Some(first.clone()));
    let small = TableScene { depth_m: 0.6, ..scene() };
    let other = told(&mut node, Event::Scene(Box::new(small))).expect("another table");
    assert!(other.reachable[28 * 32 + 2] && other.reachable[28 * 32 + 29], "all of what is nearer is in reach");
    // A planner that is started anew tells the same.
    let mut again = PlacementPlanner::new(Settings::default());
    assert_eq!(told(&mut again, Event::RobotDescription(URDF.into())), None);
    assert_eq!(told(&mut again, Event::Scene(Box::new(scene()))), Some(first));
}

#[test]
fn why_nothing_is_known_is_told() {
    let mut node = PlacementPlanner::new(Settings::default());
    told(&mut node, Event::RobotDescription(URDF.into()));
    let mut elsewhere = scene();
    elsewhere.header.frame_id = "another_table".into();
    let reach = told(&mut node, Event::Scene(Box::new(elsewhere))).expect("it is told");
    assert_eq!((reach.side, reach.reachable.len()), (0, 0));
    assert!(reach.reason.contains("no fixed link 'another_table'"), "{}", reach.reason);
}
