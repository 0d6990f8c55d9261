//! What the person wants of the lesson itself: to pause, to finish, to stop.

use crate::Settings;
use apprentice_msgs::msg::{LessonStatus, Posterior};

/// State and reason of a lesson that a wish decides, whatever the bound says.
pub(crate) fn before_the_bound(settings: &Settings, posterior: &Posterior) -> Option<(u8, String)> {
    match posterior.wish {
        Posterior::STOP => Some((LessonStatus::STOPPED, "the person said that nothing is acceptable".to_owned())),
        Posterior::PAUSE => {
            Some((LessonStatus::PAUSED, "the lesson is paused; nothing is asked until it goes on".to_owned()))
        }
        Posterior::NO_WISH if settings.wait_for_start => {
            Some((LessonStatus::PAUSED, "the lesson has not been started yet".to_owned()))
        }
        _ => None,
    }
}

/// The reason of a lesson that the person finished before the bound was below the goal. `bound` is the beginning of a sentence that
/// the goal completes where it is `known`, else why there is no bound.
pub(crate) fn finished(bound: &str, known: bool, goal: &str) -> String {
    let rest = if known { format!("{bound} ε = {goal}") } else { format!("there is no bound: {bound}") };
    format!("the person has said enough, but {rest}, so the robot does nothing of its own accord")
}
