//! Section 8.3 tried: simulated lessons that end by the stopping rule, and how often they end too early.

use crate::chapter8::stopping::{Exam, Person, hold};
use crate::harness::plot::{Content, Panel, Picture, Series, Style};
use crate::harness::{Claim, Estimate, Options, Outcome, ReproductionError, TextTable, replicates, to_value};
use inquiry::clopper_pearson;
use serde_json::json;

/// Lessons with each person.
const REPLICATES: usize = 1000;
/// Share of surprises that random questions must rule out in lessons that are confirmed.
const CONFIRMED: f64 = 0.4;
/// δ of the rule.
const DELTA: f64 = 0.05;

/// Makes the table.
///
/// # Errors
/// Too few replicates.
pub fn run(options: &Options) -> Result<Outcome, ReproductionError> {
    let n = options.count(REPLICATES)?;
    let of = |person: Person, n: usize, most_surprises: f64| {
        let hold = |replicate| hold(person, (DELTA, most_surprises), options.seed, replicate);
        replicates(person.label(), n, options.threads, hold)
    };
    // The wrong models are there to see what the guards do; a twentieth of the lessons tells.
    let fewer = (n / 20).max(2);
    let lessons = [
        (Person::Boltzmann, n, 1.0),
        (Person::Boltzmann, fewer, CONFIRMED),
        (Person::HiddenFeature, fewer, 1.0),
        (Person::HiddenFeature, fewer, CONFIRMED),
        (Person::Careless, fewer, 1.0),
        (Person::Careless, fewer, CONFIRMED),
    ];
    let exams = lessons.map(|(person, n, most)| of(person, n, most));
    let exams = exams.into_iter().collect::<Result<Vec<Vec<Exam>>, _>>()?;
    let mut table = TextTable::new(
        "How lessons end; \"too early\": the true normalised loss exceeds ε = .1 when the rule says taught",
        &["person", "lessons", "taught", "too early", "95 % interval", "questions", "not reached", "warned"],
    );
    for ((person, _, most), exams) in lessons.iter().zip(&exams) {
        let taught: Vec<&Exam> = exams.iter().filter(|exam| exam.taught).collect();
        let early = taught.iter().filter(|exam| exam.is_too_early()).count();
        let [low, high] = clopper_pearson(early as u64, exams.len() as u64, 0.95)?;
        let questions = Estimate::of(&taught.iter().map(|exam| exam.questions as f64).collect::<Vec<_>>());
        let warned = exams.iter().filter(|exam| exam.warned).count();
        let open = exams.iter().filter(|exam| !exam.taught && !exam.warned).count();
        let confirmed = if *most < 1.0 { ", confirmed" } else { "" };
        table.row(
            format!("{}{confirmed}", person.label()),
            [
                exams.len().to_string(),
                taught.len().to_string(),
                early.to_string(),
                format!("{:.2}–{:.2} %", 100.0 * low, 100.0 * high),
                questions.text(),
                open.to_string(),
                warned.to_string(),
            ],
        );
    }
    let right = &exams[0];
    let early = right.iter().filter(|exam| exam.is_too_early()).count();
    let [_, most] = clopper_pearson(early as u64, right.len() as u64, 0.9)?;
    let rate = early as f64 / right.len() as f64;
    let predicted: Vec<f64> = right.iter().filter_map(|exam| exam.prediction_ratio()).collect();
    let near = predicted.iter().filter(|ratio| (0.5..=2.0).contains(*ratio)).count();
    let mut predictions = TextTable::new(
        "\"About n more answers\", said at the look halfway through lessons that were taught",
        &["lessons", "median said / needed", "within a factor of 2"],
    );
    predictions.row(
        predicted.len().to_string(),
        [format!("{:.2}", median(&predicted)), format!("{near} of {}", predicted.len())],
    );
    let warned = right.iter().filter(|exam| exam.warned).count();
    let early_of = |exams: &[Exam]| exams.iter().filter(|exam| exam.is_too_early()).count();
    let (hidden, guarded) = (early_of(&exams[2]), early_of(&exams[3]));
    let claims = vec![
        Claim::beaten(
            format!("false stops in at most δ = {DELTA} of lessons with a person as modelled"),
            rate <= DELTA && most <= DELTA,
            format!("{early} of {}, with 95 % confidence at most {:.2} %", right.len(), 100.0 * most),
        ),
        Claim::beaten(
            "a person as modelled is seldom taken for another one: at most 5 % of lessons",
            warned as f64 <= 0.05 * right.len() as f64,
            format!("{warned} of {}", right.len()),
        ),
        Claim::beaten(
            "confirmation by random questions at least halves the false stops where a feature is missing",
            2 * guarded <= hidden && hidden > 0,
            format!("{hidden} without, {guarded} with, of {}", exams[2].len()),
        ),
    ];
    let counts = |exams: &[Exam]| {
        let most = right.iter().map(|exam| exam.questions).max().unwrap_or(0);
        (0..=most)
            .map(|q| {
                let done = exams.iter().filter(|exam| exam.taught && exam.questions <= q).count();
                (q, done as f64 / exams.len() as f64, 0.0)
            })
            .collect::<Vec<_>>()
    };
    let places: Vec<String> = counts(right).iter().map(|point| point.0.to_string()).collect();
    let series = Series { label: "taught".into(), colour: 0, style: Style::Best, points: counts(right) };
    Ok(Outcome {
        name: "stopping",
        title: "Simulated lessons that end by the stopping rule",
        replicates: n,
        seed: options.seed,
        notes: vec![
            "Not in the dissertation. 4 × 4 grids with 4 one-hot features, slip .1, γ = .9; true rewards from the prior; action questions by expected drop, a fifth of them random and held out.".into(),
            "Losses are shares of what the uniform policy loses. α = 1 − δ/2 for the rewards that fit, the other half of δ shared by all looks for the draws.".into(),
            "\"confirmed\": before a lesson is called taught, random questions must show that at most .4 of their answers are surprises: 6 without a surprise.".into(),
            "\"hidden feature\": the person goes by a fifth feature as well, which the robot does not have. \"careless\": 3 of 10 answers at random.".into(),
        ],
        tables: vec![table, predictions],
        claims,
        picture: Picture {
            title: "Lessons taught after so many questions".into(),
            content: Content::Panels(vec![Panel {
                x: "questions".into(),
                y: "share of lessons taught".into(),
                places,
                range: [0.0, 1.0],
                logarithmic: false,
                levels: vec![],
                series: vec![series],
            }]),
        },
        data: json!({ "lessons": to_value(&exams) }),
    })
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use crate::chapter8::stopping::{Person, hold};
    use crate::harness::replicates;

    /// A small version of the command: 20 lessons. With a rate of false stops of .05 five or more have a chance of .3 %.
    #[test]
    fn lessons_do_not_end_too_early() {
        let exams = replicates("lessons", 20, 2, |i| hold(Person::Boltzmann, (0.05, 1.0), 7, i)).expect("lessons");
        let early = exams.iter().filter(|exam| exam.is_too_early()).count();
        let taught = exams.iter().filter(|exam| exam.taught).count();
        assert!(early < 5, "{early} of 20 ended too early");
        assert!(taught > 10, "{taught} of 20 ended");
        assert_eq!(exams[3], hold(Person::Boltzmann, (0.05, 1.0), 7, 3).expect("a lesson"));
    }
}
