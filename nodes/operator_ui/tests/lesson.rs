//! The lesson as a whole, from a page: pausing, beginning anew, and taking up what was recorded.

mod world;

use apprentice_msgs::msg::{EvidenceReceipt, EvidenceRecord, LearnerHistory, LessonStatus, QueryResponse};
use operator_ui::{Event, Recorded, protocol::RecordingView};
use serde_json::{Value, json};
use world::table::Table;
use world::{id, lesson, log, record, retraction_record};

fn respond(n: u32, kind: &str) -> Value {
    json!({"type": "respond", "id": id(n), "query_id": "", "kind": kind})
}

fn place(n: u32, query_id: &str) -> Value {
    json!({"type": "place", "id": id(n), "query_id": query_id, "x_m": 0.5, "y_m": 0.5, "confidence": "fairly"})
}

fn said(sequence: u64, response: &QueryResponse) -> EvidenceRecord {
    let kind = EvidenceRecord::RESPONSE;
    EvidenceRecord { sequence, kind, response: vec![response.clone()], ..EvidenceRecord::default() }
}

#[test]
fn a_word_about_the_lesson_needs_no_question_and_is_repeated_until_it_is_heard() {
    let mut table = Table::asking(3);
    for (n, kind, number) in [
        (1, "pause", QueryResponse::PAUSE),
        (2, "start", QueryResponse::START),
        (3, "finish", QueryResponse::FINISH),
        (4, "new_lesson", QueryResponse::NEW_LESSON),
    ] {
        let sent = table.say(&respond(n, kind)).responses;
        assert_eq!((sent[0].kind, sent[0].query_id.as_str()), (number, ""));
        assert_eq!(table.answer(&id(n))["kind"], kind);
    }
    assert_eq!(table.wait(1.0).responses.len(), 4);
    let paused = LessonStatus { state: LessonStatus::PAUSED, query_id: String::new(), ..lesson(4) };
    table.hear(Event::Lesson(Box::new(paused)));
    assert_eq!(table.shown["lesson"]["state"], "paused");
    assert!(!table.is_open(), "nothing is asked in a pause");
}

#[test]
fn answers_of_an_earlier_lesson_are_shown_as_past_and_come_back_with_it() {
    let mut table = Table::asking(3);
    let first = table.say(&place(1, "q3-7")).demonstrations.remove(0);
    let anew = table.say(&respond(2, "new_lesson")).responses.remove(0);
    let mut records = vec![record(1, &first), said(2, &anew)];
    table.hear(Event::Evidence(Box::new(log(records.clone()))));
    assert_eq!(table.answer(&id(1))["state"], "past");
    assert_eq!(table.answer(&id(2))["state"], "accepted");
    table.say(&json!({"type": "retract", "id": id(3), "evidence_id": id(1)}));
    assert!(table.refused[0].1.contains("earlier lesson"), "{:?}", table.refused);
    let back = table.say(&json!({"type": "retract", "id": id(4), "evidence_id": id(2)})).retractions.remove(0);
    records.push(retraction_record(3, &back));
    table.hear(Event::Evidence(Box::new(log(records))));
    assert_eq!(table.answer(&id(1))["state"], "accepted");
}

#[test]
fn a_recording_is_taken_up_as_a_new_lesson_with_what_counted_in_it() {
    let mut table = Table::asking(3);
    let load = json!({"type": "load", "id": id(9), "name": "session-1"});
    assert!(table.say(&load).reads.is_empty(), "nobody has seen such a recording");
    assert!(table.refused[0].1.contains("no such recording"));
    assert_eq!(table.say(&json!({"type": "recordings", "id": id(8)})).lookups, 1);
    let found = RecordingView { name: "session-1".into(), began_s: Some(1e9), duration_s: 60.0, bytes: 1000 };
    table.hear(Event::Recordings(vec![found]));
    assert_eq!(table.shown["recordings"][0]["name"], "session-1");
    assert_eq!(table.say(&load).reads, [(id(9), "session-1".to_owned())]);

    // What was said there: two placements, of which one was taken back, a skip, and a learner's attempts.
    let mut other = Table::asking(3);
    let kept = other.say(&place(1, "q3-7")).demonstrations.remove(0);
    let undone = other.say(&place(2, "")).demonstrations.remove(0);
    let back = other.receive(&id(2), EvidenceReceipt::ACCEPTED, 2);
    assert!(back.retractions.is_empty());
    let back = other.say(&json!({"type": "retract", "id": id(3), "evidence_id": id(2)})).retractions.remove(0);
    let skip = QueryResponse { id: "skip".into(), ..QueryResponse::default() };
    let history = LearnerHistory { id: "h".into(), source: "learner".into(), ..LearnerHistory::default() };
    let history_record = EvidenceRecord {
        sequence: 5,
        kind: EvidenceRecord::HISTORY,
        history: vec![history],
        ..EvidenceRecord::default()
    };
    let records =
        vec![record(1, &kept), record(2, &undone), retraction_record(3, &back), said(4, &skip), history_record];
    let recorded = Recorded { id: id(9), name: "session-1".into(), log: Ok(log(records)) };
    let sent = table.hear(Event::Recorded(Box::new(recorded.clone())));
    assert_eq!(sent.responses[0].kind, QueryResponse::NEW_LESSON);
    assert!(sent.demonstrations.is_empty(), "they wait for the new lesson");
    assert_eq!(table.answer(&format!("{}-1", id(9)))["state"], "pending");
    let listed = table.shown["answers"].clone();
    let sent = table.hear(Event::Recorded(Box::new(recorded.clone())));
    assert!(sent.responses.is_empty(), "it was read twice, as the command was repeated meanwhile");
    assert_eq!(table.shown["answers"], listed);
    let sent = table.receive(&id(9), EvidenceReceipt::ACCEPTED, 4);
    let [again] = sent.demonstrations.as_slice() else { panic!("one placement counted") };
    assert_eq!((again.placement, again.confidence, &again.source), (kept.placement, kept.confidence, &kept.source));
    assert_eq!((again.id.clone(), again.query_id.as_str()), (format!("{}-1", id(9)), ""));
    assert_eq!((sent.histories[0].id.clone(), sent.histories[0].source.as_str()), (format!("{}-2", id(9)), "learner"));
    // The page repeats its command after a lost connection; that changes nothing.
    assert!(table.say(&load).reads.is_empty());

    // A new lesson that is refused takes with it what waited for it, and an unreadable recording says why.
    let mut table = Table::asking(3);
    table.hear(Event::Recorded(Box::new(recorded.clone())));
    assert!(table.receive(&id(9), EvidenceReceipt::REFUSED, 0).demonstrations.is_empty());
    assert_eq!(table.answer(&format!("{}-1", id(9)))["state"], "refused");
    let mut table = Table::asking(3);
    table.hear(Event::Recorded(Box::new(Recorded { log: Err("it is damaged".into()), ..recorded.clone() })));
    table.hear(Event::Recorded(Box::new(Recorded { log: Ok(log(vec![said(1, &skip)])), ..recorded })));
    assert!(table.refused[0].1.contains("it is damaged") && table.refused[1].1.contains("nothing in it counts"));
}
