//! Taking an answer back gives, bit for bit, the posterior that would have been without it.

use crate::evidence::{retraction, table, volunteered};
use crate::graph::Lesson;
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{EvidenceReceipt, PlacementDemonstration, PlacementQuery, Posterior, QueryResponse};
use apprentice_msgs::std_msgs::Header;
use apprentice_msgs::to_cdr;
use proptest::prelude::{Just, Strategy, any, prop_oneof, proptest};
use proptest::test_runner::{Config, RngSeed};
use reward_posterior::{Event, Output, RewardPosterior, Settings};

/// The bytes of everything in a posterior that speaks of the evidence in force, and not of how it came about.
fn bits(posterior: &Posterior) -> Vec<u8> {
    to_cdr(&Posterior { header: Header::default(), revision: 0, n_answers: 0, ..posterior.clone() })
}

#[test]
fn an_answer_taken_back_over_the_graph_leaves_the_posterior_that_would_have_been() {
    let answer = |lesson: &mut Lesson| {
        lesson.scene.publish(&table()).expect("memory takes everything");
        let query = lesson.query(0);
        let shown = volunteered("a", 0.5, 0.45);
        lesson.show(&PlacementDemonstration { query_id: query.id, scene: query.scene, ..shown });
        lesson.bounds(1)
    };
    let mut taken_back = Lesson::new("taken_back");
    taken_back.start_core();
    let before = answer(&mut taken_back);
    taken_back.show(&volunteered("b", 0.2, 0.8));
    taken_back.show(&volunteered("c", 0.55, 0.4));
    taken_back.retraction.publish(&retraction("undo-b", "b")).expect("memory takes everything");
    assert_eq!(taken_back.receipt("undo-b").revision, 4);
    let undone = taken_back.posterior(4);

    let mut never_said = Lesson::new("never_said");
    never_said.start_core();
    assert!(to_cdr(&before) == to_cdr(&answer(&mut never_said)), "the same answer gives the same bounds");
    never_said.show(&volunteered("c", 0.55, 0.4));
    assert!(
        bits(&undone) == bits(&never_said.posterior(2)),
        "{} and {}",
        undone.evidence_hash,
        never_said.posterior(2).evidence_hash
    );
    assert_eq!(undone.n_demonstrations, 2);
    let log = taken_back.evidence(4);
    assert!(log.records.iter().any(|record| record.demonstration.iter().any(|d| d.id == "b")), "nothing is deleted");
}

#[test]
fn taking_everything_back_leaves_the_prior() {
    let mut node = node();
    let prior = take(&mut node, Event::Scene(Box::new(table()))).1.expect("a first posterior");
    take(&mut node, Event::Demonstration(Box::new(volunteered("a", 0.5, 0.45))));
    let (receipt, undone) = take(&mut node, Event::Retraction(Box::new(retraction("undo", "a"))));
    assert_eq!(receipt.map(|r| r.outcome), Some(EvidenceReceipt::ACCEPTED));
    assert!(bits(&undone.expect("a posterior of the retraction")) == bits(&prior));
}

/// One thing a person does.
#[derive(Debug, Clone)]
enum Act {
    /// Shows a spot, given in tenths of the table.
    Show { x: u8, y: u8, confidence: u8 },
    /// Takes one of the answers in force back, counted from the newest.
    Undo(usize),
    /// Skips the open question.
    Skip,
}

fn act() -> impl Strategy<Value = Act> {
    let show = (1..=9u8, 1..=9u8, 0..=2u8).prop_map(|(x, y, confidence)| Act::Show { x, y, confidence });
    prop_oneof![4 => show, 3 => any::<usize>().prop_map(Act::Undo), 1 => Just(Act::Skip)]
}

fn node() -> RewardPosterior {
    RewardPosterior::new(Settings { n_draws: 400, threads: 1, ..Settings::default() })
}

/// Gives the node an event, and the time to compute; returns the receipt and the newest posterior.
fn take(node: &mut RewardPosterior, event: Event) -> (Option<EvidenceReceipt>, Option<Posterior>) {
    let (mut receipt, mut posterior) = (None, None);
    let mut outputs = node.step(Time::default(), event);
    // A preview comes first, and asks to be called again.
    while outputs.iter().filter(|output| matches!(output, Output::Recompute)).count() > 0 {
        outputs.retain(|output| !matches!(output, Output::Recompute));
        outputs.extend(node.step(Time::default(), Event::Recompute));
    }
    for output in outputs {
        match output {
            Output::Receipt(message) => receipt = Some(message),
            Output::Posterior(message) => posterior = Some(*message),
            _ => {}
        }
    }
    (receipt, posterior)
}

/// Lets a node live through the acts; returns what is in force at the end and the last posterior.
fn live(acts: &[Act]) -> (Vec<PlacementDemonstration>, Posterior) {
    let mut node = node();
    let mut newest = take(&mut node, Event::Scene(Box::new(table()))).1.expect("a first posterior");
    let mut in_force: Vec<PlacementDemonstration> = Vec::new();
    for (i, act) in acts.iter().enumerate() {
        let event = match act {
            Act::Show { x, y, confidence } => {
                let (x, y) = (f64::from(*x) / 10.0, f64::from(*y) / 10.0);
                let shown = PlacementDemonstration { confidence: *confidence, ..volunteered(&format!("d{i}"), x, y) };
                Event::Demonstration(Box::new(shown))
            }
            Act::Undo(_) if in_force.is_empty() => continue,
            Act::Undo(back) => {
                let id = &in_force[in_force.len() - 1 - back % in_force.len()].id;
                Event::Retraction(Box::new(retraction(&format!("u{i}"), id)))
            }
            Act::Skip => {
                let query = PlacementQuery {
                    id: format!("q{i}"),
                    revision: newest.revision,
                    scene: table(),
                    ..PlacementQuery::default()
                };
                node.step(Time::default(), Event::Query(Box::new(query)));
                let (id, query_id) = (format!("r{i}"), format!("q{i}"));
                Event::Response(Box::new(QueryResponse { id, query_id, ..QueryResponse::default() }))
            }
        };
        let (receipt, posterior) = take(&mut node, event.clone());
        let accepted = receipt.is_some_and(|receipt| receipt.outcome == EvidenceReceipt::ACCEPTED);
        match event {
            // A spot under the cup or the plate is refused, and changes nothing.
            Event::Demonstration(shown) if accepted => in_force.push(*shown),
            Event::Demonstration(_) => assert!(posterior.is_none()),
            Event::Retraction(undo) => {
                assert!(accepted, "what is in force can be taken back");
                in_force.retain(|shown| shown.id != undo.evidence_id);
            }
            _ => assert!(accepted, "an open question can be skipped"),
        }
        newest = posterior.unwrap_or(newest);
    }
    (in_force, newest)
}

proptest! {
    #![proptest_config(Config { cases: 16, failure_persistence: None, rng_seed: RngSeed::Fixed(2), ..Config::default() })]

    #[test]
    fn whatever_was_said_and_taken_back_only_what_is_in_force_counts(acts in proptest::collection::vec(act(), 1..9)) {
        let (in_force, lived) = live(&acts);
        let mut fresh = node();
        let mut posterior = take(&mut fresh, Event::Scene(Box::new(table()))).1.expect("a first posterior");
        for shown in in_force {
            posterior = take(&mut fresh, Event::Demonstration(Box::new(shown))).1.expect("it was accepted before");
        }
        assert!(bits(&lived) == bits(&posterior), "{} and {}", lived.evidence_hash, posterior.evidence_hash);
    }
}
