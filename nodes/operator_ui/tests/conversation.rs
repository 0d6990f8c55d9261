//! What the node promises to pages and to the posterior, shown on the state machine alone.

mod world;

use apprentice_msgs::msg::{EvidenceReceipt, Heartbeat, PlacementDemonstration, QueryResponse};
use operator_ui::Event;
use proptest::prelude::{Just, Strategy, any, prop_oneof, proptest};
use serde_json::{Value, json};
use world::table::{Sent, Table};
use world::{bounds, id, lesson, log, plan, posterior, query, record, retraction_record, scene};

fn place(n: u32, query_id: &str) -> Value {
    json!({"type": "place", "id": id(n), "query_id": query_id, "x_m": 0.5, "y_m": 0.45, "confidence": "fairly"})
}

#[test]
fn a_placement_goes_out_each_second_until_its_receipt_and_never_changes() {
    let mut table = Table::asking(3);
    let first = table.say(&place(1, "q3-7")).demonstrations.remove(0);
    assert_eq!((first.id.as_str(), first.query_id.as_str(), first.source.as_str()), (&*id(1), "q3-7", "operator"));
    assert_eq!((first.placement.x, first.placement.y), (0.5, 0.45));
    assert_eq!(first.confidence, PlacementDemonstration::CONFIDENCE_FAIRLY);
    assert_eq!(first.scene, query(3).scene);
    assert!(table.wait(0.5).demonstrations.is_empty());
    assert_eq!(table.wait(0.5).demonstrations, vec![first.clone()]);
    assert_eq!(table.wait(1.0).demonstrations, vec![first]);
    assert_eq!(table.answer(&id(1))["state"], "pending");
    table.receive(&id(1), EvidenceReceipt::ACCEPTED, 4);
    assert!(table.wait(5.0).demonstrations.is_empty());
    assert_eq!(table.answer(&id(1))["state"], "accepted");
    assert_eq!(table.answer(&id(1))["revision"], 4);
}

#[test]
fn the_evidence_log_acknowledges_even_when_the_receipt_was_lost() {
    let mut table = Table::asking(3);
    let sent = table.say(&place(1, "q3-7")).demonstrations.remove(0);
    table.hear(Event::Evidence(Box::new(log(vec![record(1, &sent)]))));
    assert!(table.wait(5.0).demonstrations.is_empty());
    assert_eq!(table.answer(&id(1))["state"], "accepted");
    assert_eq!(table.answer(&id(1))["mine"], true);
}

#[test]
fn sending_a_command_again_doubles_nothing() {
    let mut table = Table::asking(3);
    assert_eq!(table.say(&place(1, "q3-7")).demonstrations.len(), 1);
    assert!(table.say(&place(1, "q3-7")).demonstrations.is_empty());
    table.receive(&id(1), EvidenceReceipt::ACCEPTED, 4);
    table.revise(4);
    // The page lost its connection and sends what it has not seen acknowledged, though the question is closed by now.
    assert!(table.say(&place(1, "q3-7")).demonstrations.is_empty());
    assert!(table.refused.is_empty());
    assert_eq!(table.shown["answers"].as_array().map(Vec::len), Some(1));
}

#[test]
fn a_question_is_open_until_it_is_answered_by_anyone() {
    let mut table = Table::asking(3);
    assert!(table.is_open());
    let theirs = PlacementDemonstration {
        id: "person-1".into(),
        query_id: "q3-7".into(),
        source: "demonstrator".into(),
        scene: query(3).scene,
        ..PlacementDemonstration::default()
    };
    table.hear(Event::Evidence(Box::new(log(vec![record(1, &theirs)]))));
    assert!(!table.is_open());
    assert_eq!(table.answer("person-1")["mine"], false);
    table.say(&place(1, "q3-7"));
    let (refused_id, reason) = table.refused.remove(0);
    assert_eq!(refused_id, id(1));
    assert!(reason.contains("'q3-7' is no longer open"), "{reason}");
    table.revise(4);
    assert!(table.is_open());
    table.say(&place(2, "q3-7"));
    assert!(table.refused[0].1.contains("the open question is 'q4-7'"), "{}", table.refused[0].1);
}

#[test]
fn an_answer_waits_for_its_question_when_the_node_was_started_anew() {
    // The page has sent it again before the node hears of the question.
    let mut table = Table::new();
    assert!(table.say(&place(1, "q3-7")).demonstrations.is_empty());
    assert!(table.wait(1.0).demonstrations.is_empty() && table.refused.is_empty());
    let question = query(3);
    let sent = table.hear(Event::Query(Box::new(question)));
    assert_eq!(sent.demonstrations.len(), 1, "{:?}", table.refused);
    assert_eq!(table.answer(&id(1))["state"], "pending");
    // It does not wait for ever, and not when the lesson is known to ask something else.
    let mut table = Table::new();
    table.say(&place(1, "q3-7"));
    assert!(table.wait(4.0).demonstrations.is_empty() && table.refused.is_empty());
    table.wait(2.0);
    assert!(table.refused[0].1.contains("'q3-7' is no longer open"), "{:?}", table.refused);
    let mut table = Table::asking(4);
    table.say(&place(1, "q3-7"));
    assert_eq!(table.refused.len(), 1);
}

#[test]
fn a_refusal_is_shown_with_its_reason_and_opens_the_question_again() {
    let mut table = Table::asking(3);
    table.say(&place(1, "q3-7"));
    assert!(!table.is_open());
    table.receive(&id(1), EvidenceReceipt::REFUSED, 0);
    assert_eq!(table.answer(&id(1))["state"], "refused");
    assert_eq!(table.answer(&id(1))["reason"], "it would stand on 'plate'");
    assert!(table.is_open());
    assert!(table.wait(5.0).demonstrations.is_empty());
}

#[test]
fn undo_is_a_retraction_and_the_placement_can_be_given_again_under_a_new_id() {
    let mut table = Table::asking(3);
    let demonstration = table.say(&place(1, "q3-7")).demonstrations.remove(0);
    table.receive(&id(1), EvidenceReceipt::ACCEPTED, 4);
    let undo = json!({"type": "retract", "id": id(2), "evidence_id": id(1)});
    let retraction = table.say(&undo).retractions.remove(0);
    assert_eq!((retraction.id.as_str(), retraction.evidence_id.as_str()), (&*id(2), &*id(1)));
    assert_eq!(table.wait(1.0).retractions, vec![retraction.clone()]);
    table.receive(&id(2), EvidenceReceipt::ACCEPTED, 5);
    assert_eq!(table.answer(&id(1))["state"], "undone");
    assert_eq!(table.answer(&id(1))["undo"]["revision"], 5);
    assert!(table.wait(5.0).retractions.is_empty());
    let again = table.say(&json!({"type": "again", "id": id(3), "evidence_id": id(1)})).demonstrations.remove(0);
    assert_eq!((again.id.as_str(), again.query_id.as_str()), (&*id(3), ""));
    assert_eq!((&again.scene, &again.placement, again.confidence), (&demonstration.scene, &demonstration.placement, 1));
    // The log tells the same story to a node that starts now.
    let mut late = Table::new();
    late.hear(Event::Evidence(Box::new(log(vec![
        record(4, &demonstration),
        retraction_record(5, &retraction),
        record(6, &again),
    ]))));
    let states: Vec<_> = [1, 3].map(|n| late.answer(&id(n))["state"].clone()).into();
    assert_eq!(states, ["undone", "accepted"]);
}

#[test]
fn a_retraction_waits_for_the_answer_it_takes_back() {
    let mut table = Table::asking(3);
    table.say(&place(1, "q3-7"));
    let undo = json!({"type": "retract", "id": id(2), "evidence_id": id(1)});
    assert!(table.say(&undo).retractions.is_empty());
    assert_eq!(table.answer(&id(1))["undo"]["state"], "held");
    assert!(table.wait(3.0).retractions.is_empty());
    assert_eq!(table.receive(&id(1), EvidenceReceipt::ACCEPTED, 4).retractions.len(), 1);

    let mut table = Table::asking(3);
    table.say(&place(1, "q3-7"));
    table.say(&undo);
    assert!(table.receive(&id(1), EvidenceReceipt::REFUSED, 0).retractions.is_empty());
    assert_eq!(table.answer(&id(1))["undo"]["state"], "refused");
    assert!(table.wait(3.0).retractions.is_empty());
}

#[test]
fn skip_and_cannot_tell_need_an_open_question_but_stopping_always_works() {
    let respond = |n, kind: &str, query: &str| json!({"type": "respond", "id": id(n), "query_id": query, "kind": kind});
    let mut table = Table::asking(3);
    assert_eq!(table.say(&respond(1, "skip", "q3-7")).responses[0].kind, QueryResponse::SKIP);
    table.say(&respond(2, "cant_tell", "q3-7"));
    assert_eq!(table.refused.len(), 1);
    assert_eq!(table.say(&respond(3, "stop", "")).responses[0].kind, QueryResponse::STOP);
    table.say(&respond(4, "placement", "q3-7"));
    assert_eq!(table.refused.len(), 2);
}

#[test]
fn what_is_not_a_command_is_refused_with_a_reason() {
    let mut table = Table::asking(3);
    for (text, reason) in [
        ("", "the page sent no command"),
        ("[1, 2]", "the page sent no command"),
        (r#"{"type": "erase"}"#, "unknown variant"),
        (&place(1, "q3-7").to_string().replace("0.45", "null"), "the page sent no command"),
        (&place(1, "q3-7").to_string().replace("0.45", "1.01"), "off the table"),
        (&place(1, "q3-7").to_string().replace("}", ", \"more\": 1}"), "unknown field"),
        (&json!({"type": "retract", "id": "7", "evidence_id": "8"}).to_string(), "UUID"),
        (&json!({"type": "retract", "id": id(1), "evidence_id": "8"}).to_string(), "not known"),
        (&json!({"type": "again", "id": id(1), "evidence_id": "8"}).to_string(), "not known"),
    ] {
        let sent = table.hear(Event::Said(0, text.to_owned()));
        assert!(sent.demonstrations.is_empty() && sent.retractions.is_empty());
        let (_, got) = table.refused.pop().expect("it is refused");
        assert!(got.contains(reason), "{text}: {got}");
    }
}

#[test]
fn what_is_not_a_number_is_null_and_everything_else_keeps_all_its_digits() {
    let mut table = Table::asking(0);
    let mut guess = plan(&query(0).scene, "q0-7", 0);
    guess.reward_map[5] = f32::NAN;
    guess.map_cvar_m = f64::INFINITY;
    guess.robust_placement.x = f64::NAN;
    table.hear(Event::Guess(Box::new(guess)));
    for (value, name) in [
        (&table.shown["bounds"]["bound_m"], "bound"),
        (&table.shown["question"]["bound_m"], "question's bound"),
        (&table.shown["trend"][0]["bound_m"], "trend"),
        (&table.shown["guess"]["reward_map"][5], "cell"),
        (&table.shown["guess"]["map_cvar_m"], "CVaR"),
        (&table.shown["guess"]["robust_placement"], "robust place"),
    ] {
        assert!(value.is_null(), "{name}: {value}");
    }
    assert_eq!(table.shown["bounds"]["outcome"], "not_enough_samples");
    table.revise(7);
    let bits = |value: &Value| value.as_f64().expect("it is a number").to_bits();
    assert_eq!(bits(&table.shown["bounds"]["bound_m"]), world::bound(7).to_bits());
    assert_eq!(bits(&table.shown["trend"][1]["bound_m"]), world::bound(7).to_bits());
    assert_eq!(table.shown["bounds"]["seed"], u64::MAX.to_string());
    assert_eq!(table.shown["posterior"]["revision"], 7);
}

#[test]
fn a_page_that_joins_late_sees_what_the_others_see() {
    let mut table = Table::asking(3);
    table.say(&place(1, "q3-7"));
    table.receive(&id(1), EvidenceReceipt::ACCEPTED, 4);
    table.revise(4);
    let seen = std::mem::replace(&mut table.shown, json!({}));
    table.hear(Event::Joined(9));
    for (name, section) in seen.as_object().expect("sections are an object") {
        assert_eq!(&table.shown[name], section, "{name}");
    }
}

#[test]
fn what_has_not_changed_is_not_sent_again() {
    let mut table = Table::asking(1);
    table.shown = json!({});
    let sent = table.hear(Event::Lesson(Box::new(lesson(1))));
    table.hear(Event::Query(Box::new(query(1))));
    table.hear(Event::Posterior(Box::new(posterior(1))));
    table.hear(Event::Scene(Box::new(scene("task", 0.0))));
    assert_eq!(table.shown, json!({}));
    assert_eq!(sent.markers, 0);
}

#[test]
fn an_unusable_table_is_reported_once_and_the_last_good_one_stays() {
    let mut table = Table::asking(3);
    let before = table.shown["question"].clone();
    let mut bad = query(5);
    bad.scene.objects[0].pose.position.x = f64::NAN;
    for _ in 0..3 {
        table.hear(Event::Query(Box::new(bad.clone())));
    }
    assert_eq!(table.notices.len(), 1, "{:?}", table.notices);
    assert!(table.notices[0].contains("'q5-7'") && table.notices[0].contains("plate"), "{}", table.notices[0]);
    assert_eq!(table.shown["question"], before);
    let mut guess = plan(&query(3).scene, "q3-7", 3);
    guess.map_side = u32::MAX;
    table.hear(Event::Guess(Box::new(guess)));
    assert_eq!(table.shown["guess"]["reward_map"], json!([]));
}

#[test]
fn the_bounds_history_has_one_point_a_revision_and_begins_anew_with_a_session() {
    let mut table = Table::new();
    for revision in [0, 1, 2, 2, 3] {
        table.hear(Event::Bounds(Box::new(bounds(revision))));
    }
    let revisions = |table: &Table| -> Vec<u64> {
        let points = table.shown["trend"].as_array().expect("the history is shown");
        points.iter().map(|point| point["revision"].as_u64().expect("it has a revision")).collect()
    };
    assert_eq!(revisions(&table), [0, 1, 2, 3]);
    table.hear(Event::Bounds(Box::new(bounds(0))));
    assert_eq!(revisions(&table), [0]);
}

#[test]
fn another_session_replaces_the_answers_but_not_those_on_their_way() {
    let mut table = Table::asking(3);
    let old = table.say(&place(1, "q3-7")).demonstrations.remove(0);
    table.hear(Event::Evidence(Box::new(log(vec![record(1, &old)]))));
    table.revise(4);
    table.say(&place(2, "q4-7"));
    let other = PlacementDemonstration { id: "other".into(), ..old };
    table.hear(Event::Evidence(Box::new(log(vec![record(1, &other)]))));
    let ids: Vec<_> = table.shown["answers"].as_array().expect("answers").iter().map(|a| a["id"].clone()).collect();
    assert_eq!(ids, [json!("other"), json!(id(2))]);
}

#[test]
fn silent_nodes_are_shown_without_any_message() {
    let mut table = Table::new();
    let beat = Heartbeat { node: "/apprentice/active_query".into(), ..Heartbeat::default() };
    table.hear(Event::Heartbeat(Box::new(beat)));
    assert_eq!(table.shown["nodes"], json!([{"name": "active_query", "state": "alive", "restarts": 0}]));
    table.wait(5.5);
    assert_eq!(table.shown["nodes"][0]["state"], "gone");
}

proptest! {
    /// Whatever pages say and receipts answer, in any order: nothing panics, each id is published with one content
    /// only, and once everything has a receipt nothing is published any more.
    #[test]
    fn any_conversation_ends_in_silence(moves in proptest::collection::vec(a_move(), 1..40)) {
        let mut table = Table::asking(3);
        let mut contents = std::collections::HashMap::<String, String>::new();
        let mut check = |sent: Sent| {
            let demonstrations = sent.demonstrations.iter().map(|m| (m.id.clone(), format!("{m:?}")));
            let retractions = sent.retractions.iter().map(|m| (m.id.clone(), format!("{m:?}")));
            let responses = sent.responses.iter().map(|m| (m.id.clone(), format!("{m:?}")));
            for (id, content) in demonstrations.chain(retractions).chain(responses) {
                assert_eq!(contents.entry(id).or_insert(content.clone()), &content);
            }
            contents.keys().cloned().collect::<Vec<_>>()
        };
        for (what, a, b) in moves {
            let sent = match what {
                0 => table.say(&place(a, "q3-7")),
                1 => table.say(&json!({"type": "retract", "id": id(a), "evidence_id": id(b)})),
                2 => table.say(&json!({"type": "again", "id": id(a), "evidence_id": id(b)})),
                3 => table.say(&json!({"type": "respond", "id": id(a), "query_id": "q3-7", "kind": "skip"})),
                4 => table.receive(&id(a), (b % 3) as u8, u64::from(b)),
                _ => table.wait(1.0),
            };
            check(sent);
        }
        for _ in 0..4 {
            let sent = table.wait(1.0);
            for id in check(sent) {
                table.receive(&id, EvidenceReceipt::ACCEPTED, 50);
            }
        }
        let sent = table.wait(1.0);
        assert!(sent.demonstrations.is_empty() && sent.retractions.is_empty() && sent.responses.is_empty());
    }

    /// No text from a page, however odd, makes the node fall over.
    #[test]
    fn any_text_is_survived(text in any::<String>(), kind in "place|respond|retract|again") {
        let mut table = Table::asking(3);
        table.hear(Event::Said(0, text.clone()));
        table.say(&json!({"type": kind, "id": text, "query_id": text, "evidence_id": text, "x_m": 1e308, "y_m": -0.0}));
    }
}

fn a_move() -> impl Strategy<Value = (u8, u32, u32)> {
    (prop_oneof![Just(0_u8), Just(1), Just(2), Just(3), Just(4), Just(5)], 0_u32..6, 0_u32..6)
}
