//! A lesson about a world and trajectories is recomputed as one about a table is, with previews and bounds on policies.

use apprentice_msgs::msg::{
    ActionDemonstration, EvidenceLog, EvidenceRecord, FeatureTrajectory, NodeSettings, PolicyBounds, PolicySet,
    PolicyToJudge, PosteriorPreview, Retraction, TabularWorld, TrajectoryPreference, WorldReference,
};
use apprentice_msgs::{Message, from_cdr, to_cdr};
use bus::{NodeSettings as _, settings_to_yaml};
use exchange::world_hash;
use replay::{Recording, ReplayError, Report, recompute, verify};
use reward_posterior::{Entry, RewardPosterior};

/// Topic, type and CDR of recorded messages.
type Bag = Vec<(String, &'static str, Vec<u8>)>;

fn world() -> TabularWorld {
    TabularWorld {
        id: "row".into(),
        gamma: 0.9,
        n_states: 3,
        n_actions: 2,
        feature_names: vec!["left".into(), "middle".into(), "right".into()],
        initial: vec![0.0, 1.0, 0.0],
        from_state: vec![0, 0, 1, 1, 2, 2],
        action: vec![0, 1, 0, 1, 0, 1],
        to_state: vec![0, 1, 0, 2, 1, 2],
        probability: vec![1.0; 6],
        features: vec![1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        ..TabularWorld::default()
    }
}

fn reference() -> WorldReference {
    WorldReference { id: "row".into(), hash: world_hash(&world()) }
}

fn acted(sequence: u64, state: u32) -> EvidenceRecord {
    let actions = ActionDemonstration {
        id: format!("a{sequence}"),
        world_id: "row".into(),
        states: vec![state],
        actions: vec![1],
        ..ActionDemonstration::default()
    };
    EvidenceRecord { sequence, kind: EvidenceRecord::ACTIONS, actions: vec![actions], ..EvidenceRecord::default() }
}

fn preferred(sequence: u64) -> EvidenceRecord {
    let trajectory = |id: &str, features: [f64; 3]| FeatureTrajectory { id: id.into(), features: features.to_vec() };
    let preference = TrajectoryPreference {
        id: format!("p{sequence}"),
        trajectories: vec![trajectory("t", [1.0, 1.0, 0.0]), trajectory("u", [0.0, 1.0, 1.0])],
        ..TrajectoryPreference::default()
    };
    let kind = EvidenceRecord::PREFERENCE;
    EvidenceRecord { sequence, kind, preference: vec![preference], ..EvidenceRecord::default() }
}

fn taken_back(sequence: u64, evidence_id: &str) -> EvidenceRecord {
    let id = format!("r{sequence}");
    let retraction = Retraction { id, evidence_id: evidence_id.into(), ..Retraction::default() };
    let kind = EvidenceRecord::RETRACTION;
    EvidenceRecord { sequence, kind, retraction: vec![retraction], ..EvidenceRecord::default() }
}

fn policies() -> PolicySet {
    let always = |id: &str, action: u32| PolicyToJudge {
        id: id.into(),
        form: PolicyToJudge::TABULAR,
        actions: vec![action; 3],
        ..PolicyToJudge::default()
    };
    PolicySet {
        id: "both ways".into(),
        number: 1,
        world_id: "row".into(),
        policies: vec![always("left", 0), always("right", 1)],
        ..PolicySet::default()
    }
}

fn record<M: Message>(bag: &mut Bag, topic: &str, message: &M) {
    bag.push((format!("/apprentice/{topic}"), M::TYPE, to_cdr(message)));
}

/// Only the two nodes that such a lesson takes.
fn settings() -> Bag {
    let mut bag = Bag::new();
    let mut add = |node: &str, parameters: String| {
        record(&mut bag, "settings", &NodeSettings { node: node.into(), parameters, ..NodeSettings::default() });
    };
    let posterior = reward_posterior::Settings { n_draws: 800, beta_actions_log_sd: 0.5, ..Default::default() };
    add(reward_posterior::Settings::NODE, settings_to_yaml(&posterior));
    add(performance_bounds::Settings::NODE, settings_to_yaml(&performance_bounds::Settings::default()));
    bag
}

fn collect(bag: &Bag) -> Result<Recording, ReplayError> {
    Recording::collect(bag.iter().map(|(topic, type_name, cdr)| (topic.as_str(), *type_name, cdr.as_slice())), None)
}

fn verified(bag: &Bag) -> Result<Report, ReplayError> {
    let recording = collect(bag)?;
    let mut lesson = recompute(&recording, Some(1), |_| {})?;
    verify(&recording, &mut lesson)
}

/// What the nodes say to a log, recorded.
fn session(log: EvidenceLog) -> Bag {
    let mut bag = settings();
    record(&mut bag, "world", &world());
    record(&mut bag, "evidence", &log);
    record(&mut bag, "policies", &policies());
    let recording = collect(&bag).expect("the bag is good");
    let lesson = recompute(&recording, None, |_| {}).expect("the session can be computed");
    for round in &lesson.rounds {
        record(&mut bag, "posterior", &round.posterior);
        let asked = PolicyBounds { revision: round.posterior.revision, ..PolicyBounds::default() };
        record(&mut bag, "policy_bounds", &lesson.rejudge(&asked, &policies()).expect("they can be judged"));
    }
    bag
}

fn log() -> EvidenceLog {
    let records = vec![acted(1, 1), preferred(2), taken_back(3, "a1"), acted(4, 2)];
    EvidenceLog { world: reference(), records, ..EvidenceLog::default() }
}

#[test]
fn a_lesson_about_a_world_is_equal_bit_for_bit() {
    let report = verified(&session(log())).expect("it can be compared");
    assert_eq!(report.mismatch, None);
    assert_eq!((report.posteriors.recorded, report.posteriors.revisions), (5, 5));
    assert_eq!((report.policy_bounds.recorded, report.policy_bounds.revisions), (5, 5));
    assert_eq!((report.bounds.revisions, report.queries.revisions, report.lessons.revisions), (0, 0, 0));
}

#[test]
fn a_changed_bit_of_a_bound_on_a_policy_is_named() {
    let mut bag = session(log());
    let bounds = bag.iter_mut().filter(|(_, type_name, _)| *type_name == PolicyBounds::TYPE).nth(2);
    let (_, _, cdr) = bounds.expect("there are five");
    let mut changed: PolicyBounds = from_cdr(cdr).expect("it was just recorded");
    let mean = &mut changed.policies[1].return_bound.mean;
    *mean = f64::from_bits(mean.to_bits() ^ 1);
    *cdr = to_cdr(&changed);
    let found = verified(&bag).expect("it can be compared").mismatch.expect("a bit differs");
    assert_eq!((found.message, found.revision), (PolicyBounds::TYPE, 2));
    assert_eq!(found.difference.field, "policies[1].return_bound.mean");
}

#[test]
fn a_preview_is_recomputed_from_the_posterior_that_it_names() {
    let mut bag = session(log());
    let settings = reward_posterior::Settings { n_draws: 800, beta_actions_log_sd: 0.5, ..Default::default() };
    let mut node = RewardPosterior::new(settings);
    let entries = [Entry::World(Box::new(world())), Entry::Record(Box::new(acted(1, 1)))];
    node.restore(entries.to_vec()).expect("it fits");
    node.posterior().expect("it can be computed");
    // Two events came while the node was busy.
    let preview = node.preview_after(&log().records[1..3]).expect("they follow").expect("the evidence differs");
    assert_eq!((preview.base_revision, preview.revision), (1, 3));
    record(&mut bag, "posterior_preview", &preview);
    let report = verified(&bag).expect("it can be compared");
    assert_eq!((report.mismatch, report.previews.recorded), (None, 1));
    record(&mut bag, "posterior_preview", &PosteriorPreview { khat: preview.khat + 1e-9, ..preview });
    let found = verified(&bag).expect("it can be compared").mismatch.expect("k-hat differs");
    assert_eq!((found.message, found.difference.field.as_str()), (PosteriorPreview::TYPE, "khat"));
}

#[test]
fn a_lesson_that_only_trajectories_count_begins_with_the_first_of_them() {
    let by_reference = EvidenceRecord {
        sequence: 2,
        kind: EvidenceRecord::WORLD,
        world: vec![reference()],
        ..EvidenceRecord::default()
    };
    let log = EvidenceLog { records: vec![preferred(1), by_reference, acted(3, 1)], ..EvidenceLog::default() };
    let mut bag = settings();
    record(&mut bag, "world", &world());
    record(&mut bag, "evidence", &log);
    let recording = collect(&bag).expect("the bag is good");
    let mut lesson = recompute(&recording, None, |_| {}).expect("the session can be computed");
    let of = |i: usize| (lesson.rounds[i].posterior.revision, lesson.rounds[i].posterior.feature_names[0].as_str());
    assert_eq!((lesson.rounds.len(), of(0), of(1), of(2)), (3, (1, "feature_0"), (2, "left"), (3, "left")));
    assert_eq!(verify(&recording, &mut lesson).expect("it can be compared").mismatch, None);
}

#[test]
fn what_was_not_recorded_is_named() {
    let without = |topic: &str| {
        let bag: Bag =
            session(log()).into_iter().filter(|(name, _, _)| *name != format!("/apprentice/{topic}")).collect();
        verified(&bag)
    };
    let error = without("world").expect_err("the evidence is about a world").to_string();
    assert_eq!(error, "the world 'row' of the evidence is not in the bag; was `lesson_world` recorded?");
    let report = without("policies").expect("the rest can be compared");
    assert_eq!((report.mismatch, report.policy_bounds.recorded, report.policy_bounds.revisions), (None, 0, 5));
}
