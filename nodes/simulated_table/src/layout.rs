//! From the flat lists of the parameters to a scene.

use crate::Settings;
use scene::{ListError, Listed, Scene, SceneError, listed_target};
use thiserror::Error;

/// Why parameters describe no table.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum LayoutError {
    /// Lists that do not fit together.
    #[error(transparent)]
    List(#[from] ListError),
    /// The scene breaks the rules of scenes.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// The table that the parameters describe.
///
/// # Errors
/// When lists do not fit together, or the scene breaks the rules of scenes.
pub fn task_scene(settings: &Settings) -> Result<Scene, LayoutError> {
    let listed = Listed {
        of: "object",
        ids: &settings.object_ids,
        labels: &settings.object_labels,
        shapes: &settings.object_shapes,
        sizes_m: &settings.object_sizes_m,
        supports: &settings.object_supports,
    };
    let scene = Scene {
        id: settings.scene_id.clone(),
        frame: settings.frame.clone(),
        width_m: settings.table_width_m,
        depth_m: settings.table_depth_m,
        objects: listed.standing(&settings.object_positions_m, &settings.object_yaws_rad)?,
        target: listed_target(
            &settings.target_id,
            &settings.target_label,
            &settings.target_shape,
            &settings.target_size_m,
        )?,
    };
    scene.check()?;
    Ok(scene)
}
