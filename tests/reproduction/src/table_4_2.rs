//! Table 4.2: which of three drivers is safest, given one demonstration of safe driving.

use crate::chapter4::{
    BoundKind, Demonstration, Evidence, Judged, Problem, Quality, Walk, believe, choices, purpose, walk_on,
};
use crate::harness::plot::{Content, Panel, Picture, Series, Style};
use crate::harness::{
    Claim, Estimate, Options, Outcome, ReproductionError, TextTable, generator, replicates, to_value,
};
use likelihood::actions::without_duplicates;
use mdp::worlds::driving;
use mdp::{feature_counts, finite_feature_counts, rollout};
use posterior::Rationality;
use serde::Serialize;

/// The drivers, the safest first.
const DRIVERS: [(&str, [f64; driving::N_FEATURES]); 3] =
    [("right-safe", driving::RIGHT_SAFE), ("on-road", driving::ON_ROAD), ("nasty", driving::NASTY)];
/// (collisions, WFCB, .95 bound) in the dissertation.
const PRINTED: [(f64, f64, f64); 3] = [(0.0, 5.51, 0.85), (13.65, 1.93, 1.09), (42.75, 4.11, 2.44)];
/// Steps of the demonstration; collisions are counted over one state more.
const LENGTH: usize = 100;
/// The author's β, and how long he walks: 2,000 steps, 20 not kept, then every second kept.
const BETA: f64 = 10.0;
const WALK: Walk = Walk { steps: 2000, burn: 20, every: 2 };
/// A driver without a favourite lane, so repeated choices among equals tell that they are equal.
const SHOWN: Evidence =
    Evidence { rationality: Rationality::Learned { median: 30.0, log_sd: 1.5 }, repeats: true, wrong_rate: 0.0 };
const KIND: BoundKind = BoundKind::ValueAtRisk(1);
/// Single runs of 20 that must rank the drivers rightly.
const SHARE: f64 = 0.95;

/// One replicate: the drivers as judged.
#[derive(Debug, Clone, Copy, Serialize)]
struct Row {
    published: [Judged; 3],
    ours: [Judged; 3],
    quality: Quality,
}

/// Makes the table.
pub fn run(options: &Options) -> Result<Outcome, ReproductionError> {
    let n = options.count(20)?;
    let world = driving::world();
    let size: f64 = driving::SAFE.iter().map(|w| w.abs()).sum();
    let problem = Problem::with(world, driving::SAFE.iter().map(|w| w / size).collect())?;
    let mut counts = Vec::new();
    let mut collisions = Vec::new();
    for (_, weights) in DRIVERS {
        let driver = driving::driver(&problem.mdp, &weights);
        counts.push(feature_counts(&problem.mdp, &driver)?);
        collisions.push(finite_feature_counts(&problem.mdp, &driver, LENGTH + 1, 1.0)?[driving::COLLISION]);
    }
    let rows =
        replicates("table-4.2", n, options.threads, |replicate| one(&problem, &counts, options.seed, replicate))?;
    Ok(Outcome {
        name: "table-4.2",
        title: "ranking of three drivers after one demonstration",
        replicates: n,
        seed: options.seed,
        notes: vec![
            "the author's simulator as an exact process of 105 states; drivers take equally good actions equally often"
                .into(),
            "as published: walk of 2,000 steps, β = 10, repeated pairs removed, printed index".into(),
            "ours: HMC, β learned, repeated pairs count, index by effective sample size".into(),
            "true loss: under the demonstrator's reward, scaled to ‖w‖₁ = 1".into(),
        ],
        tables: vec![table(&rows, &collisions)],
        claims: claims(&rows, &collisions),
        picture: picture(&rows),
        data: to_value(&rows),
    })
}

fn one(problem: &Problem, counts: &[Vec<f64>], seed: u64, replicate: usize) -> Result<Row, ReproductionError> {
    let mdp = &problem.mdp;
    let start = mdp.initial().iter().position(|p| *p > 0.0).unwrap_or(0);
    let mut generator_of_demonstrations = generator(seed, replicate, purpose::DEMONSTRATIONS);
    let driver = driving::driver(mdp, &driving::SAFE);
    let shown: [Demonstration; 1] = [rollout(mdp, &driver, start, LENGTH, &mut generator_of_demonstrations)?];
    let mut walks = generator(seed, replicate, purpose::WALK);
    let walked = walk_on(mdp, without_duplicates(&choices(&shown)), BETA, WALK, &mut walks)?;
    let published = [
        walked.judge(problem, &shown, &counts[0])?,
        walked.judge(problem, &shown, &counts[1])?,
        walked.judge(problem, &shown, &counts[2])?,
    ];
    let mut chains = generator(seed, replicate, purpose::CHAINS);
    let (ours, quality) = believe(mdp, &shown, SHOWN, &mut chains, |belief| {
        let of = |i: usize| belief.judge(problem, &counts[i]);
        let ours = [of(0)?, of(1)?, of(2)?];
        Ok(((ours, belief.quality()), ours.iter().all(|judged| KIND.of(judged).is_some())))
    })?;
    Ok(Row { published, ours, quality })
}

type Of = fn(&Row) -> &[Judged; 3];

fn bounds(rows: &[Row], of: Of, driver: usize, kind: BoundKind) -> Estimate {
    Estimate::of(&rows.iter().filter_map(|row| kind.of(&of(row)[driver])).collect::<Vec<f64>>())
}

/// Single runs in which the bounds rise from the safest driver to the worst.
fn right_runs(rows: &[Row], of: Of, kind: BoundKind) -> usize {
    let right = |row: &&Row| {
        let bounds: Option<Vec<f64>> = of(row).iter().map(|judged| kind.of(judged)).collect();
        bounds.is_some_and(|bounds| bounds[0] < bounds[1] && bounds[1] < bounds[2])
    };
    rows.iter().filter(right).count()
}

fn table(rows: &[Row], collisions: &[f64]) -> TextTable {
    let mut table = TextTable::new(
        "Collisions in 101 states, and mean bound ± s.e., by driver",
        &["", "right-safe", "on-road", "nasty", "right runs"],
    );
    let n = rows.len();
    table.row("collisions D", PRINTED.map(|printed| format!("{:.2}", printed.0)));
    table.row("collisions, exact", collisions.iter().map(|x| format!("{x:.2}")));
    table.row("true loss, exact", rows[0].published.map(|judged| format!("{:.3}", judged.loss)));
    table.row("WFCB D", PRINTED.map(|printed| format!("{:.2}", printed.1)));
    let mut line = |name: &str, of: Of, kind| {
        let mut cells: Vec<String> = (0..3).map(|i| bounds(rows, of, i, kind).text()).collect();
        cells.push(format!("{} of {n}", right_runs(rows, of, kind)));
        table.row(name, cells);
    };
    line("WFCB as published", |row| &row.published, BoundKind::WorstCase);
    table.row("VaR .95 D", PRINTED.map(|printed| format!("{:.2}", printed.2)));
    let mut line = |name: &str, of: Of, kind| {
        let mut cells: Vec<String> = (0..3).map(|i| bounds(rows, of, i, kind).text()).collect();
        cells.push(format!("{} of {n}", right_runs(rows, of, kind)));
        table.row(name, cells);
    };
    line("VaR .95 as published", |row| &row.published, KIND);
    line("VaR .95 ours", |row| &row.ours, KIND);
    table
}

fn claims(rows: &[Row], collisions: &[f64]) -> Vec<Claim> {
    let means = |of: Of, kind| -> Vec<f64> { (0..3).map(|i| bounds(rows, of, i, kind).mean).collect() };
    let rising = |means: &[f64]| means[0] < means[1] && means[1] < means[2];
    let list = |means: &[f64]| means.iter().map(|x| format!("{x:.3}")).collect::<Vec<_>>().join(" < ");
    let (published, worst_case) =
        (means(|row| &row.published, KIND), means(|row| &row.published, BoundKind::WorstCase));
    let ours = means(|row| &row.ours, KIND);
    let (n, right) = (rows.len(), right_runs(rows, |row| &row.ours, KIND));
    vec![
        Claim::matched("collisions: none < some < many", collisions[0] == 0.0 && rising(collisions), list(collisions)),
        Claim::matched("VaR .95 ranks the drivers rightly on average", rising(&published), list(&published)),
        Claim::matched(
            "WFCB ranks right-safe last on average",
            worst_case[0] > worst_case[1] && worst_case[0] > worst_case[2],
            worst_case.iter().map(|x| format!("{x:.2}")).collect::<Vec<_>>().join(", "),
        ),
        Claim::beaten("ours: ranks rightly on average", rising(&ours), list(&ours)),
        Claim::beaten(
            "ours: ranks rightly in at least 19 of 20 single runs",
            right as f64 >= SHARE * n as f64,
            format!("{right} of {n}; as published {} of {n}", right_runs(rows, |row| &row.published, KIND)),
        ),
    ]
}

fn picture(rows: &[Row]) -> Picture {
    let line = |label: &str, colour, style, of: Of, kind| {
        let at = |i: usize| {
            let estimate = bounds(rows, of, i, kind);
            (i, estimate.mean, estimate.standard_error)
        };
        Series { label: label.into(), colour, style, points: (0..3).map(at).collect() }
    };
    let printed = |label: &str, colour, pick: fn((f64, f64, f64)) -> f64| Series {
        label: label.into(),
        colour,
        style: Style::Printed,
        points: PRINTED.into_iter().enumerate().map(|(i, row)| (i, pick(row), 0.0)).collect(),
    };
    let losses = rows[0].published.iter().enumerate().map(|(i, judged)| (i, judged.loss, 0.0)).collect();
    Picture {
        title: "Table 4.2: bounds on three drivers (± 1 s.e.)".into(),
        content: Content::Panels(vec![Panel {
            x: "driver".into(),
            y: "bound on the loss (return)".into(),
            places: DRIVERS.iter().map(|(name, _)| (*name).into()).collect(),
            range: [0.0, 6.0],
            logarithmic: false,
            levels: vec![],
            series: vec![
                printed("WFCB, D", 1, |row| row.1),
                line("WFCB, as published", 1, Style::Published, |row| &row.published, BoundKind::WorstCase),
                printed("VaR .95, D", 0, |row| row.2),
                line("VaR .95, as published", 0, Style::Published, |row| &row.published, KIND),
                line("VaR .95, ours", 0, Style::Best, |row| &row.ours, KIND),
                Series { label: "true loss".into(), colour: 6, style: Style::Printed, points: losses },
            ],
        }]),
    }
}
