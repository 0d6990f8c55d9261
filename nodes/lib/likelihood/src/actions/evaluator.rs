//! The likelihood of choices and its gradient at one θ after another.

use mdp::Solver;

use crate::actions::{ActionLikelihood, Item};

/// Evaluates an [`ActionLikelihood`]; remembers policies it has seen, for speed alone.
#[derive(Debug, Clone)]
pub struct ActionEvaluator<'a> {
    likelihood: &'a ActionLikelihood<'a>,
    solver: Solver<'a>,
    softmax: Softmax,
    /// ∂L/∂Q*(s, a) as (s, a, derivative).
    slopes: Vec<(usize, usize, f64)>,
}

/// π(·|s) and what it is made of.
#[derive(Debug, Clone)]
struct Softmax {
    /// f Q*(s, b).
    logits: Vec<f64>,
    /// π(b|s).
    probabilities: Vec<f64>,
    /// log Σ_b exp of the logits.
    log_sum: f64,
}

impl<'a> ActionEvaluator<'a> {
    pub(super) fn new(likelihood: &'a ActionLikelihood<'a>) -> Self {
        let n_actions = likelihood.mdp.n_actions();
        let softmax = Softmax { logits: vec![0.0; n_actions], probabilities: vec![0.0; n_actions], log_sum: 0.0 };
        let slopes = Vec::with_capacity(likelihood.groups.len() * n_actions);
        Self { likelihood, solver: Solver::new(likelihood.mdp), softmax, slopes }
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
        let Self { likelihood, solver, softmax, slopes } = self;
        let optimum = solver.solve(theta);
        slopes.clear();
        let (mut value, mut first) = (0.0, 0);
        for group in &likelihood.groups {
            softmax.set(group.factor, |action| optimum.q(group.state, action));
            let start = slopes.len();
            if gradient.is_some() {
                slopes.extend((0..softmax.logits.len()).map(|action| (group.state, action, 0.0)));
            }
            for item in &likelihood.items[first..group.end] {
                value += softmax.log_probability(item, likelihood.wrong_rate) * item.count;
                if gradient.is_some() {
                    softmax.add_slopes(item, likelihood.wrong_rate, group.factor, &mut slopes[start..]);
                }
            }
            first = group.end;
        }
        if let Some(gradient) = gradient {
            optimum.add_gradient(slopes, gradient);
        }
        value
    }
}

impl Softmax {
    fn set(&mut self, factor: f64, q: impl Fn(usize) -> f64) {
        let mut most = f64::NEG_INFINITY;
        for (action, logit) in self.logits.iter_mut().enumerate() {
            *logit = factor * q(action);
            most = most.max(*logit);
        }
        let mut sum = 0.0;
        for (p, logit) in self.probabilities.iter_mut().zip(&self.logits) {
            *p = libm::exp(logit - most);
            sum += *p;
        }
        self.probabilities.iter_mut().for_each(|p| *p /= sum);
        self.log_sum = most + libm::log(sum);
    }

    /// log of what the item says: log π, or log(1 − π) where it is judged bad.
    fn log_probability(&self, item: &Item, wrong_rate: f64) -> f64 {
        if wrong_rate > 0.0 {
            return libm::log(self.mixed(item, wrong_rate));
        }
        if item.bad {
            let (most, sum) = self.without(item.action);
            return most + libm::log(sum) - self.log_sum;
        }
        self.logits[item.action] - self.log_sum
    }

    /// (1 − ε) π + ε/A, or 1 minus that.
    fn mixed(&self, item: &Item, wrong_rate: f64) -> f64 {
        let uniform = 1.0 / self.logits.len() as f64;
        if item.bad {
            (1.0 - wrong_rate) * self.others(item.action) + wrong_rate * (1.0 - uniform)
        } else {
            (1.0 - wrong_rate) * self.probabilities[item.action] + wrong_rate * uniform
        }
    }

    /// Σ of π over all actions but one: 1 − π without cancellation.
    fn others(&self, action: usize) -> f64 {
        self.probabilities.iter().enumerate().filter(|(other, _)| *other != action).map(|(_, p)| p).sum()
    }

    /// Largest logit but that of one action, and Σ exp(logit − largest) over the others.
    fn without(&self, action: usize) -> (f64, f64) {
        let others = || self.logits.iter().enumerate().filter(|(other, _)| *other != action).map(|(_, logit)| *logit);
        let most = others().fold(f64::NEG_INFINITY, f64::max);
        (most, others().map(|logit| libm::exp(logit - most)).sum())
    }

    /// Adds the derivatives of the item, repeats counted, by Q*(s, ·).
    fn add_slopes(&self, item: &Item, wrong_rate: f64, factor: f64, slopes: &mut [(usize, usize, f64)]) {
        let chosen = |action: usize| f64::from(u8::from(action == item.action));
        let weight = item.count * factor;
        if wrong_rate > 0.0 {
            let sign = if item.bad { -1.0 } else { 1.0 };
            let share = (1.0 - wrong_rate) * self.probabilities[item.action] / self.mixed(item, wrong_rate);
            for (slope, p) in slopes.iter_mut().zip(&self.probabilities) {
                slope.2 += weight * sign * share * (chosen(slope.1) - p);
            }
        } else if item.bad {
            let (most, sum) = self.without(item.action);
            for ((slope, p), logit) in slopes.iter_mut().zip(&self.probabilities).zip(&self.logits) {
                let renormalised = if slope.1 == item.action { 0.0 } else { libm::exp(logit - most) / sum };
                slope.2 += weight * (renormalised - p);
            }
        } else {
            for (slope, p) in slopes.iter_mut().zip(&self.probabilities) {
                slope.2 += weight * (chosen(slope.1) - p);
            }
        }
    }
}
