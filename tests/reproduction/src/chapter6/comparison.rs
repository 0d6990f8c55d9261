//! A table of chapter 6: losses of both methods by column, in print, as published, and ours.

use super::learn::learn;
use super::{Learned, Shown, World, purpose};
use crate::harness::plot::{Content, Panel, Picture, Series, Style};
use crate::harness::{
    Claim, Estimate, Options, Outcome, ReproductionError, TextTable, bootstrap_interval, generator, replicates,
    to_value,
};
use rand_chacha::ChaCha8Rng;

/// What the author's solver adds to every loss: it stops at changes of 1e-3 (method notes 1.12).
const FLOOR: f64 = 0.006;

/// Mean losses of one method in print, and (mean, standard error) of the 100 losses in its author's repository.
#[derive(Debug, Clone, Copy)]
pub struct Printed {
    /// In the dissertation.
    pub dissertation: &'static [f64],
    /// In the author's files.
    pub author: &'static [(f64, f64)],
}

/// A table of chapter 6.
#[derive(Debug, Clone, Copy)]
pub struct Comparison {
    /// `table-6.2` …
    pub name: &'static str,
    /// What it shows.
    pub title: &'static str,
    /// What the columns are, for the axis.
    pub axis: &'static str,
    /// Their names.
    pub columns: &'static [&'static str],
    /// Bayesian IRL in print.
    pub irl: Printed,
    /// Bayesian REX in print.
    pub rex: Printed,
    /// What else must be known.
    pub note: &'static str,
    /// What is shown in a column.
    pub show: fn(&World, usize, &mut ChaCha8Rng) -> Result<Shown, ReproductionError>,
    /// A claim of the text about losses as published, by column: (Bayesian IRL, Bayesian REX).
    pub claim: (&'static str, ByColumn),
}

/// Judges the losses of both methods in every column.
pub type ByColumn = fn(&[(Estimate, Estimate)]) -> bool;

/// Makes the table.
pub fn run(comparison: &Comparison, options: &Options) -> Result<Outcome, ReproductionError> {
    let n = options.count(100)?;
    let rows = replicates(comparison.name, n, options.threads, |replicate| one(comparison, options.seed, replicate))?;
    let columns: Vec<Vec<Learned>> =
        (0..comparison.columns.len()).map(|i| rows.iter().map(|row| row[i]).collect()).collect();
    Ok(Outcome {
        name: comparison.name,
        title: comparison.title,
        replicates: n,
        seed: options.seed,
        notes: vec![
            "as published: L1 walk of 5,000 steps of .01, a tenth not kept, every 5th kept, β = 50, repeated pairs removed; solved exactly, so without the author's floor of .006".into(),
            "ours: HMC, β of each kind of evidence learned (a priori 1 to 2,500), 2,000 draws and up to 8,000 until R̂ ≤ 1.01; joint: both kinds of evidence in one posterior".into(),
            comparison.note.into(),
        ],
        tables: tables(comparison, &columns),
        claims: claims(comparison, &columns, options.seed),
        picture: picture(comparison, &columns),
        data: to_value(&rows),
    })
}

fn one(comparison: &Comparison, seed: u64, replicate: usize) -> Result<Vec<Learned>, ReproductionError> {
    let world = World::new(seed, replicate)?;
    (0..comparison.columns.len())
        .map(|column| {
            // The same demonstrations in every column, as far as they go.
            let mut generator = generator(seed, replicate, purpose::DEMONSTRATIONS);
            let shown = (comparison.show)(&world, column, &mut generator)?;
            learn(&world, &shown, seed, replicate, column as u32)
        })
        .collect()
}

type Of = fn(&Learned) -> f64;

fn estimates(columns: &[Vec<Learned>], of: Of) -> Vec<Estimate> {
    columns.iter().map(|column| Estimate::of(&column.iter().map(of).collect::<Vec<f64>>())).collect()
}

fn tables(comparison: &Comparison, columns: &[Vec<Learned>]) -> Vec<TextTable> {
    let mut head = vec![comparison.axis];
    head.extend(comparison.columns);
    let mut table = TextTable::new("Mean true loss ± s.e. of the policy of the mean reward", &head);
    let mut ours = |name: &str, of: Of| table.row(name, estimates(columns, of).iter().map(Estimate::text));
    let mut printed = Vec::new();
    for (name, source) in [("Bayesian IRL", comparison.irl), ("Bayesian REX", comparison.rex)] {
        printed.push((format!("{name} D"), source.dissertation.iter().map(|x| format!("{x:.3}")).collect::<Vec<_>>()));
        let author = source.author.iter().map(|(mean, error)| format!("{mean:.4} ± {error:.4}")).collect();
        printed.push((format!("{name} author's data"), author));
    }
    ours("Bayesian IRL as published", |learned| learned.irl_published);
    ours("Bayesian REX as published", |learned| learned.rex_published);
    ours("Bayesian IRL ours", |learned| learned.irl);
    ours("Bayesian REX ours", |learned| learned.rex);
    ours("joint evidence, ours", |learned| learned.joint);
    ours("learned β of actions, joint", |learned| learned.beta_actions);
    ours("learned β of preferences, joint", |learned| learned.beta_preferences);
    let not_mixed = |column: &Vec<Learned>| {
        let n: usize = column.iter().map(Learned::n_not_mixed).sum();
        format!("{n} of {}", 3 * column.len())
    };
    table.row("posteriors of ours with R̂ > 1.01", columns.iter().map(not_mixed));
    for (name, row) in printed {
        table.row(name, row);
    }
    vec![table]
}

fn claims(comparison: &Comparison, columns: &[Vec<Learned>], seed: u64) -> Vec<Claim> {
    let irl = estimates(columns, |learned| learned.irl_published);
    let rex = estimates(columns, |learned| learned.rex_published);
    let mut claims = Vec::new();
    for (name, ours, printed) in [("Bayesian IRL", &irl, comparison.irl), ("Bayesian REX", &rex, comparison.rex)] {
        let pairs = || ours.iter().zip(printed.author);
        // Losses near the floor are nothing but the floor.
        let agree = |(ours, &(mean, error)): (&Estimate, &(f64, f64))| ours.agrees_with((mean - FLOOR).max(0.0), error);
        let found: Vec<String> = pairs()
            .map(|(ours, &(mean, error))| {
                let spread = libm::hypot(ours.standard_error, error);
                format!("{:+.1}", (ours.mean - (mean - FLOOR).max(0.0)) / spread)
            })
            .collect();
        let claim = format!("{name}: within 2 s.e. of the author's data less {FLOOR} in every column");
        claims.push(Claim::matched(claim, pairs().all(agree), format!("s.e. apart: {}", found.join(", "))));
    }
    let pairs: Vec<(Estimate, Estimate)> = irl.into_iter().zip(rex).collect();
    claims.push(Claim::matched(comparison.claim.0, (comparison.claim.1)(&pairs), "as published"));
    claims.extend(joint_claims(columns, seed));
    claims
}

/// Joint evidence against the better of both, column by column and over all of them. Which is the better is known only to who
/// knows the truth: the joint posterior is compared with a choice that nobody can make.
fn joint_claims(columns: &[Vec<Learned>], seed: u64) -> [Claim; 2] {
    let mut worse = false;
    let mut found = Vec::new();
    let mut sums = vec![0.0; columns[0].len()];
    for column in columns {
        let mean = |of: Of| Estimate::of(&column.iter().map(of).collect::<Vec<f64>>()).mean;
        let better: Of = if mean(|l| l.irl) <= mean(|l| l.rex) { |l| l.irl } else { |l| l.rex };
        let differences: Vec<f64> = column.iter().map(|learned| learned.joint - better(learned)).collect();
        let [low, high] = bootstrap_interval(&differences, seed);
        worse |= low > 0.0;
        found.push(format!("{:+.4} [{low:+.4}, {high:+.4}]", Estimate::of(&differences).mean));
        for (sum, difference) in sums.iter_mut().zip(&differences) {
            *sum += difference;
        }
    }
    [
        Claim::beaten(
            "joint evidence is in no column worse than the better of both (no 95 % interval of the difference above 0)",
            !worse,
            found.join(", "),
        ),
        Claim::smaller("joint evidence is better than the better of both, summed over the columns", &sums, seed),
    ]
}

fn picture(comparison: &Comparison, columns: &[Vec<Learned>]) -> Picture {
    let line = |label: &str, colour, style, of: Of| {
        let at = |(i, estimate): (usize, &Estimate)| (i, estimate.mean, estimate.standard_error);
        let points = estimates(columns, of).iter().enumerate().map(at).collect();
        Series { label: label.into(), colour, style, points }
    };
    let printed = |label: &str, colour, source: Printed| {
        let at = |(i, &(mean, error)): (usize, &(f64, f64))| (i, mean, error);
        Series {
            label: label.into(),
            colour,
            style: Style::Printed,
            points: source.author.iter().enumerate().map(at).collect(),
        }
    };
    let series = vec![
        printed("Bayesian IRL, author's data", 0, comparison.irl),
        line("Bayesian IRL, as published", 0, Style::Published, |l| l.irl_published),
        line("Bayesian IRL, ours", 0, Style::Best, |l| l.irl),
        printed("Bayesian REX, author's data", 1, comparison.rex),
        line("Bayesian REX, as published", 1, Style::Published, |l| l.rex_published),
        line("Bayesian REX, ours", 1, Style::Best, |l| l.rex),
        line("joint evidence, ours", 2, Style::Best, |l| l.joint),
    ];
    Picture {
        title: format!("Table {}: {} (± 1 s.e.)", comparison.name.trim_start_matches("table-"), comparison.title),
        content: Content::Panels(vec![Panel {
            x: comparison.axis.into(),
            y: "true loss (return, log scale)".into(),
            places: comparison.columns.iter().map(ToString::to_string).collect(),
            range: [0.001, 4.0],
            logarithmic: true,
            levels: vec![],
            series,
        }]),
    }
}
