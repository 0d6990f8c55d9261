//! A timed motion along a path.

use crate::blend::{Point, round};
use crate::speed::{Along, Profile, State, blend_speeds};
use crate::{Limits, Path, Space, Trajectory, TrajectoryPoint};
use thiserror::Error;

/// More points than this are not written, however slow a joint: the time between them grows instead.
const MOST_POINTS: f64 = 20_000.0;

/// Why a path cannot be timed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TimingError {
    /// The limits are for another mechanism.
    #[error("limits for {limits} joints, but a path of {path}")]
    Joints {
        /// Joints with limits.
        limits: usize,
        /// Joints of the path.
        path: usize,
    },
    /// The time between points is no time.
    #[error("{0} s between points; a positive, finite time is needed")]
    Sample(f64),
    /// The speed along one straight could not be found; this should not happen.
    #[error("no motion along a straight of {length} s from speed {from} to {to}: {reason}")]
    Profile {
        /// Its length in seconds at full speed.
        length: f64,
        /// Speed at its start.
        from: f64,
        /// Speed at its end.
        to: f64,
        /// What was wrong.
        reason: String,
    },
}

/// Moves along a path from rest to rest within the limits of every joint. Corners are rounded where the space is free, and
/// the motion stops at those where it is not. There is a point every `sample_s` seconds at most; positions, velocities and
/// accelerations of the points are exact.
///
/// # Errors
/// Limits for another number of joints; a time between points that is not positive.
pub fn time(space: &mut impl Space, path: &Path, limits: &Limits, sample_s: f64) -> Result<Trajectory, TimingError> {
    let n_joints = path.start().len();
    if limits.n_joints() != n_joints {
        return Err(TimingError::Joints { limits: limits.n_joints(), path: n_joints });
    }
    if !(sample_s.is_finite() && sample_s > 0.0) {
        return Err(TimingError::Sample(sample_s));
    }
    let rest = |q: &[f64], time_from_start_s| TrajectoryPoint {
        positions: q.to_vec(),
        velocities: vec![0.0; n_joints],
        accelerations: vec![0.0; n_joints],
        time_from_start_s,
    };
    let Some(rounded) = round(space, path, limits) else {
        return Ok(Trajectory { points: vec![rest(path.start(), 0.0)] });
    };
    let along: Vec<Along> = rounded
        .straights
        .iter()
        .map(|straight| Along {
            velocity: straight.most(limits.velocity()),
            acceleration: straight.most(limits.acceleration()),
            jerk: straight.most(limits.jerk()),
        })
        .collect();
    let speeds = blend_speeds(&rounded, &along);
    let speed = |i: usize| if i == 0 || i > speeds.len() { 0.0 } else { speeds[i - 1] };
    let profiles = rounded
        .straights
        .iter()
        .enumerate()
        .map(|(i, straight)| Profile::new(straight.length, speed(i), speed(i + 1), along[i]))
        .collect::<Result<Vec<_>, _>>()?;
    let blend_s = |i: usize| if speeds[i] > 0.0 { rounded.blends[i].length / speeds[i] } else { 0.0 };
    let total_s: f64 = profiles.iter().map(Profile::seconds).sum::<f64>() + (0..speeds.len()).map(blend_s).sum::<f64>();
    let n = (total_s / sample_s).ceil().clamp(1.0, MOST_POINTS) as usize;
    let mut points = vec![rest(path.start(), 0.0)];
    let (mut piece, mut piece_start_s) = (0, 0.0);
    let seconds_of =
        |piece: usize| if piece.is_multiple_of(2) { profiles[piece / 2].seconds() } else { blend_s(piece / 2) };
    let mut point = Point::default();
    for i in 1..n {
        let t = total_s * i as f64 / n as f64;
        // Straights and blends in turn.
        while piece + 1 < 2 * profiles.len() - 1 && t > piece_start_s + seconds_of(piece) {
            piece_start_s += seconds_of(piece);
            piece += 1;
        }
        let since_s = t - piece_start_s;
        let state = if piece.is_multiple_of(2) {
            let state = profiles[piece / 2].at(since_s);
            rounded.straights[piece / 2].at(state.s, &mut point);
            state
        } else {
            let (blend, speed) = (&rounded.blends[piece / 2], speeds[piece / 2]);
            let state = State { s: (speed * since_s).min(blend.length), speed, acceleration: 0.0 };
            blend.at(state.s, &mut point);
            state
        };
        points.push(TrajectoryPoint {
            positions: point.q.clone(),
            velocities: point.first.iter().map(|first| first * state.speed).collect(),
            accelerations: point
                .first
                .iter()
                .zip(&point.second)
                .map(|(first, second)| second * state.speed * state.speed + first * state.acceleration)
                .collect(),
            time_from_start_s: t,
        });
    }
    points.push(rest(path.end(), total_s));
    Ok(Trajectory { points })
}
