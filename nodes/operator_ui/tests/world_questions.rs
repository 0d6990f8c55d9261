//! What becomes of questions about a world, and of what pages answer to them.

mod world;

use apprentice_msgs::msg::{
    ActionDemonstration, CritiqueSegment, EvidenceReceipt, LessonStatus, QueryResponse, TrajectoryPreference,
    WorldQuery,
};
use operator_ui::Event;
use serde_json::{Value, json};
use world::garden::{ask, asking, way_query};
use world::id;
use world::table::Table;

fn is_open(table: &Table) -> bool {
    table.shown["world_question"]["open"] == true
}

fn act(n: u32, query_id: &str) -> Value {
    json!({"type": "act", "id": id(n), "query_id": query_id, "action": 1, "confidence": "guess"})
}

#[test]
fn a_question_is_shown_with_its_ways_until_it_is_answered_or_the_lesson_moves_on() {
    let mut table = asking(WorldQuery::COMPARISON);
    let shown = table.shown["world_question"].clone();
    assert_eq!((&shown["kind"], &shown["id"], &shown["open"]), (&json!("comparison"), &json!("w0"), &json!(true)));
    assert_eq!(shown["ways"][0], json!({"id": "w0-a", "states": [0, 1, 2], "actions": [1, 1, 0]}));
    table.shown = json!({});
    table.hear(Event::WorldQuery(Box::new(way_query(0, WorldQuery::COMPARISON))));
    assert_eq!(table.shown, json!({}), "a repetition is no news");
    table.hear(Event::Lesson(Box::new(LessonStatus { revision: 1, ..LessonStatus::default() })));
    assert!(!is_open(&table));
    assert!(table.say(&act(1, "w0")).actions.is_empty());
    assert!(table.refused[0].1.contains("'w0' is no longer open"), "{:?}", table.refused);
    // What cannot be shown is told, and what is about another world waits for it.
    let broken = WorldQuery { state: 9, ..way_query(1, WorldQuery::ACTION) };
    table.hear(Event::WorldQuery(Box::new(broken)));
    assert!(table.notices[0].contains("question 'w1' cannot be shown: its state 9 is out of range"));
    let elsewhere = WorldQuery { world: Default::default(), ..way_query(1, WorldQuery::ACTION) };
    table.hear(Event::WorldQuery(Box::new(elsewhere)));
    assert_eq!((&table.shown["world_question"]["id"], table.notices.len()), (&json!("w0"), 1));
}

#[test]
fn an_action_goes_out_each_second_until_its_receipt_and_closes_the_question() {
    let mut table = asking(WorldQuery::ACTION);
    let sent = table.say(&act(1, "w0")).actions.remove(0);
    assert_eq!((sent.states.as_slice(), sent.actions.as_slice()), ([0].as_slice(), [1].as_slice()));
    assert_eq!((sent.query_id.as_str(), sent.world_id.as_str(), sent.source.as_str()), ("w0", "garden", "operator"));
    assert_eq!(sent.confidence, ActionDemonstration::CONFIDENCE_GUESS);
    assert!(!is_open(&table));
    assert!(table.say(&act(1, "w0")).actions.is_empty(), "the same command again changes nothing");
    assert_eq!(table.wait(1.0).actions, vec![sent]);
    assert_eq!(table.answer(&id(1))["step"], json!([0, 1]));
    table.receive(&id(1), EvidenceReceipt::ACCEPTED, 1);
    assert!(table.wait(5.0).actions.is_empty());
    assert!(table.say(&act(2, "w0")).actions.is_empty(), "a question is answered once");
}

#[test]
fn marks_and_choices_become_what_the_posterior_takes() {
    let mut table = asking(WorldQuery::CRITIQUE);
    let mark = |n: u32, segments: Value| json!({"type": "mark", "id": id(n), "query_id": "w0", "segments": segments, "confidence": "sure"});
    let part = |start: u32, end: u32, good: bool| json!({"start": start, "end": end, "good": good});
    for (n, (bad, told)) in (10..).zip([
        (json!([]), "0 parts are marked"),
        (json!([part(0, 4, true)]), "steps 0 to 4 are not of a way of 3 steps"),
        (json!([part(2, 1, true)]), "steps 2 to 1 are not of a way"),
        (json!([part(1, 1, true)]), "steps 1 to 1 are not of a way"),
        (json!([part(0, 2, true), part(1, 3, false)]), "marked twice"),
        (json!([part(0, 1, true), part(1, 2, true), part(2, 3, true), part(0, 1, true)]), "4 parts are marked"),
    ]) {
        assert!(table.say(&mark(n, bad)).critiques.is_empty());
        assert!(table.refused.pop().is_some_and(|(_, reason)| reason.contains(told)), "{told}");
    }
    assert!(table.say(&act(2, "w0")).actions.is_empty(), "it does not ask what to do");
    let sent = table.say(&mark(1, json!([part(0, 1, true), part(1, 3, false)]))).critiques.remove(0);
    let parts: Vec<_> = sent.segments.iter().map(|part| (part.start, part.end, part.verdict)).collect();
    assert_eq!(parts, [(0, 1, CritiqueSegment::GOOD), (1, 3, CritiqueSegment::BAD)]);
    assert_eq!((sent.states, table.answer(&id(1))["marked"].clone()), (vec![0, 1, 2], json!([1, 2])));
    for (n, (word, best, answer)) in (30..).zip([
        ("first", "w0-a", TrajectoryPreference::RANKED),
        ("second", "w0-b", TrajectoryPreference::RANKED),
        ("equal", "w0-b", TrajectoryPreference::EQUAL),
        ("cant_tell", "w0-b", TrajectoryPreference::CANT_TELL),
    ]) {
        let mut table = asking(WorldQuery::COMPARISON);
        let said = table
            .say(&json!({"type": "compare", "id": id(n), "query_id": "w0", "better": word, "confidence": "fairly"}));
        let sent = &said.comparisons[0];
        assert_eq!((sent.trajectories[1].id.as_str(), sent.answer), (best, answer));
        exchange::check_preference(sent, 2).expect("the posterior takes it");
    }
}

#[test]
fn what_was_taken_back_is_given_again_to_the_question_when_it_is_the_same() {
    let mut table = asking(WorldQuery::COMPARISON);
    let say = json!({"type": "compare", "id": id(1), "query_id": "w0", "better": "first", "confidence": "fairly"});
    let first = table.say(&say).comparisons.remove(0);
    table.receive(&id(1), EvidenceReceipt::ACCEPTED, 1);
    table.say(&json!({"type": "retract", "id": id(2), "evidence_id": id(1)}));
    let again = |n: u32| json!({"type": "again", "id": id(n), "evidence_id": id(1)});
    assert!(table.say(&again(3)).comparisons.is_empty() && table.refused.pop().is_some(), "not yet taken back");
    table.receive(&id(2), EvidenceReceipt::ACCEPTED, 2);
    ask(&mut table, 2, WorldQuery::COMPARISON);
    let second = table.say(&again(4)).comparisons.remove(0);
    assert_eq!((second.query_id.as_str(), second.id.as_str(), second.answer), ("w2", &*id(4), first.answer));
    let ids: Vec<&str> = second.trajectories.iter().map(|one| one.id.as_str()).collect();
    assert_eq!(ids, ["w2-b", "w2-a"], "the same ways under the names of the question that is open");
    // Where something else is asked it is volunteered, under its old names.
    table.receive(&id(4), EvidenceReceipt::ACCEPTED, 3);
    ask(&mut table, 3, WorldQuery::ACTION);
    let third = table.say(&again(5)).comparisons.remove(0);
    assert_eq!((third.query_id.as_str(), &third.trajectories), ("", &first.trajectories));
    assert!(is_open(&table));
    let skip = json!({"type": "respond", "id": id(6), "query_id": "w3", "kind": "skip"});
    assert_eq!(table.say(&skip).responses[0].kind, QueryResponse::SKIP);
    assert!(!is_open(&table));
}
