//! Where a lesson about a world stands: over when what the robot's policy may lose is small.

use crate::{Settings, wishes};
use apprentice_msgs::msg::{LessonStatus, PolicyBound, PolicyBounds, Posterior, RiskBound, RobustPolicy};
use exchange::{ROBUST_POLICY, is_about_a_table, robust_set_id};

/// The state of a lesson about a world, from bounds on the robot's policy under the posterior; none when the lesson is about a
/// table, or the bounds are of another posterior or of somebody else's policies.
pub fn world_lesson(settings: &Settings, posterior: &Posterior, bounds: &PolicyBounds) -> Option<LessonStatus> {
    let of_posterior = bounds.revision == posterior.revision && bounds.evidence_hash == posterior.evidence_hash;
    if is_about_a_table(posterior) || posterior.world.hash.is_empty() || !of_posterior {
        return None;
    }
    // The policy of an earlier posterior may be judged under this one, until its own has come.
    let (revision, preference) = bounds.set_id.strip_prefix("robust-")?.split_once('-')?;
    if bounds.set_id != robust_set_id(revision.parse().ok()?, preference.parse().ok()?)
        || revision.parse() != Ok(posterior.revision)
    {
        return None;
    }
    let robust = bounds.policies.iter().find(|policy| policy.id == ROBUST_POLICY)?;
    let loss = &robust.normalised_loss;
    let pieces: u64 = posterior.rationalities.iter().map(|of| of.n).sum();
    let goal = settings.epsilon_loss;
    let known = loss.outcome == RiskBound::BOUND && loss.bound.is_finite();
    let share = |x: f64| format!("{:.1} %", 100.0 * x);
    let (state, reason) = if let Some(told) = wishes::before_the_bound(settings, posterior) {
        told
    } else if known && pieces > 0 && loss.bound < goal {
        let reason = format!(
            "the robot's policy loses at most {} of what choosing at random loses, which is below ε = {}",
            share(loss.bound),
            share(goal)
        );
        (LessonStatus::TAUGHT, reason)
    } else if posterior.wish == Posterior::FINISH {
        let bound = if known { format!("the bound, {}, is not below", share(loss.bound)) } else { loss.reason.clone() };
        (LessonStatus::FINISHED, wishes::finished(&bound, known, &share(goal)))
    } else if i64::try_from(pieces).unwrap_or(i64::MAX) >= settings.max_questions {
        let reason = format!(
            "{pieces} pieces of evidence were given and the bound is not below ε = {}; raise max_questions or epsilon_loss",
            share(goal)
        );
        (LessonStatus::GAVE_UP, reason)
    } else if known {
        let sure = 100.0 * (1.0 - bounds.delta);
        let rewards = 100.0 * bounds.alpha;
        let reason = format!(
            "{sure:.0} % sure: under {rewards:.0} in 100 of the rewards that fit, the robot's policy loses at most {} of what \
             choosing at random loses",
            share(loss.bound)
        );
        (LessonStatus::ASKING, reason)
    } else {
        (LessonStatus::ASKING, loss.reason.clone())
    };
    Some(LessonStatus {
        header: posterior.header.clone(),
        revision: posterior.revision,
        state,
        reason,
        query_id: String::new(),
        questions_asked: u32::try_from(posterior.n_answers).unwrap_or(u32::MAX),
        demonstrations: u32::try_from(pieces).unwrap_or(u32::MAX),
        bound_outcome: loss.outcome,
        bound_m: f64::NAN,
        epsilon_m: f64::NAN,
        loss_bound: if known { loss.bound } else { f64::NAN },
        epsilon_loss: goal,
        misfit_p: f64::NAN,
        ..LessonStatus::default()
    })
}

/// What stands for bounds on a robot's policy that there is none of: nobody judges it, and the lesson goes on without a bound, for the
/// policy's reason. `None` for a policy that will be judged.
pub fn unjudged(policy: &RobustPolicy) -> Option<PolicyBounds> {
    if policy.outcome == RobustPolicy::OPTIMAL {
        return None;
    }
    let none = || RiskBound {
        outcome: RiskBound::NOT_JUDGED,
        bound: f64::NAN,
        point_estimate: f64::NAN,
        reason: policy.reason.clone(),
        ..RiskBound::default()
    };
    let robust = PolicyBound {
        id: ROBUST_POLICY.to_owned(),
        return_bound: none(),
        loss_bound: none(),
        normalised_loss: none(),
        ..PolicyBound::default()
    };
    Some(PolicyBounds {
        header: policy.header.clone(),
        revision: policy.revision,
        evidence_hash: policy.evidence_hash.clone(),
        set_id: robust_set_id(policy.revision, policy.preference_number),
        policies: vec![robust],
        alpha: policy.alpha,
        ..PolicyBounds::default()
    })
}

#[cfg(test)]
mod tests {
    use super::world_lesson;
    use crate::Settings;
    use apprentice_msgs::msg::{
        LessonStatus, PolicyBound, PolicyBounds, Posterior, Rationality, RiskBound, TableScene, WorldReference,
    };

    fn posterior(pieces: u64) -> Posterior {
        Posterior {
            revision: 3,
            evidence_hash: "h".into(),
            world: WorldReference { id: "w".into(), hash: "abc".into() },
            rationalities: vec![Rationality { kind: "actions".into(), n: pieces, ..Rationality::default() }],
            ..Posterior::default()
        }
    }

    fn bounds(outcome: u8, bound: f64) -> PolicyBounds {
        let normalised_loss = RiskBound { outcome, bound, reason: "no bound, because".into(), ..RiskBound::default() };
        let robust = PolicyBound { id: "robust".into(), normalised_loss, ..PolicyBound::default() };
        PolicyBounds {
            revision: 3,
            evidence_hash: "h".into(),
            set_id: "robust-3-0".into(),
            policies: vec![robust],
            alpha: 0.95,
            delta: 0.05,
            ..PolicyBounds::default()
        }
    }

    fn state(pieces: u64, bounds: &PolicyBounds) -> u8 {
        world_lesson(&Settings::default(), &posterior(pieces), bounds).expect("they belong together").state
    }

    #[test]
    fn a_lesson_about_a_world_ends_with_a_small_bound_on_the_loss_and_never_before_any_evidence() {
        assert_eq!(state(2, &bounds(RiskBound::BOUND, 0.2)), LessonStatus::ASKING);
        assert_eq!(state(2, &bounds(RiskBound::BOUND, 0.05)), LessonStatus::TAUGHT);
        assert_eq!(state(0, &bounds(RiskBound::BOUND, 0.05)), LessonStatus::ASKING);
        assert_eq!(state(2, &bounds(RiskBound::NOT_MIXED, f64::NAN)), LessonStatus::ASKING);
        assert_eq!(state(60, &bounds(RiskBound::BOUND, 0.2)), LessonStatus::GAVE_UP);
        let stopped = Posterior { wish: Posterior::STOP, ..posterior(2) };
        let lesson = world_lesson(&Settings::default(), &stopped, &bounds(RiskBound::BOUND, 0.05)).expect("a lesson");
        assert_eq!(lesson.state, LessonStatus::STOPPED);
        assert!(lesson.bound_m.is_nan() && lesson.epsilon_m.is_nan() && lesson.epsilon_loss == 0.1);
    }

    #[test]
    fn what_belongs_to_another_posterior_policy_or_subject_says_nothing() {
        let good = bounds(RiskBound::BOUND, 0.05);
        let none = |posterior: Posterior, bounds: PolicyBounds| {
            assert_eq!(world_lesson(&Settings::default(), &posterior, &bounds), None);
        };
        none(posterior(2), PolicyBounds { revision: 2, ..good.clone() });
        none(posterior(2), PolicyBounds { evidence_hash: "x".into(), ..good.clone() });
        for set_id in ["mine", "robust-2-0", "robust-3", "robust-3-x", "robust-3-00"] {
            none(posterior(2), PolicyBounds { set_id: set_id.into(), ..good.clone() });
        }
        none(posterior(2), PolicyBounds { policies: vec![], ..good.clone() });
        none(Posterior { world: WorldReference::default(), ..posterior(2) }, good.clone());
        let table = TableScene { width_m: 1.0, ..TableScene::default() };
        none(Posterior { task: table, ..posterior(2) }, good);
    }
}
