//! Bad input: exit code 2, one message with file, line, what was got and what was expected. Never a number, never a panic.

use crate::command::Folder;

const EXAMPLES: &str = "config/examples";

fn says(folder: &Folder, line: &str, parts: &[&str]) {
    let refused = folder.refused(line);
    for part in parts {
        assert!(refused.contains(part), "{line}:\n{refused}\nlacks: {part}");
    }
    assert!(!refused.contains("panicked"), "{refused}");
}

#[test]
fn tables_that_are_none() {
    let folder = Folder::new();
    let cases: &[(&[u8], &[&str])] = &[
        (b"1,2\n3\n", &["bad.csv, line 2: got 1 field, expected 2"]),
        (b"a,b\n1,2\n\n3,nan\n", &["bad.csv, line 4, column 2 (feature): got 'nan', expected"]),
        (b"1,inf\n", &["line 1, column 2 (feature): got 'inf'"]),
        (b"1,1e999\n", &["line 1, column 2 (feature): got '1e999'"]),
        (b"1,x\n", &["line 1, column 2 (feature): got 'x'"]),
        (b"1;2\n3;4\n", &["fields are separated by commas", "bad.csv"]),
        (b"0.1 0.2\n", &["line 1, column 1 (feature): got '0.1 0.2'", "fields are separated by commas"]),
        (b"NA,1\n", &["line 1, column 1 (feature): got 'NA', expected"]),
        (b"n/a,null\n1,2\n", &["line 1, column 1 (feature): got 'n/a', expected"]),
        (b"", &["bad.csv: holds nothing, expected a row of numbers"]),
        (b"\n\r\n\n", &["bad.csv: holds nothing"]),
        (b"cup,carpet\n", &["bad.csv: holds nothing"]),
        (b"1,2\n\xff\xfe\n", &["bad.csv, line 2: holds bytes that are not UTF-8, expected UTF-8 text"]),
        (b"\xff\xfe1\0,\x002\0\n\0", &["bad.csv, line 1: holds UTF-16"]),
        (b"1,2\r3,4\r", &["a carriage return within a line"]),
    ];
    folder.write("pairs.csv", "0,1\n");
    for (content, parts) in cases {
        folder.write("bad.csv", content);
        says(&folder, "infer --features bad.csv --preferences pairs.csv", parts);
    }
    says(
        &folder,
        "infer --features missing.csv --preferences pairs.csv",
        &["missing.csv: cannot be read: No such file"],
    );
    says(&folder, "infer --features config --preferences pairs.csv", &["config: is a directory, expected a file"]);
    folder.write("wide.csv", vec!["1"; 5000].join(","));
    says(&folder, "infer --features wide.csv --preferences pairs.csv", &["holds 5000 columns, but at most 4096"]);
    folder.write("long.csv", vec![b'1'; 2 << 20]);
    says(
        &folder,
        "infer --features long.csv --preferences pairs.csv",
        &["long.csv, line 1: is longer than 1048576 bytes"],
    );
    says(&folder, "bound --losses /dev/zero", &["/dev/zero, line 1: is longer than"]);
    folder.write("losses.csv", "1\n2,3\n");
    says(&folder, "bound --losses losses.csv", &["losses.csv, line 2: got 2 fields, expected 1 (one number a line"]);
    folder.write("losses.csv", "1\n2\n");
    says(&folder, "bound --losses losses.csv --column 1", &["--column: got 1, expected 0 to 0"]);
    // The names of nameless columns look like data: they count, but not in silence.
    folder.write("counted.csv", "0,1\n5,6\n");
    let output = folder.run("infer --features counted.csv --preferences pairs.csv --draws 400");
    assert!(crate::command::errors(&output).contains("the first row reads 0, 1, 2"));
}

#[test]
fn answers_that_are_none() {
    let folder = Folder::new();
    let line = format!("infer --features {EXAMPLES}/trajectories.csv --preferences bad.csv");
    let cases: &[(&str, &[&str])] = &[
        (
            "0,1\n0,6\n",
            &["bad.csv, line 2, column 2 (more): got '6', expected a row of the features: a whole number from 0 to 5"],
        ),
        ("-1,2\n", &["column 1 (less): got '-1'"]),
        ("0.5,2\n", &["column 1 (less): got '0.5'"]),
        ("2,2\n", &["line 1, column 2 (more): got '2', expected another row than less"]),
        ("0\n", &["line 1: got 1 field, expected 2 to 4 (less,more,confidence,verdict)"]),
        ("0,1,sure,strict,5\n", &["got 5 fields, expected 2 to 4"]),
        ("0,1\n0,1,sure\n", &["line 2: got 3 fields, expected 2"]),
        ("0,1,very\n", &["line 1, column 3 (confidence): got 'very', expected sure, fairly, guess"]),
        ("0,1,1.5\n", &["got '1.5'", "above 0 and at most 1"]),
        ("0,1,0\n", &["got '0'"]),
        ("0,1,,better\n", &["column 4 (verdict): got 'better', expected strict, equal or cant-tell"]),
        ("worse,better\n0,1\n", &["line 1: got the column 'worse'", "less, more, confidence, verdict"]),
        ("less,verdict\n0,equal\n", &["line 1", "less, more"]),
    ];
    for (content, parts) in cases {
        folder.write("bad.csv", content);
        says(&folder, &line, parts);
    }
    folder.write("bad.csv", "0,1,,equal\n");
    says(&folder, &format!("{line} --equal-threshold 0"), &["--equal-threshold: got 0", "the verdict equal"]);
    folder.write("bad.csv", "0,1,,cant-tell\n");
    says(&folder, &format!("{line} --cant-tell 0"), &["--cant-tell: got 0", "the verdict cant-tell"]);
    for (name, content, part) in [
        ("rankings", "0,1,0\n", "column 3 (row): got '0', expected every row once"),
        ("rankings", "0,1\n4\n", "line 2: got 1 field, expected at least 2"),
        ("progress", "0,9\n", "column 2 (row): got '9'"),
    ] {
        folder.write("bad.csv", content);
        says(
            &folder,
            &format!("infer --features {EXAMPLES}/trajectories.csv --{name} bad.csv"),
            &["bad.csv, line", part],
        );
    }
}

#[test]
fn processes_that_are_none() {
    let folder = Folder::new();
    let line = "infer --mdp bad.json --demonstrations pairs.csv";
    folder.write("pairs.csv", "0,0\n");
    let good = r#"{"gamma": 0.9, "n_states": 2, "n_actions": 1, "initial": [1, 0], "transitions": [[0, 0, 1, 1.0]], "features": [[0], [1]]}"#;
    let cases: &[(&str, &str, &str)] = &[
        ("[0, 0, 1, 1.0]", "[0, 0, 1, 0.9]", "the transitions of state 0, action 0 sum to 0.9, but must sum to 1"),
        ("[0, 0, 1, 1.0]", "[0, 0, 2, 1.0]", "target is 2, but must lie in 0..2"),
        ("[0, 0, 1, 1.0]", "[0, 0, 1, -0.5], [0, 0, 0, 1.5]", "has probability -0.5"),
        ("0.9", "1.0", "gamma is 1, but must lie in [0,"),
        ("0.9", "-0.1", "gamma is -0.1"),
        ("[[0], [1]]", "[[], []]", "n_features is 0"),
        ("[[0], [1]]", "[[0], [1, 2]]", "row 1 of features has 2 entries, but 1 are expected"),
        ("[[0], [1]]", "[[0]]", "features has 1 entries, but 2 are expected"),
        ("[[0], [1]]", "[[0], [1e999]]", "bad.json: not the JSON of a decision process"),
        ("[1, 0]", "[0.5, 0.4]", "initial sums to 0.9"),
        ("[1, 0]", "[1]", "initial has 1 entries, but 2 are expected"),
        ("\"n_actions\": 1", "\"n_actions\": 0", "n_actions is 0"),
        ("\"gamma\"", "\"gama\"", "unknown field `gama`"),
        ("}", "", "not the JSON of a decision process: EOF"),
    ];
    folder.write("bad.json", good);
    folder.json(line);
    for (from, to, part) in cases {
        folder.write("bad.json", good.replace(from, to));
        says(&folder, line, &["bad.json", part]);
    }
    folder.write("bad.json", good);
    for (pairs, part) in [
        ("2,0\n", "pairs.csv, line 1, column 1 (state): got '2', expected a state: a whole number from 0 to 1"),
        ("0,1\n", "pairs.csv, line 1, column 2 (action): got '1', expected an action"),
        ("0,0,bad\n", "there is no other action to take"),
        ("0,0,fine\n", "got 'fine', expected taken, good or bad"),
    ] {
        folder.write("pairs.csv", pairs);
        says(&folder, line, &[part]);
    }
    folder.write("judged.csv", "0,0\n");
    says(
        &folder,
        "infer --mdp bad.json --critiques judged.csv",
        &["judged.csv, line 1: got 2 fields, expected 3 to 5"],
    );
    let three =
        format!("infer --mdp bad.json --features {EXAMPLES}/trajectories.csv --rankings {EXAMPLES}/rankings.csv");
    says(&folder, &three, &["trajectories.csv: has 3 features, but bad.json has 1"]);
    for (policy, part) in [
        (r#"{"policy": [0]}"#, "policy has 1 entries, but 2 are expected"),
        (r#"{"policy": [0, 7]}"#, "action is 7"),
        (r#"{"policy": [[0.5], [1]]}"#, "the policy in state 0 sums to 0.5"),
        (r#"{"actions": [0, 0]}"#, "without the key \"policy\""),
        ("[0, ", "not the JSON of a policy"),
    ] {
        folder.write("policy.json", policy);
        folder.write("draws.csv", "1\n");
        says(&folder, "evaluate --mdp bad.json --draws draws.csv --policy policy.json", &["policy.json", part]);
    }
    folder.write("draws.csv", "1,2\n");
    says(
        &folder,
        "evaluate --mdp bad.json --draws draws.csv --policy policy.json",
        &["draws.csv, line 1: got 2 fields, expected 1"],
    );
}

#[test]
fn flags_that_do_not_fit() {
    let folder = Folder::new();
    let features = format!("--features {EXAMPLES}/trajectories.csv");
    let infer = format!("infer {features} --preferences {EXAMPLES}/preferences.csv");
    let more: &[(&str, &str)] = &[
        ("--beta 0", "--beta"),
        ("--beta learn:0", "got a median of beta '0'"),
        ("--beta 1e9", "beta of the preferences is 1000000000, but must be"),
        ("--wrong-rate 1", "--wrong-rate: got 1, expected a number of at least 0 and below 1"),
        ("--cant-tell 1.5", "--cant-tell: got 1.5"),
        ("--progress-confidence 0", "--progress-confidence: got 0"),
        ("--prior-scale 2", "--prior-scale: got 2, expected none: a sphere has no scale"),
        ("--prior gaussian --prior-scale 0", "the scale of the prior is 0"),
        ("--nonnegative-return 6", "--nonnegative-return: got 6, expected a row of the features: 0 to 5"),
        ("--sampler l1-walk --prior l2-sphere", "--prior: got l2-sphere, expected l1-sphere"),
        ("--sampler l1-walk --beta learn", "--beta: got learn for the preferences"),
        ("--sampler l1-walk --sigma 0.1", "--sigma: expected none: it belongs to --sampler l2-walk"),
        ("--sampler l2-walk --sigma 0", "--sigma: got 0"),
        ("--sampler l2-walk --every 0", "--every: got 0"),
        ("--step 0.1", "--step: expected none"),
        ("--burn-in 5", "--burn-in: expected none"),
        ("--draws 4001", "n_draws is 4001, but must be a multiple of n_chains, which is 4"),
        ("--draws 8", "n_draws / n_chains is 2, but must lie between 10 and 100000"),
        ("--chains 3 --draws 300", "n_chains is 3, but must lie between 4 and 64"),
        ("--warmup 5", "warmup is 5"),
        ("--threads 0", "threads is 0"),
        ("--seed x", "--seed"),
        ("--prior cauchy", "cauchy"),
        ("--unknown", "--unknown"),
    ];
    for (flags, part) in more {
        says(&folder, &format!("{infer} {flags}"), &[part]);
    }
    says(&folder, "infer", &["--features"]);
    says(
        &folder,
        &format!("infer {features}"),
        &["evidence: got none, expected --preferences, --rankings or --progress"],
    );
    says(&folder, &format!("infer --demonstrations {EXAMPLES}/demonstrations.csv"), &["--mdp"]);
    says(&folder, &format!("infer --mdp {EXAMPLES}/kitchen.json --rankings {EXAMPLES}/rankings.csv"), &["--features"]);
    let likelihood = infer.replace("infer", &format!("likelihood --weights {EXAMPLES}/weights.csv"));
    says(&folder, &format!("{likelihood} --beta learn"), &["--beta: got learn for the preferences, expected a number"]);
    folder.write("narrow.csv", "1,2\n");
    let narrow = likelihood.replace(&format!("{EXAMPLES}/weights.csv"), "narrow.csv");
    says(&folder, &narrow, &["narrow.csv, line 1: got 2 fields, expected 3 (one weight for each feature)"]);

    let bound = format!("bound --losses {EXAMPLES}/losses.csv");
    for (flags, part) in [
        ("--alpha 1", "alpha is 1, but must lie strictly between 0 and 1"),
        ("--alpha 0", "alpha is 0"),
        ("--delta 1.5", "delta is 1.5"),
        ("--look 0", "--look: got 0"),
        ("--chains 3", "do not divide into 3 chains"),
        ("--measure entropic --aversion 0 --worst 9", "the risk aversion is 0"),
        ("--measure semideviation --coefficient 2 --worst 9", "coefficient is 2"),
        ("--tail sideways", "sideways"),
        ("--alpha x", "--alpha"),
    ] {
        says(&folder, &format!("{bound} {flags}"), &[part]);
    }
    let draws = format!("evaluate --draws {EXAMPLES}/draws.csv");
    says(&folder, &draws, &["policies: got none, expected --policy, --feature-counts or --trajectories"]);
    says(&folder, &format!("{draws} --policy {EXAMPLES}/around.json"), &["--mdp"]);
    let counts = format!("{draws} --feature-counts {EXAMPLES}/feature-counts.csv");
    says(&folder, &format!("{counts} --losses losses.csv"), &["--mdp"]);
    says(&folder, &format!("{counts} --expert-features {EXAMPLES}/weights.csv"), &["has 3 rows, but one expert has 1"]);
    let kitchen = format!("--mdp {EXAMPLES}/kitchen.json");
    says(&folder, &format!("{counts} {kitchen} --floor 0"), &["--floor: got 0"]);
    says(&folder, &format!("{counts} {kitchen} --n-demonstrations 0"), &["--n-demonstrations: got 0"]);
    says(&folder, &format!("{counts} --threads 0"), &["--threads: got 0"]);
    folder.write("jump.csv", "8,0\n3,0\n");
    let jump = format!("{counts} {kitchen} --demonstrations jump.csv");
    says(
        &folder,
        &jump,
        &["jump.csv, line 2, column 1 (state): got '3', expected a state that action 0 in state 8 leads to"],
    );
}

#[test]
fn a_prior_that_is_zero_everywhere_has_no_start() {
    let folder = Folder::new();
    // The return of row 0 is zero under every weight but rounding: never negative. So this one starts.
    folder.write("features.csv", "0,0\n1,1\n");
    folder.write("pairs.csv", "0,1\n");
    folder.json("infer --features features.csv --preferences pairs.csv --nonnegative-return 0 --draws 400");
}
