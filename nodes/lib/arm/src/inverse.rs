//! Inverse kinematics of a position and a direction of the tool's z axis, the turn about it left free.
//!
//! Damped least squares (Wampler 1986) in the Levenberg–Marquardt form: the damping falls with the error, a step that does
//! not help is taken back. Joints at a limit that want to leave it are held.

use crate::{Chain, JacobianColumn, Robot, jacobian};
use nalgebra::{Isometry3, SMatrix, SVector, Unit, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Where the tool is to be, in the root frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisGoal {
    /// Of the tool's origin, metres.
    pub position: Vector3<f64>,
    /// Where the tool's z axis is to point.
    pub direction: Unit<Vector3<f64>>,
}

/// How hard to try.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IkSettings {
    /// Random starts after the given one.
    pub restarts: usize,
    /// Steps from each start.
    pub iterations: usize,
    /// Accepted error of the position, metres.
    pub position_tolerance: f64,
    /// Accepted error of the direction, radians.
    pub direction_tolerance: f64,
    /// Of the random starts.
    pub seed: u64,
}

impl Default for IkSettings {
    fn default() -> Self {
        Self { restarts: 24, iterations: 60, position_tolerance: 1e-6, direction_tolerance: 1e-6, seed: 1 }
    }
}

/// What came of it.
#[derive(Debug, Clone, PartialEq)]
pub enum IkOutcome {
    /// A configuration of the whole robot, within limits, that meets the goal.
    Solved(Vec<f64>),
    /// No start led there.
    NotFound {
        /// Smallest error of the position that was reached, metres.
        position_error: f64,
        /// The error of the direction there, radians.
        direction_error: f64,
    },
    /// Farther than the chain is long.
    OutOfReach {
        /// From the first moving joint to the goal, metres.
        distance: f64,
        /// Length of the chain, metres.
        reach: f64,
    },
}

/// Errors of the direction count as if the tool were a lever of this length, metres.
const LEVER: f64 = 0.3;
/// No joint moves farther in one step, radians or metres.
const LARGEST_STEP: f64 = 0.6;

/// Finds a configuration for a goal, near `start` if one is there: entries that do not move the tool stay as in `start`,
/// and further starts are drawn from the settings' seed. `accept` may refuse a solution (a collision, say).
pub fn solve(
    robot: &Robot,
    chain: &Chain,
    goal: &AxisGoal,
    start: &[f64],
    settings: &IkSettings,
    mut accept: impl FnMut(&[f64]) -> bool,
) -> IkOutcome {
    let mut work = Work::default();
    let mut q = start.to_vec();
    clamp(robot, chain, &mut q);
    robot.link_poses(&q, &mut work.poses);
    let &(first, ..) = chain.moves.first().expect("a chain has a moving joint");
    let joint = &robot.joints[first];
    let base = (work.poses[joint.parent] * joint.parent_from_joint).translation.vector;
    let distance = (goal.position - base).norm();
    if distance > chain.reach + settings.position_tolerance {
        return IkOutcome::OutOfReach { distance, reach: chain.reach };
    }
    let mut rng = ChaCha8Rng::seed_from_u64(settings.seed);
    let mut best = (f64::INFINITY, f64::INFINITY);
    for attempt in 0..=settings.restarts {
        if attempt > 0 {
            scatter(robot, chain, &mut q, &mut rng);
        }
        let (position, direction) = descend(robot, chain, goal, &mut q, settings, &mut work);
        if position <= settings.position_tolerance && direction <= settings.direction_tolerance {
            if accept(&q) {
                return IkOutcome::Solved(q);
            }
        } else if position + LEVER * direction < best.0 + LEVER * best.1 {
            best = (position, direction);
        }
    }
    if best.0.is_infinite() {
        best = (0.0, 0.0);
    }
    IkOutcome::NotFound { position_error: best.0, direction_error: best.1 }
}

#[derive(Default)]
struct Work {
    poses: Vec<Isometry3<f64>>,
    columns: Vec<JacobianColumn>,
    trial: Vec<f64>,
}

type Error5 = SVector<f64, 5>;

/// Steps from `q` until the goal is met or nothing helps; returns the errors of position and direction.
fn descend(
    robot: &Robot,
    chain: &Chain,
    goal: &AxisGoal,
    q: &mut Vec<f64>,
    settings: &IkSettings,
    work: &mut Work,
) -> (f64, f64) {
    let across = across(&goal.direction);
    robot.link_poses(q, &mut work.poses);
    let (mut error, mut angle) = error_of(goal, &across, &work.poses[chain.tool]);
    let mut damping = 1e-3;
    let mut slow = 0;
    for _ in 0..settings.iterations {
        let position = error.fixed_rows::<3>(0).norm();
        if position <= 0.1 * settings.position_tolerance && angle <= 0.1 * settings.direction_tolerance {
            break;
        }
        jacobian(robot, chain, &work.poses, &mut work.columns);
        step(robot, chain, &work.columns, &across, &error, damping, q, &mut work.trial);
        robot.link_poses(&work.trial, &mut work.poses);
        let (next, next_angle) = error_of(goal, &across, &work.poses[chain.tool]);
        let gain = next.norm() / error.norm();
        if gain < 1.0 {
            std::mem::swap(q, &mut work.trial);
            (error, angle) = (next, next_angle);
            damping = (0.2 * damping).max(1e-12);
        } else {
            robot.link_poses(q, &mut work.poses);
            damping *= 10.0;
        }
        slow = if gain > 0.98 { slow + 1 } else { 0 };
        if slow > 8 || damping > 1e6 {
            break;
        }
    }
    (error.fixed_rows::<3>(0).norm(), angle)
}

/// Two unit vectors that span the plane across a direction.
fn across(direction: &Unit<Vector3<f64>>) -> [Vector3<f64>; 2] {
    let aside = if direction.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
    let first = direction.cross(&aside).normalize();
    [first, direction.cross(&first)]
}

/// What is missing, as three of position and two of direction (weighted by the lever), and the angle of direction.
fn error_of(goal: &AxisGoal, across: &[Vector3<f64>; 2], tool: &Isometry3<f64>) -> (Error5, f64) {
    let position = goal.position - tool.translation.vector;
    let z = tool.rotation * Vector3::z();
    let turn = z.cross(&goal.direction);
    let angle = libm::atan2(turn.norm(), z.dot(&goal.direction));
    // The turn that is needed lies across the goal's direction; pointing the other way, any will do.
    let turn = match turn.norm() {
        norm if norm > 1e-12 => turn * (angle / norm),
        _ => across[0] * angle,
    };
    let [u, v] = [turn.dot(&across[0]) * LEVER, turn.dot(&across[1]) * LEVER];
    (Error5::from([position.x, position.y, position.z, u, v]), angle)
}

/// dq = Jᵀ (J Jᵀ + λ I)⁻¹ e over the joints that are free to move, clamped to limits, into `trial`.
#[expect(clippy::too_many_arguments, reason = "the parts of one formula")]
fn step(
    robot: &Robot,
    chain: &Chain,
    columns: &[JacobianColumn],
    across: &[Vector3<f64>; 2],
    error: &Error5,
    damping: f64,
    q: &[f64],
    trial: &mut Vec<f64>,
) {
    let row = |c: &JacobianColumn| {
        let [u, v] = [c.angular.dot(&across[0]) * LEVER, c.angular.dot(&across[1]) * LEVER];
        Error5::from([c.linear.x, c.linear.y, c.linear.z, u, v])
    };
    let rows: Vec<Error5> = columns.iter().map(row).collect();
    let mut held = [false; crate::MAX_CHAIN_JOINTS];
    for _ in 0..=rows.len() {
        let mut normal = SMatrix::<f64, 5, 5>::identity() * damping;
        for (c, _) in rows.iter().zip(&held).filter(|(_, held)| !**held) {
            normal += c * c.transpose();
        }
        let Some(factor) = normal.cholesky() else { break };
        let pull = factor.solve(error);
        let largest = rows.iter().zip(&held).filter(|(_, held)| !**held).map(|(c, _)| c.dot(&pull).abs());
        let scale = LARGEST_STEP / largest.fold(LARGEST_STEP, f64::max);
        trial.clear();
        trial.extend_from_slice(q);
        let mut again = false;
        for (i, &entry) in chain.entries.iter().enumerate() {
            if held[i] {
                continue;
            }
            let limits = &robot.driven_joint(entry).limits;
            let wanted = q[entry] + rows[i].dot(&pull) * scale;
            trial[entry] = wanted.clamp(limits.lower, limits.upper);
            if trial[entry] == q[entry] && wanted != q[entry] {
                held[i] = true;
                again = true;
            }
        }
        if !again {
            return;
        }
    }
}

fn clamp(robot: &Robot, chain: &Chain, q: &mut [f64]) {
    for &entry in &chain.entries {
        let limits = &robot.driven_joint(entry).limits;
        q[entry] = q[entry].clamp(limits.lower, limits.upper);
    }
}

/// Draws the chain's joints from their ranges; a joint without limits from one turn.
fn scatter(robot: &Robot, chain: &Chain, q: &mut [f64], rng: &mut ChaCha8Rng) {
    for &entry in &chain.entries {
        let (lower, upper) = sampling_range(robot, entry);
        q[entry] = lower + (upper - lower) * rng.random::<f64>();
    }
}

/// The range from which positions of a joint are drawn.
pub(crate) fn sampling_range(robot: &Robot, entry: usize) -> (f64, f64) {
    let limits = &robot.driven_joint(entry).limits;
    let pi = std::f64::consts::PI;
    (
        if limits.lower.is_finite() { limits.lower } else { -pi },
        if limits.upper.is_finite() { limits.upper } else { pi },
    )
}
