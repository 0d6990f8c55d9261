//! The node as a state machine: posteriors and bounds in, candidates, questions and the lesson's state out.

use crate::worlds::Worlds;
use crate::{Settings, Strategy, asking, wishes, words};
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{
    Candidates, EvidenceLog, LessonStatus, PerformanceBounds, PlacementBound, PlacementQuery, PolicyBounds, Posterior,
    RobustPolicy, TabularWorld, WorldQuery,
};
use exchange::{is_about_a_table, scene_from_message, scene_to_message};
use inquiry::{Choice, Judged, candidates, choose};
use scene::{Field, Grid, Rbf, Scene, best_placement};
use sha2::{Digest, Sha256};

/// Cells per axis on which the favourite place is looked for.
const FAVOURITE_SIDE: usize = 32;

/// What reaches the node.
#[derive(Debug, Clone)]
pub enum Event {
    /// A new (or repeated) posterior.
    Posterior(Box<Posterior>),
    /// Bounds on the candidates.
    Bounds(Box<PerformanceBounds>),
    /// Bounds on policies: in a lesson about a world, what is known of the robot's.
    PolicyBounds(Box<PolicyBounds>),
    /// The robot's policy in a lesson about a world, or why there is none.
    Policy(Box<RobustPolicy>),
    /// A world, perhaps that of the lesson.
    World(Box<TabularWorld>),
    /// Everything accepted so far: what was asked about a world before is in it.
    Evidence(Box<EvidenceLog>),
    /// Time to choose what may follow the open question about a world, as [`Output::LookAhead`] asked for.
    LookAhead,
    /// A tenth of a second has passed.
    Tick,
    /// Time to send the newest outputs again.
    Republish,
}

/// What the node sends.
#[derive(Debug, Clone)]
pub enum Output {
    /// Tables to judge.
    Candidates(Candidates),
    /// The open question.
    Query(Box<PlacementQuery>),
    /// The open question about a world.
    WorldQuery(Box<WorldQuery>),
    /// The node wants [`Event::LookAhead`] as soon as nothing else waits: that takes a while, and the person thinks anyway.
    LookAhead,
    /// Where the lesson stands.
    Lesson(LessonStatus),
    /// Something a person should know.
    Warn(String),
}

/// What is known of the revision at hand.
struct Round {
    posterior: Posterior,
    base: Scene,
    scenes: Vec<Scene>,
    candidates: Candidates,
}

/// See the crate.
pub struct ActiveQuery {
    settings: Settings,
    round: Option<Round>,
    query: Option<Box<PlacementQuery>>,
    lesson: Option<LessonStatus>,
    worlds: Worlds,
}

impl ActiveQuery {
    /// A node that has seen nothing.
    pub fn new(settings: Settings) -> Self {
        Self { settings, round: None, query: None, lesson: None, worlds: Worlds::default() }
    }

    /// Takes one event. Outputs depend on the settings and the messages alone, never on `_now`.
    pub fn step(&mut self, _now: Time, event: Event) -> Vec<Output> {
        match event {
            Event::Posterior(posterior) => self.posterior(*posterior),
            Event::Bounds(bounds) => self.bounds(&bounds),
            Event::PolicyBounds(bounds) => {
                self.worlds.take_bounds(bounds);
                self.world()
            }
            Event::Policy(policy) => {
                self.worlds.take_policy(&policy);
                self.world()
            }
            Event::World(world) => {
                let told = self.worlds.take_world(&world);
                told.into_iter().chain(self.world()).collect()
            }
            Event::Evidence(log) => {
                self.worlds.take_log(log);
                self.world()
            }
            Event::LookAhead => {
                self.worlds.look_ahead(&self.settings);
                Vec::new()
            }
            Event::Tick => self.worlds.tick(&self.settings).into_iter().collect(),
            Event::Republish => self.republish(),
        }
    }

    fn posterior(&mut self, posterior: Posterior) -> Vec<Output> {
        if self.round.as_ref().is_some_and(|round| round.posterior.revision == posterior.revision) {
            return Vec::new();
        }
        // A lesson that is about no table asks nothing about any.
        if !is_about_a_table(&posterior) {
            self.worlds.take_posterior(Box::new(posterior));
            return self.world();
        }
        let base = match scene_from_message(&posterior.scene) {
            Ok(scene) => scene,
            Err(error) => return vec![Output::Warn(format!("posterior {} is ignored: {error}", posterior.revision))],
        };
        let task = match scene_from_message(&posterior.task) {
            Ok(scene) => scene,
            Err(error) => return vec![Output::Warn(format!("posterior {} is ignored: {error}", posterior.revision))],
        };
        // The table that the lesson is about comes last: it is judged with the others, and asked about when they are not.
        let scenes = if posterior.revision == 0 {
            vec![task]
        } else {
            let n = usize::try_from(self.settings.n_candidates).unwrap_or(1);
            let seed = self.settings.seed.unsigned_abs();
            let imagined = candidates(&base, n, seed, posterior.revision, |scene| {
                favourite_is_free(scene, &posterior.map_weights)
            });
            imagined.into_iter().chain([task]).collect()
        };
        let stamp = posterior.header.stamp;
        let candidates = Candidates {
            header: posterior.header.clone(),
            revision: posterior.revision,
            scenes: scenes.iter().map(|scene| scene_to_message(scene, stamp)).collect(),
        };
        self.query = None;
        self.lesson = None;
        self.round = Some(Round { posterior, base, scenes, candidates: candidates.clone() });
        vec![Output::Candidates(candidates)]
    }

    /// Where a lesson about a world stands, when that is news.
    fn world(&mut self) -> Vec<Output> {
        let outputs = self.worlds.news(&self.settings);
        for output in &outputs {
            if let Output::Lesson(lesson) = output {
                self.lesson = Some(lesson.clone());
            }
        }
        outputs
    }

    fn bounds(&mut self, bounds: &PerformanceBounds) -> Vec<Output> {
        let Some(round) = &self.round else { return Vec::new() };
        if bounds.revision != round.posterior.revision || self.lesson.is_some() {
            return Vec::new();
        }
        if bounds.bounds.len() != round.scenes.len() {
            return vec![Output::Warn(format!(
                "bounds of revision {} are ignored: they judge {} tables, {} were asked for",
                bounds.revision,
                bounds.bounds.len(),
                round.scenes.len()
            ))];
        }
        let judged: Vec<Judged> = bounds.bounds.iter().map(judged).collect();
        let epsilon_m = self.settings.epsilon_m;
        let mut lesson = LessonStatus {
            header: round.posterior.header.clone(),
            revision: round.posterior.revision,
            state: LessonStatus::ASKING,
            reason: bounds.reason.clone(),
            query_id: String::new(),
            questions_asked: u32::try_from(round.posterior.n_answers).unwrap_or(u32::MAX),
            demonstrations: u32::try_from(round.posterior.n_demonstrations).unwrap_or(u32::MAX),
            bound_outcome: bounds.outcome,
            bound_m: bounds.bound_m,
            epsilon_m,
            loss_bound: f64::NAN,
            epsilon_loss: f64::NAN,
            misfit_p: f64::NAN,
            ..LessonStatus::default()
        };
        let (mut query, mut warnings) = (None, Vec::new());
        // Without a demonstration there is nothing the person has agreed to, whatever the prior says.
        let choice = if round.posterior.n_demonstrations == 0 { ask_first(&judged) } else { next(&judged, epsilon_m) };
        let wish = wishes::before_the_bound(&self.settings, &round.posterior);
        match (wish, choice) {
            (Some(told), _) => (lesson.state, lesson.reason) = told,
            (None, Choice::Taught { bound_m }) => {
                lesson.state = LessonStatus::TAUGHT;
                lesson.reason =
                    format!("the bound, {:.1} cm, is below ε = {:.1} cm", 100.0 * bound_m, 100.0 * epsilon_m);
            }
            (None, _) if round.posterior.wish == Posterior::FINISH => {
                let known = bounds.outcome == PlacementBound::BOUND && bounds.bound_m.is_finite();
                let bound = format!("the bound, {:.1} cm, is not below", 100.0 * bounds.bound_m);
                let goal = format!("{:.1} cm", 100.0 * epsilon_m);
                lesson.state = LessonStatus::FINISHED;
                lesson.reason = wishes::finished(if known { &bound } else { &bounds.reason }, known, &goal);
            }
            (None, Choice::Nothing) => {
                lesson.state = LessonStatus::GAVE_UP;
                lesson.reason = "there is no free spot for the target on any table I can imagine".into();
            }
            (None, Choice::Ask(_)) if i64::from(lesson.questions_asked) >= self.settings.max_questions => {
                lesson.state = LessonStatus::GAVE_UP;
                lesson.reason = format!(
                    "{} questions were answered and the bound is not below ε = {:.1} cm; raise max_questions or epsilon_m",
                    lesson.questions_asked,
                    100.0 * epsilon_m
                );
            }
            (None, Choice::Ask(largest)) => {
                let (index, warning) = self.table_to_ask(round, &judged, largest);
                warnings.extend(warning);
                let asked = self.ask(round, bounds, index);
                lesson.query_id = asked.id.clone();
                lesson.questions_asked += 1;
                query = Some(asked);
            }
        }
        let mut outputs: Vec<Output> = warnings.into_iter().map(Output::Warn).collect();
        if let Some(query) = query {
            outputs.push(Output::Query(query.clone()));
            self.query = Some(query);
        }
        outputs.push(Output::Lesson(lesson.clone()));
        self.lesson = Some(lesson);
        outputs
    }

    /// The table to ask about when `largest` has the largest bound, and what a person should know about it. The table of the
    /// task, the last one, comes only when no imagined one is worth asking about; then it is asked about.
    fn table_to_ask(&self, round: &Round, judged: &[Judged], largest: usize) -> (usize, Option<String>) {
        let imagined = round.scenes.len() - 1;
        if largest >= imagined || round.posterior.n_demonstrations == 0 {
            return (largest, None);
        }
        let (tables, judged) = (&round.scenes[..imagined], &judged[..imagined]);
        match asking::table_to_ask(&self.settings, &round.posterior, tables, judged, largest) {
            Ok(index) => (index, None),
            Err(error) => {
                let revision = round.posterior.revision;
                let warning = format!("posterior {revision}: the table with the largest bound is asked about: {error}");
                (largest, Some(warning))
            }
        }
    }

    fn ask(&self, round: &Round, bounds: &PerformanceBounds, index: usize) -> Box<PlacementQuery> {
        let bound = &bounds.bounds[index];
        let posterior = &round.posterior;
        let place = if index + 1 == round.scenes.len() {
            "on the table as it is".to_owned()
        } else {
            words::difference(&round.base, &round.scenes[index])
        };
        let is_imagined = index + 1 < round.scenes.len();
        let strategy = if is_imagined { self.settings.strategy } else { Strategy::Var };
        let question = format!("Where does the {} belong {place}?", round.base.target.label);
        Box::new(PlacementQuery {
            header: posterior.header.clone(),
            id: query_id(self.settings.seed, posterior),
            revision: posterior.revision,
            scene: round.candidates.scenes[index].clone(),
            reason: format!("{question} {}", words::why(bound, bounds, posterior.n_demonstrations, strategy)),
            bound_m: bound.bound_m,
            epsilon_m: self.settings.epsilon_m,
            n_candidates: u32::try_from(bounds.bounds.len()).unwrap_or(u32::MAX),
        })
    }

    fn republish(&self) -> Vec<Output> {
        let mut outputs = Vec::new();
        match (&self.round, &self.lesson) {
            (Some(round), None) => outputs.push(Output::Candidates(round.candidates.clone())),
            (_, Some(lesson)) => {
                outputs.extend(self.query.clone().map(Output::Query));
                outputs.extend(self.worlds.open());
                outputs.push(Output::Lesson(lesson.clone()));
            }
            (None, None) => {}
        }
        outputs
    }
}

fn judged(bound: &PlacementBound) -> Judged {
    let known = bound.outcome == PlacementBound::BOUND && bound.bound_m.is_finite();
    Judged { bound_m: known.then_some(bound.bound_m), point_estimate_m: bound.point_estimate_m }
}

/// Whether the place that the MAP reward likes best is free of objects.
///
/// Where an object stands on it, the best places left lie on all sides of that object, nearly as good as each other: such
/// a table says more about the object's size than about what the person wants, and no answer settles it.
fn favourite_is_free(scene: &Scene, map_weights: &[f64]) -> bool {
    let rbf = Rbf::new(scene);
    if map_weights.len() != rbf.n() {
        return true;
    }
    let mut clear = scene.clone();
    for object in &mut clear.objects {
        object.supports = true;
    }
    let field = Field::new(&rbf, &Grid::midpoints(FAVOURITE_SIDE), Some(&clear));
    let favourite = best_placement(&clear, &rbf, &field, map_weights, &mut Vec::new());
    favourite.is_none_or(|favourite| scene.occupied().is_free(scene.metres(favourite.at)))
}

/// What to do next: an imagined table is asked about while one is worth it, then the table of the task, the last one.
/// Imagined tables are new at every revision, so a person who skips a question is asked another.
fn next(judged: &[Judged], epsilon_m: f64) -> Choice {
    let imagined = &judged[..judged.len().saturating_sub(1)];
    match choose(imagined, epsilon_m) {
        Choice::Ask(index) => Choice::Ask(index),
        Choice::Taught { .. } | Choice::Nothing => choose(judged, epsilon_m),
    }
}

/// The first candidate on which the target has a place.
fn ask_first(judged: &[Judged]) -> Choice {
    match judged.iter().position(|j| !j.point_estimate_m.is_nan()) {
        Some(index) => Choice::Ask(index),
        None => Choice::Nothing,
    }
}

/// Unique within a session, since every accepted event makes a new revision; the hash ties it to the evidence.
fn query_id(seed: i64, posterior: &Posterior) -> String {
    let mut hash = Sha256::new();
    hash.update(seed.to_le_bytes());
    hash.update(posterior.revision.to_le_bytes());
    hash.update(posterior.evidence_hash.as_bytes());
    let digest = hash.finalize();
    let short: String = digest.iter().take(4).map(|byte| format!("{byte:02x}")).collect();
    format!("q{}-{short}", posterior.revision)
}
