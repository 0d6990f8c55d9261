//! Hamiltonian Monte Carlo on standard-normal coordinates, with forces from a coarse likelihood and acceptance by the
//! exact one. Leapfrog with any deterministic force is reversible and keeps volume, so the exact posterior is left
//! invariant however coarse the force is; only the share of accepted moves tells.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;

use crate::likelihood::Scratch;
use crate::linear::{dot, lower_times, upper_times};
use crate::sphere::Sphere;
use crate::{Likelihood, Prior, normal_quantile};

/// Time to follow the dynamics for, on average: a quarter of the period of a standard normal.
const TRAJECTORY: f64 = std::f64::consts::FRAC_PI_2;
/// Trajectories last between 1 − this and 1 + this times [`TRAJECTORY`].
const JITTER: f64 = 0.3;
/// Leapfrog steps of a trajectory, at most.
const MAX_STEPS: usize = 64;

/// What to sample.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Target<'a> {
    pub(crate) prior: Prior,
    /// Decides what is accepted.
    pub(crate) exact: &'a Likelihood,
    /// Drives the trajectories.
    pub(crate) force: &'a Likelihood,
}

/// Which likelihood decides what is accepted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Acceptance {
    /// The coarse one: while warming up, nothing is kept.
    Coarse,
    /// The exact one.
    Exact,
}

/// One chain: its position, generator and buffers.
#[derive(Debug, Clone)]
pub(crate) struct Chain<'a> {
    target: Target<'a>,
    generator: ChaCha8Rng,
    sphere: Sphere,
    force_scratch: Scratch,
    exact_scratch: Scratch,
    /// Position, standard normal a priori.
    pub(crate) z: Vec<f64>,
    /// Its weights.
    pub(crate) w: Vec<f64>,
    /// ∇ log density at z, by the force.
    gradient: Vec<f64>,
    /// Coarse log-likelihood of w.
    coarse: f64,
    /// Exact log-likelihood of w; stale while warming up on the coarse one.
    pub(crate) exact: f64,
    proposal: Proposal,
}

#[derive(Debug, Clone)]
struct Proposal {
    z: Vec<f64>,
    w: Vec<f64>,
    gradient: Vec<f64>,
    momentum: Vec<f64>,
    step: Vec<f64>,
}

impl<'a> Chain<'a> {
    /// A chain that starts at a draw from the prior.
    pub(crate) fn new(target: Target<'a>, mut generator: ChaCha8Rng) -> Self {
        let n = target.exact.n_features();
        let z: Vec<f64> = (0..n).map(|_| standard_normal(&mut generator)).collect();
        let zeros = vec![0.0; n];
        let mut chain = Self {
            target,
            generator,
            sphere: Sphere::new(target.prior, n),
            force_scratch: target.force.scratch(),
            exact_scratch: target.exact.scratch(),
            z: z.clone(),
            w: zeros.clone(),
            gradient: zeros.clone(),
            coarse: 0.0,
            exact: 0.0,
            proposal: Proposal { z, w: zeros.clone(), gradient: zeros.clone(), momentum: zeros.clone(), step: zeros },
        };
        chain.coarse = chain.evaluate_proposal();
        chain.proposal.w.clone_into(&mut chain.w);
        chain.proposal.gradient.clone_into(&mut chain.gradient);
        chain.refresh_exact();
        chain
    }

    /// Brings the exact log-likelihood up to date with the position.
    pub(crate) fn refresh_exact(&mut self) {
        self.exact = self.target.exact.value_with(&self.w, &mut self.exact_scratch);
    }

    /// One transition with the given step size, in coordinates scaled by the lower factor `scale` of a covariance.
    /// Returns the probability with which the move was accepted.
    pub(crate) fn advance(&mut self, step_size: f64, scale: &[f64], acceptance: Acceptance) -> f64 {
        let length = TRAJECTORY * (1.0 + JITTER * (2.0 * uniform(&mut self.generator) - 1.0));
        let n_steps = libm::ceil(length / step_size).clamp(1.0, MAX_STEPS as f64);
        let step_size = step_size.min(length / n_steps);
        for p in &mut self.proposal.momentum {
            *p = standard_normal(&mut self.generator);
        }
        let threshold = libm::log(uniform(&mut self.generator));

        self.proposal.z.copy_from_slice(&self.z);
        self.proposal.gradient.copy_from_slice(&self.gradient);
        let before = dot(&self.proposal.momentum, &self.proposal.momentum);
        let mut coarse = self.coarse;
        for _ in 0..n_steps as usize {
            self.kick(0.5 * step_size, scale);
            self.drift(step_size, scale);
            coarse = self.evaluate_proposal();
            self.kick(0.5 * step_size, scale);
        }
        let kinetic = 0.5 * (before - dot(&self.proposal.momentum, &self.proposal.momentum));
        let prior = 0.5 * (dot(&self.z, &self.z) - dot(&self.proposal.z, &self.proposal.z));
        let (exact, gain) = match acceptance {
            Acceptance::Coarse => (f64::NAN, coarse - self.coarse),
            Acceptance::Exact => {
                let exact = self.target.exact.value_with(&self.proposal.w, &mut self.exact_scratch);
                (exact, exact - self.exact)
            }
        };
        let log_ratio = gain + prior + kinetic;
        // A trajectory that left the numbers altogether (NaN) is rejected as well.
        if log_ratio >= threshold {
            std::mem::swap(&mut self.z, &mut self.proposal.z);
            std::mem::swap(&mut self.w, &mut self.proposal.w);
            std::mem::swap(&mut self.gradient, &mut self.proposal.gradient);
            self.coarse = coarse;
            self.exact = exact;
        }
        if log_ratio.is_nan() { 0.0 } else { libm::exp(log_ratio.min(0.0)) }
    }

    /// p += t Lᵀ∇.
    fn kick(&mut self, time: f64, scale: &[f64]) {
        let Proposal { gradient, momentum, step, .. } = &mut self.proposal;
        upper_times(scale, gradient, step);
        for (p, step) in momentum.iter_mut().zip(step) {
            *p += time * *step;
        }
    }

    /// z += t L p.
    fn drift(&mut self, time: f64, scale: &[f64]) {
        let Proposal { z, momentum, step, .. } = &mut self.proposal;
        lower_times(scale, momentum, step);
        for (z, step) in z.iter_mut().zip(step) {
            *z += time * *step;
        }
    }

    /// Weights, coarse log-likelihood (returned) and gradient of the log density at the proposed z.
    fn evaluate_proposal(&mut self) -> f64 {
        let Proposal { z, w, gradient, .. } = &mut self.proposal;
        self.sphere.weights(z, w);
        let coarse = self.target.force.value_and_gradient_with(w, gradient, &mut self.force_scratch);
        self.sphere.pull_back(w, gradient);
        for (g, z) in gradient.iter_mut().zip(z) {
            *g -= *z;
        }
        coarse
    }
}

/// Uniform in the open unit interval.
fn uniform(generator: &mut ChaCha8Rng) -> f64 {
    ((generator.next_u64() >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
}

fn standard_normal(generator: &mut ChaCha8Rng) -> f64 {
    normal_quantile(uniform(generator))
}
