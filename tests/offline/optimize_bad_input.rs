//! What `apprentice optimize` cannot work with: one message each, with what was got and what is expected.

use crate::command::{Folder, errors, text};

const KITCHEN: &str = "optimize --mdp config/examples/kitchen.json";
const GOOD: &str = "optimize --mdp config/examples/kitchen.json --draws config/examples/draws.csv";

#[track_caller]
fn says(folder: &Folder, line: &str, parts: &[&str]) {
    let refused = folder.refused(line);
    for part in parts {
        assert!(refused.contains(part), "{line}:\n{refused}\nlacks: {part}");
    }
    assert!(!refused.contains("panicked"), "{refused}");
}

/// A process of two states and one action, with something changed in it.
fn process(gamma: &str, transitions: &str) -> String {
    format!(
        r#"{{"gamma": {gamma}, "n_states": 2, "n_actions": 1, "initial": [1, 0], "transitions": {transitions}, "features": [[0], [1]]}}"#
    )
}

#[test]
fn levels_out_of_range() {
    let folder = Folder::new();
    for alpha in ["1", "-0.1", "1.5", "nan", "inf"] {
        says(&folder, &format!("{GOOD} --alpha {alpha}"), &["alpha is", "but must be at least 0 and less than 1"]);
    }
    for lambda in ["-0.1", "1.01", "nan"] {
        says(&folder, &format!("{GOOD} --lambda {lambda}"), &["lambda is", "but must be from 0 to 1"]);
    }
    says(&folder, &format!("{GOOD} --tolerance 0"), &["tolerance is 0, but must be between 1e-12 and 0.1"]);
    says(&folder, &format!("{GOOD} --max-rounds 0"), &["max_rounds is 0, but must be at least 1"]);
    says(&folder, &format!("{GOOD} --max-iterations 0"), &["max_iterations is 0"]);
    for points in ["0", "1", "1002"] {
        says(&folder, &format!("{GOOD} --frontier --points {points}"), &["--points: got", "expected 2 to 1001"]);
    }
    says(&folder, &format!("{GOOD} --threads 0"), &["--threads: got 0, expected 1 to 256"]);
    says(&folder, &format!("{GOOD} --method simplex"), &["'simplex'", "auto, lp, columns"]);
    says(&folder, &format!("{GOOD} --points 5"), &["--frontier"]);
    says(&folder, &format!("{GOOD} --svg frontier.svg"), &["--frontier"]);
}

#[test]
fn transitions_that_do_not_sum_to_one() {
    let folder = Folder::new();
    folder.write("draws.csv", "1\n2\n");
    folder.write("process.json", process("0.9", "[[0, 0, 1, 0.7], [0, 0, 0, 0.2]]"));
    says(&folder, "optimize --mdp process.json --draws draws.csv", &["process.json", "state 0", "0.8999999999999999"]);
    folder.write("process.json", process("0.9", "[[0, 0, 5, 1]]"));
    says(&folder, "optimize --mdp process.json --draws draws.csv", &["process.json", "is 5, but must lie in 0..2"]);
    folder.write("process.json", "{");
    says(&folder, "optimize --mdp process.json --draws draws.csv", &["process.json: not the JSON of"]);
}

#[test]
fn a_horizon_without_end() {
    let folder = Folder::new();
    folder.write("draws.csv", "1\n2\n-1\n");
    for gamma in ["1", "0.9999999", "1.2", "-0.1"] {
        folder.write("process.json", process(gamma, "[[0, 0, 1, 1], [1, 0, 0, 1]]"));
        says(&folder, "optimize --mdp process.json --draws draws.csv", &["gamma is", "but must lie in [0, 0.999999]"]);
    }
    // The longest that there may be is solved.
    folder.write("process.json", process("0.999999", "[[0, 0, 1, 1], [1, 0, 0, 1]]"));
    let answer = folder.json("optimize --mdp process.json --draws draws.csv --lambda 0");
    assert_eq!(text(&answer, "/outcome"), "optimal");
}

#[test]
fn draws_that_are_none() {
    let folder = Folder::new();
    let cases: &[(&str, &[&str])] = &[
        ("", &["bad.csv: holds nothing, expected a row of numbers (weight)"]),
        ("cup,carpet,puddle\n", &["bad.csv: holds nothing"]),
        ("1,2\n", &["bad.csv, line 1: got 2 fields, expected 3 (one for each feature of --mdp)"]),
        ("1,2,3\n1,2,3,4\n", &["bad.csv, line 2: got 4 fields, expected 3"]),
        ("1,2,nan\n", &["bad.csv, line 1, column 3 (weight): got 'nan'"]),
        ("1,2,3\n1,inf,3\n", &["bad.csv, line 2, column 2 (weight): got 'inf'"]),
        ("1,2,1e150\n", &["bad.csv, line 1, column 3 (weight): got '1e150'"]),
        ("1,x,3\n", &["bad.csv, line 1, column 2 (weight): got 'x'"]),
    ];
    for (content, parts) in cases {
        folder.write("bad.csv", content);
        says(&folder, &format!("{KITCHEN} --draws bad.csv"), parts);
        says(&folder, &format!("{GOOD} --out-of-sample bad.csv"), parts);
    }
    says(&folder, &format!("{KITCHEN} --draws missing.csv"), &["missing.csv: cannot be read"]);
    folder.write("odd.csv", "1,2,3\n".repeat(1001));
    says(&folder, &format!("{GOOD} --out-of-sample odd.csv"), &["--chains: got none", "do not divide into 4 chains"]);
    says(&folder, &format!("{GOOD} --out-of-sample odd.csv --chains 3"), &["--chains: got 3, expected another number"]);
    says(
        &folder,
        &format!("{GOOD} --out-of-sample config/examples/draws.csv --confidence 1"),
        &["confidence is 1, but must be strictly between 0 and 1"],
    );
}

#[test]
fn weights_that_are_none() {
    let folder = Folder::new();
    folder.write("draws.csv", "1,2,3\n3,2,1\n");
    let line = format!("{KITCHEN} --draws draws.csv --weights weights.csv");
    let cases: &[(&str, &[&str])] = &[
        ("1\n", &["weights.csv: has 1 weights, but draws.csv has 2"]),
        ("1\n-1\n", &["--weights: got -1 as weight 1 of weights.csv, expected 0 or more"]),
        ("0\n0\n", &["--weights: got weights in weights.csv that sum to 0, expected a positive sum"]),
        ("0.5,0.5\n", &["weights.csv, line 1: got 2 fields, expected 1 (one weight a line)"]),
        ("nan\n1\n", &["weights.csv"]),
    ];
    for (content, parts) in cases {
        folder.write("weights.csv", content);
        says(&folder, &line, parts);
    }
}

#[test]
fn experts_that_are_none() {
    let folder = Folder::new();
    says(
        &folder,
        &format!("{GOOD} --objective regret"),
        &["--objective regret: got no expert, expected --expert-features or --demonstrations"],
    );
    folder.write("two.csv", "1,2,3\n1,2,3\n");
    says(
        &folder,
        &format!("{GOOD} --objective regret --expert-features two.csv"),
        &["two.csv: has 2 rows, but one expert has 1"],
    );
    folder.write("short.csv", "1,2\n");
    says(&folder, &format!("{GOOD} --expert-features short.csv"), &["short.csv, line 1: got 2 fields, expected 3"]);
    folder.write("steps.csv", "state,action\n0,9\n");
    says(&folder, &format!("{GOOD} --demonstrations steps.csv"), &["steps.csv, line 2, column 2 (action): got '9'"]);
    folder.write("jump.csv", "state,action\n8,0\n3,0\n");
    says(&folder, &format!("{GOOD} --demonstrations jump.csv"), &["jump.csv, line 3, column 1 (state): got '3'"]);
    folder.write("none.csv", "state,action\n");
    says(&folder, &format!("{GOOD} --demonstrations none.csv"), &["none.csv: holds nothing, expected a demonstration"]);
    folder.write("map.csv", "1,2\n");
    says(&folder, &format!("{GOOD} --baselines --map map.csv"), &["map.csv, line 1: got 2 fields, expected 3"]);
    folder.write("map.json", r#"{"map": [1, 2]}"#);
    says(&folder, &format!("{GOOD} --baselines --map map.json"), &["map.json: has 2 weights, but --mdp has 3"]);
    folder.write("map.json", r#"{"mean": [1, 2, 3]}"#);
    says(&folder, &format!("{GOOD} --baselines --map map.json"), &["map.json", "got no list under the key \"map\""]);
    says(
        &folder,
        &format!("{GOOD} --baselines --maxent-beta 0 --expert-features config/examples/expert.csv"),
        &["rationality is 0, but must be above 0"],
    );
}

#[test]
fn numbers_that_are_too_large_to_optimise_end_in_words() {
    // Neither infeasible nor unbounded: a process with γ below 1 never is. What is too large to compute with is refused, and
    // what is not is solved.
    let folder = Folder::new();
    folder.write("process.json", process("0.9", "[[0, 0, 1, 1], [1, 0, 0, 1]]"));
    folder.write("draws.csv", "1e99\n-1e99\n3e98\n");
    let answer = folder.json("optimize --mdp process.json --draws draws.csv --lambda 0");
    assert_eq!(text(&answer, "/outcome"), "optimal");
    folder.write("draws.csv", "1e101\n");
    says(
        &folder,
        "optimize --mdp process.json --draws draws.csv",
        &["draws.csv, line 1, column 1 (weight): got '1e101'"],
    );
}

#[test]
fn pictures_that_cannot_be_drawn() {
    let folder = Folder::new();
    folder.write("draws.csv", "1\n2\n");
    folder.write("process.json", process("0.9", "[[0, 0, 1, 1]]"));
    let line = "optimize --mdp process.json --draws draws.csv --policy-svg policy.svg";
    says(&folder, line, &["--policy-svg: got a process of no shape, expected \"shape\": [rows, columns] in --mdp"]);
    let shaped = process("0.9", "[[0, 0, 1, 1]]").replace("\"features\"", "\"shape\": [1, 2], \"features\"");
    folder.write("process.json", &shaped);
    says(&folder, line, &["--policy-svg: got actions without names"]);
    folder.write("process.json", shaped.replace("\"features\"", "\"actions\": [\"grasp\"], \"features\""));
    says(&folder, line, &["--policy-svg: got an action 'grasp', expected up, down, left, right or stay"]);
    assert!(!folder.names().contains(&"policy.svg".to_owned()));
    // A file that cannot be written is a failure, not bad input.
    let output = folder.run(&format!("{GOOD} --policy-svg no/where.svg"));
    assert_eq!(output.status.code(), Some(1), "{}", errors(&output));
    assert!(errors(&output).contains("no/where.svg: cannot be written"));
}
