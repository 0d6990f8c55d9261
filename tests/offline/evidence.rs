//! What `apprentice infer` makes of evidence: of all kinds, of none, of evidence that contradicts itself.

use crate::command::{Folder, at, errors, list, text};

const TRAJECTORIES: &str = "infer --features config/examples/trajectories.csv";
const KITCHEN: &str = "--mdp config/examples/kitchen.json";

#[test]
fn an_exact_posterior_is_found() {
    // One answer about w on the circle: w = (cos a, sin a), P ∝ 1/(1 + e^{−2 cos a}); E cos a = ∫ cos a P / ∫ P.
    let folder = Folder::new();
    folder.write("features.csv", "0,0\n1,0\n");
    folder.write("pairs.csv", "0,1\n");
    let n = 10_000;
    let (mut mean, mut total) = (0.0, 0.0);
    for i in 0..n {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(n);
        let p = 1.0 / (1.0 + (-2.0 * angle.cos()).exp());
        mean += p * angle.cos();
        total += p;
    }
    for sampler in ["hmc --draws 20000", "l2-walk --sigma 1 --burn-in 100 --every 3 --draws 20000"] {
        let line = format!("infer --features features.csv --preferences pairs.csv --beta 2 --sampler {sampler}");
        let answer = folder.json(&line);
        assert_eq!(text(&answer, "/outcome"), "ready", "{answer}");
        let (got, error) = (at(&answer, "/mean/0"), at(&answer, "/mcse/0"));
        assert!(
            (got - mean / total).abs() < 4.0 * error && error < 0.01,
            "{sampler}: {got} ± {error}, {}",
            mean / total
        );
        assert!(at(&answer, "/mean/1").abs() < 4.0 * at(&answer, "/mcse/1"));
    }
}

#[test]
fn the_walk_and_hmc_agree_about_actions() {
    let folder = Folder::new();
    let line =
        format!("infer {KITCHEN} --demonstrations config/examples/demonstrations.csv --beta 3 --prior l1-sphere");
    let hmc = folder.json(&format!("{line} --draws 8000"));
    let walk = folder.json(&format!("{line} --sampler l1-walk --step 0.2 --burn-in 500 --every 20 --draws 8000"));
    assert_eq!((text(&hmc, "/outcome"), text(&walk, "/outcome")), ("ready", "ready"), "{walk}");
    for k in 0..3 {
        let value = |answer| (at(answer, &format!("/mean/{k}")), at(answer, &format!("/mcse/{k}")));
        let ((a, a_error), (b, b_error)) = (value(&hmc), value(&walk));
        assert!(
            (a - b).abs() < 4.0 * (a_error * a_error + b_error * b_error).sqrt(),
            "{k}: {a} ± {a_error}, {b} ± {b_error}"
        );
    }
    assert!((at(&hmc, "/log_likelihood_mean") - at(&walk, "/log_likelihood_mean")).abs() < 0.1);
    // The most probable weights are found to within a thousandth of a nat.
    assert!(at(&hmc, "/map_log_likelihood") >= at(&walk, "/map_log_likelihood") - 1e-3);
}

#[test]
fn all_kinds_stand_together() {
    let folder = Folder::new();
    let line = format!(
        "{TRAJECTORIES} --preferences config/examples/opinions.csv --rankings config/examples/rankings.csv --progress \
         config/examples/progress.csv {KITCHEN} --demonstrations config/examples/demonstrations.csv --critiques \
         config/examples/critiques.csv --beta 5 --beta-preferences learn --beta-actions learn:20:0.5 --wrong-rate 0.05"
    );
    let answer = folder.json(&line);
    assert_eq!(text(&answer, "/outcome"), "ready", "{answer}");
    // Rankings of five and three: 10 and 3 pairs beside the 6 answers; attempts of four and three: 6 and 3.
    for (kind, n) in [("actions", 5.0), ("preferences", 19.0), ("critiques", 4.0), ("progress", 9.0)] {
        assert_eq!(at(&answer, &format!("/evidence/{kind}")), n, "{kind}");
    }
    assert!(answer["beta"].is_null());
    let beta = |kind: &str, key: &str| at(&answer, &format!("/betas/{kind}/{key}"));
    assert_eq!((beta("critiques", "mean"), beta("progress", "q95")), (5.0, 5.0));
    for kind in ["preferences", "actions"] {
        assert!(beta(kind, "q05") < beta(kind, "mean") && beta(kind, "mean") < beta(kind, "q95"), "{answer}");
    }
    assert_eq!((beta("actions", "prior/median"), beta("actions", "prior/log_sd")), (20.0, 0.5));
    assert_eq!((beta("preferences", "prior/median"), beta("preferences", "prior/log_sd")), (10.0, 2.0));
    let model = &answer["answer_model"];
    assert_eq!((at(model, "/equal_threshold"), at(model, "/cant_tell"), at(model, "/wrong_rate")), (1.0, 0.5, 0.05));
    // What everybody said: the cup is good, the puddle is bad.
    let mean = list(&answer, "/mean");
    assert!(mean[0] > 0.3 && mean[2] < -0.3, "{mean:?}");
    // The draws' log-likelihood is that of `likelihood`.
    let fixed = line.replace("infer", "likelihood").replace("learn:20:0.5", "20").replace("learn", "10");
    let map: Vec<String> = list(&answer, "/map").iter().map(|w| format!("{w:?}")).collect();
    folder.write("map.csv", map.join(","));
    let betas = |kind: &str| beta(kind, "map");
    let fixed = fixed.replace("--beta-actions 20", &format!("--beta-actions {:?}", betas("actions")));
    let fixed = fixed.replace("--beta-preferences 10", &format!("--beta-preferences {:?}", betas("preferences")));
    let of_map = list(&folder.json(&format!("{fixed} --weights map.csv")), "/log_likelihood")[0];
    assert!((of_map - at(&answer, "/map_log_likelihood")).abs() < 1e-9, "{of_map}");
}

#[test]
fn a_learned_beta_follows_its_evidence() {
    // Forty answers about one difference, all alike: the person is consistent; then every second one the other way round.
    let folder = Folder::new();
    folder.write("features.csv", "0,0\n1,0\n0,1\n");
    let consistent = "0,1\n0,2\n2,1\n".repeat(13);
    folder.write("consistent.csv", &consistent);
    folder.write("random.csv", "0,1\n1,0\n0,2\n2,0\n".repeat(10));
    let beta = |file: &str| {
        let line = format!("infer --features features.csv --preferences {file} --beta learn:3:1");
        at(&folder.json(&line), "/beta")
    };
    let (of_consistent, of_random) = (beta("consistent.csv"), beta("random.csv"));
    assert!(of_consistent > 4.0 && of_random < 1.0, "{of_consistent} {of_random}");
}

#[test]
fn empty_evidence_gives_the_prior_and_says_so() {
    let folder = Folder::new();
    folder.write("none.csv", "less,more\n");
    let line = format!("{TRAJECTORIES} --preferences none.csv --prior l1-sphere --draws 20000");
    let output = folder.run(&line);
    assert!(errors(&output).contains("warning: the evidence is empty: this is the prior"), "{}", errors(&output));
    let answer = folder.json(&line);
    assert_eq!((text(&answer, "/outcome"), at(&answer, "/log_likelihood_mean")), ("ready", 0.0));
    assert_eq!(text(&answer, "/warnings/0"), "the evidence is empty: this is the prior");
    for k in 0..3 {
        let mean = at(&answer, &format!("/mean/{k}"));
        assert!(mean.abs() < 0.02, "{mean}");
        // E w² = 2/(3·4) on the L1 sphere of three weights.
        assert!((at(&answer, &format!("/sd/{k}")).powi(2) - 1.0 / 6.0).abs() < 0.01);
    }
    // Scales of the other priors: a Laplace weight of mean size b has variance 2 b².
    for (prior, variance) in [("gaussian", 4.0), ("laplace", 8.0)] {
        let line = format!("{TRAJECTORIES} --preferences none.csv --prior {prior} --prior-scale 2 --draws 20000");
        let sd = at(&folder.json(&line), "/sd/0");
        assert!((sd * sd / variance - 1.0).abs() < 0.1, "{prior}: {sd}");
    }
}

#[test]
fn contradictions_are_allowed_and_told() {
    let folder = Folder::new();
    folder.write("circle.csv", "0,1\n1,2\n2,0\n3,4\n4,3\n0,5\n");
    let line = format!("{TRAJECTORIES} --preferences circle.csv");
    let answer = folder.json(&line);
    assert_eq!(answer["cycles"], serde_json::json!([[0, 1, 2], [3, 4]]));
    let told = errors(&folder.run(&line));
    assert!(told.contains("warning: the preferences go in a circle: 0 < 1 < 2 < 0"), "{told}");
    assert_eq!(
        folder.json(&line.replace("infer", "likelihood --weights config/examples/weights.csv"))["cycles"],
        answer["cycles"]
    );

    folder.write("same.csv", "1,2\n1,2\n");
    folder.write("against.csv", "0,1\n1,0\n");
    let line = "infer --features same.csv --preferences against.csv --beta 50";
    let warnings = folder.json(line)["warnings"].to_string();
    assert!(warnings.contains("no better than answers at random"), "{warnings}");

    folder.write("judged.csv", "state,action,verdict\n0,1,good\n0,1,bad\n2,2,bad\n");
    folder.write("shown.csv", "2,2\n");
    let answer = folder.json(&format!("infer {KITCHEN} --demonstrations shown.csv --critiques judged.csv"));
    let warnings = answer["warnings"].to_string();
    let want = "action 1 in state 0 is called bad, and also taken or called good, and one more such pair";
    assert!(warnings.contains(want), "{warnings}");
}

#[test]
fn a_known_return_bounds_the_prior() {
    let folder = Folder::new();
    folder.write("none.csv", "");
    for sampler in ["hmc", "l2-walk --sigma 0.5 --every 5 --burn-in 100"] {
        let line =
            format!("{TRAJECTORIES} --preferences none.csv --nonnegative-return 2 --out draws.csv --sampler {sampler}");
        folder.json(&line);
        let draws = folder.numbers("draws.csv");
        // Row 2 is (0.77, 0, 1.85).
        assert!(draws.chunks(3).all(|w| 0.77 * w[0] + 1.85 * w[2] >= 0.0), "{sampler}");
        assert!(draws.chunks(3).any(|w| w[0] < 0.0) && draws.chunks(3).any(|w| w[2] < 0.0), "{sampler}");
    }
}

#[test]
fn chains_that_do_not_mix_are_told() {
    let folder = Folder::new();
    let line = format!("{TRAJECTORIES} --preferences config/examples/preferences.csv --sampler l2-walk --sigma 0.001");
    let answer = folder.json(&format!("{line} --draws 400 --every 1 --burn-in 0"));
    assert_eq!(text(&answer, "/outcome"), "not_mixed");
    assert!(at(&answer, "/rhat_max") > 1.1);
    let answer = folder.json(&format!("{TRAJECTORIES} --preferences config/examples/preferences.csv --draws 200"));
    assert!(["not_enough_samples", "not_mixed"].contains(&text(&answer, "/outcome")), "{answer}");
}
