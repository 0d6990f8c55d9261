//! The bound keeps its promise on autocorrelated chains, where the printed rule does not; and its outcomes.

use diagnostics::{SeriesError, normal_quantile};
use proptest::prelude::{prop_assert, prop_assert_eq, proptest};
use risk::{Outcome, RiskError, Tail, lower_bound, quantile, upper_bound, value_at_risk};

use crate::draws::chains;

#[test]
fn covers_on_autocorrelated_chains_where_the_printed_rule_fails() {
    let (alpha, delta) = (0.95, 0.05);
    let truth = normal_quantile(alpha);
    let (mut issued, mut covered, mut printed) = (0.0, 0.0, 0.0);
    let worlds = 400;
    for seed in 0..worlds {
        let draws = chains(seed, 4, 3000, 0.9);
        if let Some(bound) = upper_bound(&draws, 4, alpha, delta).expect("finite chains").bound() {
            issued += 1.0;
            covered += f64::from(u8::from(bound >= truth));
        }
        let mut sorted = draws;
        sorted.sort_unstable_by(f64::total_cmp);
        let literal = quantile(1.0 - delta, sorted.len() as u64, alpha) as usize;
        printed += f64::from(u8::from(sorted[literal - 1] >= truth));
    }
    assert!(issued >= 0.7 * worlds as f64, "only {issued} bounds issued");
    assert!(covered / issued >= 0.93, "covers {}", covered / issued);
    assert!(covered / issued <= 0.99, "needlessly wide: covers {}", covered / issued);
    assert!(printed / (worlds as f64) < 0.85, "the printed rule covers {}", printed / worlds as f64);
}

#[test]
fn independent_draws_give_the_tabulated_index() {
    let draws = chains(5, 4, 1000, 0.0);
    let Outcome::Bound(bound) = upper_bound(&draws, 4, 0.95, 0.05).expect("finite chains") else {
        panic!("independent draws are enough");
    };
    // For n_e = 4000 the index is 3824; a little else when some autocorrelation is suspected.
    assert!((3820..3835).contains(&bound.index), "{}", bound.index);
    assert!(bound.value > bound.receipt.point_estimate && bound.receipt.cvar > bound.receipt.point_estimate);
    assert!(bound.receipt.mean.abs() < 0.1 && bound.receipt.rhat < 1.01);
    assert_eq!((bound.receipt.n, bound.receipt.needed), (4000, 400));
}

#[test]
fn says_what_is_missing() {
    let few = chains(1, 4, 90, 0.0);
    let outcome = upper_bound(&few, 4, 0.95, 0.05).expect("finite chains");
    // 360 draws: R-hat may be anything, but never a bound.
    assert_eq!((outcome.bound(), outcome.receipt().needed), (None, 400));
    let sticky = chains(2, 4, 20_000, 0.999);
    assert!(upper_bound(&sticky, 4, 0.95, 0.05).expect("finite chains").bound().is_none());
    // Four well-mixing chains of 2000, but worth too little for a 0.999 quantile.
    let outcome = upper_bound(&chains(3, 4, 1000, 0.0), 4, 0.999, 0.05).expect("finite chains");
    assert!(matches!(outcome, Outcome::NotEnoughSamples(_)), "{outcome:?}");
    assert_eq!(outcome.receipt().needed, 5990);
    // One chain elsewhere.
    let mut draws = chains(4, 4, 1000, 0.0);
    draws[..1000].iter_mut().for_each(|x| *x += 1.0);
    assert!(matches!(upper_bound(&draws, 4, 0.95, 0.05).expect("finite chains"), Outcome::NotMixed(_)));
}

#[test]
fn equal_losses_are_bounded_by_themselves() {
    for value in [0.0, 0.3, -7.0] {
        let Outcome::Bound(bound) = upper_bound(&[value; 4000], 4, 0.95, 0.05).expect("finite chains") else {
            panic!("equal losses are enough");
        };
        assert_eq!((bound.value, bound.receipt.rhat, bound.receipt.ess), (value, 1.0, 4000.0));
        assert_eq!((bound.receipt.cvar, bound.receipt.point_estimate), (value, value));
    }
}

#[test]
fn refuses_bad_input() {
    let mut draws = vec![0.0; 4000];
    assert_eq!(upper_bound(&draws, 3, 0.95, 0.05), Err(RiskError::TooFewChains { got: 3 }));
    assert_eq!(upper_bound(&draws, 4, 1.0, 0.05), Err(RiskError::Level { name: "alpha", got: 1.0 }));
    assert!(matches!(upper_bound(&draws, 4, 0.95, f64::NAN), Err(RiskError::Level { name: "delta", .. })));
    assert_eq!(
        upper_bound(&draws, 7, 0.95, 0.05),
        Err(RiskError::Series(SeriesError::Ragged { n: 4000, n_chains: 7 }))
    );
    draws[3] = f64::NAN;
    let error = upper_bound(&draws, 4, 0.95, 0.05).expect_err("refused");
    assert_eq!(error.to_string(), "draw 3 is NaN, not a finite number");
}

proptest! {
    #[test]
    fn the_lower_bound_mirrors_the_upper(seed in 0_u64..100, alpha in 0.8..0.97_f64) {
        let draws = chains(seed, 4, 300, 0.2);
        let negated: Vec<f64> = draws.iter().map(|x| -x).collect();
        let upper = upper_bound(&draws, 4, alpha, 0.05).expect("finite chains");
        let lower = lower_bound(&negated, 4, alpha, 0.05).expect("finite chains");
        prop_assert_eq!(upper.bound(), lower.bound().map(|x| -x));
        if let (Outcome::Bound(upper), Outcome::Bound(lower)) = (upper, lower) {
            prop_assert_eq!(lower.index, 1201 - upper.index);
            let mut sorted = negated.clone();
            sorted.sort_unstable_by(f64::total_cmp);
            prop_assert_eq!(sorted[lower.index - 1], lower.value);
            prop_assert_eq!(value_at_risk(&sorted, alpha, Tail::Lower), Some(lower.receipt.point_estimate));
        }
    }

    #[test]
    fn more_confidence_never_lowers_the_bound(seed in 0_u64..100) {
        let draws = chains(seed, 4, 400, 0.0);
        let bound = |delta| upper_bound(&draws, 4, 0.9, delta).expect("finite chains").bound();
        if let (Some(loose), Some(tight)) = (bound(0.1), bound(0.01)) {
            prop_assert!(tight >= loose);
        }
    }
}
