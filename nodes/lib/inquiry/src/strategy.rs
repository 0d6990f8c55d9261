//! By what a question is chosen: the dissertation's ways and ours, all as one score a question.

use crate::value_at_risk::values_at_risk;
use crate::{
    Belief, InquiryError, Objective, QuestionKind, Round, action_entropy, class_information, expected_drop,
    reward_information,
};

/// A way to choose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Strategy {
    /// Any feasible question.
    Random,
    /// ActiveVaR, the dissertation's: the situation with the largest α-VaR of the current policy's loss.
    ValueAtRisk {
        /// α in (0, 1).
        alpha: f64,
    },
    /// AS: the largest action entropy (Lopes et al. 2009). For actions; other answers are treated alike.
    ActionEntropy,
    /// ARC: the largest information about the reward (Cui and Niekum 2018).
    RewardInformation,
    /// Ours: the largest information about whether the loss of the current policy, the worst over the situations, exceeds ε.
    RiskInformation {
        /// ε, in the unit of the losses.
        epsilon: f64,
    },
    /// Ours: the largest drop of the objective that is expected once the answer is in. Needs alternatives.
    LookAhead {
        /// What is to be small.
        objective: Objective,
        /// Looks ahead only for this many questions, those that tell most about the reward; the others score −∞. 0: for all.
        shortlist: usize,
    },
}

impl Strategy {
    /// Whether scores are gains that add up over time, so that gain per second is what counts.
    pub fn is_gain(self) -> bool {
        matches!(self, Self::RewardInformation | Self::RiskInformation { .. } | Self::LookAhead { .. })
    }
}

/// A score for every question under the belief, larger is better: α-VaR in the unit of the losses, entropy and information in
/// nats, drops in the unit of the losses, 0 for [`Strategy::Random`]. Questions that are not feasible have −∞.
///
/// # Errors
/// Parts that do not fit together; levels outside (0, 1); [`Strategy::LookAhead`] without alternatives.
pub fn scores(round: &Round, belief: &Belief, strategy: Strategy) -> Result<Vec<f64>, InquiryError> {
    round.check()?;
    crate::error::check_length("draws with weights", belief.n(), round.belief.n())?;
    let at_risk = match strategy {
        Strategy::ValueAtRisk { alpha } => values_at_risk(&round.losses, belief, alpha)?,
        _ => Vec::new(),
    };
    let classes = match strategy {
        Strategy::RiskInformation { epsilon } => exceeding(round, epsilon),
        _ => Vec::new(),
    };
    let listed = match strategy {
        Strategy::LookAhead { shortlist, .. } if shortlist > 0 => shortlisted(round, belief, shortlist)?,
        _ => vec![true; round.questions.len()],
    };
    let of = |index: usize| {
        let question = &round.questions[index];
        if !question.feasible || !listed[index] {
            return Ok(f64::NEG_INFINITY);
        }
        let answers = &question.answers;
        match strategy {
            Strategy::Random => Ok(0.0),
            Strategy::ValueAtRisk { .. } => Ok(at_risk[question.situation]),
            Strategy::ActionEntropy => action_entropy(answers, belief),
            Strategy::RewardInformation => reward_information(answers, belief),
            Strategy::RiskInformation { .. } => class_information(answers, belief, &classes, 2),
            Strategy::LookAhead { objective, .. } => {
                let alternatives = round.alternatives.as_ref().ok_or(InquiryError::Empty { what: "alternatives" })?;
                expected_drop(answers, belief, alternatives, objective)
            }
        }
    };
    (0..round.questions.len()).map(of).collect()
}

/// Whether each question is one of the `n` feasible ones that tell most about the reward; of equals the first are.
fn shortlisted(round: &Round, belief: &Belief, n: usize) -> Result<Vec<bool>, InquiryError> {
    let information = scores(round, belief, Strategy::RewardInformation)?;
    let mut order: Vec<usize> = (0..information.len()).filter(|&i| round.questions[i].feasible).collect();
    order.sort_by(|&a, &b| information[b].total_cmp(&information[a]));
    let mut listed = vec![false; information.len()];
    order.iter().take(n).for_each(|&i| listed[i] = true);
    Ok(listed)
}

/// 1 for every draw under which the current policy loses more than ε somewhere, else 0.
fn exceeding(round: &Round, epsilon: f64) -> Vec<usize> {
    let mut classes = vec![0; round.belief.n()];
    for situation in 0..round.losses.n_situations() {
        for (class, loss) in classes.iter_mut().zip(round.losses.of(situation)) {
            *class |= usize::from(*loss > epsilon);
        }
    }
    classes
}

impl Round {
    /// Kinds of question that can be asked now.
    pub fn feasible_kinds(&self) -> Vec<QuestionKind> {
        let mut kinds = Vec::new();
        for question in self.questions.iter().filter(|question| question.feasible) {
            if !kinds.contains(&question.kind) {
                kinds.push(question.kind);
            }
        }
        kinds
    }
}
