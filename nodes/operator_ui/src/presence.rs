//! Which nodes are there, by their heartbeats.

use crate::protocol::NodeView;
use apprentice_msgs::msg::Heartbeat;
use bus::Time;
use std::collections::BTreeMap;

/// Silent for longer: late.
const LATE_S: f64 = 2.0;
/// Silent for longer: gone.
const GONE_S: f64 = 5.0;
/// More nodes are not watched.
const MAX_NODES: usize = 256;
const MAX_NAME: usize = 256;

/// Every node heard of.
#[derive(Debug, Clone, Default)]
pub(crate) struct Presence {
    nodes: BTreeMap<String, Seen>,
}

#[derive(Debug, Clone)]
struct Seen {
    at: Time,
    instance: String,
    restarts: u32,
}

impl Presence {
    /// Takes a heartbeat that arrived at `now`.
    pub fn hear(&mut self, now: &Time, beat: Heartbeat) {
        if beat.node.len() > MAX_NAME || beat.instance.len() > MAX_NAME {
            return;
        }
        let has_room = self.nodes.len() < MAX_NODES;
        match self.nodes.get_mut(&beat.node) {
            Some(seen) => {
                seen.at = *now;
                if seen.instance != beat.instance {
                    seen.instance = beat.instance;
                    seen.restarts = seen.restarts.saturating_add(1);
                }
            }
            None if has_room => {
                self.nodes.insert(beat.node, Seen { at: *now, instance: beat.instance, restarts: 0 });
            }
            None => {}
        }
    }

    /// How each node stands at `now`.
    pub fn view(&self, now: &Time) -> Vec<NodeView> {
        let state = |seen: &Seen| match now.nanoseconds_since(&seen.at) as f64 * 1e-9 {
            silent if silent > GONE_S => "gone",
            silent if silent > LATE_S => "late",
            _ => "alive",
        };
        let short = |name: &str| name.rsplit('/').next().unwrap_or(name).to_owned();
        let view = |(name, seen): (&String, &Seen)| NodeView {
            name: short(name),
            state: state(seen),
            restarts: seen.restarts,
        };
        self.nodes.iter().map(view).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Presence;
    use apprentice_msgs::msg::Heartbeat;
    use bus::Time;

    #[test]
    fn a_silent_node_is_late_after_two_seconds_and_gone_after_five() {
        let at = |seconds: f64| Time::from_nanoseconds((seconds * 1e9) as i128);
        let beat = |instance: &str| Heartbeat {
            node: "/apprentice/reward_posterior".into(),
            instance: instance.into(),
            ..Heartbeat::default()
        };
        let mut presence = Presence::default();
        presence.hear(&at(10.0), beat("a"));
        let states = [11.9, 12.1, 14.9, 15.1].map(|now| presence.view(&at(now))[0].state);
        assert_eq!(states, ["alive", "late", "late", "gone"]);
        presence.hear(&at(20.0), beat("b"));
        let view = presence.view(&at(20.0));
        assert_eq!((view[0].name.as_str(), view[0].state, view[0].restarts), ("reward_posterior", "alive", 1));
    }
}
