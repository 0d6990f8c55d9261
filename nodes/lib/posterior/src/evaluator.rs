//! One term's likelihood as the sampler sees it, with the buffers of one chain.

use likelihood::actions::ActionEvaluator;
use likelihood::placements::Scratch;
use likelihood::preferences::PreferenceEvaluator;

use crate::{PlacementTerm, TermLikelihood};

/// Evaluates a term as a function of θ = β w.
#[derive(Debug)]
pub(crate) enum TermEvaluator<'a> {
    Placements { term: &'a PlacementTerm, exact: Scratch, force: Scratch },
    Actions(Box<ActionEvaluator<'a>>),
    Preferences(PreferenceEvaluator<'a>),
}

impl<'a> TermEvaluator<'a> {
    pub(crate) fn new(likelihood: &'a TermLikelihood<'_>) -> Self {
        match likelihood {
            TermLikelihood::Placements(term) => {
                Self::Placements { term, exact: term.exact().scratch(), force: term.force().scratch() }
            }
            TermLikelihood::Actions(likelihood) => Self::Actions(Box::new(likelihood.evaluator())),
            TermLikelihood::Preferences(likelihood) => Self::Preferences(likelihood.evaluator()),
        }
    }

    /// The log-likelihood.
    pub(crate) fn exact(&mut self, theta: &[f64]) -> f64 {
        match self {
            Self::Placements { term, exact, .. } => term.exact().value_with(theta, exact),
            Self::Actions(evaluator) => evaluator.value(theta),
            Self::Preferences(evaluator) => evaluator.value(theta),
        }
    }

    /// A log-likelihood near the exact one, or that itself, and its gradient ∇_θ.
    pub(crate) fn force(&mut self, theta: &[f64], gradient: &mut [f64]) -> f64 {
        match self {
            Self::Placements { term, force, .. } => term.force().value_and_gradient_with(theta, gradient, force),
            Self::Actions(evaluator) => evaluator.value_and_gradient(theta, gradient),
            Self::Preferences(evaluator) => evaluator.value_and_gradient(theta, gradient),
        }
    }

    /// Whether [`Self::force`] is the likelihood itself.
    pub(crate) fn force_is_exact(&self) -> bool {
        !matches!(self, Self::Placements { term, .. } if term.force_is_coarse())
    }
}
