//! The robust policies of a lesson about a world, what is judged of them, their frontiers, and the lesson's state are compared.

use apprentice_msgs::msg::{
    ActionDemonstration, EvidenceLog, EvidenceRecord, LessonStatus, NodeSettings, PolicyBounds, PolicyFrontier,
    PolicySet, RiskPreference, RobustPolicy, TabularWorld, WorldQuery, WorldReference,
};
use apprentice_msgs::{Message, from_cdr, to_cdr};
use bus::{NodeSettings as _, settings_to_yaml};
use exchange::{world_from_message, world_hash};
use policy_optimizer::{Inputs, Objective};
use replay::{Recording, ReplayError, Report, recompute, verify};

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

fn walked(sequence: u64, states: &[u32]) -> EvidenceRecord {
    let shown = ActionDemonstration {
        id: format!("a{sequence}"),
        world_id: "row".into(),
        states: states.to_vec(),
        actions: vec![1; states.len()],
        ..ActionDemonstration::default()
    };
    EvidenceRecord { sequence, kind: EvidenceRecord::ACTIONS, actions: vec![shown], ..EvidenceRecord::default() }
}

fn log() -> EvidenceLog {
    let world = WorldReference { id: "row".into(), hash: world_hash(&world()) };
    EvidenceLog { world, records: vec![walked(1, &[1, 2]), walked(2, &[1, 2, 2])], ..EvidenceLog::default() }
}

fn said() -> RiskPreference {
    RiskPreference { id: "said".into(), number: 1, lambda: 0.125, ..RiskPreference::default() }
}

fn record<M: Message>(bag: &mut Bag, topic: &str, message: &M) {
    bag.push((format!("/apprentice/{topic}"), M::TYPE, to_cdr(message)));
}

fn optimizer() -> policy_optimizer::Settings {
    policy_optimizer::Settings { points: 5, objective: Objective::Regret, threads: 1, ..Default::default() }
}

fn collect(bag: &Bag) -> Result<Recording, ReplayError> {
    Recording::collect(bag.iter().map(|(topic, type_name, cdr)| (topic.as_str(), *type_name, cdr.as_slice())), None)
}

fn verified(bag: &Bag, threads: i64) -> Result<Report, ReplayError> {
    let recording = collect(bag)?;
    let mut lesson = recompute(&recording, Some(threads), |_| {})?;
    verify(&recording, &mut lesson)
}

/// What the nodes say in a lesson of two walks and one preference between mean and worst case, recorded.
fn session() -> Bag {
    let mut bag = Bag::new();
    let mut add = |node: &str, parameters: String| {
        record(&mut bag, "settings", &NodeSettings { node: node.into(), parameters, ..NodeSettings::default() });
    };
    let posterior = reward_posterior::Settings { n_draws: 2000, ..Default::default() };
    add(reward_posterior::Settings::NODE, settings_to_yaml(&posterior));
    add(performance_bounds::Settings::NODE, settings_to_yaml(&performance_bounds::Settings::default()));
    add(active_query::Settings::NODE, settings_to_yaml(&active_query::Settings::default()));
    add(policy_optimizer::Settings::NODE, settings_to_yaml(&optimizer()));
    record(&mut bag, "lesson_world", &world());
    record(&mut bag, "evidence", &log());
    record(&mut bag, "risk_preference", &said());
    let recording = collect(&bag).expect("the bag is good");
    let lesson = recompute(&recording, None, |_| {}).expect("the session can be computed");
    let of = world_from_message(&world()).expect("a good world");
    for round in &lesson.rounds {
        let revision = round.posterior.revision;
        record(&mut bag, "posterior", &round.posterior);
        let walks: Vec<&ActionDemonstration> =
            recording.evidence.records[..revision as usize].iter().flat_map(|record| &record.actions).collect();
        let inputs = Inputs { posterior: &round.posterior, world: &of, demonstrations: &walks };
        for preference in [None, Some(&said())] {
            let found = policy_optimizer::policy(&optimizer(), &inputs, preference);
            record(&mut bag, "robust_policy", &found.policy);
            let Some(set) = found.set else { continue };
            record(&mut bag, "policies", &set);
            let asked = PolicyBounds { revision, ..PolicyBounds::default() };
            let judged = lesson.rejudge(&asked, &set).expect("they can be judged");
            record(&mut bag, "policy_bounds", &judged);
            let settings = active_query::Settings::default();
            let state = active_query::world_lesson(&settings, &round.posterior, &judged).expect("it is about a world");
            let (posterior, log) = (&round.posterior, &recording.evidence);
            let inputs = active_query::WorldInputs { posterior, world: &of, log, bounds: &judged };
            let state = active_query::fitted(&settings, &inputs, state).expect("it fits together");
            let asked = active_query::world_question(&settings, &inputs, &state).expect("it fits together");
            let (query, state) = (asked.0.expect("the lesson goes on"), asked.1);
            record(&mut bag, "world_query", &query);
            record(&mut bag, "lesson", &state);
        }
        record(&mut bag, "policy_frontier", &policy_optimizer::frontier(&optimizer(), &inputs));
    }
    bag
}

/// The bag with the n-th message of a kind changed.
fn changed<M: Message>(mut bag: Bag, n: usize, change: impl FnOnce(&mut M)) -> Bag {
    let found = bag.iter_mut().filter(|(_, type_name, _)| *type_name == M::TYPE).nth(n);
    let (_, _, cdr) = found.expect("there are as many");
    let mut message: M = from_cdr(cdr).expect("it was just recorded");
    change(&mut message);
    *cdr = to_cdr(&message);
    bag
}

fn next(x: &mut f64) {
    *x = f64::from_bits(x.to_bits() ^ 1);
}

#[test]
fn policies_frontiers_and_states_are_equal_bit_for_bit_with_any_number_of_threads() {
    for threads in [1, 3] {
        let report = verified(&session(), threads).expect("it can be compared");
        assert_eq!(report.mismatch, None);
        // Before the first walk there is nothing to regret: those policies are judged by their return.
        assert_eq!((report.robust_policies.recorded, report.frontiers.recorded), (6, 3));
        // At one revision both balances come to the same policy, and to the same state.
        assert_eq!((report.policy_bounds.recorded, report.lessons.recorded, report.lessons.revisions), (6, 5, 3));
        assert_eq!((report.world_queries.recorded, report.world_queries.revisions), (5, 3));
    }
}

#[test]
fn a_question_that_was_asked_ahead_follows_from_the_posterior_that_it_names() {
    let bag = session();
    let recording = collect(&bag).expect("the bag is good");
    let lesson = recompute(&recording, None, |_| {}).expect("the session can be computed");
    let settings = active_query::Settings::default();
    let of = world_from_message(&world()).expect("a good world");
    let (posterior, log) = (&lesson.rounds[1].posterior, &recording.evidence);
    let bounds = &recording.policy_bounds[&1][0].0;
    let state = active_query::world_lesson(&settings, posterior, bounds).expect("it is about a world");
    let inputs = active_query::WorldInputs { posterior, world: &of, log, bounds };
    let asked =
        active_query::questions_ahead(&settings, &inputs, &state, None, 3).expect("it fits together").swap_remove(1);
    assert_eq!((asked.revision, asked.ahead), (2, 1));
    let later = recording.lesson[&2][0].0.clone();
    let stays = LessonStatus { query_id: asked.id.clone(), ..later };
    // It was open when the state of its revision came, and stayed.
    let with = |query: &WorldQuery, state: &LessonStatus| {
        let mut bag: Bag = bag.clone();
        record(&mut bag, "world_query", query);
        record(&mut bag, "lesson", state);
        verified(&bag, 1).expect("it can be compared")
    };
    let report = with(&asked, &stays);
    assert_eq!((report.mismatch, report.world_queries.recorded), (None, 6));
    let named = |query: &WorldQuery, state: &LessonStatus| {
        with(query, state).mismatch.map(|m| (m.message, m.revision, m.difference.field))
    };
    let other = WorldQuery { state: asked.state ^ 1, ..asked.clone() };
    assert_eq!(named(&other, &stays), Some((WorldQuery::TYPE, 2, "state".into())));
    for ahead in [2, 3, 9] {
        let other = WorldQuery { ahead, ..asked.clone() };
        assert!(named(&other, &stays).is_some(), "from no posterior so far back: {ahead}");
    }
    let unknown = LessonStatus { query_id: "w2-a0-00000000".into(), ..stays.clone() };
    assert!(named(&asked, &unknown).is_some_and(|(message, ..)| message == LessonStatus::TYPE));
}

#[test]
fn a_changed_bit_is_named_wherever_it_is() {
    let found = |bag: Bag| {
        let mismatch = verified(&bag, 1).expect("it can be compared").mismatch.expect("a bit differs");
        (mismatch.message, mismatch.revision, mismatch.difference.field)
    };
    let policy = found(changed(session(), 3, |m: &mut RobustPolicy| next(&mut m.conditional_value_at_risk)));
    assert_eq!(policy, (RobustPolicy::TYPE, 1, "conditional_value_at_risk".into()));
    let frontier = found(changed(session(), 2, |m: &mut PolicyFrontier| next(&mut m.points[4].expected_return)));
    assert_eq!(frontier, (PolicyFrontier::TYPE, 2, "points[4].expected_return".into()));
    let state = found(changed(session(), 4, |m: &mut LessonStatus| next(&mut m.loss_bound)));
    assert_eq!((state.0, state.1), (LessonStatus::TYPE, 2));
    let asked = found(changed(session(), 4, |m: &mut WorldQuery| m.state ^= 1));
    assert_eq!(asked, (WorldQuery::TYPE, 2, "state".into()));
    // A set that is not the optimizer's: its own bounds would be consistent, but the policy in it is another.
    let set = found(changed(session(), 5, |m: &mut PolicySet| m.policies[1].action_probabilities.swap(0, 1)));
    assert_eq!(set.1, 2);
}

#[test]
fn what_was_not_recorded_is_named() {
    let without = |topic: &str| {
        let name = format!("/apprentice/{topic}");
        verified(&session().into_iter().filter(|(of, _, _)| *of != name).collect(), 1)
    };
    let error = without("risk_preference").expect_err("a policy names it").to_string();
    assert!(error.contains("the preference 'said'"), "{error}");
    assert_eq!(without("policies").expect("the rest can be compared").mismatch, None);
    let other = changed(session(), 3, |m: &mut NodeSettings| m.node = "somebody".into());
    let error = verified(&other, 1).expect_err("there are policies").to_string();
    assert!(error.contains("the settings of policy_optimizer are not in the bag"), "{error}");
}
