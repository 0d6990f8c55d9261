//! `apprentice optimize`: the policy, its risk, the frontier, baselines and pictures.

use crate::command::{Folder, Uniform, at, errors, lines, list, text};
use serde_json::Value;

const KITCHEN: &str = "optimize --mdp config/examples/kitchen.json --draws config/examples/draws.csv";
const CORRIDOR: &str = "optimize --mdp config/examples/corridor.json --draws config/examples/corridor-draws.csv \
                        --demonstrations config/examples/corridor-demonstration.csv";

/// Rows of a table of numbers.
fn table(folder: &Folder, name: &str, k: usize) -> Vec<Vec<f64>> {
    let text = folder.read(name);
    let numbers = |line: &str| line.split(',').map(|x| x.trim().parse::<f64>()).collect::<Result<Vec<f64>, _>>().ok();
    let rows: Vec<Vec<f64>> = text.lines().filter_map(numbers).collect();
    assert!(rows.iter().all(|row| row.len() == k));
    rows
}

/// (VaR, CVaR) of the lower tail of equally probable values, by sorting.
fn lower_tail(mut values: Vec<f64>, alpha: f64) -> (f64, f64) {
    values.sort_by(f64::total_cmp);
    let worst = ((1.0 - alpha) * values.len() as f64).round() as usize;
    (values[worst], values[..worst].iter().sum::<f64>() / worst as f64)
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

#[track_caller]
fn close(got: f64, want: f64) {
    assert!((got - want).abs() <= 1e-7 * want.abs().max(1.0), "{got}, but {want} is expected");
}

#[test]
fn the_answer_is_a_policy_whose_risk_is_what_it_says() {
    let folder = Folder::new();
    let draws = table(&folder, "config/examples/draws.csv", 3);
    assert_eq!(draws.len(), 1600);
    folder.write("expert.csv", "0.774,0,0\n");
    for (more, offset) in [("", 0.0), ("--objective regret --expert-features expert.csv", 0.774)] {
        let answer = folder.json(&format!("{KITCHEN} --lambda 0.2 {more}"));
        assert_eq!(text(&answer, "/outcome"), "optimal", "{answer}");
        assert!(at(&answer, "/gap") >= 0.0 && at(&answer, "/gap") <= 1e-8 * at(&answer, "/unit"));
        assert_eq!(answer["checks"]["hold"], true);
        // VaR and CVaR again from feature counts, by sorting.
        let counts = list(&answer, "/feature_counts");
        let values: Vec<f64> = draws.iter().map(|w| dot(w, &counts) - offset * w[0]).collect();
        let (var, cvar) = lower_tail(values, 0.95);
        close(at(&answer, "/var"), var);
        close(at(&answer, "/cvar"), cvar);
        let mean = draws.iter().map(|w| dot(w, &counts)).sum::<f64>() / 1600.0;
        close(at(&answer, "/expected_return"), mean);
        close(at(&answer, "/objective"), 0.8 * cvar + 0.2 * mean);
        // Rows are distributions, and visits are those of the policy.
        let mut visits = 0.0;
        for state in 0..12 {
            let row = list(&answer, &format!("/policy/{state}"));
            close(row.iter().sum(), 1.0);
            let occupancy = list(&answer, &format!("/occupancy/{state}"));
            let here: f64 = occupancy.iter().sum();
            visits += here;
            for (u, p) in occupancy.iter().zip(&row).filter(|_| here > 1e-9) {
                close(*u, p * here);
            }
        }
        assert!(visits > 5.0 && visits <= 20.0 + 1e-9, "{visits}");
    }
}

#[test]
fn evaluate_finds_the_same_in_the_answer_as_a_policy_file() {
    let folder = Folder::new();
    for (more, sign) in [("--objective robust", 1.0), ("--objective evd", -1.0)] {
        let answer = folder.json(&format!("{KITCHEN} --lambda 0 {more}"));
        folder.write("robust.json", answer.to_string());
        let judged = folder
            .json("evaluate --mdp config/examples/kitchen.json --draws config/examples/draws.csv --policy robust.json");
        for (got, want) in list(&judged, "/expected_feature_counts").iter().zip(list(&answer, "/feature_counts")) {
            close(*got, want);
        }
        close(at(&judged, "/return/mean"), at(&answer, "/expected_return"));
        // Under evd ψ is minus the loss.
        let tail = if sign > 0.0 { "return" } else { "loss" };
        close(sign * at(&judged, &format!("/{tail}/cvar")), at(&answer, "/cvar"));
        close(sign * at(&judged, &format!("/{tail}/var")), at(&answer, "/var"));
    }
}

#[test]
fn both_methods_agree_and_say_which_they_are() {
    let folder = Folder::new();
    for more in ["--lambda 0", "--lambda 0.3 --alpha 0.8", "--lambda 0.1 --objective evd", "--alpha 0 --lambda 0.4"] {
        let columns = folder.json(&format!("{KITCHEN} {more} --method columns"));
        let program = folder.json(&format!("{KITCHEN} {more} --method lp"));
        let automatic = folder.json(&format!("{KITCHEN} {more}"));
        assert_eq!(text(&columns, "/method"), "column_generation");
        assert_eq!(text(&program, "/method"), "direct");
        assert_eq!(text(&automatic, "/method"), "column_generation");
        for other in [&program, &automatic] {
            assert_eq!(text(other, "/outcome"), "optimal");
            close(at(other, "/objective"), at(&columns, "/objective"));
        }
    }
}

#[test]
fn posterior_weights_count() {
    let folder = Folder::new();
    let mut numbers = Uniform(3);
    let mut next = || 2.0 * numbers.next().expect("endless") - 1.0;
    // The cup is worth something under every draw, or else staying at home would be best whatever the weights.
    let rows: Vec<String> = (0..60).map(|_| format!("{:?},{:?},{:?}", 0.7 + 0.5 * next(), next(), next())).collect();
    folder.write("draws.csv", rows.join("\n"));
    // Each draw as often as its weight says.
    let times = |i: usize| i % 4;
    let repeated: Vec<String> = (0..60).flat_map(|i| vec![rows[i].clone(); times(i)]).collect();
    folder.write("repeated.csv", repeated.join("\n"));
    folder.write("weights.csv", lines((0..60).map(|i| 0.5 * times(i) as f64)));
    let process = "optimize --mdp config/examples/kitchen.json --alpha 0.9 --lambda 0.1";
    let weighted = folder.json(&format!("{process} --draws draws.csv --weights weights.csv"));
    let repeated = folder.json(&format!("{process} --draws repeated.csv"));
    let equal = folder.json(&format!("{process} --draws draws.csv"));
    assert_eq!((at(&weighted, "/n_draws"), at(&weighted, "/n_distinct_draws")), (60.0, 45.0));
    for key in ["/objective", "/expected_return", "/var", "/cvar"] {
        close(at(&weighted, key), at(&repeated, key));
    }
    assert!((at(&weighted, "/objective") - at(&equal, "/objective")).abs() > 1e-3);
}

#[test]
fn a_frontier_trades_the_mean_for_the_tail() {
    let folder = Folder::new();
    let answer = folder.json(&format!("{CORRIDOR} --lambda 0.37 --frontier --points 11 --svg frontier.svg"));
    let points = answer["frontier"].as_array().expect("a list");
    // λ asked for stands among the points.
    assert_eq!(points.len(), 12);
    let of = |key: &str| points.iter().map(|point| point[key].as_f64().expect("a number")).collect::<Vec<_>>();
    let lambdas = of("lambda");
    assert!(lambdas.is_sorted() && (lambdas[0], lambdas[11]) == (0.0, 1.0) && lambdas.contains(&0.37));
    let (means, tails) = (of("expected_return"), of("cvar"));
    for i in 1..12 {
        assert!(means[i] >= means[i - 1] - 1e-6 && tails[i] <= tails[i - 1] + 1e-6, "{answer}");
    }
    assert!(means[11] > means[0] + 0.01 && tails[0] > tails[11] + 0.01, "{answer}");
    assert!(points.iter().all(|point| point["outcome"] == "optimal"));
    let place = lambdas.iter().position(|lambda| *lambda == 0.37).expect("it is there");
    assert_eq!(points[place]["objective"], answer["objective"]);
    let alone = folder.json(&format!("{CORRIDOR} --lambda 0.37"));
    close(at(&alone, "/objective"), at(&answer, "/objective"));
    assert!(alone["frontier"].is_null());
    let svg = folder.read("frontier.svg");
    assert!(svg.contains("<svg") && svg.trim_end().ends_with("</svg>") && svg.contains("CVaR of the return, α = 0.95"));
    // A dot for each point and one in the legend.
    assert_eq!(svg.matches("<circle").count(), 13);
}

#[test]
fn no_baseline_has_a_better_objective() {
    let folder = Folder::new();
    folder.write("map.csv", "-0.3,-0.9\n");
    for objective in ["robust", "regret", "evd"] {
        let answer = folder.json(&format!("{CORRIDOR} --objective {objective} --lambda 0.2 --baselines --map map.csv"));
        let baselines = answer["baselines"].as_array().expect("a list");
        let names: Vec<&str> = baselines.iter().filter_map(|baseline| baseline["name"].as_str()).collect();
        let want = ["mean_reward", "map_reward", "var_hill_climbing", "lpal", "lpal_positive", "max_entropy"];
        assert_eq!(names, want);
        for baseline in baselines {
            let risk = |key: &str| baseline[key].as_f64().expect("a number");
            assert!(risk("objective") <= at(&answer, "/upper_bound") + 1e-9, "{objective}: {baseline}");
            close(risk("objective"), 0.8 * risk("cvar") + 0.2 * risk("expected_return"));
            assert!(risk("cvar") <= risk("var") + 1e-9);
            let words = ["optimal", "converged", "local_optimum"];
            assert!(words.contains(&baseline["outcome"].as_str().expect("a word")), "{baseline}");
        }
        // The policy that is best on average has the largest mean of all; hill climbing begins there and only improves the VaR.
        let mean = |i: usize| at(&answer, &format!("/baselines/{i}/expected_return"));
        assert!((0..6).all(|i| mean(i) <= mean(0) + 1e-9) && at(&answer, "/expected_return") <= mean(0) + 1e-9);
        assert!(at(&answer, "/baselines/2/var") >= at(&answer, "/baselines/0/var") - 1e-9);
    }
    // The answer of infer tells the most probable reward, too.
    folder.write("inferred.json", r#"{"map": [-0.3, -0.9], "outcome": "ready"}"#);
    let line = format!("{CORRIDOR} --lambda 0.2 --baselines --map");
    let both = [folder.json(&format!("{line} map.csv")), folder.json(&format!("{line} inferred.json"))];
    assert_eq!(both[0]["baselines"], both[1]["baselines"]);
    // Without an expert, and without a most probable reward, some are left out, in words.
    let answer = folder.json(&format!("{KITCHEN} --baselines"));
    assert_eq!(answer["baselines"].as_array().map(Vec::len), Some(2));
    let warnings = answer["warnings"].to_string();
    assert!(warnings.contains("no --map") && warnings.contains("no --expert-features"), "{warnings}");
}

#[test]
fn fresh_draws_judge_the_policy() {
    let folder = Folder::new();
    let line = format!("{CORRIDOR} --lambda 0 --out-of-sample config/examples/corridor-fresh-draws.csv");
    let answer = folder.json(&line);
    let fresh = table(&folder, "config/examples/corridor-fresh-draws.csv", 2);
    let counts = list(&answer, "/feature_counts");
    let (var, cvar) = lower_tail(fresh.iter().map(|w| dot(w, &counts)).collect(), 0.95);
    close(at(&answer, "/out_of_sample/cvar"), cvar);
    close(at(&answer, "/out_of_sample/var"), var);
    let interval = list(&answer, "/out_of_sample/interval");
    assert!(interval[0] < cvar && cvar < interval[1], "{interval:?} {cvar}");
    assert_eq!((at(&answer, "/out_of_sample/n"), at(&answer, "/out_of_sample/n_chains")), (800.0, 4.0));
    assert!(at(&answer, "/out_of_sample/ess") <= 800.0);
    // The seed is that of the interval alone; more confidence makes it wider.
    let seeds = [0, 1].map(|seed| folder.json(&format!("{line} --seed {seed}")));
    assert_eq!(seeds[0]["out_of_sample"], answer["out_of_sample"]);
    assert_ne!(seeds[0]["out_of_sample"], seeds[1]["out_of_sample"]);
    assert_eq!(seeds[0]["policy"], seeds[1]["policy"]);
    let sure = list(&folder.json(&format!("{line} --confidence 0.999")), "/out_of_sample/interval");
    assert!(sure[1] - sure[0] > interval[1] - interval[0]);
}

#[test]
fn what_does_not_come_to_an_end_is_an_outcome() {
    let folder = Folder::new();
    let best = folder.json(&format!("{KITCHEN} --lambda 0"));
    for more in ["--method columns --max-rounds 1", "--method lp --max-iterations 2"] {
        let cut = folder.json(&format!("{KITCHEN} --lambda 0 {more}"));
        assert_eq!(text(&cut, "/outcome"), "iteration_limit", "{cut}");
        assert!(text(&cut, "/reason").contains("did not suffice"));
        assert!(at(&cut, "/gap") > 1e-6 && at(&cut, "/objective") <= at(&best, "/objective") + 1e-9);
        assert!(at(&cut, "/upper_bound") >= at(&best, "/objective") - 1e-9);
    }
}

#[test]
fn policies_are_drawn_on_their_grid() {
    let folder = Folder::new();
    for shade in ["occupancy", "feature"] {
        let line = format!("{CORRIDOR} --lambda 0 --baselines --policy-svg policies.svg --shade {shade}");
        let answer = folder.json(&line);
        let svg = folder.read("policies.svg");
        // Ours and five others, 15 cells each, one of which is the end.
        assert_eq!(svg.matches(">end<").count(), 6, "{shade}");
        let arrows = svg.matches("<path").count();
        let taken = |policy: &Value| {
            let rows = policy.as_array().expect("rows").iter().take(14);
            rows.flat_map(|row| row.as_array().expect("a row")).filter(|p| p.as_f64() >= Some(0.002)).count()
        };
        let policies = answer["baselines"].as_array().expect("a list").iter().map(|baseline| &baseline["policy"]);
        let want: usize = std::iter::once(&answer["policy"]).chain(policies).map(taken).sum();
        assert_eq!(arrows, want, "{shade}");
    }
    assert_eq!(folder.names(), ["config", "policies.svg"]);
}

#[test]
fn states_out_of_reach_are_told_and_have_a_policy() {
    let folder = Folder::new();
    // From state 0 to 1, where it ends; nothing leads to state 2, where action 1 is better.
    let process = r#"{"gamma": 0.9, "n_states": 3, "n_actions": 2, "initial": [1, 0, 0], "transitions":
        [[0, 0, 1, 1], [0, 1, 1, 1], [2, 0, 2, 1], [2, 1, 1, 1]], "features": [[0], [1], [-1]]}"#;
    folder.write("process.json", process);
    folder.write("draws.csv", "1\n2\n");
    let line = "optimize --mdp process.json --draws draws.csv";
    let answer = folder.json(line);
    assert_eq!(list(&answer, "/unreachable"), [2.0]);
    assert_eq!(list(&answer, "/policy/2"), [0.0, 1.0]);
    let told = errors(&folder.run(line));
    assert!(told.contains("warning: 1 state can be reached by no policy (2)"), "{told}");
}

#[test]
fn answers_are_the_same_whatever_the_threads() {
    let folder = Folder::new();
    let run = |threads: usize| {
        let line = format!("{KITCHEN} --objective evd --frontier --points 5 --threads {threads} --svg {threads}.svg");
        let mut answer = folder.json(&line);
        let object = answer.as_object_mut().expect("an object");
        object.remove("seconds");
        object.remove("cpu_seconds");
        (answer, folder.read(&format!("{threads}.svg")))
    };
    assert_eq!(run(1), run(3));
}

#[test]
fn risk_is_told_in_words() {
    let folder = Folder::new();
    // Lines may end within a sentence.
    let read = |line: &str| {
        let text = String::from_utf8(folder.run(line).stdout).expect("UTF-8");
        text.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let robust = read(&format!("{CORRIDOR} --lambda 0 --frontier --points 3 --baselines"));
    for words in [
        "α = 0.95, λ = 0, robust: optimal",
        "no policy's objective is larger by more than",
        "On average over the rewards that fit, this policy returns",
        "under the worst 5 %",
        "Beside others",
        "Maximum Entropy IRL",
        "Frontier: what caution costs",
        "Policy, with discounted visits",
        "14 0.9",
    ] {
        assert!(robust.contains(words), "{words}:\n{robust}");
    }
    let regret = read(&format!("{CORRIDOR} --lambda 0 --objective regret"));
    assert!(regret.contains("than the expert's"), "{regret}");
    let evd = read(&format!("{KITCHEN} --lambda 0 --objective evd"));
    assert!(evd.contains("it loses at most"), "{evd}");
    let neutral = read(&format!("{KITCHEN} --lambda 1"));
    assert!(neutral.contains("it is the policy that is best on average"), "{neutral}");
    let progress = errors(&folder.run(&format!("{KITCHEN} --frontier --points 3 --lambda 0")));
    assert!(progress.contains("3 of 3, lambda = "), "{progress}");
}
