//! The environment that bringup and its nodes run in, taken on by starting the executable again in place.

use std::ffi::OsString;
use std::os::unix::process::CommandExt;
use std::process::Command;

/// Variables that must have a value, by what the environment holds now: a lesson stays on this machine unless the person
/// said otherwise, and every node knows the commit it was built from.
pub fn wanted(
    current: impl Fn(&str) -> Option<OsString>,
    domain_id: Option<u8>,
    commit: &str,
) -> Vec<(&'static str, String)> {
    let mut variables = vec![("APPRENTICE_COMMIT", commit.to_owned())];
    if let Some(id) = domain_id {
        variables.push(("ROS_DOMAIN_ID", id.to_string()));
    }
    let said = |name: &str| current(name).is_some_and(|value| !value.is_empty());
    if !said("ROS_AUTOMATIC_DISCOVERY_RANGE") && !said("ROS_LOCALHOST_ONLY") {
        variables.push(("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST".to_owned()));
    }
    variables.retain(|(name, value)| current(name).is_none_or(|held| held != OsString::from(value)));
    variables
}

/// Starts the executable again with more variables, in this very process; returns at once when there are none to add.
///
/// # Errors
/// When the system refuses.
pub fn take_on(variables: &[(&'static str, String)]) -> std::io::Result<()> {
    if variables.is_empty() {
        return Ok(());
    }
    let executable = std::env::current_exe()?;
    let mut args = std::env::args_os();
    let name = args.next().unwrap_or_else(|| executable.clone().into_os_string());
    let variables = variables.iter().map(|(name, value)| (name, value));
    Err(Command::new(&executable).arg0(name).args(args).envs(variables).exec())
}

#[cfg(test)]
mod tests {
    use super::wanted;
    use std::ffi::OsString;

    #[test]
    fn a_lesson_stays_on_this_machine_unless_the_person_said_otherwise() {
        let local = ("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST".to_owned());
        let commit = ("APPRENTICE_COMMIT", "abc".to_owned());
        assert_eq!(wanted(|_| None, None, "abc"), [commit.clone(), local.clone()]);
        for said in ["ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_LOCALHOST_ONLY"] {
            let current = |name: &str| (name == said).then(|| OsString::from("SUBNET"));
            assert_eq!(wanted(current, None, "abc"), std::slice::from_ref(&commit));
        }
    }

    #[test]
    fn what_is_taken_on_is_not_wanted_again() {
        let mut held = Vec::new();
        for _ in 0..2 {
            let more = wanted(
                |name| held.iter().find(|(n, _)| *n == name).map(|(_, v): &(&str, String)| OsString::from(v)),
                Some(7),
                "abc",
            );
            if !held.is_empty() {
                assert_eq!(more, []);
            }
            held.extend(more);
        }
        assert!(held.contains(&("ROS_DOMAIN_ID", "7".to_owned())));
    }
}
