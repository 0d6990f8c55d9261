//! Which lesson comes next, and on what table.

use super::Settings;
use scene::{Object, Point, Shape};
use serde_json::{Value, json};

/// How a lesson ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outcome {
    /// The thing stands there from now on, metres.
    Placed(Point),
    /// The lesson ended without a place to trust; the thing is left off the table.
    Left,
}

/// A lesson to be given.
#[derive(Debug, Clone, PartialEq)]
pub struct Lesson {
    /// Counted from 1.
    pub number: usize,
    /// Of what is to be placed.
    pub id: String,
    /// What people call it.
    pub label: String,
    /// ROS parameters that make the lesson about it, YAML.
    pub parameters: String,
}

/// The things to place, and what has become of them.
#[derive(Debug, Clone)]
pub struct Course {
    width_m: f64,
    depth_m: f64,
    standing: Vec<Object>,
    targets: Vec<(Object, String)>,
    done: Vec<Outcome>,
}

impl Course {
    /// A course that has not begun.
    ///
    /// # Errors
    /// In a sentence, when the parameters are no setting.
    pub fn new(settings: &Settings) -> Result<Self, String> {
        let targets = settings.targets().map_err(|error| error.to_string())?;
        if targets.is_empty() {
            return Err("target_ids names nothing to place".to_owned());
        }
        Ok(Self {
            width_m: settings.table_width_m,
            depth_m: settings.table_depth_m,
            standing: settings.objects().map_err(|error| error.to_string())?,
            targets,
            done: Vec::new(),
        })
    }

    /// How many lessons there are.
    pub fn len(&self) -> usize {
        self.targets.len()
    }

    /// Whether there is nothing to place; never.
    pub fn is_empty(&self) -> bool {
        self.targets.is_empty()
    }

    /// What has become of each thing so far: its label and how its lesson ended.
    pub fn done(&self) -> impl Iterator<Item = (&str, Outcome)> {
        self.targets.iter().map(|(target, _)| target.label.as_str()).zip(self.done.iter().copied())
    }

    /// The lesson that comes next; `None` at the end.
    pub fn upcoming(&self) -> Option<Lesson> {
        let number = self.done.len() + 1;
        let (target, home) = self.targets.get(number - 1)?;
        Some(Lesson {
            number,
            id: target.id.clone(),
            label: target.label.clone(),
            parameters: self.parameters(target, home),
        })
    }

    /// The lesson that came next is over.
    pub fn end(&mut self, outcome: Outcome) {
        if let (Some((target, _)), Outcome::Placed(position_m)) = (self.targets.get(self.done.len()), outcome) {
            self.standing.push(Object { position_m, ..target.clone() });
        }
        self.done.push(outcome);
    }

    /// Parameters of the simulated table and of the simulated person.
    fn parameters(&self, target: &Object, home: &str) -> String {
        let each = |of: &dyn Fn(&Object) -> Value| Value::from(self.standing.iter().map(of).collect::<Vec<_>>());
        let flat =
            |of: &dyn Fn(&Object) -> Vec<f64>| Value::from(self.standing.iter().flat_map(of).collect::<Vec<_>>());
        let table = [
            ("scene_id", json!(target.id)),
            ("table_width_m", json!(self.width_m)),
            ("table_depth_m", json!(self.depth_m)),
            ("object_ids", each(&|object| json!(object.id))),
            ("object_labels", each(&|object| json!(object.label))),
            ("object_shapes", each(&|object| json!(shape(object)))),
            ("object_sizes_m", flat(&|object| object.shape.extents_m().to_vec())),
            ("object_positions_m", flat(&|object| vec![object.position_m.x, object.position_m.y])),
            ("object_yaws_rad", flat(&|object| vec![object.yaw_rad])),
            ("object_supports", each(&|object| json!(object.supports))),
            ("target_id", json!(target.id)),
            ("target_label", json!(target.label)),
            ("target_shape", json!(shape(target))),
            ("target_size_m", json!(target.shape.extents_m())),
        ];
        let mut text = section("simulated_table", &table);
        if !home.is_empty() {
            text += &section("demonstrator", &[("reward_names", json!([home])), ("reward_weights", json!([1.0]))]);
        }
        text
    }
}

/// A section of a parameter file; JSON is YAML. A list without entries has no type and is left out.
fn section(node: &str, parameters: &[(&str, Value)]) -> String {
    let is_told = |value: &Value| value.as_array().is_none_or(|list| !list.is_empty());
    let line = |(name, value): &(&str, Value)| is_told(value).then(|| format!("    {name}: {value}\n"));
    format!("/**/{node}:\n  ros__parameters:\n{}", parameters.iter().filter_map(line).collect::<String>())
}

fn shape(object: &Object) -> &'static str {
    match object.shape {
        Shape::Cylinder { .. } => "cylinder",
        Shape::Box { .. } => "box",
    }
}

#[cfg(test)]
mod tests {
    use super::{Course, Outcome, Settings};
    use scene::Point;

    fn breakfast() -> Course {
        let names = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
        Course::new(&Settings {
            target_ids: names(&["saucer", "cup", "spoon"]),
            target_shapes: names(&["cylinder", "cylinder", "box"]),
            target_sizes_m: vec![0.12, 0.12, 0.01, 0.08, 0.08, 0.09, 0.1, 0.02, 0.01],
            target_homes: names(&["table centre", "saucer", ""]),
            ..Settings::default()
        })
        .expect("a setting")
    }

    #[test]
    fn what_was_placed_stands_on_the_next_table_and_what_was_left_does_not() {
        let mut course = breakfast();
        let first = course.upcoming().expect("three lessons");
        assert_eq!((first.number, first.id.as_str()), (1, "saucer"));
        assert!(!first.parameters.contains("object_ids"), "nothing stands there yet: {}", first.parameters);
        assert!(first.parameters.contains("reward_names: [\"table centre\"]"));
        course.end(Outcome::Placed(Point::new(0.5, 0.25)));
        let second = course.upcoming().expect("three lessons").parameters;
        assert!(
            second.contains("object_ids: [\"saucer\"]") && second.contains("object_positions_m: [0.5,0.25]"),
            "{second}"
        );
        course.end(Outcome::Left);
        let third = course.upcoming().expect("three lessons").parameters;
        assert!(third.contains("object_ids: [\"saucer\"]") && third.contains("target_shape: \"box\""), "{third}");
        assert!(!third.contains("demonstrator"), "a person answers that");
        course.end(Outcome::Placed(Point::new(0.1, 0.1)));
        assert_eq!(course.upcoming(), None);
        let said: Vec<_> = course.done().map(|(label, outcome)| (label, outcome == Outcome::Left)).collect();
        assert_eq!(said, [("saucer", false), ("cup", true), ("spoon", false)]);
    }

    #[test]
    fn a_setting_of_nothing_is_refused() {
        assert!(Course::new(&Settings::default()).expect_err("nothing to place").contains("target_ids"));
    }
}
