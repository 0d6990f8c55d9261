//! A session is recomputed from its evidence and settings, and whatever does not fit is named.

use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{
    EvidenceLog, EvidenceRecord, NodeSettings, PerformanceBounds, PlacementDemonstration, Posterior, Retraction,
    TableScene,
};
use apprentice_msgs::{Message, from_cdr, to_cdr};
use bus::{NodeSettings as _, settings_to_yaml};
use exchange::scene_to_message;
use replay::{Lesson, Recording, ReplayError, recompute, verify};
use scene::{Object, Point, Scene, Shape};

/// Topic, type and CDR of recorded messages.
type Bag = Vec<(String, &'static str, Vec<u8>)>;

fn task() -> TableScene {
    let object = |id: &str, x: f64| Object {
        id: id.into(),
        label: id.into(),
        shape: Shape::Cylinder { radius_m: 0.05, height_m: 0.1 },
        position_m: Point::new(x, 0.25),
        yaw_rad: 0.0,
        supports: false,
    };
    let scene = Scene {
        id: "task".into(),
        frame: "table".into(),
        width_m: 1.0,
        depth_m: 1.0,
        objects: vec![object("cup", 0.2)],
        target: object("vase", 0.0),
    };
    scene_to_message(&scene, Time::default())
}

fn shown(sequence: u64, x: f64) -> EvidenceRecord {
    let demonstration = PlacementDemonstration {
        id: format!("d{sequence}"),
        scene: task(),
        placement: apprentice_msgs::geometry_msgs::Point { x, y: 0.5, z: 0.0 },
        ..PlacementDemonstration::default()
    };
    EvidenceRecord {
        sequence,
        kind: EvidenceRecord::DEMONSTRATION,
        demonstration: vec![demonstration],
        ..EvidenceRecord::default()
    }
}

fn taken_back(sequence: u64, evidence_id: &str) -> EvidenceRecord {
    let retraction =
        Retraction { id: format!("r{sequence}"), evidence_id: evidence_id.into(), ..Retraction::default() };
    EvidenceRecord {
        sequence,
        kind: EvidenceRecord::RETRACTION,
        retraction: vec![retraction],
        ..EvidenceRecord::default()
    }
}

fn log(records: Vec<EvidenceRecord>) -> EvidenceLog {
    EvidenceLog { task: task(), records, ..EvidenceLog::default() }
}

fn record<M: Message>(bag: &mut Bag, topic: &str, message: &M) {
    bag.push((format!("/apprentice/{topic}"), M::TYPE, to_cdr(message)));
}

/// What every recording begins with.
fn settings() -> Bag {
    let mut bag = Bag::new();
    let mut add = |node: &str, parameters: String| {
        record(&mut bag, "settings", &NodeSettings { node: node.into(), parameters, ..NodeSettings::default() });
    };
    let posterior = reward_posterior::Settings { n_draws: 400, ..Default::default() };
    add(reward_posterior::Settings::NODE, settings_to_yaml(&posterior));
    add(performance_bounds::Settings::NODE, settings_to_yaml(&performance_bounds::Settings::default()));
    let query = active_query::Settings { n_candidates: 3, ..Default::default() };
    add(active_query::Settings::NODE, settings_to_yaml(&query));
    add(placement_planner::Settings::NODE, settings_to_yaml(&placement_planner::Settings::default()));
    bag
}

fn collect(bag: &Bag) -> Result<Recording, ReplayError> {
    Recording::collect(bag.iter().map(|(topic, type_name, cdr)| (topic.as_str(), *type_name, cdr.as_slice())), None)
}

fn computed(bag: &Bag) -> (Recording, Lesson) {
    let recording = collect(bag).expect("the bag is good");
    let lesson = recompute(&recording, None, |_| {}).expect("the session can be computed");
    (recording, lesson)
}

/// A session of two answers, the second taken back, with all that the nodes say to it.
fn session() -> Bag {
    let mut bag = settings();
    record(&mut bag, "evidence", &log(vec![shown(1, 0.5), shown(2, 0.45), taken_back(3, "d2")]));
    let (_, lesson) = computed(&bag);
    for round in &lesson.rounds {
        record(&mut bag, "posterior", &round.posterior);
        let table = round.table.as_ref().expect("the lesson is about a table");
        record(&mut bag, "candidates", &table.candidates);
        record(&mut bag, "bounds", &table.bounds);
        record(&mut bag, "lesson", &table.lesson);
        record(&mut bag, "query", table.query.as_ref().expect("400 draws teach nobody"));
    }
    bag
}

#[test]
fn an_untouched_session_is_equal_for_any_number_of_threads() {
    let bag = session();
    let recording = collect(&bag).expect("the bag is good");
    for threads in [None, Some(1), Some(2)] {
        let mut lesson = recompute(&recording, threads, |_| {}).expect("the session can be computed");
        let report = verify(&recording, &mut lesson).expect("it can be compared");
        assert_eq!(report.mismatch, None);
        assert_eq!((report.records, report.posteriors.recorded, report.bounds.recorded), (3, 4, 4));
    }
}

#[test]
fn an_undo_gives_the_draws_that_would_have_been() {
    let (_, lesson) = computed(&session());
    let of =
        |revision: usize| (&lesson.rounds[revision].posterior.draws, &lesson.rounds[revision].posterior.evidence_hash);
    assert_eq!(of(1), of(3));
    assert_ne!(of(1), of(2));
}

#[test]
fn the_first_changed_bit_is_named_by_message_revision_and_field() {
    let mut bag = session();
    let bounds = bag.iter_mut().filter(|(_, type_name, _)| *type_name == PerformanceBounds::TYPE).nth(2);
    let (_, _, cdr) = bounds.expect("there are four");
    let mut changed: PerformanceBounds = from_cdr(cdr).expect("it was just recorded");
    changed.bounds[1].mean_m = f64::from_bits(changed.bounds[1].mean_m.to_bits() ^ 1);
    *cdr = to_cdr(&changed);
    let (recording, mut lesson) = computed(&bag);
    let found = verify(&recording, &mut lesson).expect("it can be compared").mismatch.expect("a bit differs");
    assert_eq!((found.message, found.revision), (PerformanceBounds::TYPE, 2));
    assert_eq!(found.difference.field, "bounds[1].mean_m");
}

#[test]
fn an_output_that_no_evidence_explains_is_a_difference() {
    let mut bag = session();
    let (_, lesson) = computed(&bag);
    let beyond = Posterior { revision: 9, ..lesson.rounds[3].posterior.clone() };
    record(&mut bag, "posterior", &beyond);
    let (recording, mut lesson) = computed(&bag);
    let found = verify(&recording, &mut lesson).expect("it can be compared").mismatch.expect("revision 9 is made up");
    assert_eq!((found.revision, found.difference.field.as_str()), (9, "revision"));
}

#[test]
fn the_longest_log_counts_and_contradictions_are_refused() {
    let mut bag = settings();
    record(&mut bag, "evidence", &log(vec![shown(1, 0.5), shown(2, 0.45)]));
    record(&mut bag, "evidence", &log(vec![shown(1, 0.5)]));
    assert_eq!(collect(&bag).expect("the bag is good").evidence.records.len(), 2);
    record(&mut bag, "evidence", &log(vec![shown(1, 0.51)]));
    assert!(matches!(collect(&bag), Err(ReplayError::TwoHistories { sequence: 1 })));
    let mut gap = settings();
    record(&mut gap, "evidence", &log(vec![shown(1, 0.5), shown(3, 0.5)]));
    assert!(matches!(collect(&gap), Err(ReplayError::Gap { before: 1, after: 3 })));
}

#[test]
fn what_is_missing_or_ambiguous_is_told() {
    let told = |bag: &Bag| collect(bag).expect_err("the bag is of no use").to_string();
    assert!(told(&settings()).contains("holds no accepted evidence"));
    let mut two = settings();
    record(&mut two, "evidence", &log(vec![]));
    two.push(("/other/evidence".into(), EvidenceLog::TYPE, to_cdr(&log(vec![]))));
    assert!(told(&two).contains("--namespace"));
    let mut malformed = settings();
    malformed.push(("/apprentice/posterior".into(), Posterior::TYPE, vec![0, 1, 0, 0, 7]));
    assert!(told(&malformed).contains("topic '/apprentice/posterior' cannot be read as apprentice_msgs/msg/Posterior"));
    let mut changed = settings();
    let node = reward_posterior::Settings::NODE.to_owned();
    let parameters = settings_to_yaml(&reward_posterior::Settings::default());
    record(&mut changed, "settings", &NodeSettings { node, parameters, ..NodeSettings::default() });
    assert!(told(&changed).contains("different settings within the session"));
    let mut bare = Bag::new();
    record(&mut bare, "evidence", &log(vec![]));
    let recording = collect(&bare).expect("there is evidence");
    assert!(matches!(recompute(&recording, None, |_| {}), Err(ReplayError::NoSettings("reward_posterior"))));
}
