//! What a posterior is of: one weight vector, its prior, and terms of evidence, each with a rationality of its own.

use likelihood::actions::ActionLikelihood;
use likelihood::preferences::PreferenceLikelihood;

use crate::evaluator::TermEvaluator;
use crate::{PlacementTerm, Prior};

/// More weights than this are refused.
pub const MAX_FEATURES: usize = 4096;

/// What kind of evidence a term holds. People are not equally rational in all of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum EvidenceKind {
    /// Where something belongs on a table.
    Placements,
    /// State–action demonstrations (equation 3.5).
    Actions,
    /// Comparisons and rankings of trajectories (equation 6.4).
    Preferences,
    /// Good and bad segments of a trajectory.
    Critiques,
    /// Time-ordered demonstrations of a learner, as weak preferences.
    Progress,
}

impl EvidenceKind {
    /// Every kind, in the order in which they are listed everywhere.
    pub const ALL: [Self; 5] = [Self::Placements, Self::Actions, Self::Preferences, Self::Critiques, Self::Progress];

    /// As in parameters, messages and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Placements => "placements",
            Self::Actions => "actions",
            Self::Preferences => "preferences",
            Self::Critiques => "critiques",
            Self::Progress => "progress",
        }
    }
}

/// The rationality β of a kind of evidence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rationality {
    /// Known.
    Fixed(f64),
    /// Learned with the weights; a priori ln β ~ N(ln `median`, `log_sd`²).
    Learned {
        /// Of the prior.
        median: f64,
        /// Standard deviation of ln β.
        log_sd: f64,
    },
}

impl Rationality {
    /// β itself, or its prior median.
    pub fn median(self) -> f64 {
        match self {
            Self::Fixed(beta) => beta,
            Self::Learned { median, .. } => median,
        }
    }

    /// Whether it is sampled with the weights.
    pub fn is_learned(self) -> bool {
        matches!(self, Self::Learned { .. })
    }
}

/// How probable the evidence of a term is.
#[derive(Debug, Clone)]
pub enum TermLikelihood<'a> {
    /// Placements on tables.
    Placements(PlacementTerm),
    /// Actions of a decision process, demonstrated, good or bad.
    Actions(ActionLikelihood<'a>),
    /// Comparisons of trajectories.
    Preferences(PreferenceLikelihood),
}

impl TermLikelihood<'_> {
    /// Number of weights it is about.
    pub fn n_features(&self) -> usize {
        match self {
            Self::Placements(term) => term.n_features(),
            Self::Actions(likelihood) => likelihood.mdp().n_features(),
            Self::Preferences(likelihood) => likelihood.n_features(),
        }
    }
}

/// Evidence of one kind.
#[derive(Debug, Clone)]
pub struct Term<'a> {
    /// Which.
    pub kind: EvidenceKind,
    /// β of this kind.
    pub rationality: Rationality,
    /// How probable the evidence is under θ = β w.
    pub likelihood: TermLikelihood<'a>,
}

/// A posterior: prior times the likelihoods of all terms. All terms are about the same weights.
#[derive(Debug, Clone)]
pub struct Model<'a> {
    /// Number k of weights.
    pub n_features: usize,
    /// Of the weights.
    pub prior: Prior,
    /// Φ of the worst demonstration, k numbers: the prior is zero where w·Φ < 0 (equation E.3 as it is meant).
    pub nonnegative_return: Option<Vec<f64>>,
    /// The evidence.
    pub terms: Vec<Term<'a>>,
}

/// Why a model has no posterior.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ModelError {
    /// No weights, or too many.
    #[error("{got} weights; 1 to {MAX_FEATURES} are supported")]
    Features {
        /// Got.
        got: usize,
    },
    /// A term about other weights.
    #[error("the {kind} are about {got} weights, but the model has {expected}")]
    OtherFeatures {
        /// Of the term.
        kind: &'static str,
        /// Got.
        got: usize,
        /// Of the model.
        expected: usize,
    },
    /// A rationality or prior scale that is no positive number.
    #[error("{name} is {got}, but must be a number between {least} and {most}")]
    Range {
        /// What.
        name: String,
        /// Got.
        got: f64,
        /// Smallest allowed.
        least: f64,
        /// Largest allowed.
        most: f64,
    },
    /// The return that is known to be non-negative has other features.
    #[error("the features of the worst demonstration are {got} numbers, but the model has {expected} weights")]
    ReturnLength {
        /// Got.
        got: usize,
        /// Of the model.
        expected: usize,
    },
    /// The return that is known to be non-negative is no number.
    #[error("feature {index} of the worst demonstration is {value}, not a finite number")]
    ReturnNotFinite {
        /// Place in the vector.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// No weights of positive prior density were found.
    #[error(
        "no start: {tries} draws from the prior all have probability zero under the evidence or the non-negative return"
    )]
    NoStart {
        /// Draws tried.
        tries: usize,
    },
}

/// Allowed rationality, of every kind. Wide: utilities of features summed over long trajectories are large.
const BETA: (f64, f64) = (1e-6, 1e6);
/// Allowed standard deviation of ln β.
const LOG_SD: (f64, f64) = (1e-3, 5.0);
/// Allowed scale of a Gaussian or Laplace prior.
const SCALE: (f64, f64) = (1e-6, 1e6);

impl Model<'_> {
    /// Checks everything that the parts could not check themselves.
    ///
    /// # Errors
    /// The first thing that does not fit.
    pub fn check(&self) -> Result<(), ModelError> {
        if self.n_features == 0 || self.n_features > MAX_FEATURES {
            return Err(ModelError::Features { got: self.n_features });
        }
        if let Prior::Gaussian { scale } | Prior::Laplace { scale } = self.prior {
            in_range("the scale of the prior".into(), scale, SCALE)?;
        }
        if let Some(features) = &self.nonnegative_return {
            if features.len() != self.n_features {
                return Err(ModelError::ReturnLength { got: features.len(), expected: self.n_features });
            }
            if let Some(index) = features.iter().position(|x| !x.is_finite()) {
                return Err(ModelError::ReturnNotFinite { index, value: features[index] });
            }
        }
        for term in &self.terms {
            let (kind, got) = (term.kind.name(), term.likelihood.n_features());
            if got != self.n_features {
                return Err(ModelError::OtherFeatures { kind, got, expected: self.n_features });
            }
            in_range(format!("beta of the {kind}"), term.rationality.median(), BETA)?;
            if let Rationality::Learned { log_sd, .. } = term.rationality {
                in_range(format!("the standard deviation of ln beta of the {kind}"), log_sd, LOG_SD)?;
            }
        }
        Ok(())
    }

    /// Log-likelihood of all evidence, nats, at weights w and one β per term.
    pub fn log_likelihood(&self, w: &[f64], betas: &[f64]) -> f64 {
        self.evaluator().log_likelihood(w, betas)
    }

    /// The same for many weights: buffers and solved policies are kept from one to the next.
    pub fn evaluator(&self) -> ModelEvaluator<'_> {
        let terms = self.terms.iter().map(|term| TermEvaluator::new(&term.likelihood)).collect();
        ModelEvaluator { terms, theta: vec![0.0; self.n_features], gradient: vec![0.0; self.n_features] }
    }

    /// β of every term where it is fixed, its prior median where it is learned.
    pub fn median_betas(&self) -> Vec<f64> {
        self.terms.iter().map(|term| term.rationality.median()).collect()
    }
}

fn in_range(name: String, got: f64, (least, most): (f64, f64)) -> Result<(), ModelError> {
    if (least..=most).contains(&got) { Ok(()) } else { Err(ModelError::Range { name, got, least, most }) }
}

/// Evaluates a model's likelihood; one per thread.
#[derive(Debug)]
pub struct ModelEvaluator<'a> {
    terms: Vec<TermEvaluator<'a>>,
    theta: Vec<f64>,
    gradient: Vec<f64>,
}

impl ModelEvaluator<'_> {
    /// Log-likelihood at weights w and one β per term.
    pub fn log_likelihood(&mut self, w: &[f64], betas: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (term, &beta) in self.terms.iter_mut().zip(betas) {
            scaled(beta, w, &mut self.theta);
            sum += term.exact(&self.theta);
        }
        sum
    }

    /// The same with its gradient ∇_w and its derivatives ∂/∂ ln β of every term, both overwritten.
    pub fn log_likelihood_and_gradient(
        &mut self,
        w: &[f64],
        betas: &[f64],
        gradient: &mut [f64],
        by_log_beta: &mut [f64],
    ) -> f64 {
        gradient.fill(0.0);
        let mut sum = 0.0;
        for ((term, &beta), slope) in self.terms.iter_mut().zip(betas).zip(by_log_beta) {
            scaled(beta, w, &mut self.theta);
            sum += term.force(&self.theta, &mut self.gradient);
            *slope = crate::linear::dot(&self.gradient, &self.theta);
            for (total, g) in gradient.iter_mut().zip(&self.gradient) {
                *total += beta * g;
            }
        }
        sum
    }

    /// Whether what [`Self::log_likelihood_and_gradient`] gives is the likelihood itself, not something near it.
    pub(crate) fn force_is_exact(&self) -> bool {
        self.terms.iter().all(TermEvaluator::force_is_exact)
    }
}

/// θ = β w.
fn scaled(beta: f64, w: &[f64], theta: &mut [f64]) {
    for (theta, w) in theta.iter_mut().zip(w) {
        *theta = beta * w;
    }
}
