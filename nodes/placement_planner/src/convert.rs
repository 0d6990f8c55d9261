//! Between messages and the planner's types.

use apprentice_msgs::builtin_interfaces::Duration;
use apprentice_msgs::geometry_msgs::{Point as PointMessage, Pose};
use apprentice_msgs::msg::{PlacementCandidate, PlacementPlan as PlanMessage};
use apprentice_msgs::sensor_msgs::JointState;
use apprentice_msgs::std_msgs::Header;
use apprentice_msgs::trajectory_msgs::{JointTrajectory, JointTrajectoryPoint};
use exchange::{point_to_message, pose_at};
use placement::{Candidate, CellState, PlanOutcome, Source, Stand, Trajectory, Verdict};
use scene::Point;

/// More joints than this are not taken from one message.
const MAX_JOINTS: usize = 1000;

/// Joint names and positions that can be used; nameless, repeated or infinite ones are an error in words.
pub(crate) fn joints(message: &JointState) -> Result<Vec<(String, f64)>, String> {
    if message.name.len() != message.position.len() {
        return Err(format!("{} joint names but {} positions", message.name.len(), message.position.len()));
    }
    if message.name.len() > MAX_JOINTS {
        return Err(format!("{} joints; at most {MAX_JOINTS} are supported", message.name.len()));
    }
    match message.name.iter().zip(&message.position).find(|(_, position)| !position.is_finite()) {
        Some((name, position)) => Err(format!("joint '{name}' is at {position}; a finite position is needed")),
        None => Ok(message.name.iter().cloned().zip(message.position.iter().copied()).collect()),
    }
}

/// The joints of a message that the robot has, in the robot's order and without stamp: what a plan depends on.
pub(crate) fn start(names: &[String], joints: &[(String, f64)]) -> JointState {
    let known = names.iter().filter_map(|name| joints.iter().find(|(joint, _)| joint == name));
    let (name, position) = known.cloned().unzip();
    JointState { name, position, ..JointState::default() }
}

pub(crate) fn outcome(outcome: PlanOutcome) -> u8 {
    match outcome {
        PlanOutcome::Planned => PlanMessage::PLANNED,
        PlanOutcome::NoFreePlace => PlanMessage::NO_FREE_PLACE,
        PlanOutcome::Unreachable => PlanMessage::UNREACHABLE,
        PlanOutcome::NoPath => PlanMessage::NO_PATH,
        PlanOutcome::StartInCollision => PlanMessage::START_IN_COLLISION,
        PlanOutcome::GoalInCollision => PlanMessage::GOAL_IN_COLLISION,
        PlanOutcome::JointsUnknown => PlanMessage::JOINTS_UNKNOWN,
        PlanOutcome::OutsideLimits => PlanMessage::OUTSIDE_LIMITS,
        PlanOutcome::NoRobot => PlanMessage::NO_ROBOT,
        PlanOutcome::CannotPick => PlanMessage::CANNOT_PICK,
    }
}

pub(crate) fn cell(state: CellState) -> u8 {
    match state {
        CellState::Free => PlanMessage::CELL_FREE,
        CellState::Occupied => PlanMessage::CELL_OCCUPIED,
        CellState::Unreachable => PlanMessage::CELL_UNREACHABLE,
    }
}

pub(crate) fn candidate(candidate: Candidate) -> PlacementCandidate {
    PlacementCandidate {
        position: point_to_message(candidate.at_m),
        mean_reward: candidate.mean_reward,
        probability_best: candidate.probability_best,
        var_m: candidate.var_m,
        cvar_m: candidate.cvar_m,
        clearance_m: candidate.clearance_m,
        verdict: match candidate.verdict {
            Verdict::Chosen => PlacementCandidate::CHOSEN,
            Verdict::Unreachable => PlacementCandidate::UNREACHABLE,
            Verdict::Blocked => PlacementCandidate::BLOCKED,
            Verdict::NoPath => PlacementCandidate::NO_PATH,
            Verdict::NextBest => PlacementCandidate::NEXT_BEST,
        },
        reason: candidate.reason,
    }
}

/// Where the target is: in the hand, or where a pose has the middle of its base, upright; a pose without numbers is of something
/// that nobody sees.
pub(crate) fn source(pick: Option<&Pose>) -> Source {
    let Some(Pose { position: at, orientation: turn }) = pick else { return Source::Hand };
    let yaw_rad = 2.0 * libm::atan2(turn.z, turn.w);
    if [at.x, at.y, at.z, yaw_rad].iter().all(|number| number.is_finite()) {
        Source::Stands(Stand { at_m: Point::new(at.x, at.y), base_m: at.z, yaw_rad })
    } else {
        Source::Unknown
    }
}

/// The pose of something that nobody sees.
pub(crate) fn unseen() -> Pose {
    let position = PointMessage { x: f64::NAN, y: f64::NAN, z: f64::NAN };
    Pose { position, ..pose_at([0.0; 3], 0.0) }
}

/// A place that may be missing: not numbers then.
pub(crate) fn place(at_m: Option<Point>) -> PointMessage {
    at_m.map_or(PointMessage { x: f64::NAN, y: f64::NAN, z: 0.0 }, point_to_message)
}

pub(crate) fn trajectory(header: &Header, trajectory: Trajectory) -> JointTrajectory {
    let points = trajectory.points.into_iter().map(|point| JointTrajectoryPoint {
        positions: point.positions,
        velocities: point.velocities,
        accelerations: point.accelerations,
        time_from_start: Duration::from_seconds(point.time_from_start_s),
        ..JointTrajectoryPoint::default()
    });
    JointTrajectory { header: header.clone(), joint_names: trajectory.joint_names, points: points.collect() }
}
