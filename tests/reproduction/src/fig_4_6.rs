//! Figure 4.6: the most likely reward is careless about red cells; the policy of least .99-value at risk is not.

mod every_policy;

use crate::chapter4::{Demonstration, Evidence, PERFECT, Problem, Solved, Walk, believe, choices, purpose, walk_on};
use crate::harness::plot::{Cell, Content, Grid, Picture};
use crate::harness::{
    Claim, Estimate, Options, Outcome, ReproductionError, TextTable, generator, replicates, to_value,
};
use every_policy::EveryPolicy;
use likelihood::actions::without_duplicates;
use mdp::worlds::maze;
use mdp::{Mdp, Policy, improve_policy, rollout};
use serde::Serialize;
use std::time::Instant;

const ALPHA: f64 = 0.99;
const BETA: f64 = 100.0;
/// The author keeps all 10,000 steps here.
const WALK: Walk = Walk { steps: 10_000, burn: 0, every: 1 };
/// More changes than states and actions are never needed.
const MOST_CHANGES: usize = 100;
/// Steps of the demonstration, at most.
const LENGTH: usize = 100;
const SHOWN: Evidence = PERFECT;

/// One run.
#[derive(Debug, Clone, Serialize)]
struct Row {
    /// The author's way: by his walk.
    published: Climb,
    /// By our draws.
    ours: Climb,
    /// The least .99-value at risk of all deterministic policies, by our draws.
    least: f64,
    /// Its policy, an action per state.
    least_policy: Vec<usize>,
    /// Seconds to find it among all.
    seconds: f64,
    /// The .99-value at risk of the mixture of policies that the descent of the conditional value at risk ends with.
    mixture: f64,
}

/// Hill climbing from the policy of the most likely reward.
#[derive(Debug, Clone, Serialize)]
struct Climb {
    /// Weights of the most likely reward.
    map: Vec<f64>,
    /// Its policy.
    start: Vec<usize>,
    /// Its .99-value at risk.
    start_risk: f64,
    /// Where it ends.
    end: Vec<usize>,
    /// The .99-value at risk there.
    end_risk: f64,
    /// Changes of one action on the way.
    changes: usize,
}

/// Makes the figure.
pub fn run(options: &Options) -> Result<Outcome, ReproductionError> {
    let n = options.count(20)?;
    let problem = Problem::with(maze::world().mdp()?, maze::WEIGHTS.to_vec())?;
    let every = EveryPolicy::of(&problem.mdp, maze::STARTS);
    let rows = replicates("fig-4.6", n, options.threads, |replicate| one(&problem, &every, options.seed, replicate))?;
    Ok(Outcome {
        name: "fig-4.6",
        title: "value at risk improved by hill climbing",
        replicates: n,
        seed: options.seed,
        notes: vec![
            "the grid is the author's; the dissertation shows one run, here are several that differ in the chain alone"
                .into(),
            "as published: all 10,000 steps of the walk, β = 100; ours: HMC, β learned".into(),
            format!(
                "least of all: exact, by branch and bound over all pairs of the {} ways from one start and the {} from the other that differ in their feature counts",
                every.n_walks(0),
                every.n_walks(1)
            ),
        ],
        tables: vec![table(&rows)],
        claims: claims(&problem.mdp, &rows),
        picture: picture(&problem.mdp, &rows[0]),
        data: to_value(&rows),
    })
}

fn one(problem: &Problem, every: &EveryPolicy, seed: u64, replicate: usize) -> Result<Row, ReproductionError> {
    let mdp = &problem.mdp;
    let policy = Policy::Deterministic(problem.optimal.clone());
    let mut unused = generator(seed, replicate, purpose::DEMONSTRATIONS);
    let mut shown: Demonstration = rollout(mdp, &policy, maze::STARTS[0], LENGTH, &mut unused)?;
    // In the end there is nothing to choose.
    shown.retain(|&(state, _)| !mdp.is_terminal(state));
    let shown = [shown];
    let mut walks = generator(seed, replicate, purpose::WALK);
    let walked = walk_on(mdp, without_duplicates(&choices(&shown)), BETA, WALK, &mut walks)?;
    let published = climb(problem, &walked.map, &walked.draws)?;
    let mut chains = generator(seed, replicate, purpose::CHAINS);
    let draws = believe(mdp, &shown, SHOWN, &mut chains, |belief| Ok((belief.draws.clone(), true)))?;
    let ours = climb(problem, &draws.map_weights, &draws.values)?;
    let (found, seconds) = timed(|| every.safest(&draws.values, ALPHA));
    let (least, least_policy) = found;
    let solved = Solved::new(mdp, &draws.values);
    let mixture = solved.value_at_risk(&solved.least_risk_counts(mdp, ALPHA), ALPHA);
    Ok(Row { published, ours, least, least_policy, seconds, mixture })
}

#[expect(clippy::disallowed_methods, reason = "how long it takes is part of the result")]
fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let began = Instant::now();
    let result = work();
    (result, began.elapsed().as_secs_f64())
}

/// Climbs from the policy of some weights, by the value at risk over `draws`.
fn climb(problem: &Problem, map: &[f64], draws: &[f64]) -> Result<Climb, ReproductionError> {
    let mdp = &problem.mdp;
    let (start, counts) = problem.greedy(map);
    let solved = Solved::new(mdp, draws);
    let risk = |counts: &[f64]| solved.value_at_risk(counts, ALPHA);
    let start_risk = risk(&counts);
    let better = improve_policy(mdp, &Policy::Deterministic(start.clone()), MOST_CHANGES, risk)?;
    let Policy::Deterministic(end) = better.policy else { unreachable!("a deterministic policy stays one") };
    Ok(Climb { map: map.to_vec(), start, start_risk, end, end_risk: better.objective, changes: better.n_changes })
}

fn table(rows: &[Row]) -> TextTable {
    let mut table =
        TextTable::new(".99-value at risk of the loss, mean ± s.e. over runs", &["policy", "value at risk", "changes"]);
    let mean = |of: &dyn Fn(&Row) -> f64| Estimate::of(&rows.iter().map(of).collect::<Vec<f64>>()).text();
    table.row("most likely reward, as published", [mean(&|row| row.published.start_risk)]);
    let changes = |of: fn(&Row) -> usize| mean(&|row| of(row) as f64);
    table.row(
        "hill climbing, as published",
        [mean(&|row| row.published.end_risk), changes(|row| row.published.changes)],
    );
    table.row("most likely reward, ours", [mean(&|row| row.ours.start_risk)]);
    table.row("hill climbing, ours", [mean(&|row| row.ours.end_risk), changes(|row| row.ours.changes)]);
    table.row("least of all deterministic policies, ours", [mean(&|row| row.least)]);
    table.row("mixture, by its conditional value at risk, ours", [mean(&|row| row.mixture)]);
    table.row("milliseconds to find the least of all", [mean(&|row| 1000.0 * row.seconds)]);
    table
}

fn claims(mdp: &Mdp, rows: &[Row]) -> Vec<Claim> {
    let n = rows.len();
    let count = |of: &dyn Fn(&Row) -> bool| rows.iter().filter(|row| of(row)).count();
    let all = |name: &str, make: fn(String, bool, String) -> Claim, of: &dyn Fn(&Row) -> bool| {
        let held = count(of);
        make(name.to_owned(), held == n, format!("in {held} of {n} runs"))
    };
    let reddens = |policy: &[usize]| maze::STARTS.map(|start| n_red(mdp, policy, start));
    let slowest = rows.iter().map(|row| row.seconds).fold(0.0, f64::max);
    vec![
        all("the policy of the most likely reward crosses red from the second start", Claim::matched, &|row| {
            reddens(&row.published.start)[1] > 0
        }),
        all("hill climbing ends with a policy that avoids red from both starts", Claim::matched, &|row| {
            reddens(&row.published.end) == [0, 0]
        }),
        all("ours: it ends at the global optimum of all deterministic policies", Claim::beaten, &|row| {
            (row.ours.end_risk - row.least).abs() <= 1e-9 * (1.0 + row.least.abs())
        }),
        Claim::beaten(
            "the global optimum is found in less than .1 s",
            slowest < 0.1,
            format!("slowest run {:.0} ms", 1000.0 * slowest),
        ),
    ]
}

/// Red cells that a policy enters from a start, before it ends or repeats itself.
fn n_red(mdp: &Mdp, policy: &[usize], start: usize) -> usize {
    trail(mdp, policy, start).iter().filter(|&&state| mdp.features(state, 0)[1] > 0.0).count()
}

/// The states that a deterministic policy visits from a start.
fn trail(mdp: &Mdp, policy: &[usize], start: usize) -> Vec<usize> {
    let mut states = vec![start];
    loop {
        let state = states[states.len() - 1];
        match mdp.successors(state, policy[state]).next() {
            Some((next, _)) if !states.contains(&next) => states.push(next),
            _ => return states,
        }
    }
}

fn picture(mdp: &Mdp, row: &Row) -> Picture {
    let grid = |caption: &str, policy: &[usize], risk: f64| {
        let visited: Vec<usize> = maze::STARTS.iter().flat_map(|&start| trail(mdp, policy, start)).collect();
        let cell = |state: usize| Cell {
            red: mdp.features(state, 0)[1] > 0.0,
            terminal: mdp.is_terminal(state),
            start: maze::STARTS.contains(&state),
            action: policy[state],
            visited: visited.contains(&state),
        };
        Grid {
            caption: caption.into(),
            detail: format!(".99-value at risk {risk:.3}"),
            columns: 5,
            cells: (0..mdp.n_states()).map(cell).collect(),
        }
    };
    Picture {
        title: "Figure 4.6: policies on white and red cells, one run (circles: starts; the left one was demonstrated)"
            .into(),
        content: Content::Grids(vec![
            grid("most likely, as published", &row.published.start, row.published.start_risk),
            grid("hill climbing, as published", &row.published.end, row.published.end_risk),
            grid("hill climbing, ours", &row.ours.end, row.ours.end_risk),
            grid("least of all policies, ours", &row.least_policy, row.least),
        ]),
    }
}
