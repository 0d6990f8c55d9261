//! A client of interactive markers as RViz is one: it asks the service for everything, takes the updates after it, and what a
//! person does there becomes evidence.

use crate::graph::Lesson;
use apprentice_msgs::geometry_msgs::{Point, Pose};
use apprentice_msgs::msg::PlacementDemonstration;
use apprentice_msgs::std_msgs::Header;
use apprentice_msgs::visualization_msgs::{
    GetInteractiveMarkers, GetInteractiveMarkersRequest, GetInteractiveMarkersResponse, InteractiveMarkerFeedback,
};
use bus::Qos;

/// Everything there is, once it holds the target of a question.
fn everything(lesson: &Lesson, query_id: &str) -> GetInteractiveMarkersResponse {
    let service = "/rviz/question/get_interactive_markers";
    let target = format!("{query_id}/target");
    for _ in 0..1000 {
        let request = GetInteractiveMarkersRequest::default();
        let all = lesson.graph.call::<GetInteractiveMarkers>(service, &request).expect("the service answers");
        if all.markers.iter().any(|marker| marker.name == target) {
            return all;
        }
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    panic!("{target} is not among the interactive markers");
}

#[test]
fn a_lesson_is_taught_in_rviz() {
    let mut lesson = Lesson::new("rviz");
    let feedback = lesson.publisher::<InteractiveMarkerFeedback>("question/feedback", Qos::Event);
    lesson.start_all();
    let mut at = 0.0;
    for revision in 0..3 {
        let query = lesson.query(revision);
        let all = everything(&lesson, &query.id);
        assert!(all.sequence_number > 0);
        // The freest spot of the table, as a person sees it.
        let scene = exchange::scene_from_message(&query.scene).expect("a good table");
        let occupied = scene.occupied();
        let free = |x: &f64| occupied.is_free(scene::Point { x: *x, y: 0.5 * scene.depth_m });
        let x = (1..20).map(|i| 0.05 * f64::from(i) * scene.width_m).find(free).expect("there is room");
        let target = format!("{}/target", query.id);
        let act = |event_type: u8, menu_entry_id: u32| InteractiveMarkerFeedback {
            header: Header { frame_id: query.scene.header.frame_id.clone(), ..Header::default() },
            client_id: "rviz".into(),
            marker_name: target.clone(),
            control_name: "slide".into(),
            event_type,
            pose: Pose { position: Point { x, y: 0.5 * scene.depth_m, z: 0.0 }, ..Pose::default() },
            menu_entry_id,
            ..InteractiveMarkerFeedback::default()
        };
        for message in [
            act(InteractiveMarkerFeedback::MOUSE_UP, 0),
            act(InteractiveMarkerFeedback::MENU_SELECT, revision as u32 + 1),
        ] {
            feedback.publish(&message).expect("memory takes everything");
        }
        lesson.posterior(revision + 1);
        at = x;
    }
    let log = lesson.evidence(3);
    let shown: Vec<&PlacementDemonstration> = log.records.iter().flat_map(|record| &record.demonstration).collect();
    let said: Vec<(u8, &str)> = shown.iter().map(|m| (m.confidence, m.source.as_str())).collect();
    assert_eq!(said, [0, 1, 2].map(|confidence| (confidence, "operator")));
    assert_eq!(shown[2].placement.x, at);
}
