//! Policies ranked by what is certain of them.

use diagnostics::{normal_quantile, pareto_smooth};
use risk::{RankedPolicy, Ranking, RiskError, RiskOutcome, Tail, lower_bound, rank_policies, upper_bound};

use crate::draws::chains;

/// Draws of returns with normal marginals of the given means and 0.05-quantiles, one policy a pair.
fn returns(policies: &[(f64, f64)]) -> Vec<Vec<f64>> {
    let scores = policies.iter().enumerate().map(|(p, _)| chains(100 + p as u64, 4, 1000, 0.0));
    let score = -normal_quantile(0.05);
    policies
        .iter()
        .zip(scores)
        .map(|(&(mean, low), z)| z.iter().map(|z| mean + (mean - low) / score * z).collect())
        .collect()
}

fn rank(policies: &[Vec<f64>], delta: f64, tail: Tail) -> Ranking {
    let policies: Vec<&[f64]> = policies.iter().map(Vec::as_slice).collect();
    rank_policies(&policies, 4, None, 0.95, delta, tail).expect("finite draws")
}

fn order(ranking: &Ranking) -> Vec<usize> {
    ranking.policies.iter().map(|ranked| ranked.policy).collect()
}

fn warned(ranking: &Ranking) -> Vec<usize> {
    let mut warned: Vec<usize> =
        ranking.policies.iter().filter(|ranked| ranked.warning.is_some()).map(|ranked| ranked.policy).collect();
    warned.sort_unstable();
    warned
}

#[test]
fn a_policy_that_hacks_the_reward_comes_last_with_a_warning() {
    // A, B, C, D, No-Op of Table 6.7.
    let policies = returns(&[(17.1, 7.9), (22.7, 11.9), (45.5, 24.9), (57.6, 31.5), (102.5, -1557.1)]);
    let ranking = rank(&policies, 0.05, Tail::Lower);
    assert_eq!((order(&ranking), warned(&ranking)), (vec![3, 2, 1, 0, 4], vec![4]));
    let no_op = ranking.policies[4];
    assert!((no_op.mean - 102.5).abs() < 60.0 && (no_op.value_at_risk + 1557.1).abs() < 120.0, "{no_op:?}");
    let warning = no_op.warning.expect("a warning");
    assert!(warning.gap_ratio > 50.0 && warning.others_mean < 60.0 && warning.others_floor > 0.0, "{warning:?}");
    // It is the best policy under about half of the rewards.
    assert!((no_op.probability_best - 0.52).abs() < 0.05, "{}", no_op.probability_best);
}

#[test]
fn more_rankings_lift_the_warning() {
    // A, B, C, D, MAP, No-Op of Table 6.8, before and after both of the last two were ranked.
    let before = returns(&[(1.5, 0.5), (6.3, 3.7), (10.6, 5.8), (13.9, 6.2), (98.2, -370.2), (41.2, 1.0)]);
    assert_eq!(warned(&rank(&before, 0.05, Tail::Lower)), [4, 5]);
    let after = returns(&[(0.7, 0.3), (8.7, 5.5), (18.3, 12.1), (26.3, 17.1), (606.8, 289.1), (-5.0, -13.5)]);
    let ranking = rank(&after, 0.05, Tail::Lower);
    assert_eq!((order(&ranking), warned(&ranking)), (vec![4, 3, 2, 1, 0, 5], vec![]));
}

#[test]
fn losses_rank_the_other_way_round() {
    let returns = returns(&[(17.1, 7.9), (45.5, 24.9), (57.6, 31.5), (102.5, -1557.1)]);
    let losses: Vec<Vec<f64>> = returns.iter().map(|draws| draws.iter().map(|x| -x).collect()).collect();
    let (by_return, by_loss) = (rank(&returns, 0.05, Tail::Lower), rank(&losses, 0.05, Tail::Upper));
    assert_eq!((order(&by_return), warned(&by_return)), (order(&by_loss), warned(&by_loss)));
    for (gain, loss) in by_return.policies.iter().zip(&by_loss.policies) {
        assert_eq!(gain.outcome.bound(), loss.outcome.bound().map(|x| -x));
        assert_eq!((gain.mean, gain.probability_best), (-loss.mean, loss.probability_best));
    }
}

#[test]
fn all_bounds_share_delta() {
    let policies = returns(&[(1.0, 0.0), (2.0, -1.0), (3.0, -5.0)]);
    let ranking = rank(&policies, 0.06, Tail::Lower);
    assert_eq!(ranking.delta_each, 0.06 / 3.0);
    for ranked in &ranking.policies {
        let alone = lower_bound(&policies[ranked.policy], 4, 0.95, 0.06 / 3.0).expect("finite draws");
        assert_eq!(ranked.outcome.bound(), alone.bound());
        assert!(ranked.outcome.bound().expect("a bound") < ranked.value_at_risk);
    }
    let ranking = rank(&policies, 0.06, Tail::Upper);
    let alone = upper_bound(&policies[0], 4, 0.95, 0.06 / 3.0).expect("finite draws");
    let first = ranking.policies.iter().find(|ranked| ranked.policy == 0).expect("it is ranked");
    assert_eq!(first.outcome.bound(), alone.bound());
}

#[test]
fn policies_without_a_bound_come_last() {
    let mut policies = returns(&[(1.0, 0.0), (50.0, 40.0), (60.0, 50.0)]);
    for policy in [1, 2] {
        policies[policy][..1000].iter_mut().for_each(|x| *x += 30.0);
    }
    let ranking = rank(&policies, 0.05, Tail::Lower);
    assert_eq!(order(&ranking), [0, 2, 1]);
    assert!(matches!(ranking.policies[1].outcome, RiskOutcome::NotMixed(_)));
    assert_eq!(ranking.policies[0].probability_best, 0.0);
}

#[test]
fn equally_good_policies_share_the_probability_of_being_best() {
    let policies = returns(&[(1.0, 0.0), (-90.0, -91.0)]);
    let twice = [policies[0].clone(), policies[1].clone(), policies[0].clone()];
    let ranking = rank(&twice, 0.05, Tail::Lower);
    assert_eq!(order(&ranking), [0, 2, 1]);
    let probabilities = ranking.policies.iter().map(|ranked: &RankedPolicy| ranked.probability_best);
    for (got, want) in probabilities.zip([0.5, 0.5, 0.0]) {
        assert!((got - want).abs() < 1e-12, "{got}");
    }
}

#[test]
fn weights_decide_who_is_best() {
    // One posterior draw each: the first policy is better where the draw is positive.
    let draws = chains(3, 4, 2500, 0.0);
    let other: Vec<f64> = draws.iter().map(|x| -x).collect();
    let log_weights: Vec<f64> = draws.iter().map(|x| 0.5 * x).collect();
    let weights = pareto_smooth(&log_weights).expect("finite weights");
    let policies: [&[f64]; 2] = [&draws, &other];
    let ranking = rank_policies(&policies, 4, Some(&weights), 0.9, 0.05, Tail::Lower).expect("finite draws");
    let first = ranking.policies[0];
    // Under the weights the draw has mean ½, so that it is positive with probability Φ(½) = 0.6915.
    assert!(first.policy == 0 && (first.probability_best - 0.6915).abs() < 0.02, "{first:?}");
    assert!((first.mean - 0.5).abs() < 0.05 && first.outcome.bound().is_some());
}

#[test]
fn refuses_bad_input() {
    let policies = returns(&[(1.0, 0.0), (2.0, 0.0)]);
    let refused = |policies: &[&[f64]]| {
        rank_policies(policies, 4, None, 0.95, 0.05, Tail::Lower).expect_err("refused").to_string()
    };
    assert_eq!(refused(&[]), "no policies given, but at least one is needed");
    assert_eq!(refused(&[&policies[0], &policies[1][..8]]), "policy 1 has 8 draws, but policy 0 has 4000");
    let mut broken = policies[1].clone();
    broken[17] = f64::INFINITY;
    assert_eq!(refused(&[&policies[0], &broken]), "draw 17 of policy 1 is inf, not a finite number");
    assert_eq!(
        rank_policies(&[&policies[0]], 3, None, 0.95, 0.05, Tail::Lower),
        Err(RiskError::TooFewChains { got: 3 })
    );
}
