//! The posterior in standard-normal coordinates: one for each weight, one for each learned ln β.

use rand_chacha::ChaCha8Rng;

use crate::density::{Density, Point};
use crate::draws::Kept;
use crate::linear::dot;
use crate::model::ModelEvaluator;
use crate::prior::Transform;
use crate::random::standard_normal;
use crate::{Model, Prior, Rationality};

/// One chain's view of a model.
#[derive(Debug)]
pub(crate) struct FullDensity<'a> {
    model: &'a Model<'a>,
    evaluator: ModelEvaluator<'a>,
    transform: Transform,
    betas: Betas,
    w: Vec<f64>,
    by_log_beta: Vec<f64>,
    /// Where w is a positive multiple of z, the plane w·Φ = 0.
    wall: Option<Vec<f64>>,
}

impl<'a> FullDensity<'a> {
    pub(crate) fn new(model: &'a Model<'a>) -> Self {
        let rationalities: Vec<Rationality> = model.terms.iter().map(|term| term.rationality).collect();
        let n_learned = rationalities.iter().filter(|rationality| rationality.is_learned()).count();
        let straight = matches!(model.prior, Prior::L2Sphere | Prior::Gaussian { .. });
        let wall = model.nonnegative_return.as_ref().filter(|_| straight);
        Self {
            model,
            wall: wall.map(|features| features.iter().copied().chain(vec![0.0; n_learned]).collect()),
            evaluator: model.evaluator(),
            transform: Transform::new(model.prior, model.n_features),
            by_log_beta: vec![0.0; rationalities.len()],
            betas: Betas::new(rationalities),
            w: vec![0.0; model.n_features],
        }
    }

    /// w and the βs at z; whether the prior is positive there.
    fn locate(&mut self, z: &[f64]) -> bool {
        let (weights, log_betas) = z.split_at(self.model.n_features);
        self.transform.weights(weights, &mut self.w);
        self.betas.set(log_betas);
        self.model.nonnegative_return.as_ref().is_none_or(|features| dot(features, &self.w) >= 0.0)
    }
}

impl Density for FullDensity<'_> {
    fn n(&self) -> usize {
        self.model.n_features + self.betas.n_learned()
    }

    fn start(&mut self, generator: &mut ChaCha8Rng) -> Vec<f64> {
        (0..self.n()).map(|_| standard_normal(generator)).collect()
    }

    fn force(&mut self, z: &[f64], gradient: &mut [f64]) -> Point {
        let positive = self.locate(z);
        let (by_weight, by_learned) = gradient.split_at_mut(self.model.n_features);
        let log_likelihood =
            self.evaluator.log_likelihood_and_gradient(&self.w, self.betas.values(), by_weight, &mut self.by_log_beta);
        self.transform.pull_back(&self.w, by_weight);
        self.betas.pull_back(&self.by_log_beta, by_learned);
        for (g, z) in gradient.iter_mut().zip(z) {
            *g -= *z;
        }
        point(z, log_likelihood, positive)
    }

    fn exact(&mut self, z: &[f64]) -> Point {
        if !self.locate(z) {
            return point(z, f64::NEG_INFINITY, false);
        }
        let log_likelihood = self.evaluator.log_likelihood(&self.w, self.betas.values());
        point(z, log_likelihood, true)
    }

    fn force_is_exact(&self) -> bool {
        self.evaluator.force_is_exact()
    }

    fn wall(&self) -> Option<&[f64]> {
        self.wall.as_deref()
    }

    fn keep(&mut self, z: &[f64], log_likelihood: f64, _generator: &mut ChaCha8Rng, kept: &mut Kept) {
        self.locate(z);
        kept.push(&self.w, self.betas.values(), log_likelihood);
    }
}

/// Standard normal times likelihood.
fn point(z: &[f64], log_likelihood: f64, positive: bool) -> Point {
    let log_density = if positive { log_likelihood - 0.5 * dot(z, z) } else { f64::NEG_INFINITY };
    Point { log_density, log_likelihood }
}

/// The rationalities of all terms, of which some are coordinates.
#[derive(Debug, Clone)]
pub(crate) struct Betas {
    rationalities: Vec<Rationality>,
    values: Vec<f64>,
}

impl Betas {
    pub(crate) fn new(rationalities: Vec<Rationality>) -> Self {
        let values = rationalities.iter().map(|rationality| rationality.median()).collect();
        Self { rationalities, values }
    }

    pub(crate) fn n_learned(&self) -> usize {
        self.rationalities.iter().filter(|rationality| rationality.is_learned()).count()
    }

    pub(crate) fn values(&self) -> &[f64] {
        &self.values
    }

    /// β = median · exp(log_sd · z) of those that are learned.
    pub(crate) fn set(&mut self, z: &[f64]) {
        let mut z = z.iter();
        for (value, rationality) in self.values.iter_mut().zip(&self.rationalities) {
            if let Rationality::Learned { median, log_sd } = rationality {
                let z = z.next().expect("one coordinate for each learned rationality");
                *value = median * libm::exp(log_sd * z);
            }
        }
    }

    /// ∂/∂z of those that are learned from ∂/∂ ln β of all.
    pub(crate) fn pull_back(&self, by_log_beta: &[f64], gradient: &mut [f64]) {
        let mut gradient = gradient.iter_mut();
        for (slope, rationality) in by_log_beta.iter().zip(&self.rationalities) {
            if let Rationality::Learned { log_sd, .. } = rationality {
                *gradient.next().expect("one coordinate for each learned rationality") = log_sd * slope;
            }
        }
    }
}
