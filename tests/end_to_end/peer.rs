//! A DDS program that is not ours teaches, and another one that comes late learns how far the lesson is.

use crate::python;
use crate::recorded::Recorded;
use crate::suite::{LOOPBACK, Suite};
use apprentice_msgs::msg::{EvidenceReceipt, PerformanceBounds, PlacementQuery, Posterior};
use sha2::{Digest, Sha256};
use std::time::Duration;

/// Nothing is said again within the test, so that a late joiner has only what DDS keeps for it.
const SAY_ONCE: &str = "/**:\n  reward_posterior:\n    ros__parameters:\n      republish_period_s: 3600.0\n  performance_bounds:\n    ros__parameters:\n      republish_period_s: 3600.0\n";

#[test]
fn a_peer_of_another_make_teaches_and_a_late_joiner_is_told_the_newest() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("say-once.yaml");
    std::fs::write(&file, SAY_ONCE).expect("a file can be written");
    let file = file.to_string_lossy().into_owned();
    let mut suite = Suite::start("peer", &["--demonstrator", "human", "--params-file", &file]);
    suite.wait_for("the first question", Duration::from_secs(60), |suite| {
        Recorded::read(&suite.bag()).ok().filter(|bag| !bag.distinct::<PlacementQuery>("query").is_empty())
    });

    let mut peer = python::script("peer.py", &[&suite.domain.to_string()]);
    peer.env("CYCLONEDDS_URI", LOOPBACK);
    let told = python::run(peer, "the peer", Duration::from_secs(200));
    // The peer repeats itself until it hears a receipt; that of the first time may have gone out before it could hear.
    let taken = [EvidenceReceipt::ACCEPTED, EvidenceReceipt::DUPLICATE]
        .iter()
        .any(|outcome| told["receipt_outcome"] == *outcome);
    assert!(taken, "{told}\n{}", suite.dump());
    assert_eq!(told["revision"], 1, "{told}");
    assert_eq!(told["first"], told["late"], "a late joiner is told the same");
    assert!(suite.stop(rustix::process::Signal::INT).success(), "{}", suite.dump());

    let bag = Recorded::read(&suite.bag()).expect("the bag opens");
    assert_eq!(bag.accepted(), ["peer-1"]);
    let posterior = bag.distinct::<Posterior>("posterior").into_iter().find(|p| p.revision == 1).expect("recorded");
    let bounds = bag.distinct::<PerformanceBounds>("bounds").into_iter().find(|b| b.revision == 1).expect("recorded");
    let heard = &told["late"];
    let draws: Vec<u8> = posterior.draws.iter().flat_map(|draw| draw.to_le_bytes()).collect();
    let digest: String = Sha256::digest(&draws).iter().map(|byte| format!("{byte:02x}")).collect();
    assert_eq!(heard["draws_sha256"], digest.as_str());
    assert_eq!(heard["evidence_hash"], posterior.evidence_hash.as_str());
    assert_eq!(heard["bound_m"].as_f64(), Some(bounds.bound_m).filter(|bound| bound.is_finite()));
    assert_eq!(heard["bounds_outcome"], bounds.outcome);
    assert_eq!(heard["n_bounds"], bounds.bounds.len());
    assert_eq!(heard["reason"], bounds.reason.as_str());
}
