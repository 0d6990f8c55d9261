//! One lesson with a simulated person, from the command to "taught"; several tests look at what it left.

use crate::suite::{Suite, fresh_folder};
use serde_json::Value;
use std::panic::catch_unwind;
use std::path::PathBuf;
use std::sync::LazyLock;
use std::time::Duration;

/// Longest lesson that is not broken, on two busy cores.
const LIMIT: Duration = Duration::from_secs(240);

/// What a lesson left.
#[derive(Debug, Clone)]
pub struct Taught {
    /// The JSON summary.
    pub summary: Value,
    /// The bag's folder.
    pub bag: PathBuf,
    /// What the terminal showed.
    pub shown: String,
}

/// `None` once the lesson has been tried and has failed: it is not tried again for every test.
static LESSON: LazyLock<Option<Taught>> = LazyLock::new(|| catch_unwind(|| teach("flowers", &["--seed", "1"])).ok());

/// The lesson on flowers with seed 1; taught once in this process.
pub fn flowers() -> Taught {
    LESSON.clone().expect("the lesson on flowers failed, as another test tells")
}

/// Teaches a lesson until it ends by itself, which it must do well.
pub fn teach(name: &str, arguments: &[&str]) -> Taught {
    let file = fresh_folder(&format!("{name}-summary")).join("summary.json");
    let text = file.to_string_lossy().into_owned();
    let mut all = vec!["--headless", "--until-taught", "--summary", &text];
    all.extend(arguments);
    let mut suite = Suite::start(name, &all);
    let status = suite.wait(LIMIT);
    assert!(status.success(), "the lesson ended with {status}\n{}", suite.dump());
    let summary =
        std::fs::read_to_string(&file).unwrap_or_else(|error| panic!("no summary: {error}\n{}", suite.dump()));
    let summary = serde_json::from_str(&summary).expect("the summary is JSON");
    Taught { summary, bag: suite.bag(), shown: suite.shown() }
}
