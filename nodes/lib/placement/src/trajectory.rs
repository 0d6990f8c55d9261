//! When the arm is where: trapezoidal speed along each section of a path, from rest to rest.

use crate::MotionSettings;
use crate::manipulator::Manipulator;
use crate::motion::Motion;

/// Points of one section at most, corners not counted: a joint may be allowed to crawl for ever.
const MOST_SAMPLES: f64 = 1000.0;

/// A timed path of the joints that move the tool.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Trajectory {
    /// One per entry of every point.
    pub joint_names: Vec<String>,
    /// In order of time; straight in joint space between two of them.
    pub points: Vec<TrajectoryPoint>,
}

/// Where the joints are at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct TrajectoryPoint {
    /// Radians or metres.
    pub positions: Vec<f64>,
    /// Per second.
    pub velocities: Vec<f64>,
    /// Seconds since the start.
    pub time_from_start_s: f64,
}

/// Times a motion: the arm rests at every corner of the way over, then goes down in one.
pub(crate) fn time(manipulator: &Manipulator, motion: &Motion) -> Trajectory {
    let mut trajectory = Trajectory { joint_names: manipulator.joint_names(), points: Vec::new() };
    for edge in motion.over.windows(2) {
        add_section(manipulator, edge, &mut trajectory.points);
    }
    add_section(manipulator, &motion.down, &mut trajectory.points);
    trajectory
}

/// Speed along a section in units of "seconds at the joints' limits": every joint is within its limit at speed 1.
struct Profile {
    length: f64,
    speed: f64,
    acceleration: f64,
    /// Seconds of speeding up, and in all.
    ramp_s: f64,
    total_s: f64,
}

impl Profile {
    fn new(length: f64, settings: &MotionSettings) -> Self {
        let acceleration = settings.speed / settings.acceleration_s;
        // Too short to reach full speed: a triangle.
        let speed = settings.speed.min((length * acceleration).sqrt());
        let ramp_s = speed / acceleration;
        Self { length, speed, acceleration, ramp_s, total_s: ramp_s + length / speed }
    }

    /// Place and speed at a time.
    fn at(&self, t: f64) -> (f64, f64) {
        let left = self.total_s - t;
        if t < self.ramp_s {
            (0.5 * self.acceleration * t * t, self.acceleration * t)
        } else if left < self.ramp_s {
            (self.length - 0.5 * self.acceleration * left * left, self.acceleration * left)
        } else {
            (self.speed * (t - 0.5 * self.ramp_s), self.speed)
        }
    }

    /// The time at a place.
    fn when(&self, s: f64) -> f64 {
        let ramp = 0.5 * self.speed * self.ramp_s;
        if s < ramp {
            (2.0 * s / self.acceleration).sqrt()
        } else if self.length - s < ramp {
            self.total_s - (2.0 * (self.length - s).max(0.0) / self.acceleration).sqrt()
        } else {
            s / self.speed + 0.5 * self.ramp_s
        }
    }
}

/// Appends a polyline as one section from rest to rest. Its corners are points too, so that straight lines between points
/// stay on the path.
fn add_section(manipulator: &Manipulator, path: &[Vec<f64>], points: &mut Vec<TrajectoryPoint>) {
    let Manipulator { robot, chain, settings, .. } = manipulator;
    let limit = |entry: usize| robot.driven_joint(entry).limits.velocity.min(10.0);
    let slowest = |a: &[f64], b: &[f64]| {
        chain.entries.iter().map(|&entry| (b[entry] - a[entry]).abs() / limit(entry)).fold(0.0, f64::max)
    };
    let mut places = vec![0.0];
    for edge in path.windows(2) {
        places.push(places[places.len() - 1] + slowest(&edge[0], &edge[1]));
    }
    let length = places[places.len() - 1];
    if length <= 0.0 {
        return;
    }
    let profile = Profile::new(length, settings);
    let start_s = points.last().map_or(0.0, |point| point.time_from_start_s);
    let n = (profile.total_s / settings.sample_s).ceil().clamp(1.0, MOST_SAMPLES) as usize;
    let mut samples: Vec<(f64, f64)> = (0..=n)
        .map(|i| profile.total_s * i as f64 / n as f64)
        .map(|t| (t, profile.at(t).0))
        .chain(places.iter().map(|&s| (profile.when(s), s)))
        .collect();
    samples.sort_by(|a, b| a.0.total_cmp(&b.0));
    samples.dedup_by(|b, a| b.0 - a.0 < 1e-4);
    // The ends exactly.
    samples[0] = (0.0, 0.0);
    let last = samples.len() - 1;
    samples[last] = (profile.total_s, length);
    for (i, &(t, s)) in samples.iter().enumerate() {
        if i == 0 && !points.is_empty() {
            continue;
        }
        let edge = places.partition_point(|&place| place < s).clamp(1, path.len() - 1);
        let (from, to) = (&path[edge - 1], &path[edge]);
        let span = places[edge] - places[edge - 1];
        let share = if span > 0.0 { ((s - places[edge - 1]) / span).clamp(0.0, 1.0) } else { 1.0 };
        let speed = if i == 0 || i == last || span <= 0.0 { 0.0 } else { profile.at(t).1 / span };
        points.push(TrajectoryPoint {
            positions: chain.entries.iter().map(|&e| from[e] + (to[e] - from[e]) * share).collect(),
            velocities: chain.entries.iter().map(|&e| (to[e] - from[e]) * speed).collect(),
            time_from_start_s: start_s + t,
        });
    }
}

#[cfg(test)]
mod tests {
    use super::Profile;
    use crate::MotionSettings;
    use proptest::prelude::{prop_assert, proptest};

    proptest! {
        #[test]
        fn place_and_time_are_inverse_and_speed_is_their_slope(length in 0.001..5.0_f64, share in 0.0..1.0_f64) {
            let settings = MotionSettings::default();
            let profile = Profile::new(length, &settings);
            let t = share * profile.total_s;
            let (s, speed) = profile.at(t);
            prop_assert!((profile.when(s) - t).abs() < 1e-6);
            prop_assert!((0.0..=settings.speed).contains(&speed));
            let h = 1e-6;
            let slope = (profile.at(t + h).0 - profile.at(t - h).0) / (2.0 * h);
            prop_assert!((slope - speed).abs() < 1e-5, "{slope} {speed}");
        }
    }

    #[test]
    fn long_and_short_sections_take_the_textbook_time() {
        let settings = MotionSettings { speed: 0.5, acceleration_s: 0.4, ..MotionSettings::default() };
        // Speed 0.5 and acceleration 1.25: 2 at full speed take 4 s, and 0.4 s of ramps.
        assert!((Profile::new(2.0, &settings).total_s - 4.4).abs() < 1e-12);
        // 0.05 is less than the ramps need: a triangle of twice the root of 0.05 / 1.25.
        assert!((Profile::new(0.05, &settings).total_s - 0.4).abs() < 1e-12);
    }
}
