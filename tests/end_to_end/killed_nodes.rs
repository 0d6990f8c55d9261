//! `kill -9` of each node in turn: the suite brings it back, the lesson goes on, and nothing accepted is lost.

use crate::recorded::Recorded;
use crate::suite::{ENDLESS, Suite, run};
use apprentice_msgs::msg::EvidenceReceipt;
use rustix::process::Signal;
use std::time::Duration;

const LIMIT: Duration = Duration::from_secs(60);

/// A person who takes a moment.
const PERSON: &str = "  demonstrator:
    ros__parameters:
      response_delay_s: 0.1
";

/// Ids of everything that the journal holds.
fn journal(suite: &Suite) -> Vec<String> {
    suite.journal().iter().map(|record| exchange::record_id(record).to_owned()).collect()
}

/// Waits until two more answers have been accepted.
fn goes_on(suite: &mut Suite, after: &str) {
    let before = journal(suite).len();
    suite.wait_for(&format!("two more answers after {after}"), LIMIT, |suite| {
        (journal(suite).len() >= before + 2).then_some(())
    });
}

#[test]
fn each_node_is_killed_in_turn_and_nothing_accepted_is_lost() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("endless.yaml");
    std::fs::write(&file, format!("{ENDLESS}{PERSON}")).expect("a file can be written");
    let file = file.to_string_lossy().into_owned();
    let mut suite = Suite::start("killed", &["--params-file", &file]);
    goes_on(&mut suite, "the start");
    let nodes = [
        "reward_posterior",
        "performance_bounds",
        "active_query",
        "placement_planner",
        "demonstrator",
        "simulated_table",
        "operator_ui",
        "session_recorder",
        // Twice, since it is the one that keeps the evidence.
        "reward_posterior",
    ];
    for node in nodes {
        let before = journal(&suite);
        let killed = suite.kill(node);
        suite.wait_for(&format!("{node} to come back"), LIMIT, |suite| suite.node(node).filter(|pid| *pid != killed));
        goes_on(&mut suite, &format!("the death of {node}"));
        assert!(journal(&suite).starts_with(&before), "{node}: the journal lost what it had");
        let told = suite
            .shown()
            .lines()
            .any(|line| line.contains(node) && (line.contains("killed") || line.contains("signal 9")));
        assert!(told, "the death of {node} is not told\n{}", suite.dump());
    }
    assert!(suite.stop(Signal::INT).success(), "{}", suite.dump());

    let kept = journal(&suite);
    let bag = Recorded::read(&suite.bag()).expect("the bag opens");
    assert!(bag.whole, "a file of the bag is not finished");
    assert_eq!(bag.accepted(), kept, "the bag's log of evidence against the journal");
    let acknowledged = bag.distinct::<EvidenceReceipt>("receipt");
    for receipt in acknowledged.iter().filter(|receipt| receipt.outcome == EvidenceReceipt::ACCEPTED) {
        assert!(kept.contains(&receipt.id), "{} was accepted and lost", receipt.id);
    }
    let path = suite.bag().to_string_lossy().into_owned();
    drop(suite);
    let replayed = run(&["replay", "--verify", &path]);
    assert!(
        replayed.status.success(),
        "{}{}",
        String::from_utf8_lossy(&replayed.stdout),
        String::from_utf8_lossy(&replayed.stderr)
    );
}
