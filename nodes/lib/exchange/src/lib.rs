//! Between the messages on the graph and the types of the core: everything that comes in is checked here, once.

mod drawing;
mod evidence;
mod motion;
mod policies;
mod posterior;
mod record;
mod robust_policy;
mod table;
mod text;
mod world;
mod world_query;

pub use drawing::{broken_text, colour, delete_all_markers, marker, pose_at, text_marker, upright};
pub use evidence::{
    Confidence, EvidenceError, MAX_FEATURE, MAX_STEPS, MAX_TRAJECTORIES, Mark, check_history, check_preference,
    confidence_from_message, marks_from_message, steps_from_message,
};
pub use motion::{GRIP_S, motion_seconds, trajectory_seconds};
pub use policies::{Checked, Form, MAX_POLICIES, PolicyError, check_policies};
pub use posterior::{PosteriorError, check_posterior, is_about_a_table, is_about_scene};
pub use record::{begins_lesson, in_force, record_header, record_id};
pub use robust_policy::{
    PreferenceError, ROBUST_POLICY, RobustPolicyError, check_preference_of_risk, check_robust_policy,
    demonstrations_in_force, robust_set_id,
};
pub use table::{
    ExchangeError, object_from_message, point_from_message, point_to_message, scene_from_message, scene_to_message,
    stands_as,
};
pub use text::{MAX_ID, TextError};
pub use world::{Picture, World, WorldError, world_from_message, world_hash, world_to_message};
pub use world_query::{MAX_SHOWN_STEPS, WorldQueryError, check_world_query, feature_trajectory};

/// More weights than this are refused.
pub const MAX_WEIGHTS: usize = 1024;
