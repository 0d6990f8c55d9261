//! Figure 4.2: bounds on the loss of the policy learned from perfect demonstrations, by number of demonstrations.

use crate::chapter4::{
    ALPHAS, BoundKind, Demonstration, Demonstrator, Evidence, Judged, PERFECT, Problem, Quality, accuracy,
    at_least_alpha, believe, demonstrate, error, paired_errors, purpose, walk, without_bound,
};
use crate::harness::plot::{Content, Panel, Picture, Series, Style};
use crate::harness::{
    Claim, Estimate, Options, Outcome, ReproductionError, TextTable, generator, replicates, to_value, uniformity,
};
use mdp::random::uniform;
use posterior::Rationality;
use rand_chacha::ChaCha8Rng;
use serde::Serialize;

/// Numbers of demonstrations.
const SHOWN: [usize; 5] = [1, 3, 5, 7, 9];
/// β of the dissertation, for perfect demonstrations.
const BETA: f64 = 100.0;
/// (accuracy, error) by [`SHOWN`] in the author's plot, read off within .01 and .02; 1, 5 and 9 demonstrations are in the method notes.
const AUTHOR: [(BoundKind, [(f64, f64); 5]); 4] = [
    (BoundKind::WorstCase, [(1.0, 1.90), (1.0, 1.16), (1.0, 0.81), (1.0, 0.60), (1.0, 0.44)]),
    (BoundKind::ValueAtRisk(0), [(0.995, 0.27), (1.0, 0.11), (0.995, 0.05), (1.0, 0.03), (1.0, 0.02)]),
    (BoundKind::ValueAtRisk(1), [(0.97, 0.15), (0.995, 0.06), (0.99, 0.03), (1.0, 0.01), (1.0, 0.01)]),
    (BoundKind::ValueAtRisk(2), [(0.925, 0.10), (0.96, 0.05), (0.985, 0.02), (0.985, 0.01), (1.0, 0.01)]),
];
/// Where a Boltzmann-rational demonstrator is tried as well.
const CALIBRATED: [usize; 2] = [1, 9];
/// Bins of the ranks of the calibration, and the 99.9 % point of χ² with one degree of freedom less.
const BINS: usize = 10;
const MOST_CHI_SQUARED: f64 = 27.88;

/// One replicate at one number of demonstrations.
#[derive(Debug, Clone, Copy, Serialize)]
struct Cell {
    shown: usize,
    published: Judged,
    ours_map: Judged,
    ours_mean: Judged,
    ours_least_risk: Judged,
    quality: Quality,
    calibration: Option<Calibrated>,
}

/// A Boltzmann-rational demonstrator, judged by the posterior of that very model.
#[derive(Debug, Clone, Copy, Serialize)]
struct Calibrated {
    judged: Judged,
    /// Share of draws with a smaller loss than the true one, at random among equals.
    rank: f64,
}

/// Makes the figure.
pub fn run(options: &Options) -> Result<Outcome, ReproductionError> {
    let n = options.count(200)?;
    let cells = replicates("fig-4.2", n, options.threads, |replicate| one(options.seed, replicate))?;
    let column = |i: usize| -> Vec<Cell> { cells.iter().map(|row| row[i]).collect() };
    let columns: Vec<Vec<Cell>> = (0..SHOWN.len()).map(column).collect();
    Ok(Outcome {
        name: "fig-4.2",
        title: "bounds on the loss of a policy learned from perfect demonstrations",
        replicates: n,
        seed: options.seed,
        notes: vec![
            "as published: the author's walk (10,000 steps of .01 along all pairs in printed order, 495 kept), repeated pairs removed, β = 100, printed index, policy of the MAP reward".into(),
            "ours: HMC on 4 chains, repeated pairs removed, β learned (prior 25 to 500), index by effective sample size, R̂ < 1.01; policy of least .95-value at risk, chosen by the first halves of the chains and judged by the second".into(),
            "author: read off the plot in his repository; the dissertation prints no numbers".into(),
        ],
        tables: tables(&columns),
        claims: claims(&columns, options.seed),
        picture: picture(&columns),
        data: to_value(&cells),
    })
}

fn one(seed: u64, replicate: usize) -> Result<Vec<Cell>, ReproductionError> {
    let problem = Problem::new(seed, replicate)?;
    let mdp = &problem.mdp;
    let most = SHOWN[SHOWN.len() - 1];
    let all =
        demonstrate(&problem, Demonstrator::Optimal, most, &mut generator(seed, replicate, purpose::DEMONSTRATIONS))?;
    let mut boltzmann = generator(seed, replicate, purpose::BOLTZMANN);
    let noisy = demonstrate(&problem, Demonstrator::Boltzmann(BETA), most, &mut boltzmann)?;
    let mut walks = generator(seed, replicate, purpose::WALK);
    let mut chains = generator(seed, replicate, purpose::CHAINS);
    let mut cell = |shown: usize| -> Result<Cell, ReproductionError> {
        let demonstrations = &all[..shown];
        let walked = walk(mdp, demonstrations, BETA, &mut walks)?;
        let published = walked.judge(&problem, demonstrations, &problem.greedy(&walked.map).1)?;
        let (ours, quality) = believe(mdp, demonstrations, PERFECT, &mut chains, |belief| {
            let draws = &belief.draws;
            let of = |w: &[f64]| belief.judge(&problem, &problem.greedy(w).1);
            let judged = [of(&draws.map_weights)?, of(&draws.mean_weights())?, belief.judge_least_risk(&problem)?];
            Ok(((judged, belief.quality()), judged.iter().all(Judged::is_complete)))
        })?;
        let [ours_map, ours_mean, ours_least_risk] = ours;
        let calibration = match CALIBRATED.contains(&shown) {
            true => Some(calibrate(&problem, &noisy[..shown], uniform(&mut boltzmann), &mut chains)?),
            false => None,
        };
        Ok(Cell { shown, published, ours_map, ours_mean, ours_least_risk, quality, calibration })
    };
    SHOWN.into_iter().map(&mut cell).collect()
}

/// Judges the policy of the mean reward by the posterior of exactly the model that the demonstrations come from.
fn calibrate(
    problem: &Problem,
    demonstrations: &[Demonstration],
    at_random: f64,
    chains: &mut ChaCha8Rng,
) -> Result<Calibrated, ReproductionError> {
    let model = Evidence { rationality: Rationality::Fixed(BETA), repeats: true, wrong_rate: 0.0 };
    believe(&problem.mdp, demonstrations, model, chains, |belief| {
        let counts = problem.greedy(&belief.draws.mean_weights()).1;
        let judged = belief.judge(problem, &counts)?;
        let rank = rank(&belief.losses(&counts), judged.loss, at_random);
        Ok((Calibrated { judged, rank }, judged.is_complete()))
    })
}

/// Where the truth lies among the draws, in (0, 1): uniform if the model is right. Losses of nothing but rounding are equal.
fn rank(losses: &[f64], truth: f64, at_random: f64) -> f64 {
    const ROUNDING: f64 = 1e-9;
    let below = losses.iter().filter(|&&loss| loss < truth - ROUNDING).count();
    let equal = losses.iter().filter(|&&loss| (loss - truth).abs() <= ROUNDING).count();
    (below as f64 + at_random * (equal as f64 + 1.0)) / (losses.len() as f64 + 1.0)
}

fn pick(column: &[Cell], of: impl Fn(&Cell) -> Judged) -> Vec<Judged> {
    column.iter().map(of).collect()
}

fn tables(columns: &[Vec<Cell>]) -> Vec<TextTable> {
    let head = ["accuracy / bound error", "1 demo", "3", "5", "7", "9"];
    let mut main = TextTable::new("Accuracy / mean bound error ± s.e., by number of demonstrations", &head);
    let both = |judged: &[Judged], kind| format!("{:.3} / {}", accuracy(judged, kind).mean, error(judged, kind).text());
    for (kind, printed) in AUTHOR {
        let name = kind.name();
        main.row(format!("{name} author"), printed.map(|(accuracy, error)| format!("{accuracy:.3} / {error:.2}")));
        main.row(format!("{name} as published"), columns.iter().map(|c| both(&pick(c, |cell| cell.published), kind)));
        main.row(format!("{name} ours"), columns.iter().map(|c| both(&pick(c, |cell| cell.ours_least_risk), kind)));
    }
    let mut policies = TextTable::new("True loss / .95 bound / accuracy, by evaluation policy", &head);
    let kind = BoundKind::ValueAtRisk(1);
    let of = |judged: &[Judged]| {
        let loss = Estimate::of(&judged.iter().map(|judged| judged.loss).collect::<Vec<f64>>());
        let bounds = Estimate::of(&judged.iter().filter_map(|judged| kind.of(judged)).collect::<Vec<f64>>());
        format!("{:.4} / {:.4} / {:.3}", loss.mean, bounds.mean, accuracy(judged, kind).mean)
    };
    type Of = fn(&Cell) -> Judged;
    let rows: [(&str, Of); 4] = [
        ("MAP, as published", |cell| cell.published),
        ("MAP, ours", |cell| cell.ours_map),
        ("mean reward, ours", |cell| cell.ours_mean),
        ("least risk, ours", |cell| cell.ours_least_risk),
    ];
    for (name, judged) in rows {
        policies.row(name, columns.iter().map(|column| of(&pick(column, judged))));
    }
    let none =
        |c: &Vec<Cell>| without_bound(&pick(c, |cell| cell.ours_least_risk), BoundKind::ValueAtRisk(0)).to_string();
    policies.row("replicates without a .99 bound, least risk", columns.iter().map(none));
    let head: Vec<String> =
        std::iter::once("share of bounds that hold".into()).chain(CALIBRATED.map(|n| n.to_string())).collect();
    let mut calibrated = TextTable::new("Boltzmann demonstrator (β = 100), judged by its own model", &head);
    let tried = calibrated_columns(columns);
    for (i, alpha) in ALPHAS.into_iter().enumerate() {
        let held = |c: &Vec<Calibrated>| accuracy(&judged(c), BoundKind::ValueAtRisk(i)).mean;
        calibrated.row(format!("VaR {alpha:.2}"), tried.iter().map(|c| format!("{:.3}", held(c))));
    }
    calibrated.row("χ² of the ranks of the truth (9 d.f.)", tried.iter().map(|c| format!("{:.1}", chi_squared(c))));
    vec![main, policies, calibrated]
}

fn calibrated_columns(columns: &[Vec<Cell>]) -> Vec<Vec<Calibrated>> {
    let of = |column: &Vec<Cell>| -> Vec<Calibrated> { column.iter().filter_map(|cell| cell.calibration).collect() };
    columns.iter().map(of).filter(|column| !column.is_empty()).collect()
}

fn judged(column: &[Calibrated]) -> Vec<Judged> {
    column.iter().map(|calibrated| calibrated.judged).collect()
}

fn chi_squared(column: &[Calibrated]) -> f64 {
    uniformity(&column.iter().map(|calibrated| calibrated.rank).collect::<Vec<f64>>(), BINS)
}

fn claims(columns: &[Vec<Cell>], seed: u64) -> Vec<Claim> {
    let mut claims = Vec::new();
    let published: Vec<Vec<Judged>> = columns.iter().map(|c| pick(c, |cell| cell.published)).collect();
    let ours: Vec<Vec<Judged>> = columns.iter().map(|c| pick(c, |cell| cell.ours_least_risk)).collect();
    let tried = calibrated_columns(columns);
    let model: Vec<Vec<Judged>> = tried.iter().map(|column| judged(column)).collect();
    let ordered = published
        .iter()
        .all(|judged| BoundKind::ALL.windows(2).all(|pair| error(judged, pair[0]).mean > error(judged, pair[1]).mean));
    claims.push(Claim::matched("errors are ordered WFCB > .99 > .95 > .90", ordered, "as published, at every number"));
    claims.push(at_least_alpha("as published: accuracy ≥ α", &published, Claim::matched));
    claims.push(at_least_alpha("ours: accuracy ≥ α", &ours, Claim::beaten));
    for (i, shown) in SHOWN.into_iter().enumerate() {
        let differences: Vec<f64> = paired_errors(&ours[i], &published[i], BoundKind::ValueAtRisk(1))
            .into_iter()
            .map(|(ours, other)| ours - 0.9 * other)
            .collect();
        let claim = format!("{shown} shown: .95 bound error at least 10 % lower (ours − .9 × as published < 0)");
        claims.push(Claim::smaller(claim, &differences, seed));
    }
    claims.push(at_least_alpha("Boltzmann demonstrator: issued bounds hold", &model, Claim::beaten));
    let worst = tried.iter().map(|c| chi_squared(c)).fold(0.0, f64::max);
    claims.push(Claim::beaten(
        "Boltzmann demonstrator: the truth ranks uniformly among the draws (calibration, not in D)",
        worst < MOST_CHI_SQUARED,
        format!("largest χ² {worst:.1}, limit {MOST_CHI_SQUARED}"),
    ));
    claims
}

fn picture(columns: &[Vec<Cell>]) -> Picture {
    let places: Vec<String> = SHOWN.iter().map(ToString::to_string).collect();
    let series = |y: fn(&[Judged], BoundKind) -> Estimate, printed: fn((f64, f64)) -> f64| {
        let mut series = Vec::new();
        for (colour, (kind, author)) in AUTHOR.into_iter().enumerate() {
            let points = author.into_iter().enumerate().map(|(i, pair)| (i, printed(pair), 0.0)).collect();
            series.push(Series { label: format!("{}, author", kind.name()), colour, style: Style::Printed, points });
            let mut line = |name: &str, style, of: fn(&Cell) -> Judged| {
                let at = |(i, column): (usize, &Vec<Cell>)| {
                    let estimate = y(&pick(column, of), kind);
                    (i, estimate.mean, estimate.standard_error)
                };
                let points = columns.iter().enumerate().map(at).collect();
                series.push(Series { label: format!("{}, {name}", kind.name()), colour, style, points });
            };
            line("as published", Style::Published, |cell| cell.published);
            line("ours", Style::Best, |cell| cell.ours_least_risk);
        }
        series
    };
    let panel = |y: &str, range, logarithmic, levels, series| Panel {
        x: "demonstrations".into(),
        y: y.into(),
        places: places.clone(),
        range,
        logarithmic,
        levels,
        series,
    };
    Picture {
        title: "Figure 4.2: bounds on policy loss, perfect demonstrations (error bars: ± 1 s.e.)".into(),
        content: Content::Panels(vec![
            panel(
                "accuracy: share of bounds that hold",
                [0.88, 1.0],
                false,
                ALPHAS.to_vec(),
                series(accuracy, |p| p.0),
            ),
            panel("bound − true loss (return, log scale)", [0.005, 2.0], true, vec![], series(error, |p| p.1)),
        ]),
    }
}
