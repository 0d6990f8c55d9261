//! The same optima as HiGHS (SciPy 1.17) on the dense form F.1–F.4, and as HiGHS on F.6 and F.18.
#![allow(clippy::unwrap_used)]

mod common;

use common::{close, shape};
use robust::{MethodChoice, Objective, Outcome, Problem, Settings, Signs, lpal};

/// Problem, α, λ, whether draws are weighted, objective, optimum, E(return) and CVaR there.
type Known = (u64, f64, f64, bool, &'static str, f64, f64, f64);

#[rustfmt::skip]
const OPTIMA: [Known; 40] = [
    (1, 0.95, 0.0, false, "robust", 1.630463740916, 4.386888395, 1.630463741),
    (1, 0.9, 0.5, false, "robust", 3.217240188618, 4.537120638, 1.897359740),
    (1, 0.5, 0.2, true, "robust", 3.532885390586, 4.672077569, 3.248087346),
    (1, 0.95, 0.3, false, "regret", 2.262927216129, 4.492445630, 1.307419324),
    (1, 0.8, 0.0, true, "regret", 2.075227754050, 4.610724563, 2.075227754),
    (1, 0.9, 0.1, false, "evd", -0.736288676593, 4.346750090, -1.301070762),
    (1, 0.0, 0.4, false, "robust", 4.537120637605, 4.537120638, 4.537120638),
    (1, 0.99, 1.0, false, "robust", 4.537120637605, 4.537120638, 1.206982869),
    (2, 0.95, 0.0, false, "robust", 0.0, 0.0, 0.0),
    (2, 0.9, 0.5, false, "robust", 5.164563422373, 10.406652954, -0.077526109),
    (2, 0.5, 0.2, true, "robust", 6.949682784582, 10.755983677, 5.998107562),
    (2, 0.95, 0.3, false, "regret", 2.609389468513, 10.341976423, -0.704576369),
    (2, 0.8, 0.0, true, "regret", 2.223052089944, 10.656362775, 2.223052090),
    (2, 0.9, 0.1, false, "evd", -9.712824824707, 10.377199030, -11.945049697),
    (2, 0.0, 0.4, false, "robust", 10.429143354125, 10.429143354, 10.429143354),
    (2, 0.99, 1.0, false, "robust", 10.429143354125, 10.429143354, -1.889611308),
    (3, 0.95, 0.0, false, "robust", -0.169106952341, 0.064784054, -0.169106952),
    (3, 0.9, 0.5, false, "robust", -0.000873886330, 0.409118290, -0.410866063),
    (3, 0.5, 0.2, true, "robust", 0.155962986880, 0.619955541, 0.039964848),
    (3, 0.95, 0.3, false, "regret", -0.729609546654, 0.017562110, -1.049825971),
    (3, 0.8, 0.0, true, "regret", -0.446969133782, -0.049733479, -0.446969134),
    (3, 0.9, 0.1, false, "evd", -2.427859752664, 0.773312090, -2.783545513),
    (3, 0.0, 0.4, false, "robust", 0.928648678363, 0.928648678, 0.928648678),
    (3, 0.99, 1.0, false, "robust", 0.928648678363, 0.928648678, -4.525568048),
    (4, 0.95, 0.0, false, "robust", 0.0, 0.0, 0.0),
    (4, 0.9, 0.5, false, "robust", 2.354562696551, 7.368915903, -2.659790510),
    (4, 0.5, 0.2, true, "robust", 3.694782315845, 9.274894411, 2.299754292),
    (4, 0.95, 0.3, false, "regret", 0.070009637827, 4.701712394, -1.915005829),
    (4, 0.8, 0.0, true, "regret", 0.0, 0.022139659, 0.0),
    (4, 0.9, 0.1, false, "evd", -39.451781497560, 9.128545119, -44.849595566),
    (4, 0.0, 0.4, false, "robust", 13.208510099502, 13.208510100, 13.208510100),
    (4, 0.99, 1.0, false, "robust", 13.208510099502, 13.208510100, -51.798359483),
    (5, 0.95, 0.0, false, "robust", 0.749020778147, 1.437056198, 0.749020778),
    (5, 0.9, 0.5, false, "robust", 1.165195682479, 1.471233566, 0.859157799),
    (5, 0.5, 0.2, true, "robust", 1.228562870625, 1.461199340, 1.170403753),
    (5, 0.95, 0.3, false, "regret", 0.478086388424, 1.443025153, 0.064541204),
    (5, 0.8, 0.0, true, "regret", 0.551708651254, 1.460179124, 0.551708651),
    (5, 0.9, 0.1, false, "evd", 0.092993944937, 1.468115039, -0.059797288),
    (5, 0.0, 0.4, false, "robust", 1.471233565725, 1.471233566, 1.471233566),
    (5, 0.99, 1.0, false, "robust", 1.471233565725, 1.471233566, 0.543383494),
];

/// Problem, margin of F.6, margin of F.18.
const MARGINS: [(u64, f64, f64); 5] = [
    (1, -1.600914658076, -1.600914658076),
    (2, 5.198013589950, 0.0),
    (3, -0.561740142022, -0.618736468534),
    (4, 1.168797696251, 0.0),
    (5, -1.087362451763, -1.446730017319),
];

#[test]
fn both_methods_reach_the_optimum() {
    for (seed, alpha, lambda, weighted, name, optimum, mean, cvar) in OPTIMA {
        let case = shape(seed).case();
        let objective = match name {
            "robust" => Objective::Robust,
            "regret" => Objective::Regret { expert: &case.expert },
            _ => Objective::Loss,
        };
        assert_eq!(objective.name(), name);
        let weights = weighted.then_some(&case.weights[..]);
        let problem = Problem::new(&case.mdp, &case.draws, weights, objective, 2).unwrap();
        for method in [MethodChoice::ColumnGeneration, MethodChoice::Direct] {
            let settings = Settings { method, ..Settings::default() };
            let solution = problem.solve(alpha, lambda, &settings).unwrap();
            let which = format!("problem {seed}, α {alpha}, λ {lambda}, {name}, {method:?}: {solution:?}");
            assert_eq!(solution.outcome, Outcome::Optimal, "{which}");
            assert!(solution.gap() <= 1e-8 * solution.unit, "{which}");
            assert!((solution.objective - optimum).abs() <= 2e-8 * solution.unit, "{which}");
            close(solution.expected_return, mean, 1e-5 * solution.unit);
            // With λ = 1 the tail is whatever the tail of the best policy is, not the solver's σ and z.
            close(solution.conditional_value_at_risk, cvar, 1e-5 * solution.unit);
            assert!(solution.value_at_risk >= solution.conditional_value_at_risk);
        }
    }
}

#[test]
fn apprentices_reach_the_largest_margin() {
    for (seed, positive, unknown) in MARGINS {
        let case = shape(seed).case();
        for method in [MethodChoice::ColumnGeneration, MethodChoice::Direct, MethodChoice::Automatic] {
            let settings = Settings { method, ..Settings::default() };
            for (signs, margin) in [(Signs::Positive, positive), (Signs::Unknown, unknown)] {
                let found = lpal(&case.mdp, &case.expert, signs, &settings).unwrap();
                assert_eq!(found.outcome, Outcome::Optimal);
                close(found.margin, margin, 1e-7);
                let above = found.feature_counts.iter().zip(&case.expert).map(|(x, e)| x - e);
                let worst = match signs {
                    Signs::Positive => above.fold(f64::INFINITY, f64::min),
                    Signs::Unknown => above.fold(0.0, |worst, x| f64::min(worst, -x.abs())),
                };
                close(found.margin, worst, 1e-12);
                found.policy.check(&case.mdp).unwrap();
            }
        }
    }
}
