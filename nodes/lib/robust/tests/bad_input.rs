//! Bad input gives one clear error that says what, where, got and expected.
#![allow(clippy::unwrap_used)]

mod common;

use mdp::{Features, Mdp, MdpError, MdpParts, Policy};
use robust::{
    Bootstrap, Horizon, MaxEntropySettings, Objective, Problem, RobustError, Settings, Signs, expert_feature_counts,
    lpal, max_entropy, optimal_policy, out_of_sample, performance,
};

fn error(draws: &[f64], weights: Option<&[f64]>, objective: Objective<'_>) -> RobustError {
    Problem::new(&common::shape(1).case().mdp, draws, weights, objective, 1).unwrap_err()
}

#[test]
fn of_draws() {
    let good = common::shape(1).case().draws;
    assert_eq!(error(&[], None, Objective::Robust).to_string(), "no draws given, but at least one is needed");
    assert_eq!(
        error(&good[..7], None, Objective::Robust).to_string(),
        "draws: 7 numbers are no whole number of rows of 3, one weight per feature of the process"
    );
    for (bad, text) in [(f64::NAN, "NaN"), (f64::INFINITY, "inf"), (f64::NEG_INFINITY, "-inf")] {
        let mut draws = good.clone();
        draws[4] = bad;
        let expected = format!("draws: number 4 is {text}, but must be finite");
        assert_eq!(error(&draws, None, Objective::Robust).to_string(), expected);
    }
    let mut draws = good.clone();
    draws[5] = 1e200;
    assert!(matches!(error(&draws, None, Objective::Robust), RobustError::TooLarge { index: 5, .. }));
}

#[test]
fn of_weights() {
    let case = common::shape(1).case();
    let with = |weights: &[f64]| error(&case.draws, Some(weights), Objective::Robust).to_string();
    assert_eq!(with(&[1.0]), "posterior weights: 1 numbers, but 60 are expected (one per draw)");
    let mut weights = vec![1.0 / 60.0; 60];
    weights[3] = -0.1;
    assert_eq!(with(&weights), "posterior weight 3 is -0.1, but must be at least 0");
    weights[3] = 0.5;
    assert!(with(&weights).starts_with("posterior weights sum to 1.48333333333333"), "{}", with(&weights));
    weights[3] = f64::NAN;
    assert_eq!(with(&weights), "posterior weights: number 3 is NaN, but must be finite");
    assert!(with(&[0.0; 60]).starts_with("posterior weights sum to 0,"));
}

#[test]
fn of_experts() {
    let case = common::shape(1).case();
    let regret = |expert: &[f64]| error(&case.draws, None, Objective::Regret { expert }).to_string();
    assert_eq!(regret(&[1.0]), "expert feature counts: 1 numbers, but 3 are expected (one per feature)");
    assert_eq!(regret(&[0.0, f64::NAN, 0.0]), "expert feature counts: number 1 is NaN, but must be finite");
    let counts = |demonstrations: &[Vec<(usize, usize)>], discount| {
        expert_feature_counts(&case.mdp, demonstrations, discount).unwrap_err().to_string()
    };
    assert_eq!(counts(&[], 0.9), "no demonstrations given, but at least one is needed");
    assert_eq!(counts(&[vec![]], 0.9), "no steps in a demonstration given, but at least one is needed");
    assert_eq!(
        counts(&[vec![(0, 0)], vec![(0, 1), (12, 0)]], 0.9),
        "demonstration 1, step 1: state 12, but must be below 12"
    );
    assert_eq!(counts(&[vec![(0, 2)]], 0.9), "demonstration 0, step 0: action 2, but must be below 2");
    assert_eq!(counts(&[vec![(0, 1)]], 1.5), "discount is 1.5, but must be from 0 to 1");
}

#[test]
fn of_levels_and_settings() {
    let case = common::shape(1).case();
    let problem = Problem::new(&case.mdp, &case.draws, None, Objective::Robust, 1).unwrap();
    let settings = Settings::default();
    for alpha in [-0.1, 1.0, 1.5, f64::NAN] {
        let text = problem.solve(alpha, 0.5, &settings).unwrap_err().to_string();
        assert_eq!(text, format!("alpha is {alpha}, but must be at least 0 and less than 1"));
        assert!(problem.risk_of(&[0.0; 3], alpha, 0.5).is_err());
    }
    for lambda in [-0.1, 1.1, f64::NAN] {
        let text = problem.solve(0.9, lambda, &settings).unwrap_err().to_string();
        assert_eq!(text, format!("lambda is {lambda}, but must be from 0 to 1"));
        assert!(problem.frontier(0.9, &[0.5, lambda], &settings).is_err());
    }
    let text = problem.frontier(0.9, &[], &settings).unwrap_err().to_string();
    assert_eq!(text, "no lambdas given, but at least one is needed");
    let text = problem.frontier(0.9, &vec![0.5; 10_001], &settings).unwrap_err().to_string();
    assert_eq!(text, "number of lambdas is 10001, but at most 10000 are handled");
    for bad in [
        Settings { tolerance: 0.0, ..settings },
        Settings { tolerance: f64::NAN, ..settings },
        Settings { max_rounds: 0, ..settings },
        Settings { max_iterations: 0, ..settings },
    ] {
        assert!(matches!(problem.solve(0.9, 0.5, &bad), Err(RobustError::Range { .. })), "{bad:?}");
    }
    assert!(matches!(problem.risk_of(&[0.0; 2], 0.9, 0.5), Err(RobustError::Length { got: 2, expected: 3, .. })));
    assert!(matches!(problem.distribution(&[0.0, 0.0, f64::NAN]), Err(RobustError::NotFinite { index: 2, .. })));
    let short = Policy::Deterministic(vec![0; 3]);
    assert!(matches!(problem.risk(&short, 0.9, 0.5), Err(RobustError::Process(MdpError::Length { .. }))));
}

#[test]
fn of_processes() {
    // What is no process at all never gets here.
    let parts = |gamma, p| MdpParts {
        gamma,
        n_states: 2,
        n_actions: 1,
        n_features: 1,
        initial: vec![1.0, 0.0],
        transitions: vec![(0, 0, 1, p), (1, 0, 1, 1.0)],
        features: Features::State(vec![0.0, 1.0]),
        actions: vec![],
        shape: None,
    };
    assert!(matches!(Mdp::new(parts(1.0, 1.0)), Err(MdpError::Gamma { .. })));
    assert!(matches!(Mdp::new(parts(0.9, 0.9)), Err(MdpError::TransitionSum { state: 0, .. })));
}

#[test]
fn of_baselines() {
    let case = common::shape(1).case();
    let settings = MaxEntropySettings::dissertation(&case.mdp);
    assert!(matches!(max_entropy(&case.mdp, &[0.0], &settings), Err(RobustError::Length { .. })));
    assert!(matches!(max_entropy(&case.mdp, &[f64::NAN; 3], &settings), Err(RobustError::NotFinite { .. })));
    for bad in [
        MaxEntropySettings { rationality: 0.0, ..settings },
        MaxEntropySettings { rationality: f64::INFINITY, ..settings },
        MaxEntropySettings { tolerance: 0.0, ..settings },
        MaxEntropySettings { horizon: Horizon::Steps(0), ..settings },
    ] {
        assert!(matches!(max_entropy(&case.mdp, &case.expert, &bad), Err(RobustError::Range { .. })), "{bad:?}");
    }
    let long = MaxEntropySettings { horizon: Horizon::Steps(usize::MAX), ..settings };
    assert!(matches!(max_entropy(&case.mdp, &case.expert, &long), Err(RobustError::Size { .. })));
    let bad = lpal(&case.mdp, &[0.0], Signs::Unknown, &Settings::default());
    assert!(matches!(bad, Err(RobustError::Length { .. })));
    assert!(matches!(optimal_policy(&case.mdp, &[0.0; 4]), Err(RobustError::Length { .. })));
}

#[test]
fn of_samples() {
    let case = common::shape(1).case();
    let bootstrap = Bootstrap::default();
    let text = |values: &[f64], n_chains, alpha, bootstrap: &Bootstrap| {
        out_of_sample(values, n_chains, None, alpha, bootstrap).unwrap_err().to_string()
    };
    assert_eq!(text(&[], 0, 0.9, &bootstrap), "no values given, but at least one is needed");
    assert_eq!(text(&[1.0, f64::NAN], 0, 0.9, &bootstrap), "values: number 1 is NaN, but must be finite");
    assert_eq!(text(&[1.0; 7], 2, 0.9, &bootstrap), "7 draws do not divide into 2 chains of equal length");
    assert!(text(&[1.0], 0, 1.0, &bootstrap).starts_with("alpha is 1"));
    let sure = Bootstrap { confidence: 1.0, ..bootstrap };
    assert_eq!(text(&[1.0], 0, 0.9, &sure), "confidence is 1, but must be strictly between 0 and 1");
    let few = Bootstrap { replicates: 5, ..bootstrap };
    assert_eq!(text(&[1.0], 0, 0.9, &few), "replicates is 5, but must be from 100 to 100000");
    let weights = out_of_sample(&[1.0, 2.0], 0, Some(&[1.0]), 0.9, &bootstrap);
    assert!(matches!(weights, Err(RobustError::Length { .. })));
    let bad = performance(&case.mdp, &case.draws, Objective::Robust, &[0.0; 2], 1);
    assert!(matches!(bad, Err(RobustError::Length { got: 2, expected: 3, .. })));
    assert!(matches!(
        performance(&case.mdp, &[], Objective::Robust, &[0.0; 3], 1),
        Err(RobustError::Empty { what: "draws" })
    ));
}
