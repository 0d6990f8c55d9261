//! Every figure, one after another: what is finished is kept, so that a run that was cut off goes on where it was.

use crate::harness::{Figure, Options, ReproductionError, Summary};
use crate::report;
use clap::Parser;
use std::path::{Path, PathBuf};

/// What to make, and where to put it.
#[derive(Debug, Parser)]
pub struct Arguments {
    /// Independent repetitions of every figure; by default as many as the dissertation has
    #[arg(long)]
    replicates: Option<usize>,
    /// Seed; settings were chosen on seed 1, so results come from another
    #[arg(long, default_value_t = 2026)]
    seed: u64,
    /// Threads; the numbers do not depend on it
    #[arg(long, default_value_t = std::thread::available_parallelism().map_or(1, usize::from))]
    threads: usize,
    /// Only these figures
    #[arg(long, value_delimiter = ',')]
    only: Vec<String>,
    /// Make them again, even if they are there
    #[arg(long)]
    again: bool,
    /// Folder of results/NAME.json, figures/NAME.svg and REPORT.md
    #[arg(long, default_value = report::FOLDER)]
    folder: PathBuf,
    /// Folder for the numbers of every replicate, NAME.json
    #[arg(long)]
    data: Option<PathBuf>,
}

/// Makes what is missing, then writes the report. A figure that fails does not keep the others from being made.
pub fn run(figures: &[Figure], arguments: &Arguments) -> Result<(), ReproductionError> {
    if let Some(name) = arguments.only.iter().find(|name| figures.iter().all(|figure| figure.name != name.as_str())) {
        return Err(ReproductionError::UnknownFigure { name: name.clone() });
    }
    let wanted = |figure: &&Figure| arguments.only.is_empty() || arguments.only.iter().any(|name| name == figure.name);
    let wanted: Vec<&Figure> = figures.iter().filter(wanted).collect();
    for folder in
        [Some(&arguments.folder.join("results")), Some(&arguments.folder.join("figures")), arguments.data.as_ref()]
            .into_iter()
            .flatten()
    {
        let fail = |error: std::io::Error| ReproductionError::File {
            path: folder.display().to_string(),
            message: error.to_string(),
        };
        std::fs::create_dir_all(folder).map_err(fail)?;
    }
    let mut failed = Vec::new();
    for (i, figure) in wanted.iter().enumerate() {
        match make(figure, arguments) {
            Ok(what) => eprintln!("{} of {}: {} {what}", i + 1, wanted.len(), figure.name),
            Err(error) => {
                eprintln!("{} of {}: {} failed: {error}", i + 1, wanted.len(), figure.name);
                failed.push(figure.name.to_owned());
            }
        }
    }
    report::write(figures, &arguments.folder)?;
    if failed.is_empty() { Ok(()) } else { Err(ReproductionError::Failed { names: failed.join(", ") }) }
}

/// Makes one figure unless it is there; says what was done.
fn make(figure: &Figure, arguments: &Arguments) -> Result<String, ReproductionError> {
    let result = report::result(&arguments.folder, figure.name);
    let data = arguments.data.as_ref().map(|folder| folder.join(format!("{}.json", figure.name)));
    if !arguments.again
        && is_there(&result, arguments)?
        && data.as_ref().is_none_or(|data| data.exists())
        && report::picture(&arguments.folder, figure.name).exists()
    {
        return Ok("is there already".into());
    }
    let options = Options {
        replicates: arguments.replicates,
        seed: arguments.seed,
        threads: arguments.threads,
        json: data,
        svg: Some(report::picture(&arguments.folder, figure.name)),
    };
    let made = figure.make(&options)?;
    made.deliver(&options)?;
    // Last, since it says that all the rest is there.
    made.summary.write(&result)?;
    Ok(format!("made in {:.0} s", made.summary.wall_seconds))
}

/// Whether a result is the one asked for.
fn is_there(result: &Path, arguments: &Arguments) -> Result<bool, ReproductionError> {
    Ok(Summary::read(result)?.is_some_and(|summary| {
        let as_many = arguments.replicates.map_or(summary.full, |n| summary.replicates == n);
        as_many && summary.seed == arguments.seed
    }))
}

#[cfg(test)]
mod tests {
    use super::{Arguments, run};
    use crate::harness::plot::{Content, Picture};
    use crate::harness::{Claim, Figure, Options, Outcome, ReproductionError, Summary, TextTable};
    use clap::Parser;
    use std::path::Path;
    use std::sync::atomic::{AtomicUsize, Ordering};

    static MADE: AtomicUsize = AtomicUsize::new(0);

    fn counted(options: &Options) -> Result<Outcome, ReproductionError> {
        MADE.fetch_add(1, Ordering::Relaxed);
        Ok(Outcome {
            name: "one",
            title: "a figure",
            replicates: options.count(7)?,
            seed: options.seed,
            notes: vec!["a note".into()],
            tables: vec![TextTable::new("a table", &["", "a | b"])],
            claims: vec![Claim::matched("|x| is small", false, "it is not")],
            picture: Picture { title: "a figure".into(), content: Content::Drawn("<svg></svg>".into()) },
            data: serde_json::json!([1, 2]),
        })
    }

    fn failing(_: &Options) -> Result<Outcome, ReproductionError> {
        Err(ReproductionError::Replicates { got: 0 })
    }

    const FIGURES: &[Figure] =
        &[Figure { name: "two", about: "fails", run: failing }, Figure { name: "one", about: "works", run: counted }];

    fn all(folder: &Path, more: &[&str]) -> Result<(), ReproductionError> {
        let folder = folder.display().to_string();
        run(FIGURES, &Arguments::parse_from([&["all", "--folder", &folder], more].concat()))
    }

    #[test]
    fn what_is_finished_is_kept_and_what_fails_is_told() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = folder.path();
        let failed = all(at, &[]).expect_err("one figure fails");
        assert_eq!(failed.to_string(), "could not be made: two");
        assert_eq!(MADE.load(Ordering::Relaxed), 1);
        // There already: with as many replicates and the same seed.
        all(at, &["--only", "one"]).expect("nothing to do");
        assert_eq!(MADE.load(Ordering::Relaxed), 1);
        all(at, &["--only", "one", "--seed", "3"]).expect("another seed");
        all(at, &["--only", "one", "--seed", "3", "--replicates", "2"]).expect("fewer replicates");
        all(at, &["--only", "one", "--again"]).expect("once more");
        assert_eq!(MADE.load(Ordering::Relaxed), 4);
        let summary = Summary::read(&at.join("results/one.json")).expect("good").expect("there");
        assert_eq!((summary.replicates, summary.seed, summary.full), (7, 2026, true));
        assert!(at.join("figures/one.svg").exists());
        let report = std::fs::read_to_string(at.join("REPORT.md")).expect("there");
        assert!(report.contains("| match: \\|x\\| is small | it is not | **not held** |"), "{report}");
        assert!(report.contains("Not made: two."), "{report}");
        assert!(all(at, &["--only", "three"]).is_err());
        std::fs::write(at.join("results/one.json"), "{").expect("written");
        assert!(all(at, &["--only", "one"]).is_err(), "a result that is none is no result");
    }
}
