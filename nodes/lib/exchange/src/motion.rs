//! How long the motion of a plan takes.

use apprentice_msgs::msg::PlacementPlan;
use apprentice_msgs::trajectory_msgs::JointTrajectory;

/// How long a gripper is taken to need, seconds.
pub const GRIP_S: f64 = 1.0;

/// Seconds from a trajectory's start to its end; 0 for one without points.
pub fn trajectory_seconds(trajectory: &JointTrajectory) -> f64 {
    trajectory.points.last().map_or(0.0, |point| point.time_from_start.seconds())
}

/// Seconds that a plan takes to be carried out: its parts, and the gripper that closes after the first and opens before the last, where
/// there are such parts. That the gripper may have to open beforehand is left out. 0 without a motion.
pub fn motion_seconds(plan: &PlacementPlan) -> f64 {
    let parts = [&plan.approach, &plan.trajectory, &plan.retreat];
    let grips = [&plan.approach, &plan.retreat].into_iter().filter(|part| !part.points.is_empty()).count();
    parts.map(trajectory_seconds).iter().sum::<f64>() + GRIP_S * grips as f64
}

#[cfg(test)]
mod tests {
    use super::motion_seconds;
    use apprentice_msgs::builtin_interfaces::Duration;
    use apprentice_msgs::msg::PlacementPlan;
    use apprentice_msgs::trajectory_msgs::{JointTrajectory, JointTrajectoryPoint};

    #[test]
    fn the_gripper_counts_where_it_moves() {
        let lasting = |seconds: f64| {
            let point = JointTrajectoryPoint {
                time_from_start: Duration::from_seconds(seconds),
                ..JointTrajectoryPoint::default()
            };
            JointTrajectory { points: vec![JointTrajectoryPoint::default(), point], ..JointTrajectory::default() }
        };
        let in_hand = PlacementPlan { trajectory: lasting(4.0), ..PlacementPlan::default() };
        assert_eq!(motion_seconds(&PlacementPlan::default()), 0.0);
        assert_eq!(motion_seconds(&in_hand), 4.0);
        let let_go = PlacementPlan { retreat: lasting(0.5), ..in_hand };
        assert_eq!(motion_seconds(&let_go), 5.5);
        assert_eq!(motion_seconds(&PlacementPlan { approach: lasting(2.0), ..let_go }), 8.5);
    }
}
