//! What speaks against the model of a lesson about a table: see [`crate::fit`]. Comparisons are what is judged. Where something was put
//! is not: no place is so improbable that it would say much.

use crate::Settings;
use crate::draws::n_of;
use crate::fit::{Claim, MAX_JUDGED, compared, judged, may_matter};
use crate::settings::TableQuestionKind;
use crate::table_draws::DrawnRewards;
use apprentice_msgs::msg::{EvidenceLog, LessonStatus, Posterior};
use exchange::in_force;
use inquiry::InquiryError;

/// Whether a lesson's state depends on how well the evidence fits: there is a bound, and there are comparisons or there have to be.
pub(crate) fn is_judged(settings: &Settings, posterior: &Posterior, lesson: &LessonStatus) -> bool {
    let must_confirm = settings.most_surprises < 1.0 && can_confirm(settings);
    let has_said = n_of(posterior, "preferences") > 0 || must_confirm;
    may_matter(settings, lesson) && lesson.bound_m.is_finite() && has_said
}

/// The lesson with what speaks against its model: its state says so when that is too much at the level of the settings.
///
/// # Errors
/// Evidence that is not about the posterior's weights.
pub(crate) fn fitted(
    settings: &Settings,
    posterior: &Posterior,
    log: &EvidenceLog,
    draws: &DrawnRewards,
    delta: f64,
    lesson: LessonStatus,
) -> Result<LessonStatus, InquiryError> {
    let end = usize::try_from(posterior.revision).unwrap_or(usize::MAX).min(log.records.len());
    let mut said = Vec::new();
    for record in in_force(&log.records[..end]).rev() {
        for message in &record.preference {
            said.extend(compared(record, message, (&draws.weights, draws.n_features), &draws.comparisons)?);
        }
        if said.len() >= MAX_JUDGED {
            break;
        }
    }
    said.reverse();
    let claim = Claim {
        bound: lesson.bound_m,
        epsilon: settings.epsilon_m,
        delta,
        features: &posterior.feature_names,
        can_confirm: can_confirm(settings),
    };
    judged(settings, &claim, &said, draws.n(), lesson)
}

fn can_confirm(settings: &Settings) -> bool {
    settings.table_question_kinds.contains(&TableQuestionKind::Comparison)
}
