//! The posterior of preferences under a rotation-invariant prior, collapsed to the span of the feature differences.
//!
//! With z = (z_∥, z_⊥) ~ N(0, I), z_∥ in the r-dimensional span, the likelihood under w = z/‖z‖ depends on z_∥ and on ρ = ‖z_⊥‖ alone,
//! and ρ² ~ χ²_{k−r}. So r + 1 coordinates are sampled instead of k; the direction of z_⊥ is uniform, independent of everything,
//! and drawn anew for every draw that is kept. Under a Gaussian prior z_⊥ is independent altogether.

use likelihood::preferences::{Basis, PreferenceEvaluator, PreferenceLikelihood};
use rand_chacha::ChaCha8Rng;

use crate::density::{Density, Point};
use crate::draws::Kept;
use crate::full_density::Betas;
use crate::linear::{dot, norm_squared};
use crate::random::standard_normal;
use crate::{Model, Prior, Rationality, TermLikelihood};

/// Directions of the span shorter than this, relative to the longest, are rounding.
const TOLERANCE: f64 = 1e-10;

/// The span of a model's feature differences, and its terms there.
#[derive(Debug)]
pub(crate) struct Plan {
    basis: Basis,
    terms: Vec<PreferenceLikelihood>,
    nonnegative_return: Option<Vec<f64>>,
}

/// One chain's view of a collapsed model. Coordinates: z_∥ (r), ln ρ shifted and scaled (only on the sphere), learned ln β.
#[derive(Debug)]
pub(crate) struct CollapsedDensity<'a> {
    model: &'a Model<'a>,
    plan: &'a Plan,
    evaluators: Vec<PreferenceEvaluator<'a>>,
    betas: Betas,
    /// k − r.
    n_across: f64,
    /// ρ of the last place; 0 where the prior is no sphere.
    radius: f64,
    /// ‖(z_∥, ρ)‖ on the sphere, 1/σ under a Gaussian prior: w_∥ = z_∥ / this.
    norm: f64,
    w: Vec<f64>,
    theta: Vec<f64>,
    by_term: Vec<f64>,
    by_log_beta: Vec<f64>,
    /// The plane w·Φ = 0.
    wall: Option<Vec<f64>>,
}

impl<'a> CollapsedDensity<'a> {
    /// The plan for a model that has one: preferences alone, on few enough directions, under a rotation-invariant prior.
    pub(crate) fn plan(model: &Model<'_>) -> Option<Plan> {
        if !matches!(model.prior, Prior::L2Sphere | Prior::Gaussian { .. }) || model.terms.is_empty() {
            return None;
        }
        let terms: Option<Vec<&PreferenceLikelihood>> = model
            .terms
            .iter()
            .map(|term| match &term.likelihood {
                TermLikelihood::Preferences(preferences) => Some(preferences),
                _ => None,
            })
            .collect();
        let terms = terms?;
        let mut found: Vec<Vec<f64>> = model.nonnegative_return.iter().cloned().collect();
        let mut basis = None;
        for term in &terms {
            let extra: Vec<&[f64]> = found.iter().map(Vec::as_slice).collect();
            let span = term.difference_span(&extra, TOLERANCE);
            found = span.rows().chunks_exact(model.n_features).map(<[f64]>::to_vec).collect();
            basis = Some(span);
        }
        let basis = basis?;
        if basis.rank() == 0 || basis.rank() + 1 >= model.n_features {
            return None;
        }
        let terms = terms.iter().map(|term| term.projected(&basis)).collect();
        let nonnegative_return = model.nonnegative_return.as_ref().map(|features| basis.coordinates(features));
        Some(Plan { basis, terms, nonnegative_return })
    }

    pub(crate) fn new(model: &'a Model<'a>, plan: &'a Plan) -> Self {
        let rationalities: Vec<Rationality> = model.terms.iter().map(|term| term.rationality).collect();
        let rank = plan.basis.rank();
        let n_learned = rationalities.iter().filter(|rationality| rationality.is_learned()).count();
        let n_flat = n_learned + usize::from(model.prior == Prior::L2Sphere);
        let wall = plan.nonnegative_return.as_ref();
        Self {
            wall: wall.map(|features| features.iter().copied().chain(vec![0.0; n_flat]).collect()),
            model,
            plan,
            evaluators: plan.terms.iter().map(PreferenceLikelihood::evaluator).collect(),
            by_log_beta: vec![0.0; rationalities.len()],
            betas: Betas::new(rationalities),
            n_across: (model.n_features - rank) as f64,
            radius: 0.0,
            norm: 1.0,
            w: vec![0.0; rank],
            theta: vec![0.0; rank],
            by_term: vec![0.0; rank],
        }
    }

    fn rank(&self) -> usize {
        self.w.len()
    }

    fn on_sphere(&self) -> bool {
        self.model.prior == Prior::L2Sphere
    }

    /// ρ = √ν exp(s/√(2ν)) with ν = k − r: about standard normal in s.
    fn radius_at(&self, s: f64) -> f64 {
        libm::sqrt(self.n_across) * libm::exp(s / libm::sqrt(2.0 * self.n_across))
    }

    /// w_∥, ρ and the βs at z; log prior density there, −∞ where it is zero.
    fn locate(&mut self, z: &[f64]) -> f64 {
        let rank = self.rank();
        let along = &z[..rank];
        let mut log_prior = -0.5 * norm_squared(along);
        let log_betas = match self.model.prior {
            Prior::Gaussian { scale } => {
                self.norm = 1.0 / scale;
                &z[rank..]
            }
            _ => {
                let s = z[rank];
                self.radius = self.radius_at(s);
                log_prior += self.n_across * s / libm::sqrt(2.0 * self.n_across) - 0.5 * self.radius * self.radius;
                self.norm = libm::sqrt(norm_squared(along) + self.radius * self.radius).max(f64::MIN_POSITIVE);
                &z[rank + 1..]
            }
        };
        for (w, z) in self.w.iter_mut().zip(along) {
            *w = z / self.norm;
        }
        self.betas.set(log_betas);
        log_prior -= 0.5 * norm_squared(log_betas);
        match &self.plan.nonnegative_return {
            Some(features) if dot(features, &self.w) < 0.0 => f64::NEG_INFINITY,
            _ => log_prior,
        }
    }
}

impl Density for CollapsedDensity<'_> {
    fn n(&self) -> usize {
        self.rank() + usize::from(self.on_sphere()) + self.betas.n_learned()
    }

    fn start(&mut self, generator: &mut ChaCha8Rng) -> Vec<f64> {
        let mut z: Vec<f64> = (0..self.rank()).map(|_| standard_normal(generator)).collect();
        if self.on_sphere() {
            let square: f64 = (0..self.n_across as usize).map(|_| standard_normal(generator)).map(|x| x * x).sum();
            let ratio = libm::log(libm::sqrt(square / self.n_across).max(f64::MIN_POSITIVE));
            z.push(ratio * libm::sqrt(2.0 * self.n_across));
        }
        z.extend((0..self.betas.n_learned()).map(|_| standard_normal(generator)));
        z
    }

    fn force(&mut self, z: &[f64], gradient: &mut [f64]) -> Point {
        let log_prior = self.locate(z);
        let rank = self.rank();
        let (by_weight, rest) = gradient.split_at_mut(rank);
        by_weight.fill(0.0);
        let mut log_likelihood = 0.0;
        for ((evaluator, &beta), slope) in
            self.evaluators.iter_mut().zip(self.betas.values()).zip(&mut self.by_log_beta)
        {
            for (theta, w) in self.theta.iter_mut().zip(&self.w) {
                *theta = beta * w;
            }
            log_likelihood += evaluator.value_and_gradient(&self.theta, &mut self.by_term);
            *slope = dot(&self.by_term, &self.theta);
            for (total, g) in by_weight.iter_mut().zip(&self.by_term) {
                *total += beta * g;
            }
        }
        let log_betas = if self.on_sphere() {
            // w = (z_∥, ρ) / ‖·‖: the radial part of the gradient goes, and ρ feels what is left of it.
            let radial = dot(by_weight, &self.w);
            for ((g, w), z) in by_weight.iter_mut().zip(&self.w).zip(z) {
                *g = (*g - w * radial) / self.norm - z;
            }
            let stretch = libm::sqrt(2.0 * self.n_across);
            let by_radius = -self.radius / self.norm * radial / self.norm - self.radius;
            rest[0] = self.n_across / stretch + by_radius * self.radius / stretch;
            &mut rest[1..]
        } else {
            for (g, z) in by_weight.iter_mut().zip(z) {
                *g = *g / self.norm - z;
            }
            rest
        };
        self.betas.pull_back(&self.by_log_beta, log_betas);
        let n = log_betas.len();
        for (g, z) in log_betas.iter_mut().zip(&z[z.len() - n..]) {
            *g -= *z;
        }
        Point { log_density: log_prior + log_likelihood, log_likelihood }
    }

    fn exact(&mut self, z: &[f64]) -> Point {
        let log_prior = self.locate(z);
        let mut log_likelihood = 0.0;
        for (evaluator, &beta) in self.evaluators.iter_mut().zip(self.betas.values()) {
            for (theta, w) in self.theta.iter_mut().zip(&self.w) {
                *theta = beta * w;
            }
            log_likelihood += evaluator.value(&self.theta);
        }
        Point { log_density: log_prior + log_likelihood, log_likelihood }
    }

    fn force_is_exact(&self) -> bool {
        true
    }

    fn wall(&self) -> Option<&[f64]> {
        self.wall.as_deref()
    }

    fn keep(&mut self, z: &[f64], log_likelihood: f64, generator: &mut ChaCha8Rng, kept: &mut Kept) {
        self.locate(z);
        let mut across: Vec<f64> = (0..self.model.n_features).map(|_| standard_normal(generator)).collect();
        for row in self.plan.basis.rows().chunks_exact(self.model.n_features) {
            let along = dot(row, &across);
            for (x, row) in across.iter_mut().zip(row) {
                *x -= along * row;
            }
        }
        let factor = match self.model.prior {
            // Already normal in all directions across.
            Prior::Gaussian { scale } => scale,
            _ => self.radius / self.norm / libm::sqrt(norm_squared(&across)).max(f64::MIN_POSITIVE),
        };
        across.iter_mut().for_each(|x| *x *= factor);
        for (row, w) in self.plan.basis.rows().chunks_exact(self.model.n_features).zip(&self.w) {
            for (x, row) in across.iter_mut().zip(row) {
                *x += w * row;
            }
        }
        kept.push(&across, self.betas.values(), log_likelihood);
    }
}
