//! A lesson about a world, taught by a DDS program that is not ours: three nodes and no table. Killed, recorded, replayed.

use crate::python;
use crate::recorded::Recorded;
use crate::suite::{LOOPBACK, Process, Turn, apprentice, fresh_domain, fresh_folder, now, run};
use apprentice_msgs::msg::{
    EvidenceReceipt, Heartbeat, PolicyBounds, PolicySet, Posterior, PosteriorPreview, RiskBound, TabularWorld,
};
use rustix::process::{Signal, kill_process};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;
use std::time::Duration;

const LIMIT: Duration = Duration::from_secs(60);

/// A node with parameters, alone, as `ros2 run` would start it.
fn node(domain: u32, name: &str, parameters: &[String]) -> Process {
    let mut arguments = vec![name, "--ros-args", "-r", "__ns:=/apprentice"];
    arguments.extend(parameters.iter().flat_map(|parameter| ["-p", parameter]));
    Process::start(apprentice(domain, &arguments), name)
}

fn reward_posterior(domain: u32, folder: &Path) -> Process {
    let journal = format!("journal:={}", folder.join("evidence.journal").display());
    let learned = "beta_preferences_log_sd:=0.5".to_owned();
    node(domain, "reward_posterior", &[journal, learned, "republish_period_s:=1.0".to_owned()])
}

/// The recorded bag, once it holds what is looked for.
fn recorded<T>(bag: &Path, what: &str, look: impl Fn(&Recorded) -> Option<T>) -> T {
    let start = now();
    loop {
        if let Some(found) = Recorded::read(bag).ok().as_ref().and_then(&look) {
            return found;
        }
        assert!(start.elapsed() < LIMIT, "waited {LIMIT:?} in vain for {what}");
        std::thread::sleep(Duration::from_millis(50));
    }
}

#[test]
fn a_lesson_about_a_world_is_taught_by_a_peer_survives_a_kill_and_is_replayed_to_the_bit() {
    let _turn = Turn::take();
    let folder = fresh_folder("tabular");
    let bag = folder.join("bag");
    let domain = fresh_domain();
    let mut recorder = node(domain, "session_recorder", &[format!("output:={}", bag.display())]);
    let mut posterior = reward_posterior(domain, &folder);
    let mut bounds = node(domain, "performance_bounds", &[]);

    let mut peer = python::script("tabular_peer.py", &[&domain.to_string()]);
    peer.env("CYCLONEDDS_URI", LOOPBACK);
    let told = python::run(peer, "the peer", Duration::from_secs(200));
    let receipts = told["receipts"].as_array().expect("receipts");
    let ids: Vec<&str> = receipts.iter().filter_map(|receipt| receipt["id"].as_str()).collect();
    assert_eq!(ids, ["a", "p", "wrong", "c", "h", "undo"]);
    assert!(receipts.iter().all(|receipt| receipt["outcome"] != EvidenceReceipt::REFUSED), "{told}");
    assert_eq!(told["revision"], 6);
    let n = &told["n"];
    assert_eq!([&n["placements"], &n["actions"], &n["preferences"], &n["critiques"], &n["progress"]], [0, 1, 1, 1, 1]);
    let of = |id: &str| -> Value {
        let policies = told["policies"].as_array().expect("policies");
        policies.iter().find(|policy| policy["id"] == id).expect("it was judged").clone()
    };
    assert_eq!(of("left")["rank"], 3, "the person walks to the right: {told}");
    assert!(of("right")["loss"].as_f64() < of("left")["loss"].as_f64(), "{told}");

    // The one that keeps the evidence is killed, once it is known; the one that comes back says the same.
    let n_starts = |bag: &Recorded| {
        let alive = bag.timed::<Heartbeat>("heartbeat").into_iter().map(|(_, beat)| beat);
        let ours = alive.filter(|beat| beat.node.ends_with("reward_posterior")).map(|beat| beat.instance);
        ours.collect::<BTreeSet<String>>().len()
    };
    recorded(&bag, "the first node", |bag| (n_starts(bag) == 1).then_some(()));
    kill_process(posterior.pid(), Signal::KILL).expect("it runs");
    posterior.wait(LIMIT);
    let mut posterior = reward_posterior(domain, &folder);
    let n_before = recorded(&bag, "the restarted node", |bag| {
        (n_starts(bag) == 2).then(|| bag.timed::<Posterior>("posterior").len())
    });
    recorded(&bag, "a posterior of the restarted node", |bag| {
        (bag.timed::<Posterior>("posterior").len() > n_before).then_some(())
    });
    for process in [&mut posterior, &mut bounds, &mut recorder] {
        kill_process(process.pid(), Signal::INT).expect("it runs");
        let status = process.wait(LIMIT);
        assert!(status.success(), "{status}\n{}", process.dump());
    }

    let held = Recorded::read(&bag).expect("the bag opens");
    assert!(held.whole, "the bag is not finished");
    assert_eq!(held.accepted(), ids);
    let revisions: Vec<u64> = held.distinct::<Posterior>("posterior").iter().map(|p| p.revision).collect();
    assert!(revisions.is_sorted() && revisions.contains(&0) && revisions.last() == Some(&6), "{revisions:?}");
    let last = held.distinct::<Posterior>("posterior").pop().expect("there is one");
    assert_eq!(
        (told["evidence_hash"].as_str(), told["world_hash"].as_str()),
        (Some(&*last.evidence_hash), Some(&*last.world.hash))
    );
    assert_eq!((held.distinct::<TabularWorld>("world").len(), held.distinct::<PolicySet>("policies").len()), (1, 1));
    assert_eq!(
        held.distinct::<TabularWorld>("lesson_world"),
        held.distinct::<TabularWorld>("world"),
        "also after the kill"
    );
    assert!(!held.distinct::<PosteriorPreview>("posterior_preview").is_empty());
    for judged in held.distinct::<PolicyBounds>("policy_bounds") {
        assert_eq!((judged.policies.len(), judged.look, &judged.world), (3, judged.revision + 1, &last.world));
        for bound in judged.policies.iter().map(|policy| &policy.loss_bound) {
            let is_bound = bound.outcome == RiskBound::BOUND;
            assert!(is_bound == bound.bound.is_finite() && is_bound == bound.reason.is_empty(), "{bound:?}");
        }
    }

    let output = run(&["replay", "--verify", "--json", &bag.to_string_lossy()]);
    let words = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{words}");
    let report: Value = serde_json::from_slice(&output.stdout).expect("--json gives JSON");
    let compared = &report["verification"];
    assert!(compared["mismatch"].is_null() && compared["records"] == 6, "{compared}");
    for kind in ["posteriors", "policy_bounds", "previews"] {
        assert!(compared[kind]["recorded"].as_u64() > Some(0), "{kind}: {compared}");
    }
    assert_eq!(report["revisions"].as_array().map(Vec::len), Some(7), "{report}");
}
