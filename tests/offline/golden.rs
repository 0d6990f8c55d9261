//! Numbers that are known from elsewhere: by hand, or exact values of the method notes.

use crate::command::{Folder, Uniform, at, lines, list, text};
use mdp::worlds::chapter4;

/// Method notes, section 6.
const PAIRS: &str = "state,action\n10,0\n1,2\n0,0\n9,0\n11,2\n2,2\n";

fn rep_0(folder: &Folder) {
    let mdp = chapter4::rep_0().mdp().expect("a process");
    folder.write("world.json", mdp.to_json());
    folder.write("pairs.csv", PAIRS);
    let row = |w: &[f64]| w.iter().map(|w| format!("{w:?}")).collect::<Vec<_>>().join(",");
    let weights = format!("{}\n{}\n", row(&[-0.125; 8]), row(&chapter4::REP_0_WEIGHTS));
    folder.write("weights.csv", weights);
}

#[test]
fn action_log_likelihoods_are_those_of_the_method_notes() {
    let folder = Folder::new();
    rep_0(&folder);
    let likelihood = |more: &str| {
        let line = format!("likelihood --mdp world.json --demonstrations pairs.csv --weights weights.csv {more}");
        list(&folder.json(&line), "/log_likelihood")
    };
    for (beta, want) in [("1", -6.91010309), ("10", -2.36513127), ("100", -0.67867086)] {
        let got = likelihood(&format!("--beta {beta}"));
        assert!((got[0] - -8.31776617).abs() < 5e-9, "{got:?}");
        assert!((got[1] - want).abs() < 5e-9, "{got:?}");
    }
    // A repeat counts, unless the author's program is to be repeated.
    folder.write("pairs.csv", format!("{PAIRS}10,0\n10,0\n"));
    let all = likelihood("--beta 10")[1];
    assert!((likelihood("--beta 10 --reproduce")[1] - -2.36513127).abs() < 5e-9);
    folder.write("pairs.csv", "10,0\n");
    let one = likelihood("--beta 10")[1];
    assert!((all - -2.36513127 - 2.0 * one).abs() < 1e-8);
    // Judged bad: one minus the probability. Wrong answers: mixed with one in four.
    folder.write("pairs.csv", "10,0,bad\n");
    assert!((likelihood("--beta 10")[1] - (1.0 - one.exp()).ln()).abs() < 1e-9);
    folder.write("pairs.csv", "10,0\n");
    assert!((likelihood("--beta 10 --wrong-rate 0.2")[1] - (0.8 * one.exp() + 0.05).ln()).abs() < 1e-9);
}

#[test]
fn values_of_the_world_are_those_of_the_method_notes() {
    let folder = Folder::new();
    rep_0(&folder);
    let truth: Vec<String> = chapter4::REP_0_WEIGHTS.iter().map(|w| format!("{w:?}")).collect();
    folder.write("truth.csv", truth.join(","));
    folder.write("up.json", format!("{{\"policy\": {:?}}}", [0; 81]));
    let answer = folder.json("evaluate --mdp world.json --draws truth.csv --policy up.json");
    assert!((list(&answer, "/losses")[0] - 1.27668072).abs() < 5e-9, "{}", answer["losses"]);
    assert!((at(&answer, "/return/mean") + at(&answer, "/loss/mean") - 1.44290598).abs() < 5e-9);
    // A single draw says nothing of a quantile, and is no error.
    assert_eq!(text(&answer, "/outcome"), "not_enough_samples");
    // The expert of the method notes loses nothing.
    let expert = "0.174553,1.169877,0.791750,0.254028,0.561989,5.740527,1.001399,0.305878\n";
    folder.write("expert.csv", expert);
    let answer = folder.json("evaluate --mdp world.json --draws truth.csv --feature-counts expert.csv");
    assert!(list(&answer, "/losses")[0].abs() < 1e-6, "{}", answer["losses"]);
}

#[test]
fn preference_log_likelihoods_are_those_of_bradley_terry() {
    let folder = Folder::new();
    folder.write("features.csv", "1,0\n0,1\n3,-1\n");
    folder.write("weights.csv", "0.6,0.8\n-1,0\n");
    folder.write("pairs.csv", "0,1,sure\n1,2,0.5\n");
    let likelihood = |more: &str| {
        let line = format!("likelihood --features features.csv --weights weights.csv {more}");
        list(&folder.json(&line), "/log_likelihood")
    };
    let s = |d: f64| -(-d).exp().ln_1p();
    let close = |got: f64, want: f64| assert!((got - want).abs() < 1e-12, "{got} {want}");
    // Returns under (0.6, 0.8): 0.6, 0.8, 1; under (−1, 0): −1, 0, −3.
    let got = likelihood("--preferences pairs.csv --beta 2");
    close(got[0], s(2.0 * 0.2) + s(0.5 * 2.0 * 0.2));
    close(got[1], s(2.0) + s(0.5 * 2.0 * -3.0));
    // A ranking is all its pairs; attempts of a learner count half.
    folder.write("order.csv", "0,1,2\n");
    close(likelihood("--rankings order.csv")[0], s(0.2) + s(0.4) + s(0.2));
    close(likelihood("--progress order.csv")[0], s(0.1) + s(0.2) + s(0.1));
    close(likelihood("--progress order.csv --progress-confidence 1 --beta-progress 3")[0], s(0.6) + s(1.2) + s(0.6));
    // Kinds add up, each with its own rationality.
    let both = likelihood("--preferences pairs.csv --progress order.csv --beta 2 --beta-progress 4");
    close(both[0], s(0.4) + s(0.2) + s(0.4) + s(0.8) + s(0.4));
    // Verdicts: threshold 1 where the file has them, and as given.
    folder.write("verdicts.csv", "less,more,verdict\n0,1,strict\n0,2,equal\n");
    let logistic = |x: f64| 1.0 / (1.0 + (-x).exp());
    let equal = |d: f64, t: f64| ((2.0 * t).exp_m1() * logistic(d - t) * logistic(-d - t)).ln();
    close(likelihood("--preferences verdicts.csv")[0], s(0.2 - 1.0) + equal(0.4, 1.0));
    close(likelihood("--preferences verdicts.csv --equal-threshold 0.3")[0], s(0.2 - 0.3) + equal(0.4, 0.3));
    folder.write("verdicts.csv", "0,1,sure,cant-tell\n");
    let cannot = |d: f64, share: f64| (4.0 * share * logistic(d) * logistic(-d)).ln();
    close(likelihood("--preferences verdicts.csv")[0], cannot(0.2, 0.5));
    close(likelihood("--preferences verdicts.csv --cant-tell 0.25")[0], cannot(0.2, 0.25));
    let mixed = (0.9 * logistic(0.2) + 0.05).ln() + (0.9 * logistic(0.1) + 0.05).ln();
    close(likelihood("--preferences pairs.csv --wrong-rate 0.1")[0], mixed);
}

/// Draws that alternate about every level are worth as many as there are, so that the index is that of the table.
#[test]
fn order_statistics_are_those_of_the_method_notes() {
    let folder = Folder::new();
    for (n, alpha, index) in [(500_u32, 0.90, 462), (1000, 0.99, 996), (2000, 0.95, 1917), (10_000, 0.95, 9537)] {
        // A low-discrepancy order: each stretch of a chain covers the whole range evenly.
        let values = (0..n).map(|i| (i.reverse_bits() >> 12) as f64);
        let mut ascending: Vec<f64> = values.clone().collect();
        ascending.sort_by(f64::total_cmp);
        folder.write("losses.csv", lines(values.clone()));
        let line = format!("bound --losses losses.csv --alpha {alpha}");
        let answer = folder.json(&line);
        assert_eq!(at(&answer, "/ess"), f64::from(n), "{answer}");
        assert_eq!(at(&answer, "/index"), f64::from(index), "{answer}");
        assert_eq!(at(&answer, "/bound"), ascending[index as usize - 1]);
        // As returns: counted from the other end.
        folder.write("returns.csv", lines(values.map(|x| -x)));
        let mirrored = folder.json(&format!("bound --losses returns.csv --tail lower --alpha {alpha}"));
        assert_eq!(at(&mirrored, "/bound"), -ascending[index as usize - 1]);
        assert_eq!(at(&mirrored, "/index"), f64::from(n + 1 - index));
    }
    for (n, needed) in [(58, 400.0), (59, 400.0), (396, 400.0)] {
        folder.write("losses.csv", lines(Uniform(9).take(n)));
        let answer = folder.json("bound --losses losses.csv");
        assert_eq!((text(&answer, "/outcome"), at(&answer, "/needed")), ("not_enough_samples", needed), "{n}");
        assert!(answer["bound"].is_null() && answer["index"].is_null());
    }
}
