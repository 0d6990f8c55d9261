//! The sentences an operator reads.

use crate::Strategy;
use apprentice_msgs::msg::{PerformanceBounds, PlacementBound};
use scene::Scene;

/// How a hypothetical table differs from the one before: "plate 1 at (0.31, 0.72) m".
pub(crate) fn difference(from: &Scene, to: &Scene) -> String {
    let moved = from.objects.iter().zip(&to.objects).find(|(a, b)| a.position_m != b.position_m);
    match moved {
        None => "on the same table".into(),
        Some((_, object)) => {
            format!("with the {} at ({:.2}, {:.2}) m", object.label, object.position_m.x, object.position_m.y)
        }
    }
}

/// What is asked.
pub(crate) fn question(label: &str, place: &str, is_of_two: bool) -> String {
    if is_of_two {
        format!("Which of the two places is better for the {label} {place}?")
    } else {
        format!("Where does the {label} belong {place}?")
    }
}

/// Why a question was drawn at random.
pub(crate) const HELD_OUT: &str =
    "I drew this question at random, to see whether you answer as I expect; now and then I do.";

/// Why a table is asked about.
pub(crate) fn why(bound: &PlacementBound, bounds: &PerformanceBounds, n_pieces: u64, strategy: Strategy) -> String {
    if n_pieces == 0 {
        return "I have not been shown anything yet.".into();
    }
    let of = bounds.bounds.len();
    if bound.outcome == PlacementBound::BOUND {
        let tables = match strategy {
            _ if of == 1 => String::new(),
            Strategy::Var => format!(", the most of {of} tables I looked at"),
            Strategy::Random => format!("; I drew this table at random out of {of}"),
            _ => format!(", and here your answer tells me more than on {} other tables", of - 1),
        };
        format!(
            "Here I could still be {:.1} cm off ({:.0} % sure that it is no more for {:.0} in 100 of the rewards that fit){tables}.",
            100.0 * bound.bound_m,
            100.0 * (1.0 - bounds.delta),
            100.0 * bounds.alpha,
        )
    } else {
        format!(
            "Here I cannot bound my error yet; among the rewards that fit, {:.0} in 100 put it within {:.1} cm.",
            100.0 * bounds.alpha,
            100.0 * bound.point_estimate_m
        )
    }
}
