//! Bounds through a dominating distribution: they hold for every measure, on independent and on autocorrelated chains.

use risk::{Measure, RiskError, RiskOutcome, Sample, Tail, risk_bound, risk_bounds, upper_bound};

use crate::draws::chains;

const DELTA: f64 = 0.05;

/// Each measure with its value for a loss uniform on (0, 1).
fn measures() -> [(Measure, f64); 5] {
    [
        (Measure::Mean, 0.5),
        (Measure::ValueAtRisk { alpha: 0.9 }, 0.9),
        (Measure::ConditionalValueAtRisk { alpha: 0.9 }, 0.95),
        (Measure::Entropic { aversion: 3.0 }, ((3.0_f64.exp() - 1.0) / 3.0).ln() / 3.0),
        // E (U − ½)₊ = ⅛.
        (Measure::Semideviation { coefficient: 0.8 }, 0.5 + 0.8 / 8.0),
    ]
}

/// Autocorrelated chains of losses uniform on (0, 1).
fn uniform_chains(seed: u64, per_chain: usize, rho: f64) -> Vec<f64> {
    chains(seed, 4, per_chain, rho).iter().map(|z| 0.5 * libm::erfc(-z / 2.0_f64.sqrt())).collect()
}

fn sample(values: &[f64]) -> Sample<'_> {
    Sample { values, n_chains: 4, weights: None }
}

/// Shares of 400 worlds in which bounds were issued, each measure's bound held, all held together, and the empirical
/// distribution function stayed within the shift, over the worlds with bounds.
fn coverage(per_chain: usize, rho: f64) -> (f64, [f64; 5], f64, f64) {
    let worlds = 400;
    let (mut issued, mut each, mut together, mut within) = (0.0, [0.0; 5], 0.0, 0.0);
    for seed in 0..worlds {
        let draws = uniform_chains(seed, per_chain, rho);
        let asked = measures().map(|(measure, _)| measure);
        let outcomes = risk_bounds(&sample(&draws), &asked, DELTA, Some(1.0), Tail::Upper).expect("finite chains");
        let Some(bounds) = outcomes.iter().map(RiskOutcome::bound).collect::<Option<Vec<f64>>>() else {
            continue;
        };
        issued += 1.0;
        let held: Vec<bool> = bounds.iter().zip(measures()).map(|(bound, (_, truth))| *bound >= truth).collect();
        for (count, held) in each.iter_mut().zip(&held) {
            *count += f64::from(u8::from(*held));
        }
        together += f64::from(u8::from(held.iter().all(|held| *held)));
        // The true distribution function of a uniform loss is its value.
        let mut sorted = draws;
        sorted.sort_unstable_by(f64::total_cmp);
        let n = sorted.len() as f64;
        let excess = sorted.iter().zip(1..).map(|(x, rank)| f64::from(rank) / n - x).fold(0.0, f64::max);
        within += f64::from(u8::from(excess <= outcomes[0].receipt().shift));
        assert!(bounds.iter().all(|bound| *bound < 1.0), "a bound that says nothing: {bounds:?}");
    }
    (issued / worlds as f64, each.map(|count| count / issued), together / issued, within / issued)
}

#[test]
fn covers_on_independent_chains() {
    let (issued, each, together, within) = coverage(500, 0.0);
    // Independent chains miss R̂ ≤ 1.01 now and then.
    assert!(issued > 0.9, "issued {issued}");
    assert!(each.iter().all(|share| *share >= 0.95) && together >= 0.95, "{each:?} {together}");
    // The promise about the whole distribution is kept, and not by being needlessly wide (3 standard errors: 3.3 %).
    assert!((0.93..0.99).contains(&within), "{within}");
}

#[test]
fn covers_on_autocorrelated_chains() {
    let (issued, each, together, within) = coverage(3000, 0.9);
    assert!(issued > 0.5, "issued {issued}");
    assert!(each.iter().all(|share| *share >= 0.95) && together >= 0.95, "{each:?} {together}");
    assert!((0.93..=1.0).contains(&within), "{within}");
}

#[test]
fn taking_all_draws_for_independent_would_not_cover() {
    let worlds = 300;
    let within: u32 = (0..worlds)
        .map(|seed| {
            let mut sorted = uniform_chains(seed, 3000, 0.9);
            sorted.sort_unstable_by(f64::total_cmp);
            let n = sorted.len() as f64;
            let excess = sorted.iter().zip(1..).map(|(x, rank)| f64::from(rank) / n - x).fold(0.0, f64::max);
            u32::from(excess <= risk::distribution_shift(sorted.len(), DELTA))
        })
        .sum();
    assert!(f64::from(within) < 0.7 * worlds as f64, "{within} of {worlds}");
}

#[test]
fn the_bound_is_the_measure_of_the_shifted_distribution() {
    let draws = uniform_chains(3, 2500, 0.0);
    for (measure, truth) in measures() {
        let outcome = risk_bound(&sample(&draws), measure, DELTA, Some(1.0), Tail::Upper).expect("finite chains");
        let RiskOutcome::Bound(bound) = outcome else { panic!("{outcome:?}") };
        assert!(bound.value > bound.receipt.point_estimate && (bound.receipt.point_estimate - truth).abs() < 0.02);
    }
    // For the mean of a uniform loss: ε moved from the lowest ε of values to 1 adds about ε.
    let measure = Measure::Mean;
    let RiskOutcome::Bound(bound) =
        risk_bound(&sample(&draws), measure, DELTA, Some(1.0), Tail::Upper).expect("finite chains")
    else {
        panic!("independent draws are enough")
    };
    let shift = bound.receipt.shift;
    assert!((bound.value - bound.receipt.mean - shift * (1.0 - shift / 2.0)).abs() < 0.02 * shift);
    // Moved to 10 instead, it adds 10 ε.
    let far = risk_bound(&sample(&draws), measure, DELTA, Some(10.0), Tail::Upper).expect("finite chains");
    assert!((far.bound().expect("a bound") - bound.value - 9.0 * shift).abs() < 1e-9);
}

#[test]
fn the_value_at_risk_alone_is_the_order_statistic() {
    for (seed, rho) in [(1, 0.0), (2, 0.5), (3, 0.9)] {
        let draws = uniform_chains(seed, 2500, rho);
        let measure = Measure::ValueAtRisk { alpha: 0.95 };
        let ours = risk_bound(&sample(&draws), measure, DELTA, None, Tail::Upper).expect("finite chains");
        let plain = upper_bound(&draws, 4, 0.95, DELTA).expect("finite chains");
        assert_eq!(ours.bound(), plain.bound());
        let (ours, plain) = (ours.receipt(), plain.receipt());
        assert_eq!((ours.ess, ours.rhat, ours.needed), (plain.ess, plain.rhat, plain.needed));
        assert_eq!(ours.point_estimate, plain.point_estimate);
    }
}

#[test]
fn returns_mirror_losses() {
    let losses = uniform_chains(5, 2500, 0.3);
    let returns: Vec<f64> = losses.iter().map(|x| 4.0 - x).collect();
    for (measure, _) in measures() {
        let upper = risk_bound(&sample(&losses), measure, DELTA, Some(1.0), Tail::Upper).expect("finite chains");
        let lower = risk_bound(&sample(&returns), measure, DELTA, Some(3.0), Tail::Lower).expect("finite chains");
        let (upper_bound, lower_bound) = (upper.bound().expect("a bound"), lower.bound().expect("a bound"));
        assert!((lower_bound - (4.0 - upper_bound)).abs() < 1e-9, "{measure:?}: {upper_bound} {lower_bound}");
        assert!((lower.receipt().point_estimate - (4.0 - upper.receipt().point_estimate)).abs() < 1e-9);
        assert!((lower.receipt().mean - (4.0 - upper.receipt().mean)).abs() < 1e-9);
    }
}

#[test]
fn says_what_is_missing() {
    let draws = uniform_chains(7, 500, 0.0);
    let ask = |values: &[f64], measure, worst| {
        risk_bound(&sample(values), measure, DELTA, worst, Tail::Upper).expect("finite chains")
    };
    // Nothing bounds the mean of a loss that may be arbitrarily large, but its quantiles.
    assert!(matches!(ask(&draws, Measure::Mean, None), RiskOutcome::Unbounded(_)));
    assert!(ask(&draws, Measure::ValueAtRisk { alpha: 0.95 }, None).bound().is_some());
    // A tail of 1 % takes ln 20 / (2 · 0.01²) = 14,979 draws before its mean is bounded by less than the worst case.
    let outcome = ask(&draws, Measure::ConditionalValueAtRisk { alpha: 0.99 }, Some(1.0));
    assert!(matches!(outcome, RiskOutcome::NotEnoughSamples(_)) && outcome.receipt().needed == 14_979, "{outcome:?}");
    assert!(matches!(
        ask(&draws[..360], Measure::Mean, Some(1.0)),
        RiskOutcome::NotEnoughSamples(_) | RiskOutcome::NotMixed(_)
    ));
    let mut apart = draws.clone();
    apart[..500].iter_mut().for_each(|x| *x *= 0.5);
    assert!(matches!(ask(&apart, Measure::Mean, None), RiskOutcome::NotMixed(_)));
}

#[test]
fn refuses_bad_input() {
    let draws = uniform_chains(7, 500, 0.0);
    let refused = |sample: &Sample<'_>, measure, delta, worst, tail| {
        risk_bound(sample, measure, delta, worst, tail).expect_err("refused")
    };
    let good = sample(&draws);
    assert!(matches!(
        refused(&good, Measure::Mean, DELTA, Some(0.5), Tail::Upper),
        RiskError::BeyondWorst { worst: 0.5, got, .. } if got > 0.5
    ));
    // A smallest possible return of one half.
    assert!(matches!(
        refused(&good, Measure::Mean, DELTA, Some(0.5), Tail::Lower),
        RiskError::BeyondWorst { worst: 0.5, got, .. } if got < 0.5
    ));
    assert!(matches!(
        refused(&good, Measure::Mean, DELTA, Some(f64::NAN), Tail::Upper),
        RiskError::Parameter { name: "the worst possible value", .. }
    ));
    assert_eq!(
        refused(&good, Measure::Mean, 1.0, Some(1.0), Tail::Upper),
        RiskError::Level { name: "delta", got: 1.0 }
    );
    assert!(matches!(
        refused(&good, Measure::Semideviation { coefficient: 2.0 }, DELTA, Some(1.0), Tail::Upper),
        RiskError::Parameter { .. }
    ));
    assert_eq!(
        refused(&Sample { n_chains: 2, ..good }, Measure::Mean, DELTA, Some(1.0), Tail::Upper),
        RiskError::TooFewChains { got: 2 }
    );
    // Rounding of whoever computed the draws is forgiven.
    let largest = draws.iter().copied().fold(0.0, f64::max);
    assert!(risk_bound(&good, Measure::Mean, DELTA, Some(largest * (1.0 - 1e-12)), Tail::Upper).is_ok());
}
