//! A whole lesson within one process: the nodes' own state machines, fed by hand.

use active_query::ActiveQuery;
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{
    EvidenceReceipt, LessonStatus, PerformanceBounds, PlacementBound, PlacementDemonstration, PlacementQuery,
    Posterior, QueryResponse, TrajectoryPreference,
};
use bus::Arguments;
use demonstrator::{Answer, Comparison, Person, true_error_m};
use exchange::{point_to_message, scene_from_message, scene_to_message};
use performance_bounds::PerformanceBoundsNode;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use reward_posterior::RewardPosterior;
use scene::{Field, Grid, Point, Rbf, Scene, best_placement};
use serde::Serialize;
use std::path::Path;
use thiserror::Error;

/// Why a lesson cannot be held.
#[derive(Debug, Error)]
pub enum LessonError {
    /// The scenario's parameters are wrong.
    #[error("{0}")]
    Scenario(String),
    /// A node said something unexpected.
    #[error("revision {revision}: {what}")]
    Node {
        /// Revision.
        revision: u64,
        /// What was said.
        what: String,
    },
}

/// What was measured at one revision.
#[derive(Debug, Clone, Serialize)]
pub struct Measured {
    /// Demonstrations so far.
    pub demonstrations: u64,
    /// The bound on the worst imagined table, metres; null without one.
    pub bound_m: Option<f64>,
    /// Empirical quantile there, metres.
    pub point_estimate_m: f64,
    /// Mean true error over the test tables, metres.
    pub mean_error_m: f64,
    /// Largest true error over the test tables, metres.
    pub worst_error_m: f64,
    /// Share of test tables on which the true error is at most the bound; null without one.
    pub within_bound: Option<f64>,
    /// R-hat.
    pub rhat: f64,
    /// Smallest bulk effective sample size.
    pub ess_bulk: f64,
}

/// A lesson from beginning to end.
#[derive(Debug, Clone, Serialize)]
pub struct Held {
    /// Seed.
    pub seed: u64,
    /// Whether the bound fell below ε.
    pub taught: bool,
    /// Whether it ended because what was said did not fit together.
    pub doubted: bool,
    /// Comparisons of places drawn at random that were held against the model.
    pub held_out: u32,
    /// Questions asked.
    pub questions: u32,
    /// After each answer.
    pub history: Vec<Measured>,
}

/// The parts of a lesson on one scenario.
pub struct Classroom {
    task: Scene,
    person: demonstrator::Settings,
    posterior: reward_posterior::Settings,
    bounds: performance_bounds::Settings,
    query: active_query::Settings,
}

impl Classroom {
    /// Reads a scenario's parameter file.
    pub fn open(scenario: &Path) -> Result<Self, LessonError> {
        let wrong = |error: &dyn std::fmt::Display| LessonError::Scenario(error.to_string());
        let arguments = ["--ros-args", "--params-file", &scenario.to_string_lossy()].map(String::from);
        let arguments = Arguments::parse(&arguments).map_err(|error| wrong(&error))?;
        let table: simulated_table::Settings = arguments.settings().map_err(|error| wrong(&error))?;
        Ok(Self {
            task: simulated_table::task_scene(&table).map_err(|error| wrong(&error))?,
            person: arguments.settings().map_err(|error| wrong(&error))?,
            posterior: arguments.settings().map_err(|error| wrong(&error))?,
            bounds: arguments.settings().map_err(|error| wrong(&error))?,
            query: arguments.settings().map_err(|error| wrong(&error))?,
        })
    }

    /// Changes what an experiment varies.
    pub fn vary(
        &mut self,
        epsilon_m: Option<f64>,
        max_questions: Option<i64>,
        beta: Option<f64>,
        hold_out_share: Option<f64>,
    ) {
        self.query.hold_out_share = hold_out_share.unwrap_or(self.query.hold_out_share);
        self.query.epsilon_m = epsilon_m.unwrap_or(self.query.epsilon_m);
        self.query.max_questions = max_questions.unwrap_or(self.query.max_questions);
        self.posterior.beta = beta.unwrap_or(self.posterior.beta);
    }

    /// ε of the lessons, metres.
    pub fn epsilon_m(&self) -> f64 {
        self.query.epsilon_m
    }

    /// Holds one lesson; the person answers every question.
    pub fn hold(&self, seed: u64, n_tests: usize) -> Result<Held, LessonError> {
        let signed = i64::try_from(seed).unwrap_or(i64::MAX);
        let person = Person::new(&demonstrator::Settings { seed: signed, ..self.person.clone() });
        // Nobody looks at previews here.
        let settings = reward_posterior::Settings { seed: signed, preview_draws: 0, ..self.posterior.clone() };
        let mut posterior = RewardPosterior::new(settings);
        let mut bounds = PerformanceBoundsNode::new(self.bounds.clone());
        // There is no arm here.
        let asks = active_query::Settings { seed: signed, only_reachable: false, ..self.query.clone() };
        let mut query = ActiveQuery::new(asks);
        let tests = test_tables(&self.task, n_tests, seed);
        let now = Time::default();
        posterior.step(now, reward_posterior::Event::Scene(Box::new(scene_to_message(&self.task, now))));
        let mut history = Vec::new();
        loop {
            let drawn = newest(&mut posterior)?;
            let revision = drawn.revision;
            let unexpected = |what: String| LessonError::Node { revision, what };
            let mut judged = None;
            for output in query.step(now, active_query::Event::Posterior(Box::new(drawn.clone()))) {
                let active_query::Output::Candidates(candidates) = output else {
                    return Err(unexpected(format!("{output:?}")));
                };
                bounds.step(now, performance_bounds::Event::Posterior(Box::new(drawn.clone())));
                for output in bounds.step(now, performance_bounds::Event::Candidates(Box::new(candidates))) {
                    match output {
                        performance_bounds::Output::Bounds(bounds) => judged = Some(bounds),
                        other => return Err(unexpected(format!("{other:?}"))),
                    }
                }
            }
            let judged = judged.ok_or_else(|| unexpected("there are no bounds".into()))?;
            if drawn.n_demonstrations > 0 {
                history.push(self.examine(&person, &tests, &drawn, &judged));
            }
            let (mut asked, mut lesson) = (None, None);
            let evidence = active_query::Event::Evidence(Box::new(posterior.evidence().log()));
            let outputs = query.step(now, evidence).into_iter();
            for output in outputs.chain(query.step(now, active_query::Event::Bounds(judged))) {
                match output {
                    active_query::Output::Query(query) => asked = Some(query),
                    active_query::Output::Lesson(status) => lesson = Some(status),
                    other => return Err(unexpected(format!("{other:?}"))),
                }
            }
            let lesson = lesson.ok_or_else(|| unexpected("there is no state of the lesson".into()))?;
            let Some(asked) = asked else {
                let taught = lesson.state == LessonStatus::TAUGHT;
                let doubted = lesson.state == LessonStatus::MISFIT;
                let held_out = lesson.held_out;
                return Ok(Held { seed, taught, doubted, held_out, questions: lesson.questions_asked, history });
            };
            posterior.step(now, reward_posterior::Event::Query(asked.clone()));
            let event = answer(&person, *asked).map_err(unexpected)?;
            for output in posterior.step(now, event) {
                if let reward_posterior::Output::Receipt(receipt) = output
                    && receipt.outcome != EvidenceReceipt::ACCEPTED
                {
                    return Err(unexpected(receipt.reason));
                }
            }
        }
    }

    fn examine(&self, person: &Person, tests: &[Scene], drawn: &Posterior, judged: &PerformanceBounds) -> Measured {
        let mut scratch = Vec::new();
        let mut errors = Vec::with_capacity(tests.len());
        for scene in tests {
            let rbf = Rbf::new(scene);
            let field = Field::new(&rbf, &Grid::midpoints(64), Some(scene));
            let placed = best_placement(scene, &rbf, &field, &drawn.map_weights, &mut scratch);
            let error = placed.and_then(|placed| true_error_m(person, scene, scene.metres(placed.at)));
            errors.extend(error);
        }
        let bound_m = (judged.outcome == PlacementBound::BOUND).then_some(judged.bound_m);
        let n = errors.len() as f64;
        Measured {
            demonstrations: drawn.n_demonstrations,
            bound_m,
            point_estimate_m: judged.bounds[judged.worst as usize].point_estimate_m,
            mean_error_m: errors.iter().sum::<f64>() / n,
            worst_error_m: errors.iter().copied().fold(0.0, f64::max),
            within_bound: bound_m.map(|bound| errors.iter().filter(|&&error| error <= bound).count() as f64 / n),
            rhat: judged.rhat_max,
            ess_bulk: drawn.ess_bulk_min,
        }
    }
}

fn newest(posterior: &mut RewardPosterior) -> Result<Posterior, LessonError> {
    let revision = posterior.evidence().revision();
    match posterior.step(Time::default(), reward_posterior::Event::Recompute).pop() {
        Some(reward_posterior::Output::Posterior(posterior)) => Ok(*posterior),
        other => Err(LessonError::Node { revision, what: format!("no posterior, but {other:?}") }),
    }
}

fn answer(person: &Person, asked: PlacementQuery) -> Result<reward_posterior::Event, String> {
    let scene = scene_from_message(&asked.scene).map_err(|error| error.to_string())?;
    let id = format!("a-{}", asked.id);
    let skip = |id: String, query_id: String| {
        let response = QueryResponse { id, query_id, ..QueryResponse::default() };
        reward_posterior::Event::Response(Box::new(response))
    };
    if let [first, second] = asked.options.as_slice() {
        let places_m = [first, second].map(|option| Point::new(option.placement.x, option.placement.y));
        let said = person.compare(&asked.id, &scene, places_m).map_err(|error| error.to_string())?;
        let Comparison::Said { answer, second_is_better } = said else { return Ok(skip(id, asked.id)) };
        let [worse, better] = if second_is_better { [first, second] } else { [second, first] };
        return Ok(reward_posterior::Event::Preference(Box::new(TrajectoryPreference {
            id,
            query_id: asked.id.clone(),
            trajectories: vec![worse.trajectory.clone(), better.trajectory.clone()],
            answer,
            ..TrajectoryPreference::default()
        })));
    }
    Ok(match person.answer(&asked.id, &scene).map_err(|error| error.to_string())? {
        Answer::Place(at_m) => reward_posterior::Event::Demonstration(Box::new(PlacementDemonstration {
            id,
            query_id: asked.id,
            scene: asked.scene,
            placement: point_to_message(at_m),
            ..PlacementDemonstration::default()
        })),
        Answer::Skip | Answer::CantTell { .. } => skip(id, asked.id),
    })
}

/// Tables with every object redrawn, uniform among those where objects are whole on the table and clear of each other.
fn test_tables(task: &Scene, n: usize, seed: u64) -> Vec<Scene> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(u64::MAX);
    let mut tables = Vec::with_capacity(n);
    while tables.len() < n {
        let mut scene = Scene { id: format!("test {}", tables.len()), ..task.clone() };
        for object in &mut scene.objects {
            let r = object.shape.bounding_radius_m();
            object.position_m =
                Point::new(rng.random_range(r..=task.width_m - r), rng.random_range(r..=task.depth_m - r));
        }
        let clear = scene.objects.iter().enumerate().all(|(i, a)| {
            let r = a.shape.bounding_radius_m();
            scene.objects.iter().skip(i + 1).all(|b| b.distance_m(a.position_m) > r)
        });
        if clear {
            tables.push(scene);
        }
    }
    tables
}
