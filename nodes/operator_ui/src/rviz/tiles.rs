//! Things that can be pressed: flat tiles with a word on them, and the menu behind the other mouse button.

use apprentice_msgs::geometry_msgs::Vector3;
use apprentice_msgs::std_msgs::Header;
use apprentice_msgs::visualization_msgs::{InteractiveMarker, InteractiveMarkerControl, Marker, MenuEntry};
use exchange::{colour, marker, pose_at, text_marker};

/// A tile.
const TILE_M: [f64; 3] = [0.26, 0.055, 0.008];
/// From the middle of a tile to the middle of the next.
pub(super) const TILE_STEP_M: f64 = 0.07;
/// Letters on a tile.
const LETTER_M: f64 = 0.026;

/// Something to say.
pub(super) const ANSWER: [f32; 4] = [0.16, 0.42, 0.62, 1.0];
/// No answer.
pub(super) const PASS: [f32; 4] = [0.52, 0.52, 0.54, 1.0];
/// The end.
pub(super) const STOP: [f32; 4] = [0.66, 0.20, 0.18, 1.0];

/// Entries of the menu: how sure a person is.
pub(super) const SURE: u32 = 1;
/// See [`SURE`].
pub(super) const FAIRLY: u32 = 2;
/// See [`SURE`].
pub(super) const GUESS: u32 = 3;

/// Where the next tile goes: down a column.
#[derive(Debug, Clone, Copy)]
pub(super) struct Column {
    /// Middle of the next tile.
    pub x_m: f64,
    /// Middle of the next tile.
    pub y_m: f64,
}

impl Column {
    /// A tile of that name with a word on it.
    pub fn tile(&mut self, frame: &str, name: String, word: &str, rgba: [f32; 4]) -> InteractiveMarker {
        let at_m = [self.x_m, self.y_m, 0.5 * TILE_M[2]];
        self.y_m -= TILE_STEP_M;
        let body = Marker {
            r#type: Marker::CUBE,
            scale: Vector3 { x: TILE_M[0], y: TILE_M[1], z: TILE_M[2] },
            color: colour(rgba),
            ..marker("", "tile", 0)
        };
        // Letters float in front of their tile, wherever it is looked at from.
        let mut letters = text_marker("", "tile", 1, word, [0.0, 0.0, LETTER_M], LETTER_M);
        letters.color = colour([1.0; 4]);
        button(frame, name, at_m, vec![body, letters])
    }

    /// A tile that gives an answer, whose menu asks how sure that is.
    pub fn answer(&mut self, frame: &str, name: String, word: &str, rgba: [f32; 4]) -> InteractiveMarker {
        InteractiveMarker { menu_entries: how_sure(0), ..self.tile(frame, name, word, rgba) }
    }
}

/// Something that can be pressed.
pub(super) fn button(frame: &str, name: String, at_m: [f64; 3], markers: Vec<Marker>) -> InteractiveMarker {
    let control = InteractiveMarkerControl {
        name: "press".into(),
        interaction_mode: InteractiveMarkerControl::BUTTON,
        always_visible: true,
        markers,
        ..InteractiveMarkerControl::default()
    };
    InteractiveMarker { controls: vec![control], ..handle(frame, name, at_m) }
}

/// A handle with nothing to see or to press yet.
pub(super) fn handle(frame: &str, name: String, at_m: [f64; 3]) -> InteractiveMarker {
    InteractiveMarker {
        header: Header { frame_id: frame.to_owned(), ..Header::default() },
        pose: pose_at(at_m, 0.0),
        name,
        scale: 0.15,
        ..InteractiveMarker::default()
    }
}

/// Entries that ask how sure a person is, under another or under none (0).
pub(super) fn how_sure(under: u32) -> Vec<MenuEntry> {
    [(SURE, "I am sure"), (FAIRLY, "Fairly sure"), (GUESS, "It is a guess")]
        .map(|(id, title)| entry(id, under, title))
        .into()
}

/// An entry of a menu, under another or under none (0).
pub(super) fn entry(id: u32, parent_id: u32, title: &str) -> MenuEntry {
    MenuEntry { id, parent_id, title: title.to_owned(), ..MenuEntry::default() }
}
