//! A question about a table as handles: the target is moved by hand, and its menu or a tile answers. Of two places each shows the
//! target there, to be pressed.

use super::draft::Draft;
use super::tiles::{ANSWER, Column, PASS, button, entry, handle, how_sure};
use super::world::WAYS;
use super::{named, passes};
use crate::markers::{TARGET, body};
use crate::protocol::SceneView;
use apprentice_msgs::geometry_msgs::Quaternion;
use apprentice_msgs::msg::PlacementQuery;
use apprentice_msgs::visualization_msgs::{InteractiveMarker, InteractiveMarkerControl};
use exchange::text_marker;
use std::f64::consts::FRAC_1_SQRT_2;

const BLOCKED: [f32; 4] = [0.72, 0.16, 0.14, 0.7];
/// Names, letters and colours of two places.
const PLACES: [(&str, &str, [f32; 4]); 2] = [("first", "A", WAYS[0]), ("second", "B", WAYS[1])];
/// The entry of the menu above the answers.
const BELONGS: u32 = 10;
/// An entry of the menu.
pub(super) const SKIP: u32 = 11;
/// An entry of the menu.
pub(super) const CANT_TELL: u32 = 12;

/// The handles.
pub(super) fn handles(query: &PlacementQuery, scene: &SceneView, draft: &Draft) -> Vec<InteractiveMarker> {
    let (id, frame) = (query.id.as_str(), scene.frame_id.as_str());
    let mut column = Column { x_m: scene.width_m + scene.target.size_x_m + 0.3, y_m: scene.depth_m };
    let mut all = Vec::new();
    if let [first, second] = query.options.as_slice() {
        for ((name, letter, rgba), option) in PLACES.into_iter().zip([first, second]) {
            let at = &option.placement;
            all.push(offered(named(id, name), letter, rgba, scene, [at.x, at.y]));
            all.push(column.answer(
                frame,
                named(id, &format!("{name} tile")),
                &format!("Place {letter} is better"),
                rgba,
            ));
        }
        all.push(column.answer(frame, named(id, "equal"), "About equal", ANSWER));
    }
    let is_ready = draft.at_m.is_some() && !draft.is_blocked;
    let word = if query.options.is_empty() { "It belongs here" } else { "Neither: it belongs here" };
    all.push(target(id, scene, draft));
    all.push(column.answer(frame, named(id, "place"), word, if is_ready { ANSWER } else { PASS }));
    all.extend(passes(frame, id, &mut column));
    all
}

/// The target in one of two places.
fn offered(name: String, letter: &str, rgba: [f32; 4], scene: &SceneView, [x_m, y_m]: [f64; 2]) -> InteractiveMarker {
    let target = &scene.target;
    let body = body("", "place", 0, target, rgba);
    let letter = text_marker("", "place", 1, letter, [0.0, 0.0, 0.5 * target.size_z_m + 0.04], 0.06);
    let at_m = [x_m, y_m, 0.5 * target.size_z_m];
    InteractiveMarker { menu_entries: how_sure(0), ..button(&scene.frame_id, name, at_m, vec![body, letter]) }
}

/// The thing to be placed: it slides over the table. It waits beside it.
fn target(id: &str, scene: &SceneView, draft: &Draft) -> InteractiveMarker {
    let target = &scene.target;
    let beside_m = [scene.width_m + target.size_x_m, 0.5 * scene.depth_m];
    let [x_m, y_m] = draft.at_m.unwrap_or(beside_m);
    let body = body("", "target", 0, target, if draft.is_blocked { BLOCKED } else { TARGET });
    let slide = InteractiveMarkerControl {
        name: "slide".into(),
        // The plane is across the control's own x axis, which this turns upwards.
        orientation: Quaternion { x: 0.0, y: -FRAC_1_SQRT_2, z: 0.0, w: FRAC_1_SQRT_2 },
        interaction_mode: InteractiveMarkerControl::MOVE_PLANE,
        always_visible: true,
        markers: vec![body],
        ..InteractiveMarkerControl::default()
    };
    let mut menu = vec![entry(BELONGS, 0, "It belongs here")];
    menu.extend(how_sure(BELONGS));
    menu.extend([entry(SKIP, 0, "Skip this question"), entry(CANT_TELL, 0, "I can't tell")]);
    InteractiveMarker {
        description: if draft.hint.is_empty() { target.label.clone() } else { draft.hint.clone() },
        menu_entries: menu,
        controls: vec![slide],
        ..handle(&scene.frame_id, named(id, "target"), [x_m, y_m, 0.5 * target.size_z_m])
    }
}
