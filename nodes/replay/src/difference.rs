//! Where two messages first differ.

use serde::Serialize;
use serde_json::Value;

/// The first field in which two messages differ.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Difference {
    /// Path of the field, such as `bounds[3].bound_m`.
    pub field: String,
    /// As in the bag.
    pub recorded: String,
    /// As computed now.
    pub recomputed: String,
}

/// The first field, in the order of the message, in which two messages differ; of equal fields with different bytes
/// (numbers that are not finite) it says only that the bits differ.
pub fn difference<M: Serialize>(recorded: &M, recomputed: &M) -> Difference {
    let as_value = |message: &M| serde_json::to_value(message).unwrap_or(Value::Null);
    let (a, b) = (as_value(recorded), as_value(recomputed));
    let mut field = String::new();
    match first(&a, &b, &mut field) {
        Some((a, b)) => Difference { field, recorded: a, recomputed: b },
        None => Difference {
            field: "a number that is not finite".into(),
            recorded: "other bits".into(),
            recomputed: "other bits".into(),
        },
    }
}

fn first(a: &Value, b: &Value, path: &mut String) -> Option<(String, String)> {
    let length = path.len();
    match (a, b) {
        (Value::Object(a), Value::Object(b)) => {
            for (key, value) in a {
                if !path.is_empty() {
                    path.push('.');
                }
                path.push_str(key);
                let found = first(value, b.get(key).unwrap_or(&Value::Null), path);
                if found.is_some() {
                    return found;
                }
                path.truncate(length);
            }
            None
        }
        (Value::Array(a), Value::Array(b)) => {
            for (i, (x, y)) in a.iter().zip(b).enumerate() {
                path.push_str(&format!("[{i}]"));
                let found = first(x, y, path);
                if found.is_some() {
                    return found;
                }
                path.truncate(length);
            }
            if a.len() == b.len() {
                return None;
            }
            path.push_str(" (length)");
            Some((a.len().to_string(), b.len().to_string()))
        }
        // Text, not `==`: −0 and 0 are equal numbers with different bits.
        _ => {
            let (x, y) = (a.to_string(), b.to_string());
            (x != y).then(|| (shortened(x), shortened(y)))
        }
    }
}

fn shortened(text: String) -> String {
    match text.char_indices().nth(200) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use super::{Difference, difference};
    use apprentice_msgs::msg::{PerformanceBounds, PlacementBound};

    #[test]
    fn the_first_difference_is_named_by_its_path() {
        let bounds = |bound_m: f64| PerformanceBounds {
            bounds: vec![PlacementBound::default(), PlacementBound { bound_m, ..PlacementBound::default() }],
            ..PerformanceBounds::default()
        };
        let found = difference(&bounds(0.25), &bounds(0.5));
        let expected =
            Difference { field: "bounds[1].bound_m".into(), recorded: "0.25".into(), recomputed: "0.5".into() };
        assert_eq!(found, expected);
        assert_eq!(difference(&bounds(0.0), &bounds(-0.0)).field, "bounds[1].bound_m");
        let fewer = PerformanceBounds::default();
        assert_eq!(difference(&fewer, &bounds(0.0)).field, "bounds (length)");
    }
}
