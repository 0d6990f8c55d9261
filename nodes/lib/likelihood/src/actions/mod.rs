//! How probable chosen actions are under a reward: a Boltzmann-rational person (dissertation eqs. 3.4 and 3.5).

mod choice;
mod error;
mod evaluator;
mod log_product;

pub use choice::{Choice, ChoiceVerdict, without_duplicates};
pub use error::ActionError;
pub use evaluator::ActionEvaluator;

use mdp::Mdp;

/// The likelihood of choices as a function of θ = β w, rationality times weights.
///
/// log π_θ(a|s) = Q*_θ(s, a) − log Σ_b exp Q*_θ(s, b), since Q* is homogeneous of degree 1 in the weights. A confidence
/// factor f multiplies θ for its choice alone. With a rate ε of wrong answers, π becomes (1 − ε) π + ε/A. A choice judged
/// bad counts as log(1 − π).
#[derive(Debug, Clone)]
pub struct ActionLikelihood<'a> {
    mdp: &'a Mdp,
    groups: Vec<Group>,
    items: Vec<Item>,
    n_choices: usize,
    wrong_rate: f64,
}

/// Choices in the same state with the same confidence: one softmax serves them all.
#[derive(Debug, Clone)]
struct Group {
    state: usize,
    factor: f64,
    /// Where its items end; they start where those of the group before end.
    end: usize,
}

/// Equal choices, counted.
#[derive(Debug, Clone)]
struct Item {
    action: usize,
    bad: bool,
    count: f64,
}

impl<'a> ActionLikelihood<'a> {
    /// The likelihood of `choices` in `mdp`, in any order. Equal choices all count; none is dropped.
    ///
    /// # Errors
    /// States or actions out of range; factors that are not positive and finite; an action judged bad where there is no
    /// other.
    pub fn new(mdp: &'a Mdp, mut choices: Vec<Choice>) -> Result<Self, ActionError> {
        for (index, choice) in choices.iter().enumerate() {
            choice.check(index, mdp)?;
        }
        let n_choices = choices.len();
        let bad = |choice: &Choice| choice.verdict == ChoiceVerdict::Bad;
        choices.sort_by(|x, y| {
            let (x_key, y_key) = ((x.action, bad(x)), (y.action, bad(y)));
            x.state.cmp(&y.state).then(x.factor.total_cmp(&y.factor)).then(x_key.cmp(&y_key))
        });
        let mut likelihood = Self { mdp, groups: vec![], items: vec![], n_choices, wrong_rate: 0.0 };
        for same in choices.chunk_by(|x, y| x.state == y.state && x.factor == y.factor) {
            for equal in same.chunk_by(|x, y| x.action == y.action && bad(x) == bad(y)) {
                let count = equal.len() as f64;
                likelihood.items.push(Item { action: equal[0].action, bad: bad(&equal[0]), count });
            }
            let (state, factor, end) = (same[0].state, same[0].factor, likelihood.items.len());
            likelihood.groups.push(Group { state, factor, end });
        }
        Ok(likelihood)
    }

    /// The same with a rate ε in [0, 1) of answers given at random.
    ///
    /// # Errors
    /// A rate out of range.
    pub fn with_wrong_rate(mut self, wrong_rate: f64) -> Result<Self, ActionError> {
        if !(0.0..1.0).contains(&wrong_rate) {
            return Err(ActionError::WrongRate { got: wrong_rate });
        }
        self.wrong_rate = wrong_rate;
        Ok(self)
    }

    /// The process in which actions are chosen.
    pub fn mdp(&self) -> &'a Mdp {
        self.mdp
    }

    /// Choices, repeats counted.
    pub fn n_choices(&self) -> usize {
        self.n_choices
    }

    /// Something that evaluates this likelihood at one θ after another, fastest when they lie close together; one per
    /// chain. What it was asked before changes answers by rounding only.
    pub fn evaluator(&self) -> ActionEvaluator<'_> {
        ActionEvaluator::new(self)
    }
}
