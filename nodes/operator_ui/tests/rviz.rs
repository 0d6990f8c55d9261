//! Questions as interactive markers, shown on the state machine alone: what a client like RViz is told, and what becomes of what
//! a person does there.

mod world;

use apprentice_msgs::geometry_msgs::{Point, Pose};
use apprentice_msgs::msg::{
    CritiqueSegment, EvidenceReceipt, LessonStatus, PlacementDemonstration, QueryResponse, TrajectoryPreference,
    WorldQuery,
};
use apprentice_msgs::std_msgs::Header;
use apprentice_msgs::visualization_msgs::{InteractiveMarker, InteractiveMarkerControl, InteractiveMarkerFeedback};
use operator_ui::Event;
use proptest::prelude::{any, proptest};
use world::garden::{asking, way_query};
use world::id;
use world::table::{Sent, Table};

/// What a person does at an interactive marker.
fn done(name: &str, event_type: u8) -> InteractiveMarkerFeedback {
    InteractiveMarkerFeedback {
        header: Header { frame_id: "table".into(), ..Header::default() },
        client_id: "rviz".into(),
        marker_name: name.into(),
        event_type,
        ..InteractiveMarkerFeedback::default()
    }
}

/// Does it; the command that it may be has the id of that number.
fn handle(table: &mut Table, n: u32, feedback: InteractiveMarkerFeedback) -> Sent {
    table.hear(Event::Handled(Box::new(feedback), id(n)))
}

fn press(table: &mut Table, n: u32, name: &str) -> Sent {
    handle(table, n, done(name, InteractiveMarkerFeedback::BUTTON_CLICK))
}

fn choose(table: &mut Table, n: u32, name: &str, menu_entry_id: u32) -> Sent {
    handle(table, n, InteractiveMarkerFeedback { menu_entry_id, ..done(name, InteractiveMarkerFeedback::MENU_SELECT) })
}

fn let_go(table: &mut Table, name: &str, x: f64, y: f64) -> Sent {
    let pose = Pose { position: Point { x, y, z: 0.025 }, ..Pose::default() };
    handle(table, 0, InteractiveMarkerFeedback { pose, ..done(name, InteractiveMarkerFeedback::MOUSE_UP) })
}

/// A marker as clients have it.
fn find<'a>(table: &'a Table, name: &str) -> &'a InteractiveMarker {
    let found = table.handles.iter().find(|marker| marker.name == name);
    found.unwrap_or_else(|| panic!("no '{name}' in {:?}", names(table)))
}

fn names(table: &Table) -> Vec<&str> {
    table.handles.iter().map(|marker| marker.name.as_str()).collect()
}

#[test]
fn the_target_is_slid_into_place_and_a_menu_says_how_sure() {
    let mut table = Table::asking(3);
    let target = find(&table, "q3-7/target");
    assert_eq!((target.header.frame_id.as_str(), target.description.as_str()), ("table", "vase"));
    let control = &target.controls[0];
    assert_eq!(control.interaction_mode, InteractiveMarkerControl::MOVE_PLANE);
    // The control's own x axis, turned: the plane across it is the table's.
    let q = control.orientation;
    let x_axis = [1.0 - 2.0 * (q.y * q.y + q.z * q.z), 2.0 * (q.x * q.y + q.w * q.z), 2.0 * (q.x * q.z - q.w * q.y)];
    assert!((x_axis[2].abs() - 1.0).abs() < 1e-12, "{x_axis:?}");
    let titles: Vec<&str> = target.menu_entries.iter().map(|entry| entry.title.as_str()).collect();
    assert_eq!(
        titles,
        ["It belongs here", "I am sure", "Fairly sure", "It is a guess", "Skip this question", "I can't tell"]
    );

    // Not before it has been moved; and touching is not moving.
    assert!(press(&mut table, 1, "q3-7/place").demonstrations.is_empty());
    assert_eq!(find(&table, "q3-7/target").description, "first move it to where it belongs");
    let waits = find(&table, "q3-7/target").pose.position;
    let_go(&mut table, "q3-7/target", waits.x, waits.y);
    assert!(press(&mut table, 1, "q3-7/place").demonstrations.is_empty());

    // Nor into the cup.
    let_go(&mut table, "q3-7/target", 0.76, 0.75);
    assert_eq!(find(&table, "q3-7/target").description, "vase does not fit here: it would stand on 'cup'");
    assert!(press(&mut table, 1, "q3-7/place").demonstrations.is_empty());

    let_go(&mut table, "q3-7/target", 0.5, 0.45);
    assert_eq!(find(&table, "q3-7/target").pose.position, Point { x: 0.5, y: 0.45, z: 0.025 });
    let shown = choose(&mut table, 1, "q3-7/target", 2).demonstrations.remove(0);
    assert_eq!((shown.id.as_str(), shown.query_id.as_str(), shown.source.as_str()), (&*id(1), "q3-7", "operator"));
    assert_eq!((shown.placement.x, shown.placement.y), (0.5, 0.45));
    assert_eq!(shown.confidence, PlacementDemonstration::CONFIDENCE_FAIRLY);
    assert!(names(&table).is_empty(), "what is answered is asked no more");
    assert_eq!(table.answer(&id(1))["state"], "pending", "the pages show what was answered in RViz");
}

#[test]
fn a_refused_answer_opens_its_question_as_it_was() {
    let mut table = Table::asking(3);
    let_go(&mut table, "q3-7/target", 0.5, 0.45);
    assert_eq!(press(&mut table, 1, "q3-7/place").demonstrations.len(), 1);
    table.receive(&id(1), EvidenceReceipt::REFUSED, 0);
    let again = find(&table, "q3-7/target").pose.position;
    assert_eq!((again.x, again.y), (0.5, 0.45));
    assert_eq!(press(&mut table, 2, "q3-7/place").demonstrations.len(), 1);
}

#[test]
fn what_was_meant_for_one_question_never_answers_the_next() {
    let mut table = Table::asking(3);
    let_go(&mut table, "q3-7/target", 0.5, 0.45);
    table.revise(4);
    let sent = press(&mut table, 1, "q3-7/place");
    assert!(sent.demonstrations.is_empty() && sent.responses.is_empty());
    assert_eq!(find(&table, "q4-7/target").description, "that question is no longer open");
    assert!(press(&mut table, 2, "q3-7/skip").responses.is_empty());
    assert!(press(&mut table, 3, "q4-7/place").demonstrations.is_empty(), "the target waits beside the table again");
    // Two presses of the same tile are one answer.
    assert_eq!(press(&mut table, 4, "q4-7/skip").responses.len(), 1);
    assert!(press(&mut table, 5, "q4-7/skip").responses.is_empty());
}

#[test]
fn where_nothing_is_asked_nothing_is_answered() {
    for name in ["/stop", "/skip", "stop", "/target", ""] {
        let sent = press(&mut Table::new(), 1, name);
        assert!(sent.responses.is_empty() && sent.demonstrations.is_empty(), "{name:?}");
    }
}

#[test]
fn a_place_in_another_frame_is_not_taken() {
    let mut table = Table::asking(3);
    let pose = Pose { position: Point { x: 0.5, y: 0.45, z: 0.0 }, ..Pose::default() };
    let header = Header { frame_id: "camera".into(), ..Header::default() };
    let elsewhere = done("q3-7/target", InteractiveMarkerFeedback::MOUSE_UP);
    handle(&mut table, 0, InteractiveMarkerFeedback { header, pose, ..elsewhere });
    assert_eq!(find(&table, "q3-7/target").description, "its place has to be told in the frame 'table'");
    assert!(press(&mut table, 1, "q3-7/place").demonstrations.is_empty());
    // What lies beyond the edge is put at the edge, where it does not fit.
    let_go(&mut table, "q3-7/target", 7.0, -3.0);
    let at = find(&table, "q3-7/target").pose.position;
    assert_eq!((at.x, at.y), (1.0, 0.0));
    assert!(find(&table, "q3-7/target").description.contains("edge"));
    let_go(&mut table, "q3-7/target", f64::NAN, 0.5);
    assert_eq!(find(&table, "q3-7/target").pose.position, at, "no number is no place");
}

#[test]
fn every_kind_of_no_answer_is_its_own() {
    for (name, kind) in
        [("skip", QueryResponse::SKIP), ("cant_tell", QueryResponse::CANT_TELL), ("stop", QueryResponse::STOP)]
    {
        let mut table = Table::asking(3);
        let said = press(&mut table, 1, &format!("q3-7/{name}")).responses.remove(0);
        assert_eq!((said.kind, said.query_id.as_str()), (kind, "q3-7"), "{name}");
        let mut table = asking(WorldQuery::ACTION);
        assert_eq!(press(&mut table, 1, &format!("w0/{name}")).responses.remove(0).kind, kind, "{name}");
    }
    let mut table = Table::asking(3);
    assert_eq!(choose(&mut table, 1, "q3-7/target", 11).responses.remove(0).kind, QueryResponse::SKIP);
    let mut table = Table::asking(3);
    assert_eq!(choose(&mut table, 1, "q3-7/target", 12).responses.remove(0).kind, QueryResponse::CANT_TELL);
}

#[test]
fn an_action_is_a_tile() {
    let mut table = asking(WorldQuery::ACTION);
    assert_eq!(names(&table), ["w0/action 0", "w0/action 1", "w0/cant_tell", "w0/skip", "w0/stop"]);
    assert_eq!(find(&table, "w0/action 1").header.frame_id, "world");
    let sent = choose(&mut table, 1, "w0/action 1", 3).actions.remove(0);
    assert_eq!((sent.states.as_slice(), sent.actions.as_slice(), sent.confidence), ([0].as_slice(), [1].as_slice(), 2));
    assert!(names(&table).is_empty());
    for nonsense in ["w0/action 9999999999", "w0/action -1", "w0/action", "w0/", "", "w0/action 1 "] {
        let mut table = asking(WorldQuery::ACTION);
        assert!(press(&mut table, 1, nonsense).actions.is_empty(), "{nonsense:?}");
    }
}

#[test]
fn two_ways_are_compared_by_tiles() {
    for (name, answer, worse) in [
        ("first", TrajectoryPreference::RANKED, "w0-b"),
        ("second", TrajectoryPreference::RANKED, "w0-a"),
        ("equal", TrajectoryPreference::EQUAL, "w0-a"),
        ("cant_tell", TrajectoryPreference::CANT_TELL, "w0-a"),
    ] {
        let mut table = asking(WorldQuery::COMPARISON);
        let sent = press(&mut table, 1, &format!("w0/{name}")).comparisons.remove(0);
        assert_eq!((sent.answer, sent.trajectories[0].id.as_str()), (answer, worse), "{name}");
    }
}

#[test]
fn steps_are_pressed_until_they_are_good_or_bad() {
    let mut table = asking(WorldQuery::CRITIQUE);
    assert!(press(&mut table, 1, "w0/send").critiques.is_empty());
    for (step, presses) in [(0, 1), (1, 1), (2, 2)] {
        for _ in 0..presses {
            press(&mut table, 0, &format!("w0/step {step}"));
        }
    }
    let colour = |table: &Table, step: u32| find(table, &format!("w0/step {step}")).controls[0].markers[0].color;
    assert_ne!(colour(&table, 1), colour(&table, 2), "good and bad look different");
    let sent = press(&mut table, 1, "w0/send").critiques.remove(0);
    let part = |start, end, verdict| CritiqueSegment { start, end, verdict };
    assert_eq!(sent.segments, [part(0, 2, CritiqueSegment::GOOD), part(2, 3, CritiqueSegment::BAD)]);

    let mut table = asking(WorldQuery::CRITIQUE);
    press(&mut table, 0, "w0/all_good");
    let sent = press(&mut table, 1, "w0/send").critiques.remove(0);
    assert_eq!(sent.segments, [part(0, 3, CritiqueSegment::GOOD)]);
}

#[test]
fn a_client_that_counts_its_updates_never_misses_one() {
    // The harness applies every update as a client does, and fails when a number is left out or twice.
    let mut table = Table::asking(3);
    let first = table.sequence;
    for revision in 4..9 {
        table.revise(revision);
        press(&mut table, revision as u32, &format!("q{revision}-7/skip"));
    }
    assert_eq!(table.sequence, first + 10);
    // What is repeated changes nothing.
    table.revise(9);
    let before = table.sequence;
    table.revise(9);
    table.wait(5.0);
    assert_eq!(table.sequence, before);
}

#[test]
fn the_map_of_a_world_shows_what_is_asked_or_what_the_robot_would_do() {
    let mut table = asking(WorldQuery::COMPARISON);
    let spaces = |table: &Table| -> Vec<String> {
        let mut names: Vec<String> = table.drawn.iter().map(|marker| marker.ns.clone()).collect();
        names.dedup();
        names
    };
    assert_eq!(
        spaces(&table),
        [
            "all",
            "cells",
            "ends",
            "legend",
            "here",
            "way ends",
            "way letters",
            "ways",
            "way ends",
            "way letters",
            "question"
        ]
    );
    let cells = table.drawn.iter().find(|marker| marker.ns == "cells").expect("there are cells");
    assert_eq!((cells.points.len(), cells.colors.len(), cells.header.frame_id.as_str()), (3, 3, "world"));
    assert_ne!(cells.colors[0], cells.colors[2], "cells have the colour of what they are");
    table.hear(Event::Lesson(Box::new(LessonStatus { revision: 1, ..LessonStatus::default() })));
    assert_eq!(spaces(&table), ["all", "cells", "ends", "legend"], "no question, and no policy yet");
    table.hear(Event::WorldQuery(Box::new(way_query(2, WorldQuery::CRITIQUE))));
    assert!(spaces(&table).contains(&"ways".to_owned()));
}

proptest! {
    #[test]
    fn any_feedback_is_survived(
        name in "(q3-7/|w0/)?(target|place|step [0-9]{1,12}|action [0-9]{1,12}|.{0,8})",
        event_type in 0_u8..8,
        entry in any::<u32>(),
        (x, y) in (any::<f64>(), any::<f64>()),
        kind in 0_u8..3,
    ) {
        let pose = Pose { position: Point { x, y, z: 0.0 }, ..Pose::default() };
        let feedback = InteractiveMarkerFeedback { pose, menu_entry_id: entry, ..done(&name, event_type) };
        for mut table in [Table::asking(3), asking(kind), Table::new()] {
            handle(&mut table, 1, feedback.clone());
            for marker in &table.handles {
                let at = marker.pose.position;
                proptest::prop_assert!(at.x.is_finite() && at.y.is_finite() && at.z.is_finite());
            }
        }
    }
}
