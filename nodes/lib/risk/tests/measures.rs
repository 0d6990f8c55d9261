//! Risk measures against what is known in closed form, and the axioms that make one envelope serve them all.

use proptest::prelude::{Strategy, prop_assert, prop_assert_eq, proptest};
use risk::{Distribution, Measure, RiskError, Tail, cvar, value_at_risk};

fn close(got: f64, want: f64) {
    assert!((got - want).abs() < 1e-12 * want.abs().max(1.0), "{got} vs {want}");
}

#[test]
fn a_coin_has_known_risks() {
    // 0 with probability 0.9, 10 with 0.1.
    let coin = Distribution::weighted(&[0.0, 10.0], &[9.0, 1.0]).expect("values");
    let upper = |measure: Measure| measure.of(&coin, Tail::Upper).expect("in range");
    let lower = |measure: Measure| measure.of(&coin, Tail::Lower).expect("in range");
    close(upper(Measure::Mean), 1.0);
    assert_eq!(upper(Measure::ValueAtRisk { alpha: 0.9 }), 0.0);
    assert_eq!(upper(Measure::ValueAtRisk { alpha: 0.91 }), 10.0);
    close(upper(Measure::ConditionalValueAtRisk { alpha: 0.8 }), 5.0);
    close(upper(Measure::ConditionalValueAtRisk { alpha: 0.95 }), 10.0);
    let entropic = |theta: f64| (0.9 + 0.1 * (10.0 * theta).exp()).ln() / theta;
    close(upper(Measure::Entropic { aversion: 0.7 }), entropic(0.7));
    close(lower(Measure::Entropic { aversion: 0.7 }), entropic(-0.7));
    // Mean 1, E(X − 1)₊ = 0.9 = E(1 − X)₊.
    close(upper(Measure::Semideviation { coefficient: 0.5 }), 1.45);
    close(lower(Measure::Semideviation { coefficient: 0.5 }), 0.55);
    close(lower(Measure::ConditionalValueAtRisk { alpha: 0.05 }), 0.5 / 0.95);
    assert_eq!(lower(Measure::ValueAtRisk { alpha: 0.05 }), 10.0);
    assert_eq!(lower(Measure::ValueAtRisk { alpha: 0.11 }), 0.0);
}

#[test]
fn entropic_risk_runs_from_the_mean_to_the_worst_case() {
    let x = Distribution::equal(&[-1.0, 0.0, 4.0]).expect("values");
    let risk = |aversion| Measure::Entropic { aversion }.of(&x, Tail::Upper).expect("in range");
    // Mean + θ variance / 2 for small θ: variance 14/3 at n = 3.
    close(risk(1e-12), 1.0 + 0.5e-12 * 14.0 / 3.0);
    assert!((risk(1e-4) - (1.0 + 0.5e-4 * 14.0 / 3.0)).abs() < 1e-7);
    // Largest − ln(3)/θ for large θ.
    close(risk(1e6), 4.0 - 3.0_f64.ln() / 1e6);
    assert!(
        risk(0.299).is_finite() && (risk(0.333_333) - risk(0.333_334)).abs() < 1e-5,
        "no jump between the two forms"
    );
}

#[test]
fn parameters_outside_their_range_are_refused() {
    let x = Distribution::equal(&[1.0]).expect("values");
    let refused = |measure: Measure| measure.of(&x, Tail::Upper).expect_err("refused").to_string();
    assert_eq!(
        refused(Measure::Semideviation { coefficient: 1.5 }),
        "the semideviation's coefficient is 1.5, but must be from 0 to 1"
    );
    assert_eq!(refused(Measure::Entropic { aversion: 0.0 }), "the risk aversion is 0, but must be positive and finite");
    assert_eq!(
        Measure::ValueAtRisk { alpha: 1.0 }.of(&x, Tail::Upper),
        Err(RiskError::Level { name: "alpha", got: 1.0 })
    );
    assert!(Measure::Entropic { aversion: f64::INFINITY }.of(&x, Tail::Lower).is_err());
}

fn any_measure() -> impl Strategy<Value = Measure> {
    (0..5, 0.01..0.99_f64).prop_map(|(which, parameter)| match which {
        0 => Measure::Mean,
        1 => Measure::ValueAtRisk { alpha: parameter },
        2 => Measure::ConditionalValueAtRisk { alpha: parameter },
        3 => Measure::Entropic { aversion: 3.0 * parameter },
        _ => Measure::Semideviation { coefficient: parameter },
    })
}

proptest! {
    #[test]
    fn agrees_with_the_order_statistics(values in proptest::collection::vec(-10.0..10.0_f64, 1..200), alpha in 0.01..0.99_f64) {
        let x = Distribution::equal(&values).expect("values");
        let mut sorted = values;
        sorted.sort_unstable_by(f64::total_cmp);
        for tail in [Tail::Upper, Tail::Lower] {
            let of = |measure: Measure| measure.of(&x, tail).expect("in range");
            prop_assert_eq!(Some(of(Measure::ValueAtRisk { alpha })), value_at_risk(&sorted, alpha, tail));
            let tail_mean = of(Measure::ConditionalValueAtRisk { alpha });
            prop_assert!((tail_mean - cvar(&sorted, alpha, tail).expect("values")).abs() < 1e-9);
        }
    }

    /// Raising any value never lowers a risk: what makes a dominating distribution a bound on all of them.
    #[test]
    fn measures_are_monotone(
        points in proptest::collection::vec((-5.0..5.0_f64, 0.01..1.0_f64, 0.0..2.0_f64), 1..40),
        measure in any_measure(),
    ) {
        let weights: Vec<f64> = points.iter().map(|p| p.1).collect();
        let low = Distribution::weighted(&points.iter().map(|p| p.0).collect::<Vec<_>>(), &weights).expect("values");
        let high = Distribution::weighted(&points.iter().map(|p| p.0 + p.2).collect::<Vec<_>>(), &weights).expect("values");
        for tail in [Tail::Upper, Tail::Lower] {
            let (low, high) = (measure.of(&low, tail).expect("in range"), measure.of(&high, tail).expect("in range"));
            prop_assert!(high >= low - 1e-9, "{measure:?} {tail:?}: {low} {high}");
        }
    }

    #[test]
    fn measures_lie_between_mean_and_worst_case_and_move_with_the_values(
        values in proptest::collection::vec(-5.0..5.0_f64, 1..40),
        measure in any_measure(),
        shift in -3.0..3.0_f64,
    ) {
        let x = Distribution::equal(&values).expect("values");
        let shifted = Distribution::equal(&values.iter().map(|v| v + shift).collect::<Vec<_>>()).expect("values");
        let risk = measure.of(&x, Tail::Upper).expect("in range");
        prop_assert!((measure.of(&shifted, Tail::Upper).expect("in range") - risk - shift).abs() < 1e-9);
        prop_assert!(risk <= x.largest() + 1e-9);
        let averse = !matches!(measure, Measure::ValueAtRisk { .. });
        prop_assert!(!averse || risk >= x.mean() - 1e-9);
        let mirrored = measure.of(&x.negated(), Tail::Lower).expect("in range");
        prop_assert!((mirrored + risk).abs() < 1e-12);
    }

    #[test]
    fn equal_values_risk_that_value(value in -5.0..5.0_f64, n in 1_usize..50, measure in any_measure()) {
        let x = Distribution::equal(&vec![value; n]).expect("values");
        prop_assert!(measure.of(&x, Tail::Upper).expect("in range") == value);
    }
}
