//! A lesson about a table, as the node hears of it: the tables that it imagined, and what was made of the bounds on them.

use crate::node::Output;
use crate::question_id::{short_hash, table_query_id};
use crate::reach::{Reach, is_in_reach};
use crate::settings::Strategy;
use crate::table_draws::DrawnRewards;
use crate::table_fit::{fitted, is_judged};
use crate::table_lesson::{judged, pieces, table_lesson};
use crate::table_question::{Subject, Tables, subject};
use crate::{Settings, fit_words, words};
use apprentice_msgs::geometry_msgs;
use apprentice_msgs::msg::{
    Candidates, EvidenceLog, FeatureTrajectory, LessonStatus, PerformanceBounds, PlacementOption, PlacementQuery,
    Posterior, TableReach,
};
use exchange::{scene_from_message, scene_to_message};
use inquiry::{Choice, candidates};
use scene::{Field, Grid, Point, Rbf, Scene, best_placement};
use std::sync::Arc;

/// Cells per axis on which the favourite place is looked for.
const FAVOURITE_SIDE: usize = 32;

/// What is known of the revision at hand.
struct Round {
    posterior: Posterior,
    base: Scene,
    scenes: Vec<Scene>,
    reach: Option<Reach>,
    candidates: Candidates,
    bounds: Option<Box<PerformanceBounds>>,
}

/// See the module.
#[derive(Default)]
pub(crate) struct TableLesson {
    reach: Option<Reach>,
    /// A posterior that waits to be told what the arm reaches.
    waiting: Option<Box<Posterior>>,
    round: Option<Round>,
    log: Option<Arc<EvidenceLog>>,
    query: Option<Box<PlacementQuery>>,
    lesson: Option<LessonStatus>,
}

impl TableLesson {
    /// Whether this is the revision at hand.
    pub fn is_at(&self, revision: u64) -> bool {
        let known = self.waiting.as_deref().or(self.round.as_ref().map(|round| &round.posterior));
        known.is_some_and(|known| known.revision == revision)
    }

    /// Takes what the arm reaches; what waited for it goes on.
    pub fn take_reach(&mut self, settings: &Settings, message: TableReach) -> Vec<Output> {
        let reach = match Reach::new(message) {
            Ok(reach) => reach,
            Err(error) => return vec![Output::Warn(format!("what the arm reaches is ignored: {error}"))],
        };
        if self.reach.as_ref() == Some(&reach) {
            return Vec::new();
        }
        let unknown = reach.unknown().filter(|_| settings.only_reachable);
        let told =
            unknown.map(|reason| Output::Warn(format!("tables are asked about that may be out of reach: {reason}")));
        let waited = self.waiting.take_if(|posterior| reach.is_of(&posterior.task));
        self.reach = Some(reach);
        let waited = waited.map(|posterior| self.take_posterior(settings, *posterior));
        told.into_iter().chain(waited.unwrap_or_default()).collect()
    }

    pub fn take_log(&mut self, settings: &Settings, log: Arc<EvidenceLog>) -> Vec<Output> {
        self.log = Some(log);
        self.news(settings)
    }

    /// Imagines tables for a new revision, to be judged.
    pub fn take_posterior(&mut self, settings: &Settings, posterior: Posterior) -> Vec<Output> {
        let scenes =
            scene_from_message(&posterior.scene).and_then(|base| Ok((base, scene_from_message(&posterior.task)?)));
        let (base, task) = match scenes {
            Ok(scenes) => scenes,
            Err(error) => return vec![Output::Warn(format!("posterior {} is ignored: {error}", posterior.revision))],
        };
        let reach = self.reach.as_ref().filter(|reach| settings.only_reachable && reach.is_of(&posterior.task));
        if settings.only_reachable && reach.is_none() {
            let waits = "waiting for placement_planner to tell what the arm reaches of the table (only_reachable)";
            let is_new = self.waiting.is_none();
            (self.query, self.lesson, self.round) = (None, None, None);
            self.waiting = Some(Box::new(posterior));
            return is_new.then(|| Output::Warn(waits.to_owned())).into_iter().collect();
        }
        self.waiting = None;
        // The table that the lesson is about comes last: it is judged with the others, and asked about when they are not.
        let scenes = if posterior.revision == 0 {
            vec![task]
        } else {
            let n = usize::try_from(settings.n_candidates).unwrap_or(1);
            let seed = settings.seed.unsigned_abs();
            let is_sensible = |scene: &Scene| favourite_is_free(scene, reach, &posterior.map_weights);
            let imagined = candidates(&base, n, seed, posterior.revision, is_sensible);
            imagined.into_iter().chain([task]).collect()
        };
        let stamp = posterior.header.stamp;
        let candidates = Candidates {
            header: posterior.header.clone(),
            revision: posterior.revision,
            robot_hash: reach.map_or_else(String::new, |reach| reach.robot_hash().to_owned()),
            scenes: scenes.iter().map(|scene| scene_to_message(scene, stamp)).collect(),
        };
        (self.query, self.lesson) = (None, None);
        let reach = reach.cloned();
        self.round = Some(Round { posterior, base, scenes, reach, candidates: candidates.clone(), bounds: None });
        vec![Output::Candidates(candidates)]
    }

    pub fn take_bounds(&mut self, settings: &Settings, bounds: Box<PerformanceBounds>) -> Vec<Output> {
        let Some(round) = &mut self.round else { return Vec::new() };
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
        round.bounds = Some(bounds);
        self.news(settings)
    }

    /// Where the lesson stands and what is asked, once everything is there that this depends on.
    fn news(&mut self, settings: &Settings) -> Vec<Output> {
        let Some(round) = &self.round else { return Vec::new() };
        let Some(bounds) = round.bounds.as_deref().filter(|_| self.lesson.is_none()) else { return Vec::new() };
        let posterior = &round.posterior;
        let judged = judged(bounds);
        let (mut lesson, choice) = table_lesson(settings, posterior, bounds, &judged);
        let (mut query, mut warnings) = (None, Vec::new());
        let mut warn =
            |reason: &str| warnings.push(Output::Warn(format!("posterior {}: {reason}", posterior.revision)));
        let draws = DrawnRewards::new(posterior);
        if is_judged(settings, posterior, &lesson) {
            let Some(log) = self.log.as_deref().filter(|log| log.records.len() as u64 >= posterior.revision) else {
                return Vec::new();
            };
            let fit = draws.as_ref().map_err(Clone::clone).and_then(|draws| {
                let fit = fitted(settings, posterior, log, draws, bounds.delta, lesson.clone());
                fit.map_err(|error| error.to_string())
            });
            match fit {
                Ok(fitted) => lesson = fitted,
                Err(reason) => warn(&format!("what was said is not held against the model: {reason}")),
            }
        }
        if lesson.state == LessonStatus::ASKING {
            let last = round.scenes.len() - 1;
            let tables = Tables {
                scenes: &round.scenes,
                reach: round.reach.as_ref(),
                judged: &judged,
                largest: if let Choice::Ask(index) = choice { index } else { last },
                is_taught_anything: pieces(posterior) > 0,
                must_confirm: lesson.to_confirm > 0,
                revision: posterior.revision,
            };
            let asked = subject(settings, &draws, &tables).unwrap_or_else(|reason| {
                warn(&format!("the table with the largest bound is asked about: {reason}"));
                Some(Subject::plain(tables.largest))
            });
            // A gain that was not reckoned is not below anything.
            let per_second = asked.as_ref().and_then(|asked| asked.gain).map_or(f64::NAN, |[_, per_second]| per_second);
            if per_second < settings.least_gain_per_second {
                lesson.state = LessonStatus::GAVE_UP;
                lesson.reason = fit_words::not_worth_it(per_second, settings.least_gain_per_second);
            } else if let Some(asked) = asked {
                let asked = message(settings, round, bounds, &asked);
                lesson.query_id = asked.id.clone();
                lesson.questions_asked = lesson.questions_asked.saturating_add(1);
                query = Some(Box::new(asked));
            }
        }
        let mut outputs = warnings;
        outputs.extend(query.clone().map(Output::Query));
        outputs.push(Output::Lesson(lesson.clone()));
        (self.query, self.lesson) = (query, Some(lesson));
        outputs
    }

    /// Everything that is current, to be sent again.
    pub fn republish(&self) -> Vec<Output> {
        match (&self.round, &self.lesson) {
            (Some(round), None) => vec![Output::Candidates(round.candidates.clone())],
            (_, Some(lesson)) => {
                let query = self.query.clone().map(Output::Query);
                query.into_iter().chain([Output::Lesson(lesson.clone())]).collect()
            }
            (None, None) => Vec::new(),
        }
    }
}

/// The message about a question.
fn message(settings: &Settings, round: &Round, bounds: &PerformanceBounds, asked: &Subject) -> PlacementQuery {
    let (posterior, table) = (&round.posterior, asked.table);
    let (bound, scene) = (&bounds.bounds[table], &round.scenes[table]);
    let is_imagined = table + 1 < round.scenes.len();
    let place = if is_imagined { words::difference(&round.base, scene) } else { "on the table as it is".to_owned() };
    let question = words::question(&round.base.target.label, &place, asked.places.is_some());
    let why = if asked.is_held_out {
        words::HELD_OUT.to_owned()
    } else {
        let strategy = if is_imagined { settings.strategy } else { Strategy::Var };
        words::why(bound, bounds, pieces(posterior), strategy)
    };
    let id = table_query_id(posterior.revision, asked.is_held_out, &short_hash(settings.seed, posterior));
    let rbf = Rbf::new(scene);
    let option = |(at, name): (&Point, &str)| {
        let at_m = scene.metres(*at);
        PlacementOption {
            placement: geometry_msgs::Point { x: at_m.x, y: at_m.y, z: 0.0 },
            trajectory: FeatureTrajectory { id: format!("{id}-{name}"), features: rbf.features(*at) },
        }
    };
    PlacementQuery {
        header: posterior.header.clone(),
        revision: posterior.revision,
        scene: round.candidates.scenes[table].clone(),
        reason: format!("{question} {why}"),
        bound_m: bound.bound_m,
        epsilon_m: settings.epsilon_m,
        n_candidates: u32::try_from(bounds.bounds.len()).unwrap_or(u32::MAX),
        options: asked.places.iter().flatten().zip(["a", "b"]).map(option).collect(),
        gain: asked.gain.map_or(f64::NAN, |[gain, _]| gain),
        gain_per_second: asked.gain.map_or(f64::NAN, |[_, per_second]| per_second),
        held_out: asked.is_held_out,
        id,
    }
}

/// Whether the place that the MAP reward likes best is free of objects, and in reach.
///
/// Where an object stands on it, the best places left lie on all sides of that object, nearly as good as each other: such
/// a table says more about the object's size than about what the person wants, and no answer settles it.
fn favourite_is_free(scene: &Scene, reach: Option<&Reach>, map_weights: &[f64]) -> bool {
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
    favourite.is_none_or(|best| scene.occupied().is_free(scene.metres(best.at)) && is_in_reach(reach, best.at))
}
