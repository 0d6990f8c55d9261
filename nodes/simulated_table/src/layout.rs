//! From the flat lists of the parameters to a scene.

use crate::Settings;
use scene::{Object, Point, Scene, SceneError, Shape};
use thiserror::Error;

/// Why parameters describe no table.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum LayoutError {
    /// Lists that belong together have different lengths.
    #[error("{name} has {got} entries; {expected} are needed for the {objects} object_ids")]
    Length {
        /// The parameter.
        name: &'static str,
        /// Got.
        got: usize,
        /// Needed.
        expected: usize,
        /// Number of objects.
        objects: usize,
    },
    /// A size has three extents.
    #[error("target_size_m has {got} entries; it must have 3 (x, y, z)")]
    TargetSize {
        /// Got.
        got: usize,
    },
    /// Only two shapes are known.
    #[error("the shape of '{id}' is '{got}'; it must be cylinder or box")]
    Shape {
        /// The object.
        id: String,
        /// Got.
        got: String,
    },
    /// A cylinder is as wide as it is deep.
    #[error("'{id}' is a cylinder of {x_m} m by {y_m} m; x and y must both be its diameter")]
    Cylinder {
        /// The object.
        id: String,
        /// Got.
        x_m: f64,
        /// Got.
        y_m: f64,
    },
    /// The scene breaks the rules of scenes.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// The table that the parameters describe.
///
/// # Errors
/// When lists do not fit together, or the scene breaks the rules of scenes.
pub fn task_scene(settings: &Settings) -> Result<Scene, LayoutError> {
    let objects = settings.object_ids.len();
    let fits = |name, got, each: usize, optional: bool| {
        let expected = objects * each;
        let fine = got == expected || (optional && got == 0);
        if fine { Ok(()) } else { Err(LayoutError::Length { name, got, expected, objects }) }
    };
    fits("object_labels", settings.object_labels.len(), 1, true)?;
    fits("object_shapes", settings.object_shapes.len(), 1, false)?;
    fits("object_sizes_m", settings.object_sizes_m.len(), 3, false)?;
    fits("object_positions_m", settings.object_positions_m.len(), 2, false)?;
    fits("object_yaws_rad", settings.object_yaws_rad.len(), 1, true)?;
    fits("object_supports", settings.object_supports.len(), 1, true)?;
    if settings.target_size_m.len() != 3 {
        return Err(LayoutError::TargetSize { got: settings.target_size_m.len() });
    }
    let on_table = settings.object_ids.iter().enumerate().map(|(i, id)| {
        Ok(Object {
            id: id.clone(),
            label: settings.object_labels.get(i).unwrap_or(id).clone(),
            shape: shape(id, &settings.object_shapes[i], &settings.object_sizes_m[3 * i..3 * i + 3])?,
            position_m: Point::new(settings.object_positions_m[2 * i], settings.object_positions_m[2 * i + 1]),
            yaw_rad: settings.object_yaws_rad.get(i).copied().unwrap_or(0.0),
            supports: settings.object_supports.get(i).copied().unwrap_or(false),
        })
    });
    let scene = Scene {
        id: settings.scene_id.clone(),
        frame: settings.frame.clone(),
        width_m: settings.table_width_m,
        depth_m: settings.table_depth_m,
        objects: on_table.collect::<Result<_, LayoutError>>()?,
        target: Object {
            id: settings.target_id.clone(),
            label: settings.target_label.clone(),
            shape: shape(&settings.target_id, &settings.target_shape, &settings.target_size_m)?,
            position_m: Point::default(),
            yaw_rad: 0.0,
            supports: false,
        },
    };
    scene.check()?;
    Ok(scene)
}

/// `size_m` has three entries.
fn shape(id: &str, name: &str, size_m: &[f64]) -> Result<Shape, LayoutError> {
    let (x_m, y_m, height_m) = (size_m[0], size_m[1], size_m[2]);
    match name {
        "cylinder" if x_m == y_m => Ok(Shape::Cylinder { radius_m: 0.5 * x_m, height_m }),
        "cylinder" => Err(LayoutError::Cylinder { id: id.to_owned(), x_m, y_m }),
        "box" => Ok(Shape::Box { width_m: x_m, depth_m: y_m, height_m }),
        _ => Err(LayoutError::Shape { id: id.to_owned(), got: name.to_owned() }),
    }
}
