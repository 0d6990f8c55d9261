//! Evidence about worlds and trajectories over the graph: each kind counts, all stand together, and what is taken back was
//! never said.

use crate::evidence::{table, volunteered};
use crate::graph::Lesson;
use crate::log_lines;
use crate::row::{Person, RIGHT, acted, critique, history, pair, preferred, row};
use apprentice_msgs::msg::{
    ActionDemonstration, EvidenceReceipt, LearnerHistory, Posterior, SegmentCritique, TabularWorld,
    TrajectoryPreference,
};
use apprentice_msgs::std_msgs::Header;
use apprentice_msgs::to_cdr;

/// The bytes of everything in a posterior that speaks of the evidence in force, and not of how it came about.
fn bits(posterior: &Posterior) -> Vec<u8> {
    to_cdr(&Posterior { header: Header::default(), revision: 0, n_answers: 0, ..posterior.clone() })
}

fn begun(name: &str) -> (Lesson, Person) {
    let mut lesson = Lesson::new(name);
    let parameters = ["n_draws:=800", "threads:=1", "beta_preferences_log_sd:=0.5"];
    lesson.start("reward_posterior", reward_posterior::run, &parameters);
    let person = Person::new(&mut lesson);
    (lesson, person)
}

#[test]
fn each_kind_is_heard_and_what_is_taken_back_was_never_said() {
    let (mut lesson, person) = begun("kinds");
    person.world.publish(&row(5)).expect("memory takes everything");
    let prior = lesson.posterior(0);
    let ids = person.says_everything(&mut lesson, 5);
    let told = lesson.posterior(4);
    let n_of = |posterior: &Posterior| posterior.rationalities.iter().map(|of| of.n).collect::<Vec<u64>>();
    assert_eq!((n_of(&prior), n_of(&told)), (vec![0; 5], vec![0, 1, 1, 1, 1]));
    assert_eq!((told.learned_kinds.as_slice(), told.learned_betas.len()), (["preferences".to_owned()].as_slice(), 800));
    assert!(bits(&told) != bits(&prior));
    let preview = lesson.preview(4);
    assert!(preview.base_revision < 4 && preview.evidence_hash == told.evidence_hash);
    assert_eq!(Person::takes_back(&mut lesson, &ids), 8);
    assert!(bits(&lesson.posterior(8)) == bits(&prior), "nothing is left of what was taken back");
    let log = lesson.evidence(8);
    assert_eq!((log.world.id.as_str(), log.task.width_m, log.records.len()), ("row", 0.0, 8), "nothing is deleted");
}

#[test]
fn a_table_and_a_world_share_one_weight_vector() {
    let (mut lesson, person) = begun("shared");
    lesson.start("performance_bounds", performance_bounds::run, &["threads:=1"]);
    lesson.start("active_query", active_query::run, &["n_candidates:=5"]);
    lesson.scene.publish(&table()).expect("memory takes everything");
    lesson.posterior(0);
    person.world.publish(&row(11)).expect("memory takes everything");
    let both = lesson.posterior(1);
    assert_eq!((both.task.id.as_str(), both.world.id.as_str(), both.feature_names[0].as_str()), ("task", "row", "cup"));
    person.says_everything(&mut lesson, 11);
    lesson.show(&volunteered("d", 0.5, 0.45));
    let told = lesson.posterior(6);
    assert_eq!(told.rationalities.iter().map(|of| of.n).collect::<Vec<u64>>(), [1; 5]);
    // The table's nodes go on with it.
    assert_eq!(lesson.bounds(6).evidence_hash, told.evidence_hash);
    lesson.query(6);
}

#[test]
fn a_world_that_does_not_fit_the_table_is_told_once_and_the_lesson_goes_on() {
    let (mut lesson, person) = begun("misfit");
    lesson.scene.publish(&table()).expect("memory takes everything");
    lesson.posterior(0);
    for _ in 0..3 {
        person.world.publish(&row(4)).expect("memory takes everything");
    }
    lesson.show(&volunteered("d", 0.5, 0.45));
    lesson.posterior(1);
    let told =
        log_lines::wait_for_warning("it has 4 features, but this lesson has 11 weights, those of the table 'task'");
    assert_eq!(told.len(), 1, "{told:#?}");
}

/// Sends something that must be refused for a reason that holds `wanted`, told in one line.
fn refused(lesson: &mut Lesson, id: &str, wanted: &str) {
    let receipt = lesson.receipt(id);
    assert_eq!((receipt.outcome, receipt.revision), (EvidenceReceipt::REFUSED, 0), "{id}");
    assert!(receipt.reason.contains(wanted) && !receipt.reason.contains('\n'), "{wanted:?}: {:?}", receipt.reason);
    let told = log_lines::wait_for_warning(&format!(" '{id}' from 'test'"));
    assert!(told.len() == 1 && told[0].contains(wanted), "{told:#?}");
}

#[test]
fn hostile_messages_get_one_clear_sentence_each_and_lose_nothing() {
    const TAKES_EVERYTHING: &str = "memory takes everything";
    let (mut lesson, person) = begun("hostile");
    let worlds = [
        (TabularWorld { id: "nan".into(), gamma: f64::NAN, ..row(3) }, "gamma is NaN"),
        (TabularWorld { id: "ragged".into(), to_state: vec![0], ..row(3) }, "as many of each are needed"),
        (TabularWorld { id: "huge".into(), n_states: u32::MAX, ..row(3) }, "pairs are supported"),
        (TabularWorld { id: "leaky".into(), probability: vec![0.5; 6], ..row(3) }, "must sum to 1"),
        (TabularWorld { id: "outside".into(), to_state: vec![9; 6], ..row(3) }, "must lie in 0..3"),
        (TabularWorld { id: "featureless".into(), feature_names: vec![], ..row(3) }, "it names 0 features"),
    ];
    for (world, wanted) in worlds {
        person.world.publish(&world).expect(TAKES_EVERYTHING);
        let told = log_lines::wait_for_warning(&format!("the world '{}' is ignored", world.id));
        assert!(told.len() == 1 && told[0].contains(wanted) && !told[0].contains('\n'), "{wanted:?}: {told:#?}");
    }
    person.world.publish(&row(3)).expect(TAKES_EVERYTHING);
    lesson.posterior(0);

    person.actions.publish(&acted("empty-actions", &[])).expect(TAKES_EVERYTHING);
    refused(&mut lesson, "empty-actions", "it has 0 steps");
    let ragged = ActionDemonstration { states: vec![0, 1], ..acted("ragged-actions", &[(0, 0)]) };
    person.actions.publish(&ragged).expect(TAKES_EVERYTHING);
    refused(&mut lesson, "ragged-actions", "2 states and 1 actions");
    person.actions.publish(&acted("far-state", &[(u32::MAX, 0)])).expect(TAKES_EVERYTHING);
    refused(&mut lesson, "far-state", "state 4294967295 is out of range");
    let elsewhere = ActionDemonstration { world_id: "moon".into(), ..acted("elsewhere", &[(0, 0)]) };
    person.actions.publish(&elsewhere).expect(TAKES_EVERYTHING);
    refused(&mut lesson, "elsewhere", "about the world 'moon'");
    person.actions.publish(&acted("huge-actions", &vec![(0, 0); 150_000])).expect(TAKES_EVERYTHING);
    refused(&mut lesson, "huge-actions", "it has 150000 steps");

    let mut nan = pair(3, 0, 1);
    nan[0].features[1] = f64::NAN;
    person.preference.publish(&preferred("nan-features", nan)).expect(TAKES_EVERYTHING);
    refused(&mut lesson, "nan-features", "is NaN");
    person.preference.publish(&preferred("ragged-features", pair(2, 0, 1))).expect(TAKES_EVERYTHING);
    refused(&mut lesson, "ragged-features", "has 2 features, but this lesson has 3 weights");
    let odd = TrajectoryPreference { answer: 200, ..preferred("odd-answer", pair(3, 0, 1)) };
    person.preference.publish(&odd).expect(TAKES_EVERYTHING);
    refused(&mut lesson, "odd-answer", "its answer is 200");
    let many: Vec<_> = (0..500).flat_map(|_| pair(3, 0, 1)).collect();
    person.preference.publish(&preferred("too-many", many)).expect(TAKES_EVERYTHING);
    refused(&mut lesson, "too-many", "it compares 1000 trajectories");

    let beyond = critique("beyond", &[(0, RIGHT)], &[(0, 5, 0)]);
    person.critique.publish(&beyond).expect(TAKES_EVERYTHING);
    refused(&mut lesson, "beyond", "segment 0 goes from step 0 to 5");
    let odd = SegmentCritique { confidence: 9, ..critique("odd-confidence", &[(0, RIGHT)], &[(0, 1, 0)]) };
    person.critique.publish(&odd).expect(TAKES_EVERYTHING);
    refused(&mut lesson, "odd-confidence", "its confidence is 9");

    let single = LearnerHistory { ..history("single", pair(3, 0, 1)[..1].to_vec()) };
    person.history.publish(&single).expect(TAKES_EVERYTHING);
    refused(&mut lesson, "single", "it compares 1 trajectories");

    person.says_everything(&mut lesson, 3);
    assert_eq!(lesson.evidence(4).records.len(), 4);
    lesson.posterior(4);
    lesson.check_nodes();
}
