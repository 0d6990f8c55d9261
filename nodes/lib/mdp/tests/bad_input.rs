//! Every hazard of bad input gives an error of its own that says what, where, got and expected; none a panic.
#![allow(clippy::unwrap_used)]

use mdp::worlds::{GridWorld, chapter4};
use mdp::{Features, Mdp, MdpError, MdpParts, Policy, feature_counts, policy_losses, projection, rollout, values};
use proptest::prelude::{any, prop_assert, proptest};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// Two states, two actions, two features; the second state is terminal.
fn parts() -> MdpParts {
    MdpParts {
        gamma: 0.9,
        n_states: 2,
        n_actions: 2,
        n_features: 2,
        initial: vec![0.25, 0.75],
        transitions: vec![(0, 0, 0, 0.5), (0, 0, 1, 0.5), (0, 1, 1, 1.0)],
        features: Features::State(vec![1.0, 0.0, 0.0, 1.0]),
        actions: vec!["stay".into(), "go".into()],
        shape: Some([1, 2]),
    }
}

/// The error of changed parts, and that its message holds every one of `words`.
fn refuse(change: impl FnOnce(&mut MdpParts), words: &[&str]) -> MdpError {
    let mut changed = parts();
    change(&mut changed);
    let error = Mdp::new(changed).unwrap_err();
    for word in words {
        assert!(error.to_string().contains(word), "`{error}` lacks `{word}`");
    }
    error
}

#[test]
fn the_parts_themselves_are_a_process() {
    let mdp = Mdp::new(parts()).unwrap();
    assert!(mdp.is_terminal(1) && !mdp.is_terminal(0));
    assert_eq!(mdp.parts(), parts());
    assert_eq!(Mdp::from_json(mdp.to_json().as_bytes()).unwrap(), mdp);
}

#[test]
fn sizes() {
    assert_eq!(refuse(|p| p.n_states = 0, &["n_states is 0"]), MdpError::Zero { name: "n_states" });
    assert_eq!(refuse(|p| p.n_actions = 0, &["n_actions is 0"]), MdpError::Zero { name: "n_actions" });
    assert_eq!(refuse(|p| p.n_features = 0, &["n_features is 0"]), MdpError::Zero { name: "n_features" });
    assert!(matches!(refuse(|p| p.n_states = 1 << 40, &["1099511627776", "200000"]), MdpError::TooLarge { .. }));
    // Products that overflow.
    assert!(matches!(
        refuse(|p| p.n_actions = usize::MAX, &["n_states × n_actions", "20000000"]),
        MdpError::TooLarge { .. }
    ));
    assert!(matches!(refuse(|p| p.n_features = usize::MAX / 2, &["100000000"]), MdpError::TooLarge { .. }));
    refuse(|p| p.shape = Some([2, 2]), &["2 × 2", "2 states"]);
    refuse(|p| p.shape = Some([usize::MAX, 2]), &["2 states"]);
    refuse(|p| p.actions = vec!["one".into()], &["actions has 1", "2 are expected"]);
}

#[test]
fn discount_factors() {
    for gamma in [1.0, 1.5, -0.1, f64::NAN, f64::INFINITY, 1.0 - 1e-9] {
        assert!(matches!(refuse(|p| p.gamma = gamma, &["gamma is", "[0, 0.999999]"]), MdpError::Gamma { .. }));
    }
    let grid = GridWorld { gamma: 0.99999, ..GridWorld::one_hot(50, 50, &[0; 2500], 1) };
    assert_eq!(grid.mdp().unwrap_err(), MdpError::Horizon { gamma: 0.99999, n_states: 2500 });
}

#[test]
fn distributions() {
    refuse(|p| p.initial = vec![1.0], &["initial has 1", "2 are expected (n_states)"]);
    refuse(|p| p.initial = vec![0.5, 0.4], &["initial sums to 0.9"]);
    refuse(|p| p.initial = vec![1.5, -0.5], &["initial[0] is 1.5"]);
    refuse(|p| p.initial = vec![f64::NAN, 1.0], &["initial[0] is NaN"]);
}

#[test]
fn transitions() {
    let error = refuse(|p| p.transitions[2] = (2, 1, 1, 1.0), &["transition 2: state is 2", "0..2"]);
    assert_eq!(error, MdpError::OutOfRange { name: "transition", index: 2, what: "state", got: 2, below: 2 });
    refuse(|p| p.transitions[1] = (0, 7, 1, 0.5), &["transition 1: action is 7", "0..2"]);
    refuse(|p| p.transitions[0] = (0, 0, 9, 0.5), &["transition 0: target is 9", "0..2"]);
    for bad in [-0.5, f64::NAN, f64::INFINITY, 1.5] {
        let error = refuse(|p| p.transitions[1].3 = bad, &["transition 1 (0, 0 → 1)", "[0, 1]"]);
        assert!(matches!(error, MdpError::TransitionProbability { index: 1, state: 0, action: 0, target: 1, .. }));
    }
    refuse(|p| p.transitions[1].3 = 0.4, &["state 0, action 0 sum to 0.9", "1e-9"]);
    refuse(|p| p.transitions.push((0, 1, 1, 0.0)), &["(0, 1 → 1)", "twice"]);
    let twice = refuse(|p| p.transitions.push((0, 0, 1, 0.1)), &["(0, 0 → 1)", "twice"]);
    assert_eq!(twice, MdpError::Duplicate { state: 0, action: 0, target: 1 });
    let partly = refuse(|p| p.transitions.truncate(2), &["state 0", "action 1"]);
    assert_eq!(partly, MdpError::PartlyTerminal { state: 0, action: 1 });
    // A state whose transitions all have probability 0 is no terminal state.
    refuse(|p| p.transitions[2].3 = 0.0, &["state 0, action 1 sum to 0"]);
    // Within the tolerance all is well.
    let mut near = parts();
    near.transitions[1].3 = 0.5 + 9e-10;
    assert!(Mdp::new(near).is_ok());
}

#[test]
fn features() {
    refuse(|p| p.features = Features::State(vec![1.0; 3]), &["features has 3", "4 are expected"]);
    refuse(|p| p.features = Features::StateAction(vec![1.0; 4]), &["state_action_features has 4", "8 are expected"]);
    for bad in [f64::NAN, f64::NEG_INFINITY] {
        refuse(|p| p.features = Features::State(vec![1.0, bad, 0.0, 0.0]), &["features[1]", "finite"]);
    }
}

#[test]
fn json_texts() {
    let good = Mdp::new(parts()).unwrap().to_json();
    let refuse = |text: &str, words: &[&str]| {
        let message = Mdp::from_json(text.as_bytes()).unwrap_err().to_string();
        assert!(words.iter().all(|word| message.contains(word)), "`{message}` lacks one of {words:?}");
    };
    refuse("", &["decision process", "line 1"]);
    refuse("[1, 2", &["decision process"]);
    refuse("{}", &["missing field"]);
    refuse(&good.replace("\"gamma\":0.9", "\"gamma\":\"0.9\""), &["line 1", "string"]);
    refuse(&good.replace("\"gamma\":0.9", "\"gamma\":1e999"), &["line 1"]);
    refuse(&good.replace("\"gamma\":0.9", "\"gamma\":0.9,\"gamma\":0.8"), &["duplicate field `gamma`"]);
    refuse(&good.replace("\"gamma\":0.9", "\"gamma\":0.9,\"gama\":0.8"), &["unknown field `gama`"]);
    refuse(&good.replace("[0,1,1,1.0]", "[0,1,1]"), &["line 1"]);
    refuse(&good.replace("[0,1,1,1.0]", "[0,-1,1,1.0]"), &["-1"]);
    refuse(&good.replace("[[1.0,0.0],[0.0,1.0]]", "[[1.0,0.0],[0.0]]"), &["row 1 of features has 1", "2 are expected"]);
    refuse(&good.replace("[[1.0,0.0],[0.0,1.0]]", "[[],[]]"), &["n_features is 0"]);
    refuse(&good.replace("\"n_states\":2", "\"n_states\":99999999999"), &["99999999999"]);
    refuse(&good.replace("\"features\":[[1.0,0.0],[0.0,1.0]],", ""), &["neither is given"]);
    refuse(&good.replace("\"features\":", "\"state_action_features\":[[1.0]],\"features\":"), &["both are given"]);
    refuse(&"[".repeat(100_000), &["line 1"]);
}

#[test]
fn policies() {
    let mdp = Mdp::new(parts()).unwrap();
    let refuse = |policy: Policy, words: &[&str]| {
        let message = policy.check(&mdp).unwrap_err().to_string();
        assert!(words.iter().all(|word| message.contains(word)), "`{message}` lacks one of {words:?}");
        assert!(values(&mdp, &policy, &[1.0, 0.0]).is_err() && feature_counts(&mdp, &policy).is_err());
    };
    refuse(Policy::Deterministic(vec![0]), &["policy has 1", "2 are expected"]);
    refuse(Policy::Deterministic(vec![0, 2]), &["state 1: action is 2", "0..2"]);
    refuse(Policy::Stochastic(vec![0.5; 3]), &["policy has 3", "4 are expected"]);
    refuse(Policy::Stochastic(vec![0.5, 0.5, 0.5, 0.4]), &["state 1 sums to 0.9"]);
    refuse(Policy::Stochastic(vec![1.5, -0.5, 0.5, 0.5]), &["policy[0] is 1.5"]);
    refuse(Policy::Stochastic(vec![f64::NAN, 1.0, 0.5, 0.5]), &["policy[0] is NaN"]);
    let read = |text: &str| Policy::from_json(text.as_bytes(), &mdp);
    assert_eq!(read(r#"{"policy": [1, 0]}"#).unwrap(), Policy::Deterministic(vec![1, 0]));
    assert_eq!(read(r#"{"policy": [[1, 0], [0.5, 0.5]]}"#).unwrap(), Policy::Stochastic(vec![1.0, 0.0, 0.5, 0.5]));
    let message = |text: &str| read(text).unwrap_err().to_string();
    assert!(message(r#"{"policy": [[1, 0], [1]]}"#).contains("row 1 of policy has 1"));
    assert!(message(r#"{"policy": "up"}"#).contains("a list of actions, or a list of rows of probabilities"));
    assert!(message(r#"{"plan": [1]}"#).contains("plan"));
}

#[test]
fn arguments() {
    let mdp = Mdp::new(parts()).unwrap();
    let policy = Policy::uniform(&mdp);
    let message = |error: MdpError| error.to_string();
    assert!(message(values(&mdp, &policy, &[1.0]).unwrap_err()).contains("weights has 1 entries, but 2"));
    assert!(message(values(&mdp, &policy, &[1.0, f64::NAN]).unwrap_err()).contains("weights[1] is NaN"));
    assert!(message(policy_losses(&mdp, &[1.0], &[], 1).unwrap_err()).contains("feature_counts has 1"));
    assert!(message(policy_losses(&mdp, &[1.0, 2.0], &[1.0; 3], 1).unwrap_err()).contains("draws has 3"));
    assert!(message(policy_losses(&mdp, &[1.0, 2.0], &[f64::NAN; 2], 1).unwrap_err()).contains("draws[0]"));
    assert!(policy_losses(&mdp, &[1.0, 2.0], &[], 4).unwrap().is_empty());
    assert!(message(projection(&mdp, &[1.0], &policy, 0.1, 9).unwrap_err()).contains("expert feature counts has 1"));
    let mut rng = ChaCha8Rng::seed_from_u64(0);
    assert!(message(rollout(&mdp, &policy, 2, 5, &mut rng).unwrap_err()).contains("state is 2"));
    assert!(message(mdp::finite_optimum(&mdp, &[1.0, 0.0], 0, 1.0).unwrap_err()).contains("horizon is 0"));
    assert!(message(mdp::finite_optimum(&mdp, &[1.0, 0.0], 5, 1.1).unwrap_err()).contains("discount is 1.1"));
    assert!(message(mdp::finite_optimum(&mdp, &[1.0, 0.0], usize::MAX, 1.0).unwrap_err()).contains("horizon is"));
    assert!(mdp::improve_policy(&mdp, &policy, 5, |_| f64::NAN).is_err());
    assert!(GridWorld { slip: 0.6, ..chapter4::rep_0() }.mdp().is_err());
    assert!(GridWorld { starts: vec![], ..chapter4::rep_0() }.mdp().is_err());
    assert!(GridWorld { terminals: vec![81], ..chapter4::rep_0() }.mdp().is_err());
}

proptest! {
    #[test]
    fn arbitrary_bytes_never_panic(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        prop_assert!(Mdp::from_json(&bytes).is_err());
    }

    #[test]
    fn mutated_json_never_panics(
        edits in proptest::collection::vec((any::<usize>(), any::<u8>(), 0..3_u8), 1..4),
    ) {
        let mut text = Mdp::new(parts()).unwrap().to_json().into_bytes();
        for (at, byte, kind) in edits {
            let at = at % text.len();
            // Digits and punctuation keep many texts readable.
            let byte = b"0123456789-.,[]{}e\"ans"[usize::from(byte) % 22];
            match kind {
                0 => text[at] = byte,
                1 => text.insert(at, byte),
                _ => drop(text.remove(at)),
            }
        }
        // Whatever is accepted can be used.
        if let Ok(mdp) = Mdp::from_json(&text) {
            let w = vec![1.0; mdp.n_features()];
            prop_assert!(values(&mdp, &Policy::uniform(&mdp), &w).is_ok());
            mdp::Solver::new(&mdp).solve(&w);
        }
    }
}
