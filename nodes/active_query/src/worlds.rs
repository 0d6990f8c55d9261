//! A lesson about a world, as the node hears of it: what has come so far, and what was made of it.

use crate::ahead::Ahead;
use crate::node::Output;
use crate::world_draws::WorldDraws;
use crate::world_fit::{fitted_by, is_judged};
use crate::world_question::{ahead_by, asked_by};
use crate::{Settings, WorldInputs, unjudged, world_lesson};
use apprentice_msgs::msg::{
    EvidenceLog, LessonStatus, PolicyBounds, Posterior, RobustPolicy, TabularWorld, WorldQuery,
};
use apprentice_msgs::to_cdr;
use exchange::{MAX_ID, World, world_from_message, world_hash};
use std::sync::Arc;

/// Ticks in a second.
pub(crate) const TICKS_PER_SECOND: f64 = 10.0;

/// See the module.
#[derive(Default)]
pub(crate) struct Worlds {
    posterior: Option<Box<Posterior>>,
    bounds: Option<Box<PolicyBounds>>,
    world: Option<World>,
    log: Option<Arc<EvidenceLog>>,
    /// The state of the lesson by the bounds that came last.
    known: Option<LessonStatus>,
    /// The same by how well the evidence fits, too; without its question.
    lesson: Option<LessonStatus>,
    /// As it was sent last.
    sent: Option<LessonStatus>,
    /// What that and the question were chosen by.
    draws: Option<WorldDraws>,
    query: Option<Box<WorldQuery>>,
    ahead: Option<Ahead>,
    told: Option<String>,
}

impl Worlds {
    pub fn take_posterior(&mut self, posterior: Box<Posterior>) {
        self.posterior = Some(posterior);
    }

    pub fn take_bounds(&mut self, bounds: Box<PolicyBounds>) {
        self.bounds = Some(bounds);
    }

    /// A policy that nobody will judge stands for its own bounds, unless another of its revision was judged.
    pub fn take_policy(&mut self, policy: &RobustPolicy) {
        let is_judged = self
            .bounds
            .as_ref()
            .is_some_and(|bounds| (bounds.revision, &bounds.evidence_hash) == (policy.revision, &policy.evidence_hash));
        if !is_judged && let Some(bounds) = unjudged(policy) {
            self.bounds = Some(Box::new(bounds));
        }
    }

    pub fn take_log(&mut self, log: Arc<EvidenceLog>) {
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

    /// Where the lesson stands and what is asked, when that is news.
    pub fn news(&mut self, settings: &Settings) -> Vec<Output> {
        let outputs = self.learn(settings);
        for output in &outputs {
            if let Output::Lesson(lesson) = output {
                self.sent = Some(lesson.clone());
            }
        }
        outputs
    }

    /// What is made of what has come. A question waits for the world and the evidence that it is
    /// about, and the state of the lesson with it.
    fn learn(&mut self, settings: &Settings) -> Vec<Output> {
        let (Some(posterior), Some(bounds)) = (&self.posterior, &self.bounds) else { return Vec::new() };
        let Some(known) = world_lesson(settings, posterior, bounds) else { return Vec::new() };
        if self.known.as_ref().is_some_and(|before| to_cdr(before) == to_cdr(&known)) {
            return Vec::new();
        }
        let asks = known.state == LessonStatus::ASKING && !settings.question_kinds.is_empty();
        let (mut lesson, mut asked) = (known.clone(), Ok(None));
        if asks || is_judged(settings, &known) {
            let Some(inputs) = self.inputs() else { return Vec::new() };
            match WorldDraws::new(&inputs) {
                Ok(draws) => {
                    lesson = fitted_by(settings, &inputs, &draws, known.clone()).unwrap_or(lesson);
                    if self.stays(&lesson).is_none() {
                        asked = asked_by(settings, &inputs, &draws, &lesson).map(Some);
                    }
                    let goes_on = lesson.state == LessonStatus::ASKING;
                    self.draws = (settings.next_within_s > 0.0 && goes_on).then_some(draws);
                }
                Err(reason) => asked = Err(reason),
            }
        }
        self.known = Some(known);
        if let Some(with_question) = self.stays(&lesson) {
            // What may follow is chosen by what is known now.
            let open = self.query.as_deref().filter(|open| open.id == with_question.query_id);
            self.ahead = open.cloned().map(Ahead::new).or(self.ahead.take());
            self.lesson = Some(lesson);
            let looks = open.map(|_| Output::LookAhead);
            return std::iter::once(Output::Lesson(with_question)).chain(looks).collect();
        }
        self.lesson = Some(lesson.clone());
        (self.query, self.ahead) = (None, None);
        let mut outputs = Vec::new();
        match asked {
            Ok(Some((Some(query), with_question))) => {
                let query = Box::new(query);
                outputs.push(Output::WorldQuery(query.clone()));
                if settings.next_within_s > 0.0 && settings.questions_ahead > 0 {
                    self.ahead = Some(Ahead::new((*query).clone()));
                }
                self.query = Some(query);
                lesson = with_question;
            }
            Ok(Some((None, known_better))) => lesson = known_better,
            Ok(None) => {}
            Err(reason) => outputs.extend(self.tell(format!("nothing can be asked about the world: {reason}"))),
        }
        outputs.push(Output::Lesson(lesson));
        outputs.extend(self.ahead.as_ref().map(|_| Output::LookAhead));
        outputs
    }

    /// What a question is chosen by, once everything is there.
    fn inputs(&self) -> Option<WorldInputs<'_>> {
        let (posterior, bounds) = (self.posterior.as_ref()?, self.bounds.as_ref()?);
        let world = self.world.as_ref().filter(|world| world.hash == posterior.world.hash)?;
        let log = self.log.as_ref().filter(|log| log.records.len() as u64 >= posterior.revision)?;
        Some(WorldInputs { posterior, world, log, bounds })
    }

    /// The lesson when a question is open that was asked before the posterior came: it stays, since the person may be at it. One
    /// that is of a later revision still is not this posterior's.
    fn stays(&self, lesson: &LessonStatus) -> Option<LessonStatus> {
        let open = self.query.as_deref().filter(|_| lesson.state == LessonStatus::ASKING)?;
        let query = Some(open).filter(|query| query.ahead > 0 && query.revision >= lesson.revision)?;
        let is_its_own = query.revision == lesson.revision;
        Some(LessonStatus {
            query_id: if is_its_own { query.id.clone() } else { String::new() },
            questions_asked: lesson.questions_asked.saturating_add(u32::from(is_its_own)),
            ..lesson.clone()
        })
    }

    /// Chooses what may follow the open question, while the person thinks.
    pub fn look_ahead(&mut self, settings: &Settings) {
        let open = self.ahead.as_ref().and_then(Ahead::bare);
        // Of a large world they fill much memory, and are not needed twice.
        let draws = self.draws.take();
        let (Some(open), Some(lesson), Some(inputs), Some(draws)) = (open, &self.lesson, self.inputs(), draws) else {
            return;
        };
        // A posterior that has come since has draws of its own, and a lesson with them.
        if open.revision != inputs.posterior.revision || lesson.revision != open.revision {
            return;
        }
        let n = usize::try_from(settings.questions_ahead).unwrap_or(0);
        // What cannot be asked was told of when the open question was chosen.
        let open = Some(open).filter(|open| open.ahead > 0);
        let queries = ahead_by(settings, &inputs, &draws, lesson, open, n).unwrap_or_default();
        if let Some(ahead) = &mut self.ahead {
            ahead.follow(queries);
        }
    }

    /// A tick has passed: what is asked because the person has waited long enough.
    pub fn tick(&mut self, settings: &Settings) -> Option<Output> {
        let patience = (settings.next_within_s * TICKS_PER_SECOND).ceil() as u32;
        let next = self.ahead.as_mut()?.tick(self.log.as_ref()?, patience)?;
        let query = Box::new(next);
        self.query = Some(query.clone());
        Some(Output::WorldQuery(query))
    }

    /// Everything that is current, to be sent again.
    pub fn republish(&self) -> Vec<Output> {
        let lesson = self.sent.clone().map(Output::Lesson);
        self.query.clone().map(Output::WorldQuery).into_iter().chain(lesson).collect()
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
