//! Positions by name, as joint states and files have them, to a configuration.

use crate::{Drive, Robot};

/// A configuration from names, and what did not fit.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedPositions {
    /// One position per driven joint; what was not given, or not finite, is 0. Not clamped to limits.
    pub q: Vec<f64>,
    /// Driven joints that no name set.
    pub missing: Vec<String>,
    /// Names that are no moving joint of the robot.
    pub unknown: Vec<String>,
    /// Names given with a position that is not finite.
    pub not_finite: Vec<String>,
    /// Driven joints beyond their limits by more than 1e-6.
    pub outside: Vec<String>,
    /// Joints that mimic, given a position other than their leader's by more than 1e-6.
    pub astray: Vec<String>,
}

impl NamedPositions {
    /// Whether every driven joint has a finite position, within its limits or not.
    pub fn is_complete(&self) -> bool {
        self.missing.is_empty() && self.not_finite.is_empty()
    }
}

impl Robot {
    /// Sorts positions by name into a configuration. Of a name that comes twice the last counts.
    pub fn configuration<'a>(&self, positions: impl IntoIterator<Item = (&'a str, f64)>) -> NamedPositions {
        let mut found: Vec<Option<f64>> = vec![None; self.joints.len()];
        let mut unknown = Vec::new();
        let mut not_finite = Vec::new();
        for (name, position) in positions {
            match self.joints.iter().position(|joint| joint.name == name && joint.drive != Drive::Fixed) {
                None => unknown.push(name.to_owned()),
                Some(_) if !position.is_finite() => not_finite.push(name.to_owned()),
                Some(joint) => found[joint] = Some(position),
            }
        }
        let driven = || self.driven.iter().map(|&j| (&self.joints[j], found[j]));
        let names = |keep: &dyn Fn(&crate::Joint, Option<f64>) -> bool| -> Vec<String> {
            driven().filter(|(joint, at)| keep(joint, *at)).map(|(joint, _)| joint.name.clone()).collect()
        };
        let q: Vec<f64> = driven().map(|(_, at)| at.unwrap_or(0.0)).collect();
        let missing = names(&|joint, at| at.is_none() && !not_finite.contains(&joint.name));
        let outside =
            names(&|joint, at| at.is_some_and(|at| at < joint.limits.lower - 1e-6 || at > joint.limits.upper + 1e-6));
        let followers = self.joints.iter().zip(&found).filter(|(joint, _)| matches!(joint.drive, Drive::Mimic { .. }));
        let astray = followers
            .filter(|(joint, at)| at.is_some_and(|at| (at - joint.position(&q)).abs() > 1e-6))
            .map(|(joint, _)| joint.name.clone())
            .collect();
        NamedPositions { q, missing, unknown, not_finite, outside, astray }
    }
}
