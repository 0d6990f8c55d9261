//! The sentences about a world that a person reads.

use crate::settings::QuestionKind;
use crate::words::HELD_OUT;
use exchange::{Picture, World};

/// Why a question was chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Why {
    /// The largest value at risk; with what the robot may lose from there as a share of what choosing at random loses.
    Risk { share: f64, alpha: f64, n_states: usize },
    /// The answer is expected to tell most for the time it takes.
    Telling { n: usize },
    /// The rewards that fit disagree most about what to do.
    Torn { n_states: usize },
    /// The answer is expected to tell most about the reward, for the time it takes.
    Informing { n: usize },
    /// The answer is expected to bring the risk down most, for the time it takes.
    Helping { n: usize },
    /// By lot, as the strategy has it.
    Lot,
    /// By lot, to hold the answer against what was expected.
    HoldOut,
}

/// What is asked.
pub(crate) fn question(world: &World, kind: QuestionKind, state: usize) -> String {
    let place = place(world, state);
    match kind {
        QuestionKind::Action => format!("What should I do {place}?"),
        QuestionKind::Critique => format!("What is good and what is bad in how I would go on {place}?"),
        QuestionKind::Comparison => format!("Which of these two ways is better, starting {place}?"),
    }
}

/// Why it is asked.
pub(crate) fn why(why: Why) -> String {
    match why {
        Why::Risk { share, alpha, n_states } => format!(
            "Of {n_states} places that I may come to, this is where I may be most wrong: going on from here I could lose {:.0} % \
             of what choosing at random loses, and no more in {:.0} in 100 of the rewards that fit.",
            100.0 * share,
            100.0 * alpha
        ),
        Why::Telling { n } => format!(
            "Of {n} questions that I could ask, your answer to this one should tell me most, for the time it takes you, about \
             whether I may lose too much."
        ),
        Why::Torn { n_states } => format!(
            "Of {n_states} places that I may come to, this is where the rewards that fit disagree most about what to do."
        ),
        Why::Informing { n } => format!(
            "Of {n} questions that I could ask, your answer to this one should tell me most, for the time it takes you, about what \
             you want."
        ),
        Why::Helping { n } => format!(
            "Of {n} questions that I could ask, your answer to this one should make what I may lose smaller than any other, for the \
             time it takes you."
        ),
        Why::Lot => "I drew this question at random.".to_owned(),
        Why::HoldOut => HELD_OUT.to_owned(),
    }
}

/// That a question does not know of the newest answers, where it does not.
pub(crate) fn ahead(n: usize) -> String {
    match n {
        0 => String::new(),
        1 => " I am still learning from your last answer, so that this question does not know of it.".to_owned(),
        n => format!(" I am still learning from your last {n} answers, so that this question does not know of them."),
    }
}

/// Where a state is: "in row 2, column 5 (flowers)".
fn place(world: &World, state: usize) -> String {
    match world.picture {
        Picture::Cells { columns, .. } if columns > 0 => {
            let name = feature(world, state).map(|name| format!(" ({name})")).unwrap_or_default();
            format!("in row {}, column {}{name}", state / columns + 1, state % columns + 1)
        }
        Picture::Road { lanes, places } => {
            let traffic = lanes - 2;
            let (lane, other, at) = (state / (traffic * places), state / places % traffic, state % places);
            let near = match at {
                0 => "far ahead".to_owned(),
                _ if at + 1 == places => "behind me".to_owned(),
                _ => format!("ahead, {at} of {} steps closer", places - 1),
            };
            format!("in the {} with traffic in the {} {near}", lane_name(lane, lanes), lane_name(other + 1, lanes))
        }
        Picture::Cells { .. } | Picture::None => format!("in state {state}"),
    }
}

/// The feature that is largest in a state, if any is positive.
fn feature(world: &World, state: usize) -> Option<&str> {
    let features = world.mdp.features(state, 0);
    let best = (0..features.len()).max_by(|&a, &b| features[a].total_cmp(&features[b]).then(b.cmp(&a)))?;
    (features[best] > 0.0).then(|| world.feature_names[best].as_str())
}

fn lane_name(lane: usize, lanes: usize) -> String {
    match (lane, lanes) {
        (0, _) => "left roadside".to_owned(),
        _ if lane + 1 == lanes => "right roadside".to_owned(),
        (_, 3) => "lane".to_owned(),
        (1, 4 | 5) => "left lane".to_owned(),
        (2, 5) => "centre lane".to_owned(),
        (2, 4) | (3, 5) => "right lane".to_owned(),
        _ => format!("lane {lane}"),
    }
}
