//! The world as a pure state machine: it says again and again what it is.

use crate::{Settings, WorldSettingsError, world};
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::TabularWorld;

/// What the node takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event {
    /// Say again what there is.
    Announce,
}

/// What the node gives.
#[derive(Debug, Clone, PartialEq)]
pub enum Output {
    /// The world.
    World(Box<TabularWorld>),
}

/// The simulated world.
#[derive(Debug)]
pub struct SimulatedWorldNode {
    world: TabularWorld,
    announced: bool,
}

impl SimulatedWorldNode {
    /// The world of the settings.
    ///
    /// # Errors
    /// Parameters that make no world.
    pub fn new(settings: &Settings) -> Result<Self, WorldSettingsError> {
        Ok(Self { world: world(settings)?, announced: false })
    }

    /// Takes one event. The world keeps the stamp of its first announcement: it has not changed since.
    pub fn step(&mut self, now: Time, event: Event) -> Vec<Output> {
        match event {
            Event::Announce => {
                if !self.announced {
                    self.world.header.stamp = now;
                    self.announced = true;
                }
                vec![Output::World(Box::new(self.world.clone()))]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Event, Output, SimulatedWorldNode};
    use crate::Settings;
    use apprentice_msgs::builtin_interfaces::Time;

    #[test]
    fn every_announcement_is_the_same_message() {
        let mut node = SimulatedWorldNode::new(&Settings::default()).expect("the road");
        let at = |sec: i32| Time { sec, nanosec: 0 };
        let [Output::World(first)] = node.step(at(5), Event::Announce).try_into().expect("one output");
        let [Output::World(again)] = node.step(at(9), Event::Announce).try_into().expect("one output");
        assert_eq!((first.header.stamp, &first), (at(5), &again));
    }
}
