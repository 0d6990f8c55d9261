//! What the arm reaches of the table: only what the robot could carry out is asked about.

use apprentice_msgs::msg::{TableReach, TableScene};
use scene::Point;

/// More cells a side are not taken.
const MAX_SIDE: usize = 512;

/// What the planner told, checked.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Reach {
    message: TableReach,
    side: usize,
}

impl Reach {
    /// From the planner.
    ///
    /// # Errors
    /// In a sentence, when its numbers do not fit together.
    pub fn new(message: TableReach) -> Result<Self, String> {
        let side = message.side as usize;
        if side > MAX_SIDE || message.reachable.len() != side * side {
            let cells = message.reachable.len();
            return Err(format!("it has {cells} cells for {side} on each side; at most {MAX_SIDE} are taken"));
        }
        Ok(Self { message, side })
    }

    /// Whether it is of the table and the target of a scene.
    pub fn is_of(&self, scene: &TableScene) -> bool {
        let Self { message, .. } = self;
        (message.width_m, message.depth_m) == (scene.width_m, scene.depth_m) && message.target_id == scene.target.id
    }

    /// Why nothing is known of what is in reach, where nothing is.
    pub fn unknown(&self) -> Option<&str> {
        (self.side == 0).then_some(&self.message.reason)
    }

    /// Of which robot.
    pub fn robot_hash(&self) -> &str {
        &self.message.robot_hash
    }

    /// Whether the target can be put there, in normalised coordinates; everywhere where nothing is known.
    pub fn contains(&self, at: Point) -> bool {
        let cell = |x: f64| ((x * self.side as f64).max(0.0) as usize).min(self.side.saturating_sub(1));
        self.side == 0 || self.message.reachable[cell(at.y) * self.side + cell(at.x)]
    }
}

/// Whether a place may be asked about.
pub(crate) fn is_in_reach(reach: Option<&Reach>, at: Point) -> bool {
    reach.is_none_or(|reach| reach.contains(at))
}

#[cfg(test)]
mod tests {
    use super::Reach;
    use apprentice_msgs::msg::TableReach;
    use scene::Point;

    #[test]
    fn a_cell_is_in_reach_when_it_was_told_to_be_and_nothing_that_is_broken_is_taken() {
        let told = |side, reachable| Reach::new(TableReach { side, reachable, ..TableReach::default() });
        let half = told(2, vec![true, true, true, false]).expect("four cells");
        for (x, y, is) in [(0.1, 0.1, true), (0.9, 0.1, true), (0.49, 0.9, true), (0.51, 0.9, false), (1.0, 1.0, false)]
        {
            assert_eq!(half.contains(Point::new(x, y)), is, "{x} {y}");
        }
        assert!(half.contains(Point::new(-3.0, f64::NAN)), "the nearest cell");
        assert!(told(0, Vec::new()).expect("nothing is known").contains(Point::new(0.5, 0.5)));
        assert!(told(2, vec![true; 3]).is_err() && told(u32::MAX, Vec::new()).is_err());
    }
}
