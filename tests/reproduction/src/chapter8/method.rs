//! Ways to choose a question, by the names of the dissertation.

use inquiry::{Objective, Strategy};

/// A way to choose questions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Method {
    /// As in the dissertation, or "ours".
    pub label: &'static str,
    /// By what.
    pub strategy: Strategy,
    /// Colour in pictures.
    pub colour: usize,
}

/// α of the dissertation's VaR.
pub const ALPHA: f64 = 0.95;
/// Questions that ours looks ahead for.
const SHORTLIST: usize = 16;

/// Any question.
pub const RANDOM: Method = Method { label: "Random", strategy: Strategy::Random, colour: 6 };
/// Lopes et al. 2009.
pub const AS: Method = Method { label: "AS", strategy: Strategy::ActionEntropy, colour: 3 };
/// The dissertation's.
pub const ACTIVE_VAR: Method =
    Method { label: "ActiveVaR", strategy: Strategy::ValueAtRisk { alpha: ALPHA }, colour: 1 };
/// Cui and Niekum 2018, exact information by re-weighting instead of chains.
pub const ARC: Method = Method { label: "ARC", strategy: Strategy::RewardInformation, colour: 2 };
/// Ours: the largest expected drop of the expected loss once the answer is in.
pub const OURS: Method = Method {
    label: "ours",
    strategy: Strategy::LookAhead { objective: Objective::Mean, shortlist: SHORTLIST },
    colour: 0,
};
/// The same for tables, of which all candidates are looked at.
pub const OURS_TABLE: Method =
    Method { strategy: Strategy::LookAhead { objective: Objective::Mean, shortlist: 0 }, ..OURS };
