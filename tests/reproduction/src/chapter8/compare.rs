//! Lessons of several methods on the same worlds, and what is told of them.

use super::{Ask, Course, Curve, Learner, Method, Step, Teacher, fewer_queries, hold, mean_curve, queries_to};
use crate::harness::{
    Claim, Estimate, Options, ReproductionError, TextTable, bootstrap_interval, replicates, to_value,
};
use inquiry::tabular::Over;
use likelihood::actions::Choice;
use mdp::Mdp;
use posterior::Run;
use serde_json::{Value, json};

/// A world with a person in it, and what is shown first.
#[derive(Debug, Clone)]
pub struct Situation {
    /// The world.
    pub mdp: Mdp,
    /// The true reward.
    pub weights: Vec<f64>,
    /// Shown before the first question.
    pub shown: Vec<Choice>,
}

/// What all lessons of a figure have in common.
#[derive(Debug, Clone)]
pub struct Plan {
    /// What is asked for.
    pub ask: Ask,
    /// Questions, at most.
    pub n_questions: usize,
    /// How to sample.
    pub run: Run,
    /// β that is taken for granted.
    pub beta: f64,
    /// A lesson ends once the worst loss is below this; never: 0.
    pub enough: f64,
    /// What ours makes small.
    pub over: Over,
}

/// Lessons of every method: `steps[method][replicate][question]`.
#[derive(Debug, Clone)]
pub struct Lessons {
    /// In order.
    pub methods: Vec<Method>,
    /// Of each.
    pub steps: Vec<Vec<Vec<Step>>>,
}

/// Holds the lessons of all methods in the worlds that `situation` makes.
///
/// # Errors
/// Whatever keeps a robot from learning or asking.
pub fn compare(
    options: &Options,
    n: usize,
    plan: &Plan,
    methods: &[Method],
    situation: impl Fn(usize) -> Result<Situation, ReproductionError> + Sync,
) -> Result<Lessons, ReproductionError> {
    let of_replicate = |replicate: usize| -> Result<Vec<Vec<Step>>, ReproductionError> {
        let Situation { mdp, weights, shown } = situation(replicate)?;
        let teacher = Teacher::new(&mdp, &weights);
        let learner = Learner { mdp: &mdp, run: plan.run.clone(), seed: options.seed, replicate, beta: plan.beta };
        let first = learner.learn(&shown, 0, None)?;
        let states: Vec<usize> = (0..mdp.n_states()).collect();
        let course = Course {
            learner,
            teacher: &teacher,
            shown,
            states,
            ask: plan.ask,
            n_questions: plan.n_questions,
            enough: plan.enough,
            over: plan.over,
        };
        methods.iter().map(|method| hold(&course, method, &first)).collect()
    };
    let all = replicates("lessons", n, options.threads, of_replicate)?;
    let steps = (0..methods.len()).map(|method| all.iter().map(|lessons| lessons[method].clone()).collect()).collect();
    Ok(Lessons { methods: methods.to_vec(), steps })
}

impl Lessons {
    /// One number of every step: `[method]` with its curve.
    pub fn curves(&self, of: impl Fn(&Step) -> f64) -> Vec<Curve> {
        let lessons = |steps: &Vec<Vec<Step>>| steps.iter().map(|lesson| lesson.iter().map(&of).collect()).collect();
        let curve = |(method, steps): (&Method, _)| Curve { method: *method, lessons: lessons(steps) };
        self.methods.iter().zip(&self.steps).map(curve).collect()
    }

    /// Seconds of processor time a query, by method: choosing alone, and with solving the draws.
    pub fn seconds(&self) -> Vec<(Estimate, Estimate)> {
        let of = |steps: &Vec<Vec<Step>>| {
            let asked = || steps.iter().flatten().filter(|step| step.asked.is_some());
            let choosing: Vec<f64> = asked().map(|step| step.choosing_s).collect();
            let whole: Vec<f64> = asked().map(|step| step.choosing_s + step.solving_s).collect();
            (Estimate::of(&choosing), Estimate::of(&whole))
        };
        self.steps.iter().map(of).collect()
    }

    /// The times as a table.
    pub fn seconds_table(&self, printed: &[(&str, &str)]) -> TextTable {
        let title = "Seconds of processor time per query, mean ± s.e.; \"with draws\" also solves the draws, once for all questions";
        let mut table = TextTable::new(title, &["method", "choosing", "with draws", "dissertation"]);
        for (method, (choosing, whole)) in self.methods.iter().zip(self.seconds()) {
            let theirs = printed.iter().find(|(label, _)| *label == method.label).map_or("–", |(_, text)| *text);
            let text = |estimate: Estimate| format!("{:.5} ± {:.5}", estimate.mean, estimate.standard_error);
            table.row(method.label, [text(choosing), text(whole), theirs.to_owned()]);
        }
        table
    }

    /// Every number.
    pub fn data(&self) -> Value {
        let of =
            |(method, steps): (&Method, &Vec<Vec<Step>>)| json!({ "method": method.label, "lessons": to_value(steps) });
        Value::Array(self.methods.iter().zip(&self.steps).map(of).collect())
    }
}

/// Mean and standard error after some numbers of questions.
pub fn curve_table(title: &str, curves: &[Curve], at: &[usize]) -> TextTable {
    let head: Vec<String> = std::iter::once("method".to_owned()).chain(at.iter().map(usize::to_string)).collect();
    let mut table = TextTable::new(title, &head);
    for curve in curves {
        let means = mean_curve(&curve.lessons);
        let cell = |&i: &usize| means.get(i.min(means.len() - 1)).map_or_else(|| "–".to_owned(), Estimate::text);
        table.row(curve.method.label, at.iter().map(cell));
    }
    table
}

/// Questions until each level is reached for the first time: mean over lessons, and in how many it was never reached; those count
/// as one question more than there were.
pub fn queries_table(title: &str, curves: &[Curve], levels: &[f64]) -> TextTable {
    let head: Vec<String> =
        std::iter::once("method".to_owned()).chain(levels.iter().map(|level| format!("≤ {level}"))).collect();
    let mut table = TextTable::new(title, &head);
    for curve in curves {
        let cell = |&level: &f64| {
            let of = |lesson: &Vec<f64>| queries_to(lesson, level).map(libm::ceil);
            let reached: Vec<Option<f64>> = curve.lessons.iter().map(of).collect();
            let never = reached.iter().filter(|n| n.is_none()).count();
            let counts: Vec<f64> =
                reached.iter().zip(&curve.lessons).map(|(n, lesson)| n.unwrap_or(lesson.len() as f64)).collect();
            let text = Estimate::of(&counts).text();
            if never == 0 { text } else { format!("{text} ({never} never)") }
        };
        table.row(curve.method.label, levels.iter().map(cell));
    }
    table
}

/// Mean over the questions from the first on, one number a lesson: what is compared between methods. A lesson that has ended stays
/// where it ended up to `n` questions.
pub fn mean_after(curve: &Curve, n: usize) -> Vec<f64> {
    let of =
        |lesson: &Vec<f64>| (1..=n).map(|i| lesson[i.min(lesson.len() - 1)]).fold(0.0, |sum, y| sum + y) / n as f64;
    curve.lessons.iter().map(of).collect()
}

/// Paired differences of such means, `a` minus `b`.
pub fn differences(a: &Curve, b: &Curve, n: usize) -> Vec<f64> {
    mean_after(a, n).iter().zip(mean_after(b, n)).map(|(a, b)| a - b).collect()
}

/// That `a` loses less than `b` per question in the dissertation, found again.
pub fn match_order(a: &Curve, b: &Curve, n: usize, seed: u64) -> Claim {
    let gaps = differences(a, b, n);
    let [low, high] = bootstrap_interval(&gaps, seed);
    let mean = gaps.iter().fold(0.0, |sum, gap| sum + gap) / gaps.len() as f64;
    let claim = format!("{} loses less than {}, mean over {n} questions", a.method.label, b.method.label);
    Claim::matched(claim, high < 0.0, format!("difference {mean:+.4} [{low:+.4}, {high:+.4}]"))
}

/// That `ours` is where `other` is after `n` questions with at least a fifth fewer.
pub fn fifth_fewer(ours: &Curve, other: &Curve, n: usize, seed: u64) -> Claim {
    let (share, [low, high]) = fewer_queries(&ours.lessons, &other.lessons, n, seed);
    let claim = format!("the mean loss of {} after {n} questions with at least 20 % fewer", other.method.label);
    let found = format!(
        "{:.1} questions, {:.0} % of {n} [{:.0} %, {:.0} %]",
        share * n as f64,
        100.0 * share,
        100.0 * low,
        100.0 * high
    );
    Claim::beaten(claim, high <= 0.8, found)
}
