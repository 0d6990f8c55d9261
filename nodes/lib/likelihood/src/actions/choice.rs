//! One choice of an action, shown or judged.

use mdp::Mdp;

use crate::actions::ActionError;

/// What is said about an action in a state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ChoiceVerdict {
    /// It was taken in a demonstration.
    Taken,
    /// It was judged good.
    Good,
    /// It was judged bad.
    Bad,
}

/// An action in a state with what is said about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Choice {
    /// 0-based state.
    pub state: usize,
    /// 0-based action.
    pub action: usize,
    /// What is said.
    pub verdict: ChoiceVerdict,
    /// Confidence: multiplies the rationality for this choice; positive, 1 for ordinary.
    pub factor: f64,
}

impl Choice {
    /// An action taken with ordinary confidence.
    pub fn taken(state: usize, action: usize) -> Self {
        Self { state, action, verdict: ChoiceVerdict::Taken, factor: 1.0 }
    }

    pub(super) fn check(&self, index: usize, mdp: &Mdp) -> Result<(), ActionError> {
        for (what, got, below) in [("state", self.state, mdp.n_states()), ("action", self.action, mdp.n_actions())] {
            if got >= below {
                return Err(ActionError::OutOfRange { index, what, got, below });
            }
        }
        if !(self.factor > 0.0 && self.factor.is_finite()) {
            return Err(ActionError::Factor { index, got: self.factor });
        }
        if self.verdict == ChoiceVerdict::Bad && mdp.n_actions() == 1 {
            return Err(ActionError::NoAlternative { index });
        }
        Ok(())
    }
}

/// Each choice once, where it first stands. Changes the likelihood: only to reproduce programs that drop repeats (method
/// notes 1.7).
pub fn without_duplicates(choices: &[Choice]) -> Vec<Choice> {
    let mut seen = std::collections::HashSet::new();
    let key = |choice: &Choice| (choice.state, choice.action, choice.verdict, choice.factor.to_bits());
    choices.iter().filter(|choice| seen.insert(key(choice))).copied().collect()
}
