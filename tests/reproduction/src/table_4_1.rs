//! Table 4.1: our bounds beside the Hoeffding bound of Syed and Schapire, for policies of the projection algorithm.

use crate::chapter4::{
    BoundKind, DELTA, Demonstrator, Judged, PERFECT, Problem, accuracy, believe, demonstrate, discounted_counts,
    last_by_printed_projection, purpose, walk, without_bound,
};
use crate::harness::plot::{Content, Panel, Picture, Series, Style};
use crate::harness::{
    Claim, Estimate, Options, Outcome, ReproductionError, TextTable, generator, least_successes, replicates, to_value,
};
use mdp::random::index;
use mdp::{Policy, projection};
use risk::{hoeffding_demonstrations, hoeffding_loss_bound};
use serde::Serialize;

/// Numbers of demonstrations.
const SHOWN: [usize; 3] = [1, 5, 9];
const BETA: f64 = 100.0;
/// Distance to the expert's feature counts at which projection ends, and its most steps, as in the author's program.
const EPSILON: f64 = 0.001;
const MOST_STEPS: usize = 5000;
/// Level, the dissertation's mean bounds by [`SHOWN`] and its accuracy, and the bounds to beat.
type Printed = (BoundKind, f64, [f64; 3], f64, Option<[f64; 3]>);
const PRINTED: [Printed; 2] = [
    (BoundKind::ValueAtRisk(1), 0.95, [0.9372, 0.2532, 0.1328], 0.98, Some([0.80, 0.21, 0.11])),
    (BoundKind::ValueAtRisk(0), 0.99, [1.1428, 0.2937, 0.1535], 1.0, None),
];
/// Syed and Schapire's bound as printed, with γ = .95 and δ = .95 by mistake (method notes 1.11).
const PRINTED_HOEFFDING: [f64; 3] = [142.59, 63.77, 47.53];

/// One replicate at one number of demonstrations.
#[derive(Debug, Clone, Copy, Serialize)]
struct Cell {
    shown: usize,
    /// The policy found last, judged as published.
    published: Judged,
    /// The same policy, judged by us.
    ours_same: Judged,
    /// The policy of the projection whose feature counts are nearest to the demonstrated ones, judged by us.
    ours_nearest: Judged,
    /// The policy of the projection with the least risk, judged by us.
    ours_safest: Judged,
}

/// Makes the table.
pub fn run(options: &Options) -> Result<Outcome, ReproductionError> {
    let n = options.count(200)?;
    let cells = replicates("table-4.1", n, options.threads, |replicate| one(options.seed, replicate))?;
    let columns: Vec<Vec<Cell>> = (0..SHOWN.len()).map(|i| cells.iter().map(|row| row[i]).collect()).collect();
    let hoeffding: Vec<f64> =
        SHOWN.into_iter().map(|shown| hoeffding_loss_bound(shown as u64, 8, 0.9, DELTA)).collect::<Result<_, _>>()?;
    let first = mean_bound(&columns[0], |cell| cell.published, BoundKind::ValueAtRisk(1)).mean;
    let as_many = hoeffding_demonstrations(first, 8, 0.9, DELTA)?;
    Ok(Outcome {
        name: "table-4.1",
        title: "bounds for policies of the projection algorithm",
        replicates: n,
        seed: options.seed,
        notes: vec![
            "as published: the policy that projection finds last (from a random policy, along whole lines, until within .001 or for 5,000 steps), walk and index as in figure 4.2".into(),
            "ours: posterior as in figure 4.2; the last policy of a projection is nearest to nothing, so the nearest to the demonstrated ones is judged too, and the safest: chosen among all of its policies by the .95-value at risk over half of the draws, judged by the other half".into(),
            format!("Syed and Schapire would need {as_many} demonstrations for the .95 bound after one (23,146 in print, with γ = .95 and δ = .95)"),
        ],
        tables: tables(&columns, &hoeffding),
        claims: claims(&columns, &hoeffding, options.seed),
        picture: picture(&columns, &hoeffding),
        data: to_value(&cells),
    })
}

fn one(seed: u64, replicate: usize) -> Result<Vec<Cell>, ReproductionError> {
    let problem = Problem::new(seed, replicate)?;
    let mdp = &problem.mdp;
    let mut generator_of_demonstrations = generator(seed, replicate, purpose::DEMONSTRATIONS);
    let all = demonstrate(&problem, Demonstrator::Optimal, SHOWN[2], &mut generator_of_demonstrations)?;
    let mut policies = generator(seed, replicate, purpose::POLICIES);
    let mut walks = generator(seed, replicate, purpose::WALK);
    let mut chains = generator(seed, replicate, purpose::CHAINS);
    let mut cells = Vec::new();
    for shown in SHOWN {
        let demonstrations = &all[..shown];
        let start = (0..mdp.n_states()).map(|_| index(mdp.n_actions(), &mut policies)).collect();
        let expert = discounted_counts(mdp, demonstrations);
        let start = Policy::Deterministic(start);
        let last = last_by_printed_projection(mdp, &expert, &start)?;
        let projected = projection(mdp, &expert, &start, EPSILON, MOST_STEPS)?;
        let nearest = &projected.feature_counts[projected.closest(&expert)];
        let walked = walk(mdp, demonstrations, BETA, &mut walks)?;
        let published = walked.judge(&problem, demonstrations, &last)?;
        let [ours_same, ours_nearest, ours_safest] = believe(mdp, demonstrations, PERFECT, &mut chains, |belief| {
            let safest = belief.judge_safest(&problem, &projected.feature_counts)?;
            let all = [belief.judge(&problem, &last)?, belief.judge(&problem, nearest)?, safest];
            Ok((all, all.iter().all(Judged::is_complete)))
        })?;
        cells.push(Cell { shown, published, ours_same, ours_nearest, ours_safest });
    }
    Ok(cells)
}

type Of = fn(&Cell) -> Judged;

const WAYS: [(&str, Of); 4] = [
    ("as published", |cell| cell.published),
    ("ours, same policy", |cell| cell.ours_same),
    ("ours, nearest policy", |cell| cell.ours_nearest),
    ("ours, safest policy", |cell| cell.ours_safest),
];

fn pick(column: &[Cell], of: Of) -> Vec<Judged> {
    column.iter().map(of).collect()
}

fn mean_bound(column: &[Cell], of: Of, kind: BoundKind) -> Estimate {
    Estimate::of(&column.iter().filter_map(|cell| kind.of(&of(cell))).collect::<Vec<f64>>())
}

fn tables(columns: &[Vec<Cell>], hoeffding: &[f64]) -> Vec<TextTable> {
    let mut table =
        TextTable::new("Mean bound ± s.e., by number of demonstrations", &["", "1 demo", "5", "9", "mean accuracy"]);
    for (kind, _, printed, accuracy_printed, _) in PRINTED {
        let name = kind.name();
        let mut row: Vec<String> = printed.iter().map(|bound| format!("{bound:.4}")).collect();
        row.push(format!("{accuracy_printed:.2}"));
        table.row(format!("{name} D"), row);
        for (way, of) in WAYS {
            let mut row: Vec<String> = columns.iter().map(|c| mean_bound(c, of, kind).text()).collect();
            let accuracies: Vec<f64> = columns.iter().map(|c| accuracy(&pick(c, of), kind).mean).collect();
            row.push(format!("{:.3}", accuracies.iter().sum::<f64>() / accuracies.len() as f64));
            table.row(format!("{name} {way}"), row);
        }
    }
    for (way, of) in WAYS {
        let losses = |c: &Vec<Cell>| Estimate::of(&pick(c, of).iter().map(|j| j.loss).collect::<Vec<f64>>()).text();
        table.row(format!("true loss, {way}"), columns.iter().map(losses));
    }
    table.row("Syed and Schapire, D", PRINTED_HOEFFDING.map(|bound| format!("{bound:.2}")));
    table.row("Syed and Schapire, as stated (γ .9, δ .05)", hoeffding.iter().map(|bound| format!("{bound:.3}")));
    let none = |c: &Vec<Cell>| without_bound(&pick(c, |cell| cell.ours_nearest), BoundKind::ValueAtRisk(0)).to_string();
    table.row("ours: replicates without a .99 bound", columns.iter().map(none));
    vec![table]
}

fn claims(columns: &[Vec<Cell>], hoeffding: &[f64], seed: u64) -> Vec<Claim> {
    let mut claims = Vec::new();
    for (kind, alpha, printed, _, to_beat) in PRINTED {
        let name = kind.name();
        let means: Vec<f64> = columns.iter().map(|c| mean_bound(c, |cell| cell.published, kind).mean).collect();
        let close = means.iter().zip(printed).all(|(mean, printed)| (mean / printed - 1.0).abs() <= 0.15);
        let found = means.iter().zip(printed).map(|(m, p)| format!("{:+.0} %", 100.0 * (m / p - 1.0)));
        claims.push(Claim::matched(format!("{name}: within 15 % of D"), close, found.collect::<Vec<_>>().join(", ")));
        for (way, of) in [&WAYS[3]] {
            let Some(to_beat) = to_beat else { continue };
            for ((column, limit), shown) in columns.iter().zip(to_beat).zip(SHOWN) {
                let bounds: Vec<f64> = column.iter().filter_map(|cell| kind.of(&of(cell))).map(|b| b - limit).collect();
                claims.push(Claim::smaller(
                    format!("{name}, {way}, {shown} shown: bound below {limit}"),
                    &bounds,
                    seed,
                ));
            }
            let enough = |column: &Vec<Cell>| {
                let share = accuracy(&pick(column, *of), kind);
                (share.mean * share.n as f64).round() as usize >= least_successes(share.n, alpha)
            };
            let found: Vec<String> =
                columns.iter().map(|c| format!("{:.3}", accuracy(&pick(c, *of), kind).mean)).collect();
            claims.push(Claim::beaten(
                format!("{name}, {way}: accuracy ≥ {alpha}"),
                columns.iter().all(enough),
                found.join(", "),
            ));
        }
    }
    let given = [101.897, 45.570, 33.966];
    let same = hoeffding.iter().zip(given).all(|(bound, given)| (bound - given).abs() < 1e-3);
    claims.push(Claim::matched("Syed and Schapire as stated: 101.897/45.570/33.966", same, "exact"));
    claims
}

fn picture(columns: &[Vec<Cell>], hoeffding: &[f64]) -> Picture {
    let mut series = Vec::new();
    for (colour, (kind, _, printed, _, _)) in PRINTED.into_iter().enumerate() {
        let points = printed.into_iter().enumerate().map(|(i, bound)| (i, bound, 0.0)).collect();
        series.push(Series { label: format!("{}, D", kind.name()), colour, style: Style::Printed, points });
        for (way, of) in [WAYS[0], WAYS[3]] {
            let at = |(i, column): (usize, &Vec<Cell>)| {
                let estimate = mean_bound(column, of, kind);
                (i, estimate.mean, estimate.standard_error)
            };
            let style = if way == "as published" { Style::Published } else { Style::Best };
            let points = columns.iter().enumerate().map(at).collect();
            series.push(Series { label: format!("{}, {way}", kind.name()), colour, style, points });
        }
    }
    let points = hoeffding.iter().enumerate().map(|(i, &bound)| (i, bound, 0.0)).collect();
    series.push(Series { label: "Syed and Schapire, as stated".into(), colour: 6, style: Style::Best, points });
    Picture {
        title: "Table 4.1: bounds for the projection algorithm (± 1 s.e.)".into(),
        content: Content::Panels(vec![Panel {
            x: "demonstrations".into(),
            y: "bound on the loss (return, log scale)".into(),
            places: SHOWN.iter().map(ToString::to_string).collect(),
            range: [0.1, 100.0],
            logarithmic: true,
            levels: vec![],
            series,
        }]),
    }
}
