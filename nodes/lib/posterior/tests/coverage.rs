//! Bounds on policy loss hold over random worlds: the loss of any data-dependent policy under the true reward lies below its
//! posterior α-quantile in a share α of the worlds, and below issued bounds at least as often.

mod support;

use likelihood::actions::ActionLikelihood;
use mdp::{Policy, Solver, feature_counts, policy_losses};
use posterior::{EvidenceKind, Model, Prior, Rationality, Run, Term, TermLikelihood, draw};
use risk::{Tail, upper_bound, value_at_risk};
use support::{generator, grid, in_parallel, l1_sphere, taken};

const WORLDS: u64 = 200;
const BETA: f64 = 12.0;

/// α, fewest and most successes of a calibrated quantile in 200 worlds, fewest of an issued bound (method notes section 3).
const LEVELS: [(f64, usize, usize, usize); 3] = [(0.90, 165, 192, 166), (0.95, 179, 198, 179), (0.99, 192, 200, 192)];

/// Per level: whether the quantile covers the true loss, and the issued bound if there is one.
fn one_world(world: u64, assumed_beta: f64) -> [(bool, Option<bool>); 3] {
    let mut generator = generator(90, world);
    let mdp = grid(3, 0.9, &mut generator);
    let w = l1_sphere(3, &mut generator);
    let choices = taken(&mdp, &w, BETA, (12, 16), &mut generator);
    let likelihood = ActionLikelihood::new(&mdp, choices).expect("good choices");
    let terms = vec![Term {
        kind: EvidenceKind::Actions,
        rationality: Rationality::Fixed(assumed_beta),
        likelihood: TermLikelihood::Actions(likelihood),
    }];
    let model = Model { n_features: 3, prior: Prior::L1Sphere, nonnegative_return: None, terms };
    let run = Run { n_draws: 4000, n_chains: 4, warmup: 200, threads: 1 };
    let draws = draw(&model, &run, world, &[6; 32]).expect("draws");
    // The robot's policy is the best one for the mean reward.
    let mut solver = Solver::new(&mdp);
    let policy = Policy::Deterministic(solver.solve(&draws.mean_weights()).policy().to_vec());
    let counts = feature_counts(&mdp, &policy).expect("a policy of this world");
    let truth = policy_losses(&mdp, &counts, &w, 1).expect("a good reward")[0];
    let losses = policy_losses(&mdp, &counts, &draws.values, 1).expect("good rewards");
    let mut sorted = losses.clone();
    sorted.sort_unstable_by(f64::total_cmp);
    // Both losses may be zero but for rounding.
    let covers = |bound: f64| bound >= truth - 1e-9;
    LEVELS.map(|(alpha, ..)| {
        let quantile = value_at_risk(&sorted, alpha, Tail::Upper).expect("there are draws");
        let bound = upper_bound(&losses, 4, alpha, 0.05).expect("good losses").bound();
        (covers(quantile), bound.map(covers))
    })
}

#[test]
fn quantiles_and_bounds_cover_the_true_loss() {
    let worlds = in_parallel(WORLDS, |world| one_world(world, BETA));
    for (level, (alpha, least, most, least_bounds)) in LEVELS.into_iter().enumerate() {
        let covered = worlds.iter().filter(|world| world[level].0).count();
        // Losses of zero are covered always, so only the lower end can be missed.
        assert!(
            covered >= least,
            "alpha {alpha}: the quantile covers {covered} of {WORLDS}, {least} to {most} expected"
        );
        let issued = worlds.iter().filter(|world| world[level].1.is_some()).count();
        let held = worlds.iter().filter(|world| world[level].1 == Some(true)).count();
        assert!(issued >= 190, "alpha {alpha}: only {issued} bounds were issued");
        let needed = least_bounds * issued / WORLDS as usize;
        assert!(held >= needed, "alpha {alpha}: {held} of {issued} bounds hold, {needed} expected");
    }
}

#[test]
fn a_doubled_beta_breaks_the_coverage() {
    // A person taken for eight times as rational as they are: the bounds are too sure of themselves.
    let worlds = in_parallel(WORLDS, |world| one_world(world, 8.0 * BETA));
    let missed = LEVELS
        .iter()
        .enumerate()
        .any(|(level, (_, least, ..))| worlds.iter().filter(|world| world[level].0).count() < *least);
    assert!(missed, "a wrong rationality goes unnoticed");
}
