//! A lesson on a table: configurations are asked about, and what the robot would do is tried on other tables.

use super::tables::Task;
use super::{Method, cpu_seconds, purpose};
use crate::harness::{ReproductionError, generator};
use inquiry::table::{TableDraws, placement_alternatives, placement_losses, sampled_placement_answers};
use inquiry::{
    Answers, Belief, Losses, Question, QuestionKind, Round, Selecting, Selection, Strategy, candidates, select,
};
use placement::{LossBatch, placement_optima};
use posterior::{Confidence, Demonstration, Draws, Lesson, Rationality, Settings, sample};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;
use risk::upper_bound;
use scene::{Point, Scene};
use serde::Serialize;

/// β of the dissertation's author.
const BETA: f64 = 100.0;
/// Tables that may be asked about, as in the dissertation.
const CANDIDATES: usize = 50;
/// Draws that ours judges questions by.
const SCORED: usize = 200;
/// Tables that stand for all tables when ours looks ahead.
const REFERENCES: usize = 16;
/// Ways to place that ours considers besides the current one.
const POLICIES: usize = 60;
/// Answers drawn for each question.
const ANSWERS: usize = 24;
/// Points a side of the grid on which ours normalises densities.
const GRID_SIDE: usize = 24;
/// Level of every bound.
const ALPHA: f64 = 0.95;
/// The bound holds with confidence 1 − δ.
const DELTA: f64 = 0.05;

/// Where a table lesson stands after so many demonstrations.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TableStep {
    /// Demonstrations so far.
    pub demonstrations: usize,
    /// Mean true error over the test tables, metres.
    pub error_m: f64,
    /// Mean true error, metres, when the most likely of the draws stands in for the MAP weights, as in the author's program.
    pub error_of_best_draw_m: f64,
    /// Largest true error over those tables for which there is a bound, metres.
    pub worst_m: f64,
    /// The largest bound over them, metres; null where any has none.
    pub bound_m: Option<f64>,
    /// The largest empirical α-quantile over them, metres.
    pub quantile_m: f64,
    /// Seconds of processor time that choosing the next question took, all computed anew.
    pub choosing_s: f64,
}

impl TableStep {
    /// Takes the bound from more draws, and with it how far the robot errs that goes by them. The curve of the lesson stays one of
    /// few draws.
    fn bounded_by(&mut self, more: &Self) {
        (self.bound_m, self.quantile_m, self.worst_m) = (more.bound_m, more.quantile_m, more.worst_m);
    }
}

/// How much work to do.
#[derive(Debug, Clone, Copy)]
pub struct Extent {
    /// Questions after the first demonstration.
    pub n_questions: usize,
    /// Test tables.
    pub n_tests: usize,
    /// Of these, so many are bounded,
    pub n_bounded: usize,
    /// after so many questions; a bound takes more draws than a question.
    pub bounded_after: &'static [usize],
    /// Draws to choose a question by, over four chains.
    pub n_draws: usize,
    /// Draws for a bound, and four times as many, up to `most_draws_bounded`, for as long as a table has none.
    pub n_draws_bounded: usize,
    /// Draws after which a lesson stays without a bound.
    pub most_draws_bounded: usize,
}

impl Extent {
    /// Draws to take after so many questions.
    pub fn draws_after(&self, n_asked: usize) -> usize {
        if self.bounded_after.contains(&n_asked) { self.n_draws_bounded } else { self.n_draws }
    }
}

/// Tables to try the robot on, with the best places.
#[derive(Debug, Clone)]
pub struct Tests {
    tables: Vec<Scene>,
    best_m: Vec<Point>,
}

impl Tests {
    /// Those of a trial.
    pub fn new(task: &Task, n: usize, seed: u64, trial: usize) -> Self {
        let tables = task.redrawn(n, &mut generator(seed, trial, purpose::TESTS));
        let best_m = tables.iter().filter_map(|table| task.best_m(table)).collect();
        Self { tables, best_m }
    }
}

/// What the robot knows after some demonstrations.
pub struct Known<'a> {
    task: &'a Task,
    draws: Draws,
    narrow: Vec<f32>,
}

impl<'a> Known<'a> {
    /// Learns from demonstrations (scene and place in metres).
    ///
    /// # Errors
    /// A demonstration that cannot be learned from.
    pub fn new(task: &'a Task, shown: &[(Scene, Point)], n_draws: usize, seed: u64) -> Result<Self, ReproductionError> {
        let lesson = Lesson::new(&task.scene);
        let demonstration = |(i, (scene, at_m)): (usize, &(Scene, Point))| Demonstration {
            id: format!("d{i}"),
            scene: scene.clone(),
            placement: scene.normalised(*at_m),
            confidence: Confidence::Sure,
        };
        let demonstrations: Vec<Demonstration> = shown.iter().enumerate().map(demonstration).collect();
        let settings = Settings {
            rationality: Rationality::Fixed(BETA),
            n_draws,
            warmup: 200,
            threads: 1,
            grid_side: 32,
            ..Settings::default()
        };
        let draws = sample(&settings, seed, &lesson, &demonstrations)?;
        let narrow = draws.values.iter().map(|w| *w as f32).collect();
        Ok(Self { task, draws, narrow })
    }

    /// The best places under the MAP weights and under some of the draws: on every table.
    fn optima(&self, tables: &[Scene], draws: &[f32]) -> Vec<Option<(Point, Vec<Point>)>> {
        let (n_features, map_weights) = (self.draws.n_features, &self.draws.map_weights);
        placement_optima(tables, &LossBatch { draws, n_features, map_weights, threads: 1 })
    }

    /// Tries the robot on the test tables.
    ///
    /// # Errors
    /// Losses that cannot be judged.
    pub fn examine(&self, tests: &Tests, n_bounded: usize) -> Result<TableStep, ReproductionError> {
        let likely = &self.draws.log_likelihood;
        let best = (0..likely.len()).fold(0, |best, i| if likely[i] > likely[best] { i } else { best });
        let k = self.draws.n_features;
        let placed = self.optima(&tests.tables, &self.narrow[best * k..][..k]);
        let mut errors = Vec::with_capacity(tests.tables.len());
        let mut error_of_best_draw_m = 0.0;
        for ((map, of_best), best) in placed.into_iter().flatten().zip(&tests.best_m) {
            errors.push(map.distance(*best));
            error_of_best_draw_m += of_best[0].distance(*best) / tests.tables.len() as f64;
        }
        let (mut bound_m, mut quantile_m, mut worst_m) = ((n_bounded > 0).then_some(0.0_f64), 0.0_f64, 0.0_f64);
        let bounded = &tests.tables[..n_bounded];
        for ((map, optima), error) in self.optima(bounded, &self.narrow).into_iter().flatten().zip(&errors) {
            let losses: Vec<f64> = optima.iter().map(|best| best.distance(map)).collect();
            let outcome = upper_bound(&losses, self.draws.n_chains, ALPHA, DELTA)?;
            bound_m = bound_m.zip(outcome.bound()).map(|(most, bound)| most.max(bound));
            quantile_m = quantile_m.max(outcome.receipt().point_estimate);
            worst_m = worst_m.max(*error);
        }
        let error_m = errors.iter().fold(0.0, |sum, error| sum + error) / errors.len() as f64;
        Ok(TableStep {
            demonstrations: 0,
            error_m,
            error_of_best_draw_m,
            worst_m,
            bound_m,
            quantile_m,
            choosing_s: 0.0,
        })
    }

    /// The table to ask about next, out of hypothetical ones that each have one object moved.
    fn ask(
        &self,
        base: &Scene,
        method: &Method,
        revision: u64,
        seed: u64,
        rng: &mut ChaCha8Rng,
    ) -> Result<Scene, ReproductionError> {
        let tables = candidates(base, CANDIDATES, seed, revision, |table| self.task.best_m(table).is_some());
        let question =
            |situation, answers| Question { kind: QuestionKind::Placement, situation, answers, feasible: true };
        let round = match method.strategy {
            Strategy::LookAhead { .. } | Strategy::RewardInformation => self.ours(&tables, rng)?,
            strategy => {
                let random = strategy == Strategy::Random;
                let narrow = if random { &self.narrow[..self.draws.n_features] } else { &self.narrow[..] };
                let (map, optima): (Vec<_>, Vec<_>) = self.optima(&tables, narrow).into_iter().flatten().unzip();
                let n = optima.first().map_or(1, Vec::len);
                let certain = Answers::table(n, vec![1.0; n])?;
                Round {
                    belief: Belief::equal(n)?,
                    losses: placement_losses(&map, &optima)?,
                    questions: (0..tables.len()).map(|situation| question(situation, certain.clone())).collect(),
                    alternatives: None,
                }
            }
        };
        let selecting = Selecting { strategy: method.strategy, effort: None, hold_out_share: 0.0, seed };
        let index = match select(&round, &selecting, revision)? {
            Selection::Ask(chosen) => chosen.question,
            Selection::NothingToLearn | Selection::NothingFeasible => 0,
        };
        Ok(tables[index].clone())
    }

    /// Candidates with what may be answered there, and what the robot could do on tables that stand for all.
    fn ours(&self, tables: &[Scene], rng: &mut ChaCha8Rng) -> Result<Round, ReproductionError> {
        let k = self.draws.n_features;
        let n = SCORED.min(self.draws.n());
        let weights = super::some(&self.draws, n);
        let narrow: Vec<f32> = weights.iter().map(|w| *w as f32).collect();
        let references = self.task.redrawn(REFERENCES, rng);
        let (map, optima): (Vec<_>, Vec<_>) = self.optima(&references, &narrow).into_iter().flatten().unzip();
        let belief = Belief::equal(n)?;
        let draws = TableDraws { weights: &weights, n_features: k, betas: &[BETA] };
        let mut questions = Vec::with_capacity(tables.len());
        for (situation, table) in tables.iter().enumerate() {
            let answers = sampled_placement_answers(table, &draws, &belief, ANSWERS, GRID_SIDE, rng)?;
            let feasible = answers.is_some();
            let answers = match answers {
                Some(answers) => answers,
                None => Answers::table(n, vec![1.0; n])?,
            };
            questions.push(Question { kind: QuestionKind::Placement, situation, answers, feasible });
        }
        let losses = Losses::new(n, vec![0.0; n * tables.len()])?;
        Ok(Round { belief, losses, questions, alternatives: Some(placement_alternatives(&map, &optima, POLICIES)?) })
    }
}

/// Holds one lesson. The first demonstration is on the table of the task; `first` is what was learned from it.
///
/// # Errors
/// Whatever keeps the robot from learning or asking.
pub fn hold_table(
    first: &Known<'_>,
    method: &Method,
    tests: &Tests,
    extent: &Extent,
    seed: u64,
    trial: usize,
) -> Result<Vec<TableStep>, ReproductionError> {
    let task = first.task;
    let mut rng = generator(seed, trial, purpose::QUESTIONS);
    let mut chains = generator(seed, trial, purpose::CHAINS);
    let mut more_chains = generator(seed, trial, purpose::MORE_CHAINS);
    let mut shown: Vec<(Scene, Point)> = shown_first(task).into_iter().collect();
    let mut steps = Vec::with_capacity(extent.n_questions + 1);
    let mut learned = None;
    for n_asked in 0..=extent.n_questions {
        let known = learned.as_ref().unwrap_or(first);
        let is_bounded = extent.bounded_after.contains(&n_asked);
        let mut step = known.examine(tests, if is_bounded { extent.n_bounded } else { 0 })?;
        let mut n_draws = extent.n_draws_bounded;
        while is_bounded && step.bound_m.is_none() && 4 * n_draws <= extent.most_draws_bounded {
            n_draws *= 4;
            let more = Known::new(task, &shown, n_draws, more_chains.next_u64())?;
            step.bounded_by(&more.examine(tests, extent.n_bounded)?);
        }
        step.demonstrations = n_asked + 1;
        if n_asked < extent.n_questions {
            let begin = cpu_seconds();
            let base = &shown.last().expect("there was a first demonstration").0;
            let asked = known.ask(base, method, n_asked as u64 + 1, rng.next_u64(), &mut rng)?;
            step.choosing_s = cpu_seconds() - begin;
            let at = task.best_m(&asked).expect("candidates have a free place");
            shown.push((asked, at));
            learned = Some(Known::new(task, &shown, extent.draws_after(n_asked + 1), chains.next_u64())?);
        }
        steps.push(step);
    }
    Ok(steps)
}

/// The first demonstration.
pub fn shown_first(task: &Task) -> Option<(Scene, Point)> {
    Some((task.scene.clone(), task.best_m(&task.scene)?))
}
