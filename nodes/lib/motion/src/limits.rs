//! How fast joints may move, speed up and change their acceleration.

use thiserror::Error;

/// Limits of every joint, in its unit (radians or metres) per s, s² and s³; all finite and positive.
#[derive(Debug, Clone, PartialEq)]
pub struct Limits {
    velocity: Vec<f64>,
    acceleration: Vec<f64>,
    jerk: Vec<f64>,
}

/// A limit that no motion can keep.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum LimitsError {
    /// Not one limit of each kind per joint.
    #[error(
        "{velocity} limits of velocity, {acceleration} of acceleration and {jerk} of jerk; one of each per joint is needed"
    )]
    Lengths {
        /// Limits of velocity.
        velocity: usize,
        /// Limits of acceleration.
        acceleration: usize,
        /// Limits of jerk.
        jerk: usize,
    },
    /// Zero, negative, infinite or not a number.
    #[error("joint {joint} has {kind} limit {value}; a positive, finite one is needed")]
    Value {
        /// 0-based.
        joint: usize,
        /// "velocity", "acceleration" or "jerk".
        kind: &'static str,
        /// What was given.
        value: f64,
    },
}

impl Limits {
    /// Checks limits, one of each kind per joint.
    ///
    /// # Errors
    /// Lengths that differ; a limit that is not positive and finite.
    pub fn new(velocity: Vec<f64>, acceleration: Vec<f64>, jerk: Vec<f64>) -> Result<Self, LimitsError> {
        if velocity.len() != acceleration.len() || velocity.len() != jerk.len() {
            return Err(LimitsError::Lengths {
                velocity: velocity.len(),
                acceleration: acceleration.len(),
                jerk: jerk.len(),
            });
        }
        for (kind, values) in [("velocity", &velocity), ("acceleration", &acceleration), ("jerk", &jerk)] {
            if let Some((joint, &value)) = values.iter().enumerate().find(|(_, v)| !(v.is_finite() && **v > 0.0)) {
                return Err(LimitsError::Value { joint, kind, value });
            }
        }
        Ok(Self { velocity, acceleration, jerk })
    }

    /// Limits in proportion to the velocity: full speed is reached `ramp_s` seconds after rest, and half of those seconds
    /// go into changes of acceleration.
    ///
    /// # Errors
    /// A velocity or time that is not positive and finite.
    pub fn from_velocity(velocity: Vec<f64>, ramp_s: f64) -> Result<Self, LimitsError> {
        // With acceleration a and jerk j speed v takes v/a + a/j; a = 4v/3T and j = 4a/T make that 3T/4 + T/4.
        let acceleration: Vec<f64> = velocity.iter().map(|v| v * 4.0 / (3.0 * ramp_s)).collect();
        let jerk = acceleration.iter().map(|a| a * 4.0 / ramp_s).collect();
        Self::new(velocity, acceleration, jerk)
    }

    /// Number of joints.
    pub fn n_joints(&self) -> usize {
        self.velocity.len()
    }

    /// Per s.
    pub fn velocity(&self) -> &[f64] {
        &self.velocity
    }

    /// Per s².
    pub fn acceleration(&self) -> &[f64] {
        &self.acceleration
    }

    /// Per s³.
    pub fn jerk(&self) -> &[f64] {
        &self.jerk
    }
}

#[cfg(test)]
mod tests {
    use super::Limits;

    #[test]
    fn proportional_limits_reach_full_speed_in_the_time_asked_for() {
        let limits = Limits::from_velocity(vec![0.6, 2.0], 0.4).expect("good");
        for i in 0..2 {
            let (v, a, j) = (limits.velocity()[i], limits.acceleration()[i], limits.jerk()[i]);
            assert!((v / a + a / j - 0.4).abs() < 1e-12);
        }
    }

    #[test]
    fn bad_limits_are_named() {
        let words = |v: f64| Limits::from_velocity(vec![1.0, v], 0.4).expect_err("bad").to_string();
        for v in [0.0, -1.0, f64::INFINITY, f64::NAN] {
            assert!(words(v).starts_with("joint 1 has velocity limit"), "{}", words(v));
        }
        assert!(Limits::from_velocity(vec![1.0], 0.0).is_err());
        assert!(Limits::new(vec![1.0], vec![1.0], Vec::new()).is_err());
    }
}
