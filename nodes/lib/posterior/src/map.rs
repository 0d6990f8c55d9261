//! The most probable weights (and learned rationalities) a posteriori.

use crate::linear::{cholesky, dot, lower_times, upper_times};
use crate::model::ModelEvaluator;
use crate::most_likely::most_likely;
use crate::prior::{log_prior, nearest_on_sphere};
use crate::{Draws, Model, Prior, Rationality, TermLikelihood};

/// Climbs end after this many steps, or when one gains less than [`NEGLIGIBLE`].
const MAX_STEPS: usize = 200;
/// Nats.
const NEGLIGIBLE: f64 = 1e-10;
/// Halvings of a step before a direction is given up.
const MAX_HALVINGS: usize = 40;

/// Where the posterior is highest.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Map {
    pub(crate) weights: Vec<f64>,
    pub(crate) betas: Vec<f64>,
    pub(crate) log_likelihood: f64,
}

/// The highest place of the posterior: for placements of known rationality on a sphere a function of the evidence alone, else
/// the top of climbs from the best draw of every chain.
pub(crate) fn most_probable(model: &Model<'_>, draws: &Draws) -> Map {
    let on_sphere = matches!(model.prior, Prior::L1Sphere | Prior::L2Sphere);
    match model.terms.as_slice() {
        [] if on_sphere && model.nonnegative_return.is_none() => {
            return Map {
                weights: nearest_on_sphere(model.prior, &vec![0.0; model.n_features]),
                betas: Vec::new(),
                log_likelihood: 0.0,
            };
        }
        [term] if on_sphere && model.nonnegative_return.is_none() => {
            if let (TermLikelihood::Placements(placements), Rationality::Fixed(beta)) =
                (&term.likelihood, term.rationality)
                && placements.exact().wrong_rate() == 0.0
            {
                let (weights, log_likelihood) = most_likely(model.prior, beta, placements.exact(), placements.force());
                return Map { weights, betas: vec![beta], log_likelihood };
            }
        }
        _ => {}
    }
    let mut climber = Climber::new(model, draws);
    let mut best: Option<(f64, Vec<f64>)> = None;
    for chain in 0..draws.n_chains {
        let (height, top) = climber.climb(climber.best_draw(draws, chain));
        if best.as_ref().is_none_or(|(so_far, _)| height > *so_far) {
            best = Some((height, top));
        }
    }
    let (_, top) = best.expect("there is at least one chain");
    let (weights, log_betas) = top.split_at(model.n_features);
    let betas = climber.betas(log_betas);
    let log_likelihood = climber.evaluator.log_likelihood(weights, &betas);
    Map { weights: weights.to_vec(), betas, log_likelihood }
}

/// Climbs in (w, ln β of the learned) along directions scaled by the covariance of the draws.
struct Climber<'a> {
    model: &'a Model<'a>,
    evaluator: ModelEvaluator<'a>,
    /// Lower Cholesky factor of the covariance of the draws; `None` where they do not spread in all directions.
    scale: Option<Vec<f64>>,
}

impl<'a> Climber<'a> {
    fn new(model: &'a Model<'a>, draws: &Draws) -> Self {
        Self { model, evaluator: model.evaluator(), scale: covariance_factor(model, draws) }
    }

    fn n(&self) -> usize {
        self.model.n_features + self.model.terms.iter().filter(|term| term.rationality.is_learned()).count()
    }

    /// β of every term.
    fn betas(&self, log_betas: &[f64]) -> Vec<f64> {
        let mut learned = log_betas.iter();
        let beta = |rationality: Rationality| match rationality {
            Rationality::Fixed(beta) => beta,
            Rationality::Learned { .. } => libm::exp(*learned.next().expect("one for each learned rationality")),
        };
        self.model.terms.iter().map(|term| term.rationality).map(beta).collect()
    }

    /// The draw of one chain with the highest posterior density.
    fn best_draw(&self, draws: &Draws, chain: usize) -> Vec<f64> {
        let of_chain = chain * draws.per_chain..(chain + 1) * draws.per_chain;
        let height = |i: usize| {
            let place = place(draws, i);
            draws.log_likelihood[i] + self.log_prior(&place)
        };
        let best = of_chain.map(|i| (height(i), i)).max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
        place(draws, best.expect("chains are not empty").1)
    }

    /// Log prior density of a place, −∞ where the known return is negative.
    fn log_prior(&self, place: &[f64]) -> f64 {
        let (w, log_betas) = place.split_at(self.model.n_features);
        if self.model.nonnegative_return.as_ref().is_some_and(|features| dot(features, w) < 0.0) {
            return f64::NEG_INFINITY;
        }
        let mut sum = log_prior(self.model.prior, w);
        let learned = self.model.terms.iter().filter_map(|term| match term.rationality {
            Rationality::Fixed(_) => None,
            Rationality::Learned { median, log_sd } => Some((libm::log(median), log_sd)),
        });
        for ((centre, log_sd), u) in learned.zip(log_betas) {
            let z = (u - centre) / log_sd;
            sum -= 0.5 * z * z;
        }
        sum
    }

    /// Log posterior density up to a constant, and its gradient.
    fn height(&mut self, place: &[f64], gradient: &mut [f64]) -> f64 {
        let n_features = self.model.n_features;
        let (w, log_betas) = place.split_at(n_features);
        let betas = self.betas(log_betas);
        let mut by_log_beta = vec![0.0; betas.len()];
        let (by_weight, by_learned) = gradient.split_at_mut(n_features);
        let log_likelihood = self.evaluator.log_likelihood_and_gradient(w, &betas, by_weight, &mut by_log_beta);
        for (g, w) in by_weight.iter_mut().zip(w) {
            *g += match self.model.prior {
                Prior::L1Sphere | Prior::L2Sphere => 0.0,
                Prior::Gaussian { scale } => -w / (scale * scale),
                Prior::Laplace { scale } => -w.signum() / scale,
            };
        }
        let mut by_learned = by_learned.iter_mut();
        let mut log_betas = log_betas.iter();
        for (term, slope) in self.model.terms.iter().zip(&by_log_beta) {
            if let Rationality::Learned { median, log_sd } = term.rationality {
                let u = log_betas.next().expect("one for each learned rationality");
                let g = by_learned.next().expect("one for each learned rationality");
                *g = slope - (u - libm::log(median)) / (log_sd * log_sd);
            }
        }
        log_likelihood + self.log_prior(place)
    }

    /// The point of the prior's support nearest to a place.
    fn feasible(&self, mut place: Vec<f64>) -> Vec<f64> {
        if matches!(self.model.prior, Prior::L1Sphere | Prior::L2Sphere) {
            let w = nearest_on_sphere(self.model.prior, &place[..self.model.n_features]);
            place[..self.model.n_features].copy_from_slice(&w);
        }
        place
    }

    fn climb(&mut self, start: Vec<f64>) -> (f64, Vec<f64>) {
        let n = self.n();
        let mut place = start;
        let (mut gradient, mut there) = (vec![0.0; n], vec![0.0; n]);
        let mut height = self.height(&place, &mut gradient);
        let mut rates = [1.0, 1.0];
        for _ in 0..MAX_STEPS {
            let before = height;
            // Along the scaled gradient, and where that leads nowhere along the gradient itself.
            for (which, rate) in rates.iter_mut().enumerate() {
                let Some(direction) = self.direction(which, &gradient) else { continue };
                for _ in 0..MAX_HALVINGS {
                    let stepped = place.iter().zip(&direction).map(|(x, d)| x + *rate * d).collect();
                    let next = self.feasible(stepped);
                    let value = self.height(&next, &mut there);
                    if value > height {
                        (height, place) = (value, next);
                        std::mem::swap(&mut gradient, &mut there);
                        *rate *= 2.0;
                        break;
                    }
                    *rate *= 0.5;
                }
                *rate = rate.max(1e-9);
                if height > before {
                    break;
                }
            }
            if height - before < NEGLIGIBLE * (1.0 + height.abs()) {
                break;
            }
        }
        (height, place)
    }

    fn direction(&self, which: usize, gradient: &[f64]) -> Option<Vec<f64>> {
        if which == 1 {
            return Some(gradient.to_vec());
        }
        let scale = self.scale.as_ref()?;
        let (mut half, mut whole) = (vec![0.0; gradient.len()], vec![0.0; gradient.len()]);
        upper_times(scale, gradient, &mut half);
        lower_times(scale, &half, &mut whole);
        Some(whole)
    }
}

/// (w, ln β of the learned) of one draw.
fn place(draws: &Draws, draw: usize) -> Vec<f64> {
    let learned = draws.betas.iter().filter(|betas| betas.is_learned()).map(|betas| libm::log(betas.at(draw)));
    draws.weights(draw).iter().copied().chain(learned).collect()
}

/// Lower Cholesky factor of the covariance of the draws, a little widened so that it exists on a sphere too.
fn covariance_factor(model: &Model<'_>, draws: &Draws) -> Option<Vec<f64>> {
    let n = model.n_features + draws.betas.iter().filter(|betas| betas.is_learned()).count();
    let mut mean = vec![0.0; n];
    // A few hundred draws tell the scale well enough.
    let stride = draws.n().div_ceil(8 * n.max(50)).max(1);
    let chosen: Vec<Vec<f64>> = (0..draws.n()).step_by(stride).map(|i| place(draws, i)).collect();
    for x in &chosen {
        for (mean, x) in mean.iter_mut().zip(x) {
            *mean += x / chosen.len() as f64;
        }
    }
    let mut covariance = vec![0.0; n * n];
    for x in &chosen {
        for i in 0..n {
            let centred = (x[i] - mean[i]) / chosen.len() as f64;
            for j in 0..=i {
                covariance[i * n + j] += centred * (x[j] - mean[j]);
            }
        }
    }
    let trace: f64 = (0..n).map(|i| covariance[i * n + i]).sum();
    for i in 0..n {
        covariance[i * n + i] += 1e-6 * trace / n as f64;
    }
    cholesky(&covariance, n)
}
