//! Inverse kinematics: a configuration that brings the tool to a goal.
//!
//! Damped least squares (Wampler 1986) in the Levenberg–Marquardt form: the damping falls with the error, a step that does
//! not help is taken back. Joints at a limit that want to leave it are held. From where that leads nowhere, random starts go on.

use crate::goal::{LEVER, Miss, Target};
use crate::jacobian::PerJoint;
use crate::{Chain, Goal, JacobianColumn, Robot};
use nalgebra::{Cholesky, Const, Matrix6, Vector6};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// How hard to try.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IkSettings {
    /// Random starts after the given one.
    pub restarts: usize,
    /// Steps from each start.
    pub iterations: usize,
    /// Accepted error of the position, metres.
    pub position_tolerance: f64,
    /// Accepted error of the direction or rotation, radians.
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

/// No joint moves farther in one step, radians or metres.
const LARGEST_STEP: f64 = 0.6;
/// Two solutions differ in some joint by more than this, radians or metres.
const DISTINCT: f64 = 1e-3;
/// Steps towards a posture.
const POSTURE_STEPS: usize = 60;

/// Finds a configuration for a goal, near `start` if one is there: entries that do not move the tool stay as in `start`,
/// and further starts are drawn from the settings' seed. `accept` may refuse a solution (a collision, say).
pub fn solve(
    robot: &Robot,
    chain: &Chain,
    goal: &Goal,
    start: &[f64],
    settings: &IkSettings,
    mut accept: impl FnMut(&[f64]) -> bool,
) -> IkOutcome {
    let mut search = Search::new(robot, chain, goal, settings);
    let mut q = start.to_vec();
    search.clamp(&mut q);
    let distance = (search.target.position() - chain.base()).norm();
    // A number that is none is out of every reach.
    if distance.is_nan() || distance > chain.reach + settings.position_tolerance {
        return IkOutcome::OutOfReach { distance, reach: chain.reach };
    }
    let mut rng = ChaCha8Rng::seed_from_u64(settings.seed);
    let mut best = (f64::INFINITY, f64::INFINITY);
    for attempt in 0..=settings.restarts {
        if attempt > 0 {
            search.scatter(&mut q, &mut rng);
        }
        let miss = search.descend(&mut q);
        if search.is_met(&miss) {
            if accept(&q) {
                return IkOutcome::Solved(q);
            }
        } else if miss.position + LEVER * miss.angle < best.0 + LEVER * best.1 {
            best = (miss.position, miss.angle);
        }
    }
    if best.0.is_infinite() {
        best = (0.0, 0.0);
    }
    IkOutcome::NotFound { position_error: best.0, direction_error: best.1 }
}

/// Distinct configurations for a goal, the first from `start`, all that the settings' random starts find but no more than
/// `most`. An arm of six joints has up to sixteen; one of more joints has families of them, from which these are samples.
pub fn solutions(
    robot: &Robot,
    chain: &Chain,
    goal: &Goal,
    start: &[f64],
    settings: &IkSettings,
    most: usize,
) -> Vec<Vec<f64>> {
    let mut found: Vec<Vec<f64>> = Vec::new();
    if most > 0 {
        let _ = solve(robot, chain, goal, start, settings, |q| {
            let differs = |known: &Vec<f64>| known.iter().zip(q).any(|(a, b)| (a - b).abs() > DISTINCT);
            if found.iter().all(differs) {
                found.push(q.to_vec());
            }
            found.len() == most
        });
    }
    found
}

/// Moves a solution towards a posture as far as the goal allows: the part of the way there that does not move the tool, then back
/// onto the goal, until that brings no gain (the null-space projection of Liégeois 1977). `q` stays a solution within limits; the
/// sum of squared distances to the posture over the chain's joints is returned.
pub fn approach_posture(
    robot: &Robot,
    chain: &Chain,
    goal: &Goal,
    q: &mut Vec<f64>,
    posture: &[f64],
    settings: &IkSettings,
) -> f64 {
    let mut search = Search::new(robot, chain, goal, settings);
    let off = |q: &[f64]| chain.entries.iter().map(|&e| (q[e] - posture[e]) * (q[e] - posture[e])).sum::<f64>();
    let mut least = off(q);
    let mut share = 1.0;
    for _ in 0..POSTURE_STEPS {
        let mut trial = q.clone();
        search.step_in_null_space(&mut trial, posture, share);
        let miss = search.descend(&mut trial);
        let gained = off(&trial);
        if search.is_met(&miss) && gained < least {
            let slow = gained > 0.999 * least - 1e-12;
            (*q, least) = (trial, gained);
            if slow {
                break;
            }
        } else {
            share *= 0.5;
            if share < 1e-2 {
                break;
            }
        }
    }
    least
}

/// One search and its room to work in.
struct Search<'a> {
    robot: &'a Robot,
    chain: &'a Chain,
    target: Target,
    settings: &'a IkSettings,
    columns: Vec<JacobianColumn>,
    rows: Vec<Vector6<f64>>,
    trial: Vec<f64>,
}

impl<'a> Search<'a> {
    fn new(robot: &'a Robot, chain: &'a Chain, goal: &Goal, settings: &'a IkSettings) -> Self {
        let target = Target::new(goal);
        Self { robot, chain, target, settings, columns: Vec::new(), rows: Vec::new(), trial: Vec::new() }
    }

    fn is_met(&self, miss: &Miss) -> bool {
        miss.position <= self.settings.position_tolerance && miss.angle <= self.settings.direction_tolerance
    }

    /// Steps from `q` until the goal is met or nothing helps; what is still missing then.
    fn descend(&mut self, q: &mut Vec<f64>) -> Miss {
        let mut miss = self.linearise(q);
        let mut damping = 1e-3;
        let mut slow = 0;
        for _ in 0..self.settings.iterations {
            let IkSettings { position_tolerance, direction_tolerance, .. } = self.settings;
            if miss.position <= 0.1 * position_tolerance && miss.angle <= 0.1 * direction_tolerance {
                break;
            }
            self.step(&miss.rows, damping, q);
            let next = self.target.miss(&self.chain.tool_pose(&self.trial));
            let gain = next.rows.norm() / miss.rows.norm();
            if gain < 1.0 {
                std::mem::swap(q, &mut self.trial);
                miss = self.linearise(q);
                damping = (0.2 * damping).max(1e-12);
            } else {
                damping *= 10.0;
            }
            slow = if gain > 0.98 { slow + 1 } else { 0 };
            if slow > 8 || damping > 1e6 || damping.is_nan() {
                break;
            }
        }
        miss
    }

    fn linearise(&mut self, q: &[f64]) -> Miss {
        let pose = self.chain.linearise(q, &mut self.columns);
        self.rows.clear();
        self.rows.extend(self.columns.iter().map(|column| self.target.row(column)));
        self.target.miss(&pose)
    }

    /// J Jᵀ + λ I over the joints that are not held, factored.
    fn factor(&self, damping: f64, held: &[bool]) -> Option<Cholesky<f64, Const<6>>> {
        let mut normal = Matrix6::identity() * damping;
        for (row, _) in self.rows.iter().zip(held).filter(|(_, held)| !**held) {
            normal.ger(1.0, row, row, 1.0);
        }
        normal.cholesky()
    }

    /// dq = Jᵀ (J Jᵀ + λ I)⁻¹ e over the joints that are free to move, clamped to limits, into `trial`.
    fn step(&mut self, error: &Vector6<f64>, damping: f64, q: &[f64]) {
        let mut held = [false; crate::MAX_CHAIN_JOINTS];
        for _ in 0..=self.rows.len() {
            self.trial.clear();
            self.trial.extend_from_slice(q);
            let Some(factor) = self.factor(damping, &held) else { return };
            let pull = factor.solve(error);
            let wanted: PerJoint = std::array::from_fn(|i| match self.rows.get(i) {
                Some(row) if !held[i] => row.dot(&pull),
                _ => 0.0,
            });
            let scale = LARGEST_STEP / wanted.iter().fold(LARGEST_STEP, |largest, step| largest.max(step.abs()));
            let mut again = false;
            for (i, &entry) in self.chain.entries.iter().enumerate() {
                let limits = &self.robot.driven_joint(entry).limits;
                let to = q[entry] + wanted[i] * scale;
                self.trial[entry] = to.clamp(limits.lower, limits.upper);
                if !held[i] && self.trial[entry] == q[entry] && to != q[entry] {
                    held[i] = true;
                    again = true;
                }
            }
            if !again {
                return;
            }
        }
    }

    /// Adds (I − J⁺ J) share (posture − q), clamped to limits.
    fn step_in_null_space(&mut self, q: &mut [f64], posture: &[f64], share: f64) {
        self.linearise(q);
        let Some(factor) = self.factor(1e-9, &[false; crate::MAX_CHAIN_JOINTS]) else { return };
        let wish = |i: usize| share * (posture[self.chain.entries[i]] - q[self.chain.entries[i]]);
        let moved: Vector6<f64> = self.rows.iter().enumerate().map(|(i, row)| row * wish(i)).sum();
        let pull = factor.solve(&moved);
        let step: PerJoint = std::array::from_fn(|i| self.rows.get(i).map_or(0.0, |row| wish(i) - row.dot(&pull)));
        let scale = LARGEST_STEP / step.iter().fold(LARGEST_STEP, |largest, step| largest.max(step.abs()));
        for (i, &entry) in self.chain.entries.iter().enumerate() {
            let limits = &self.robot.driven_joint(entry).limits;
            q[entry] = (q[entry] + step[i] * scale).clamp(limits.lower, limits.upper);
        }
    }

    fn clamp(&self, q: &mut [f64]) {
        for &entry in &self.chain.entries {
            let limits = &self.robot.driven_joint(entry).limits;
            q[entry] = if q[entry].is_finite() { q[entry] } else { 0.0 }.clamp(limits.lower, limits.upper);
        }
    }

    /// Draws the chain's joints from their ranges; a joint without limits from one turn.
    fn scatter(&self, q: &mut [f64], rng: &mut ChaCha8Rng) {
        for &entry in &self.chain.entries {
            let (lower, upper) = sampling_range(self.robot, entry);
            q[entry] = lower + (upper - lower) * rng.random::<f64>();
        }
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
