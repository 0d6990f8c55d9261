//! The likelihood of choices and its gradient at one θ after another.

use mdp::Solver;
use pulp::{Arch, Simd, WithSimd};

use super::log_product::LogProduct;
use crate::actions::{ActionLikelihood, Item};

/// Below this a sum of probabilities relative to the largest has lost what it was a sum of.
const VANISHED: f64 = 1e-290;

/// Evaluates an [`ActionLikelihood`]; remembers policies it has seen, for speed alone.
#[derive(Debug, Clone)]
pub struct ActionEvaluator<'a> {
    likelihood: &'a ActionLikelihood<'a>,
    solver: Solver<'a>,
    /// f Q*(s, b) of every group, row by row.
    logits: Vec<f64>,
    /// The exponentials of the logits, less the largest of their row.
    exponentials: Vec<f64>,
    /// ∂L/∂Q*(s, a) as (s, a, derivative).
    slopes: Vec<(usize, usize, f64)>,
    arch: Arch,
}

/// π(·|s) and what it is made of.
#[derive(Debug, Clone, Copy)]
struct Softmax<'a> {
    /// f Q*(s, b).
    logits: &'a [f64],
    /// π(b|s) times `sum`: the largest is 1.
    exponentials: &'a [f64],
    sum: f64,
    /// The largest logit.
    most: f64,
}

impl<'a> ActionEvaluator<'a> {
    pub(super) fn new(likelihood: &'a ActionLikelihood<'a>) -> Self {
        let size = likelihood.groups.len() * likelihood.mdp.n_actions();
        Self {
            likelihood,
            solver: Solver::new(likelihood.mdp),
            logits: vec![0.0; size],
            exponentials: vec![0.0; size],
            slopes: Vec::with_capacity(size),
            arch: Arch::new(),
        }
    }

    /// log P(choices | θ); −∞ where θ is not finite.
    ///
    /// # Panics
    /// When `theta` does not hold one number per feature.
    pub fn value(&mut self, theta: &[f64]) -> f64 {
        self.evaluate(theta, None)
    }

    /// log P(choices | θ), and its gradient by θ into `gradient`. Where two policies are equally good Q* has a kink, and
    /// the gradient is that of the one with the first actions. −∞ and a gradient of 0 where θ is not finite.
    ///
    /// # Panics
    /// When `theta` or `gradient` do not hold one number per feature.
    pub fn value_and_gradient(&mut self, theta: &[f64], gradient: &mut [f64]) -> f64 {
        assert_eq!(gradient.len(), self.likelihood.mdp.n_features(), "a gradient by every feature");
        gradient.fill(0.0);
        self.evaluate(theta, Some(gradient))
    }

    fn evaluate(&mut self, theta: &[f64], gradient: Option<&mut [f64]>) -> f64 {
        if self.likelihood.groups.is_empty() {
            return 0.0;
        }
        if theta.iter().any(|x| !x.is_finite()) {
            return f64::NEG_INFINITY;
        }
        let Self { likelihood, solver, logits, exponentials, slopes, arch } = self;
        let n_actions = likelihood.mdp.n_actions();
        let optimum = solver.solve(theta);
        for ((group, logits), shifted) in likelihood
            .groups
            .iter()
            .zip(logits.chunks_exact_mut(n_actions))
            .zip(exponentials.chunks_exact_mut(n_actions))
        {
            for (action, logit) in logits.iter_mut().enumerate() {
                *logit = group.factor * optimum.q(group.state, action);
            }
            let most = largest(logits.iter().copied());
            for (shifted, logit) in shifted.iter_mut().zip(logits) {
                *shifted = *logit - most;
            }
        }
        arch.dispatch(Exponentials(exponentials));

        slopes.clear();
        let (mut value, mut ratios, mut first) = (0.0, LogProduct::default(), 0);
        for ((group, logits), exponentials) in
            likelihood.groups.iter().zip(logits.chunks_exact(n_actions)).zip(exponentials.chunks_exact(n_actions))
        {
            let softmax = Softmax::new(logits, exponentials);
            let start = slopes.len();
            if gradient.is_some() {
                slopes.extend((0..n_actions).map(|action| (group.state, action, 0.0)));
            }
            for item in &likelihood.items[first..group.end] {
                let (log_probability, ratio) = softmax.log_probability(item, likelihood.wrong_rate);
                value += log_probability * item.count;
                ratios.multiply(ratio, item.count);
                if gradient.is_some() {
                    softmax.add_slopes(item, likelihood.wrong_rate, group.factor, &mut slopes[start..]);
                }
            }
            first = group.end;
        }
        if let Some(gradient) = gradient {
            optimum.add_gradient(slopes, gradient);
        }
        value + ratios.log()
    }
}

/// Each number becomes its exponential. A named operation, because a closure would not be inlined into the dispatch and miss the
/// machine's vectors.
struct Exponentials<'a>(&'a mut [f64]);

impl WithSimd for Exponentials<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        for x in self.0 {
            *x = scene::exp(*x);
        }
    }
}

fn largest(numbers: impl Iterator<Item = f64>) -> f64 {
    numbers.fold(f64::NEG_INFINITY, f64::max)
}

impl<'a> Softmax<'a> {
    fn new(logits: &'a [f64], exponentials: &'a [f64]) -> Self {
        let sum = exponentials.iter().fold(0.0, |sum, e| sum + e);
        Self { logits, exponentials, sum, most: largest(logits.iter().copied()) }
    }

    /// log of what the item says, log π, or log(1 − π) where it is judged bad, as a number and a factor whose logarithm is to be
    /// added: logarithms of many factors are cheaper together.
    fn log_probability(&self, item: &Item, wrong_rate: f64) -> (f64, f64) {
        if wrong_rate > 0.0 {
            return (0.0, self.mixed(item, wrong_rate));
        }
        if !item.bad {
            return (self.logits[item.action] - self.most, 1.0 / self.sum);
        }
        let others = self.others(item.action);
        if others > VANISHED {
            return (0.0, others / self.sum);
        }
        let (most, sum) = self.without(item.action);
        (most - self.most, sum / self.sum)
    }

    /// (1 − ε) π + ε/A, or 1 minus that.
    fn mixed(&self, item: &Item, wrong_rate: f64) -> f64 {
        let uniform = 1.0 / self.logits.len() as f64;
        if item.bad {
            (1.0 - wrong_rate) * self.others(item.action) / self.sum + wrong_rate * (1.0 - uniform)
        } else {
            (1.0 - wrong_rate) * self.exponentials[item.action] / self.sum + wrong_rate * uniform
        }
    }

    /// Σ of the exponentials of all actions but one: that of 1 − π without cancellation.
    fn others(&self, action: usize) -> f64 {
        self.exponentials.iter().enumerate().filter(|(other, _)| *other != action).fold(0.0, |sum, (_, e)| sum + e)
    }

    /// Largest logit but that of one action, and Σ exp(logit − largest) over the others.
    fn without(&self, action: usize) -> (f64, f64) {
        let others = || self.logits.iter().enumerate().filter(|(other, _)| *other != action).map(|(_, logit)| *logit);
        let most = largest(others());
        (most, others().fold(0.0, |sum, logit| sum + scene::exp(logit - most)))
    }

    /// Adds the derivatives of the item, repeats counted, by Q*(s, ·).
    fn add_slopes(&self, item: &Item, wrong_rate: f64, factor: f64, slopes: &mut [(usize, usize, f64)]) {
        let weight = item.count * factor;
        if item.bad && wrong_rate == 0.0 {
            self.add_slopes_of_the_others(item, weight, slopes);
            return;
        }
        let weight = if wrong_rate > 0.0 {
            let sign = if item.bad { -1.0 } else { 1.0 };
            let probability = self.exponentials[item.action] / self.sum;
            weight * sign * (1.0 - wrong_rate) * probability / self.mixed(item, wrong_rate)
        } else {
            weight
        };
        let per_exponential = weight / self.sum;
        for (slope, e) in slopes.iter_mut().zip(self.exponentials) {
            slope.2 -= per_exponential * e;
        }
        slopes[item.action].2 += weight;
    }

    /// Adds the derivatives of log(1 − π).
    fn add_slopes_of_the_others(&self, item: &Item, weight: f64, slopes: &mut [(usize, usize, f64)]) {
        let others = self.others(item.action);
        if others > VANISHED {
            // e / others − e / sum, of which the part of the action itself is only the second.
            let (of_others, of_all) = (weight / others, weight / self.sum);
            for (slope, e) in slopes.iter_mut().zip(self.exponentials) {
                slope.2 += (of_others - of_all) * e;
            }
            slopes[item.action].2 -= of_others * self.exponentials[item.action];
            return;
        }
        let (most, sum) = self.without(item.action);
        for ((slope, e), logit) in slopes.iter_mut().zip(self.exponentials).zip(self.logits) {
            let renormalised = if slope.1 == item.action { 0.0 } else { scene::exp(logit - most) / sum };
            slope.2 += weight * (renormalised - e / self.sum);
        }
    }
}
