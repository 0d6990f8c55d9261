//! A way around obstacles in joint space: RRT-Connect (Kuffner and LaValle 2000) with a seeded generator, then shortcuts.

use crate::manipulator::Manipulator;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// How far a tree grows at once, in the largest change of a joint, radians or metres.
const STEP: f64 = 0.35;
const SHORTCUTS: usize = 60;

struct Tree {
    nodes: Vec<(Vec<f64>, usize)>,
}

impl Tree {
    fn nearest(&self, to: &[f64]) -> usize {
        let squared = |q: &[f64]| q.iter().zip(to).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
        let mut best = (f64::INFINITY, 0);
        for (i, (q, _)) in self.nodes.iter().enumerate() {
            let d = squared(q);
            if d < best.0 {
                best = (d, i);
            }
        }
        best.1
    }

    /// From the root to a node.
    fn path_to(&self, mut node: usize) -> Vec<Vec<f64>> {
        let mut path = vec![self.nodes[node].0.clone()];
        while node != 0 {
            node = self.nodes[node].1;
            path.push(self.nodes[node].0.clone());
        }
        path.reverse();
        path
    }
}

/// Corner configurations from `start` to `goal`, both included, joined by free straight edges; `None` when none was found
/// in the settings' number of samples. Only joints of the chain move.
pub(crate) fn connect(
    manipulator: &Manipulator,
    start: &[f64],
    goal: &[f64],
    edge_is_free: &mut impl FnMut(&[f64], &[f64]) -> bool,
) -> Option<Vec<Vec<f64>>> {
    if edge_is_free(start, goal) {
        return Some(vec![start.to_vec(), goal.to_vec()]);
    }
    let mut rng = ChaCha8Rng::seed_from_u64(manipulator.settings.seed);
    let mut from_start = Tree { nodes: vec![(start.to_vec(), 0)] };
    let mut from_goal = Tree { nodes: vec![(goal.to_vec(), 0)] };
    for sample in 0..manipulator.settings.samples {
        let to = draw(manipulator, start, &mut rng);
        let forwards = sample % 2 == 0;
        let (grown, other) =
            if forwards { (&mut from_start, &mut from_goal) } else { (&mut from_goal, &mut from_start) };
        let Some(new) = extend(grown, &to, edge_is_free) else { continue };
        let target = grown.nodes[new].0.clone();
        while let Some(next) = extend(other, &target, edge_is_free) {
            if other.nodes[next].0 == target {
                let (mut path, mut rest) = (grown.path_to(new), other.path_to(next));
                rest.reverse();
                path.extend(rest.into_iter().skip(1));
                if !forwards {
                    path.reverse();
                }
                shorten(&mut path, &mut rng, edge_is_free);
                return Some(path);
            }
        }
    }
    None
}

/// Grows a tree one step towards a configuration; the new node.
fn extend(tree: &mut Tree, to: &[f64], edge_is_free: &mut impl FnMut(&[f64], &[f64]) -> bool) -> Option<usize> {
    let nearest = tree.nearest(to);
    let from = &tree.nodes[nearest].0;
    let largest = from.iter().zip(to).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    if largest == 0.0 {
        return None;
    }
    let next: Vec<f64> = if largest <= STEP {
        to.to_vec()
    } else {
        from.iter().zip(to).map(|(a, b)| a + (b - a) * (STEP / largest)).collect()
    };
    if !edge_is_free(from, &next) {
        return None;
    }
    tree.nodes.push((next, nearest));
    Some(tree.nodes.len() - 1)
}

/// A configuration with the chain's joints drawn from their ranges; an endless joint from the turn around its start.
fn draw(manipulator: &Manipulator, start: &[f64], rng: &mut ChaCha8Rng) -> Vec<f64> {
    let mut q = start.to_vec();
    for &entry in &manipulator.chain.entries {
        let limits = &manipulator.robot.driven_joint(entry).limits;
        let pi = std::f64::consts::PI;
        let lower = if limits.lower.is_finite() { limits.lower } else { start[entry] - pi };
        let upper = if limits.upper.is_finite() { limits.upper } else { start[entry] + pi };
        q[entry] = lower + (upper - lower) * rng.random::<f64>();
    }
    q
}

/// Replaces corners by straight edges where those are free.
fn shorten(path: &mut Vec<Vec<f64>>, rng: &mut ChaCha8Rng, edge_is_free: &mut impl FnMut(&[f64], &[f64]) -> bool) {
    for _ in 0..SHORTCUTS {
        if path.len() < 3 {
            break;
        }
        let i = rng.random_range(0..path.len() - 2);
        let j = rng.random_range(i + 2..path.len());
        if edge_is_free(&path[i], &path[j]) {
            path.drain(i + 1..j);
        }
    }
}
