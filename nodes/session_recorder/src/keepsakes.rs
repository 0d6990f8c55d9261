//! What is picked out of the recorded messages to be attached to the bag: node settings and the robot's description.

use std::collections::BTreeMap;

use apprentice_msgs::{Message, from_cdr, msg::NodeSettings, std_msgs};
use bag::{Attachment, MetadataRecord};

/// Name of the topic with the robot's URDF.
const ROBOT_DESCRIPTION: &str = "/robot_description";

/// The newest of each.
#[derive(Debug, Default)]
pub(crate) struct Keepsakes {
    /// By fully qualified node name.
    settings: BTreeMap<String, (u64, NodeSettings)>,
    robot: Option<(u64, String)>,
}

impl Keepsakes {
    /// Looks at a message; one that is malformed is none of these.
    pub(crate) fn see(&mut self, topic: &str, type_name: &str, log_time: u64, cdr: &[u8]) {
        if type_name == NodeSettings::TYPE {
            if let Ok(settings) = from_cdr::<NodeSettings>(cdr) {
                self.settings.insert(settings.name.clone(), (log_time, settings));
            }
        } else if topic == ROBOT_DESCRIPTION
            && type_name == std_msgs::String::TYPE
            && let Ok(robot) = from_cdr::<std_msgs::String>(cdr)
        {
            self.robot = Some((log_time, robot.data));
        }
    }

    /// `parameters/<node>.yaml` for each node, and `robot.urdf`.
    pub(crate) fn attachments(&self) -> Vec<Attachment> {
        let settings = self.settings.iter().map(|(name, (log_time, settings))| Attachment {
            log_time: *log_time,
            create_time: *log_time,
            name: format!("parameters/{}.yaml", plain(name)),
            media_type: "application/yaml".to_owned(),
            data: settings.parameters.clone().into_bytes(),
        });
        let robot = self.robot.iter().map(|(log_time, text)| Attachment {
            log_time: *log_time,
            create_time: *log_time,
            name: "robot.urdf".to_owned(),
            media_type: "application/xml".to_owned(),
            data: text.clone().into_bytes(),
        });
        settings.chain(robot).collect()
    }

    /// Version, commit and seed of every node.
    pub(crate) fn metadata(&self) -> MetadataRecord {
        let mut values = BTreeMap::new();
        for (name, (_, settings)) in &self.settings {
            values.insert(format!("{name} version"), settings.version.clone());
            values.insert(format!("{name} commit"), settings.commit.clone());
            values.insert(format!("{name} seed"), settings.seed.to_string());
        }
        MetadataRecord { name: "nodes".to_owned(), values }
    }
}

/// A node's name as a file name: `/apprentice/active_query` becomes `apprentice.active_query`.
fn plain(name: &str) -> String {
    let safe = |c: char| if c.is_ascii_alphanumeric() || c == '_' { c } else { '.' };
    name.trim_start_matches('/').chars().map(safe).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use apprentice_msgs::to_cdr;

    #[test]
    fn the_newest_settings_of_each_node_and_the_robot_are_kept() {
        let mut kept = Keepsakes::default();
        for (time, name, seed) in [(1, "/a/one", 5), (2, "/a/two", 6), (3, "/a/one", 7)] {
            let settings = NodeSettings {
                name: name.to_owned(),
                seed,
                parameters: format!("seed: {seed}\n"),
                ..NodeSettings::default()
            };
            kept.see("/a/settings", "apprentice_msgs/msg/NodeSettings", time, &to_cdr(&settings));
        }
        kept.see("/a/settings", "apprentice_msgs/msg/NodeSettings", 4, &[0, 1, 0, 0, 9]);
        let robot = std_msgs::String { data: "<robot/>".to_owned() };
        kept.see("/robot_description", "std_msgs/msg/String", 5, &to_cdr(&robot));
        kept.see("/other", "std_msgs/msg/String", 6, &to_cdr(&robot));

        let names: Vec<_> = kept.attachments().into_iter().map(|a| (a.name, a.data)).collect();
        let expected = [
            ("parameters/a.one.yaml", "seed: 7\n"),
            ("parameters/a.two.yaml", "seed: 6\n"),
            ("robot.urdf", "<robot/>"),
        ];
        assert_eq!(names, expected.map(|(name, data)| (name.to_owned(), data.as_bytes().to_vec())));
        assert_eq!(kept.metadata().values["/a/one seed"], "7");
    }

    #[test]
    fn a_hostile_node_name_cannot_become_a_path() {
        assert_eq!(plain("/../../etc/passwd"), "......etc.passwd");
    }
}
