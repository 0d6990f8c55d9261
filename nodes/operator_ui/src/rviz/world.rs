//! A question about a world as handles: a tile for every answer, and for every step of a way that is to be judged a disc.

use super::draft::Draft;
use super::layout::{CELL_M, Layout};
use super::tiles::{ANSWER, Column, PASS, TILE_STEP_M, button};
use super::{named, passes};
use crate::protocol::WorldView;
use apprentice_msgs::geometry_msgs::Vector3;
use apprentice_msgs::msg::{WorldQuery, WorldTrajectory};
use apprentice_msgs::visualization_msgs::{InteractiveMarker, Marker};
use exchange::{colour, marker, text_marker};

/// More answers than this have no tile each.
const MAX_TILES: usize = 64;
const GOOD: [f32; 4] = [0.15, 0.55, 0.28, 1.0];
const BAD: [f32; 4] = [0.72, 0.16, 0.14, 1.0];
const OPEN: [f32; 4] = [0.95, 0.95, 0.93, 1.0];
/// Colours of the first and the second of two ways.
pub(super) const WAYS: [[f32; 4]; 2] = [[0.13, 0.36, 0.78, 1.0], [0.80, 0.40, 0.05, 1.0]];

/// The handles.
pub(super) fn handles(query: &WorldQuery, world: &WorldView, frame: &str, draft: &Draft) -> Vec<InteractiveMarker> {
    let layout = Layout::new(world);
    let [width_m, depth_m] = layout.size_m();
    let id = query.id.as_str();
    let mut column = Column { x_m: width_m + 0.25, y_m: depth_m.max(5.0 * TILE_STEP_M) };
    let mut all = Vec::new();
    let mut answer = |column: &mut Column, name: String, word: &str, rgba| {
        all.push(column.answer(frame, named(id, &name), word, rgba));
    };
    match query.kind {
        WorldQuery::ACTION => {
            for (action, word) in world.actions.iter().enumerate().take(MAX_TILES) {
                answer(&mut column, format!("action {action}"), word, ANSWER);
            }
        }
        WorldQuery::COMPARISON => {
            for (name, word, rgba) in [("first", "Way A is better", WAYS[0]), ("second", "Way B is better", WAYS[1])] {
                answer(&mut column, name.into(), word, rgba);
            }
            answer(&mut column, "equal".into(), "About equal", ANSWER);
        }
        _ => {
            let is_marked = draft.marks.iter().any(Option::is_some);
            answer(&mut column, "send".into(), "Send these marks", if is_marked { ANSWER } else { PASS });
            all.push(column.tile(frame, named(id, "all_good"), "All of it is good", GOOD));
            all.extend(query.trajectories.first().into_iter().flat_map(|way| steps(id, way, layout, frame, draft)));
        }
    }
    all.extend(passes(frame, id, &mut column));
    all
}

/// A disc for each step of a way, in its cell; a cell that is come to again gets the next one beside the first.
fn steps(id: &str, way: &WorldTrajectory, layout: Layout<'_>, frame: &str, draft: &Draft) -> Vec<InteractiveMarker> {
    let disc = |(step, &state): (usize, &u32)| {
        let before = way.states[..step].iter().filter(|&&other| other == state).count();
        // What is not drawn as a map is a row of discs.
        let [x_m, y_m] = layout.middle_m(state as usize).unwrap_or([(step as f64 + 0.5) * CELL_M, 0.0]);
        let aside_m = 0.25 * CELL_M * (before % 3) as f64;
        let mark = draft.marks.get(step).copied().flatten();
        let body = Marker {
            r#type: Marker::CYLINDER,
            scale: Vector3 { x: 0.5 * CELL_M, y: 0.5 * CELL_M, z: 0.01 },
            color: colour(match mark {
                Some(true) => GOOD,
                Some(false) => BAD,
                None => OPEN,
            }),
            ..marker("", "step", 0)
        };
        let sign = match mark {
            Some(true) => " +",
            Some(false) => " −",
            None => "",
        };
        let number = text_marker("", "step", 1, &format!("{}{sign}", step + 1), [0.0, 0.0, 0.025], 0.022);
        let at_m = [x_m + aside_m, y_m - aside_m, 0.02 + 0.004 * before as f64];
        button(frame, named(id, &format!("step {step}")), at_m, vec![body, number])
    };
    way.states.iter().enumerate().take(MAX_STEPS).map(disc).collect()
}

/// Later steps of a way have no disc.
const MAX_STEPS: usize = 256;
