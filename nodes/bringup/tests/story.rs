//! Claims about what is told of a lesson, and what is counted.

use apprentice_msgs::action::PlaceObjectResult;
use apprentice_msgs::builtin_interfaces::Duration as TimeFromStart;
use apprentice_msgs::geometry_msgs::Point;
use apprentice_msgs::msg::{
    Carrying, EvidenceLog, EvidenceReceipt, EvidenceRecord, FeatureTrajectory, LessonStatus, PerformanceBounds,
    PlacementBound, PlacementDemonstration, PlacementOption, PlacementPlan, PlacementQuery, QueryResponse, Retraction,
    SceneObject, TableScene, TrajectoryPreference,
};
use apprentice_msgs::trajectory_msgs::JointTrajectoryPoint;
use bringup::{Circumstances, Kind, Ledger, NodeCount, Percentiles, Placing, SessionRecord, Story, Summary, Topic};
use std::collections::BTreeMap;
use std::time::Duration;

fn object(id: &str, label: &str, x: f64, y: f64) -> SceneObject {
    let mut object = SceneObject { id: id.to_owned(), label: label.to_owned(), ..SceneObject::default() };
    object.pose.position = Point { x, y, z: 0.0 };
    object
}

fn table() -> TableScene {
    TableScene {
        objects: vec![
            object("plate_1", "plate", 0.2, 0.7),
            object("plate_2", "plate", 0.7, 0.7),
            object("cup", "cup", 0.2, 0.2),
        ],
        target: object("vase", "vase", 0.0, 0.0),
        ..TableScene::default()
    }
}

fn query(id: &str, revision: u64, bound_m: f64) -> PlacementQuery {
    PlacementQuery { id: id.to_owned(), revision, bound_m, scene: table(), ..PlacementQuery::default() }
}

fn lesson(revision: u64, state: u8, bound_m: f64) -> LessonStatus {
    LessonStatus {
        revision,
        state,
        bound_m,
        epsilon_m: 0.1,
        questions_asked: 12,
        demonstrations: 11,
        reason: "because".to_owned(),
        ..LessonStatus::default()
    }
}

fn bounds(revision: u64, bound_m: f64) -> PerformanceBounds {
    PerformanceBounds { revision, bound_m, alpha: 0.95, delta: 0.05, ..PerformanceBounds::default() }
}

fn texts(lines: Vec<(Kind, String)>) -> Vec<String> {
    lines.into_iter().map(|(_, text)| text.trim().to_owned()).collect()
}

fn evidence() -> EvidenceLog {
    let shown = PlacementDemonstration {
        source: "simulated_person".to_owned(),
        placement: Point { x: 0.5, y: 0.5, z: 0.0 },
        ..PlacementDemonstration::default()
    };
    let undo = Retraction { evidence_id: "a-1".to_owned(), source: "operator".to_owned(), ..Retraction::default() };
    let stop = QueryResponse { kind: QueryResponse::STOP, source: "operator".to_owned(), ..QueryResponse::default() };
    let record = |sequence, kind| EvidenceRecord { sequence, kind, ..EvidenceRecord::default() };
    let mut records = vec![
        record(1, EvidenceRecord::DEMONSTRATION),
        record(2, EvidenceRecord::RETRACTION),
        record(3, EvidenceRecord::RESPONSE),
    ];
    records[0].demonstration.push(shown);
    records[1].retraction.push(undo);
    records[2].response.push(stop);
    EvidenceLog { records, ..EvidenceLog::default() }
}

#[test]
fn a_question_names_what_moved_by_label_or_by_id_where_labels_repeat_and_is_told_once() {
    let mut story = Story::default();
    story.tell(&Topic::Scene(table()));
    assert!(story.tell(&Topic::Query(query("q1", 0, f64::NAN))).is_empty(), "a question waits for the bound behind it");
    let mut moved = query("q2", 1, 0.142);
    moved.scene.objects[1].pose.position = Point { x: 0.31, y: 0.72, z: 0.0 };
    let mut further = moved.clone();
    further.id = "q3".to_owned();
    further.scene.objects[2].pose.position.x = 0.9;
    let mut told = Vec::new();
    for query in [&moved, &further, &further, &PlacementQuery { id: "q4".to_owned(), ..further.clone() }] {
        told.extend(texts(story.tell(&Topic::Query(query.clone()))));
    }
    // Only what has changed since the question before is named; the last question waits.
    let wanted = [
        "1   where does the vase belong on the table as it is?  no bound there yet",
        "2   where does the vase belong if plate_2 moves to (0.31, 0.72) m?  worst case there 14.2 cm",
        "3   where does the vase belong if the cup moves to (0.90, 0.20) m?  worst case there 14.2 cm",
    ];
    assert_eq!(told, wanted);
    let last = texts(story.tell(&Topic::Evidence(EvidenceLog::default())));
    assert_eq!(last, ["4   where does the vase belong on the same table?  worst case there 14.2 cm"]);
}

#[test]
fn a_question_of_two_places_names_both_and_its_answer_the_better() {
    let option = |name: &str, x: f64| PlacementOption {
        placement: Point { x, y: 0.5, z: 0.0 },
        trajectory: FeatureTrajectory { id: format!("q1-{name}"), features: vec![x] },
    };
    let options = vec![option("a", 0.25), option("b", 0.75)];
    let asked = |story: &mut Story| {
        story.tell(&Topic::Scene(table()));
        story.tell(&Topic::Query(PlacementQuery { options: options.clone(), ..query("q1", 0, 0.2) }));
    };
    let answered = |answer: u8| {
        let preference = TrajectoryPreference {
            source: "operator".to_owned(),
            trajectories: options.iter().map(|option| option.trajectory.clone()).collect(),
            answer,
            ..TrajectoryPreference::default()
        };
        let record = EvidenceRecord { sequence: 1, preference: vec![preference], ..EvidenceRecord::default() };
        Topic::Evidence(EvidenceLog { records: vec![record], ..EvidenceLog::default() })
    };
    let question = "1   which is better for the vase on the table as it is, A (0.25, 0.50) m or B (0.75, 0.50) m?  worst case there 20.0 cm";
    for (answer, words) in [
        (TrajectoryPreference::RANKED, "1   operator: B (0.75, 0.50) m is better  \u{2192} revision 1"),
        (TrajectoryPreference::EQUAL, "1   operator: both are about equal  \u{2192} revision 1"),
        (TrajectoryPreference::CANT_TELL, "1   operator: I can't tell which is better  \u{2192} revision 1"),
    ] {
        let mut story = Story::default();
        asked(&mut story);
        assert_eq!(texts(story.tell(&answered(answer))), [question, words]);
    }
    // Of places that nobody asked about here only the number is known.
    let told = texts(Story::default().tell(&answered(TrajectoryPreference::RANKED)));
    assert_eq!(told, ["1   operator: 2 trajectories compared  \u{2192} revision 1"]);
}

#[test]
fn a_question_is_told_after_the_bound_it_comes_from_and_before_its_answer() {
    let mut story = Story::default();
    story.tell(&Topic::Query(query("q1", 3, 0.2)));
    story.tell(&Topic::Lesson(lesson(3, LessonStatus::ASKING, 0.2)));
    let told = texts(story.tell(&Topic::Bounds(bounds(3, 0.2))));
    assert!(told.len() == 2 && told[0].starts_with("95 % sure") && told[1].starts_with("1   where"), "{told:?}");
    story.tell(&Topic::Query(query("q2", 4, 0.2)));
    let mut log = evidence();
    log.records.truncate(1);
    let told = texts(story.tell(&Topic::Evidence(log)));
    assert!(told.len() == 2 && told[0].starts_with("2   where") && told[1].contains("revision 1"), "{told:?}");
}

#[test]
fn every_piece_of_evidence_is_told_once_and_a_continued_session_in_one_line() {
    let mut story = Story::default();
    let mut log = evidence();
    let all = log.records.clone();
    log.records.truncate(1);
    assert_eq!(
        texts(story.tell(&Topic::Evidence(log.clone()))),
        ["1   simulated person: (0.50, 0.50) m  \u{2192} revision 1"]
    );
    assert!(story.tell(&Topic::Evidence(log.clone())).is_empty());
    log.records = all;
    let rest = texts(story.tell(&Topic::Evidence(log.clone())));
    assert_eq!(rest.len(), 2);
    assert!(
        rest[0].contains("operator takes back 'a-1'") && rest[1].contains("stop, nothing is acceptable"),
        "{rest:?}"
    );
    let continued = texts(Story::default().tell(&Topic::Evidence(log)));
    assert_eq!(continued, ["3   answers and corrections are there already"]);
}

#[test]
fn the_bound_is_told_once_in_whichever_order_its_two_topics_come() {
    for swapped in [false, true] {
        let mut story = Story::default();
        let mut topics = [Topic::Bounds(bounds(3, 0.124)), Topic::Lesson(lesson(3, LessonStatus::ASKING, 0.124))];
        if swapped {
            topics.reverse();
        }
        assert!(story.tell(&topics[0]).is_empty());
        let told = texts(story.tell(&topics[1]));
        assert_eq!(told.len(), 1);
        let wanted = "95 % sure: at most 1 reward in 20 puts it more than 12.4 cm off (\u{3b5} = 10.0 cm)  |";
        assert!(told[0].starts_with(wanted), "{told:?}");
        assert!(story.tell(&topics[0]).is_empty() && story.tell(&topics[1]).is_empty());
    }
}

#[test]
fn without_a_bound_the_reason_is_told() {
    let mut story = Story::default();
    let mut none = bounds(1, f64::NAN);
    none.outcome = PlacementBound::NOT_ENOUGH_SAMPLES;
    none.reason = "no bound, because 40 effective draws are fewer than 59".to_owned();
    story.tell(&Topic::Bounds(none.clone()));
    assert_eq!(texts(story.tell(&Topic::Lesson(lesson(1, LessonStatus::ASKING, f64::NAN)))), [none.reason]);
}

#[test]
fn the_end_is_told_and_told_again_only_after_it_was_taken_back() {
    let mut story = Story::default();
    story.tell(&Topic::Bounds(bounds(12, 0.09)));
    let end = Topic::Lesson(lesson(12, LessonStatus::TAUGHT, 0.09));
    let told = texts(story.tell(&end));
    assert_eq!(
        told.last().map(String::as_str),
        Some("taught after 12 questions: the bound is 9.00 < \u{3b5} = 10.00 cm")
    );
    assert!(story.tell(&end).is_empty());
    story.tell(&Topic::Lesson(lesson(13, LessonStatus::ASKING, 0.11)));
    let again = texts(story.tell(&Topic::Lesson(lesson(14, LessonStatus::GAVE_UP, 0.11))));
    assert_eq!(again, ["gave up after 12 questions: because"]);
}

fn plan(revision: u64) -> PlacementPlan {
    let mut plan = PlacementPlan { revision, inside_bound: true, ..PlacementPlan::default() };
    plan.robust_placement = Point { x: 0.5, y: 0.52, z: 0.0 };
    plan.trajectory.points.push(JointTrajectoryPoint {
        time_from_start: TimeFromStart::from_seconds(4.2),
        ..JointTrajectoryPoint::default()
    });
    plan
}

#[test]
fn a_plan_is_told_when_the_robot_may_move_and_guesses_are_not() {
    let mut story = Story::default();
    story.tell(&Topic::Scene(table()));
    let told = texts(story.tell(&Topic::Plan(Box::new(plan(12)))));
    assert_eq!(told, ["the vase goes to (0.50, 0.52) m; the arm needs 4.2 s"]);
    assert!(story.tell(&Topic::Plan(Box::new(plan(12)))).is_empty());
    let guess = PlacementPlan { query_id: "q".to_owned(), ..plan(13) };
    assert!(story.tell(&Topic::Plan(Box::new(guess))).is_empty());
    assert!(story.tell(&Topic::Plan(Box::new(PlacementPlan { inside_bound: false, ..plan(13) }))).is_empty());
}

#[test]
fn text_from_the_graph_cannot_command_the_terminal_or_flood_it() {
    let mut story = Story::default();
    let mut hostile = query("q", 0, f64::NAN);
    hostile.scene.target.label = format!("\u{1b}[2J{}", "v".repeat(100_000));
    story.tell(&Topic::Query(hostile));
    let told = texts(story.tell(&Topic::Evidence(EvidenceLog::default())));
    assert!(told[0].len() < 400 && !told[0].contains('\u{1b}'));
}

fn seconds(s: u64) -> Duration {
    Duration::from_secs(s)
}

fn accepted(revision: u64) -> Topic {
    Topic::Receipt(EvidenceReceipt { revision, outcome: EvidenceReceipt::ACCEPTED, ..EvidenceReceipt::default() })
}

#[test]
fn latencies_run_from_acceptance_to_the_first_question_that_knows_of_it() {
    let mut ledger = Ledger::default();
    ledger.note(seconds(2), &Topic::Query(query("q1", 0, f64::NAN)));
    ledger.note(seconds(3), &accepted(1));
    ledger.note(seconds(4), &Topic::Query(query("q1", 0, f64::NAN)));
    ledger.note(seconds(5), &Topic::Query(query("q2", 1, 0.2)));
    ledger.note(seconds(6), &Topic::Query(query("q2", 1, 0.2)));
    // Revision 2 is overtaken by 3 before any question knows of it; only 3 was waited for.
    ledger.note(seconds(7), &accepted(2));
    ledger.note(seconds(8), &accepted(3));
    ledger.note(seconds(9), &Topic::Lesson(lesson(3, LessonStatus::ASKING, 0.2)));
    ledger.note(seconds(12), &Topic::Lesson(lesson(3, LessonStatus::TAUGHT, 0.09)));
    assert_eq!(ledger.latencies_ms(), [2000.0, 4000.0]);
    assert_eq!(ledger.first_question, Some(seconds(2)));
    assert!(ledger.is_over() && !ledger.has_final_plan());
    ledger.note(seconds(13), &Topic::Plan(Box::new(plan(2))));
    assert!(!ledger.has_final_plan());
    ledger.note(seconds(13), &Topic::Plan(Box::new(plan(3))));
    assert!(ledger.has_final_plan());
}

fn circumstances() -> Circumstances {
    Circumstances {
        record: SessionRecord { scenario: "flowers".to_owned(), seed: 7, version: "0".to_owned() },
        session: "bags/s".to_owned(),
        bag: Some("bags/s/bag".to_owned()),
        demonstrator: "simulated",
        commit: "abc".to_owned(),
    }
}

#[test]
fn the_summary_says_what_happened_and_null_for_what_did_not() {
    let counts = BTreeMap::from([("active_query", NodeCount { starts: 2, deaths: 1 })]);
    let mut ledger = Ledger::default();
    let nothing = Summary::new(&circumstances(), &ledger, counts.clone(), seconds(3), Some("interrupted by SIGINT"));
    assert_eq!((nothing.taught, nothing.state, nothing.why.as_str()), (false, "asking", "interrupted by SIGINT"));
    ledger.note(seconds(1), &Topic::Query(query("q1", 0, f64::NAN)));
    ledger.note(seconds(1), &Topic::Evidence(evidence()));
    ledger.note(seconds(2), &accepted(1));
    ledger.note(seconds(3), &Topic::Lesson(lesson(12, LessonStatus::TAUGHT, 0.09)));
    ledger.note(seconds(3), &Topic::Plan(Box::new(plan(12))));
    let root = tempfile::tempdir().expect("a folder");
    let path = root.path().join("summary.json");
    Summary::new(&circumstances(), &ledger, counts, seconds(9), Some("interrupted by SIGINT"))
        .write(&path)
        .expect("writes");
    let text = std::fs::read_to_string(&path).expect("reads");
    let json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let wanted = serde_json::json!({
        "taught": true, "state": "taught", "why": "because", "questions_asked": 12, "answers": 2, "demonstrations": 11,
        "last_bound_m": 0.09, "epsilon_m": 0.1, "placement_m": [0.5, 0.52], "placed": null, "wall_time_s": 9.0,
        "start_to_first_question_s": 1.0, "answer_to_next_question_ms": {"p50": 1000.0, "p99": 1000.0, "n": 1},
        "bag": "bags/s/bag", "session": "bags/s", "scenario": "flowers", "demonstrator": "simulated", "seed": 7,
        "version": env!("CARGO_PKG_VERSION"), "commit": "abc", "nodes": {"active_query": {"starts": 2, "deaths": 1}}
    });
    assert_eq!(json, wanted);
    let files = std::fs::read_dir(root.path()).expect("reads").count();
    assert_eq!(files, 1, "a partial file was left");
    ledger.note(seconds(10), &Topic::Lesson(lesson(13, LessonStatus::ASKING, f64::NAN)));
    let without = Summary::new(&circumstances(), &ledger, BTreeMap::new(), seconds(10), None);
    assert_eq!(without.last_bound_m, None);
}

#[test]
fn what_the_arm_does_is_told_once_a_step_and_how_it_ended() {
    let mut story = Story::default();
    story.tell(&Topic::Scene(table()));
    let mut told = |revision: u64, over: bool, outcome: u8, words: &str| {
        let placement = Point { x: 0.5, y: 0.52, z: 0.0 };
        let description = words.to_owned();
        let carrying = Carrying { revision, over, outcome, description, placement, ..Carrying::default() };
        texts(story.tell(&Topic::Carrying(Box::new(carrying))))
    };
    assert_eq!(told(12, false, 0, "the gripper closes"), ["the gripper closes"]);
    assert!(told(12, false, 0, "the gripper closes").is_empty(), "said again");
    assert_eq!(told(12, true, PlaceObjectResult::DONE, "it stands"), ["the vase stands at (0.50, 0.52) m"]);
    assert_eq!(told(13, false, 0, "the gripper closes"), ["the gripper closes"], "of the next plan");
    let failed = told(13, true, PlaceObjectResult::GRASP_FAILED, "the gripper did not close");
    assert_eq!(failed, ["the vase was not put there: the gripper did not close"]);
}

#[test]
fn the_summary_says_whether_the_thing_was_put_there() {
    let summary = |plan: PlacementPlan, carrying: Option<Carrying>| {
        let mut ledger = Ledger::default();
        ledger.note(seconds(1), &Topic::Lesson(lesson(12, LessonStatus::TAUGHT, 0.09)));
        ledger.note(seconds(2), &Topic::Plan(Box::new(plan)));
        let carrying = carrying.map(Box::new);
        carrying.into_iter().for_each(|carrying| ledger.note(seconds(3), &Topic::Carrying(carrying)));
        let summary = Summary::new(&circumstances(), &ledger, BTreeMap::new(), seconds(4), None);
        (ledger.placing(), summary.placed, summary.placed_reason)
    };
    let told = |over: bool, outcome: u8, words: &str| {
        let description = words.to_owned();
        Some(Carrying { revision: 12, over, outcome, description, ..Carrying::default() })
    };
    assert_eq!(summary(plan(12), None), (Placing::NotBegun, None, None));
    let moving = told(false, 0, "the gripper closes");
    assert_eq!(summary(plan(12), moving), (Placing::UnderWay, None, None));
    let stands = told(true, PlaceObjectResult::DONE, "it stands");
    assert_eq!(summary(plan(12), stands), (Placing::Over, Some(true), Some("it stands".into())));
    let failed = told(true, PlaceObjectResult::GRASP_FAILED, "nothing was there");
    assert_eq!(summary(plan(12), failed), (Placing::Over, Some(false), Some("nothing was there".into())));
    // Taught, and yet there is no way: that is no success. Without a robot nobody was to put it anywhere.
    let refused = |outcome: u8| PlacementPlan { outcome, reason: "no way".into(), ..plan(12) };
    let no_way = (Placing::NotPlanned, Some(false), Some("no way".into()));
    assert_eq!(summary(refused(PlacementPlan::CANNOT_PICK), None), no_way);
    assert_eq!(summary(refused(PlacementPlan::NO_ROBOT), None), (Placing::NotPlanned, None, None));
}

#[test]
fn percentiles_are_nearest_ranks() {
    let hundred: Vec<f64> = (1..=100).map(f64::from).collect();
    assert_eq!(Percentiles::of(&hundred), Percentiles { p50: Some(50.0), p99: Some(99.0), n: 100 });
    assert_eq!(Percentiles::of(&[3.0]), Percentiles { p50: Some(3.0), p99: Some(3.0), n: 1 });
    assert_eq!(Percentiles::of(&[]), Percentiles { p50: None, p99: None, n: 0 });
}
