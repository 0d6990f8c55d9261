//! How fast to go along a path of straights and blends: along a blend at one speed, along a straight from one speed to the
//! next with limited velocity, acceleration and jerk, as quickly as can be (Berscheid and Kröger 2021, by `rsruckig`).

use crate::TimingError;
use crate::blend::Rounded;
use rsruckig::prelude::{DataArrayOrVec, InputParameter, Ruckig, ThrowErrorHandler, Trajectory};

/// Limits along a straight, by its length.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Along {
    pub velocity: f64,
    pub acceleration: f64,
    pub jerk: f64,
}

/// Where a motion along one straight is at a time.
#[derive(Debug, Clone, Copy)]
pub(crate) struct State {
    pub s: f64,
    pub speed: f64,
    pub acceleration: f64,
}

/// A straight's motion, from one speed to another.
pub(crate) struct Profile {
    trajectory: Trajectory<1>,
    length: f64,
}

/// Speeds differ from what can just be reached by this share: rounding must not decide whether a motion exists.
const SLACK: f64 = 1e-6;

impl Along {
    /// The shortest length in which the speed can change, accelerating from rest of acceleration to rest of acceleration.
    fn length_of_change(&self, from: f64, to: f64) -> f64 {
        let change = (to - from).abs();
        // An S-curve is symmetric, so its mean speed is the mean of its ends.
        let seconds = if change * self.jerk < self.acceleration * self.acceleration {
            2.0 * (change / self.jerk).sqrt()
        } else {
            change / self.acceleration + self.acceleration / self.jerk
        };
        0.5 * (from + to) * seconds
    }

    /// The fastest speed up to `most` that can be reached from another within a length (or from which it can be).
    fn reach(&self, from: f64, most: f64, length: f64) -> f64 {
        if most <= from || self.length_of_change(from, most) <= length {
            return most;
        }
        let (mut low, mut high) = (from, most);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.length_of_change(from, middle) <= length {
                low = middle;
            } else {
                high = middle;
            }
        }
        from + (low - from) * (1.0 - SLACK)
    }
}

/// The speed along every blend, such that each can be reached from the last, and rest at the end.
pub(crate) fn blend_speeds(rounded: &Rounded, along: &[Along]) -> Vec<f64> {
    let n = rounded.blends.len();
    let mut speeds: Vec<f64> = rounded.blends.iter().map(|blend| blend.speed).collect();
    let mut last = 0.0;
    for i in 0..n {
        let most = speeds[i].min(along[i].velocity).min(along[i + 1].velocity);
        last = along[i].reach(last, most, rounded.straights[i].length).min(most);
        speeds[i] = last;
    }
    let mut next = 0.0;
    for i in (0..n).rev() {
        next = along[i + 1].reach(next, speeds[i], rounded.straights[i + 1].length).min(speeds[i]);
        speeds[i] = next;
    }
    speeds
}

impl Profile {
    /// The quickest motion along a straight of `length` that starts and ends at the given speeds.
    pub fn new(length: f64, from: f64, to: f64, along: Along) -> Result<Self, TimingError> {
        let one = |x: f64| DataArrayOrVec::Stack([x]);
        let mut input = InputParameter::<1>::new(None);
        input.current_velocity = one(from);
        input.target_position = one(length);
        input.target_velocity = one(to);
        input.max_velocity = one(along.velocity);
        input.max_acceleration = one(along.acceleration);
        input.max_jerk = one(along.jerk);
        let mut trajectory = Trajectory::new(None);
        Ruckig::<1, ThrowErrorHandler>::new(None, 1.0)
            .calculate(&input, &mut trajectory)
            .map_err(|error| TimingError::Profile { length, from, to, reason: error.to_string() })?;
        Ok(Self { trajectory, length })
    }

    pub fn seconds(&self) -> f64 {
        self.trajectory.get_duration()
    }

    pub fn at(&self, seconds: f64) -> State {
        let (mut s, mut v, mut a) =
            (DataArrayOrVec::Stack([0.0]), DataArrayOrVec::Stack([0.0]), DataArrayOrVec::Stack([0.0]));
        self.trajectory.at_time(seconds, &mut Some(&mut s), &mut Some(&mut v), &mut Some(&mut a), &mut None, &mut None);
        State { s: s[0].clamp(0.0, self.length), speed: v[0].max(0.0), acceleration: a[0] }
    }
}

#[cfg(test)]
mod tests {
    use super::{Along, Profile};
    use proptest::prelude::{ProptestConfig, prop_assert, proptest};

    proptest! {
        #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]
        /// Whatever can be reached is: within limits, forwards all the way, and exactly at the end.
        #[test]
        fn profiles_go_forwards_within_limits(
            length in 1e-4..5.0_f64, velocity in 0.05..2.0_f64, acceleration in 0.1..20.0_f64, jerk in 0.5..500.0_f64,
            share in 0.0..=1.0_f64, wish in 0.0..=1.0_f64,
        ) {
            let along = Along { velocity, acceleration, jerk };
            // A speed from which one can stop within the length, then one that can be reached from it.
            let from = share * along.reach(0.0, velocity, length);
            let to = along.reach(from, (wish * velocity).max(from), length);
            for (from, to) in [(from, to), (to, from)] {
                let profile = Profile::new(length, from, to, along);
                prop_assert!(profile.is_ok(), "{:?}", profile.err());
                let profile = profile.expect("checked");
                let mut last = 0.0;
                for i in 0..=200 {
                    let state = profile.at(profile.seconds() * f64::from(i) / 200.0);
                    prop_assert!(state.s >= last - 1e-9, "backwards at {i}: {} after {last}", state.s);
                    prop_assert!(state.speed <= velocity * (1.0 + 1e-6));
                    prop_assert!(state.acceleration.abs() <= acceleration * (1.0 + 1e-6));
                    last = state.s;
                }
                prop_assert!((last - length).abs() < 1e-7 * (1.0 + length));
            }
        }
    }

    #[test]
    fn a_long_straight_takes_the_textbook_time() {
        // From rest to rest: length over speed, and v/a + a/j for the ramps.
        let along = Along { velocity: 0.5, acceleration: 1.0, jerk: 10.0 };
        let profile = Profile::new(3.0, 0.0, 0.0, along).expect("feasible");
        assert!((profile.seconds() - (3.0 / 0.5 + 0.5 + 0.1)).abs() < 1e-9);
    }
}
