//! Which of two places is better: what a page is shown of that, what its answers become, and the same at the handles of RViz.

mod world;

use apprentice_msgs::geometry_msgs::{Point, Pose};
use apprentice_msgs::msg::{EvidenceReceipt, TrajectoryPreference};
use apprentice_msgs::std_msgs::Header;
use apprentice_msgs::visualization_msgs::InteractiveMarkerFeedback as Feedback;
use operator_ui::Event;
use serde_json::{Value, json};
use world::id;
use world::table::{Sent, Table};

fn asking() -> Table {
    let mut table = Table::asking(3);
    table.hear(Event::Query(Box::new(world::pair(3))));
    table
}

fn compare(n: u32, better: &str) -> Value {
    json!({"type": "compare", "id": id(n), "query_id": "q3-7", "better": better, "confidence": "fairly"})
}

fn press(table: &mut Table, n: u32, name: &str) -> Sent {
    let feedback = Feedback {
        header: Header { frame_id: "table".into(), ..Header::default() },
        marker_name: format!("q3-7/{name}"),
        event_type: Feedback::BUTTON_CLICK,
        ..Feedback::default()
    };
    table.hear(Event::Handled(Box::new(feedback), id(n)))
}

#[test]
fn both_places_are_shown_and_the_better_is_sent_worst_first_until_its_receipt() {
    for (better, answer, worse) in [
        ("first", TrajectoryPreference::RANKED, "q3-7-b"),
        ("second", TrajectoryPreference::RANKED, "q3-7-a"),
        ("equal", TrajectoryPreference::EQUAL, "q3-7-a"),
        ("cant_tell", TrajectoryPreference::CANT_TELL, "q3-7-a"),
    ] {
        let mut table = asking();
        let shown = &table.shown["question"];
        assert_eq!(shown["options"], json!([{"x_m": 0.5, "y_m": 0.52}, {"x_m": 0.45, "y_m": 0.9}]));
        let sent = table.say(&compare(1, better)).comparisons.remove(0);
        assert_eq!((sent.answer, sent.trajectories[0].id.as_str()), (answer, worse), "{better}");
        assert_eq!((sent.query_id.as_str(), sent.confidence), ("q3-7", TrajectoryPreference::CONFIDENCE_FAIRLY));
        assert_eq!(sent.trajectories.iter().map(|of| of.features.len()).collect::<Vec<_>>(), [2, 2]);
        assert_eq!(table.shown["question"]["open"], false);
        assert_eq!(table.wait(1.0).comparisons, vec![sent]);
        table.receive(&id(1), EvidenceReceipt::ACCEPTED, 4);
        assert!(table.wait(5.0).comparisons.is_empty());
        assert_eq!(table.answer(&id(1))["kind"], "preference");
    }
}

#[test]
fn a_third_place_may_be_shown_and_what_does_not_ask_which_is_not_told_which() {
    let mut table = asking();
    let third = json!({"type": "place", "id": id(1), "query_id": "q3-7", "x_m": 0.6, "y_m": 0.5, "confidence": "sure"});
    assert_eq!(table.say(&third).demonstrations.len(), 1);
    let mut plain = Table::asking(3);
    assert!(plain.say(&compare(1, "first")).comparisons.is_empty());
    assert!(plain.refused[0].1.contains("does not ask which is better"), "{:?}", plain.refused);
    assert_eq!(plain.shown["question"]["options"], json!([]));
    assert_eq!(plain.shown["question"]["open"], true);
}

#[test]
fn a_question_whose_places_cannot_be_shown_is_told_and_not_asked() {
    let broken = |change: fn(&mut apprentice_msgs::msg::PlacementQuery)| {
        let mut table = Table::asking(3);
        let mut query = world::pair(4);
        change(&mut query);
        table.hear(Event::Query(Box::new(query)));
        assert_eq!(table.shown["question"]["id"], "q3-7", "the one before stays");
        table.notices.remove(0)
    };
    let nowhere = broken(|query| query.options[1].placement.x = f64::NAN);
    assert!(nowhere.contains("question 'q4-7' cannot be shown") && nowhere.contains("off the table"), "{nowhere}");
    let off = broken(|query| query.options[0].placement.y = 1.2);
    assert!(off.contains("(0.5, 1.2) m"), "{off}");
    let lonely = broken(|query| drop(query.options.pop()));
    assert!(lonely.contains("it offers 1 places"), "{lonely}");
}

#[test]
fn in_rviz_either_place_or_its_tile_is_pressed_or_the_target_moved_elsewhere() {
    for (name, answer, worse) in [
        ("first", TrajectoryPreference::RANKED, "q3-7-b"),
        ("second", TrajectoryPreference::RANKED, "q3-7-a"),
        ("first tile", TrajectoryPreference::RANKED, "q3-7-b"),
        ("second tile", TrajectoryPreference::RANKED, "q3-7-a"),
        ("equal", TrajectoryPreference::EQUAL, "q3-7-a"),
        ("cant_tell", TrajectoryPreference::CANT_TELL, "q3-7-a"),
    ] {
        let mut table = asking();
        let at = |name: &str| {
            let name = format!("q3-7/{name}");
            let found = table.handles.iter().find(|marker| marker.name == name);
            found.unwrap_or_else(|| panic!("no '{name}'")).pose.position
        };
        assert_eq!([at("first").x, at("first").y, at("second").x, at("second").y], [0.5, 0.52, 0.45, 0.9]);
        let sent = press(&mut table, 1, name).comparisons.remove(0);
        assert_eq!((sent.answer, sent.trajectories[0].id.as_str()), (answer, worse), "{name}");
        assert!(table.handles.is_empty(), "an answered question has no handles");
    }
    let mut table = asking();
    assert!(press(&mut table, 1, "place").demonstrations.is_empty(), "it has not been moved yet");
    let moved = Feedback {
        header: Header { frame_id: "table".into(), ..Header::default() },
        marker_name: "q3-7/target".into(),
        event_type: Feedback::MOUSE_UP,
        pose: Pose { position: Point { x: 0.6, y: 0.5, z: 0.025 }, ..Pose::default() },
        ..Feedback::default()
    };
    table.hear(Event::Handled(Box::new(moved), id(2)));
    let shown = press(&mut table, 3, "place").demonstrations.remove(0);
    assert_eq!((shown.query_id.as_str(), shown.placement.x), ("q3-7", 0.6));
    // The menu of the target says that neither can be told to be better, which says something; a skip does not.
    let chosen = |entry| {
        let mut table = asking();
        let feedback = Feedback {
            marker_name: "q3-7/target".into(),
            event_type: Feedback::MENU_SELECT,
            menu_entry_id: entry,
            ..Feedback::default()
        };
        table.hear(Event::Handled(Box::new(feedback), id(1)))
    };
    assert_eq!(chosen(12).comparisons.remove(0).answer, TrajectoryPreference::CANT_TELL);
    assert_eq!(chosen(11).responses.len(), 1);
}
