//! The node as a state machine between the topics and the pages.

use crate::answers::Answers;
use crate::arm_picture::{ArmNews, ArmPicture};
use crate::early::Early;
use crate::event::{Event, Output, Recorded, Told};
use crate::evidence::Evidence;
use crate::hub::PageId;
use crate::loading::{new_lesson, said_once_more};
use crate::markers::markers;
use crate::presence::Presence;
use crate::protocol::{
    BoundsView, FromPage, LessonView, NodeView, PROTOCOL, PlanView, PosteriorView, RecordingView, SceneView, Sections,
    ToPage, TrendPoint,
};
use crate::question::{Context, id_of, is_uuid};
use crate::rviz::{Asked, Handles, map};
use crate::settings::Settings;
use crate::tabular::{News, Tabular};
use crate::view::{
    bounds_view, check_options, finite, lesson_view, plan_view, posterior_view, question_view, scene_view, trend_point,
};
use apprentice_msgs::msg::{LessonStatus, PerformanceBounds, PlacementPlan, PlacementQuery, TableScene};
use apprentice_msgs::visualization_msgs::{InteractiveMarkerFeedback, MarkerArray};
use bus::Time;

/// Points of the bound's history kept.
const MAX_TREND: usize = 2000;
/// A page is told that the node is alive this often, nanoseconds.
const TICK_NS: i128 = 2_000_000_000;
/// Of the interactive markers, unique on their topic.
const SERVER_ID: &str = "operator_ui";

/// Which sections have changed.
#[derive(Debug, Clone, Copy, Default)]
struct Changed {
    scene: bool,
    question: bool,
    world_question: bool,
    guess: bool,
    plan: bool,
    lesson: bool,
    bounds: bool,
    posterior: bool,
    answers: bool,
    nodes: bool,
    recordings: bool,
    arm: ArmNews,
    tabular: News,
}

impl Changed {
    const ALL: Self = Self {
        scene: true,
        question: true,
        world_question: true,
        guess: true,
        plan: true,
        lesson: true,
        bounds: true,
        posterior: true,
        answers: true,
        nodes: true,
        recordings: true,
        arm: ArmNews::ALL,
        tabular: News::ALL,
    };
}

/// See the module.
#[derive(Debug)]
pub struct OperatorUi {
    settings: Settings,
    scene: Option<(TableScene, SceneView)>,
    query: Option<(PlacementQuery, SceneView)>,
    lesson: Option<LessonStatus>,
    guess: Option<PlanView>,
    plan: Option<PlanView>,
    bounds: Option<BoundsView>,
    posterior: Option<PosteriorView>,
    trend: Vec<TrendPoint>,
    answers: Answers,
    tabular: Tabular,
    arm: ArmPicture,
    handles: Handles,
    presence: Presence,
    nodes: Vec<NodeView>,
    recordings: Vec<RecordingView>,
    ticked: Option<Time>,
    last_warning: String,
    early: Early,
}

impl OperatorUi {
    /// A node that has heard of nothing yet.
    pub fn new(settings: Settings) -> Self {
        Self {
            settings,
            scene: None,
            query: None,
            lesson: None,
            guess: None,
            plan: None,
            bounds: None,
            posterior: None,
            trend: Vec::new(),
            answers: Answers::default(),
            tabular: Tabular::default(),
            arm: ArmPicture::default(),
            handles: Handles::default(),
            presence: Presence::default(),
            nodes: Vec::new(),
            recordings: Vec::new(),
            ticked: None,
            last_warning: String::new(),
            early: Early::default(),
        }
    }

    /// Takes one event.
    pub fn step(&mut self, now: Time, event: Event) -> Vec<Output> {
        let mut out = Vec::new();
        let mut changed = Changed::default();
        let mut handled = false;
        let was_open = (self.context().is_open(), self.context().is_world_open());
        match event {
            Event::Scene(message) => changed.scene = self.take_scene(*message, &mut out),
            Event::Query(message) => changed.question = self.take_query(*message, &mut out),
            Event::Lesson(message) => {
                changed.lesson = self.lesson.as_ref().map(lesson_view) != Some(lesson_view(&message));
                changed.tabular |= self.tabular.take_lesson(&message);
                self.lesson = Some(*message);
            }
            Event::Bounds(message) => changed.bounds = self.take_bounds(&message),
            Event::Posterior(message) => {
                changed.tabular |= self.tabular.take_posterior(&message);
                changed.posterior = replace(&mut self.posterior, posterior_view(&message));
            }
            Event::World(message) => match self.tabular.take_world(&message) {
                Ok(news) => changed.tabular |= news,
                Err(text) => self.warn(text, &mut out),
            },
            Event::WorldQuery(message) => match self.tabular.take_query(message) {
                Ok(news) => changed.world_question = news,
                Err(text) => self.warn(text, &mut out),
            },
            Event::Policy(message) => match self.tabular.take_policy(&message) {
                Ok(news) => changed.tabular |= news,
                Err(text) => self.warn(text, &mut out),
            },
            Event::Frontier(message) => changed.tabular |= self.tabular.take_frontier(&message),
            Event::PolicyBounds(message) => changed.tabular |= self.tabular.take_bounds(&message),
            Event::ArmModel(message) => match self.arm.take_model(&message) {
                Ok(news) => changed.arm = news,
                Err(text) => self.warn(text, &mut out),
            },
            Event::ArmPose(message) => changed.arm = self.arm.take_pose(&message),
            Event::ArmMotion(message) => match self.arm.take_motion(&message) {
                Ok(news) => changed.arm = news,
                Err(text) => self.warn(text, &mut out),
            },
            Event::Carrying(message) => changed.arm = self.arm.take_carrying(&message),
            Event::Guess(message) => {
                let view = self.checked_plan(&message, &mut out);
                changed.guess = replace(&mut self.guess, view);
            }
            Event::Plan(message) => {
                let view = self.checked_plan(&message, &mut out);
                changed.plan = replace(&mut self.plan, view);
            }
            Event::Receipt(message) => {
                let (meant, orphan) = self.answers.receipt(&message);
                changed.answers = meant;
                out.extend(orphan.map(|reason| tell(None, &ToPage::Refused { id: Some(message.id), reason })));
            }
            Event::Evidence(message) => changed.answers = self.answers.log(&message),
            Event::Heartbeat(message) => self.presence.hear(&now, *message),
            Event::Joined(page) => {
                let sections = self.sections(Changed::ALL);
                out.push(tell(Some(page), &ToPage::State { protocol: PROTOCOL, sections }));
            }
            Event::Recordings(found) => {
                self.recordings = found;
                changed.recordings = true;
            }
            Event::Recorded(found) => {
                changed.answers = true;
                out.extend(self.take_up(now, *found));
            }
            Event::Said(page, text) => match serde_json::from_str(&text) {
                Ok(command) => self.early.add(now, page, command),
                Err(error) => {
                    let reason = format!("the page sent no command: {error}");
                    out.push(tell(Some(page), &ToPage::Refused { id: None, reason }));
                }
            },
            // While something is slid it is told of many times a second; what counts is where it is let go.
            Event::Handled(feedback, _) if feedback.event_type == InteractiveMarkerFeedback::POSE_UPDATE => {}
            Event::Handled(feedback, id) => {
                handled = true;
                changed.answers = self.take_feedback(&now, &feedback, &id, &mut out);
            }
            Event::Tick => out.extend(self.tick(&now)),
        }
        let mut early = std::mem::take(&mut self.early);
        let ready = early.ready(&now, &self.context());
        self.early = early;
        for (page, command) in ready {
            let id = id_of(&command).chars().take(128).collect();
            match self.carry_out(&now, command, &mut out) {
                Ok(news) => {
                    changed.answers = true;
                    changed.tabular |= news;
                }
                Err(reason) => out.push(tell(Some(page), &ToPage::Refused { id: Some(id), reason })),
            }
        }
        let nodes = self.presence.view(&now);
        changed.nodes = nodes != self.nodes;
        self.nodes = nodes;
        changed.question |= was_open.0 != self.context().is_open();
        changed.world_question |= was_open.1 != self.context().is_world_open();
        out.extend(self.answers.due(&now).into_iter().map(|evidence| match evidence {
            Evidence::Demonstration(message) => Output::Demonstration(message),
            Evidence::Actions(message) => Output::Actions(message),
            Evidence::Critique(message) => Output::Critique(message),
            Evidence::Comparison(message) => Output::Comparison(message),
            Evidence::History(message) => Output::History(message),
            Evidence::Retraction(message) => Output::Retraction(message),
            Evidence::Response(message) => Output::Response(message),
        }));
        out.extend(self.tabular.due(&now).map(|message| Output::Preference(Box::new(message))));
        let sections = self.sections(changed);
        if *sections != Sections::default() {
            out.push(tell(None, &ToPage::State { protocol: PROTOCOL, sections }));
        }
        let is_asked_anew = changed.question || changed.world_question;
        let is_drawn_anew =
            changed.scene || changed.guess || changed.plan || changed.bounds || changed.tabular.is_drawn();
        if is_asked_anew || is_drawn_anew {
            out.extend(self.markers().map(|message| Output::Markers(Box::new(message))));
        }
        if is_asked_anew || handled {
            out.extend(self.refresh_handles());
        }
        out
    }

    fn context(&self) -> Context<'_> {
        Context {
            source: &self.settings.source,
            scene: self.scene.as_ref().map(|(message, _)| message),
            query: self.query.as_ref().map(|(message, _)| message),
            world_query: self.tabular.query(),
            lesson: self.lesson.as_ref(),
            answers: &self.answers,
        }
    }

    fn take_scene(&mut self, message: TableScene, out: &mut Vec<Output>) -> bool {
        match scene_view(&message) {
            Ok(view) => {
                let changed = self.scene.as_ref().map(|(_, before)| before) != Some(&view);
                self.scene = Some((message, view));
                changed
            }
            Err(error) => {
                self.warn(format!("the table cannot be shown: {error}"), out);
                false
            }
        }
    }

    fn take_query(&mut self, message: PlacementQuery, out: &mut Vec<Output>) -> bool {
        match scene_view(&message.scene)
            .map_err(|error| error.to_string())
            .and_then(|view| check_options(&message, view))
        {
            // The copies that are sent again may differ in their stamps only; NaN differs even from itself.
            Ok(view) => {
                let before = self.query.as_ref().map(|(m, v)| question_view(m, v.clone(), true));
                let changed = before != Some(question_view(&message, view.clone(), true));
                self.query = Some((message, view));
                changed
            }
            Err(error) => {
                self.warn(format!("question '{}' cannot be shown: {error}", message.id), out);
                false
            }
        }
    }

    fn take_bounds(&mut self, message: &PerformanceBounds) -> bool {
        // An earlier revision than the last one begins a new session; the same one replaces its point.
        self.trend.retain(|point| point.revision < message.revision);
        self.trend.push(trend_point(message));
        if self.trend.len() > MAX_TREND {
            self.trend.remove(0);
        }
        replace(&mut self.bounds, bounds_view(message))
    }

    fn checked_plan(&mut self, message: &PlacementPlan, out: &mut Vec<Output>) -> PlanView {
        let (view, complaint) = plan_view(message);
        if let Some(complaint) = complaint {
            self.warn(complaint, out);
        }
        view
    }

    /// Carries out a command, or says why not.
    fn carry_out(&mut self, now: &Time, command: FromPage, out: &mut Vec<Output>) -> Result<News, String> {
        match &command {
            FromPage::Caution { id, lambda } => {
                return self.tabular.say(now, &self.settings.source, id, *lambda);
            }
            FromPage::Recordings { .. } => {
                out.push(Output::LookUp);
                return Ok(News::NONE);
            }
            FromPage::Load { id, name } if is_uuid(id) => {
                if self.answers.knows(id) {
                    return Ok(News::NONE);
                }
                if !self.recordings.iter().any(|known| known.name == *name) {
                    return Err("there is no such recording".into());
                }
                out.push(Output::Read { id: id.clone(), name: name.clone() });
                return Ok(News::NONE);
            }
            _ => {}
        }
        if let Some(evidence) = self.context().evidence(now, command)? {
            self.answers.add(evidence)?;
        }
        Ok(News::NONE)
    }

    /// What is asked, for those who show it as interactive markers.
    fn asked(&self) -> Asked<'_> {
        let context = self.context();
        if let Some((query, view)) = self.query.as_ref().filter(|_| context.is_open()) {
            return Asked::Table(query, view);
        }
        match (self.tabular.query().filter(|_| context.is_world_open()), self.tabular.world()) {
            (Some(query), Some(world)) => Asked::World(query, world, &self.settings.world_frame),
            _ => Asked::Nothing,
        }
    }

    /// Takes what a person did to an interactive marker: whether that said something. What cannot be meant is told where they look.
    fn take_feedback(
        &mut self,
        now: &Time,
        feedback: &InteractiveMarkerFeedback,
        id: &str,
        out: &mut Vec<Output>,
    ) -> bool {
        let mut handles = std::mem::take(&mut self.handles);
        let done = match handles.take(self.asked(), feedback, id) {
            Ok(None) => Ok(false),
            Ok(Some(command)) => self.carry_out(now, command, out).map(|_| true),
            Err(reason) => Err(reason),
        };
        if let Err(reason) = &done {
            handles.hint(reason);
        }
        self.handles = handles;
        done == Ok(true)
    }

    /// What those who show interactive markers are to be told.
    fn refresh_handles(&mut self) -> Option<Output> {
        let mut handles = std::mem::take(&mut self.handles);
        let update = handles.refresh(self.asked(), SERVER_ID);
        self.handles = handles;
        update.map(|update| Output::Handles { update: Box::new(update), all: self.handles.all().to_vec() })
    }

    /// Begins a new lesson with what was said in a recording.
    fn take_up(&mut self, now: Time, found: Recorded) -> Option<Output> {
        let Recorded { id, name, log } = found;
        // A page that repeats its command while the recording is being read has it read twice.
        if self.answers.knows(&id) {
            return None;
        }
        let pieces = log.and_then(|log| said_once_more(&id, now, &log));
        let begin = new_lesson(&id, now, &self.settings.source, &name);
        let refused = pieces.and_then(|pieces| self.answers.take_up(begin, pieces)).err()?;
        Some(tell(None, &ToPage::Refused { id: Some(id), reason: format!("'{name}' cannot be taken up: {refused}") }))
    }

    fn tick(&mut self, now: &Time) -> Option<Output> {
        let due = self.ticked.as_ref().is_none_or(|ticked| now.nanoseconds_since(ticked) >= TICK_NS);
        due.then(|| {
            self.ticked = Some(*now);
            tell(None, &ToPage::Tick)
        })
    }

    /// Logs a complaint and shows it, unless it is the same as the last.
    fn warn(&mut self, text: String, out: &mut Vec<Output>) {
        if text != self.last_warning {
            self.last_warning.clone_from(&text);
            out.push(tell(None, &ToPage::Notice { text: text.clone() }));
            out.push(Output::Warn(text));
        }
    }

    fn sections(&self, changed: Changed) -> Box<Sections> {
        let question = || {
            let (message, scene) = self.query.as_ref()?;
            Some(question_view(message, scene.clone(), self.context().is_open()))
        };
        let lesson = || -> Option<LessonView> { self.lesson.as_ref().map(lesson_view) };
        let epsilon_m = || {
            let lesson = self.lesson.as_ref().and_then(|lesson| finite(lesson.epsilon_m));
            lesson.or(self.query.as_ref().and_then(|(query, _)| finite(query.epsilon_m)))
        };
        let trend = || {
            let epsilon_m = epsilon_m();
            self.trend.iter().map(|point| TrendPoint { epsilon_m, ..point.clone() }).collect()
        };
        let mut sections = Box::new(Sections {
            scene: changed.scene.then(|| self.scene.as_ref().map(|(_, view)| view.clone())),
            question: changed.question.then(question),
            world_question: changed.world_question.then(|| self.tabular.question(self.context().is_world_open())),
            guess: changed.guess.then(|| self.guess.clone()),
            plan: changed.plan.then(|| self.plan.clone()),
            lesson: changed.lesson.then(lesson),
            bounds: changed.bounds.then(|| self.bounds.clone()),
            posterior: changed.posterior.then(|| self.posterior.clone()),
            trend: (changed.bounds || changed.lesson).then(trend),
            answers: changed.answers.then(|| self.answers.views()),
            nodes: changed.nodes.then(|| self.nodes.clone()),
            recordings: changed.recordings.then(|| self.recordings.clone()),
            ..Sections::default()
        });
        self.arm.fill(changed.arm, &mut sections);
        self.tabular.fill(changed.tabular, &mut sections);
        sections
    }

    /// What there is to see for RViz: the table in front of the robot, the question's while one is open, else the task's; or the
    /// map of a world.
    fn markers(&self) -> Option<MarkerArray> {
        let context = self.context();
        if let Some((query, view)) = self.query.as_ref().filter(|_| context.is_open()) {
            let guess = self.guess.as_ref().filter(|guess| guess.query_id == query.id);
            return Some(markers(view, Some(query), guess, self.bounds.as_ref()));
        }
        if let Some((_, view)) = &self.scene {
            return Some(markers(view, None, self.plan.as_ref(), self.bounds.as_ref()));
        }
        let query = self.tabular.query().filter(|_| context.is_world_open());
        self.tabular.world().map(|world| map(world, self.tabular.policy(), query, &self.settings.world_frame))
    }
}

/// Stores a value and says whether it is new.
fn replace<T: PartialEq>(place: &mut Option<T>, value: T) -> bool {
    let changed = place.as_ref() != Some(&value);
    *place = Some(value);
    changed
}

fn tell(to: Option<PageId>, message: &ToPage) -> Output {
    let text = serde_json::to_string(message).expect("the protocol's types have string keys only");
    Output::Told(Told { to, text })
}
