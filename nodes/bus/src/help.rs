//! The `--help` text of a node, made from its settings.

use crate::{
    parameter::{NodeSettings, Range},
    settings::{self, BUS_PARAMETERS},
};

/// The text of `apprentice <node> --help`.
pub(crate) fn help<S: NodeSettings>() -> String {
    let defaults = settings::fields(&S::default()).unwrap_or_default();
    let mut text = format!(
        "{}\n\nUsage: apprentice {} [--ros-args OPTIONS]\n\n\
         Options, as of every ROS 2 node:\n\
         \x20 -p NAME:=VALUE          a parameter\n\
         \x20 --params-file FILE      a ROS parameter file (YAML)\n\
         \x20 -r FROM:=TO             another name for a topic or a service\n\
         \x20 -r __node:=NAME         another name for the node\n\
         \x20 -r __ns:=/NAMESPACE     another namespace (default {})\n\
         \x20 --log-level LEVEL       debug, info, warn, error or fatal\n\n\
         Parameters (fixed once the node runs):\n",
        S::ABOUT,
        S::NODE,
        crate::arguments::DEFAULT_NAMESPACE,
    );
    for spec in S::PARAMETERS {
        let default =
            defaults.get(spec.name).map(|value| settings::to_parameter(value).to_string()).unwrap_or_default();
        text.push_str(&format!("  {} = {default}\n      {}", spec.name, spec.about));
        if spec.range != Range::Any {
            text.push_str(&format!(" [{}]", spec.range));
        }
        text.push('\n');
    }
    for (spec, default) in BUS_PARAMETERS.iter().zip(["false", "\"auto\""]) {
        text.push_str(&format!("  {} = {default}\n      {}\n", spec.name, spec.about));
    }
    let example = S::PARAMETERS.first().map_or_else(
        || "use_sim_time:=true".to_owned(),
        |spec| {
            let value = defaults.get(spec.name).map(settings::to_parameter);
            format!("{}:={}", spec.name, value.map(|value| value.to_string()).unwrap_or_default())
        },
    );
    text.push_str(&format!(
        "\nExample:\n  apprentice {} --ros-args -p {example} --log-level debug\n\n\
         Environment: ROS_DOMAIN_ID, ROS_AUTOMATIC_DISCOVERY_RANGE, ROS_LOCALHOST_ONLY, RMW_IMPLEMENTATION, NO_COLOR\n",
        S::NODE
    ));
    text
}
