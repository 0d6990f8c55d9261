//! What becomes evidence, what does not and why, and that the posterior is a function of the evidence in force.

use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::geometry_msgs::{Point, Pose, Quaternion, Vector3};
use apprentice_msgs::msg::{
    EvidenceReceipt, FeatureTrajectory, PlacementDemonstration, PlacementOption, PlacementQuery, Posterior,
    QueryResponse, Retraction, SceneObject, TableScene, TrajectoryPreference,
};
use apprentice_msgs::std_msgs::Header;
use apprentice_msgs::to_cdr;
use bus::testing::check_parameters;
use proptest::prelude::{ProptestConfig, Strategy, any, prop_assert_eq, proptest};
use reward_posterior::{Entry, Event, MAGIC, Output, RewardPosterior, Settings, read_journal};

fn object(id: &str, x: f64, y: f64) -> SceneObject {
    SceneObject {
        id: id.into(),
        label: id.into(),
        shape: SceneObject::SHAPE_CYLINDER,
        size_m: Vector3 { x: 0.1, y: 0.1, z: 0.1 },
        pose: Pose { position: Point { x, y, z: 0.0 }, orientation: Quaternion { x: 0.0, y: 0.0, z: 0.0, w: 1.0 } },
        supports: false,
    }
}

fn task() -> TableScene {
    TableScene {
        id: "task".into(),
        width_m: 1.0,
        depth_m: 1.0,
        objects: vec![object("cup", 0.25, 0.25), object("plate", 0.75, 0.75)],
        target: object("vase", 0.0, 0.0),
        ..TableScene::default()
    }
}

fn shown(id: &str, x: f64, y: f64) -> PlacementDemonstration {
    PlacementDemonstration {
        header: Header { stamp: Time { sec: 7, nanosec: 5 }, frame_id: String::new() },
        id: id.into(),
        source: "test".into(),
        scene: task(),
        placement: Point { x, y, z: 0.0 },
        ..PlacementDemonstration::default()
    }
}

fn asked(id: &str, revision: u64) -> PlacementQuery {
    PlacementQuery { id: id.into(), revision, scene: task(), ..PlacementQuery::default() }
}

fn back(id: &str, evidence_id: &str) -> Retraction {
    Retraction { id: id.into(), evidence_id: evidence_id.into(), ..Retraction::default() }
}

/// A node that knows the task, with few draws so that tests are quick.
struct Bench {
    node: RewardPosterior,
    journal: Vec<u8>,
}

fn settings() -> Settings {
    Settings { n_draws: 400, threads: 1, ..Settings::default() }
}

impl Bench {
    fn new() -> Self {
        let mut bench = Self { node: RewardPosterior::new(settings()), journal: MAGIC.to_vec() };
        bench.step(Event::Scene(Box::new(task())));
        bench
    }

    fn step(&mut self, event: Event) -> Vec<Output> {
        let outputs = self.node.step(Time::default(), event);
        for output in &outputs {
            if let Output::Journal(bytes) = output {
                self.journal.extend(bytes);
            }
        }
        outputs
    }

    fn receipts(&mut self, event: Event) -> Vec<EvidenceReceipt> {
        let receipt = |output| if let Output::Receipt(receipt) = output { Some(receipt) } else { None };
        self.step(event).into_iter().filter_map(receipt).collect()
    }

    fn receipt(&mut self, event: Event) -> EvidenceReceipt {
        let mut receipts = self.receipts(event);
        assert_eq!(receipts.len(), 1, "{receipts:?}");
        receipts.remove(0)
    }

    fn show(&mut self, message: PlacementDemonstration) -> EvidenceReceipt {
        self.receipt(Event::Demonstration(Box::new(message)))
    }

    /// The sentence with which a demonstration is refused, nothing else having changed.
    fn refused(&mut self, message: PlacementDemonstration) -> String {
        let before = (self.node.evidence().revision(), self.journal.len());
        let receipt = self.show(message);
        assert_eq!((receipt.outcome, receipt.revision), (EvidenceReceipt::REFUSED, 0), "{receipt:?}");
        assert_eq!((self.node.evidence().revision(), self.journal.len()), before);
        receipt.reason
    }

    fn posterior(&mut self) -> Posterior {
        loop {
            match self.step(Event::Recompute).as_slice() {
                [Output::Posterior(posterior)] => return (**posterior).clone(),
                [Output::Preview(_), Output::Recompute] => {}
                other => panic!("a posterior was expected, got {other:?}"),
            }
        }
    }
}

#[test]
fn parameters_are_documented() {
    check_parameters::<Settings>();
    assert!(bus::NodeSettings::check(&Settings { n_draws: 402, ..Settings::default() }).is_err());
}

#[test]
fn a_demonstration_is_journalled_before_it_is_acknowledged() {
    let mut bench = Bench::new();
    let outputs = bench.step(Event::Demonstration(Box::new(shown("d1", 0.5, 0.5))));
    let [Output::Journal(_), Output::Receipt(receipt), Output::Evidence(log), Output::Recompute] = outputs.as_slice()
    else {
        panic!("{outputs:?}")
    };
    assert_eq!((receipt.outcome, receipt.revision), (EvidenceReceipt::ACCEPTED, 1));
    assert_eq!((log.task.id.as_str(), log.records.len()), ("task", 1));
    assert_eq!(log.header.stamp, Time { sec: 7, nanosec: 5 }, "stamps come from the evidence");
}

#[test]
fn what_came_twice_counts_once() {
    let mut bench = Bench::new();
    bench.show(shown("d1", 0.5, 0.5));
    let again = PlacementDemonstration { header: Header::default(), ..shown("d1", 0.5, 0.5) };
    let receipt = bench.show(again);
    assert_eq!((receipt.outcome, receipt.revision), (EvidenceReceipt::DUPLICATE, 1));
    assert_eq!(bench.node.evidence().revision(), 1);
    assert!(bench.refused(shown("d1", 0.6, 0.5)).contains("'d1' was used before"));
}

#[test]
fn bad_demonstrations_are_refused_in_one_sentence_each() {
    let mut bench = Bench::new();
    assert_eq!(bench.refused(shown("", 0.5, 0.5)), "its id has 0 characters; 1 to 128 are allowed");
    assert_eq!(bench.refused(shown("d", f64::NAN, 0.5)), "the placement is (NaN, 0.5, 0); finite metres are needed");
    assert_eq!(bench.refused(shown("d", 0.25, 0.25)), "the vase cannot be at (0.25, 0.25) m: it would stand on 'cup'");
    assert_eq!(
        bench.refused(shown("d", 1.5, 0.5)),
        "the vase cannot be at (1.5, 0.5) m: it would stick out over the table's edge"
    );
    let mut off_table = shown("d", 0.5, 0.5);
    off_table.scene.objects[0].pose.position.x = 1.25;
    assert!(bench.refused(off_table).starts_with("object 'cup' of scene 'task' is at (1.25, 0.25) m, off the"));
    let mut nan = shown("d", 0.5, 0.5);
    nan.scene.objects[1].pose.position.y = f64::NAN;
    assert!(bench.refused(nan).starts_with("object 'plate' of scene 'task' has a position"));
    let mut twice = shown("d", 0.5, 0.5);
    twice.scene.objects[1].id = "cup".into();
    assert!(bench.refused(twice).contains("has the object id 'cup' twice"));
    let mut other = shown("d", 0.5, 0.5);
    other.scene.objects[1].id = "pan".into();
    assert_eq!(bench.refused(other), "its scene has the objects [cup, pan], but this lesson is about [cup, plate]");
    let unsure = PlacementDemonstration { confidence: 9, ..shown("d", 0.5, 0.5) };
    assert_eq!(bench.refused(unsure), "its confidence is 9; 0 (sure), 1 (fairly) and 2 (a guess) are known");
}

#[test]
fn only_the_open_question_is_answered_and_only_once() {
    let mut bench = Bench::new();
    let answer = |id: &str, query_id: &str| PlacementDemonstration { query_id: query_id.into(), ..shown(id, 0.5, 0.5) };
    bench.step(Event::Query(Box::new(asked("q0", 0))));
    assert_eq!(bench.show(answer("d1", "q0")).outcome, EvidenceReceipt::ACCEPTED);
    assert_eq!(bench.show(answer("d1", "q0")).outcome, EvidenceReceipt::DUPLICATE);
    assert_eq!(bench.refused(answer("d2", "q0")), "question 'q0' is no longer open; no question is open");
    bench.step(Event::Query(Box::new(asked("q1", 1))));
    assert_eq!(bench.refused(answer("d2", "q0")), "question 'q0' is no longer open; the open question is 'q1'");
    let mut elsewhere = answer("d2", "q1");
    elsewhere.scene.objects[0].pose.position.x = 0.3;
    assert_eq!(bench.refused(elsewhere), "its scene is not the one that question 'q1' asks about");
}

#[test]
fn which_of_two_places_is_better_is_answered_by_comparing_the_two_or_by_showing_a_third() {
    let option = |name: &str, x: f64| PlacementOption {
        placement: Point { x, y: 0.9, z: 0.0 },
        trajectory: FeatureTrajectory { id: format!("q0-{name}"), features: (0..11).map(|i| x + i as f64).collect() },
    };
    let query = PlacementQuery { options: vec![option("a", 0.1), option("b", 0.2)], ..asked("q0", 0) };
    let compared = |id: &str, of: Vec<FeatureTrajectory>| TrajectoryPreference {
        id: id.into(),
        query_id: "q0".into(),
        trajectories: of,
        answer: TrajectoryPreference::RANKED,
        ..TrajectoryPreference::default()
    };
    let of = |options: &[PlacementOption]| options.iter().map(|option| option.trajectory.clone()).collect::<Vec<_>>();
    let mut session = Bench::new();
    session.step(Event::Query(Box::new(query.clone())));
    let mut send = |message| session.receipt(Event::Preference(Box::new(message)));
    let mut others = of(&query.options);
    others[0].features[3] = 7.0;
    for wrong in [others, of(&[option("a", 0.1), option("c", 0.3)])] {
        let receipt = send(compared("wrong", wrong));
        assert_eq!(receipt.outcome, EvidenceReceipt::REFUSED);
        assert!(receipt.reason.contains("does not answer what question 'q0' asks"), "{}", receipt.reason);
    }
    let mut swapped = of(&query.options);
    swapped.reverse();
    assert_eq!(send(compared("c1", swapped)).outcome, EvidenceReceipt::ACCEPTED);
    assert_eq!(
        send(compared("c2", of(&query.options))).outcome,
        EvidenceReceipt::REFUSED,
        "a question is answered once"
    );
    let posterior = session.posterior();
    let kinds: Vec<(&str, u64)> = posterior.rationalities.iter().map(|of| (of.kind.as_str(), of.n)).collect();
    assert!(kinds.contains(&("preferences", 1)) && kinds.contains(&("placements", 0)), "{kinds:?}");
    // A question that asks where has no two places to compare; who is asked which of two may show a third.
    session.step(Event::Query(Box::new(PlacementQuery { scene: query.scene.clone(), ..asked("q1", 1) })));
    let stray = TrajectoryPreference { query_id: "q1".into(), ..compared("c3", of(&query.options)) };
    assert_eq!(session.receipt(Event::Preference(Box::new(stray))).outcome, EvidenceReceipt::REFUSED);
    session.step(Event::Query(Box::new(PlacementQuery { id: "q2".into(), revision: 1, ..query })));
    let third = PlacementDemonstration { query_id: "q2".into(), ..shown("d1", 0.5, 0.5) };
    assert_eq!(session.show(third).outcome, EvidenceReceipt::ACCEPTED);
}

#[test]
fn an_answer_that_overtakes_its_question_waits_for_it_but_not_for_ever() {
    let mut bench = Bench::new();
    let answer = PlacementDemonstration { query_id: "q0".into(), ..shown("d1", 0.5, 0.5) };
    assert!(bench.receipts(Event::Demonstration(Box::new(answer.clone()))).is_empty());
    assert!(bench.receipts(Event::Demonstration(Box::new(answer))).is_empty(), "a repetition waits too");
    assert_eq!(bench.receipt(Event::Query(Box::new(asked("q0", 0)))).outcome, EvidenceReceipt::ACCEPTED);

    let skip = QueryResponse { id: "r1".into(), query_id: "nonsense".into(), ..QueryResponse::default() };
    assert!(bench.receipts(Event::Response(Box::new(skip))).is_empty());
    assert!(bench.receipts(Event::Tick).is_empty());
    let receipt = bench.receipt(Event::Tick);
    assert_eq!(receipt.outcome, EvidenceReceipt::REFUSED);
    assert_eq!(receipt.reason, "question 'nonsense' was never asked; no question is open");
}

#[test]
fn only_accepted_evidence_is_taken_back_and_only_once() {
    let mut bench = Bench::new();
    let take_back = |id: &str, of: &str, bench: &mut Bench| bench.receipt(Event::Retraction(Box::new(back(id, of))));
    assert!(take_back("r1", "d1", &mut bench).reason.contains("has not been accepted"));
    bench.show(shown("d1", 0.5, 0.5));
    assert_eq!(take_back("r1", "d1", &mut bench).outcome, EvidenceReceipt::ACCEPTED);
    assert_eq!(take_back("r1", "d1", &mut bench).outcome, EvidenceReceipt::DUPLICATE);
    assert_eq!(take_back("r2", "d1", &mut bench).reason, "'d1' has been taken back before");
    assert!(take_back("r2", "r1", &mut bench).reason.contains("is itself a retraction"));
}

#[test]
fn a_skip_changes_the_revision_and_nothing_else() {
    let mut bench = Bench::new();
    bench.show(shown("d1", 0.5, 0.5));
    let before = bench.posterior();
    bench.step(Event::Query(Box::new(asked("q1", 1))));
    let skip = QueryResponse { id: "s".into(), query_id: "q1".into(), ..QueryResponse::default() };
    assert_eq!(bench.receipt(Event::Response(Box::new(skip))).revision, 2);
    let after = bench.posterior();
    assert_eq!((before.revision, after.revision, after.n_answers), (1, 2, 1));
    assert_eq!((before.draws, before.evidence_hash), (after.draws, after.evidence_hash));
}

#[test]
fn stop_needs_no_open_question_and_can_be_taken_back() {
    let mut bench = Bench::new();
    let stop = QueryResponse { id: "s".into(), kind: QueryResponse::STOP, ..QueryResponse::default() };
    assert_eq!(bench.receipt(Event::Response(Box::new(stop))).outcome, EvidenceReceipt::ACCEPTED);
    assert_eq!(bench.posterior().wish, Posterior::STOP);
    bench.step(Event::Retraction(Box::new(back("r", "s"))));
    assert_eq!(bench.posterior().wish, Posterior::NO_WISH);
    let odd = QueryResponse { id: "o".into(), kind: 9, ..QueryResponse::default() };
    assert!(bench.receipt(Event::Response(Box::new(odd))).reason.starts_with("its kind is 9"));
}

fn word(id: &str, kind: u8) -> Event {
    Event::Response(Box::new(QueryResponse { id: id.into(), kind, ..QueryResponse::default() }))
}

#[test]
fn words_about_the_lesson_need_no_question_and_change_no_draw() {
    let mut bench = Bench::new();
    bench.show(shown("d1", 0.5, 0.5));
    let before = bench.posterior();
    let mut wish = |id: &str, kind| {
        assert_eq!(bench.receipt(word(id, kind)).outcome, EvidenceReceipt::ACCEPTED);
        let after = bench.posterior();
        assert_eq!((&after.draws, &after.evidence_hash), (&before.draws, &before.evidence_hash));
        assert_eq!(after.n_answers, before.n_answers + u64::from(kind == QueryResponse::STOP));
        after.wish
    };
    assert_eq!(wish("p", QueryResponse::PAUSE), Posterior::PAUSE);
    assert_eq!(wish("s", QueryResponse::START), Posterior::START);
    assert_eq!(wish("p2", QueryResponse::PAUSE), Posterior::PAUSE);
    assert_eq!(wish("f", QueryResponse::FINISH), Posterior::FINISH);
    assert_eq!(wish("s2", QueryResponse::START), Posterior::FINISH, "an end is taken back, not started over");
    assert_eq!(wish("x", QueryResponse::STOP), Posterior::STOP);
    bench.step(Event::Retraction(Box::new(back("r1", "x"))));
    bench.step(Event::Retraction(Box::new(back("r2", "f"))));
    assert_eq!(bench.posterior().wish, Posterior::START);
}

#[test]
fn a_new_lesson_knows_nothing_of_the_old_one_until_it_is_taken_back() {
    let mut bench = Bench::new();
    let blank = bench.posterior();
    bench.show(shown("d1", 0.5, 0.5));
    bench.receipt(word("p", QueryResponse::PAUSE));
    let old = bench.posterior();
    assert_eq!(bench.receipt(word("n", QueryResponse::NEW_LESSON)).outcome, EvidenceReceipt::ACCEPTED);
    let new = bench.posterior();
    assert_eq!((&new.draws, &new.evidence_hash, new.wish), (&blank.draws, &blank.evidence_hash, Posterior::NO_WISH));
    assert_eq!((new.n_demonstrations, new.n_answers, new.revision), (0, 0, 3));
    assert_eq!(new.task, old.task);
    // A node that is killed now comes back into the new lesson.
    let mut again = RewardPosterior::new(settings());
    let (entries, _) = read_journal(&bench.journal).expect("it was just written");
    again.restore(entries).expect("it fits");
    assert_eq!(again.posterior().expect("evidence").expect("weights").draws, new.draws);
    bench.show(shown("d2", 0.3, 0.6));
    assert_eq!(bench.posterior().n_demonstrations, 1);
    bench.step(Event::Retraction(Box::new(back("r1", "d2"))));
    bench.step(Event::Retraction(Box::new(back("r2", "n"))));
    let back_again = bench.posterior();
    assert_eq!((&back_again.draws, back_again.wish), (&old.draws, Posterior::PAUSE));
}

#[test]
fn a_killed_node_comes_back_as_it_was() {
    let mut bench = Bench::new();
    bench.show(shown("d1", 0.5, 0.5));
    bench.show(shown("d2", 0.4, 0.5));
    bench.step(Event::Retraction(Box::new(back("r", "d1"))));
    let expected = bench.posterior();
    let (entries, used) = read_journal(&bench.journal).expect("the journal is whole");
    assert_eq!(used, bench.journal.len());
    assert_eq!(entries.len(), 4);
    let mut node = RewardPosterior::new(settings());
    let outputs = node.restore(entries).expect("the journal fits");
    assert!(matches!(outputs.as_slice(), [Output::Evidence(log), Output::Recompute] if log.records.len() == 3));
    let again = node.step(Time::default(), Event::Recompute);
    assert!(matches!(again.as_slice(), [Output::Posterior(p)] if to_cdr(&**p) == to_cdr(&expected)));
    let gap = vec![Entry::Record(Box::new(apprentice_msgs::msg::EvidenceRecord { sequence: 9, ..Default::default() }))];
    assert!(
        node.restore(gap)
            .expect_err("9 does not follow 3")
            .contains("entry 0 of the journal: it has sequence 9, 4 was expected")
    );
}

#[test]
fn without_a_scene_the_first_demonstration_names_the_task() {
    let mut bench = Bench { node: RewardPosterior::new(settings()), journal: MAGIC.to_vec() };
    assert_eq!(bench.show(shown("d1", 0.5, 0.5)).outcome, EvidenceReceipt::ACCEPTED);
    assert_eq!(bench.node.evidence().feature_names()[..2], ["cup".to_owned(), "plate".to_owned()]);
}

fn undone() -> impl Strategy<Value = Vec<(f64, bool)>> {
    proptest::collection::vec((0.4..0.6_f64, any::<bool>()), 1..5)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]
    #[test]
    fn after_an_undo_the_posterior_is_the_one_that_would_have_been(answers in undone()) {
        let (mut with, mut without) = (Bench::new(), Bench::new());
        for (i, &(x, taken_back)) in answers.iter().enumerate() {
            with.show(shown(&format!("d{i}"), x, 0.5));
            if taken_back {
                with.step(Event::Retraction(Box::new(back(&format!("r{i}"), &format!("d{i}")))));
            } else {
                without.show(shown(&format!("d{i}"), x, 0.5));
            }
        }
        let (with, without) = (with.posterior(), without.posterior());
        // Revision and count of answers tell of the history; everything else is of the evidence in force.
        let plain = |p: &Posterior| Posterior { revision: 0, header: Header::default(), ..p.clone() };
        prop_assert_eq!(to_cdr(&plain(&with)), to_cdr(&plain(&without)));
    }
}
