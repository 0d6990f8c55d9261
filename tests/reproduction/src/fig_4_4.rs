//! Figures 4.4 and 4.5: bounds on policies that are given, the optimal one with ever more wrong actions.

use crate::chapter4::{
    ALPHAS, BoundKind, Demonstrator, Judged, PERFECT, Problem, Quality, accuracy, at_least_alpha, believe, demonstrate,
    error, paired_errors, purpose, walk, without_bound,
};
use crate::harness::plot::{Content, Panel, Picture, Series, Style};
use crate::harness::{
    Claim, Estimate, Options, Outcome, ReproductionError, TextTable, bootstrap_interval, generator, replicates,
    to_value,
};
use mdp::random::index;
use rand_chacha::ChaCha8Rng;
use serde::Serialize;

/// Numbers of states with a wrong action.
const WRONG: [usize; 7] = [0, 2, 4, 8, 16, 32, 64];
/// β of the dissertation, for perfect demonstrations.
const BETA: f64 = 100.0;

/// What the two figures differ in.
#[derive(Debug, Clone, Copy)]
pub struct Which {
    name: &'static str,
    title: &'static str,
    heading: &'static str,
    shown: usize,
    /// (accuracy, error) by bound and [`WRONG`], read off the plots in the author's repository within .002 and .02.
    author: [(BoundKind, [(f64, f64); 7]); 4],
}

/// After one demonstration.
pub const FIG_4_4: Which = Which {
    name: "fig-4.4",
    title: "sensitivity to the evaluation policy, 1 demonstration",
    heading: "Figure 4.4: bounds on given policies after 1 demonstration (error bars: ± 1 s.e.)",
    shown: 1,
    author: [
        (
            BoundKind::WorstCase,
            [(1.0, 2.13), (1.0, 2.12), (1.0, 2.11), (1.0, 2.10), (1.0, 2.16), (0.995, 2.38), (0.99, 2.86)],
        ),
        (
            BoundKind::ValueAtRisk(0),
            [(1.0, 0.56), (1.0, 0.56), (1.0, 0.56), (1.0, 0.57), (1.0, 0.63), (1.0, 0.79), (1.0, 1.05)],
        ),
        (
            BoundKind::ValueAtRisk(1),
            [(1.0, 0.39), (1.0, 0.39), (1.0, 0.39), (1.0, 0.40), (0.995, 0.43), (0.99, 0.51), (0.965, 0.61)],
        ),
        (
            BoundKind::ValueAtRisk(2),
            [(1.0, 0.33), (1.0, 0.33), (0.995, 0.33), (0.995, 0.34), (0.98, 0.36), (0.955, 0.41), (0.91, 0.46)],
        ),
    ],
};

/// After nine demonstrations.
pub const FIG_4_5: Which = Which {
    name: "fig-4.5",
    title: "sensitivity to the evaluation policy, 9 demonstrations",
    heading: "Figure 4.5: bounds on given policies after 9 demonstrations (error bars: ± 1 s.e.)",
    shown: 9,
    author: [
        (
            BoundKind::WorstCase,
            [(1.0, 0.43), (1.0, 0.47), (0.995, 0.50), (1.0, 0.60), (0.995, 0.89), (1.0, 1.41), (1.0, 2.12)],
        ),
        (
            BoundKind::ValueAtRisk(0),
            [(1.0, 0.03), (1.0, 0.04), (1.0, 0.06), (1.0, 0.10), (1.0, 0.17), (1.0, 0.30), (1.0, 0.47)],
        ),
        (
            BoundKind::ValueAtRisk(1),
            [(1.0, 0.02), (0.995, 0.03), (1.0, 0.04), (1.0, 0.07), (0.99, 0.12), (0.995, 0.20), (0.99, 0.32)],
        ),
        (
            BoundKind::ValueAtRisk(2),
            [(1.0, 0.01), (0.995, 0.02), (0.985, 0.03), (0.98, 0.05), (0.975, 0.09), (0.96, 0.17), (0.955, 0.26)],
        ),
    ],
};

/// One replicate.
#[derive(Debug, Clone, Serialize)]
struct Row {
    /// By [`WRONG`].
    published: Vec<Judged>,
    /// By [`WRONG`].
    ours: Vec<Judged>,
    quality: Quality,
}

/// Makes one of the two.
pub fn run(which: &Which, options: &Options) -> Result<Outcome, ReproductionError> {
    let n = options.count(200)?;
    let rows = replicates(which.name, n, options.threads, |replicate| one(which.shown, options.seed, replicate))?;
    let columns = |of: fn(&Row) -> &Vec<Judged>| -> Vec<Vec<Judged>> {
        (0..WRONG.len()).map(|i| rows.iter().map(|row| of(row)[i]).collect()).collect()
    };
    let (published, ours) = (columns(|row| &row.published), columns(|row| &row.ours));
    Ok(Outcome {
        name: which.name,
        title: which.title,
        replicates: n,
        seed: options.seed,
        notes: vec![
            "as published and ours: as in figure 4.2, but the policy to judge is given: the optimal one, wrong in X of 81 states".into(),
            "author: read off the plots in his repository; the dissertation prints no numbers".into(),
        ],
        tables: tables(which, &published, &ours),
        claims: claims(which, &published, &ours, options.seed),
        picture: picture(which, &published, &ours),
        data: to_value(&rows),
    })
}

fn one(shown: usize, seed: u64, replicate: usize) -> Result<Row, ReproductionError> {
    let problem = Problem::new(seed, replicate)?;
    let mut generator_of_demonstrations = generator(seed, replicate, purpose::DEMONSTRATIONS);
    let demonstrations = demonstrate(&problem, Demonstrator::Optimal, shown, &mut generator_of_demonstrations)?;
    let policies = worsened(&problem, &mut generator(seed, replicate, purpose::POLICIES));
    let counts: Vec<Vec<f64>> = policies.iter().map(|policy| problem.counts(policy)).collect::<Result<_, _>>()?;
    let walked = walk(&problem.mdp, &demonstrations, BETA, &mut generator(seed, replicate, purpose::WALK))?;
    let published =
        counts.iter().map(|counts| walked.judge(&problem, &demonstrations, counts)).collect::<Result<_, _>>()?;
    let mut chains = generator(seed, replicate, purpose::CHAINS);
    let (ours, quality) = believe(&problem.mdp, &demonstrations, PERFECT, &mut chains, |belief| {
        let judged: Vec<Judged> =
            counts.iter().map(|counts| belief.judge(&problem, counts)).collect::<Result<_, _>>()?;
        let complete = judged.iter().all(Judged::is_complete);
        Ok(((judged, belief.quality()), complete))
    })?;
    Ok(Row { published, ours, quality })
}

/// The optimal policy with an action that is not optimal in ever more states, drawn without replacement.
fn worsened(problem: &Problem, generator: &mut ChaCha8Rng) -> Vec<Vec<usize>> {
    let mut states: Vec<usize> = (0..problem.mdp.n_states()).collect();
    for i in (1..states.len()).rev() {
        states.swap(i, index(i + 1, generator));
    }
    let n_actions = problem.mdp.n_actions();
    let turns: Vec<usize> = states.iter().map(|_| 1 + index(n_actions - 1, generator)).collect();
    let wrong = |n: usize| {
        let mut policy = problem.optimal.clone();
        for (&state, turn) in states.iter().zip(&turns).take(n) {
            policy[state] = (policy[state] + turn) % n_actions;
        }
        policy
    };
    WRONG.map(wrong).to_vec()
}

fn tables(which: &Which, published: &[Vec<Judged>], ours: &[Vec<Judged>]) -> Vec<TextTable> {
    let mut head = vec!["accuracy / bound error".to_owned()];
    head.extend(WRONG.map(|n| format!("X = {n}")));
    let mut table =
        TextTable::new("Accuracy / mean bound error ± s.e., by number X of states with a wrong action", &head);
    let both = |judged: &[Judged], kind| format!("{:.3} / {}", accuracy(judged, kind).mean, error(judged, kind).text());
    for (kind, author) in which.author {
        let name = kind.name();
        table.row(format!("{name} author"), author.map(|(accuracy, error)| format!("{accuracy:.3} / {error:.2}")));
        table.row(format!("{name} as published"), published.iter().map(|judged| both(judged, kind)));
        if kind != BoundKind::WorstCase {
            table.row(format!("{name} ours"), ours.iter().map(|judged| both(judged, kind)));
        }
    }
    let losses = |judged: &Vec<Judged>| Estimate::of(&judged.iter().map(|j| j.loss).collect::<Vec<f64>>()).text();
    table.row("true loss", published.iter().map(losses));
    let none = |judged: &Vec<Judged>| without_bound(judged, BoundKind::ValueAtRisk(0)).to_string();
    table.row("ours: replicates without a .99 bound", ours.iter().map(none));
    vec![table]
}

fn claims(which: &Which, published: &[Vec<Judged>], ours: &[Vec<Judged>], seed: u64) -> Vec<Claim> {
    let exact = |judged: &[Judged]| BoundKind::ALL.iter().all(|&kind| accuracy(judged, kind).mean == 1.0);
    let mut claims = vec![Claim::matched("X = 0: every bound holds always", exact(&published[0]), "as published")];
    let widest =
        |judged: &[Judged]| error(judged, BoundKind::WorstCase).mean / error(judged, BoundKind::ValueAtRisk(0)).mean;
    if which.shown == 1 {
        let ratio = widest(&published[0]);
        // The interval is of what is claimed, not of the ratio of means.
        let beyond: Vec<f64> = paired_errors(&published[0], &published[0], BoundKind::WorstCase)
            .iter()
            .zip(paired_errors(&published[0], &published[0], BoundKind::ValueAtRisk(0)))
            .map(|(widest, narrow)| widest.0 - 4.0 * narrow.0)
            .collect();
        let [low, high] = bootstrap_interval(&beyond, seed);
        let author = which.author[0].1[0].1 / which.author[1].1[0].1;
        let found = format!(
            "{ratio:.1} times at X = 0, {author:.1} times in the author's plot; WFCB − 4 VaR .99: 95 % interval [{low:+.3}, {high:+.3}]"
        );
        claims.push(Claim::matched(
            "WFCB error about 4 times that of the widest VaR bound (3 to 5)",
            (3.0..5.0).contains(&ratio),
            found,
        ));
    } else {
        let kinds = BoundKind::ALL.into_iter().skip(1);
        let least = kinds.map(|kind| accuracy(&published[6], kind).mean).fold(f64::INFINITY, f64::min);
        let found = format!(
            "X = 64: least {least:.3}, s.e. {:.3}",
            libm::sqrt(least * (1.0 - least) / published[6].len() as f64)
        );
        claims.push(Claim::matched(
            "wrong in three states of four: every VaR bound still holds in 95 %",
            least >= 0.95,
            found,
        ));
    }
    claims.push(at_least_alpha("as published: accuracy ≥ α", published, Claim::matched));
    claims.push(at_least_alpha("ours: accuracy ≥ α", ours, Claim::beaten));
    let kind = BoundKind::ValueAtRisk(1);
    let by_policy: Vec<Vec<(f64, f64)>> = ours.iter().zip(published).map(|(o, p)| paired_errors(o, p, kind)).collect();
    let n = by_policy.iter().map(Vec::len).min().unwrap_or(0);
    // The mean over the policies of each replicate.
    let mean = |r: usize| by_policy.iter().map(|pairs| pairs[r].0 - pairs[r].1).sum::<f64>() / by_policy.len() as f64;
    let differences: Vec<f64> = (0..n).map(mean).collect();
    claims.push(Claim::smaller("ours: .95 bound error lower than as published, mean over X", &differences, seed));
    claims
}

fn picture(which: &Which, published: &[Vec<Judged>], ours: &[Vec<Judged>]) -> Picture {
    let series = |y: fn(&[Judged], BoundKind) -> Estimate, printed: fn((f64, f64)) -> f64| {
        let mut all = Vec::new();
        for (colour, (kind, author)) in which.author.into_iter().enumerate() {
            let points = author.into_iter().enumerate().map(|(i, pair)| (i, printed(pair), 0.0)).collect();
            all.push(Series { label: format!("{}, author", kind.name()), colour, style: Style::Printed, points });
            let mut line = |name: &str, style, columns: &[Vec<Judged>]| {
                let at = |(i, judged): (usize, &Vec<Judged>)| {
                    let estimate = y(judged, kind);
                    (i, estimate.mean, estimate.standard_error)
                };
                let points = columns.iter().enumerate().map(at).collect();
                all.push(Series { label: format!("{}, {name}", kind.name()), colour, style, points });
            };
            line("as published", Style::Published, published);
            if kind != BoundKind::WorstCase {
                line("ours", Style::Best, ours);
            }
        }
        all
    };
    let panel = |y: &str, range, logarithmic, levels, series| Panel {
        x: "states with a wrong action, of 81".into(),
        y: y.into(),
        places: WRONG.iter().map(ToString::to_string).collect(),
        range,
        logarithmic,
        levels,
        series,
    };
    Picture {
        title: which.heading.into(),
        content: Content::Panels(vec![
            panel("accuracy: share of bounds that hold", [0.9, 1.0], false, ALPHAS.to_vec(), series(accuracy, |p| p.0)),
            panel("bound − true loss (return, log scale)", [0.01, 3.0], true, vec![], series(error, |p| p.1)),
        ]),
    }
}
