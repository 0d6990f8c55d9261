//! What happens in a lesson, one plain sentence each.

use crate::world_story::WorldStory;
use crate::{Kind, Topic};
use apprentice_msgs::action::PlaceObjectResult;
use apprentice_msgs::geometry_msgs::Point;
use apprentice_msgs::msg::{
    Carrying, EvidenceLog, EvidenceRecord, LessonStatus, PerformanceBounds, PlacementBound, PlacementOption,
    PlacementPlan, PlacementQuery, QueryResponse, TableScene, TrajectoryPreference,
};
use exchange::motion_seconds;

/// Cells of the bar that shows a bound.
const BAR: usize = 24;
/// Places that were offered and are remembered.
const MAX_OFFERED: usize = 16;
/// Longest text of others that goes into a sentence, characters.
const MAX_TEXT: usize = 160;

/// Follows a lesson; the same thing said twice is told once.
#[derive(Debug, Default)]
pub struct Story {
    table: Option<TableScene>,
    questions: Vec<String>,
    /// The scene of the newest question: the next one usually differs from it in one object.
    asked: Option<TableScene>,
    /// The newest question, which is told after the bound that it comes from.
    held: Option<(u64, String)>,
    /// The places that the newest questions offered.
    offered: Vec<Offered>,
    told_evidence: Option<u64>,
    bounds: Option<PerformanceBounds>,
    lesson: Option<LessonStatus>,
    told_bound: Option<u64>,
    told_state: Option<(u8, u64)>,
    told_plan: Option<u64>,
    told_carrying: Option<(u64, String)>,
    widest_m: f64,
    world: WorldStory,
}

impl Story {
    /// The sentences that this adds to the story.
    pub fn tell(&mut self, topic: &Topic) -> Vec<(Kind, String)> {
        // An answer comes after its question, and a question after the one before, whatever else is still on its way.
        let mut lines: Vec<_> = match topic {
            Topic::Query(query) if !self.questions.contains(&query.id) => self.release(u64::MAX).into_iter().collect(),
            Topic::Evidence(_) => self.release(u64::MAX).into_iter().collect(),
            _ => Vec::new(),
        };
        match topic {
            Topic::Scene(scene) => self.table = Some(scene.clone()),
            Topic::Query(query) => self.hold(query),
            Topic::Evidence(log) => lines.extend(self.answers(log)),
            Topic::Bounds(bounds) => {
                self.bounds = Some(bounds.clone());
                lines.extend(self.bound_and_state());
            }
            Topic::Lesson(lesson) if lesson.epsilon_loss.is_finite() && lesson.epsilon_loss > 0.0 => {
                lines.extend(self.world.lesson(lesson));
            }
            Topic::Lesson(lesson) => {
                self.lesson = Some(lesson.clone());
                lines.extend(self.bound_and_state());
            }
            Topic::Plan(plan) => lines.extend(self.plan(plan)),
            Topic::Carrying(carrying) => lines.extend(self.carrying(carrying)),
            Topic::World(world) => lines.extend(self.world.world(world)),
            Topic::WorldQuery(query) => lines.extend(self.world.query(query)),
            Topic::Policy(policy) => lines.extend(self.world.policy(policy)),
            Topic::Receipt(_) => {}
        }
        lines.extend(self.told_bound.and_then(|revision| self.release(revision)));
        lines
    }

    /// Keeps a question that is new.
    fn hold(&mut self, query: &PlacementQuery) {
        if self.questions.contains(&query.id) {
            return;
        }
        self.questions.push(query.id.clone());
        let before = self.asked.as_ref().or(self.table.as_ref());
        let change = before.map(|before| moved(before, &query.scene)).unwrap_or_default();
        let is_real = self.table.as_ref().is_some_and(|table| moved(table, &query.scene).is_empty());
        let when = match (is_real, change.is_empty()) {
            (true, _) => " on the table as it is".to_owned(),
            (false, true) => " on the same table".to_owned(),
            (false, false) => format!(" if {change}"),
        };
        self.asked = Some(query.scene.clone());
        let risk = if query.bound_m.is_finite() {
            format!("worst case there {}", centimetres(query.bound_m))
        } else {
            "no bound there yet".to_owned()
        };
        let number = self.questions.len();
        let target = short(&query.scene.target.label);
        let question = match query.options.as_slice() {
            [a, b] => {
                let two = [(a, "A"), (b, "B")].map(|(option, name)| Offered::new(option, name));
                let places: Vec<String> = two.iter().map(Offered::to_string).collect();
                self.offered.drain(..(self.offered.len() + 2).saturating_sub(MAX_OFFERED));
                self.offered.extend(two);
                format!("which is better for the {target}{when}, {}?", places.join(" or "))
            }
            _ => format!("where does the {target} belong{when}?"),
        };
        self.held = Some((query.revision, format!("{number:<3} {question}  {risk}")));
    }

    /// The held question, if it comes from this revision or an earlier one.
    fn release(&mut self, known: u64) -> Option<(Kind, String)> {
        self.held.take_if(|(revision, _)| *revision <= known).map(|(_, text)| (Kind::Question, text))
    }

    fn answers(&mut self, log: &EvidenceLog) -> Vec<(Kind, String)> {
        let newest = log.records.iter().map(|record| record.sequence).max().unwrap_or(0);
        let told = self.told_evidence.replace(newest.max(self.told_evidence.unwrap_or(0)));
        if told.is_none() && log.records.len() > 1 {
            // The next question differs from the newest table that was shown.
            let shown = log.records.iter().rev().find_map(|record| record.demonstration.first());
            self.asked = shown.map(|shown| shown.scene.clone()).or(self.asked.take());
            return vec![(Kind::Answer, format!("{newest:<3} answers and corrections are there already"))];
        }
        let told = told.unwrap_or(0);
        let new = log.records.iter().filter(|record| record.sequence > told);
        new.map(|record| (Kind::Answer, format!("{:<3} {}", record.sequence, said(record, &self.offered)))).collect()
    }

    /// The bound and the lesson's state come on two topics, in either order; they are told once both are there.
    fn bound_and_state(&mut self) -> Vec<(Kind, String)> {
        let (Some(bounds), Some(lesson)) = (&self.bounds, &self.lesson) else { return Vec::new() };
        let mut lines = Vec::new();
        if bounds.revision == lesson.revision && self.told_bound != Some(bounds.revision) {
            self.told_bound = Some(bounds.revision);
            if bounds.bound_m.is_finite() {
                self.widest_m = self.widest_m.max(bounds.bound_m);
            }
            lines.push((Kind::Bound, bound_sentence(bounds, lesson.epsilon_m, self.widest_m)));
        }
        // An undo that reaches the same state again is a new revision, and told again.
        let state = (lesson.state, lesson.revision);
        if lesson.state == LessonStatus::ASKING {
            self.told_state = None;
        } else if self.told_state != Some(state) {
            self.told_state = Some(state);
            lines.push((Kind::Lesson, end_sentence(lesson)));
        }
        lines
    }

    fn plan(&mut self, plan: &PlacementPlan) -> Option<(Kind, String)> {
        if !plan.query_id.is_empty() || !plan.inside_bound || self.told_plan == Some(plan.revision) {
            return None;
        }
        self.told_plan = Some(plan.revision);
        let target = self.table.as_ref().map_or("target".to_owned(), |table| short(&table.target.label));
        if plan.outcome != PlacementPlan::PLANNED {
            return Some((Kind::Plan, format!("    no way to place the {target}: {}", short(&plan.reason))));
        }
        let at = &plan.robust_placement;
        let all_s = motion_seconds(plan);
        Some((Kind::Plan, format!("    the {target} goes to ({:.2}, {:.2}) m; the arm needs {all_s:.1} s", at.x, at.y)))
    }

    /// Each step once, and how it ended.
    fn carrying(&mut self, carrying: &Carrying) -> Option<(Kind, String)> {
        let step = Some((carrying.revision, carrying.description.clone()));
        if std::mem::replace(&mut self.told_carrying, step.clone()) == step {
            return None;
        }
        let target = self.table.as_ref().map_or("target".to_owned(), |table| short(&table.target.label));
        let at = &carrying.placement;
        let words = short(&carrying.description);
        Some((
            Kind::Plan,
            match (carrying.over, carrying.outcome) {
                (false, _) => format!("    {words}"),
                (true, PlaceObjectResult::DONE) => format!("    the {target} stands at ({:.2}, {:.2}) m", at.x, at.y),
                (true, _) => format!("    the {target} was not put there: {words}"),
            },
        ))
    }
}

/// "plate_2 moves to (0.31, 0.72) m and …": the objects that stand elsewhere than on the table.
fn moved(table: &TableScene, scene: &TableScene) -> String {
    let labels: Vec<&str> = scene.objects.iter().map(|object| object.label.as_str()).collect();
    let elsewhere = scene.objects.iter().filter(|object| {
        let before = table.objects.iter().find(|known| known.id == object.id);
        before.is_none_or(|known| known.pose.position != object.pose.position)
    });
    let sentences = elsewhere.map(|object| {
        let unique = labels.iter().filter(|label| **label == object.label).count() == 1;
        let name = if unique { format!("the {}", short(&object.label)) } else { short(&object.id) };
        format!("{name} moves to ({:.2}, {:.2}) m", object.pose.position.x, object.pose.position.y)
    });
    sentences.collect::<Vec<_>>().join(" and ")
}

/// A place that a question offers: "A (0.50, 0.50) m".
#[derive(Debug)]
struct Offered {
    /// Of its trajectory.
    id: String,
    name: &'static str,
    at: Point,
}

impl Offered {
    fn new(option: &PlacementOption, name: &'static str) -> Self {
        Self { id: option.trajectory.id.clone(), name, at: option.placement }
    }
}

impl std::fmt::Display for Offered {
    fn fmt(&self, to: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(to, "{} ({:.2}, {:.2}) m", self.name, self.at.x, self.at.y)
    }
}

/// "simulated person: (0.50, 0.50) m → revision 3".
fn said(record: &EvidenceRecord, offered: &[Offered]) -> String {
    let who = |source: &str| short(source).replace('_', " ");
    let revision = format!("\u{2192} revision {}", record.sequence);
    if let Some(shown) = record.demonstration.first() {
        let at = &shown.placement;
        return format!("{}: ({:.2}, {:.2}) m  {revision}", who(&shown.source), at.x, at.y);
    }
    if let Some(undo) = record.retraction.first() {
        return format!("{} takes back '{}'  {revision}", who(&undo.source), short(&undo.evidence_id));
    }
    if let Some(response) = record.response.first() {
        let words = match response.kind {
            QueryResponse::SKIP => "skip this one",
            QueryResponse::CANT_TELL => "I can't tell",
            QueryResponse::STOP => "stop, nothing is acceptable",
            QueryResponse::PAUSE => "pause",
            QueryResponse::START => "go on",
            QueryResponse::FINISH => "that is enough",
            QueryResponse::NEW_LESSON => "a new lesson; what was said before counts no more",
            _ => "an unknown response",
        };
        let reason = if response.reason.is_empty() { String::new() } else { format!(" ({})", short(&response.reason)) };
        return format!("{}: {words}{reason}  {revision}", who(&response.source));
    }
    if let Some(preference) = record.preference.first()
        && let [worse, better] = preference.trajectories.as_slice()
        && let Some(better) = offered.iter().find(|offered| offered.id == better.id)
        && offered.iter().any(|offered| offered.id == worse.id)
    {
        let words = match preference.answer {
            TrajectoryPreference::RANKED => format!("{better} is better"),
            TrajectoryPreference::EQUAL => "both are about equal".to_owned(),
            _ => "I can't tell which is better".to_owned(),
        };
        return format!("{}: {words}  {revision}", who(&preference.source));
    }
    let other = None
        .or(record.actions.first().map(|m| (&m.source, counted(m.states.len(), "action"))))
        .or(record.preference.first().map(|m| (&m.source, format!("{} trajectories compared", m.trajectories.len()))))
        .or(record.critique.first().map(|m| (&m.source, format!("{} marked", counted(m.segments.len(), "segment")))))
        .or(record.history.first().map(|m| (&m.source, format!("{} attempts of a learner", m.demonstrations.len()))));
    if let Some((source, what)) = other {
        return format!("{}: {what}  {revision}", who(source));
    }
    let about = record.scene.first().map(|m| &m.id).or(record.world.first().map(|m| &m.id));
    match about {
        Some(id) => format!("the lesson is about '{}' too  {revision}", short(id)),
        None => format!("an empty record  {revision}"),
    }
}

fn counted(n: usize, what: &str) -> String {
    if n == 1 { format!("1 {what}") } else { format!("{n} {what}s") }
}

fn bound_sentence(bounds: &PerformanceBounds, epsilon_m: f64, widest_m: f64) -> String {
    if bounds.outcome != PlacementBound::BOUND || !bounds.bound_m.is_finite() {
        let reason = short(bounds.reason.trim());
        let known = reason.to_lowercase().starts_with("no bound");
        return format!("    {}{reason}", if known { "" } else { "no bound, because " });
    }
    let one_in = (1.0 / (1.0 - bounds.alpha)).round();
    let sure = 100.0 * (1.0 - bounds.delta);
    format!(
        "    {sure:.0} % sure: at most 1 reward in {one_in:.0} puts it more than {} off (\u{3b5} = {})  {}",
        centimetres(bounds.bound_m),
        centimetres(epsilon_m),
        bar(bounds.bound_m, epsilon_m, widest_m),
    )
}

/// A bar from 0 to the widest bound so far, with a mark at ε.
pub(crate) fn bar(bound_m: f64, epsilon_m: f64, widest_m: f64) -> String {
    let full_m = widest_m.max(1.5 * epsilon_m).max(f64::MIN_POSITIVE);
    let cell = |m: f64| ((m / full_m * BAR as f64).round() as usize).min(BAR);
    let (filled, mark) = (cell(bound_m), cell(epsilon_m));
    let cells = (0..BAR).map(|i| {
        let (on, here) = (i < filled, i == mark);
        if here {
            '\u{2506}'
        } else if on {
            '\u{2588}'
        } else {
            '\u{b7}'
        }
    });
    format!("|{}|", cells.collect::<String>())
}

fn end_sentence(lesson: &LessonStatus) -> String {
    let after = format!("after {} questions", lesson.questions_asked);
    let reason = short(lesson.reason.trim());
    match lesson.state {
        LessonStatus::TAUGHT => {
            let bound = format!("{:.2} < \u{3b5} = {:.2} cm", 100.0 * lesson.bound_m, 100.0 * lesson.epsilon_m);
            format!("    taught {after}: the bound is {bound}")
        }
        LessonStatus::STOPPED => format!("    stopped {after}: {reason}"),
        LessonStatus::GAVE_UP => format!("    gave up {after}: {reason}"),
        LessonStatus::PAUSED => format!("    paused {after}: {reason}"),
        LessonStatus::FINISHED => format!("    finished {after}: {reason}"),
        _ => format!("    ended {after}: {reason}"),
    }
}

fn centimetres(metres: f64) -> String {
    format!("{:.1} cm", 100.0 * metres)
}

/// Others' text, cut and without characters that command a terminal.
pub(crate) fn short(text: &str) -> String {
    crate::log_line::harmless(text).chars().take(MAX_TEXT).collect()
}
