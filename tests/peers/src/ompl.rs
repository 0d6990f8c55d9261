//! Motions among things on a table: ours and OMPL's RRT-Connect on the same transfers, each judged by the other's collision checks.

use std::collections::BTreeMap;
use std::path::PathBuf;

use arm::SweepSettings;
use motion::{Limits, Metric, Path, Search, connect, shorten};
use serde::{Deserialize, Serialize};

use crate::arm::{robot_error, run};
use crate::clock::{cpu_seconds, timed};
use crate::error::PeersError;
use crate::joint_space::{Edges, JointSpace, between, length};
use crate::transfers::{Carrier, Transfer};

const N_TRANSFERS: usize = 120;
/// States that OMPL checks are at most this far apart, radians along all joints: about 1.5 cm at the hand.
const STEP_RAD: f64 = 0.02;
/// The same where a path is judged.
const FINE_RAD: f64 = 0.002;
/// How far our trees grow at once where lengths are radians.
const REACH_RAD: f64 = 0.5;
/// OMPL with its own range, a fifth of the space; with ours; and as the motions came out shortest of sixteen configurations
/// that were tried.
const THEIRS: [Theirs; 3] = [
    Theirs { name: "OMPL, own range", range: None, simplifications: 1 },
    Theirs { name: "OMPL, range 0.5", range: Some(REACH_RAD), simplifications: 1 },
    Theirs { name: "OMPL, 0.25, thrice", range: Some(0.25), simplifications: 3 },
];
/// Samples after which our search ends if the time does not end it.
const SAMPLES: usize = 50_000;
/// As `placement` does it.
const SHORTCUTS: usize = 60;

/// All figures; seconds of CPU time.
#[derive(Debug, Serialize)]
pub struct Compared {
    transfers: usize,
    solvable: usize,
    /// Transfers whose straight way is free.
    straight: usize,
    rows: Vec<Row>,
    /// Starts and goals that touch something as Coal sees it.
    ends_refused: usize,
    states_sampled: usize,
    /// States of OMPL's searches that we judge otherwise than Coal.
    states_otherwise: usize,
    /// A check of one of those states: ours, Pinocchio's with Coal, and asking Python for an answer that costs nothing.
    check_us: f64,
    coal_check_us: f64,
    dispatch_us: f64,
    versions: BTreeMap<String, String>,
}

/// One program in one configuration; times and states over the solvable transfers, lengths over those it solved.
#[derive(Debug, Serialize)]
struct Row {
    name: &'static str,
    solved: usize,
    ms: Spread,
    search_ms: Spread,
    /// Of all time, spent in the checks that Python asks for; none on our side.
    callback_share: f64,
    without_callback_ms: Spread,
    /// What it would take with our checks called from C++: without the callback and without asking Python, but with our time
    /// for each state.
    with_our_checks_ms: Spread,
    search_states: Spread,
    states: Spread,
    edges: Spread,
    length_rad: Spread,
    /// Median of our lengths over its lengths, where both found a motion: of the first of our rows, then of the others.
    ours_to_it: Vec<f64>,
    verdicts: Verdicts,
    /// What was not solved, and how near things are at its ends.
    unsolved: Vec<String>,
}

/// Two quantiles.
#[derive(Debug, Clone, Copy, Serialize)]
struct Spread {
    p50: f64,
    p95: f64,
}

/// What both sides' checks say of paths, from states close to each other.
#[derive(Debug, Default, Serialize)]
struct Verdicts {
    touching_coal: usize,
    touching_us: usize,
    /// Paths that touch nothing but come nearer than the margin.
    near_coal: usize,
    near_us: usize,
    /// Paths with other numbers of touching or near states for Coal than for us.
    otherwise: usize,
    /// Paths that are free wherever we looked, but that a sweep does not prove free.
    unproven: usize,
}

/// How OMPL plans.
#[derive(Debug, Serialize)]
struct Theirs {
    #[serde(skip)]
    name: &'static str,
    range: Option<f64>,
    simplifications: usize,
}

/// How we plan.
struct Ours {
    name: &'static str,
    metric: Metric,
    reach: f64,
    edges: Edges,
}

/// One search and what follows it.
#[derive(Debug, Deserialize)]
struct Attempt {
    solved: bool,
    search_s: f64,
    simplify_s: f64,
    #[serde(default)]
    callback_s: f64,
    search_checks: u64,
    checks: u64,
    #[serde(default)]
    edges: u64,
    corners: Vec<Vec<f64>>,
    /// By Coal.
    judged: Option<Judged>,
}

/// What the Python program reports.
#[derive(Debug, Deserialize)]
struct Report {
    versions: BTreeMap<String, String>,
    ends_free: Vec<[bool; 2]>,
    runs: Vec<Vec<Attempt>>,
    ours: Vec<Vec<Option<Judged>>>,
    sampled: Vec<Sampled>,
    check_us: Vec<f64>,
    dispatch_us: f64,
}

/// States along a path.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
struct Judged {
    touching: usize,
    near: usize,
}

#[derive(Debug, Deserialize)]
struct Sampled {
    transfer: usize,
    q: Vec<f64>,
    free: bool,
}

/// Plans the same transfers on both sides, each search within `seconds`.
pub fn compare(seconds: f64, seed: u64) -> Result<Compared, PeersError> {
    let carrier = Carrier::new()?;
    let transfers = carrier.transfers(seed, N_TRANSFERS);
    let ways = ways(&carrier)?;
    let plan_all = |way: &Ours| transfers.iter().map(|one| plan(&carrier, one, way, seconds, seed)).collect();
    let mut runs: Vec<Vec<Attempt>> = ways.iter().map(plan_all).collect();
    let mut request = carrier.request(&transfers);
    let paths = |attempts: &Vec<Attempt>| attempts.iter().map(|one| one.solved.then(|| one.corners.clone())).collect();
    let paths: Vec<Vec<Option<Vec<Vec<f64>>>>> = runs.iter().map(paths).collect();
    request["ours"] = serde_json::json!(paths);
    request["configurations"] = serde_json::json!(THEIRS);
    request["step"] = STEP_RAD.into();
    request["fine"] = FINE_RAD.into();
    request["seconds"] = seconds.into();
    request["seed"] = seed.into();
    let mut report: Report = run(&python(), "motions_ompl.py", &request, "the report of OMPL's run")?;
    for (run, judged) in runs.iter_mut().zip(&report.ours) {
        run.iter_mut().zip(judged).for_each(|(attempt, judged)| attempt.judged = *judged);
    }
    runs.append(&mut report.runs);
    let compared = judge(&carrier, &transfers, &ways, &runs, report);
    print(&compared, seconds);
    Ok(compared)
}

/// The interpreter that `tests/peers/setup` sets up.
fn python() -> PathBuf {
    let own = || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(".venv/bin/python");
    std::env::var_os("APPRENTICE_PEERS_PYTHON").map_or_else(own, PathBuf::from)
}

fn ways(carrier: &Carrier) -> Result<Vec<Ours>, PeersError> {
    let speed = |&entry: &usize| carrier.settings.speed * carrier.robot.driven_joint(entry).limits.velocity;
    let speeds: Vec<f64> = carrier.chain.entries.iter().map(speed).collect();
    let limits = Limits::from_velocity(speeds, carrier.settings.acceleration_s).map_err(robot_error)?;
    let even = || Metric::even(carrier.chain.entries.len());
    let own = Search::default().step;
    Ok(vec![
        Ours { name: "ours, as it plans", metric: Metric::of_limits(&limits), reach: own, edges: Edges::Proven },
        Ours { name: "ours, proven", metric: even(), reach: REACH_RAD, edges: Edges::Proven },
        Ours { name: "ours, in steps", metric: even(), reach: REACH_RAD, edges: Edges::Stepped(STEP_RAD) },
    ])
}

fn space<'a>(carrier: &'a Carrier, transfer: &'a Transfer, edges: Edges) -> JointSpace<'a> {
    let margin = carrier.settings.margin_m;
    JointSpace::new(carrier.checker(), &transfer.world, &carrier.chain.entries, &transfer.start, edges, margin)
}

fn plan(carrier: &Carrier, transfer: &Transfer, way: &Ours, seconds: f64, seed: u64) -> Attempt {
    let mut space = space(carrier, transfer, way.edges);
    let search = Search { samples: SAMPLES, step: way.reach, seed };
    let (start, goals) = (carrier.part(&transfer.start), [carrier.part(&transfer.goal)]);
    space.until = cpu_seconds() + seconds;
    let (found, search_s) = timed(|| connect(&mut space, &way.metric, &start, &goals, &search));
    let search_checks = space.n_states;
    let found: Option<Path> = found.ok().filter(|_| !space.is_late());
    space.until = f64::INFINITY;
    let (path, simplify_s) = timed(|| found.map(|path| shorten(&mut space, &way.metric, &path, SHORTCUTS, seed)));
    let corners = path.as_ref().map_or_else(Vec::new, |path| path.corners().to_vec());
    let (checks, edges) = (space.n_states, space.n_edges);
    Attempt {
        solved: path.is_some(),
        search_s,
        simplify_s,
        callback_s: 0.0,
        search_checks,
        checks,
        edges,
        corners,
        judged: None,
    }
}

/// `runs` are first ours, then OMPL's.
fn judge(carrier: &Carrier, transfers: &[Transfer], ways: &[Ours], runs: &[Vec<Attempt>], report: Report) -> Compared {
    let mut checker = carrier.checker();
    let margin = carrier.settings.margin_m;
    let whole = |one: &Sampled| (one.transfer, carrier.moved_to(&transfers[one.transfer].start, &one.q));
    let states: Vec<(usize, Vec<f64>)> = report.sampled.iter().map(whole).collect();
    let mut verdicts = Vec::with_capacity(states.len());
    let ((), took) = timed(|| {
        for _ in 0..5 {
            verdicts.clear();
            verdicts.extend(states.iter().map(|(at, q)| checker.is_free(q, &transfers[*at].world, margin)));
        }
    });
    let check_us = 1e6 * took / (5 * states.len().max(1)) as f64;
    let solvable: Vec<usize> = (0..transfers.len()).filter(|&i| runs.iter().any(|run| run[i].solved)).collect();
    let names = ways.iter().map(|way| way.name).chain(THEIRS.iter().map(|one| one.name));
    let rows = names.zip(runs).map(|(name, run)| Row {
        ours_to_it: runs[..ways.len()].iter().map(|ours| ratio(ours, run)).collect(),
        verdicts: verify(run, carrier, transfers),
        unsolved: solvable.iter().filter(|&&i| !run[i].solved).map(|&i| ends(i, &transfers[i], carrier)).collect(),
        ..row(name, run, &solvable, check_us - report.dispatch_us)
    });
    let straight = transfers.iter().filter(|one| {
        let sweep = SweepSettings { margin, ..SweepSettings::default() };
        carrier.checker().way_is_free(&one.start, &one.goal, &one.world, &sweep)
    });
    Compared {
        transfers: transfers.len(),
        solvable: solvable.len(),
        straight: straight.count(),
        rows: rows.collect(),
        ends_refused: report.ends_free.iter().flatten().filter(|free| !**free).count(),
        states_sampled: states.len(),
        states_otherwise: verdicts.iter().zip(&report.sampled).filter(|(ours, one)| **ours != one.free).count(),
        check_us,
        coal_check_us: report.check_us.iter().sum::<f64>() / report.check_us.len().max(1) as f64,
        dispatch_us: report.dispatch_us,
        versions: report.versions,
    }
}

/// `per_state_us` is what a state checked would take more or less with our checks in place of the callback.
fn row(name: &'static str, run: &[Attempt], solvable: &[usize], per_state_us: f64) -> Row {
    let of: Vec<&Attempt> = solvable.iter().map(|&i| &run[i]).collect();
    let solved: Vec<&Attempt> = of.iter().copied().filter(|one| one.solved).collect();
    let each = |figure: &dyn Fn(&Attempt) -> f64| spread(of.iter().map(|one| figure(one)).collect());
    let total = |one: &Attempt| one.search_s + one.simplify_s;
    let without = |one: &Attempt| (total(one) - one.callback_s).max(0.0);
    let replaced = |one: &Attempt| {
        // Our own runs hold their checks already.
        let more_us = if one.callback_s > 0.0 { per_state_us * one.checks as f64 } else { 0.0 };
        (1e3 * without(one) + 1e-3 * more_us).max(0.0)
    };
    Row {
        name,
        solved: solved.len(),
        ms: each(&|one| 1e3 * total(one)),
        search_ms: each(&|one| 1e3 * one.search_s),
        callback_share: of.iter().map(|one| one.callback_s).sum::<f64>() / of.iter().map(|one| total(one)).sum::<f64>(),
        without_callback_ms: each(&|one| 1e3 * without(one)),
        with_our_checks_ms: each(&replaced),
        search_states: each(&|one| one.search_checks as f64),
        states: each(&|one| one.checks as f64),
        edges: each(&|one| one.edges as f64),
        length_rad: spread(solved.iter().map(|one| along(&one.corners)).collect()),
        ours_to_it: Vec::new(),
        verdicts: Verdicts::default(),
        unsolved: Vec::new(),
    }
}

/// The nearest two things at both ends, in words: a sweep proves nothing where they are barely the margin apart.
fn ends(number: usize, transfer: &Transfer, carrier: &Carrier) -> String {
    let mut checker = carrier.checker();
    let mut end = |q: &[f64]| match checker.nearest(q, &transfer.world, 0.05) {
        Some((contact, apart)) => {
            let name = |body: arm::Body| body.name(&carrier.robot, &transfer.world);
            format!("{:.2} mm between {} and {}", 1e3 * apart, name(contact.a), name(contact.b))
        }
        None => "nothing within 50 mm".into(),
    };
    format!("transfer {number}: {} at its start, {} at its goal", end(&transfer.start), end(&transfer.goal))
}

fn spread(mut figures: Vec<f64>) -> Spread {
    figures.sort_unstable_by(f64::total_cmp);
    Spread { p50: at(&figures, 0.5), p95: at(&figures, 0.95) }
}

/// A quantile of sorted figures.
fn at(sorted: &[f64], share: f64) -> f64 {
    let last = sorted.len().saturating_sub(1);
    sorted.get(((share * sorted.len() as f64) as usize).min(last)).copied().unwrap_or(f64::NAN)
}

fn along(corners: &[Vec<f64>]) -> f64 {
    corners.windows(2).map(|edge| length(&edge[0], &edge[1])).sum()
}

fn ratio(ours: &[Attempt], other: &[Attempt]) -> f64 {
    let both = ours.iter().zip(other).filter(|(a, b)| a.solved && b.solved);
    spread(both.map(|(a, b)| along(&a.corners) / along(&b.corners)).collect()).p50
}

fn verify(run: &[Attempt], carrier: &Carrier, transfers: &[Transfer]) -> Verdicts {
    let mut verdicts = Verdicts::default();
    let margin = carrier.settings.margin_m;
    let sweep = SweepSettings { margin, ..SweepSettings::default() };
    let mut checker = carrier.checker();
    for (attempt, transfer) in run.iter().zip(transfers).filter(|(attempt, _)| attempt.solved) {
        let mut ours = Judged { touching: 0, near: 0 };
        for part in states_along(&attempt.corners) {
            let q = carrier.moved_to(&transfer.start, &part);
            ours.touching += usize::from(!checker.is_free(&q, &transfer.world, 0.0));
            ours.near += usize::from(!checker.is_free(&q, &transfer.world, margin));
        }
        let is_proven = attempt.corners.windows(2).all(|edge| {
            let [a, b] = [&edge[0], &edge[1]].map(|part| carrier.moved_to(&transfer.start, part));
            checker.way_is_free(&a, &b, &transfer.world, &sweep)
        });
        let coal = attempt.judged.unwrap_or(Judged { touching: 0, near: 0 });
        verdicts.touching_coal += usize::from(coal.touching > 0);
        verdicts.touching_us += usize::from(ours.touching > 0);
        verdicts.near_coal += usize::from(coal.touching == 0 && coal.near > 0);
        verdicts.near_us += usize::from(ours.touching == 0 && ours.near > 0);
        verdicts.otherwise += usize::from(attempt.judged != Some(ours));
        verdicts.unproven += usize::from(ours.near == 0 && !is_proven);
    }
    verdicts
}

/// The start of a path, then every edge in equal steps.
fn states_along(corners: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut states = vec![corners[0].clone()];
    for edge in corners.windows(2) {
        let n = (length(&edge[0], &edge[1]) / FINE_RAD).ceil().max(1.0) as usize;
        states.extend((1..=n).map(|i| between(&edge[0], &edge[1], i as f64 / n as f64)));
    }
    states
}

fn print(c: &Compared, seconds: f64) {
    println!(
        "{} transfers of a Panda among 8 objects, {} solvable (some run found a motion); the straight way is free in {}; {:?}",
        c.transfers, c.solvable, c.straight, c.versions
    );
    println!(
        "  one state, CPU us: our check {:.1}, Pinocchio's with Coal {:.1}, asking Python for nothing {:.1}; {} of {} states judged otherwise; \
         {} ends refused by Coal",
        c.check_us, c.coal_check_us, c.dispatch_us, c.states_otherwise, c.states_sampled, c.ends_refused
    );
    println!("  CPU ms as p50/p95, each search at most {seconds} s; ways in radians; ratios are medians of ours / it");
    println!(
        "  {:<18} {:>6} {:>13} {:>13} {:>8} {:>13} {:>15} {:>13} {:>11} {:>5} {:>5} {:>5}  ratios of our rows",
        "",
        "solved",
        "all",
        "search alone",
        "callback",
        "without it",
        "with our checks",
        "states",
        "in search",
        "edges",
        "p50",
        "p95"
    );
    let two = |spread: &Spread| format!("{:.1}/{:.1}", spread.p50, spread.p95);
    let whole = |spread: &Spread| format!("{:.0}/{:.0}", spread.p50, spread.p95);
    for r in &c.rows {
        let ratios: Vec<String> = r.ours_to_it.iter().map(|ratio| format!("{ratio:.3}")).collect();
        println!(
            "  {:<18} {:>6} {:>13} {:>13} {:>6.0} % {:>13} {:>15} {:>13} {:>11} {:>5.0} {:>5.2} {:>5.2}  {}",
            r.name,
            r.solved,
            two(&r.ms),
            two(&r.search_ms),
            100.0 * r.callback_share,
            two(&r.without_callback_ms),
            two(&r.with_our_checks_ms),
            whole(&r.states),
            whole(&r.search_states),
            r.edges.p50,
            r.length_rad.p50,
            r.length_rad.p95,
            ratios.join(", ")
        );
    }
    println!(
        "  paths, by states {FINE_RAD} rad apart, Coal / us: touching, nearer than the margin; judged otherwise; not proven by our sweep"
    );
    for Row { name, verdicts: v, .. } in &c.rows {
        println!(
            "  {name:<18} touching {} / {}, nearer {} / {}, otherwise {}, not proven {}",
            v.touching_coal, v.touching_us, v.near_coal, v.near_us, v.otherwise, v.unproven
        );
    }
    for Row { name, unsolved, .. } in &c.rows {
        unsolved.iter().for_each(|text| println!("  not solved by {name}: {text}"));
    }
}

#[cfg(test)]
mod tests {
    use super::{Attempt, Report, along, ratio, spread, states_along};

    /// As the Python program printed it for one transfer, shortened.
    const REPORT: &str = r#"{"versions": {"ompl": "2.0.1", "pin": "4.1.0", "coal": "3.0.3"}, "ends_free": [[true, true]], "dispatch_us": 1.2,
        "runs": [[{"solved": true, "search_s": 0.01, "simplify_s": 0.04, "callback_s": 0.045, "checks": 2000, "search_checks": 300,
        "corners": [[0.0, 0.0], [3.0, 4.0]], "judged": {"touching": 0, "near": 1}}]], "ours": [[{"touching": 0, "near": 0}], [null]],
        "sampled": [{"transfer": 0, "q": [0.0, 0.0], "free": true}], "check_us": [20.0]}"#;

    #[test]
    fn reports_parse_and_ways_are_compared_where_both_found_one() {
        let report: Report = serde_json::from_str(REPORT).expect("a report");
        let theirs = &report.runs[0];
        assert_eq!((along(&theirs[0].corners), theirs[0].checks, theirs[0].edges), (5.0, 2000, 0));
        assert!((ratio(theirs, theirs) - 1.0).abs() < 1e-12);
        let none: Vec<Attempt> = Vec::new();
        assert!(ratio(&none, theirs).is_nan() && spread(Vec::new()).p95.is_nan());
    }

    #[test]
    fn states_lie_as_close_as_asked_and_hold_every_corner() {
        let corners = [vec![0.0], vec![0.01], vec![0.005]];
        let states = states_along(&corners);
        assert_eq!(states.len(), 1 + 5 + 3);
        assert!(corners.iter().all(|corner| states.contains(corner)));
    }
}
