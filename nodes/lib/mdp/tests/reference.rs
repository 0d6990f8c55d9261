//! Exact values of the world "rep 0" of chapter 4 (method notes section 6).
#![allow(clippy::unwrap_used)]

use mdp::worlds::{UP, chapter4};
use mdp::{Policy, Solver, feature_counts, policy_losses, values};

fn close(got: f64, want: f64, tolerance: f64) {
    assert!((got - want).abs() <= tolerance, "{got}, but {want} is known");
}

#[test]
fn optimal_values_match() {
    let mdp = chapter4::rep_0().mdp().unwrap();
    let mut solver = Solver::new(&mdp);
    let optimum = solver.solve(&chapter4::REP_0_WEIGHTS);
    close(optimum.value(), 1.442_905_98, 5e-9);
    close(optimum.state_value(40), 1.355_526_92, 5e-9);
    let known = [0.174553, 1.169877, 0.791750, 0.254028, 0.561989, 5.740527, 1.001399, 0.305878];
    for (got, want) in optimum.feature_counts().iter().zip(known) {
        close(*got, want, 5e-7);
    }
    let policy = Policy::Deterministic(optimum.policy().to_vec());
    let again = values(&mdp, &policy, &chapter4::REP_0_WEIGHTS).unwrap();
    close(again[40], 1.355_526_92, 5e-9);
}

#[test]
fn loss_of_always_up_matches() {
    let mdp = chapter4::rep_0().mdp().unwrap();
    let up = Policy::Deterministic(vec![UP; mdp.n_states()]);
    let losses = policy_losses(&mdp, &feature_counts(&mdp, &up).unwrap(), &chapter4::REP_0_WEIGHTS, 2).unwrap();
    close(losses[0], 1.276_680_72, 5e-9);
}
