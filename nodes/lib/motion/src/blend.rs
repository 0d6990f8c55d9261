//! A path with its corners rounded, by length along it.
//!
//! At a corner C with unit directions e₁ before and e₂ after, the tangent turns as q′(s) = e₁ + (e₂ − e₁) h(s/L) with
//! h(u) = 3u² − 2u³. Then q leaves the first edge L/2 before C, meets the second L/2 after C, and has a continuous second
//! derivative (0 at both ends) and a bounded third: |q″| ≤ 3|e₂ − e₁|/2L, |q‴| ≤ 6|e₂ − e₁|/L². So at a steady speed the
//! joints' accelerations are continuous and their jerks bounded. It comes no nearer to C than 3L|e₂ − e₁|/32.

use crate::path::between;
use crate::{Limits, Metric, Path, Space};

/// Blends of two corners share an edge; each takes at most this share of it, and the rest is for changing speed.
const MOST_OF_EDGE: f64 = 0.4;
/// Chords along which a blend is checked.
const CHORDS: usize = 8;
/// A blend that is not free is halved this often before the motion stops at the corner instead.
const HALVINGS: usize = 6;

/// A straight edge between two blends.
#[derive(Debug, Clone)]
pub(crate) struct Straight {
    pub from: Vec<f64>,
    /// Change of each joint per unit of length.
    pub direction: Vec<f64>,
    pub length: f64,
}

/// A rounded corner; its length is 0 where the motion has to stop.
#[derive(Debug, Clone)]
pub(crate) struct Blend {
    from: Vec<f64>,
    before: Vec<f64>,
    after: Vec<f64>,
    pub length: f64,
    /// The fastest it may be gone along.
    pub speed: f64,
}

/// Where the path is at a length along a piece, with its first two derivatives by length.
#[derive(Debug, Clone, Default)]
pub(crate) struct Point {
    pub q: Vec<f64>,
    pub first: Vec<f64>,
    pub second: Vec<f64>,
}

/// `straights` one more than `blends`, in turn.
#[derive(Debug, Clone)]
pub(crate) struct Rounded {
    pub straights: Vec<Straight>,
    pub blends: Vec<Blend>,
}

impl Straight {
    pub fn at(&self, s: f64, point: &mut Point) {
        point.q = self.from.iter().zip(&self.direction).map(|(q, d)| q + d * s).collect();
        point.first.clone_from(&self.direction);
        point.second = vec![0.0; self.from.len()];
    }

    /// The largest x with x·|direction| within limits of every joint.
    pub fn most(&self, limits: &[f64]) -> f64 {
        let each = limits.iter().zip(&self.direction).map(|(limit, d)| limit / d.abs());
        each.fold(f64::INFINITY, f64::min)
    }
}

impl Blend {
    pub fn at(&self, s: f64, point: &mut Point) {
        let l = self.length;
        let u = s / l;
        // ∫h = u³ − u⁴/2.
        let (turned, h, slope) = (u * u * u * (1.0 - 0.5 * u), u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u));
        let axes = || self.before.iter().zip(&self.after);
        point.q = self.from.iter().zip(axes()).map(|(q, (b, a))| q + l * (u * b + turned * (a - b))).collect();
        point.first = axes().map(|(b, a)| b + (a - b) * h).collect();
        point.second = axes().map(|(b, a)| (a - b) * slope / l).collect();
    }

    /// The fastest that a blend of a length may be gone along at steady speed.
    fn most_speed(before: &[f64], after: &[f64], length: f64, limits: &Limits) -> f64 {
        let mut most = f64::INFINITY;
        for (i, (b, a)) in before.iter().zip(after).enumerate() {
            let turn = (a - b).abs();
            most = most.min(limits.velocity()[i] / b.abs().max(a.abs()));
            most = most.min((limits.acceleration()[i] * length / (1.5 * turn)).sqrt());
            most = most.min((limits.jerk()[i] * length * length / (6.0 * turn)).cbrt());
        }
        most
    }

    /// The shortest length that lets every joint keep the speed its velocity limits allow.
    fn length_of_full_speed(before: &[f64], after: &[f64], limits: &Limits) -> f64 {
        let axes = || before.iter().zip(after).enumerate();
        let speed = axes().map(|(i, (b, a))| limits.velocity()[i] / b.abs().max(a.abs())).fold(f64::INFINITY, f64::min);
        axes()
            .map(|(i, (b, a))| {
                let turn = (a - b).abs();
                let of_acceleration = 1.5 * turn * speed * speed / limits.acceleration()[i];
                let of_jerk = (6.0 * turn * speed.powi(3) / limits.jerk()[i]).sqrt();
                of_acceleration.max(of_jerk)
            })
            .fold(0.0, f64::max)
    }

    fn is_free(&self, space: &mut impl Space) -> bool {
        let mut point = Point::default();
        let mut last = self.from.clone();
        (1..=CHORDS).all(|i| {
            self.at(self.length * i as f64 / CHORDS as f64, &mut point);
            let free = space.edge_is_free(&last, &point.q);
            last.clone_from(&point.q);
            free
        })
    }
}

/// Rounds the corners of a path as far as it stays free. Corners that repeat are dropped; `None` when nothing is left to
/// move along.
pub(crate) fn round(space: &mut impl Space, path: &Path, limits: &Limits) -> Option<Rounded> {
    let metric = Metric::of_limits(limits);
    let mut corners: Vec<&Vec<f64>> = Vec::new();
    for corner in path.corners() {
        if corners.last().is_none_or(|last| metric.distance(last, corner) > 0.0) {
            corners.push(corner);
        }
    }
    let lengths: Vec<f64> = corners.windows(2).map(|edge| metric.distance(edge[0], edge[1])).collect();
    if lengths.is_empty() {
        return None;
    }
    let directions: Vec<Vec<f64>> = corners
        .windows(2)
        .zip(&lengths)
        .map(|(edge, length)| edge[0].iter().zip(edge[1]).map(|(a, b)| (b - a) / length).collect())
        .collect();
    let mut blends = Vec::new();
    for i in 1..corners.len() - 1 {
        let (before, after) = (&directions[i - 1], &directions[i]);
        let room = 2.0 * MOST_OF_EDGE * lengths[i - 1].min(lengths[i]);
        let mut length = room.min(Blend::length_of_full_speed(before, after, limits));
        let mut found = None;
        for _ in 0..HALVINGS {
            let back = 0.5 * length / lengths[i - 1];
            let blend = Blend {
                from: between(corners[i], corners[i - 1], back),
                before: before.clone(),
                after: after.clone(),
                length,
                speed: Blend::most_speed(before, after, length, limits),
            };
            // Two edges in one line need no rounding: any speed keeps the accelerations.
            if length == 0.0 || blend.is_free(space) {
                found = Some(blend);
                break;
            }
            length *= 0.5;
        }
        blends.push(found.unwrap_or_else(|| Blend {
            from: corners[i].clone(),
            before: before.clone(),
            after: after.clone(),
            length: 0.0,
            speed: 0.0,
        }));
    }
    let straights = (0..lengths.len())
        .map(|i| {
            let start = if i == 0 { 0.0 } else { 0.5 * blends[i - 1].length };
            let end = blends.get(i).map_or(0.0, |blend| 0.5 * blend.length);
            Straight {
                from: between(corners[i], corners[i + 1], start / lengths[i]),
                direction: directions[i].clone(),
                length: lengths[i] - start - end,
            }
        })
        .collect();
    Some(Rounded { straights, blends })
}
