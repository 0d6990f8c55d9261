//! The figures of the main job, measured on this machine: `cargo bench --bench figures`, or one of them:
//! `cargo bench --bench figures -- recorder`.
//!
//! Prints a table, and leaves the same as JSON under `target/tmp/end_to_end/figures`. Nothing here passes or fails.

#[allow(dead_code, reason = "the tests use all of it")]
#[path = "../end_to_end/chromium.rs"]
mod chromium;
#[allow(dead_code, reason = "the tests use all of it")]
#[path = "../end_to_end/recorded.rs"]
mod recorded;
#[allow(dead_code, reason = "the tests use all of it")]
#[path = "../end_to_end/suite.rs"]
mod suite;

mod drag;
mod flood;
mod idle;
mod lesson;
mod page;

use serde_json::{Value, json};

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if let Some(at) = arguments.iter().position(|word| word == "flood") {
        return flood::publish(&arguments[at + 1..]);
    }
    // One figure by its name, or all of them.
    let only = arguments.iter().skip(1).find(|word| !word.starts_with('-'));
    let of = |name: &str, measure: &dyn Fn() -> Value| match only {
        Some(wanted) if wanted != name => Value::Null,
        _ => measure(),
    };
    let executable = std::fs::metadata(env!("CARGO_BIN_EXE_apprentice")).map_or(0, |file| file.len());
    let figures = json!({
        "executable_mb": megabytes(executable),
        "flowers": of("flowers", &|| lesson::measure("flowers")),
        "spoon": of("spoon", &|| lesson::measure("spoon")),
        "page": of("page", &page::measure),
        "drag": of("drag", &drag::measure),
        "recorder": of("recorder", &flood::measure),
    });
    show("", &figures);
    let file = suite::fresh_folder("figures").join("figures.json");
    match std::fs::write(&file, format!("{figures:#}\n")) {
        Ok(()) => println!("\n{}", file.display()),
        Err(error) => eprintln!("{}: {error}", file.display()),
    }
}

/// One line a number.
fn show(path: &str, value: &Value) {
    match value {
        Value::Object(members) => {
            for (name, member) in members {
                let path = if path.is_empty() { name.clone() } else { format!("{path} · {name}") };
                show(&path, member);
            }
        }
        Value::Null => {}
        Value::Number(number) if number.is_f64() => {
            println!("{path:<64} {:>12.3}", number.as_f64().unwrap_or(f64::NAN))
        }
        other => println!("{path:<64} {other:>12}"),
    }
}

/// Bytes as megabytes (10⁶).
fn megabytes(bytes: u64) -> f64 {
    bytes as f64 / 1e6
}

/// Percentiles by nearest rank, and how many numbers there were.
fn percentiles(mut numbers: Vec<f64>) -> Value {
    numbers.sort_by(f64::total_cmp);
    let rank = |percent: usize| numbers.get((percent * numbers.len()).div_ceil(100).saturating_sub(1)).copied();
    json!({ "p50": rank(50), "p99": rank(99), "n": numbers.len() })
}
