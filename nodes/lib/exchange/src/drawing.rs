//! Poses upright on a table, and markers (`visualization_msgs`) for those who draw. Stamps of markers are zero, which means "with
//! the newest transform".

use apprentice_msgs::geometry_msgs::{Point, Pose, Quaternion, Vector3};
use apprentice_msgs::std_msgs::{ColorRGBA, Header};
use apprentice_msgs::visualization_msgs::Marker;

/// Turned by an angle about the vertical, radians.
pub fn upright(yaw_rad: f64) -> Quaternion {
    let (sin, cos) = (0.5 * yaw_rad).sin_cos();
    Quaternion { x: 0.0, y: 0.0, z: sin, w: cos }
}

/// At (x, y, z) in metres, upright.
pub fn pose_at([x, y, z]: [f64; 3], yaw_rad: f64) -> Pose {
    Pose { position: Point { x, y, z }, orientation: upright(yaw_rad) }
}

/// A marker to be added, with a frame, a name and a valid pose, and nothing to see yet.
pub fn marker(frame: &str, ns: &str, id: i32) -> Marker {
    Marker {
        header: Header { frame_id: frame.to_owned(), ..Header::default() },
        ns: ns.to_owned(),
        id,
        action: Marker::ADD,
        pose: pose_at([0.0; 3], 0.0),
        ..Marker::default()
    }
}

/// Takes away what was drawn before on the same topic.
pub fn delete_all_markers(frame: &str) -> Marker {
    Marker { action: Marker::DELETEALL, ..marker(frame, "all", 0) }
}

/// Text that faces the viewer, its middle at `at_m`, letters `height_m` high.
pub fn text_marker(frame: &str, ns: &str, id: i32, text: &str, at_m: [f64; 3], height_m: f64) -> Marker {
    Marker {
        r#type: Marker::TEXT_VIEW_FACING,
        pose: pose_at(at_m, 0.0),
        scale: Vector3 { x: 0.0, y: 0.0, z: height_m },
        color: colour(INK),
        text: text.to_owned(),
        ..marker(frame, ns, id)
    }
}

/// Of text.
const INK: [f32; 4] = [0.15, 0.15, 0.17, 1.0];

/// Red, green, blue and opacity, each from 0 to 1.
pub fn colour([r, g, b, a]: [f32; 4]) -> ColorRGBA {
    ColorRGBA { r, g, b, a }
}

/// A text in lines of at most so many characters, unless a word is longer.
pub fn broken_text(text: &str, line: usize) -> String {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut().filter(|last| last.chars().count() + 1 + word.chars().count() <= line) {
            Some(last) => {
                last.push(' ');
                last.push_str(word);
            }
            None => lines.push(word.to_owned()),
        }
    }
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::broken_text;

    #[test]
    fn lines_break_between_words() {
        assert_eq!(broken_text("one two  three", 7), "one two\nthree");
        assert_eq!(broken_text("incomprehensible a", 4), "incomprehensible\na");
        assert_eq!(broken_text(" ", 4), "");
    }
}
