//! Shorter ways along a path that is free already.

use crate::path::between;
use crate::{Metric, Path, Space};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A shortcut that saves less than this share of what it replaces only adds corners.
const LEAST_SAVING: f64 = 0.01;

/// Shortens a path: first straight edges between its corners, then `rounds` shortcuts between two points drawn anywhere
/// along it. The ends stay; what it returns is free and never longer.
pub fn shorten(space: &mut impl Space, metric: &Metric, path: &Path, rounds: usize, seed: u64) -> Path {
    let mut corners = skip_corners(space, path.corners());
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    for _ in 0..rounds {
        if corners.len() < 3 {
            break;
        }
        let lengths = lengths(metric, &corners);
        let total = lengths[lengths.len() - 1];
        let (one, other): (f64, f64) = (rng.random(), rng.random());
        let (from, to) = (one.min(other) * total, one.max(other) * total);
        let (first, a) = at(&lengths, &corners, from);
        let (last, b) = at(&lengths, &corners, to);
        if first == last || metric.distance(&a, &b) > (1.0 - LEAST_SAVING) * (to - from) {
            continue;
        }
        if space.edge_is_free(&a, &b) {
            let mut shorter = corners[..=first].to_vec();
            push_apart(&mut shorter, a);
            push_apart(&mut shorter, b);
            for corner in corners.drain(last + 1..) {
                push_apart(&mut shorter, corner);
            }
            corners = shorter;
        }
    }
    // Points drawn along it may have left corners that are none.
    let corners = skip_corners(space, &corners);
    let mut shorter = path.clone();
    shorter.replace(corners);
    shorter
}

/// From each corner straight to the last one that can be reached so.
fn skip_corners(space: &mut impl Space, corners: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut kept = vec![corners[0].clone()];
    let mut i = 0;
    while i + 1 < corners.len() {
        let next = (i + 2..corners.len()).rev().find(|&j| space.edge_is_free(&corners[i], &corners[j]));
        i = next.unwrap_or(i + 1);
        kept.push(corners[i].clone());
    }
    kept
}

/// How far along the path each corner is.
fn lengths(metric: &Metric, corners: &[Vec<f64>]) -> Vec<f64> {
    let mut lengths = vec![0.0];
    for edge in corners.windows(2) {
        lengths.push(lengths[lengths.len() - 1] + metric.distance(&edge[0], &edge[1]));
    }
    lengths
}

/// The edge (by its first corner) and the point that are a length along the path.
fn at(lengths: &[f64], corners: &[Vec<f64>], along: f64) -> (usize, Vec<f64>) {
    let edge = lengths.partition_point(|&l| l <= along).clamp(1, corners.len() - 1) - 1;
    let span = lengths[edge + 1] - lengths[edge];
    let share = if span > 0.0 { ((along - lengths[edge]) / span).clamp(0.0, 1.0) } else { 0.0 };
    (edge, between(&corners[edge], &corners[edge + 1], share))
}

fn push_apart(corners: &mut Vec<Vec<f64>>, corner: Vec<f64>) {
    if corners.last() != Some(&corner) {
        corners.push(corner);
    }
}
