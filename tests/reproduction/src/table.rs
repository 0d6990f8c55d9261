//! Figure 8.6: lessons on the flowers and spoon tables; error of the taught placement, and whether the bound holds.

use crate::chart::{Line, chart};
use crate::lesson::{Classroom, Held, LessonError};
use clap::Parser;
use serde_json::json;
use std::path::{Path, PathBuf};

/// What to vary.
#[derive(Debug, Parser)]
pub struct Arguments {
    /// Lessons per scenario, seeds 1, 2, …
    #[arg(long, default_value_t = 20)]
    trials: u64,
    /// Scenarios, by the name of their file in config/
    #[arg(long, value_delimiter = ',', default_value = "flowers,spoon")]
    scenarios: Vec<String>,
    /// End of a lesson, metres; as in the scenario unless given
    #[arg(long)]
    epsilon_m: Option<f64>,
    /// Most questions a lesson; as in the scenario unless given
    #[arg(long)]
    max_questions: Option<i64>,
    /// Rationality assumed of the person; as in the scenario unless given
    #[arg(long)]
    beta: Option<f64>,
    /// Share of questions that offer two places at random; as in the scenario unless given
    #[arg(long)]
    hold_out_share: Option<f64>,
    /// Test tables a lesson, every object redrawn
    #[arg(long, default_value_t = 200)]
    tests: usize,
    /// Folder for table-NAME.json and table-NAME.svg
    #[arg(long, default_value = "target/reproduction")]
    out: PathBuf,
}

/// Runs the lessons, prints a table per scenario and writes JSON and SVG.
pub fn run(arguments: &Arguments) -> Result<(), LessonError> {
    for name in &arguments.scenarios {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../config").join(format!("{name}.yaml"));
        let mut classroom = Classroom::open(&file)?;
        classroom.vary(arguments.epsilon_m, arguments.max_questions, arguments.beta, arguments.hold_out_share);
        let mut lessons = Vec::new();
        for seed in 1..=arguments.trials {
            let held = classroom.hold(seed, arguments.tests)?;
            let last = held.history.last();
            eprintln!(
                "{name} seed {seed}: {} after {} questions, mean error {:.1} cm",
                match (held.taught, held.doubted) {
                    (true, _) => "taught",
                    (false, true) => "doubted",
                    (false, false) => "not taught",
                },
                held.questions,
                last.map_or(f64::NAN, |last| 100.0 * last.mean_error_m)
            );
            lessons.push(held);
        }
        report(name, &classroom, &lessons);
        write(name, &classroom, &lessons, &arguments.out)
            .map_err(|error| LessonError::Scenario(format!("{}: {error}", arguments.out.display())))?;
    }
    Ok(())
}

fn report(name: &str, classroom: &Classroom, lessons: &[Held]) {
    let taught: Vec<&Held> = lessons.iter().filter(|held| held.taught).collect();
    let mut questions: Vec<u32> = taught.iter().map(|held| held.questions).collect();
    questions.sort_unstable();
    println!(
        "{name}: {} of {} lessons taught, ε = {:.1} cm; {} doubted, after {} comparisons at random in all",
        taught.len(),
        lessons.len(),
        100.0 * classroom.epsilon_m(),
        lessons.iter().filter(|held| held.doubted).count(),
        lessons.iter().map(|held| held.held_out).sum::<u32>(),
    );
    if let (Some(first), Some(last)) = (questions.first(), questions.last()) {
        println!("  questions to taught: min {first}, median {}, max {last}", questions[questions.len() / 2]);
        let of = |pick: fn(&crate::lesson::Measured) -> f64| {
            let values: Vec<f64> = taught.iter().filter_map(|held| held.history.last()).map(pick).collect();
            (
                100.0 * values.iter().sum::<f64>() / values.len() as f64,
                100.0 * values.iter().copied().fold(0.0, f64::max),
            )
        };
        let ((mean, worst_mean), (largest, worst)) = (of(|m| m.mean_error_m), of(|m| m.worst_error_m));
        println!("  true error when taught: mean {mean:.2} cm (worst lesson {worst_mean:.2} cm)");
        println!("  largest true error over the test tables: mean {largest:.2} cm, worst lesson {worst:.2} cm");
    }
    println!(
        "  {:>5} {:>9} {:>11} {:>11} {:>12} {:>8} {:>8}",
        "shown", "bound cm", "mean err cm", "worst err cm", "within bound", "R-hat", "ESS"
    );
    for n in 1..=lessons.iter().map(|held| held.history.len()).max().unwrap_or(0) {
        let at: Vec<_> = lessons.iter().filter_map(|held| held.history.get(n - 1)).collect();
        let mean = |values: Vec<f64>| values.iter().sum::<f64>() / values.len() as f64;
        println!(
            "  {n:>5} {:>9.2} {:>11.2} {:>11.2} {:>12.3} {:>8.4} {:>8.0}  ({} lessons, {} with a bound)",
            100.0 * mean(at.iter().filter_map(|m| m.bound_m).collect()),
            100.0 * mean(at.iter().map(|m| m.mean_error_m).collect()),
            100.0 * mean(at.iter().map(|m| m.worst_error_m).collect()),
            mean(at.iter().filter_map(|m| m.within_bound).collect()),
            mean(at.iter().map(|m| m.rhat).collect()),
            mean(at.iter().map(|m| m.ess_bulk).collect()),
            at.len(),
            at.iter().filter(|m| m.bound_m.is_some()).count(),
        );
    }
}

fn write(name: &str, classroom: &Classroom, lessons: &[Held], out: &Path) -> std::io::Result<()> {
    std::fs::create_dir_all(out)?;
    let json = json!({ "scenario": name, "epsilon_m": classroom.epsilon_m(), "lessons": lessons });
    std::fs::write(out.join(format!("table-{name}.json")), serde_json::to_vec_pretty(&json)?)?;
    let longest = lessons.iter().map(|held| held.history.len()).max().unwrap_or(0);
    let line = |label: &str, pick: fn(&crate::lesson::Measured) -> Option<f64>| Line {
        label: label.into(),
        points: (0..longest)
            .filter_map(|i| {
                let at: Vec<f64> =
                    lessons.iter().filter_map(|held| held.history.get(i)).filter_map(pick).map(|m| 100.0 * m).collect();
                (!at.is_empty()).then(|| ((i + 1) as f64, at.iter().sum::<f64>() / at.len() as f64))
            })
            .collect(),
    };
    let lines = [
        line("bound, worst of the imagined tables", |m| m.bound_m),
        line("largest true error", |m| Some(m.worst_error_m)),
        line("mean true error", |m| Some(m.mean_error_m)),
    ];
    let path = out.join(format!("table-{name}.svg"));
    chart(&path, &format!("{name}: placement error, mean of lessons"), "demonstrations", "cm", &lines)
        .map_err(std::io::Error::other)
}
