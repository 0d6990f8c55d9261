//! A setting as ROS parameters: what stands on the table, and what is to be placed, in order.

use bus::{NodeSettings, ParameterSpec, Range};
use scene::{ListError, Listed, Object, Point, Scene};
use serde::{Deserialize, Serialize};

/// The section `/**/setting` of a parameter file; the other sections of the file are for the nodes of every lesson.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Extent along x, metres.
    pub table_width_m: f64,
    /// Extent along y, metres.
    pub table_depth_m: f64,
    /// Unique ids of what stands on the table at first.
    pub object_ids: Vec<String>,
    /// What people call them; one per object, or none to use the ids.
    pub object_labels: Vec<String>,
    /// "cylinder" or "box"; one per object.
    pub object_shapes: Vec<String>,
    /// Three extents per object (x, y, z), metres; a cylinder's x and y are its diameter.
    pub object_sizes_m: Vec<f64>,
    /// Two coordinates per object (x, y), metres.
    pub object_positions_m: Vec<f64>,
    /// Rotation about the vertical; one per object, or none for all zero.
    pub object_yaws_rad: Vec<f64>,
    /// Whether other things may stand on it; one per object, or none for all false.
    pub object_supports: Vec<bool>,
    /// Unique ids of what is to be placed, in this order.
    pub target_ids: Vec<String>,
    /// What people call them; one per target, or none to use the ids.
    pub target_labels: Vec<String>,
    /// "cylinder" or "box"; one per target.
    pub target_shapes: Vec<String>,
    /// Three extents per target, metres.
    pub target_sizes_m: Vec<f64>,
    /// Where the simulated person wants each: the id of something that stands on the table by then, or "table centre".
    pub target_homes: Vec<String>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            table_width_m: 1.0,
            table_depth_m: 1.0,
            object_ids: Vec::new(),
            object_labels: Vec::new(),
            object_shapes: Vec::new(),
            object_sizes_m: Vec::new(),
            object_positions_m: Vec::new(),
            object_yaws_rad: Vec::new(),
            object_supports: Vec::new(),
            target_ids: Vec::new(),
            target_labels: Vec::new(),
            target_shapes: Vec::new(),
            target_sizes_m: Vec::new(),
            target_homes: Vec::new(),
        }
    }
}

impl Settings {
    /// What stands on the table at first.
    ///
    /// # Errors
    /// Lists that do not fit together; a shape that is not known.
    pub fn objects(&self) -> Result<Vec<Object>, ListError> {
        let listed = Listed {
            of: "object",
            ids: &self.object_ids,
            labels: &self.object_labels,
            shapes: &self.object_shapes,
            sizes_m: &self.object_sizes_m,
            supports: &self.object_supports,
        };
        listed.standing(&self.object_positions_m, &self.object_yaws_rad)
    }

    /// What is to be placed, and where the simulated person wants it.
    ///
    /// # Errors
    /// Lists that do not fit together; a shape that is not known.
    pub fn targets(&self) -> Result<Vec<(Object, String)>, ListError> {
        let listed = Listed {
            of: "target",
            ids: &self.target_ids,
            labels: &self.target_labels,
            shapes: &self.target_shapes,
            sizes_m: &self.target_sizes_m,
            supports: &[],
        };
        listed.fit("target_homes", self.target_homes.len(), 1, true)?;
        let homes = self.target_homes.iter().cloned().chain(std::iter::repeat(String::new()));
        Ok(listed.objects()?.into_iter().zip(homes).collect())
    }
}

/// The feature of the middle of the table, as the rewards of the simulated person name it.
pub(crate) const CENTRE: &str = "table centre";

const EXTENT_M: Range = Range::Float { min: 0.001, max: 100.0 };
const SHAPES: Range = Range::Choice(&["cylinder", "box"]);

impl NodeSettings for Settings {
    const NODE: &'static str = "setting";
    const ABOUT: &'static str = "A table to be set, one thing after another.";
    const PARAMETERS: &'static [ParameterSpec] = &[
        ParameterSpec { name: "table_width_m", about: "extent of the table along x, metres", range: EXTENT_M },
        ParameterSpec { name: "table_depth_m", about: "extent of the table along y, metres", range: EXTENT_M },
        ParameterSpec {
            name: "object_ids",
            about: "unique ids of what stands on the table at first",
            range: Range::Any,
        },
        ParameterSpec {
            name: "object_labels",
            about: "what people call them; one per object, or none to use the ids",
            range: Range::Any,
        },
        ParameterSpec { name: "object_shapes", about: "one per object", range: SHAPES },
        ParameterSpec {
            name: "object_sizes_m",
            about: "three extents per object: x, y, z, metres; a cylinder's x and y are its diameter",
            range: EXTENT_M,
        },
        ParameterSpec {
            name: "object_positions_m",
            about: "two coordinates per object: x to the right, y away from the robot, metres",
            range: Range::Float { min: -100.0, max: 100.0 },
        },
        ParameterSpec {
            name: "object_yaws_rad",
            about: "rotation about the vertical, radians; one per object, or none for all zero",
            range: Range::Float { min: -7.0, max: 7.0 },
        },
        ParameterSpec {
            name: "object_supports",
            about: "whether other things may stand on it; one per object, or none for all false",
            range: Range::Any,
        },
        ParameterSpec { name: "target_ids", about: "unique ids of what is to be placed, in order", range: Range::Any },
        ParameterSpec {
            name: "target_labels",
            about: "what people call them; one per target, or none to use the ids",
            range: Range::Any,
        },
        ParameterSpec { name: "target_shapes", about: "one per target", range: SHAPES },
        ParameterSpec { name: "target_sizes_m", about: "three extents per target: x, y, z, metres", range: EXTENT_M },
        ParameterSpec {
            name: "target_homes",
            about: "where the simulated person wants each: something that stands on the table by then, or 'table centre'",
            range: Range::Any,
        },
    ];

    fn check(&self) -> Result<(), String> {
        let objects = self.objects().map_err(|error| error.to_string())?;
        let targets = self.targets().map_err(|error| error.to_string())?;
        let mut standing = objects;
        for (target, home) in targets {
            let is_there = home.is_empty() || home == CENTRE || standing.iter().any(|object| object.id == home);
            if !is_there {
                return Err(format!(
                    "the home of '{}' is '{home}', which does not stand on the table when its turn comes",
                    target.id
                ));
            }
            let scene = Scene {
                id: target.id.clone(),
                frame: "table".to_owned(),
                width_m: self.table_width_m,
                depth_m: self.table_depth_m,
                objects: standing.clone(),
                target: target.clone(),
            };
            scene.check().map_err(|error| error.to_string())?;
            // Where it will stand is not known yet; that it will is.
            standing.push(Object { position_m: Point::new(0.5 * scene.width_m, 0.5 * scene.depth_m), ..target });
        }
        Ok(())
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
    fn what_is_wanted_somewhere_comes_after_it() {
        let names = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
        let setting = Settings {
            target_ids: names(&["saucer", "cup"]),
            target_shapes: names(&["cylinder", "cylinder"]),
            target_sizes_m: vec![0.12, 0.12, 0.01, 0.08, 0.08, 0.09],
            target_homes: names(&["table centre", "saucer"]),
            ..Settings::default()
        };
        setting.check().expect("the saucer comes first");
        let late = Settings { target_homes: names(&["cup", "table centre"]), ..setting.clone() };
        assert!(late.check().expect_err("no cup yet").contains("'cup', which does not stand"), "{:?}", late.check());
        let twice = Settings { target_ids: names(&["cup", "cup"]), ..setting.clone() };
        assert!(twice.check().is_err());
        let short = Settings { target_sizes_m: vec![0.1; 5], ..setting };
        assert!(short.check().expect_err("5 of 6").contains("target_sizes_m has 5 entries; 6"));
    }
}
