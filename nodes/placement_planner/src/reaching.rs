//! What the arm reaches of a table, for those who ask about it.

use crate::PlacementPlanner;
use crate::node::Output;
use apprentice_msgs::msg::{TableReach, TableScene};
use apprentice_msgs::std_msgs::Header;
use exchange::scene_from_message;

impl PlacementPlanner {
    /// Where the arm can put the target on the bare table of a scene: a function of the settings, the robot and the scene.
    ///
    /// # Errors
    /// A scene that cannot be used.
    pub fn reach(&mut self, message: &TableScene) -> Result<TableReach, String> {
        let scene = scene_from_message(message).map_err(|error| error.to_string())?;
        let mut told = TableReach {
            header: Header { frame_id: message.header.frame_id.clone(), ..Header::default() },
            robot_hash: self.robot_hash.clone(),
            target_id: scene.target.id.clone(),
            width_m: scene.width_m,
            depth_m: scene.depth_m,
            ..TableReach::default()
        };
        match self.planner.reach(&scene) {
            Ok(map) => {
                told.side = u32::try_from(map.side()).unwrap_or(0);
                told.reachable = (0..map.side().pow(2)).map(|cell| map.configuration(cell).is_some()).collect();
            }
            Err(reason) => told.reason = reason,
        }
        Ok(told)
    }

    /// What is told of the table at hand, when that is news or wanted again. A table on which things were moved is the same.
    pub(crate) fn tell_reach(&mut self, again: bool) -> Option<Output> {
        let mut is_news = false;
        if self.reach_is_old
            && !self.robot_hash.is_empty()
            && let Some(scene) = self.scene.take()
        {
            self.reach_is_old = false;
            // A scene that cannot be used is told of by those who plan for it.
            let reach = self.reach(&scene).ok().map(Box::new);
            is_news = reach.is_some() && reach != self.reach;
            self.reach = reach;
            self.scene = Some(scene);
        }
        self.reach.clone().filter(|_| again || is_news).map(Output::Reach)
    }
}
