//! The joints of an arm as a planner of motions sees them, with the checks counted and an end to the time.

use std::collections::VecDeque;

use arm::{Checker, SweepSettings, World};
use motion::Space;

use crate::clock::cpu_seconds;

/// How an edge is checked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Edges {
    /// Proven free from end to end.
    Proven,
    /// Looked at in states at most this far apart, radians along all joints, as OMPL does.
    Stepped(f64),
}

/// Some joints of a robot among things; the other joints stay where they are.
pub(crate) struct JointSpace<'a> {
    pub checker: Checker,
    pub world: &'a World,
    /// Which entries of a configuration are planned.
    pub entries: &'a [usize],
    pub lower: Vec<f64>,
    pub upper: Vec<f64>,
    pub edges: Edges,
    /// Obstacles nearer than this count as touched, metres.
    pub margin: f64,
    /// CPU seconds of the process after which nothing is checked any more.
    pub until: f64,
    /// The whole robot at both ends of an edge.
    from: Vec<f64>,
    to: Vec<f64>,
    /// States looked at one by one, and edges.
    pub n_states: u64,
    pub n_edges: u64,
}

impl<'a> JointSpace<'a> {
    /// The joints `entries` of the checker's robot, the others as in `q`; no end to the time.
    pub fn new(checker: Checker, world: &'a World, entries: &'a [usize], q: &[f64], edges: Edges, margin: f64) -> Self {
        let limits = |entry: &usize| checker.robot().driven_joint(*entry).limits;
        Self {
            lower: entries.iter().map(|entry| limits(entry).lower).collect(),
            upper: entries.iter().map(|entry| limits(entry).upper).collect(),
            checker,
            world,
            entries,
            edges,
            margin,
            until: f64::INFINITY,
            from: q.to_vec(),
            to: q.to_vec(),
            n_states: 0,
            n_edges: 0,
        }
    }

    /// Whether the time is over. From then on everything counts as free, so that a search ends at once; its result is
    /// not to be used.
    pub fn is_late(&self) -> bool {
        cpu_seconds() > self.until
    }

    fn set(&mut self, a: &[f64], b: &[f64]) {
        for (i, &entry) in self.entries.iter().enumerate() {
            self.from[entry] = a[i];
            self.to[entry] = b[i];
        }
    }

    /// The far end first, then the middle of what is not looked at yet, the widest first.
    fn steps_are_free(&mut self, a: &[f64], b: &[f64], step: f64) -> bool {
        if !self.is_free(b) {
            return false;
        }
        let n = (length(a, b) / step).ceil() as usize;
        let mut open = VecDeque::from([(1, n)]);
        while let Some((first, end)) = open.pop_front() {
            if first >= end {
                continue;
            }
            let middle = first + (end - first) / 2;
            if !self.is_free(&between(a, b, middle as f64 / n as f64)) {
                return false;
            }
            open.extend([(first, middle), (middle + 1, end)]);
        }
        true
    }
}

impl Space for JointSpace<'_> {
    fn lower(&self) -> &[f64] {
        &self.lower
    }

    fn upper(&self) -> &[f64] {
        &self.upper
    }

    fn is_free(&mut self, q: &[f64]) -> bool {
        self.n_states += 1;
        self.set(q, q);
        self.checker.is_free(&self.from, self.world, self.margin)
    }

    fn edge_is_free(&mut self, a: &[f64], b: &[f64]) -> bool {
        if self.is_late() {
            return true;
        }
        self.n_edges += 1;
        match self.edges {
            Edges::Stepped(step) => self.steps_are_free(a, b, step),
            Edges::Proven => {
                self.set(a, b);
                let sweep = SweepSettings { margin: self.margin, ..SweepSettings::default() };
                self.checker.way_is_free(&self.from, &self.to, self.world, &sweep)
            }
        }
    }
}

/// Radians along all joints.
pub(crate) fn length(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// A share of the way.
pub(crate) fn between(a: &[f64], b: &[f64], share: f64) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + (b - a) * share).collect()
}

#[cfg(test)]
mod tests {
    use super::{Edges, JointSpace};
    use arm::{Checker, CollisionModel, Exclusions, Robot, World};
    use motion::Space;
    use std::sync::Arc;

    #[test]
    fn steps_are_as_many_as_the_length_asks_for_and_none_after_the_end_of_the_time() {
        let robot = Robot::from_urdf(include_str!("../../../config/urdf/table_arm_7.urdf")).expect("a robot");
        let model = CollisionModel::new(&robot, &Exclusions::derived(&robot, 1));
        let (world, q, entries) = (World::new(), robot.rest(), [0]);
        let checker = Checker::new(Arc::new(robot), Arc::new(model));
        let mut space = JointSpace::new(checker, &world, &entries, &q, Edges::Stepped(0.1), 0.0);
        assert!(space.edge_is_free(&[0.0], &[0.95]));
        // Nine inside and the far end.
        assert_eq!((space.n_states, space.n_edges), (10, 1));
        space.until = 0.0;
        assert!(space.is_late() && space.edge_is_free(&[0.0], &[0.95]));
        assert_eq!((space.n_states, space.n_edges), (10, 1));
    }
}
