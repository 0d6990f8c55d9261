//! A lesson with a simulated person: how long each step takes, and how near the robot comes.

use crate::recorded::Recorded;
use crate::suite::{Suite, fresh_folder};
use apprentice_msgs::msg::{EvidenceReceipt, LessonStatus, PerformanceBounds, PlacementQuery, Posterior};
use serde_json::{Value, json};
use std::time::Duration;

/// Teaches the scenario with seed 1.
pub fn measure(scenario: &str) -> Value {
    let file = fresh_folder(&format!("figures-{scenario}-summary")).join("summary.json");
    let text = file.to_string_lossy().into_owned();
    let arguments = ["--headless", "--until-taught", "--scenario", scenario, "--seed", "1", "--summary", &text];
    let mut suite = Suite::start(&format!("figures-{scenario}"), &arguments);
    let status = suite.wait(Duration::from_secs(600));
    let summary: Value =
        std::fs::read_to_string(&file).ok().and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default();
    let steps = Recorded::read(&suite.bag()).map(|bag| steps(&bag)).unwrap_or_default();
    json!({
        "exit": status.code(),
        "state": summary["state"],
        "questions": summary["questions_asked"],
        "last bound, m": summary["last_bound_m"],
        "wall time, s": summary["wall_time_s"],
        "start to first question, s": summary["start_to_first_question_s"],
        "answer accepted to": steps,
    })
}

/// From the receipt of an answer to what follows from it, by the recorder's clock, in milliseconds.
fn steps(bag: &Recorded) -> Value {
    let receipts = bag.timed::<EvidenceReceipt>("receipt");
    let accepted: Vec<(u64, u64)> = receipts
        .iter()
        .filter(|(_, receipt)| receipt.outcome == EvidenceReceipt::ACCEPTED)
        .map(|(time, receipt)| (receipt.revision, *time))
        .collect();
    let to = |of: Vec<(u64, u64)>| {
        let first = |revision: u64| of.iter().filter(|(r, _)| *r == revision).map(|(_, time)| *time).min();
        let spans =
            accepted.iter().filter_map(|(revision, at)| Some(first(*revision)?.saturating_sub(*at) as f64 / 1e6));
        crate::percentiles(spans.collect())
    };
    json!({
        "posterior, ms": to(bag.timed::<Posterior>("posterior").into_iter().map(|(t, m)| (m.revision, t)).collect()),
        "bounds, ms": to(bag.timed::<PerformanceBounds>("bounds").into_iter().map(|(t, m)| (m.revision, t)).collect()),
        "next question, ms": to(bag.timed::<PlacementQuery>("query").into_iter().map(|(t, m)| (m.revision, t)).collect()),
        "state of the lesson, ms": to(bag.timed::<LessonStatus>("lesson").into_iter().map(|(t, m)| (m.revision, t)).collect()),
    })
}
