//! The frontier and policies on a grid as SVG.

use std::collections::BTreeSet;
use std::path::Path;

use mdp::{Mdp, Policy, occupancy};
use picture::{
    Cell, Chart, Direction, GridPicture, Line, MAX_CELLS, Mark, PictureError, Shade, Stroke, charts, policy_grids,
};

use super::Arguments;
use super::arguments::{ObjectiveName, ShadeName};
use super::found::Found;
use super::inputs::Inputs;
use super::report::probabilities;
use super::text::actions;
use crate::OfflineError;
use crate::answer::{level, short};
use crate::evidence::flag;

/// Draws something for a file.
pub(super) type Draw = fn(&Arguments, &Inputs, &Found, &Path) -> Result<String, OfflineError>;

/// Baselines are drawn up to so many extents of the frontier away from it.
const AROUND: f64 = 4.0;
/// Visits below this share of the largest are none.
const UNSEEN: f64 = 1e-9;

fn failed(path: &Path) -> impl Fn(PictureError) -> OfflineError {
    let file = path.display().to_string();
    move |error| OfflineError::Picture { file: file.clone(), error }
}

/// What a lower tail is of, for an axis.
fn axis(arguments: &Arguments) -> String {
    let what = match arguments.objective {
        ObjectiveName::Robust => "return",
        ObjectiveName::Regret => "return above the expert's",
        ObjectiveName::Evd => "return less the best one",
    };
    format!("CVaR of the {what}, α = {}", level(arguments.alpha))
}

/// The frontier, with the policy asked for and the baselines.
pub(super) fn frontier(arguments: &Arguments, _: &Inputs, found: &Found, path: &Path) -> Result<String, OfflineError> {
    let at = |cvar: f64, mean: f64| (cvar, mean);
    let points: Vec<(f64, f64)> =
        found.frontier.iter().map(|s| at(s.conditional_value_at_risk, s.expected_return)).collect();
    let chosen = at(found.solution.conditional_value_at_risk, found.solution.expected_return);
    let mut marks = vec![];
    if let (Some(first), Some(last)) = (points.first(), points.last()) {
        marks.push(Mark { text: "λ = 0".into(), at: *first });
        marks.push(Mark { text: "λ = 1".into(), at: *last });
    }
    let mut lines = vec![
        Line { label: format!("BROIL, {} values of λ", points.len()), colour: 0, stroke: Stroke::Dotted, points },
        Line {
            label: format!("λ = {}", level(arguments.lambda)),
            colour: 1,
            stroke: Stroke::Crosses,
            points: vec![chosen],
        },
    ];
    let near = neighbourhood(&lines);
    for (index, baseline) in found.baselines.iter().flatten().enumerate() {
        let point = at(baseline.risk.conditional_value_at_risk, baseline.risk.expected_return);
        // What is far off would press the frontier into a corner.
        let (label, points) = if near(point) {
            (baseline.title.to_owned(), vec![point])
        } else {
            (format!("{}: off, at {}, {}", baseline.title, brief(point.0), brief(point.1)), vec![])
        };
        lines.push(Line { label, colour: 2 + index, stroke: Stroke::Crosses, points });
    }
    let title = "What caution costs: the mean against the bad end";
    let chart = Chart { x: axis(arguments), y: "mean return".into(), lines, marks };
    charts(title, &[chart]).map_err(failed(path))
}

/// Whether a point lies within a few times the extent of what is drawn already.
fn neighbourhood(lines: &[Line]) -> impl Fn((f64, f64)) -> bool + use<> {
    let points: Vec<(f64, f64)> = lines.iter().flat_map(|line| line.points.iter().copied()).collect();
    let range = |of: fn(&(f64, f64)) -> f64| {
        let low = points.iter().map(of).fold(f64::INFINITY, f64::min);
        let high = points.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        let around = AROUND * (high - low).max(0.05 * low.abs().max(high.abs()));
        (low - around, high + around)
    };
    let (xs, ys) = (range(|point| point.0), range(|point| point.1));
    move |(x, y)| (xs.0..=xs.1).contains(&x) && (ys.0..=ys.1).contains(&y)
}

/// Three digits or so.
fn brief(x: f64) -> String {
    let decimals = match x.abs() {
        size if size >= 100.0 => 0,
        size if size >= 1.0 => 2,
        size if size >= 1e-3 || size == 0.0 => 3,
        _ => return short(x),
    };
    format!("{x:.decimals$}").replace('-', "−")
}

/// Where each action leads.
///
/// # Errors
/// A process without a shape, with too many cells, or with actions whose names are no directions.
pub(super) fn directions(mdp: &Mdp, path: &Path) -> Result<Vec<Direction>, OfflineError> {
    let wrong = |problem: String| flag("--policy-svg", problem);
    if mdp.shape().is_none() {
        return Err(wrong("got a process of no shape, expected \"shape\": [rows, columns] in --mdp".into()));
    }
    if mdp.n_states() > MAX_CELLS {
        let (got, most) = (mdp.n_states(), MAX_CELLS);
        return Err(failed(path)(PictureError::TooLarge { got, most }));
    }
    if mdp.actions().is_empty() {
        return Err(wrong("got actions without names, expected \"actions\": [\"up\", …] in --mdp".into()));
    }
    let named = mdp.actions().iter().map(|name| {
        Direction::of_name(name)
            .ok_or_else(|| wrong(format!("got an action '{name}', expected up, down, left, right or stay")))
    });
    named.collect()
}

/// The policy and the baselines on the grid.
pub(super) fn policies(
    arguments: &Arguments,
    inputs: &Inputs,
    found: &Found,
    path: &Path,
) -> Result<String, OfflineError> {
    let directions = directions(&inputs.mdp, path)?;
    let solution = &found.solution;
    let detail = |cvar: f64, mean: f64| format!("CVaR {}, mean {}", brief(cvar), brief(mean));
    let one = |policy: &Policy, caption: String, detail: String| {
        grid(arguments, inputs, &directions, policy, caption, detail)
    };
    let ours = format!("BROIL {}, λ = {}", super::text::kind(arguments), level(solution.lambda));
    let mut grids =
        vec![one(&solution.policy, ours, detail(solution.conditional_value_at_risk, solution.expected_return))?];
    for baseline in found.baselines.iter().flatten() {
        let risk = &baseline.risk;
        let detail = detail(risk.conditional_value_at_risk, risk.expected_return);
        grids.push(one(&baseline.policy, baseline.title.to_owned(), detail)?);
    }
    let legend: Vec<(Shade, String)> = match arguments.shade {
        ShadeName::Occupancy => {
            vec![(Shade::Amount(1.0), "most visited".into()), (Shade::Amount(0.0), "never visited".into())]
        }
        ShadeName::Feature => {
            let shown: BTreeSet<usize> =
                (0..inputs.mdp.n_states()).map(|state| largest_feature(&inputs.mdp, state)).collect();
            let name = |kind: usize| if kind == 0 { "none".to_owned() } else { format!("feature {}", kind - 1) };
            shown.into_iter().map(|kind| (Shade::Kind(kind), name(kind))).collect()
        }
    };
    policy_grids("Policies: the area of an arrow is the probability of its action", &grids, &legend)
        .map_err(failed(path))
}

fn grid(
    arguments: &Arguments,
    inputs: &Inputs,
    directions: &[Direction],
    policy: &Policy,
    caption: String,
    detail: String,
) -> Result<GridPicture, OfflineError> {
    let mdp = &inputs.mdp;
    let n_actions = mdp.n_actions();
    let probabilities = probabilities(policy, n_actions);
    let visits: Vec<f64> = occupancy(mdp, policy)
        .map_err(robust::RobustError::from)?
        .chunks(n_actions)
        .map(|row| row.iter().sum())
        .collect();
    let most = visits.iter().enumerate().filter(|(state, _)| !mdp.is_terminal(*state)).map(|(_, visits)| *visits);
    let most = most.fold(0.0_f64, f64::max).max(f64::MIN_POSITIVE);
    let cells = (0..mdp.n_states())
        .map(|state| {
            let row = &probabilities[state * n_actions..][..n_actions];
            let does = if mdp.is_terminal(state) { "end".to_owned() } else { actions(row, mdp.actions()) };
            Cell {
                shade: match arguments.shade {
                    ShadeName::Occupancy => Shade::Amount(visits[state] / most),
                    ShadeName::Feature => Shade::Kind(largest_feature(mdp, state)),
                },
                terminal: mdp.is_terminal(state),
                start: mdp.initial()[state] > 0.0,
                visited: visits[state] > UNSEEN * most,
                arrows: directions.iter().copied().zip(row.iter().copied()).collect(),
                about: format!("state {state}: {does}; {:.3} visits", visits[state]),
            }
        })
        .collect();
    let columns = mdp.shape().map_or(1, |[_, columns]| columns);
    Ok(GridPicture { caption, detail, columns, cells })
}

/// 1 + the feature that is largest in size, 0 where all are 0.
fn largest_feature(mdp: &Mdp, state: usize) -> usize {
    let mut best = (0.0, 0);
    for (j, phi) in mdp.features(state, 0).iter().enumerate() {
        if phi.abs() > best.0 {
            best = (phi.abs(), j + 1);
        }
    }
    best.1
}
