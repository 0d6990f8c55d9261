//! The report: what `all` has made, as Markdown. It holds nothing but what stands in the results.

use crate::harness::{ClaimKind, Figure, ReproductionError, Summary};
use clap::Parser;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Where results, pictures and the report are kept.
pub const FOLDER: &str = env!("CARGO_MANIFEST_DIR");

/// Where to find results.
#[derive(Debug, Parser)]
pub struct Arguments {
    /// Folder of results/NAME.json, figures/NAME.svg and REPORT.md
    #[arg(long, default_value = FOLDER)]
    folder: PathBuf,
}

/// Writes REPORT.md.
pub fn run(figures: &[Figure], arguments: &Arguments) -> Result<(), ReproductionError> {
    write(figures, &arguments.folder)?;
    println!("{}", arguments.folder.join("REPORT.md").display());
    Ok(())
}

/// Writes the report of what lies in `folder`.
pub fn write(figures: &[Figure], folder: &Path) -> Result<(), ReproductionError> {
    let path = folder.join("REPORT.md");
    let fail = |error: std::io::Error| ReproductionError::File {
        path: path.display().to_string(),
        message: error.to_string(),
    };
    std::fs::write(&path, of_folder(figures, folder)?).map_err(fail)
}

/// The result of a figure.
pub fn result(folder: &Path, name: &str) -> PathBuf {
    folder.join("results").join(format!("{name}.json"))
}

/// The picture of a figure.
pub fn picture(folder: &Path, name: &str) -> PathBuf {
    folder.join("figures").join(format!("{name}.svg"))
}

/// The text of the report of what lies in `folder`.
pub fn of_folder(figures: &[Figure], folder: &Path) -> Result<String, ReproductionError> {
    let mut found = Vec::new();
    let mut missing = Vec::new();
    for figure in figures {
        match Summary::read(&result(folder, figure.name))? {
            Some(summary) => found.push(summary),
            None => missing.push(figure.name),
        }
    }
    Ok(text(&found, &missing))
}

const HEAD: &str = "# The dissertation's results beside ours

Written by `cargo run --release -p reproduction -- report` from `results/`; what to know before quoting a number stands in the
[README](README.md). *D* is the dissertation, *author* what its author's public programs and data say. *As published* is his method
written anew, *ours* what this project does. ± is one standard error. A claim *to match* holds when the dissertation's result is
found again, one *to beat* when a 95 % bootstrap interval over pairs excludes 0, unless it says otherwise. Claims that do not hold
stand here like all others.
";

fn text(found: &[Summary], missing: &[&str]) -> String {
    let mut text = HEAD.to_owned();
    text.push_str("\n| | replicates | seed | to match | to beat | CPU s |\n|---|---|---|---|---|---|\n");
    for summary in found {
        let held = |kind| {
            let of_kind = || summary.claims.iter().filter(move |claim| claim.kind == kind);
            let (held, all) = (of_kind().filter(|claim| claim.held).count(), of_kind().count());
            if all == 0 { "–".to_owned() } else { format!("{held} of {all}") }
        };
        line(
            &mut text,
            &format!(
                "| [{name}](#{anchor}) {title} | {replicates}{few} | {seed} | {matched} | {beaten} | {cpu:.0} |",
                name = summary.name,
                anchor = summary.name.replace('.', ""),
                title = summary.title,
                replicates = summary.replicates,
                few = if summary.full { "" } else { " (fewer than D)" },
                seed = summary.seed,
                matched = held(ClaimKind::Match),
                beaten = held(ClaimKind::Beat),
                cpu = summary.cpu_seconds,
            ),
        );
    }
    if !missing.is_empty() {
        line(&mut text, &format!("\nNot made: {}.", missing.join(", ")));
    }
    for summary in found {
        section(&mut text, summary);
    }
    text
}

fn section(text: &mut String, summary: &Summary) {
    let name = &summary.name;
    line(text, &format!("\n## {name}\n"));
    let mut title = summary.title.clone();
    if let Some(first) = title.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    let replicates = if summary.full { String::new() } else { format!(" --replicates {}", summary.replicates) };
    line(
        text,
        &format!(
            "{title}. {} replicates, seed {}, {:.0} CPU seconds on {} threads:\n`cargo run --release -p reproduction -- {name} --seed {}{replicates}`",
            summary.replicates, summary.seed, summary.cpu_seconds, summary.threads, summary.seed
        ),
    );
    line(text, &format!("\n![{name}](figures/{name}.svg)"));
    for table in &summary.tables {
        line(text, &format!("\n{}", table.markdown()));
    }
    line(text, "\n| claim | found | |\n|---|---|---|");
    for claim in &summary.claims {
        let kind = match claim.kind {
            ClaimKind::Match => "match",
            ClaimKind::Beat => "beat",
        };
        let held = if claim.held { "held" } else { "**not held**" };
        line(text, &format!("| {kind}: {} | {} | {held} |", cell(&claim.claim), cell(&claim.found)));
    }
    if !summary.notes.is_empty() {
        line(text, "");
    }
    for note in &summary.notes {
        line(text, &format!("- {note}"));
    }
}

fn line(text: &mut String, what: &str) {
    writeln!(text, "{what}").expect("a string takes everything");
}

/// Text in a cell of a Markdown table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

#[cfg(test)]
mod tests {
    use super::{FOLDER, of_folder, text};
    use crate::FIGURES;
    use std::path::Path;

    #[test]
    fn the_report_is_of_the_results() {
        let folder = Path::new(FOLDER);
        let written = std::fs::read_to_string(folder.join("REPORT.md")).expect("the report is there");
        assert!(
            written == of_folder(FIGURES, folder).expect("results can be read"),
            "REPORT.md is not what `cargo run --release -p reproduction -- report` writes"
        );
    }

    /// Every result has its picture, small enough to be kept.
    #[test]
    fn pictures_are_there_and_small() {
        for figure in FIGURES {
            if !super::result(Path::new(FOLDER), figure.name).exists() {
                continue;
            }
            let picture = super::picture(Path::new(FOLDER), figure.name);
            let size = std::fs::metadata(&picture).map(|data| data.len());
            assert!(size.as_ref().is_ok_and(|size| *size < 60_000), "{}: {size:?}", picture.display());
        }
    }

    #[test]
    fn what_is_missing_is_said() {
        assert!(text(&[], &["fig-4.2", "fig-4.3"]).contains("\nNot made: fig-4.2, fig-4.3.\n"));
    }
}
