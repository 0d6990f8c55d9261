//! Places that were considered, and what became of each.

use scene::{Point, Scene};

/// What became of a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// It is the one.
    Chosen,
    /// The arm cannot put the target there.
    Unreachable,
    /// The arm reaches it, but would touch something.
    Blocked,
    /// The arm found no way there.
    NoPath,
    /// It could be used, but a better one was.
    NextBest,
}

/// One place that was considered for the target.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// Metres in the table's frame.
    pub at_m: Point,
    /// R there, averaged over the draws.
    pub mean_reward: f64,
    /// Share of the draws whose own best place is within [`NEAR_M`](crate::NEAR_M).
    pub probability_best: f64,
    /// VaR_α of the distance to each draw's own best place, metres.
    pub var_m: f64,
    /// CVaR_α of it, metres.
    pub cvar_m: f64,
    /// From the target's outline to the nearest object that it does not stand on, or edge of the table, metres.
    pub clearance_m: f64,
    /// What became of it.
    pub verdict: Verdict,
    /// The same in words.
    pub reason: String,
}

/// From the target's bounding circle to the nearest object that does not carry it, or edge, metres.
pub(crate) fn clearance_m(scene: &Scene, at_m: Point) -> f64 {
    let radius_m = scene.target.shape.bounding_radius_m();
    let edge_m = at_m.x.min(scene.width_m - at_m.x).min(at_m.y).min(scene.depth_m - at_m.y);
    let objects = scene.objects.iter().filter(|object| !object.supports).map(|object| object.distance_m(at_m));
    objects.fold(edge_m, f64::min) - radius_m
}
