//! A way around obstacles: RRT-Connect (Kuffner and LaValle 2000) with a seeded generator and any number of goals.

use crate::path::between;
use crate::{Metric, Path, Space};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use thiserror::Error;

/// How long to search.
#[derive(Debug, Clone, PartialEq)]
pub struct Search {
    /// Samples after which the search ends.
    pub samples: usize,
    /// How far a tree grows at once, in the metric.
    pub step: f64,
    /// Of the samples.
    pub seed: u64,
}

impl Default for Search {
    fn default() -> Self {
        Self { samples: 5000, step: 0.2, seed: 1 }
    }
}

/// Why no way was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum NoPath {
    /// Something touches at the start.
    #[error("the start is not free")]
    StartBlocked,
    /// No goal was given, or something touches at all of them.
    #[error("none of the {goals} goals is free")]
    GoalsBlocked {
        /// How many there were.
        goals: usize,
    },
    /// The trees did not meet.
    #[error("no way was found in {samples} samples")]
    NotFound {
        /// How many were drawn.
        samples: usize,
    },
}

/// Configurations in one allocation, each with the node it grew from.
struct Tree {
    n_joints: usize,
    nodes: Vec<f64>,
    parents: Vec<usize>,
    roots: usize,
}

impl Tree {
    fn new<'a>(n_joints: usize, roots: impl Iterator<Item = &'a [f64]>) -> Self {
        let mut tree = Self { n_joints, nodes: Vec::new(), parents: Vec::new(), roots: 0 };
        for root in roots {
            tree.push(root, tree.roots);
            tree.roots += 1;
        }
        tree
    }

    fn at(&self, node: usize) -> &[f64] {
        &self.nodes[node * self.n_joints..(node + 1) * self.n_joints]
    }

    fn push(&mut self, q: &[f64], parent: usize) -> usize {
        self.nodes.extend_from_slice(q);
        self.parents.push(parent);
        self.parents.len() - 1
    }

    /// The node nearest to a configuration, the first of equals.
    fn nearest(&self, metric: &Metric, to: &[f64]) -> usize {
        let mut best = (f64::INFINITY, 0);
        for (i, q) in self.nodes.chunks_exact(self.n_joints).enumerate() {
            let squared = metric.squared(q, to);
            if squared < best.0 {
                best = (squared, i);
            }
        }
        best.1
    }

    /// From the root to a node.
    fn path_to(&self, mut node: usize) -> Vec<Vec<f64>> {
        let mut path = vec![self.at(node).to_vec()];
        while node >= self.roots {
            node = self.parents[node];
            path.push(self.at(node).to_vec());
        }
        path.reverse();
        path
    }

    /// Grows one step towards a configuration; the new node and whether that is the configuration itself.
    fn extend(&mut self, space: &mut impl Space, metric: &Metric, to: &[f64], step: f64) -> Option<(usize, bool)> {
        let nearest = self.nearest(metric, to);
        let from = self.at(nearest);
        let distance = metric.distance(from, to);
        if distance == 0.0 {
            return None;
        }
        let there = distance <= step;
        let next = if there { to.to_vec() } else { between(from, to, step / distance) };
        space.edge_is_free(from, &next).then(|| (self.push(&next, nearest), there))
    }
}

/// Corners from `start` to one of `goals` joined by free straight edges. A straight edge to a goal is taken before any
/// search, the shortest such edge first.
///
/// # Errors
/// Ends that are not free; no way within the number of samples. All configurations must have the space's number of joints.
///
/// # Panics
/// When they do not.
pub fn connect(
    space: &mut impl Space,
    metric: &Metric,
    start: &[f64],
    goals: &[Vec<f64>],
    search: &Search,
) -> Result<Path, NoPath> {
    let n_joints = space.lower().len();
    assert!(start.len() == n_joints && goals.iter().all(|goal| goal.len() == n_joints), "one position per joint");
    if !space.is_free(start) {
        return Err(NoPath::StartBlocked);
    }
    let mut free: Vec<&Vec<f64>> = goals.iter().filter(|goal| space.is_free(goal)).collect();
    if free.is_empty() {
        return Err(NoPath::GoalsBlocked { goals: goals.len() });
    }
    free.sort_by(|a, b| metric.squared(start, a).total_cmp(&metric.squared(start, b)));
    let path = |corners| Ok(Path::new(corners).expect("it has corners of one length"));
    for &goal in &free {
        if space.edge_is_free(start, goal) {
            return path(vec![start.to_vec(), goal.clone()]);
        }
    }
    let mut rng = ChaCha8Rng::seed_from_u64(search.seed);
    let mut from_start = Tree::new(n_joints, std::iter::once(start));
    let mut from_goals = Tree::new(n_joints, free.iter().map(|goal| goal.as_slice()));
    for sample in 0..search.samples {
        let to: Vec<f64> = (0..n_joints)
            .map(|i| space.lower()[i] + (space.upper()[i] - space.lower()[i]) * rng.random::<f64>())
            .collect();
        let forwards = sample % 2 == 0;
        let (grown, other) =
            if forwards { (&mut from_start, &mut from_goals) } else { (&mut from_goals, &mut from_start) };
        let Some((new, _)) = grown.extend(space, metric, &to, search.step) else { continue };
        let target = grown.at(new).to_vec();
        while let Some((next, there)) = other.extend(space, metric, &target, search.step) {
            if there {
                let (mut corners, mut rest) = (grown.path_to(new), other.path_to(next));
                rest.reverse();
                corners.extend(rest.into_iter().skip(1));
                if !forwards {
                    corners.reverse();
                }
                return path(corners);
            }
        }
    }
    Err(NoPath::NotFound { samples: search.samples })
}
