//! Where a lesson about a table stands by its bounds.

use crate::{Settings, wishes};
use apprentice_msgs::msg::{LessonStatus, PerformanceBounds, PlacementBound, Posterior};
use inquiry::{Choice, Judged, choose};

/// What was said about the reward, in pieces of evidence in force.
pub(crate) fn pieces(posterior: &Posterior) -> u64 {
    let of_all_kinds = posterior.rationalities.iter().fold(0_u64, |sum, of| sum.saturating_add(of.n));
    of_all_kinds.max(posterior.n_demonstrations)
}

/// The state of the lesson, and which table is to be asked about while it goes on.
pub(crate) fn table_lesson(
    settings: &Settings,
    posterior: &Posterior,
    bounds: &PerformanceBounds,
    judged: &[Judged],
) -> (LessonStatus, Choice) {
    let epsilon_m = settings.epsilon_m;
    let number = |n: u64| u32::try_from(n).unwrap_or(u32::MAX);
    let mut lesson = LessonStatus {
        header: posterior.header.clone(),
        revision: posterior.revision,
        state: LessonStatus::ASKING,
        reason: bounds.reason.clone(),
        query_id: String::new(),
        questions_asked: number(posterior.n_answers),
        demonstrations: number(pieces(posterior)),
        bound_outcome: bounds.outcome,
        bound_m: bounds.bound_m,
        epsilon_m,
        loss_bound: f64::NAN,
        epsilon_loss: f64::NAN,
        misfit_p: f64::NAN,
        ..LessonStatus::default()
    };
    // Before anything was said there is nothing the person has agreed to, whatever the prior says.
    let choice = if pieces(posterior) == 0 { ask_first(judged) } else { next(judged, epsilon_m) };
    match (wishes::before_the_bound(settings, posterior), choice) {
        (Some(told), _) => (lesson.state, lesson.reason) = told,
        (None, Choice::Taught { bound_m }) => {
            lesson.state = LessonStatus::TAUGHT;
            lesson.reason = format!("the bound, {:.1} cm, is below ε = {:.1} cm", 100.0 * bound_m, 100.0 * epsilon_m);
        }
        (None, _) if posterior.wish == Posterior::FINISH => {
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
        (None, Choice::Ask(_)) if i64::from(lesson.questions_asked) >= settings.max_questions => {
            lesson.state = LessonStatus::GAVE_UP;
            lesson.reason = format!(
                "{} questions were answered and the bound is not below ε = {:.1} cm; raise max_questions or epsilon_m",
                lesson.questions_asked,
                100.0 * epsilon_m
            );
        }
        (None, Choice::Ask(_)) => {}
    }
    (lesson, choice)
}

/// How the robot's placement on each table was judged.
pub(crate) fn judged(bounds: &PerformanceBounds) -> Vec<Judged> {
    let of = |bound: &PlacementBound| {
        let known = bound.outcome == PlacementBound::BOUND && bound.bound_m.is_finite();
        Judged { bound_m: known.then_some(bound.bound_m), point_estimate_m: bound.point_estimate_m }
    };
    bounds.bounds.iter().map(of).collect()
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
