//! A world for those who draw `visualization_msgs/MarkerArray`: its cells, what the robot would do, and what is asked.

use super::layout::{CELL_M, Layout};
use super::world::WAYS;
use crate::markers::question;
use crate::protocol::{PolicyView, WorldView};
use apprentice_msgs::geometry_msgs::{Point, Vector3};
use apprentice_msgs::msg::{WorldQuery, WorldTrajectory};
use apprentice_msgs::visualization_msgs::{Marker, MarkerArray};
use exchange::{colour, delete_all_markers, marker, pose_at, text_marker};

/// Colours of features, again from the first after the last.
const HUES: [[f32; 4]; 6] = [
    [0.55, 0.70, 0.86, 1.0],
    [0.90, 0.66, 0.50, 1.0],
    [0.62, 0.78, 0.58, 1.0],
    [0.82, 0.64, 0.80, 1.0],
    [0.90, 0.82, 0.50, 1.0],
    [0.58, 0.78, 0.78, 1.0],
];
const PLAIN: [f32; 4] = [0.93, 0.92, 0.89, 1.0];
const MOVE: [f32; 3] = [0.16, 0.17, 0.22];
const HERE: [f32; 4] = [0.85, 0.46, 0.17, 0.95];
const END: [f32; 4] = [0.20, 0.20, 0.24, 1.0];
/// Rarer actions are not drawn.
const LEAST: f64 = 0.02;
const LETTER_M: f64 = 0.035;
/// More features are not in the legend.
const MAX_LEGEND: usize = 24;

/// Everything. The stamp is zero, which means "the newest transform" to those who draw.
pub(crate) fn map(
    world: &WorldView,
    policy: Option<&PolicyView>,
    query: Option<&WorldQuery>,
    frame: &str,
) -> MarkerArray {
    let layout = Layout::new(world);
    let [width_m, depth_m] = layout.size_m();
    let mut list = vec![delete_all_markers(frame)];
    if layout.n_drawn() > 0 {
        list.push(cells(world, layout, frame));
        list.extend(ends(world, layout, frame));
    }
    list.extend(legend(world, frame));
    // While something is asked, what the robot would do is not suggested.
    match query {
        Some(query) => {
            list.extend(layout.middle_m(query.state as usize).map(|at_m| here(at_m, frame)));
            for (i, way) in query.trajectories.iter().enumerate().take(WAYS.len()) {
                list.extend(path(way, i, query.trajectories.len(), layout, frame));
            }
            list.push(question(frame, &query.reason, [0.5 * width_m, depth_m]));
        }
        None => list.extend(policy.and_then(|policy| moves(world, policy, layout, frame))),
    }
    MarkerArray { markers: list }
}

/// Every cell in the colour of the feature that is largest there.
fn cells(world: &WorldView, layout: Layout<'_>, frame: &str) -> Marker {
    let drawn = || (0..layout.n_drawn()).filter_map(|state| Some((state, layout.middle_m(state)?)));
    Marker {
        r#type: Marker::CUBE_LIST,
        pose: pose_at([0.0, 0.0, -0.01], 0.0),
        scale: Vector3 { x: 0.95 * CELL_M, y: 0.95 * CELL_M, z: 0.01 },
        color: colour(PLAIN),
        points: drawn().map(|(_, [x, y])| Point { x, y, z: 0.0 }).collect(),
        colors: drawn().map(|(state, _)| colour(world.cells[state].map_or(PLAIN, hue))).collect(),
        ..marker(frame, "cells", 0)
    }
}

fn hue(feature: usize) -> [f32; 4] {
    HUES[feature % HUES.len()]
}

/// Where it ends.
fn ends(world: &WorldView, layout: Layout<'_>, frame: &str) -> Option<Marker> {
    let points: Vec<Point> = world
        .terminals
        .iter()
        .filter_map(|&state| layout.middle_m(state))
        .map(|[x, y]| Point { x, y, z: 0.0 })
        .collect();
    (!points.is_empty()).then(|| Marker {
        r#type: Marker::SPHERE_LIST,
        scale: Vector3 { x: 0.3 * CELL_M, y: 0.3 * CELL_M, z: 0.3 * CELL_M },
        color: colour(END),
        points,
        ..marker(frame, "ends", 0)
    })
}

/// The names of the features in their colours, in a row below.
fn legend(world: &WorldView, frame: &str) -> Vec<Marker> {
    let name = |(id, name): (i32, &String)| {
        let at_m = [0.0, -LETTER_M * (1.5 + 1.4 * f64::from(id)), 0.0];
        let text = text_marker(frame, "legend", id, name, at_m, LETTER_M);
        let [r, g, b, _] = hue(id.unsigned_abs() as usize).map(|part| 0.62 * part);
        Marker { color: colour([r, g, b, 1.0]), ..text }
    };
    (0..).zip(&world.features).take(MAX_LEGEND).map(name).collect()
}

/// The state that is asked about.
fn here([x_m, y_m]: [f64; 2], frame: &str) -> Marker {
    Marker {
        r#type: Marker::CYLINDER,
        pose: pose_at([x_m, y_m, 0.004], 0.0),
        scale: Vector3 { x: 0.8 * CELL_M, y: 0.8 * CELL_M, z: 0.008 },
        color: colour(HERE),
        ..marker(frame, "here", 0)
    }
}

/// A way through the cells; the second of two runs beside the first, and a little above.
fn path(way: &WorldTrajectory, i: usize, of: usize, layout: Layout<'_>, frame: &str) -> Vec<Marker> {
    let aside_m = if of > 1 { 0.12 * CELL_M * (2.0 * i as f64 - 1.0) } else { 0.0 };
    let z = 0.015 + 0.003 * i as f64;
    let points: Vec<Point> = way
        .states
        .iter()
        .filter_map(|&state| layout.middle_m(state as usize))
        .map(|[x, y]| Point { x: x + aside_m, y: y + aside_m, z })
        .collect();
    let Some(last) = points.last().copied() else { return Vec::new() };
    let letter = text_marker(frame, "way letters", i as i32, ["A", "B"][i % 2], [last.x, last.y, z + 0.03], LETTER_M);
    let mut list = vec![Marker {
        r#type: Marker::SPHERE,
        pose: pose_at([last.x, last.y, z], 0.0),
        scale: Vector3 { x: 0.2 * CELL_M, y: 0.2 * CELL_M, z: 0.2 * CELL_M },
        color: colour(WAYS[i]),
        ..marker(frame, "way ends", i as i32)
    }];
    if of > 1 {
        list.push(Marker { color: colour(WAYS[i]), ..letter });
    }
    // A line has two points at least.
    if points.len() > 1 {
        list.push(Marker {
            r#type: Marker::LINE_STRIP,
            scale: Vector3 { x: 0.1 * CELL_M, y: 0.0, z: 0.0 },
            color: colour(WAYS[i]),
            points,
            ..marker(frame, "ways", i as i32)
        });
    }
    list
}

/// What the robot would do in each cell: a line as long as the action is likely, with a tip.
fn moves(world: &WorldView, policy: &PolicyView, layout: Layout<'_>, frame: &str) -> Option<Marker> {
    let n = world.actions.len();
    if policy.table.len() != n * world.n_states {
        return None;
    }
    let (mut points, mut colors) = (Vec::new(), Vec::new());
    for state in 0..layout.n_drawn() {
        let Some([x, y]) = layout.middle_m(state).filter(|_| !world.terminals.contains(&state)) else { continue };
        for (action, &p) in policy.table[state * n..(state + 1) * n].iter().enumerate() {
            let [dx, dy] = layout.towards(action);
            if p < LEAST || (dx == 0.0 && dy == 0.0) {
                continue;
            }
            let length_m = CELL_M * (0.1 + 0.3 * p);
            let at = |along: f64, across: f64| Point {
                x: x + along * dx - across * dy,
                y: y + along * dy + across * dx,
                z: 0.0,
            };
            let (tail, tip, wing_m) = (at(-0.3 * length_m, 0.0), at(length_m, 0.0), 0.3 * length_m);
            points.extend([tail, tip, at(length_m - wing_m, wing_m), tip, at(length_m - wing_m, -wing_m), tip]);
            let [r, g, b] = MOVE;
            colors.extend([colour([r, g, b, 0.35 + 0.65 * p as f32]); 6]);
        }
    }
    (!points.is_empty()).then(|| Marker {
        r#type: Marker::LINE_LIST,
        pose: pose_at([0.0, 0.0, 0.01], 0.0),
        scale: Vector3 { x: 0.05 * CELL_M, y: 0.0, z: 0.0 },
        color: colour([MOVE[0], MOVE[1], MOVE[2], 1.0]),
        points,
        colors,
        ..marker(frame, "moves", 0)
    })
}
