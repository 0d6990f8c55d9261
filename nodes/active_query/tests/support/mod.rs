//! What `performance_bounds` says of the robot's policy, for the tests of lessons about worlds.

use apprentice_msgs::msg::{PolicyBound, PolicyBounds, RiskBound};

/// A bound on the normalised loss of the robust policy of a revision, or none, as `outcome` has it.
pub fn bounds(revision: u64, outcome: u8, bound: f64) -> PolicyBounds {
    let normalised_loss = RiskBound { outcome, bound, ..RiskBound::default() };
    PolicyBounds {
        revision,
        evidence_hash: "h".into(),
        set_id: format!("robust-{revision}-0"),
        policies: vec![PolicyBound { id: "robust".into(), normalised_loss, ..PolicyBound::default() }],
        alpha: 0.95,
        delta: 0.05,
        ..PolicyBounds::default()
    }
}
