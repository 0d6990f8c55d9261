//! What happens in a lesson about a world, one plain sentence each.

use crate::Kind;
use crate::story::{bar, short};
use apprentice_msgs::msg::{LessonStatus, RiskBound, RobustPolicy, TabularWorld, WorldQuery};

/// Follows a lesson about a world; the same thing said twice is told once.
#[derive(Debug, Default)]
pub(crate) struct WorldStory {
    told_world: bool,
    told_lesson: Option<(u64, u8, u64)>,
    told_query: Option<String>,
    n_queries: u32,
    over: Option<u64>,
    policy: Option<RobustPolicy>,
    told_policy: Option<(u64, u64)>,
}

impl WorldStory {
    /// What there is to act in.
    pub fn world(&mut self, world: &TabularWorld) -> Option<(Kind, String)> {
        if std::mem::replace(&mut self.told_world, true) {
            return None;
        }
        let features: Vec<String> = world.feature_names.iter().take(12).map(|name| short(name)).collect();
        let states = match (world.shape.as_slice(), world.shape_of) {
            ([rows, columns], TabularWorld::CELLS) => format!("a grid of {rows} × {columns} cells"),
            ([lanes, _], TabularWorld::ROAD) => format!("a road of {} lanes with traffic", lanes.saturating_sub(2)),
            _ => format!("{} states", world.n_states),
        };
        let text = format!(
            "{}: {states}, {} actions; what counts: {}",
            short(&world.id),
            world.n_actions,
            features.join(", ")
        );
        Some((Kind::Info("world"), text))
    }

    /// What is asked.
    pub fn query(&mut self, query: &WorldQuery) -> Option<(Kind, String)> {
        if self.told_query.replace(query.id.clone()).as_ref() == Some(&query.id) {
            return None;
        }
        self.n_queries += 1;
        let asked = query.reason.split_inclusive('?').next().unwrap_or_default();
        Some((Kind::Question, format!("{:<3} {}", self.n_queries, short(asked))))
    }

    /// How much the robot may still lose, and how the lesson ended.
    pub fn lesson(&mut self, lesson: &LessonStatus) -> Vec<(Kind, String)> {
        let key = (lesson.revision, lesson.state, lesson.loss_bound.to_bits());
        if self.told_lesson.replace(key) == Some(key) {
            return Vec::new();
        }
        let mut lines = vec![(Kind::Bound, bound(lesson))];
        let goes_on = [LessonStatus::ASKING, LessonStatus::PAUSED].contains(&lesson.state);
        self.over = (!goes_on).then_some(lesson.revision);
        let pieces = if lesson.demonstrations == 1 { "piece" } else { "pieces" };
        let after = format!("after {} {pieces} of evidence", lesson.demonstrations);
        let word = match lesson.state {
            LessonStatus::TAUGHT => "taught",
            LessonStatus::STOPPED => "stopped",
            LessonStatus::GAVE_UP => "gave up",
            LessonStatus::PAUSED => "paused",
            LessonStatus::FINISHED => "finished",
            LessonStatus::MISFIT => "does not fit",
            _ => return lines,
        };
        lines.push((Kind::Lesson, format!("    {word} {after}: {}", short(&lesson.reason))));
        lines.extend(self.final_policy());
        lines
    }

    /// What the robot would do.
    pub fn policy(&mut self, policy: &RobustPolicy) -> Option<(Kind, String)> {
        self.policy = Some(policy.clone());
        self.final_policy()
    }

    /// The policy, once the lesson is over; again when somebody asks for another caution.
    fn final_policy(&mut self) -> Option<(Kind, String)> {
        let policy = self.policy.as_ref().filter(|policy| self.over.is_some_and(|over| policy.revision >= over))?;
        let key = (policy.revision, policy.preference_number);
        if self.told_policy.replace(key) == Some(key) {
            return None;
        }
        let reason: String = crate::log_line::harmless(&policy.reason).chars().take(400).collect();
        Some((Kind::Plan, format!("    {reason}")))
    }
}

fn bound(lesson: &LessonStatus) -> String {
    if lesson.bound_outcome != RiskBound::BOUND || !lesson.loss_bound.is_finite() {
        return format!("    {}", short(&lesson.reason));
    }
    let (bound, goal) = (lesson.loss_bound, lesson.epsilon_loss);
    format!(
        "    the robot's policy loses at most {:.1} % of what choosing at random loses (\u{3b5} = {:.1} %)  {}",
        100.0 * bound,
        100.0 * goal,
        bar(bound, goal, 1.0)
    )
}
