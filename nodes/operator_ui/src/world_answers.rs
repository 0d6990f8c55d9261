//! From what a page says about ways, places, states and steps to evidence. A question about a world was checked against it when it came.

use crate::evidence::Evidence;
use crate::protocol::{Better, Segment};
use apprentice_msgs::msg::{
    ActionDemonstration, CritiqueSegment, FeatureTrajectory, PlacementQuery, SegmentCritique, TrajectoryPreference,
    WorldQuery,
};
use exchange::feature_trajectory;

/// What to do in the state that is asked about; whether there is such an action is for the posterior to say.
pub(crate) fn acted(query: &WorldQuery, action: u32, confidence: u8) -> Result<Evidence, String> {
    if query.kind != WorldQuery::ACTION {
        return Err(format!("question '{}' does not ask what to do", query.id));
    }
    Ok(Evidence::Actions(Box::new(ActionDemonstration {
        world_id: query.world.id.clone(),
        states: vec![query.state],
        actions: vec![action],
        confidence,
        ..ActionDemonstration::default()
    })))
}

/// Good and bad parts of the way that is shown.
pub(crate) fn marked(query: &WorldQuery, segments: &[Segment], confidence: u8) -> Result<Evidence, String> {
    let (WorldQuery::CRITIQUE, [way]) = (query.kind, query.trajectories.as_slice()) else {
        return Err(format!("question '{}' does not ask what is good and what is bad", query.id));
    };
    let mut marked = vec![false; way.states.len()];
    if segments.is_empty() || segments.len() > marked.len() {
        return Err(format!("{} parts are marked; 1 to {} are needed", segments.len(), marked.len()));
    }
    for &Segment { start, end, .. } in segments {
        let steps = marked.get_mut(start as usize..end as usize).filter(|steps| !steps.is_empty());
        let steps =
            steps.ok_or_else(|| format!("steps {start} to {end} are not of a way of {} steps", way.states.len()))?;
        if steps.contains(&true) {
            return Err(format!("a step between {start} and {end} is marked twice"));
        }
        steps.fill(true);
    }
    let segment = |&Segment { start, end, good }: &Segment| CritiqueSegment {
        start,
        end,
        verdict: if good { CritiqueSegment::GOOD } else { CritiqueSegment::BAD },
    };
    Ok(Evidence::Critique(Box::new(SegmentCritique {
        world_id: query.world.id.clone(),
        states: way.states.clone(),
        actions: way.actions.clone(),
        segments: segments.iter().map(segment).collect(),
        confidence,
        ..SegmentCritique::default()
    })))
}

/// Which of the two ways is better: worst first.
pub(crate) fn compared(query: &WorldQuery, better: Better, confidence: u8) -> Result<Evidence, String> {
    match (query.kind, query.trajectories.as_slice()) {
        (WorldQuery::COMPARISON, [first, second]) => {
            Ok(preferred([first, second].map(feature_trajectory), better, confidence))
        }
        _ => Err(does_not_compare(&query.id)),
    }
}

/// Which of the two places is better: worst first.
pub(crate) fn compared_places(query: &PlacementQuery, better: Better, confidence: u8) -> Result<Evidence, String> {
    match query.options.as_slice() {
        [first, second] => Ok(preferred([first, second].map(|option| option.trajectory.clone()), better, confidence)),
        _ => Err(does_not_compare(&query.id)),
    }
}

fn does_not_compare(query_id: &str) -> String {
    format!("question '{query_id}' does not ask which is better")
}

fn preferred(mut of: [FeatureTrajectory; 2], better: Better, confidence: u8) -> Evidence {
    if better == Better::First {
        of.reverse();
    }
    Evidence::Comparison(Box::new(TrajectoryPreference {
        trajectories: of.into(),
        answer: match better {
            Better::First | Better::Second => TrajectoryPreference::RANKED,
            Better::Equal => TrajectoryPreference::EQUAL,
            Better::CantTell => TrajectoryPreference::CANT_TELL,
        },
        confidence,
        ..TrajectoryPreference::default()
    }))
}

/// What was taken back as an answer to the open question, when that asks the same once more; else as volunteered.
pub(crate) fn asked_again(before: Evidence, open: Option<&WorldQuery>) -> (Evidence, String) {
    let Some(query) = open else { return (before, String::new()) };
    let shown = query.trajectories.as_slice();
    let evidence = match before {
        Evidence::Actions(m) if query.kind == WorldQuery::ACTION && m.states == [query.state] => Evidence::Actions(m),
        Evidence::Critique(m)
            if query.kind == WorldQuery::CRITIQUE
                && shown.iter().any(|way| (&way.states, &way.actions) == (&m.states, &m.actions)) =>
        {
            Evidence::Critique(m)
        }
        Evidence::Comparison(mut m) if query.kind == WorldQuery::COMPARISON => {
            // The same ways under the names that the question gives them.
            let named = |features: &[f64]| shown.iter().find(|way| way.features == features).map(feature_trajectory);
            let renamed: Option<Vec<_>> = m.trajectories.iter().map(|known| named(&known.features)).collect();
            match renamed {
                Some(renamed) if renamed.len() == 2 && renamed[0].id != renamed[1].id => m.trajectories = renamed,
                _ => return (Evidence::Comparison(m), String::new()),
            }
            Evidence::Comparison(m)
        }
        other => return (other, String::new()),
    };
    (evidence, query.id.clone())
}
