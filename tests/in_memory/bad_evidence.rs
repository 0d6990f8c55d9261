//! Evidence that cannot be: each kind is refused with one clear sentence, and nothing that was said before is lost.

use crate::evidence::{retraction, table, volunteered};
use crate::graph::Lesson;
use crate::log_lines::{self, warnings};
use apprentice_msgs::msg::{EvidenceReceipt, PlacementDemonstration, PlacementQuery, QueryResponse};

/// A lesson in which the first question has been answered and the second is open.
fn lesson(name: &str) -> (Lesson, PlacementQuery) {
    let mut lesson = Lesson::new(name);
    lesson.start_core();
    lesson.scene.publish(&table()).expect("memory takes everything");
    let first = lesson.query(0);
    lesson.show(&answer(&first, "first", 0.5, 0.45));
    let open = lesson.query(1);
    (lesson, open)
}

/// A spot on the question's table that is free of its objects, the nearest to the wish on a grid of 5 cm.
fn free_spot(query: &PlacementQuery, x: f64, y: f64) -> (f64, f64) {
    let scene = exchange::scene_from_message(&query.scene).expect("a question is about a good scene");
    let wish = scene::Point::new(x, y);
    let spots = (2..19).flat_map(|i| (2..19).map(move |j| scene::Point::new(f64::from(i) * 0.05, f64::from(j) * 0.05)));
    let occupied = scene.occupied();
    let nearest = spots
        .filter(|&at| occupied.is_free(at))
        .min_by(|a, b| a.distance(wish).total_cmp(&b.distance(wish)))
        .expect("the table is not full");
    (nearest.x, nearest.y)
}

/// An answer to a question.
fn answer(query: &PlacementQuery, id: &str, x: f64, y: f64) -> PlacementDemonstration {
    let (x, y) = free_spot(query, x, y);
    PlacementDemonstration { query_id: query.id.clone(), scene: query.scene.clone(), ..volunteered(id, x, y) }
}

/// Sends a demonstration that must be refused for a reason that holds `wanted`, told in one line.
fn refused(lesson: &mut Lesson, message: &PlacementDemonstration, wanted: &str) {
    lesson.demonstration.publish(message).expect("memory takes everything");
    let receipt = lesson.receipt(&message.id);
    assert_eq!(receipt.outcome, EvidenceReceipt::REFUSED, "{} was not refused", message.id);
    assert!(receipt.reason.contains(wanted), "expected {wanted:?} in {:?}", receipt.reason);
    assert_eq!(receipt.revision, 0);
    told_once(&message.id, wanted);
}

/// One warning names the id and holds `wanted`.
fn told_once(id: &str, wanted: &str) {
    let told = log_lines::wait_for_warning(&format!(" '{id}' from 'test'"));
    assert_eq!(told.len(), 1, "{told:#?}");
    assert!(told[0].contains(wanted) && !told[0].contains('\n'), "{}", told[0]);
}

/// The lesson goes on: the open question can still be answered, and the log holds the first answer and this one.
fn goes_on(mut lesson: Lesson, open: &PlacementQuery) {
    lesson.show(&answer(open, "last", 0.45, 0.55));
    let log = lesson.evidence(2);
    let ids: Vec<&str> = log.records.iter().flat_map(|record| &record.demonstration).map(|d| d.id.as_str()).collect();
    assert_eq!(ids, ["first", "last"]);
    assert_eq!(lesson.posterior(2).n_demonstrations, 2);
}

#[test]
fn a_nan_pose_is_refused() {
    let (mut lesson, open) = lesson("nan");
    let mut shown = volunteered("nan-placement", 0.5, 0.5);
    shown.placement.x = f64::NAN;
    refused(&mut lesson, &shown, "the placement is (NaN, 0.5, 0)");
    let mut shown = volunteered("nan-object", 0.5, 0.5);
    shown.scene.objects[0].pose.position.y = f64::NAN;
    refused(&mut lesson, &shown, "'cup'");
    let mut shown = volunteered("nan-rotation", 0.5, 0.5);
    shown.scene.objects[1].pose.orientation.w = f64::NAN;
    refused(&mut lesson, &shown, "'plate'");
    let mut shown = volunteered("endless-table", 0.5, 0.5);
    shown.scene.width_m = f64::INFINITY;
    refused(&mut lesson, &shown, "inf");
    goes_on(lesson, &open);
}

#[test]
fn an_object_off_the_table_is_refused() {
    let (mut lesson, open) = lesson("off");
    let mut shown = volunteered("off-object", 0.5, 0.5);
    shown.scene.objects[0].pose.position.x = 1.7;
    refused(&mut lesson, &shown, "'cup'");
    refused(&mut lesson, &volunteered("off-placement", 0.5, 1.2), "(0.5, 1.2) m");
    refused(&mut lesson, &volunteered("on-the-cup", 0.25, 0.25), "cup");
    goes_on(lesson, &open);
}

#[test]
fn duplicate_ids_are_refused() {
    let (mut lesson, open) = lesson("duplicates");
    let mut shown = volunteered("two-cups", 0.5, 0.5);
    shown.scene.objects[1].id = "cup".to_owned();
    refused(&mut lesson, &shown, "cup");
    // The id of the first answer, for other evidence: its own receipt stands, a second one refuses.
    lesson.demonstration.publish(&volunteered("first", 0.3, 0.6)).expect("memory takes everything");
    let receipt = lesson.wait("the refusal of a used id", |heard| match heard {
        crate::graph::Heard::Receipt(r) if r.id == "first" && r.outcome == EvidenceReceipt::REFUSED => Some(r.clone()),
        _ => None,
    });
    assert!(receipt.reason.contains("used before"), "{}", receipt.reason);
    lesson.retraction.publish(&retraction("first", "first")).expect("memory takes everything");
    refused(&mut lesson, &volunteered("", 0.5, 0.5), "id has 0 characters");
    goes_on(lesson, &open);
}

#[test]
fn an_answer_to_a_question_that_is_not_open_is_refused() {
    let (mut lesson, open) = lesson("not_open");
    let first = lesson.query(0);
    refused(&mut lesson, &answer(&first, "too-late", 0.4, 0.4), "no longer open");
    let invented = PlacementQuery { id: "invented".to_owned(), ..open.clone() };
    refused(&mut lesson, &answer(&invented, "never-asked", 0.4, 0.4), "was never asked");
    let (id, source) = ("late-skip".into(), "test".into());
    let response = QueryResponse { id, query_id: first.id, source, ..QueryResponse::default() };
    lesson.response.publish(&response).expect("memory takes everything");
    assert_eq!(lesson.receipt("late-skip").outcome, EvidenceReceipt::REFUSED);
    told_once("late-skip", "no longer open");
    goes_on(lesson, &open);
}

#[test]
fn an_answer_sent_twice_counts_once() {
    let (mut lesson, open) = lesson("twice");
    let shown = answer(&open, "twice", 0.6, 0.4);
    lesson.show(&shown);
    for _ in 0..3 {
        lesson.demonstration.publish(&shown).expect("memory takes everything");
    }
    let again = lesson.wait("a receipt of the repetition", |heard| match heard {
        crate::graph::Heard::Receipt(r) if r.id == "twice" && r.outcome == EvidenceReceipt::DUPLICATE => {
            Some(r.clone())
        }
        _ => None,
    });
    assert_eq!(again.revision, 2);
    // Another answer to the same question is one too many.
    refused(&mut lesson, &answer(&open, "second-thought", 0.4, 0.6), "no longer open");
    let next = lesson.query(2);
    lesson.show(&answer(&next, "next", 0.5, 0.5));
    assert_eq!(lesson.evidence(3).records.len(), 3);
    assert!(warnings("'twice'").is_empty(), "a repetition is no fault");
}

#[test]
fn a_retraction_of_nothing_and_a_second_one_are_refused() {
    let (mut lesson, open) = lesson("retractions");
    for (id, of, wanted) in
        [("undo-nothing", "nothing", "has not been accepted"), ("undo-empty", "", "has not been accepted")]
    {
        lesson.retraction.publish(&retraction(id, of)).expect("memory takes everything");
        assert_eq!(lesson.receipt(id).outcome, EvidenceReceipt::REFUSED);
        told_once(id, wanted);
    }
    lesson.show(&answer(&open, "kept", 0.6, 0.4));
    for (id, outcome) in [("undo", EvidenceReceipt::ACCEPTED), ("undo-again", EvidenceReceipt::REFUSED)] {
        lesson.retraction.publish(&retraction(id, "kept")).expect("memory takes everything");
        assert_eq!(lesson.receipt(id).outcome, outcome);
    }
    told_once("undo-again", "taken back before");
    assert_eq!(lesson.evidence(3).records.len(), 3);
}

#[test]
fn evidence_about_another_table_is_refused() {
    let (mut lesson, open) = lesson("another_table");
    let mut shown = volunteered("less", 0.5, 0.5);
    shown.scene.objects.pop();
    refused(&mut lesson, &shown, "[cup]");
    let mut shown = volunteered("spoon", 0.5, 0.5);
    shown.scene.target.id = "spoon".to_owned();
    refused(&mut lesson, &shown, "'spoon'");
    let mut shown = answer(&open, "moved", 0.5, 0.5);
    shown.scene.objects[0].pose.position.x += 0.013;
    refused(&mut lesson, &shown, "not the one that question");
    goes_on(lesson, &open);
}
