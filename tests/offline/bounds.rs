//! Bounds: what they say of losses whose distribution is known, and when there is none.

use crate::command::{Folder, Uniform, at, lines, text};

#[test]
fn measures_bound_what_is_known() {
    let folder = Folder::new();
    folder.write("losses.csv", lines(Uniform(1).take(8000)));
    let judge = |more: &str| folder.json(&format!("bound --losses losses.csv --alpha 0.9 {more}"));
    // Uniform on [0, 1]: VaR .9, CVaR .95, mean 1/2, entropic ln(e − 1), semideviation 1/2 + 1/8.
    let cases = [
        ("--measure var", 0.9),
        ("--measure cvar --worst 1", 0.95),
        ("--measure mean --worst 1", 0.5),
        ("--measure entropic --aversion 1 --worst 1", (1.0_f64.exp() - 1.0).ln()),
        ("--measure semideviation --coefficient 1 --worst 1", 0.625),
    ];
    for (flags, truth) in cases {
        let answer = judge(flags);
        let (bound, estimate) = (at(&answer, "/bound"), at(&answer, "/point_estimate"));
        assert!((estimate - truth).abs() < 0.02, "{flags}: {answer}");
        assert!(bound > truth && bound < truth + 0.03 && bound > estimate, "{flags}: {answer}");
    }
    assert!((at(&judge(""), "/cvar") - 0.95).abs() < 0.01);
    let answer = judge("--measure cvar");
    assert_eq!((text(&answer, "/outcome"), answer["bound"].is_null()), ("unbounded", true));
    assert!(text(&answer, "/reason").contains("--worst"));
    // From below: a lower bound on a return.
    let answer = folder.json("bound --losses losses.csv --alpha 0.9 --tail lower --measure cvar --worst 0");
    assert!((at(&answer, "/point_estimate") - 0.05).abs() < 0.01);
    assert!(at(&answer, "/bound") < 0.05 && at(&answer, "/bound") > 0.02);
    assert!(
        folder.refused("bound --losses losses.csv --measure mean --worst 0.5").contains("0.5 was said to be the worst")
    );
}

#[test]
fn later_looks_spend_less() {
    let folder = Folder::new();
    folder.write("losses.csv", lines(Uniform(2).take(4000)));
    let answer = folder.json("bound --losses losses.csv --delta 0.05 --look 3");
    let spent = 6.0 * 0.05 / (std::f64::consts::PI.powi(2) * 9.0);
    assert!((at(&answer, "/delta_spent") - spent).abs() < 1e-15);
    let plain = folder.json(&format!("bound --losses losses.csv --delta {spent:?}"));
    assert_eq!(answer["bound"], plain["bound"]);
    assert!(at(&answer, "/bound") > at(&folder.json("bound --losses losses.csv"), "/bound"));
}

#[test]
fn chains_that_disagree_give_no_bound() {
    let folder = Folder::new();
    let apart = Uniform(3).take(4000).enumerate().map(|(i, x)| x + (i / 1000) as f64);
    folder.write("losses.csv", lines(apart));
    let answer = folder.json("bound --losses losses.csv");
    assert_eq!(text(&answer, "/outcome"), "not_mixed");
    assert!(answer["bound"].is_null() && at(&answer, "/rhat") > 1.5);
    // Correlated draws are worth fewer.
    let mut x = 0.0;
    let walk = Uniform(4).take(1200).map(|u| {
        x = 0.95 * x + u - 0.5;
        x
    });
    folder.write("losses.csv", lines(walk));
    let answer = folder.json("bound --losses losses.csv");
    assert_ne!(text(&answer, "/outcome"), "bound");
    assert!(at(&answer, "/ess") < 200.0, "{answer}");
}

#[test]
fn few_chains_are_an_answer_and_odd_numbers_a_question() {
    let folder = Folder::new();
    folder.write("losses.csv", lines(Uniform(5).take(3000)));
    let answer = folder.json("bound --losses losses.csv --chains 1");
    assert_eq!(text(&answer, "/outcome"), "not_mixed");
    assert!(text(&answer, "/reason").contains("1 chain cannot show"), "{answer}");
    assert!(at(&answer, "/point_estimate") > 0.9);
    folder.write("losses.csv", lines(Uniform(5).take(495)));
    let refused = folder.refused("bound --losses losses.csv");
    assert!(refused.contains("the 495 draws in losses.csv do not divide into 4 chains"), "{refused}");
    assert_eq!(at(&folder.json("bound --losses losses.csv --chains 5"), "/n_chains"), 5.0);
    folder.refused("bound --losses losses.csv --chains 0");
}

#[test]
fn weights_move_the_bound_and_bad_ones_are_told() {
    let folder = Folder::new();
    let n = 4000;
    let losses: Vec<f64> = Uniform(6).take(n).collect();
    folder.write("losses.csv", lines(losses.iter().copied()));
    folder.write("flat.csv", lines(std::iter::repeat_n(2.5, n)));
    let plain = folder.json("bound --losses losses.csv");
    let flat = folder.json("bound --losses losses.csv --weights flat.csv");
    assert!((at(&plain, "/bound") - at(&flat, "/bound")).abs() < 0.005, "{plain} {flat}");
    // Weight e^x on the loss x: its .95-quantile is ln(1 + .95 (e − 1)).
    folder.write("tilted.csv", lines(losses.iter().map(|x| x.exp())));
    folder.write("logarithms.csv", lines(losses.iter().copied()));
    let truth = (0.95 * 1.0_f64.exp_m1()).ln_1p();
    let tilted = folder.json("bound --losses losses.csv --weights tilted.csv");
    assert!((at(&tilted, "/point_estimate") - truth).abs() < 0.01 && at(&tilted, "/bound") > truth, "{tilted}");
    let logarithms = folder.json("bound --losses losses.csv --log-weights logarithms.csv");
    assert!((at(&tilted, "/bound") - at(&logarithms, "/bound")).abs() < 1e-3);
    folder.write("extreme.csv", lines(losses.iter().map(|x| 40.0 * x * x)));
    let extreme = folder.json("bound --losses losses.csv --log-weights extreme.csv");
    assert_ne!(text(&extreme, "/outcome"), "bound", "{extreme}");
    folder.write("short.csv", "1\n2\n");
    assert!(
        folder
            .refused("bound --losses losses.csv --weights short.csv")
            .contains("has 2 weights, but losses.csv has 4000")
    );
    folder.write("negative.csv", lines(losses.iter().map(|x| x - 0.5)));
    assert!(folder.refused("bound --losses losses.csv --weights negative.csv").contains("expected 0 or more"));
}
