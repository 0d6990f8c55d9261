//! A lesson about a world, as the node hears of it: what has come so far, and what was made of it.

use crate::node::Output;
use crate::{Settings, WorldInputs, world_lesson, world_question};
use apprentice_msgs::msg::{EvidenceLog, LessonStatus, PolicyBounds, Posterior, TabularWorld, WorldQuery};
use apprentice_msgs::to_cdr;
use exchange::{MAX_ID, World, world_from_message, world_hash};

/// See the module.
#[derive(Default)]
pub(crate) struct Worlds {
    posterior: Option<Box<Posterior>>,
    bounds: Option<Box<PolicyBounds>>,
    world: Option<World>,
    log: Option<Box<EvidenceLog>>,
    /// The state of the lesson that was told last, before a question was added.
    known: Option<LessonStatus>,
    query: Option<Box<WorldQuery>>,
    told: Option<String>,
}

impl Worlds {
    pub fn take_posterior(&mut self, posterior: Box<Posterior>) {
        self.posterior = Some(posterior);
    }

    pub fn take_bounds(&mut self, bounds: Box<PolicyBounds>) {
        self.bounds = Some(bounds);
    }

    pub fn take_log(&mut self, log: Box<EvidenceLog>) {
        self.log = Some(log);
    }

    /// The world that the posterior names is kept, whatever else comes.
    pub fn take_world(&mut self, message: &TabularWorld) -> Vec<Output> {
        let hash = world_hash(message);
        let is_named = |of: &str| self.posterior.as_ref().is_some_and(|posterior| posterior.world.hash == of);
        if self.world.as_ref().is_some_and(|known| known.hash == hash || is_named(&known.hash)) {
            return Vec::new();
        }
        match world_from_message(message) {
            Ok(world) => {
                self.world = Some(world);
                Vec::new()
            }
            Err(error) => {
                let id: String = message.id.chars().take(MAX_ID).collect();
                self.tell(format!("the world '{id}' is ignored: {error}"))
            }
        }
    }

    /// Where the lesson stands and what is asked, when that is news. A question waits for the world and the evidence that it is
    /// about, and the state of the lesson with it.
    pub fn news(&mut self, settings: &Settings) -> Vec<Output> {
        let (Some(posterior), Some(bounds)) = (&self.posterior, &self.bounds) else { return Vec::new() };
        let Some(lesson) = world_lesson(settings, posterior, bounds) else { return Vec::new() };
        if self.known.as_ref().is_some_and(|known| to_cdr(known) == to_cdr(&lesson)) {
            return Vec::new();
        }
        let mut asked = Ok(None);
        if lesson.state == LessonStatus::ASKING && !settings.question_kinds.is_empty() {
            let world = self.world.as_ref().filter(|world| world.hash == posterior.world.hash);
            let log = self.log.as_ref().filter(|log| log.records.len() as u64 >= posterior.revision);
            let (Some(world), Some(log)) = (world, log) else { return Vec::new() };
            asked = world_question(settings, &WorldInputs { posterior, world, log, bounds }, &lesson);
        }
        self.known = Some(lesson.clone());
        self.query = None;
        let mut outputs = Vec::new();
        let lesson = match asked {
            Ok(Some((query, lesson))) => {
                let query = Box::new(query);
                outputs.push(Output::WorldQuery(query.clone()));
                self.query = Some(query);
                lesson
            }
            Ok(None) => lesson,
            Err(reason) => {
                outputs.extend(self.tell(format!("nothing can be asked about the world: {reason}")));
                lesson
            }
        };
        outputs.push(Output::Lesson(lesson));
        outputs
    }

    /// The open question, to be sent again.
    pub fn open(&self) -> Option<Output> {
        self.query.clone().map(Output::WorldQuery)
    }

    /// Says something once, until there is something else to say.
    fn tell(&mut self, text: String) -> Vec<Output> {
        if self.told.as_ref() == Some(&text) {
            return Vec::new();
        }
        self.told = Some(text.clone());
        vec![Output::Warn(text)]
    }
}
