//! What becomes evidence of the kinds that are about worlds and trajectories, what names the weights, and what a restart keeps.

mod support;

use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{
    ActionDemonstration, EvidenceReceipt, EvidenceRecord, FeatureTrajectory, LearnerHistory, SegmentCritique,
    TableScene, TabularWorld, TrajectoryPreference,
};
use apprentice_msgs::std_msgs::Header;
use apprentice_msgs::to_cdr;
use reward_posterior::{Entry, Event, Output, RewardPosterior, read_journal};
use support::{Bench, RIGHT, acted, back, critique, history, ranked, row, settings, shown, table, trajectory};

fn pair(k: usize) -> [FeatureTrajectory; 2] {
    let unit = |i: usize| (0..k).map(|j| f64::from(u8::from(i == j))).collect::<Vec<f64>>();
    [trajectory("t", &unit(0)), trajectory("u", &unit(1))]
}

#[test]
fn whatever_comes_twice_counts_once_and_ids_are_used_once() {
    let mut bench = Bench::in_row(settings(), 3);
    let stamped = Header { stamp: Time { sec: 9, nanosec: 0 }, frame_id: "x".into() };
    let said: [(Event, Event); 4] = [
        (
            Event::Actions(Box::new(acted("a", &[(1, RIGHT)]))),
            Event::Actions(Box::new(ActionDemonstration { header: stamped.clone(), ..acted("a", &[(1, RIGHT)]) })),
        ),
        (
            Event::Preference(Box::new(ranked("p", &pair(3)))),
            Event::Preference(Box::new(TrajectoryPreference { header: stamped.clone(), ..ranked("p", &pair(3)) })),
        ),
        (
            Event::Critique(Box::new(critique("c", &[(1, 0)], &[(0, 1, 0)]))),
            Event::Critique(Box::new(SegmentCritique {
                header: stamped.clone(),
                ..critique("c", &[(1, 0)], &[(0, 1, 0)])
            })),
        ),
        (
            Event::History(Box::new(history("h", &pair(3)))),
            Event::History(Box::new(LearnerHistory { header: stamped, ..history("h", &pair(3)) })),
        ),
    ];
    for (revision, (first, again)) in (1..).zip(said) {
        assert_eq!(bench.take(first), revision);
        let receipt = bench.receipt(again);
        assert_eq!((receipt.outcome, receipt.revision), (EvidenceReceipt::DUPLICATE, revision));
    }
    let other = Event::Actions(Box::new(acted("p", &[(1, RIGHT)])));
    assert_eq!(bench.refused(other), "its id 'p' was used before for other evidence; ids must be unique");
    assert!(bench.refused(Event::Retraction(Box::new(back("h", "a")))).contains("'h' was used before"));
}

#[test]
fn bad_evidence_of_every_kind_is_refused_in_one_sentence() {
    let mut bench = Bench::in_row(settings(), 3);
    let mut refused = |event: Event, wanted: &str| {
        let reason = bench.refused(event);
        assert!(reason.contains(wanted), "expected {wanted:?} in {reason:?}");
        assert!(bench.warnings.pop().is_some_and(|told| told.ends_with(&reason) && told.contains("is refused: ")));
    };
    let acts = |states: Vec<u32>, actions: Vec<u32>| {
        Event::Actions(Box::new(ActionDemonstration { states, actions, ..acted("a", &[]) }))
    };
    refused(acts(vec![], vec![]), "it has 0 steps");
    refused(acts(vec![0; 200_000], vec![0; 200_000]), "it has 200000 steps");
    refused(acts(vec![0, 1], vec![0]), "2 states and 1 actions");
    refused(acts(vec![3], vec![0]), "state 3 is out of range");
    refused(acts(vec![0], vec![7]), "action 7 is out of range");
    let elsewhere = ActionDemonstration { world_id: "moon".into(), ..acted("a", &[(0, 0)]) };
    refused(Event::Actions(Box::new(elsewhere)), "about the world 'moon', but this lesson is about 'row'");
    let long = ActionDemonstration { source: "s".repeat(5000), ..acted("a", &[(0, 0)]) };
    refused(Event::Actions(Box::new(long)), "a text of 5000 bytes");
    refused(Event::Actions(Box::new(acted(&"i".repeat(200), &[(0, 0)]))), "its id has 200 characters");
    let compares = |trajectories: &[FeatureTrajectory]| Event::Preference(Box::new(ranked("p", trajectories)));
    refused(compares(&[]), "it compares 0 trajectories");
    refused(compares(&pair(3)[..1]), "it compares 1 trajectories");
    refused(compares(&[trajectory("t", &[0.0; 3]), trajectory("t", &[1.0; 3])]), "the trajectory 't' twice");
    refused(compares(&pair(2)), "trajectory 't' has 2 features, but this lesson has 3 weights");
    refused(compares(&[trajectory("t", &[0.0, f64::NAN, 0.0]), trajectory("u", &[1.0; 3])]), "is NaN");
    refused(compares(&[trajectory("t", &[f64::INFINITY; 3]), trajectory("u", &[1.0; 3])]), "is inf");
    let unsure = TrajectoryPreference { confidence: 7, ..ranked("p", &pair(3)) };
    refused(Event::Preference(Box::new(unsure)), "its confidence is 7");
    let odd = TrajectoryPreference { answer: 7, ..ranked("p", &pair(3)) };
    refused(Event::Preference(Box::new(odd)), "its answer is 7");
    refused(Event::History(Box::new(history("h", &pair(3)[..1]))), "it compares 1 trajectories");
    let steps = [(0, 0), (1, 0)];
    let marks = |segments: &[(u32, u32, u8)]| Event::Critique(Box::new(critique("c", &steps, segments)));
    refused(marks(&[]), "it marks 0 segments");
    refused(marks(&[(0, 3, 0)]), "segment 0 goes from step 0 to 3");
    refused(marks(&[(0, 2, 0), (1, 2, 1)]), "step 1 lies in two segments");
    refused(marks(&[(0, 1, 9)]), "the verdict of segment 0 is 9");
    bench.take(compares(&pair(3)));
    let mut changed = pair(3);
    changed[1].features[2] = 5.0;
    let reason = bench.refused(Event::Preference(Box::new(ranked("q", &changed))));
    assert_eq!(reason, "trajectory 'u' had other features before; ids of trajectories must be unique");
    bench.take(Event::Retraction(Box::new(back("r", "p"))));
    bench.take(Event::Preference(Box::new(ranked("q", &changed))));
}

#[test]
fn a_session_has_room_for_much_but_not_for_everything() {
    let mut bench = Bench::in_row(settings(), 3);
    let many: Vec<FeatureTrajectory> =
        (0..100).map(|i| trajectory(&format!("t{i}"), &[f64::from(i), 0.0, 0.0])).collect();
    let mut taken = 0;
    let reason = loop {
        let receipt = bench.receipt(Event::Preference(Box::new(ranked(&format!("p{taken}"), &many))));
        if receipt.outcome != EvidenceReceipt::ACCEPTED {
            break receipt.reason;
        }
        taken += 1;
    };
    assert_eq!(taken, 40, "40 rankings of 100 are 198,000 pairs");
    assert!(reason.starts_with("it compares 4950 pairs of trajectories and the session holds 198000"), "{reason}");
    let long = acted("a", &[(1, RIGHT); 90_000]);
    let reason = loop {
        let id = format!("a{taken}");
        let receipt = bench.receipt(Event::Actions(Box::new(ActionDemonstration { id, ..long.clone() })));
        if receipt.outcome != EvidenceReceipt::ACCEPTED {
            break receipt.reason;
        }
        taken += 1;
    };
    assert!(reason.contains("8388608 are all it takes") && bench.node.evidence().n_bytes() < 8 << 20, "{reason}");
    bench.take(Event::Retraction(Box::new(back("r", "p0"))));
}

#[test]
fn what_speaks_of_a_world_waits_for_it_but_not_for_ever() {
    let mut bench = Bench::new(settings());
    assert!(bench.receipts(Event::Actions(Box::new(acted("a", &[(1, RIGHT)])))).is_empty());
    assert!(bench.receipts(Event::Preference(Box::new(ranked("p", &pair(3))))).is_empty());
    let receipts = bench.receipts(Event::World(Box::new(row("row", 3))));
    assert_eq!(receipts.iter().map(|r| (r.id.as_str(), r.revision)).collect::<Vec<_>>(), [("a", 1), ("p", 2)]);
    assert_eq!(bench.posterior().feature_names[0], "at 0", "the world names the weights");

    let mut bench = Bench::new(settings());
    bench.receipts(Event::Critique(Box::new(critique("c", &[(1, 0)], &[(0, 1, 0)]))));
    assert!(bench.receipts(Event::Tick).is_empty());
    let receipt = bench.receipt(Event::Tick);
    assert_eq!(receipt.reason, "no world has been received that it could be about");
}

#[test]
fn without_a_table_or_a_world_trajectories_count_the_weights_and_a_later_world_names_them() {
    let mut bench = Bench::new(settings());
    assert!(bench.receipts(Event::Preference(Box::new(ranked("p", &pair(3))))).is_empty());
    bench.receipts(Event::Tick);
    assert_eq!(bench.receipt(Event::Tick).revision, 1);
    assert_eq!(bench.posterior().feature_names, ["feature_0", "feature_1", "feature_2"]);
    assert!(bench.refused(Event::Preference(Box::new(ranked("q", &pair(4))))).contains("this lesson has 3 weights"));
    bench.step(Event::World(Box::new(row("large", 4))));
    let told =
        "the world 'large' is ignored: it has 4 features, but this lesson has 3 weights, those of its trajectories";
    assert_eq!(bench.warnings.last().map(String::as_str), Some(told));
    bench.step(Event::World(Box::new(row("row", 3))));
    let posterior = bench.posterior();
    assert_eq!((posterior.revision, posterior.feature_names[2].as_str()), (2, "at 2"));
    let log = bench.node.evidence().log();
    assert_eq!((log.task.width_m, log.world.id.as_str()), (0.0, ""), "nothing was known before the first event");
    assert_eq!((log.records[1].kind, log.records[1].world[0].id.as_str()), (EvidenceRecord::WORLD, "row"));
}

#[test]
fn a_table_and_a_world_stand_together_when_they_have_as_many_features() {
    let mut bench = Bench::new(settings());
    bench.step(Event::World(Box::new(row("row", 11))));
    let before = bench.posterior();
    bench.step(Event::Scene(Box::new(table())));
    bench.step(Event::Scene(Box::new(table())));
    let after = bench.posterior();
    assert_eq!((before.revision, after.revision), (0, 1), "what comes second is an event of its own, once");
    assert_eq!((before.draws, before.evidence_hash), (after.draws, after.evidence_hash));
    assert_eq!(
        (after.feature_names[0].as_str(), after.task.id.as_str(), after.world.id.as_str()),
        ("at 0", "task", "row")
    );
    let log = bench.node.evidence().log();
    assert_eq!((log.world.id.as_str(), log.task.width_m), ("row", 0.0));
    assert_eq!(log.records[0].scene, [table()]);
    bench.take(Event::Demonstration(Box::new(shown("d", 0.5, 0.5))));
    assert!(bench.refused(Event::Retraction(Box::new(back("r", "row")))).contains("has not been accepted"));
    assert!(bench.warnings.len() == 1, "{:?}", bench.warnings);

    let mut bench = Bench::new(settings());
    bench.step(Event::World(Box::new(row("row", 3))));
    for _ in 0..3 {
        bench.step(Event::Scene(Box::new(table())));
    }
    let told =
        "the scene 'task' is ignored: it has 11 features, but this lesson has 3 weights, those of the world 'row'";
    assert_eq!(bench.warnings, [told]);
    let reason = bench.refused(Event::Demonstration(Box::new(shown("d", 0.5, 0.5))));
    assert!(reason.starts_with("its table does not fit: it has 11 features"), "{reason}");

    let mut bench = Bench::new(settings());
    bench.step(Event::World(Box::new(row("row", 11))));
    assert_eq!(bench.take(Event::Demonstration(Box::new(shown("d", 0.5, 0.5)))), 2, "its table is the first event");
}

#[test]
fn a_world_that_cannot_be_used_or_is_not_the_lessons_is_told_once() {
    let mut bench = Bench::new(settings());
    let broken = TabularWorld { gamma: f64::NAN, ..row("row", 3) };
    for _ in 0..3 {
        bench.step(Event::World(Box::new(broken.clone())));
    }
    assert_eq!(bench.warnings.len(), 1, "{:?}", bench.warnings);
    assert!(bench.warnings[0].starts_with("the world 'row' is ignored: gamma is NaN"), "{:?}", bench.warnings);
    bench.step(Event::World(Box::new(row("row", 3))));
    let stamped = Header { stamp: Time { sec: 5, nanosec: 0 }, frame_id: String::new() };
    bench.step(Event::World(Box::new(TabularWorld { header: stamped, ..row("row", 3) })));
    assert_eq!(bench.warnings.len(), 1, "a repetition is no fault: {:?}", bench.warnings);
    bench.step(Event::World(Box::new(TabularWorld { gamma: 0.5, ..row("row", 3) })));
    bench.step(Event::World(Box::new(row("other", 3))));
    let told = [
        "the world 'row' is ignored: it is not what it was when this lesson began",
        "the world 'other' is ignored: this lesson is about the world 'row'",
    ];
    assert_eq!(bench.warnings[1..], told);
    assert_eq!(bench.node.evidence().revision(), 0);
}

/// A lesson about everything, in which something was taken back.
fn mixed() -> Bench {
    let mut bench = Bench::new(settings());
    bench.step(Event::Scene(Box::new(table())));
    bench.take(Event::Demonstration(Box::new(shown("d", 0.5, 0.5))));
    bench.step(Event::World(Box::new(row("row", 11))));
    bench.take(Event::Actions(Box::new(acted("a", &[(5, RIGHT)]))));
    bench.take(Event::Preference(Box::new(ranked("p", &pair(11)))));
    bench.take(Event::Retraction(Box::new(back("r", "a"))));
    bench.take(Event::Critique(Box::new(critique("c", &[(5, 0)], &[(0, 1, 1)]))));
    bench.take(Event::History(Box::new(history("h", &pair(11)))));
    bench
}

#[test]
fn a_restart_keeps_every_kind_to_the_bit() {
    let mut bench = mixed();
    let expected = bench.posterior();
    let (entries, used) = read_journal(&bench.journal).expect("the journal is whole");
    assert_eq!((used, entries.len()), (bench.journal.len(), 9), "a table, a world and seven events");
    let mut node = RewardPosterior::new(settings());
    let outputs = node.restore(entries.clone()).expect("the journal fits");
    let [Output::World(world), Output::Evidence(log), Output::Recompute] = outputs.as_slice() else {
        panic!("{outputs:?}")
    };
    assert_eq!((world.id.as_str(), log.records.len()), ("row", 7), "the world, which nobody may be sending any more");
    assert_eq!(node.evidence().log(), bench.node.evidence().log());
    let restored = node.posterior().expect("it can be computed").expect("the weights are known");
    assert!(to_cdr(&restored) == to_cdr(&expected));

    // A crash between a world and the event that takes it up: the world is offered again.
    let mut node = RewardPosterior::new(settings());
    node.restore(entries[..3].to_vec()).expect("the journal fits");
    assert_eq!((node.evidence().revision(), node.evidence().world().is_none()), (1, true));
    let outputs = node.step(Time::default(), Event::World(Box::new(row("row", 11))));
    assert!(matches!(outputs[0], Output::Journal(_)) && node.evidence().world().is_some());

    let without_world: Vec<Entry> = entries.into_iter().filter(|entry| !matches!(entry, Entry::World(_))).collect();
    let error = RewardPosterior::new(settings()).restore(without_world).expect_err("the world is gone");
    assert_eq!(error, "entry 2 of the journal: it names the world 'row', which is not known");
}

#[test]
fn a_lesson_that_began_with_a_world_comes_back_as_one() {
    let mut bench = Bench::in_row(settings(), 11);
    bench.take(Event::Actions(Box::new(acted("a", &[(5, RIGHT)]))));
    bench.step(Event::Scene(Box::new(table())));
    let (entries, _) = read_journal(&bench.journal).expect("the journal is whole");
    let mut node = RewardPosterior::new(settings());
    node.restore(entries).expect("the journal fits");
    assert_eq!(node.evidence().log(), bench.node.evidence().log());
    assert_eq!(node.evidence().log().world.id, "row");
    assert_eq!(node.evidence().log().task, TableScene::default());
}

#[test]
fn settings_that_rule_accepted_answers_out_are_told_at_the_start() {
    let mut bench = Bench::in_row(settings(), 3);
    let equal = TrajectoryPreference { answer: TrajectoryPreference::EQUAL, ..ranked("p", &pair(3)) };
    bench.take(Event::Preference(Box::new(equal)));
    let (entries, _) = read_journal(&bench.journal).expect("the journal is whole");
    let strict = reward_posterior::Settings { equal_threshold: 0.0, ..settings() };
    let error = RewardPosterior::new(strict).restore(entries).expect_err("the answer is not expected");
    assert!(error.starts_with("the journal holds evidence that is unusable with these settings: "), "{error}");
}

#[test]
fn a_preview_can_be_made_again_from_the_log() {
    let mut bench = mixed();
    bench.posterior();
    let before = bench.node.evidence().log();
    bench.take(Event::Actions(Box::new(acted("b", &[(6, RIGHT)]))));
    bench.posterior();
    let records = bench.node.evidence().records().to_vec();
    let (entries, _) = read_journal(&bench.journal).expect("the journal is whole");
    let mut node = RewardPosterior::new(settings());
    node.restore(entries[..entries.len() - 1].to_vec()).expect("the journal fits");
    assert_eq!(node.evidence().log(), before);
    node.posterior().expect("it can be computed");
    let again = node.preview_after(&records[7..]).expect("the record follows").expect("the evidence differs");
    assert!(to_cdr(&again) == to_cdr(bench.previews.last().expect("there was one")));
    assert_eq!((again.revision, again.base_revision), (8, 7));
}
