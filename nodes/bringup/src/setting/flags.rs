//! The command line of `apprentice setting`.

use super::SettingError;
use clap::Parser;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  apprentice setting                                     breakfast, with a simulated person
  apprentice setting -- --demonstrator human             you answer; the page stays the same from lesson to lesson
  apprentice setting --session bags/mine                 begin, or continue, the setting in that folder
  apprentice setting my-table.yaml -- --headless --seed 7

A setting is a parameter file with a section /**/setting: what stands on the table, and what is to be placed, in order
(config/breakfast.yaml is one). Its other sections are for the nodes of every lesson. Each thing is a lesson of its own, with its
own bag in the folder N-ID; once it is taught, the robot puts the thing where it belongs, in the way of the next.
Where nothing moves (a lesson that you finish early, execute: false), the thing is taken to stand where the robot would put it.

Exit codes:
  0  everything has its place
  1  something was left off the table, or a lesson failed
  2  the command line or a parameter is wrong
  129, 130, 143  interrupted; the same command with the same --session goes on";

/// Flags that every lesson gets from the setting.
const OWN: [&str; 5] = ["--scenario", "--session", "--summary", "--until-taught", "--until-placed"];

/// Teach a robot to set a whole table, one thing after another.
#[derive(Debug, Clone, Parser)]
#[command(name = "apprentice setting", after_help = EXAMPLES, max_term_width = 110)]
pub struct Flags {
    /// The setting: breakfast, or the path of a parameter file
    #[arg(default_value = "breakfast", value_name = "NAME|FILE")]
    pub setting: String,
    /// Folder of the setting; one that exists is continued [default: bags/NAME, or bags/NAME-2 …]
    #[arg(long, value_name = "DIR")]
    pub session: Option<PathBuf>,
    /// Flags for each lesson, as of `apprentice`
    #[arg(last = true, value_name = "FLAGS")]
    pub lesson: Vec<String>,
}

impl Flags {
    /// Refuses what the setting itself says to each lesson.
    ///
    /// # Errors
    /// The first such flag.
    pub fn check(&self) -> Result<(), SettingError> {
        let name = |flag: &String| flag.split('=').next().unwrap_or_default().to_owned();
        match self.lesson.iter().map(name).find(|flag| OWN.contains(&flag.as_str())) {
            Some(flag) => Err(SettingError::OwnFlag { flag }),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Flags;
    use clap::{CommandFactory, Parser};

    #[test]
    fn what_comes_after_the_dashes_is_for_each_lesson() {
        Flags::command().debug_assert();
        let flags = Flags::parse_from(["apprentice setting", "my.yaml", "--", "--headless", "--seed", "7"]);
        assert_eq!((flags.setting.as_str(), flags.lesson.len()), ("my.yaml", 3));
        flags.check().expect("these are the lessons' own");
        for bad in ["--session=x", "--until-taught", "--summary"] {
            let flags = Flags::parse_from(["apprentice setting", "--", bad]);
            assert!(flags.check().expect_err("the setting says that").to_string().contains("leave it out"));
        }
    }
}
