//! The joints that move the tool, as the planner of motions sees them: the other joints stay where they are.

use crate::manipulator::Cell;
use arm::{Checker, SweepSettings};
use motion::Space;

/// An endless joint may turn this far either way from where it is, radians.
const TURN: f64 = std::f64::consts::PI;
/// No joint counts as faster than this, radians or metres per second: descriptions often say 1e9 where they mean "any".
const FASTEST: f64 = 10.0;

pub(crate) struct ArmSpace<'a> {
    cell: &'a Cell<'a>,
    checker: Checker,
    sweep: SweepSettings,
    lower: Vec<f64>,
    upper: Vec<f64>,
    /// Configurations of the whole robot, the ends of an edge.
    from: Vec<f64>,
    to: Vec<f64>,
}

impl<'a> ArmSpace<'a> {
    /// The joints of the chain about where the arm is; things nearer than the settings' margin count as touching.
    pub fn new(cell: &'a Cell<'a>, current: &[f64]) -> Self {
        let manipulator = cell.manipulator;
        let limits = |entry: usize| manipulator.robot.driven_joint(entry).limits;
        let entries = &manipulator.chain.entries;
        let end = |value: f64, else_: f64| if value.is_finite() { value } else { else_ };
        Self {
            checker: manipulator.checker(),
            sweep: SweepSettings { margin: manipulator.settings.margin_m, ..SweepSettings::default() },
            lower: entries.iter().map(|&e| end(limits(e).lower, current[e] - TURN)).collect(),
            upper: entries.iter().map(|&e| end(limits(e).upper, current[e] + TURN)).collect(),
            from: current.to_vec(),
            to: current.to_vec(),
            cell,
        }
    }

    /// Arm, surroundings and what is held.
    pub fn cell(&self) -> &'a Cell<'a> {
        self.cell
    }

    /// The chain's part of a configuration.
    pub fn part(&self, q: &[f64]) -> Vec<f64> {
        self.cell.manipulator.chain.entries.iter().map(|&entry| q[entry]).collect()
    }

    /// How fast the joints may go: the settings' share of their velocity limits.
    pub fn velocities(&self) -> Vec<f64> {
        let manipulator = self.cell.manipulator;
        let limit = |entry: usize| manipulator.robot.driven_joint(entry).limits.velocity.min(FASTEST);
        manipulator.chain.entries.iter().map(|&entry| manipulator.settings.speed * limit(entry)).collect()
    }

    /// Where the tool is.
    pub fn tool(&mut self, part: &[f64]) -> arm::Isometry3<f64> {
        self.set(part, part);
        self.cell.chain.tool_pose(&self.from)
    }

    /// Whether nothing touches on a straight edge; without a margin, as a last check of what was planned with one.
    pub fn edge_touches_nothing(&mut self, a: &[f64], b: &[f64]) -> bool {
        self.set(a, b);
        let bare = SweepSettings { margin: 0.0, ..self.sweep };
        self.checker.way_is_free(&self.from, &self.to, &self.cell.world, &bare)
    }

    fn set(&mut self, a: &[f64], b: &[f64]) {
        for (i, &entry) in self.cell.manipulator.chain.entries.iter().enumerate() {
            self.from[entry] = a[i];
            self.to[entry] = b[i];
        }
    }

    fn is_within_limits(&self, q: &[f64]) -> bool {
        q.iter().zip(&self.lower).zip(&self.upper).all(|((q, lower), upper)| lower <= q && q <= upper)
    }
}

impl Space for ArmSpace<'_> {
    fn lower(&self) -> &[f64] {
        &self.lower
    }

    fn upper(&self) -> &[f64] {
        &self.upper
    }

    fn is_free(&mut self, q: &[f64]) -> bool {
        self.set(q, q);
        self.is_within_limits(q) && self.cell.is_free(&self.from, &mut self.checker)
    }

    fn edge_is_free(&mut self, a: &[f64], b: &[f64]) -> bool {
        if !(self.is_within_limits(a) && self.is_within_limits(b)) {
            return false;
        }
        self.set(a, b);
        self.checker.way_is_free(&self.from, &self.to, &self.cell.world, &self.sweep)
    }
}
