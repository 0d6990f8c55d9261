//! What comes in by message is what the core gets, and whatever cannot be used is refused in one sentence.

use apprentice_msgs::msg::{
    ActionDemonstration, CritiqueSegment, FeatureTrajectory, LearnerHistory, PolicySet, PolicyToJudge, SegmentCritique,
    TabularWorld, TrajectoryPreference,
};
use exchange::{
    Form, Mark, Picture, World, check_history, check_policies, check_preference, marks_from_message,
    steps_from_message, world_from_message, world_hash, world_to_message,
};
use mdp::Policy;
use proptest::prelude::{Strategy, any, prop_assert, proptest};

/// Two states: stay, or go over; the second is terminal.
fn message() -> TabularWorld {
    TabularWorld {
        id: "w".into(),
        gamma: 0.9,
        n_states: 2,
        n_actions: 2,
        feature_names: vec!["here".into(), "there".into(), "bias".into()],
        action_names: vec!["stay".into(), "go".into()],
        initial: vec![1.0, 0.0],
        from_state: vec![0, 0, 0],
        action: vec![0, 1, 1],
        to_state: vec![0, 0, 1],
        probability: vec![1.0, 0.25, 0.75],
        features_of: TabularWorld::STATE_FEATURES,
        features: vec![1.0, 0.0, 1.0, 0.0, 1.0, 1.0],
        shape: vec![1, 2],
        ..TabularWorld::default()
    }
}

fn world() -> World {
    world_from_message(&message()).expect("the world is good")
}

#[test]
fn a_world_is_what_its_message_says() {
    let world = world();
    assert_eq!((world.id.as_str(), world.feature_names.len()), ("w", 3));
    assert_eq!((world.mdp.gamma(), world.mdp.n_states(), world.mdp.n_actions()), (0.9, 2, 2));
    assert_eq!(world.mdp.successors(0, 1).collect::<Vec<_>>(), [(0, 0.25), (1, 0.75)]);
    assert!(world.mdp.is_terminal(1));
    assert_eq!((world.mdp.features(1, 0), world.mdp.shape()), ([0.0, 1.0, 1.0].as_slice(), Some([1, 2])));
    let mut later = message();
    later.header.stamp.sec = 9;
    assert_eq!(world_hash(&later), world.hash, "a repetition is the same world");
    assert_ne!(world_hash(&TabularWorld { gamma: 0.8, ..message() }), world.hash);
}

#[test]
fn every_fault_of_a_world_is_one_sentence() {
    let told = |change: fn(&mut TabularWorld)| {
        let mut wrong = message();
        change(&mut wrong);
        let text = world_from_message(&wrong).expect_err("it is no world").to_string();
        assert!(!text.contains('\n'), "{text}");
        text
    };
    assert_eq!(told(|w| w.id.clear()), "its id has 0 characters; 1 to 128 are allowed");
    assert_eq!(told(|w| w.feature_names.clear()), "it names 0 features; 1 to 1024 are supported");
    assert_eq!(told(|w| w.feature_names[1] = "here".into()), "it names the feature 'here' twice");
    assert!(told(|w| w.to_state.truncate(2)).starts_with("its transitions are 3 states, 3 actions, 2 targets and 3"));
    assert!(told(|w| (w.n_states, w.n_actions) = (u32::MAX, u32::MAX)).starts_with("it has 4294967295 states of"));
    assert!(told(|w| w.n_states = 0).contains("n_states is 0"));
    assert!(told(|w| w.n_states = 100_000).contains("initial has 2 entries, but 100000 are expected"));
    assert!(told(|w| w.n_actions = 3_000_000).starts_with("it has 2 states of 3000000 actions"));
    assert!(told(|w| w.n_actions = 3).contains("3"));
    assert!(told(|w| w.gamma = 1.0).starts_with("gamma is 1,"));
    assert!(told(|w| w.gamma = f64::NAN).starts_with("gamma is NaN,"));
    assert!(told(|w| w.initial[0] = f64::NAN).contains("initial[0] is NaN"));
    assert!(told(|w| w.initial[0] = 0.5).contains("initial sums to 0.5"));
    assert!(told(|w| w.to_state[2] = 7).contains("target is 7, but must lie in 0..2"));
    assert!(told(|w| w.probability[2] = 0.5).contains("state 0, action 1 sum to 0.75"));
    assert!(told(|w| w.probability[2] = f64::INFINITY).contains("has probability inf"));
    assert!(told(|w| w.features.truncate(5)).contains("features has 5 entries, but 6 are expected"));
    assert!(told(|w| w.features[3] = f64::NAN).contains("features[3] is NaN"));
    assert!(told(|w| w.features[3] = 1e13).contains("features[3] is 10000000000000"));
    assert!(told(|w| w.features_of = 1).contains("12 are expected"));
    assert!(told(|w| w.features_of = 2).starts_with("its features are of kind 2;"));
    assert!(told(|w| w.action_names.truncate(1)).contains("actions has 1 entries"));
    assert!(told(|w| w.shape = vec![3, 3]).contains("shape is 3"));
    assert!(told(|w| w.shape = vec![2]).starts_with("its shape has 1 numbers;"));
    assert!(told(|w| w.shape_of = 2).starts_with("its shape is of kind 2;"));
    assert!(told(|w| w.shape_of = TabularWorld::ROAD).starts_with("a road of 1 lanes and 2 places of traffic has"));
    assert!(told(|w| (w.shape, w.shape_of) = (vec![u32::MAX, 9], TabularWorld::ROAD)).ends_with("it has 2 states"));
}

#[test]
fn a_process_goes_there_and_back_with_its_picture() {
    let world = world();
    assert_eq!(world.picture, Picture::Cells { rows: 1, columns: 2 });
    let again = world_to_message("w", &world.feature_names, &world.mdp, world.picture);
    assert_eq!(again, message());
    let road = mdp::worlds::driving::world();
    let names: Vec<String> = (0..6).map(|i| format!("f{i}")).collect();
    let picture = Picture::Road { lanes: 5, places: 7 };
    let read = world_from_message(&world_to_message("road", &names, &road, picture)).expect("a good road");
    assert_eq!((read.picture, read.mdp), (picture, road));
}

fn shown(states: Vec<u32>, actions: Vec<u32>) -> ActionDemonstration {
    ActionDemonstration { world_id: "w".into(), states, actions, ..ActionDemonstration::default() }
}

#[test]
fn actions_are_taken_in_any_order_and_as_often_as_shown() {
    assert_eq!(steps_from_message(&shown(vec![1, 0, 0], vec![0, 1, 1]), &world()), Ok(vec![(1, 0), (0, 1), (0, 1)]));
    let told = |message: &ActionDemonstration| {
        steps_from_message(message, &world()).expect_err("it is no evidence").to_string()
    };
    let elsewhere = ActionDemonstration { world_id: "v".into(), ..shown(vec![0], vec![0]) };
    assert_eq!(told(&elsewhere), "it is about the world 'v', but this lesson is about 'w'");
    assert_eq!(told(&shown(vec![], vec![])), "it has 0 steps; 1 to 100000 are supported");
    assert_eq!(told(&shown(vec![0; 100_001], vec![0; 100_001])), "it has 100001 steps; 1 to 100000 are supported");
    let ragged = told(&shown(vec![0, 0], vec![0]));
    assert_eq!(ragged, "it has 2 states and 1 actions; one action for each state is needed");
    let out_of_range = told(&shown(vec![0, 2], vec![0, 0]));
    assert_eq!(out_of_range, "step 1: state 2 is out of range; the world has 2 of them, counted from 0");
    let out_of_range = told(&shown(vec![0, 0], vec![u32::MAX, 0]));
    assert_eq!(out_of_range, "step 0: action 4294967295 is out of range; the world has 2 of them, counted from 0");
    let unsure = ActionDemonstration { confidence: 3, ..shown(vec![0], vec![0]) };
    assert_eq!(told(&unsure), "its confidence is 3; 0 (sure), 1 (fairly) and 2 (a guess) are known");
}

fn marked(segments: &[(u32, u32, u8)]) -> SegmentCritique {
    let segment = |&(start, end, verdict): &(u32, u32, u8)| CritiqueSegment { start, end, verdict };
    SegmentCritique {
        world_id: "w".into(),
        states: vec![0, 0, 0, 1],
        actions: vec![0, 0, 1, 0],
        segments: segments.iter().map(segment).collect(),
        ..SegmentCritique::default()
    }
}

#[test]
fn what_is_not_marked_says_nothing() {
    let marks = marks_from_message(&marked(&[(2, 4, CritiqueSegment::GOOD), (0, 1, CritiqueSegment::BAD)]), &world());
    let mark = |state, action, good| Mark { state, action, good };
    assert_eq!(marks, Ok(vec![mark(0, 0, false), mark(0, 1, true), mark(1, 0, true)]));
    let told = |segments: &[(u32, u32, u8)]| {
        marks_from_message(&marked(segments), &world()).expect_err("it is no critique").to_string()
    };
    assert!(told(&[]).starts_with("it marks 0 segments of 4 steps"));
    assert!(told(&[(0, 1, 0); 5]).starts_with("it marks 5 segments of 4 steps"));
    assert_eq!(told(&[(2, 2, 0)]), "segment 0 goes from step 2 to 2; 0 <= start < end <= 4 is needed");
    assert!(told(&[(0, 1, 0), (1, 5, 0)]).starts_with("segment 1 goes from step 1 to 5;"));
    assert_eq!(told(&[(0, 2, 0), (1, 3, 1)]), "step 1 lies in two segments; a step is marked once");
    let single = TabularWorld {
        n_actions: 1,
        action_names: vec![],
        from_state: vec![0],
        action: vec![0],
        to_state: vec![1],
        probability: vec![1.0],
        ..message()
    };
    let single = world_from_message(&single).expect("one action is enough");
    let message = SegmentCritique { states: vec![0], actions: vec![0], ..marked(&[(0, 1, CritiqueSegment::BAD)]) };
    let text = marks_from_message(&message, &single).expect_err("there is no alternative").to_string();
    assert_eq!(text, "segment 0 is bad, but the world 'w' has no other action to take");
    assert_eq!(told(&[(0, 1, 2)]), "the verdict of segment 0 is 2; 0 (good) and 1 (bad) are known");
}

fn trajectories(features: &[&[f64]]) -> Vec<FeatureTrajectory> {
    let one = |(i, features): (usize, &&[f64])| FeatureTrajectory { id: format!("t{i}"), features: features.to_vec() };
    features.iter().enumerate().map(one).collect()
}

#[test]
fn trajectories_that_cannot_be_compared_are_told() {
    let told = |trajectories: Vec<FeatureTrajectory>| {
        let history = LearnerHistory { demonstrations: trajectories.clone(), ..LearnerHistory::default() };
        let preference = TrajectoryPreference { trajectories, ..TrajectoryPreference::default() };
        let text = check_preference(&preference, 2).map_err(|error| error.to_string());
        assert_eq!(check_history(&history, 2).map_err(|error| error.to_string()), text, "the same rules");
        text
    };
    assert_eq!(told(trajectories(&[&[0.0, 1.0], &[1.0, 0.0]])), Ok(()));
    let refused = |trajectories| told(trajectories).expect_err("they cannot be compared");
    assert_eq!(refused(trajectories(&[&[0.0, 1.0]])), "it compares 1 trajectories; 2 to 100 are supported");
    assert!(refused(trajectories(&[&[0.0, 1.0][..]; 101])).starts_with("it compares 101 trajectories"));
    let ragged = refused(trajectories(&[&[0.0, 1.0], &[1.0]]));
    assert_eq!(ragged, "trajectory 't1' has 1 features, but this lesson has 2 weights");
    let nan = refused(trajectories(&[&[0.0, f64::NAN], &[1.0, 1.0]]));
    assert_eq!(nan, "feature 1 of trajectory 't0' is NaN; finite numbers of at most 1e12 are needed");
    assert!(refused(trajectories(&[&[1e13, 0.0], &[1.0, 1.0]])).starts_with("feature 0 of trajectory 't0' is 1"));
    let mut twice = trajectories(&[&[0.0, 1.0], &[1.0, 0.0]]);
    twice[1].id = "t0".into();
    assert_eq!(refused(twice), "it holds the trajectory 't0' twice");
    let odd = TrajectoryPreference {
        trajectories: trajectories(&[&[0.0], &[1.0]]),
        answer: 3,
        ..TrajectoryPreference::default()
    };
    let text = check_preference(&odd, 1).expect_err("there is no such answer").to_string();
    assert_eq!(text, "its answer is 3; 0 (ranked), 1 (equal) and 2 (can't tell) are known");
}

fn set(policies: Vec<PolicyToJudge>) -> PolicySet {
    PolicySet { id: "s".into(), number: 1, world_id: "w".into(), policies, ..PolicySet::default() }
}

#[test]
fn policies_come_in_each_of_their_forms() {
    let policies = vec![
        PolicyToJudge { id: "a".into(), feature_counts: vec![1.0, 2.0, 3.0], ..PolicyToJudge::default() },
        PolicyToJudge { id: "b".into(), form: PolicyToJudge::TABULAR, actions: vec![1, 0], ..PolicyToJudge::default() },
        PolicyToJudge {
            id: "c".into(),
            form: PolicyToJudge::TABULAR,
            action_probabilities: vec![0.5, 0.5, 1.0, 0.0],
            ..PolicyToJudge::default()
        },
        PolicyToJudge {
            id: "d".into(),
            form: PolicyToJudge::ROLLOUTS,
            rollouts: trajectories(&[&[1.0, 0.0, 0.0], &[0.0, 1.0, 0.0]]),
            ..PolicyToJudge::default()
        },
    ];
    let checked = check_policies(&set(policies), 3, Some(&world())).expect("the set is good");
    let forms: Vec<Form> = checked.into_iter().map(|policy| policy.form).collect();
    let expected = [
        Form::FeatureCounts(vec![1.0, 2.0, 3.0]),
        Form::Tabular(Policy::Deterministic(vec![1, 0])),
        Form::Tabular(Policy::Stochastic(vec![0.5, 0.5, 1.0, 0.0])),
        Form::Rollouts(vec![vec![1.0, 0.0, 0.0], vec![0.0, 1.0, 0.0]]),
    ];
    assert_eq!(forms, expected);
}

#[test]
fn policies_that_cannot_be_judged_are_told() {
    let good = PolicyToJudge { id: "a".into(), feature_counts: vec![0.0; 3], ..PolicyToJudge::default() };
    let table = PolicyToJudge { id: "a".into(), form: 1, actions: vec![0, 1], ..PolicyToJudge::default() };
    let of = |set: &PolicySet, world: Option<&World>| {
        check_policies(set, 3, world).expect_err("it cannot be judged").to_string()
    };
    let told = |policy: PolicyToJudge| of(&set(vec![policy]), Some(&world()));
    assert_eq!(of(&set(vec![]), None), "it holds 0 policies; 1 to 1000 are supported");
    assert_eq!(
        of(&PolicySet { number: 0, ..set(vec![]) }, None),
        "its number is 0; the sets of a session count 1, 2, …"
    );
    assert_eq!(of(&set(vec![good.clone(), good.clone()]), None), "it holds the policy 'a' twice");
    let elsewhere = PolicySet { world_id: "v".into(), ..set(vec![good.clone()]) };
    assert_eq!(of(&elsewhere, Some(&world())), "it is about the world 'v', but this lesson is about 'w'");
    let unheard = of(&set(vec![table.clone()]), None);
    assert_eq!(unheard, "policy 'a' is a table of the world 'w', which has not been received");
    assert!(told(PolicyToJudge { form: 3, ..good.clone() }).starts_with("policy 'a' is of form 3;"));
    let short = told(PolicyToJudge { feature_counts: vec![0.0], ..good.clone() });
    assert_eq!(short, "policy 'a' has 1 feature counts, but this lesson has 3 weights");
    let nan = told(PolicyToJudge { feature_counts: vec![0.0, f64::NAN, 0.0], ..good });
    assert!(nan.starts_with("feature count 1 of policy 'a' is NaN;"));
    let both = told(PolicyToJudge { action_probabilities: vec![0.0; 4], ..table.clone() });
    assert_eq!(both, "policy 'a' has 2 actions and 4 probabilities; one of the two is needed");
    let beyond = told(PolicyToJudge { actions: vec![0, 2], ..table.clone() });
    assert!(beyond.starts_with("policy 'a': policy in state 1: action is 2, but must lie in 0..2"), "{beyond}");
    let probabilities = vec![0.5, 0.4, 1.0, 0.0];
    let short = told(PolicyToJudge { actions: vec![], action_probabilities: probabilities, ..table.clone() });
    assert!(short.starts_with("policy 'a': the policy in state 0 sums to 0.9"), "{short}");
    let none = told(PolicyToJudge { form: PolicyToJudge::ROLLOUTS, ..table.clone() });
    assert_eq!(none, "policy 'a' has 0 rollouts; 1 to 100000 are supported");
    let ragged = PolicyToJudge { form: PolicyToJudge::ROLLOUTS, rollouts: trajectories(&[&[0.0]]), ..table };
    assert_eq!(told(ragged), "policy 'a': trajectory 't0' has 1 features, but this lesson has 3 weights");
}

/// A world with a few numbers replaced by whatever.
fn distorted() -> impl Strategy<Value = TabularWorld> {
    let index = any::<proptest::sample::Index>;
    (0..8_u8, index(), any::<u32>(), any::<f64>()).prop_map(|(which, at, integer, float)| {
        let mut world = message();
        match which {
            0 => world.n_states = integer,
            1 => world.n_actions = integer,
            2 => *at.get_mut(&mut world.from_state) = integer,
            3 => *at.get_mut(&mut world.action) = integer,
            4 => *at.get_mut(&mut world.to_state) = integer,
            5 => *at.get_mut(&mut world.probability) = float,
            6 => *at.get_mut(&mut world.features) = float,
            _ => *at.get_mut(&mut world.initial) = float,
        }
        world
    })
}

proptest! {
    #[test]
    fn a_distorted_world_is_refused_or_sound(message in distorted()) {
        if let Ok(world) = world_from_message(&message) {
            let counts = mdp::feature_counts(&world.mdp, &Policy::uniform(&world.mdp));
            prop_assert!(counts.is_ok_and(|counts| counts.iter().all(|x| x.is_finite())));
        }
    }
}
