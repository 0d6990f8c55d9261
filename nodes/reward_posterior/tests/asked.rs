//! What may answer a question about a world, and when.

mod support;

use apprentice_msgs::msg::ActionDemonstration;
use apprentice_msgs::msg::{QueryResponse, SegmentCritique, TrajectoryPreference, WorldQuery, WorldTrajectory};
use reward_posterior::Event;
use support::{Bench, RIGHT, acted, back, critique, ranked, settings, trajectory};

fn way(id: &str, steps: &[(u32, u32)], features: [f64; 3]) -> WorldTrajectory {
    WorldTrajectory {
        id: id.into(),
        states: steps.iter().map(|step| step.0).collect(),
        actions: steps.iter().map(|step| step.1).collect(),
        features: features.to_vec(),
    }
}

fn ask(revision: u64, kind: u8, trajectories: Vec<WorldTrajectory>) -> Event {
    let id = format!("w{revision}");
    Event::WorldQuery(Box::new(WorldQuery { id, revision, kind, state: 1, trajectories, ..WorldQuery::default() }))
}

fn shows(id: &str, query_id: &str, state: u32) -> Event {
    Event::Actions(Box::new(ActionDemonstration { query_id: query_id.into(), ..acted(id, &[(state, RIGHT)]) }))
}

fn marks(id: &str, query_id: &str, steps: &[(u32, u32)]) -> Event {
    Event::Critique(Box::new(SegmentCritique { query_id: query_id.into(), ..critique(id, steps, &[(0, 1, 0)]) }))
}

fn prefers(id: &str, query_id: &str, names: [&str; 2]) -> Event {
    let of = [trajectory(names[0], &[1.0, 0.0, 0.0]), trajectory(names[1], &[0.0, 1.0, 0.0])];
    Event::Preference(Box::new(TrajectoryPreference { query_id: query_id.into(), ..ranked(id, &of) }))
}

#[test]
fn a_question_is_answered_once_and_only_by_what_it_asks_for() {
    let mut bench = Bench::in_row(settings(), 3);
    bench.step(ask(0, WorldQuery::ACTION, vec![]));
    let other = "it does not answer what question 'w0' asks";
    assert_eq!(bench.refused(shows("a", "w0", 0)), other, "another state");
    assert_eq!(bench.refused(marks("c", "w0", &[(1, RIGHT)])), other);
    assert_eq!(bench.refused(prefers("p", "w0", ["s", "t"])), other);
    assert_eq!(bench.take(shows("a", "w0", 1)), 1);
    assert!(bench.refused(shows("b", "w0", 1)).contains("'w0' is no longer open; no question is open"));

    let steps = [(0, RIGHT), (1, RIGHT)];
    bench.step(ask(1, WorldQuery::CRITIQUE, vec![way("s", &steps, [1.0, 0.0, 0.0])]));
    assert_eq!(bench.refused(marks("c", "w1", &steps[..1])), "it does not answer what question 'w1' asks");
    assert!(bench.refused(shows("b", "w0", 1)).contains("no longer open; the open question is 'w1'"));
    assert_eq!(bench.take(marks("c", "w1", &steps)), 2);

    let pair = vec![way("s", &steps, [1.0, 0.0, 0.0]), way("t", &steps, [0.0, 1.0, 0.0])];
    bench.step(ask(2, WorldQuery::COMPARISON, pair));
    assert_eq!(bench.refused(prefers("p", "w2", ["s", "u"])), "it does not answer what question 'w2' asks");
    assert_eq!(bench.refused(prefers("p", "w2", ["t", "s"])), "it does not answer what question 'w2' asks");
    assert_eq!(bench.take(prefers("p", "w2", ["s", "t"])), 3);
    assert_eq!(bench.posterior().n_answers, 3);
}

#[test]
fn skipping_needs_an_open_question_and_what_is_volunteered_needs_none() {
    let mut bench = Bench::in_row(settings(), 3);
    let skip = |id: &str, query_id: &str| {
        let response = QueryResponse { id: id.into(), query_id: query_id.into(), ..QueryResponse::default() };
        Event::Response(Box::new(response))
    };
    bench.step(ask(0, WorldQuery::ACTION, vec![]));
    assert_eq!(bench.take(skip("s", "w0")), 1);
    assert!(bench.refused(skip("r", "w0")).contains("no longer open"));
    // A question of an earlier revision is not open, nor is one that nobody asked.
    bench.step(ask(0, WorldQuery::ACTION, vec![]));
    assert!(bench.refused(shows("a", "w0", 1)).contains("no longer open"));
    assert_eq!(bench.take(shows("a", "", 1)), 2);
    assert_eq!(bench.take(shows("b", "somebody else's", 1)), 3);
    assert_eq!(bench.take(Event::Retraction(Box::new(back("u", "a")))), 4);
    assert_eq!(bench.posterior().n_answers, 2, "a skip, and an answer to somebody else");
}

#[test]
fn who_answered_what_question_changes_no_draw() {
    let draws = |query_id: &str| {
        let mut bench = Bench::in_row(settings(), 3);
        bench.step(ask(0, WorldQuery::ACTION, vec![]));
        bench.take(shows("a", query_id, 1));
        bench.posterior()
    };
    let (asked, volunteered) = (draws("w0"), draws(""));
    assert_eq!((asked.evidence_hash, asked.draws), (volunteered.evidence_hash, volunteered.draws));
}
