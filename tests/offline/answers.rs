//! From evidence to a bound: each command takes what the one before it wrote.

use crate::command::{Folder, at, errors, list, text};

const EVIDENCE: &str =
    "--features config/examples/trajectories.csv --preferences config/examples/preferences.csv --beta 5";
const POLICIES: &str = "config/examples/around.json config/examples/along.json config/examples/wander.json";

#[test]
fn draws_losses_and_bounds_agree() {
    let folder = Folder::new();
    let inferred = folder.json(&format!("infer {EVIDENCE} --out draws.csv"));
    assert_eq!(text(&inferred, "/outcome"), "ready");
    let draws = folder.numbers("draws.csv");
    assert_eq!(draws.len(), 3 * 4000);
    for k in 0..3 {
        let mean = draws.iter().skip(k).step_by(3).sum::<f64>() / 4000.0;
        assert!((mean - at(&inferred, &format!("/mean/{k}"))).abs() < 1e-12);
    }
    let likelihood = folder.json(&format!("likelihood {EVIDENCE} --weights draws.csv"));
    let values = list(&likelihood, "/log_likelihood");
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    assert!((mean - at(&inferred, "/log_likelihood_mean")).abs() < 1e-9);

    let kitchen = "evaluate --mdp config/examples/kitchen.json --draws draws.csv";
    let judged = folder.json(&format!("{kitchen} --policy config/examples/around.json --losses losses.csv"));
    assert_eq!(text(&judged, "/outcome"), "bound", "{judged}");
    assert_eq!(folder.numbers("losses.csv"), list(&judged, "/losses"));
    let bound = folder.json("bound --losses losses.csv");
    for key in ["bound", "index", "ess", "rhat", "needed", "point_estimate", "cvar", "mean", "outcome", "reason"] {
        assert_eq!(bound[key], judged["bounds"]["loss_var"][key], "{key}");
    }
    // Returns are w·Φ.
    let counts = list(&judged, "/expected_feature_counts");
    let mean: f64 = counts.iter().enumerate().map(|(k, x)| x * at(&inferred, &format!("/mean/{k}"))).sum();
    assert!((mean - at(&judged, "/return/mean")).abs() < 1e-9);
    assert_eq!(text(&judged, "/bounds/return_cvar/outcome"), "bound");
    assert!(at(&judged, "/bounds/return_cvar/bound") < at(&judged, "/return/cvar"));
    assert!(at(&judged, "/bounds/loss_cvar/bound") > at(&judged, "/loss/cvar"));
    assert_eq!(text(&judged, "/bounds/normalised_loss_var/reference"), "uniform random");
}

#[test]
fn policies_share_delta_and_are_ranked() {
    let folder = Folder::new();
    let line = "evaluate --mdp config/examples/kitchen.json --draws config/examples/draws.csv";
    let judged = folder.json(&format!("{line} --policy {POLICIES} --losses losses.csv"));
    assert_eq!(judged["ranking"], serde_json::json!(["around", "along", "wander"]));
    assert!((at(&judged, "/delta_each") - 0.05 / 3.0).abs() < 1e-15);
    assert!(judged.get("losses").is_none(), "those of one policy alone stand at the top");
    for (column, name) in ["around", "along", "wander"].into_iter().enumerate() {
        let policy = &judged["policies"][column];
        assert_eq!((text(policy, "/name"), text(policy, "/form")), (name, "tabular"));
        assert_eq!((at(policy, "/rank"), at(policy, "/rank_by_loss")), ((column + 1) as f64, (column + 1) as f64));
        let bound = folder.json(&format!("bound --losses losses.csv --column {column} --delta {:?}", 0.05 / 3.0));
        assert_eq!(bound["bound"], policy["bounds"]["loss_var"]["bound"]);
    }
    let best: f64 = (0..3).map(|policy| at(&judged, &format!("/policies/{policy}/probability_best"))).sum();
    assert!((best - 1.0).abs() < 1e-9);
    // The uniform random policy loses all that the uniform random policy loses.
    assert!((at(&judged, "/policies/2/bounds/normalised_loss_var/point_estimate") - 1.0).abs() < 1e-9);
    // A stochastic file of sure actions is the deterministic policy.
    let rows: Vec<String> = [3, 3, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0]
        .iter()
        .map(|action| {
            format!("[{}]", (0..4).map(|a| if a == *action { "1" } else { "0.0" }).collect::<Vec<_>>().join(","))
        })
        .collect();
    folder.write("sure.json", format!("{{\"gap\": 0, \"policy\": [{}]}}", rows.join(",")));
    let sure = folder.json(&format!("{line} --policy sure.json"));
    assert_eq!(sure["expected_feature_counts"], judged["policies"][0]["expected_feature_counts"]);
}

#[test]
fn a_policy_that_does_nothing_is_warned_of() {
    // The draws agree about features 0 and 1; of feature 2 they know nothing, and it is what the idle policy collects.
    let folder = Folder::new();
    let draw = |x: f64, y: f64| format!("{},{},{}\n", 1.0 + 0.1 * x, 1.0 - 0.1 * x, 0.4 + 3.0 * (y - 0.5));
    let mut numbers = crate::command::Uniform(8);
    let mut next = || numbers.next().expect("endless");
    folder.write("draws.csv", (0..4000).map(|_| draw(next(), next())).collect::<String>());
    folder.write("counts.csv", "1,1,0\n2,1,0\n1,2,0\n0,0,20\n");
    let judged = folder.json("evaluate --draws draws.csv --feature-counts counts.csv");
    assert_eq!(at(&judged, "/policies/3/rank"), 4.0);
    assert_eq!(at(&judged, "/policies/3/rank_by_mean"), 1.0);
    assert!(text(&judged, "/policies/3/warning").contains("may exploit what the evidence does not say"));
    assert!((0..3).all(|policy| judged["policies"][policy]["warning"].is_null()));
    // Without a process there is no loss; and weights on no sphere give no worst return.
    assert!(judged["policies"][0]["losses"].is_null() && judged["policies"][0]["loss"].is_null());
    assert_eq!(text(&judged, "/policies/0/bounds/return_cvar/outcome"), "unbounded");
    let bounded = folder.json("evaluate --draws draws.csv --feature-counts counts.csv --worst-return -100");
    assert_eq!(text(&bounded, "/policies/0/bounds/return_cvar/outcome"), "bound");
}

#[test]
fn rollouts_are_averaged_and_experts_compared() {
    let folder = Folder::new();
    let line = "evaluate --mdp config/examples/kitchen.json --draws config/examples/draws.csv";
    folder.write("runs.csv", "1,0,2\n0,0,1\n0.5,3,0\n");
    let judged = folder.json(&format!("{line} --trajectories runs.csv --expert-features config/examples/expert.csv"));
    assert_eq!(list(&judged, "/expected_feature_counts"), [0.5, 1.0, 1.0]);
    assert_eq!((text(&judged, "/form"), at(&judged, "/n_rollouts")), ("rollouts", 3.0));
    assert!(at(&judged, "/return_standard_error") > 0.0);
    // |0.774 − 0.5|, |0 − 1|, |0 − 1|.
    assert_eq!(at(&judged, "/worst_case_feature_count_bound"), 1.0);
    assert!(judged["hoeffding_bound"].is_null());
    // A demonstration 8 up 4 up 0 right 1 right 2 right: it does not show the cup, which is collected after its end.
    let with =
        format!("{line} --policy config/examples/around.json --demonstrations config/examples/demonstrations.csv");
    let judged = folder.json(&with);
    assert_eq!(list(&judged, "/expert_feature_counts"), [0.0, 0.0, 0.0]);
    let hoeffding = |m: f64| 3.0 / 0.05 * (2.0 / m * (6.0_f64 / 0.05).ln()).sqrt();
    assert!((at(&judged, "/hoeffding_bound") - hoeffding(1.0)).abs() < 1e-9, "{judged}");
    folder.write("two.csv", "state,action,trajectory\n2,3,a\n3,0,a\n6,0,b\n2,3,b\n3,0,b\n");
    let judged = folder.json(&format!("{line} --policy config/examples/around.json --demonstrations two.csv"));
    let want = [(0.95 + 0.95 * 0.95) / 2.0, 0.5, 0.0];
    for (got, want) in list(&judged, "/expert_feature_counts").iter().zip(want) {
        assert!((got - want).abs() < 1e-12);
    }
    assert!((at(&judged, "/hoeffding_bound") - hoeffding(2.0)).abs() < 1e-9);
    // Counts that no policy of the process collects.
    folder.write("much.csv", "5,0,0\n");
    let told = errors(&folder.run(&format!("{line} --feature-counts much.csv")));
    assert!(told.contains("much: under") && told.contains("worth more than the best policy"), "{told}");
}

#[test]
fn answers_to_read_hold_what_matters() {
    let folder = Folder::new();
    let read = |line: &str| String::from_utf8(folder.run(line).stdout).expect("UTF-8");
    let inferred = read(&format!("infer {EVIDENCE}"));
    for words in
        ["Posterior of 3 weights: ready", "preferences", "R-hat, largest", "acceptance", "effective draws, least"]
    {
        assert!(inferred.contains(words), "{words}:\n{inferred}");
    }
    let bound = read("bound --losses config/examples/losses.csv");
    for words in ["Upper bound on the 0.95-quantile of the loss: 0.300929", "outcome", "order statistic, from 1"] {
        assert!(bound.contains(words), "{words}:\n{bound}");
    }
    let judged = read(&format!(
        "evaluate --mdp config/examples/kitchen.json --draws config/examples/draws.csv --policy {POLICIES}"
    ));
    for words in ["3 policies under 1600 draws", "VaR bound", "around", "along", "wander", "Expected feature counts"] {
        assert!(judged.contains(words), "{words}:\n{judged}");
    }
    let likelihood = read(&format!("likelihood {EVIDENCE} --weights config/examples/weights.csv"));
    assert!(likelihood.contains("log-likelihood (nats)") && likelihood.lines().count() == 4, "{likelihood}");
}
