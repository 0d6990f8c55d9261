//! Parameters of the node: what may stand on the table, and what is taken for it.

use bus::{NodeSettings, ParameterSpec, Range};
use scene::{ListError, Listed, Object, Scene, listed_target};
use serde::{Deserialize, Serialize};

/// Parameters of `table_perception`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Id of the scene.
    pub scene_id: String,
    /// Frame of the table: x to the right, y away from the robot, origin at the near left corner of its surface.
    pub frame: String,
    /// Extent along x, metres.
    pub table_width_m: f64,
    /// Extent along y, metres.
    pub table_depth_m: f64,
    /// Unique ids of the things on the table.
    pub object_ids: Vec<String>,
    /// What people call them; one per object, or none to use the ids.
    pub object_labels: Vec<String>,
    /// What the detector calls them; one per object, or none to use the ids. Several may be of one class.
    pub object_classes: Vec<String>,
    /// "cylinder" or "box"; one per object.
    pub object_shapes: Vec<String>,
    /// Three extents per object (x, y, z), metres; a cylinder's x and y are its diameter.
    pub object_sizes_m: Vec<f64>,
    /// Whether other things may stand on it; one per object, or none for all false.
    pub object_supports: Vec<bool>,
    /// A topic of `PoseStamped` for an object, empty for none; one per object, or none at all.
    pub pose_topics: Vec<String>,
    /// Id of the thing to place.
    pub target_id: String,
    /// What people call it.
    pub target_label: String,
    /// "cylinder" or "box".
    pub target_shape: String,
    /// Three extents, metres.
    pub target_size_m: Vec<f64>,
    /// What the detector calls it; empty: its id.
    pub target_class: String,
    /// A topic of `PoseStamped` for it; empty: none.
    pub target_pose_topic: String,
    /// Detections with a lower score do not count.
    pub min_score: f64,
    /// What is tilted by more does not stand, radians.
    pub max_tilt_rad: f64,
    /// How far above or below the surface the middle of something may be, metres.
    pub reach_m: f64,
    /// What moves less stands still, metres.
    pub still_m: f64,
    /// What turns less stands still, radians; cylinders may turn as they like.
    pub still_rad: f64,
    /// What is not seen for so long is no longer there, seconds.
    pub forget_s: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            scene_id: "table".to_owned(),
            frame: "table".to_owned(),
            table_width_m: 1.0,
            table_depth_m: 1.0,
            object_ids: Vec::new(),
            object_labels: Vec::new(),
            object_classes: Vec::new(),
            object_shapes: Vec::new(),
            object_sizes_m: Vec::new(),
            object_supports: Vec::new(),
            pose_topics: Vec::new(),
            target_id: "target".to_owned(),
            target_label: "target".to_owned(),
            target_shape: "cylinder".to_owned(),
            target_size_m: vec![0.08, 0.08, 0.2],
            target_class: String::new(),
            target_pose_topic: String::new(),
            min_score: 0.5,
            max_tilt_rad: 0.35,
            reach_m: 0.5,
            still_m: 0.008,
            still_rad: 0.05,
            forget_s: 10.0,
        }
    }
}

impl Settings {
    fn listed(&self) -> Listed<'_> {
        Listed {
            of: "object",
            ids: &self.object_ids,
            labels: &self.object_labels,
            shapes: &self.object_shapes,
            sizes_m: &self.object_sizes_m,
            supports: &self.object_supports,
        }
    }

    /// The table with everything at its origin.
    pub(crate) fn scene(&self) -> Result<Scene, ListError> {
        let listed = self.listed();
        listed.fit("object_classes", self.object_classes.len(), 1, true)?;
        listed.fit("pose_topics", self.pose_topics.len(), 1, true)?;
        Ok(Scene {
            id: self.scene_id.clone(),
            frame: self.frame.clone(),
            width_m: self.table_width_m,
            depth_m: self.table_depth_m,
            objects: listed.objects()?,
            target: listed_target(&self.target_id, &self.target_label, &self.target_shape, &self.target_size_m)?,
        })
    }

    /// What the detector calls the thing to place.
    pub(crate) fn target_class(&self) -> &str {
        if self.target_class.is_empty() { &self.target_id } else { &self.target_class }
    }

    /// What the detector calls a thing.
    pub(crate) fn class<'a>(&'a self, i: usize, object: &'a Object) -> &'a str {
        self.object_classes.get(i).map_or(object.id.as_str(), String::as_str)
    }
}

const EXTENT_M: Range = Range::Float { min: 0.001, max: 100.0 };
const SHAPES: Range = Range::Choice(&["cylinder", "box"]);

impl NodeSettings for Settings {
    const NODE: &'static str = "table_perception";
    const ABOUT: &'static str = "Makes the scene of a lesson from what detectors and trackers see of a real table";
    const PARAMETERS: &'static [ParameterSpec] = &[
        ParameterSpec { name: "scene_id", about: "id of the scene", range: Range::Any },
        ParameterSpec {
            name: "frame",
            about: "tf frame of the table: x to the right, y away from the robot, origin at its near left corner",
            range: Range::Any,
        },
        ParameterSpec { name: "table_width_m", about: "extent of the table along x, metres", range: EXTENT_M },
        ParameterSpec { name: "table_depth_m", about: "extent of the table along y, metres", range: EXTENT_M },
        ParameterSpec { name: "object_ids", about: "unique ids of the things on the table", range: Range::Any },
        ParameterSpec {
            name: "object_labels",
            about: "what people call them; one per object, or none to use the ids",
            range: Range::Any,
        },
        ParameterSpec {
            name: "object_classes",
            about: "what the detector calls them (class_id); one per object, or none to use the ids; several may be of one class",
            range: Range::Any,
        },
        ParameterSpec { name: "object_shapes", about: "one per object", range: SHAPES },
        ParameterSpec {
            name: "object_sizes_m",
            about: "three extents per object: x, y, z, metres; a cylinder's x and y are its diameter",
            range: EXTENT_M,
        },
        ParameterSpec {
            name: "object_supports",
            about: "whether other things may stand on it; one per object, or none for all false",
            range: Range::Any,
        },
        ParameterSpec {
            name: "pose_topics",
            about: "a topic of geometry_msgs/PoseStamped for each object that a tracker follows, '' for the others; or none at all",
            range: Range::Any,
        },
        ParameterSpec { name: "target_id", about: "id of the thing to place", range: Range::Any },
        ParameterSpec { name: "target_label", about: "what people call it", range: Range::Any },
        ParameterSpec { name: "target_shape", about: "its shape", range: SHAPES },
        ParameterSpec { name: "target_size_m", about: "its three extents: x, y, z, metres", range: EXTENT_M },
        ParameterSpec {
            name: "target_class",
            about: "what the detector calls it (class_id); empty: its id; where things on the table are called so too, they are meant",
            range: Range::Any,
        },
        ParameterSpec {
            name: "target_pose_topic",
            about: "a topic of geometry_msgs/PoseStamped when a tracker follows it; empty: none",
            range: Range::Any,
        },
        ParameterSpec {
            name: "min_score",
            about: "detections with a lower score do not count",
            range: Range::Float { min: 0.0, max: 1.0 },
        },
        ParameterSpec {
            name: "max_tilt_rad",
            about: "what is tilted by more does not stand, radians",
            range: Range::Float { min: 0.0, max: 1.5 },
        },
        ParameterSpec {
            name: "reach_m",
            about: "how far above or below the table's surface the middle of a thing on it may be, metres",
            range: Range::Float { min: 0.01, max: 10.0 },
        },
        ParameterSpec {
            name: "still_m",
            about: "what moves less stands still, metres",
            range: Range::Float { min: 0.0, max: 0.1 },
        },
        ParameterSpec {
            name: "still_rad",
            about: "what turns less stands still, radians; cylinders may turn as they like",
            range: Range::Float { min: 0.0, max: 1.0 },
        },
        ParameterSpec {
            name: "forget_s",
            about: "what is not seen for so long, behind the arm for one, is taken for gone, seconds",
            range: Range::Float { min: 0.1, max: 86_400.0 },
        },
    ];

    fn check(&self) -> Result<(), String> {
        let scene = self.scene().map_err(|error| error.to_string())?;
        scene.check().map_err(|error| error.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::Settings;
    use bus::NodeSettings;

    #[test]
    fn the_table_of_parameters_matches_the_settings() {
        bus::testing::check_parameters::<Settings>();
    }

    #[test]
    fn lists_must_fit_together() {
        let one = Settings {
            object_ids: vec!["cup".into()],
            object_shapes: vec!["cylinder".into()],
            object_sizes_m: vec![0.08, 0.08, 0.1],
            ..Settings::default()
        };
        assert_eq!(one.check(), Ok(()));
        let told = |settings: Settings| settings.check().expect_err("it does not fit");
        assert_eq!(Settings::default().check(), Ok(()), "a table may be empty");
        let two = vec!["a".to_owned(), "b".to_owned()];
        assert!(told(Settings { object_classes: two.clone(), ..one.clone() }).contains("object_classes has 2"));
        assert!(told(Settings { pose_topics: two, ..one }).contains("pose_topics has 2"));
    }
}
