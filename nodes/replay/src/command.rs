//! `apprentice replay`: a session recomputed offline, shown as a table, and compared with the bag.

use crate::{Recording, ReplayError, Report, Round, recompute, verify};
use apprentice_msgs::msg::{LessonStatus, PlacementBound};
use clap::Parser;
use serde_json::json;
use std::path::PathBuf;
use std::process::ExitCode;

/// Recomputes every posterior, bound, question and plan of a recorded session from its evidence and settings.
///
/// Exit code 0: recomputed, and with --verify equal bit for bit; 1: something differs, and the first difference is named;
/// 2: the bag cannot be used.
#[derive(Debug, Parser)]
#[command(
    name = "apprentice replay",
    after_help = "Example:\n  apprentice replay --verify bags/session-20260101-120000/bag"
)]
pub struct Arguments {
    /// A bag's folder, its metadata.yaml, or one .mcap file
    bag: PathBuf,
    /// Compare every recorded message with the recomputed one, bit for bit
    #[arg(long)]
    verify: bool,
    /// Threads to compute with, instead of as recorded; the result does not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(i64).range(1..=1024))]
    threads: Option<i64>,
    /// Namespace of the session, for a bag that holds several
    #[arg(long, value_name = "NS")]
    namespace: Option<String>,
    /// One JSON object on standard output; the table goes to standard error
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> ExitCode {
    match replay(arguments) {
        Ok(report) if report.as_ref().is_some_and(|report| report.mismatch.is_some()) => ExitCode::FAILURE,
        Ok(_) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("apprentice replay: {}: {error}", arguments.bag.display());
            match error {
                ReplayError::Compute { .. } => ExitCode::FAILURE,
                _ => ExitCode::from(2),
            }
        }
    }
}

fn replay(arguments: &Arguments) -> Result<Option<Report>, ReplayError> {
    let bag = bag_files::open_bag(&arguments.bag)?;
    for (file, damage) in bag.damage() {
        eprintln!("apprentice replay: {}: {damage}", file.display());
    }
    let messages = bag.messages().collect::<Result<Vec<_>, _>>()?;
    let parts = messages.iter().map(|m| (m.topic.name.as_str(), m.topic.type_name.as_str(), m.data.as_slice()));
    let recording = Recording::collect(parts, arguments.namespace.as_deref())?;
    let show = |line: String| if arguments.json { eprintln!("{line}") } else { println!("{line}") };
    show(format!("{:>8}  {:>5}  {:>10}  {:>6}  {:>6}  state", "revision", "shown", "bound", "R-hat", "ESS"));
    let mut lesson = recompute(&recording, arguments.threads, |round| show(line(round)))?;
    let report = if arguments.verify { Some(verify(&recording, &mut lesson)?) } else { None };
    if let Some(report) = &report {
        for text in words(report) {
            show(text);
        }
    }
    if arguments.json {
        let rounds: Vec<_> = lesson.rounds.iter().map(summary).collect();
        println!("{}", json!({ "bag": arguments.bag, "revisions": rounds, "verification": report }));
    }
    Ok(report)
}

fn line(round: &Round) -> String {
    let Some(table) = &round.table else {
        let posterior = &round.posterior;
        let n: u64 = posterior.rationalities.iter().map(|of| of.n).sum();
        let (revision, rhat, ess) = (posterior.revision, posterior.rhat_max, posterior.ess_bulk_min);
        return format!("{revision:>8}  {n:>5}  {:>10}  {rhat:>6.4}  {ess:>6.0}  no table", "");
    };
    let bounds = &table.bounds;
    let bound = if bounds.outcome == PlacementBound::BOUND {
        format!("{:7.2} cm", 100.0 * bounds.bound_m)
    } else {
        "no bound".into()
    };
    let (shown, rhat, ess) = (round.posterior.n_demonstrations, bounds.rhat_max, bounds.ess_min);
    format!("{:>8}  {shown:>5}  {bound:>10}  {rhat:>6.4}  {ess:>6.0}  {}", bounds.revision, state(table.lesson.state))
}

fn summary(round: &Round) -> serde_json::Value {
    let posterior = &round.posterior;
    let Some(table) = &round.table else {
        return json!({
            "revision": posterior.revision,
            "evidence_hash": posterior.evidence_hash,
            "rhat_max": posterior.rhat_max,
            "ess_min": posterior.ess_bulk_min,
            "reason": posterior.reason,
        });
    };
    json!({
        "revision": posterior.revision,
        "demonstrations": posterior.n_demonstrations,
        "evidence_hash": posterior.evidence_hash,
        "bound_m": table.bounds.bound_m,
        "rhat_max": table.bounds.rhat_max,
        "ess_min": table.bounds.ess_min,
        "reason": table.bounds.reason,
        "state": state(table.lesson.state),
        "query_id": table.lesson.query_id,
    })
}

fn state(state: u8) -> &'static str {
    match state {
        LessonStatus::ASKING => "asking",
        LessonStatus::TAUGHT => "taught",
        LessonStatus::STOPPED => "stopped",
        LessonStatus::GAVE_UP => "gave up",
        LessonStatus::PAUSED => "paused",
        LessonStatus::FINISHED => "finished",
        LessonStatus::MISFIT => "misfit",
        _ => "unknown",
    }
}

fn words(report: &Report) -> Vec<String> {
    if let Some(found) = &report.mismatch {
        return vec![
            format!("DIFFERENT: {} of revision {}, field {}", found.message, found.revision, found.difference.field),
            format!("  recorded    {}", found.difference.recorded),
            format!("  recomputed  {}", found.difference.recomputed),
        ];
    }
    let kinds = [
        ("posteriors", report.posteriors),
        ("candidates", report.candidates),
        ("bounds", report.bounds),
        ("questions", report.queries),
        ("questions about worlds", report.world_queries),
        ("lesson states", report.lessons),
        ("plans", report.plans),
        ("maps of the arm's reach", report.reaches),
        ("previews", report.previews),
        ("bounds on policies", report.policy_bounds),
        ("robust policies", report.robust_policies),
        ("frontiers", report.frontiers),
    ];
    let counts: Vec<String> = kinds.iter().map(|(name, checked)| format!("{} {name}", checked.recorded)).collect();
    let mut lines = vec![format!("equal bit for bit: {} from {} accepted events", counts.join(", "), report.records)];
    for (name, checked) in kinds.iter().take(5).filter(|(_, checked)| checked.recorded < checked.revisions) {
        let missing = checked.revisions - checked.recorded;
        lines.push(format!("not in the bag: {missing} of {} {name}; there was nothing to compare", checked.revisions));
    }
    let (compared, all) = (report.policy_bounds.recorded, report.policy_bounds.revisions);
    if compared < all {
        let missing = all - compared;
        lines.push(format!(
            "not in the bag: the policies of {missing} of {all} bounds on policies; these were not compared"
        ));
    }
    lines
}
