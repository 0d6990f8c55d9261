//! Messages as the pages see them: checked, with `null` for what is not finite.

use crate::protocol::{
    BoundsView, CandidateView, LessonView, ObjectView, PlanView, PosteriorView, QuestionView, SceneView, SpotView,
    TrendPoint,
};
use apprentice_msgs::geometry_msgs::Point;
use apprentice_msgs::msg::{
    LessonStatus, PerformanceBounds, PlacementBound, PlacementCandidate, PlacementPlan, PlacementQuery, Posterior,
    TableScene,
};
use exchange::{ExchangeError, motion_seconds, scene_from_message};
use scene::{Object, Shape};

/// A larger map is not shown.
const MAX_MAP_SIDE: u32 = 256;
/// More candidates are not shown.
const MAX_CANDIDATES: usize = 50;

/// More pieces of evidence that do not fit are not named.
const MAX_MISFITS: usize = 16;

/// `None` for what is not finite.
pub(crate) fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// A scene, when it can be used at all.
pub(crate) fn scene_view(message: &TableScene) -> Result<SceneView, ExchangeError> {
    let scene = scene_from_message(message)?;
    Ok(SceneView {
        objects: scene.objects.iter().map(object_view).collect(),
        target: object_view(&Object { position_m: scene::Point::default(), yaw_rad: 0.0, ..scene.target }),
        id: scene.id,
        frame_id: scene.frame,
        width_m: scene.width_m,
        depth_m: scene.depth_m,
    })
}

pub(crate) fn object_view(object: &Object) -> ObjectView {
    let (shape, size_x_m, size_y_m, size_z_m) = match object.shape {
        Shape::Cylinder { radius_m, height_m } => ("cylinder", 2.0 * radius_m, 2.0 * radius_m, height_m),
        Shape::Box { width_m, depth_m, height_m } => ("box", width_m, depth_m, height_m),
    };
    ObjectView {
        id: object.id.clone(),
        label: object.label.clone(),
        shape,
        size_x_m,
        size_y_m,
        size_z_m,
        x_m: object.position_m.x,
        y_m: object.position_m.y,
        yaw_rad: object.yaw_rad,
        supports: object.supports,
    }
}

/// The table of a question that offers nothing, or two places on it.
///
/// # Errors
/// In a sentence, when it offers anything else.
pub(crate) fn check_options(message: &PlacementQuery, scene: SceneView) -> Result<SceneView, String> {
    if ![0, 2].contains(&message.options.len()) {
        return Err(format!("it offers {} places; none or two can be shown", message.options.len()));
    }
    let is_on = |x: f64, extent_m: f64| (0.0..=extent_m).contains(&x);
    for option in &message.options {
        let at = &option.placement;
        if !is_on(at.x, scene.width_m) || !is_on(at.y, scene.depth_m) {
            return Err(format!("it offers ({}, {}) m, which is off the table", at.x, at.y));
        }
    }
    Ok(scene)
}

/// A question; whether it is open is for the caller to say.
pub(crate) fn question_view(message: &PlacementQuery, scene: SceneView, open: bool) -> QuestionView {
    QuestionView {
        id: message.id.clone(),
        revision: message.revision,
        scene,
        options: message.options.iter().filter_map(|option| spot(&option.placement)).collect(),
        reason: message.reason.clone(),
        bound_m: finite(message.bound_m),
        epsilon_m: finite(message.epsilon_m),
        n_candidates: message.n_candidates,
        open,
    }
}

/// A plan or guess; maps whose size does not fit are left out, with a sentence for the log.
pub(crate) fn plan_view(message: &PlacementPlan) -> (PlanView, Option<String>) {
    let side = message.map_side;
    let cells = u64::from(side) * u64::from(side);
    let fits = |n: usize| n as u64 == cells;
    let good = side <= MAX_MAP_SIDE && fits(message.reward_map.len()) && fits(message.cell_state.len());
    let complaint = (!good).then(|| {
        format!(
            "a plan's maps are left out: {side} x {side} cells, {} rewards and {} states; both lists must hold every \
             cell, and at most {MAX_MAP_SIDE} x {MAX_MAP_SIDE} are shown",
            message.reward_map.len(),
            message.cell_state.len()
        )
    });
    let outcome = match message.outcome {
        PlacementPlan::PLANNED => "planned",
        PlacementPlan::NO_FREE_PLACE => "no_free_place",
        PlacementPlan::UNREACHABLE => "unreachable",
        PlacementPlan::NO_PATH => "no_path",
        PlacementPlan::NO_ROBOT => "no_robot",
        PlacementPlan::START_IN_COLLISION => "start_in_collision",
        PlacementPlan::GOAL_IN_COLLISION => "goal_in_collision",
        PlacementPlan::JOINTS_UNKNOWN => "joints_unknown",
        PlacementPlan::OUTSIDE_LIMITS => "outside_limits",
        PlacementPlan::CANNOT_PICK => "cannot_pick",
        _ => "unknown",
    };
    let placed = outcome != "no_free_place";
    let view = PlanView {
        query_id: message.query_id.clone(),
        revision: message.revision,
        scene_id: message.scene.id.clone(),
        outcome,
        reason: message.reason.clone(),
        map_placement: spot(&message.map_placement).filter(|_| placed),
        robust_placement: spot(&message.robust_placement).filter(|_| placed),
        map_cvar_m: finite(message.map_cvar_m),
        robust_cvar_m: finite(message.robust_cvar_m),
        alpha: finite(message.alpha),
        inside_bound: message.inside_bound,
        motion_s: motion_seconds(message),
        candidates: message.candidates.iter().take(MAX_CANDIDATES).filter_map(candidate_view).collect(),
        map_side: if good { side } else { 0 },
        reward_map: if good {
            message.reward_map.iter().map(|&v| v.is_finite().then_some(v)).collect()
        } else {
            Vec::new()
        },
        cell_state: if good { message.cell_state.clone() } else { Vec::new() },
    };
    (view, complaint)
}

/// A place that was considered; none when it is nowhere.
fn candidate_view(message: &PlacementCandidate) -> Option<CandidateView> {
    Some(CandidateView {
        x_m: finite(message.position.x)?,
        y_m: finite(message.position.y)?,
        verdict: match message.verdict {
            PlacementCandidate::CHOSEN => "chosen",
            PlacementCandidate::NEXT_BEST => "next_best",
            PlacementCandidate::UNREACHABLE => "unreachable",
            PlacementCandidate::NO_PATH => "no_path",
            PlacementCandidate::BLOCKED => "blocked",
            _ => "unknown",
        },
        reason: message.reason.clone(),
        probability_best: finite(message.probability_best),
        cvar_m: finite(message.cvar_m),
        clearance_m: finite(message.clearance_m),
    })
}

fn spot(point: &Point) -> Option<SpotView> {
    Some(SpotView { x_m: finite(point.x)?, y_m: finite(point.y)? })
}

/// Where the lesson stands.
pub(crate) fn lesson_view(message: &LessonStatus) -> LessonView {
    LessonView {
        revision: message.revision,
        state: match message.state {
            LessonStatus::ASKING => "asking",
            LessonStatus::TAUGHT => "taught",
            LessonStatus::STOPPED => "stopped",
            LessonStatus::GAVE_UP => "gave_up",
            LessonStatus::PAUSED => "paused",
            LessonStatus::FINISHED => "finished",
            LessonStatus::MISFIT => "misfit",
            _ => "unknown",
        },
        reason: message.reason.clone(),
        query_id: message.query_id.clone(),
        questions_asked: message.questions_asked,
        demonstrations: message.demonstrations,
        bound_outcome: bound_outcome(message.bound_outcome),
        bound_m: finite(message.bound_m),
        epsilon_m: finite(message.epsilon_m),
        loss_bound: goal(message).and(finite(message.loss_bound)),
        epsilon_loss: goal(message),
        held_out: message.held_out,
        surprises: message.surprises,
        misfits: message.misfits.iter().take(MAX_MISFITS).cloned().collect(),
    }
}

/// The goal of a lesson about a world; none in one about a table.
pub(crate) fn goal(message: &LessonStatus) -> Option<f64> {
    finite(message.epsilon_loss).filter(|goal| *goal > 0.0)
}

/// The bound with its receipt.
pub(crate) fn bounds_view(message: &PerformanceBounds) -> BoundsView {
    BoundsView {
        revision: message.revision,
        outcome: bound_outcome(message.outcome),
        reason: message.reason.clone(),
        bound_m: finite(message.bound_m),
        alpha: finite(message.alpha),
        delta: finite(message.delta),
        look: message.look,
        delta_spent: finite(message.delta_spent),
        n: message.n,
        n_chains: message.n_chains,
        ess_min: finite(message.ess_min),
        rhat_max: finite(message.rhat_max),
        acceptance: finite(message.acceptance),
        beta: finite(message.beta),
        prior: message.prior.clone(),
        evidence_hash: message.evidence_hash.clone(),
        seed: message.seed.to_string(),
        version: message.version.clone(),
    }
}

/// The bound as a point of the history; the goal is filled in when it is shown.
pub(crate) fn trend_point(message: &PerformanceBounds) -> TrendPoint {
    TrendPoint {
        revision: message.revision,
        outcome: bound_outcome(message.outcome),
        bound_m: finite(message.bound_m),
        epsilon_m: None,
        reason: message.reason.clone(),
    }
}

/// The posterior in short.
pub(crate) fn posterior_view(message: &Posterior) -> PosteriorView {
    PosteriorView {
        revision: message.revision,
        outcome: match message.outcome {
            Posterior::READY => "ready",
            Posterior::NOT_MIXED => "not_mixed",
            _ => "unknown",
        },
        reason: message.reason.clone(),
        n_demonstrations: message.n_demonstrations,
        evidence_hash: message.evidence_hash.clone(),
    }
}

fn bound_outcome(outcome: u8) -> &'static str {
    match outcome {
        PlacementBound::BOUND => "bound",
        PlacementBound::NOT_ENOUGH_SAMPLES => "not_enough_samples",
        PlacementBound::NOT_MIXED => "not_mixed",
        PlacementBound::NO_PLACEMENT => "no_placement",
        _ => "unknown",
    }
}
