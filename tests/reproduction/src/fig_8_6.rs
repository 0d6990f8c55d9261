//! Figure 8.6: which tables to ask about, and whether the bound on the placement holds.

use crate::chapter8::compare::{curve_table, differences, fifth_fewer, match_order};
use crate::chapter8::table_lesson::{Extent, Known, TableStep, Tests, hold_table, shown_first};
use crate::chapter8::tables::{Task, flowers, spoon};
use crate::chapter8::{ACTIVE_VAR, Curve, Method, OURS_TABLE, RANDOM, curve_panel};
use crate::harness::plot::{Content, Panel, Picture};
use crate::harness::{
    Claim, Estimate, Options, Outcome, ReproductionError, TextTable, extent, generator, replicates, to_value,
};
use rand_chacha::rand_core::Rng;
use serde_json::{Value, json};

/// As in the dissertation.
const REPLICATES: usize = 100;
/// Methods, in order.
const METHODS: [Method; 3] = [RANDOM, ACTIVE_VAR, OURS_TABLE];
/// Questions after which there is a bound.
const BOUNDED_AFTER: [usize; 3] = [0, 5, 10];
/// What is done in every trial.
const EXTENT: Extent = Extent {
    n_questions: 10,
    n_tests: extent(200, 10),
    n_bounded: extent(30, 3),
    bounded_after: &BOUNDED_AFTER,
    n_draws: 300,
    n_draws_bounded: extent(1200, 300),
    most_draws_bounded: extent(19_200, 300),
};
/// Errors below this are none, cm.
const NO_ERROR_CM: f64 = 1e-3;
/// Trials out of 100 in which the bound must hold.
const COVERED: f64 = 0.87;
/// Mean placement error of the author's program after 11 demonstrations, metres: random, active (method notes 5).
const PRINTED: [(&str, [f64; 2]); 2] = [("flowers", [0.063, 0.0425]), ("spoon", [0.095, 0.042])];

/// Lessons of one task: `steps[method][trial][demonstration]`.
struct Lessons {
    task: Task,
    steps: Vec<Vec<Vec<TableStep>>>,
}

/// Makes the figure.
///
/// # Errors
/// Too few replicates.
pub fn run(options: &Options) -> Result<Outcome, ReproductionError> {
    let n = options.count(REPLICATES)?;
    let (mut tables, mut claims, mut panels, mut data) = (vec![], vec![], vec![], serde_json::Map::new());
    for task in [flowers(), spoon()] {
        let lessons = lessons(task, n, options)?;
        lessons.tell(options.seed, &mut tables, &mut claims, &mut panels);
        data.insert(lessons.task.name.into(), lessons.data());
    }
    Ok(Outcome {
        name: "fig-8.6",
        title: "Teaching where to place flowers and a spoon",
        replicates: n,
        seed: options.seed,
        notes: vec![
            format!(
                "Errors over {} tables with every object redrawn; bound and worst error over the first {} of them. The bound is the largest .95-VaR bound (95 % confidence each), from {} draws, or up to {} where chains of fewer do not agree; the author's is the 96th of 100 draws.",
                EXTENT.n_tests, EXTENT.n_bounded, EXTENT.n_draws_bounded, EXTENT.most_draws_bounded
            ),
            "Unlike the author's program, dishes take up room and are redrawn clear of each other, so errors are not the same. Printed numbers are those of his program (method notes 5).".into(),
        ],
        tables,
        claims,
        picture: Picture { title: "Figure 8.6: placement error".into(), content: Content::Panels(panels) },
        data: Value::Object(data),
    })
}

fn lessons(task: Task, n: usize, options: &Options) -> Result<Lessons, ReproductionError> {
    let of_trial = |trial: usize| -> Result<Vec<Vec<TableStep>>, ReproductionError> {
        let tests = Tests::new(&task, EXTENT.n_tests, options.seed, trial);
        let shown: Vec<_> = shown_first(&task).into_iter().collect();
        let seed = generator(options.seed, trial, crate::chapter8::purpose::SHOWN).next_u64();
        let first = Known::new(&task, &shown, EXTENT.draws_after(0), seed)?;
        METHODS.iter().map(|method| hold_table(&first, method, &tests, &EXTENT, options.seed, trial)).collect()
    };
    let all = replicates(task.name, n, options.threads, of_trial)?;
    let steps = (0..METHODS.len()).map(|method| all.iter().map(|lessons| lessons[method].clone()).collect()).collect();
    Ok(Lessons { task, steps })
}

impl Lessons {
    fn curves(&self, of: impl Fn(&TableStep) -> f64) -> Vec<Curve> {
        let lessons =
            |steps: &Vec<Vec<TableStep>>| steps.iter().map(|lesson| lesson.iter().map(&of).collect()).collect();
        METHODS
            .iter()
            .zip(&self.steps)
            .map(|(method, steps)| Curve { method: *method, lessons: lessons(steps) })
            .collect()
    }

    fn tell(&self, seed: u64, tables: &mut Vec<TextTable>, claims: &mut Vec<Claim>, panels: &mut Vec<Panel>) {
        let name = self.task.name;
        let n = EXTENT.n_questions;
        let at: Vec<usize> = (0..=n).collect();
        let errors = self.curves(|step| 100.0 * step.error_m);
        let of_best = self.curves(|step| 100.0 * step.error_of_best_draw_m);
        tables.push(curve_table(
            &format!("{name}: mean true error of the MAP placement, cm, after so many questions"),
            &errors,
            &at,
        ));
        tables.push(curve_table(&format!("{name}: the same by the most likely draw, as published"), &of_best, &at));
        tables.push(self.coverage());
        tables.push(self.seconds());
        let mut add = |claim: Claim| claims.push(Claim { claim: format!("{name}: {}", claim.claim), ..claim });
        for (which, curves) in [("MAP", &errors), ("most likely draw", &of_best)] {
            let [random, risk, ours] = [0, 1, 2].map(|i| &curves[i]);
            let last = |curve: &Curve| Estimate::of(&curve.lessons.iter().map(|l| l[n] / 100.0).collect::<Vec<_>>());
            if let Some((_, [of_random, of_active])) = PRINTED.iter().find(|printed| printed.0 == name) {
                let (r, a) = (last(random), last(risk));
                let found = format!("{} and {} m, printed {of_random} and {of_active} m", r.text(), a.text());
                let claim =
                    format!("{which}: errors of Random and ActiveVaR after 11 demonstrations at most those printed");
                add(Claim::matched(claim, r.mean <= *of_random && a.mean <= *of_active, found));
            }
            if curves.iter().flat_map(|curve| curve.lessons.iter().flatten()).all(|error| *error < NO_ERROR_CM) {
                add(Claim::beaten(
                    format!("{which}: no method errs after the first demonstration"),
                    true,
                    "nothing left to compare",
                ));
                continue;
            }
            let mut of = |claim: Claim| add(Claim { claim: format!("{which}: {}", claim.claim), ..claim });
            of(match_order(risk, random, n, seed));
            let smaller = format!("ours errs less than ActiveVaR, cm, mean over {n} questions");
            of(Claim::smaller(smaller, &differences(ours, risk, n), seed));
            of(fifth_fewer(ours, risk, n, seed));
        }
        for (method, steps) in METHODS.iter().zip(&self.steps) {
            let (held, of) = held(steps, n);
            let claim = format!(
                "{}: the bound after 11 demonstrations is at least the worst error in 87 of 100 trials",
                method.label
            );
            add(Claim::beaten(
                claim,
                of > 0 && held as f64 >= COVERED * steps.len() as f64,
                format!("{held} of {} ({of} with a bound)", steps.len()),
            ));
        }
        let shown = if name == "spoon" { &of_best } else { &errors };
        panels.push(curve_panel(
            shown,
            &format!("{name}: questions answered"),
            if name == "spoon" { "mean error by the most likely draw, cm" } else { "mean error, cm" },
        ));
    }

    /// Bound, worst error and how often the one is at least the other.
    fn coverage(&self) -> TextTable {
        let title = format!(
            "{}: largest bound / worst true error, cm (trials in which the bound holds of those with one)",
            self.task.name
        );
        let at = BOUNDED_AFTER;
        let head: Vec<String> =
            std::iter::once("method".to_owned()).chain(at.iter().map(|i| format!("{} shown", i + 1))).collect();
        let mut table = TextTable::new(title, &head);
        for (method, steps) in METHODS.iter().zip(&self.steps) {
            let cell = |&i: &usize| {
                let bounds: Vec<f64> = steps.iter().filter_map(|lesson| lesson[i].bound_m).collect();
                let worst: Vec<f64> = steps.iter().map(|lesson| lesson[i].worst_m).collect();
                let mean = |x: &[f64]| 100.0 * x.iter().fold(0.0, |sum, x| sum + x) / x.len() as f64;
                let (held, of) = held(steps, i);
                format!("{:.1} / {:.1} ({held} of {of})", mean(&bounds), mean(&worst))
            };
            table.row(method.label, at.iter().map(cell));
        }
        table
    }

    fn seconds(&self) -> TextTable {
        let title = format!("{}: seconds of processor time per question, everything computed anew", self.task.name);
        let mut table = TextTable::new(title, &["method", "choosing"]);
        for (method, steps) in METHODS.iter().zip(&self.steps) {
            let asked = steps.iter().flat_map(|lesson| &lesson[..EXTENT.n_questions]).map(|step| step.choosing_s);
            table.row(method.label, [Estimate::of(&asked.collect::<Vec<_>>()).text()]);
        }
        table
    }

    fn data(&self) -> Value {
        let of = |(method, steps): (&Method, &Vec<Vec<TableStep>>)| json!({ "method": method.label, "lessons": to_value(steps) });
        Value::Array(METHODS.iter().zip(&self.steps).map(of).collect())
    }
}

/// Trials in which the bound after `i` questions is at least the worst error, and trials with a bound.
fn held(steps: &[Vec<TableStep>], i: usize) -> (usize, usize) {
    let bounded = || steps.iter().filter_map(|lesson| lesson[i].bound_m.map(|bound| (bound, lesson[i].worst_m)));
    (bounded().filter(|(bound, worst)| bound >= worst).count(), bounded().count())
}
