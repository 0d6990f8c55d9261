//! Same input and seed, same bytes: whatever the threads, the layout of the files, the run.

use crate::command::{Folder, text};
use serde_json::Value;

/// An answer without how long it took.
fn without_times(mut answer: Value) -> Value {
    let object = answer.as_object_mut().expect("an object");
    object.remove("seconds");
    object.remove("cpu_seconds");
    answer
}

#[test]
fn same_seed_same_bytes_whatever_the_threads() {
    let folder = Folder::new();
    let kinds = [
        "--features config/examples/trajectories.csv --preferences config/examples/opinions.csv --beta learn",
        "--mdp config/examples/kitchen.json --demonstrations config/examples/demonstrations.csv --beta 5 --prior laplace",
        "--mdp config/examples/kitchen.json --demonstrations config/examples/demonstrations.csv --sampler l1-walk --every 5",
    ];
    for kind in kinds {
        let run =
            |more: &str, out: &str| without_times(folder.json(&format!("infer {kind} --draws 800 {more} --out {out}")));
        let first = run("--seed 7 --threads 1", "a.csv");
        assert_eq!(first, run("--seed 7 --threads 1", "b.csv"));
        assert_eq!(first, run("--seed 7 --threads 3", "c.csv"));
        assert!(folder.read("a.csv") == folder.read("b.csv") && folder.read("a.csv") == folder.read("c.csv"), "{kind}");
        run("--seed 8", "d.csv");
        assert_ne!(folder.read("a.csv"), folder.read("d.csv"), "{kind}");
    }
    let line = "evaluate --mdp config/examples/kitchen.json --draws config/examples/draws.csv --policy config/examples/around.json";
    let judged = |threads: usize| without_times(folder.json(&format!("{line} --threads {threads}")));
    assert_eq!(judged(1), judged(5));
}

#[test]
fn the_layout_of_a_file_does_not_matter() {
    let folder = Folder::new();
    folder.write("plain.csv", "0.5,0\n0,1\n-1,2\n");
    folder.write("pairs.csv", "2,1\n1,0\n");
    folder.write("fancy.csv", "\u{feff}\"speed\", \"comfort\"\r\n\r\n0.50 , 0e0\r\n\"0\",+1.0\r\n\r\n-1,2\r\n");
    folder.write("fancy-pairs.csv", "# More,Less,Confidence\r\n1,2,\r\n0.0e+00, 1.000000000000000000e+00,sure");
    let infer = |features: &str, pairs: &str| {
        let answer =
            folder.json(&format!("infer --features {features} --preferences {pairs} --draws 400 --out draws.csv"));
        (without_times(answer), folder.read("draws.csv"))
    };
    let plain = infer("plain.csv", "pairs.csv");
    assert_eq!(plain, infer("fancy.csv", "fancy-pairs.csv"));
    // Other evidence has another fingerprint and other draws.
    folder.write("pairs.csv", "1,2\n1,0\n");
    let other = infer("plain.csv", "pairs.csv");
    assert_ne!(text(&plain.0, "/evidence_hash"), text(&other.0, "/evidence_hash"));
    assert_eq!(text(&plain.0, "/evidence_hash").len(), 64);
}
