//! Hamiltonian Monte Carlo with forces from a possibly coarse density and acceptance by the exact one. Leapfrog with any
//! deterministic force is reversible and keeps volume, so the exact posterior is left invariant however coarse the force
//! is; only the share of accepted moves tells.
//!
//! A trajectory that meets the plane where the prior ends is reflected there (Afshar and Domke 2015).
//!
//! Between trajectories a chain jumps: by normal noise of a size drawn anew over orders of magnitude, or to a draw from the prior.
//! One evaluation each, and what helps where trajectories do not: in corners and kinks, where the prior ends, and between
//! modes.

use rand_chacha::ChaCha8Rng;

use crate::density::{Density, Point};
use crate::linear::{dot, lower_times, upper_times};
use crate::random::{standard_normal, uniform};

/// Time to follow the dynamics for, on average: a little over a quarter of the period of a standard normal.
const TRAJECTORY: f64 = 1.7;
/// Trajectories last between 1 − this and 1 + this times [`TRAJECTORY`].
const JITTER: f64 = 0.3;
/// Leapfrog steps of a trajectory, at most.
pub(crate) const MAX_STEPS: usize = 64;
/// A trajectory whose energy strays by more than this many nats is given up: it would be rejected anyway.
const DIVERGED: f64 = 1000.0;
/// Share of the jumps that go to a draw from the prior, times the number of coordinates: with many of them none is accepted.
const PRIOR_JUMPS: f64 = 0.5;
/// Sizes of the other jumps, in standard deviations of the scale: ln of the smallest and of the largest.
const LOG_JUMPS: (f64, f64) = (-4.6, 1.1);
/// Draws from the prior to try before a chain has no start.
pub(crate) const MAX_STARTS: usize = 1000;

/// Which density decides what is accepted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Acceptance {
    /// The force's: while warming up, nothing is kept.
    Coarse,
    /// The exact one.
    Exact,
}

/// One chain: its position, generator and buffers.
#[derive(Debug)]
pub(crate) struct Chain<D> {
    density: D,
    generator: ChaCha8Rng,
    /// Position.
    pub(crate) z: Vec<f64>,
    /// ∇ log density at z, by the force.
    gradient: Vec<f64>,
    /// By the force.
    coarse: Point,
    /// By the exact density; stale while warming up on the coarse one.
    exact: Point,
    proposal: Proposal,
}

#[derive(Debug)]
struct Proposal {
    z: Vec<f64>,
    gradient: Vec<f64>,
    momentum: Vec<f64>,
    /// Lᵀ∇ at z.
    pulled: Vec<f64>,
    step: Vec<f64>,
}

impl<D: Density> Chain<D> {
    /// A chain that starts at `from`, or at a draw from the prior. `None` if no place of positive density was found.
    pub(crate) fn new(mut density: D, mut generator: ChaCha8Rng, from: Option<&[f64]>) -> Option<Self> {
        let n = density.n();
        let mut gradient = vec![0.0; n];
        let mut found = None;
        for attempt in 0..MAX_STARTS {
            let z = match from {
                Some(z) if attempt == 0 => z.to_vec(),
                _ => density.start(&mut generator),
            };
            let coarse = density.force(&z, &mut gradient);
            let exact = if density.force_is_exact() { coarse } else { density.exact(&z) };
            if coarse.log_density.is_finite() && exact.log_density.is_finite() {
                found = Some((z, coarse, exact));
                break;
            }
        }
        let (z, coarse, exact) = found?;
        let zeros = vec![0.0; n];
        let proposal = Proposal {
            z: z.clone(),
            gradient: zeros.clone(),
            momentum: zeros.clone(),
            pulled: zeros.clone(),
            step: zeros,
        };
        Some(Self { density, generator, z, gradient, coarse, exact, proposal })
    }

    /// Brings the exact density up to date with the position.
    pub(crate) fn refresh_exact(&mut self) {
        self.exact = if self.density.force_is_exact() { self.coarse } else { self.density.exact(&self.z) };
    }

    /// Whether the force gives the density itself.
    pub(crate) fn force_is_exact(&self) -> bool {
        self.density.force_is_exact()
    }

    /// Adds the draw at the position to what is kept.
    pub(crate) fn keep(&mut self, kept: &mut crate::draws::Kept) {
        self.density.keep(&self.z, self.exact.log_likelihood, &mut self.generator, kept);
    }

    /// One transition with the given step size, in coordinates scaled by the lower factor `scale` of a covariance.
    /// A trajectory takes at most `max_steps` steps. Returns the probability with which the move was accepted.
    pub(crate) fn advance(&mut self, step_size: f64, scale: &[f64], acceptance: Acceptance, max_steps: usize) -> f64 {
        let length = TRAJECTORY * (1.0 + JITTER * (2.0 * uniform(&mut self.generator) - 1.0));
        let n_steps = libm::ceil(length / step_size).clamp(1.0, max_steps as f64);
        let step_size = step_size.min(length / n_steps);
        for p in &mut self.proposal.momentum {
            *p = standard_normal(&mut self.generator);
        }
        let threshold = libm::log(uniform(&mut self.generator));

        self.proposal.z.copy_from_slice(&self.z);
        self.proposal.gradient.copy_from_slice(&self.gradient);
        self.pull(scale);
        let before = 0.5 * dot(&self.proposal.momentum, &self.proposal.momentum);
        let mut coarse = self.coarse;
        let energy = before - self.coarse.log_density;
        let (mut highest, mut last) = (energy, energy);
        for _ in 0..n_steps as usize {
            self.kick(0.5 * step_size);
            self.drift_reflected(step_size, scale);
            coarse = self.density.force(&self.proposal.z, &mut self.proposal.gradient);
            self.pull(scale);
            self.kick(0.5 * step_size);
            last = 0.5 * dot(&self.proposal.momentum, &self.proposal.momentum) - coarse.log_density;
            highest = highest.max(last);
            if last.is_nan() || last - energy > DIVERGED {
                return 0.0;
            }
        }
        // As it would be given up the other way round.
        if highest - last > DIVERGED {
            return 0.0;
        }
        let kinetic = before - 0.5 * dot(&self.proposal.momentum, &self.proposal.momentum);
        let (exact, gain) = match acceptance {
            Acceptance::Coarse => (coarse, coarse.log_density - self.coarse.log_density),
            Acceptance::Exact => {
                let same = self.density.force_is_exact();
                let exact = if same { coarse } else { self.density.exact(&self.proposal.z) };
                (exact, exact.log_density - self.exact.log_density)
            }
        };
        let log_ratio = gain + kinetic;
        // A trajectory that left the numbers altogether (NaN) is rejected as well.
        if log_ratio >= threshold {
            std::mem::swap(&mut self.z, &mut self.proposal.z);
            std::mem::swap(&mut self.gradient, &mut self.proposal.gradient);
            self.coarse = coarse;
            self.exact = exact;
        }
        if log_ratio.is_nan() { 0.0 } else { libm::exp(log_ratio.min(0.0)) }
    }

    /// A jump, with the same `scale`.
    pub(crate) fn jump(&mut self, scale: &[f64]) {
        let from_prior = uniform(&mut self.generator) < PRIOR_JUMPS / self.z.len() as f64;
        if from_prior {
            self.proposal.z = self.density.start(&mut self.generator);
        } else {
            let (least, most) = LOG_JUMPS;
            let dimension = libm::sqrt(self.z.len() as f64);
            let size = libm::exp(least + (most - least) * uniform(&mut self.generator)) / dimension;
            for p in &mut self.proposal.momentum {
                *p = standard_normal(&mut self.generator);
            }
            self.proposal.z.copy_from_slice(&self.z);
            self.drift(size, scale);
        }
        let threshold = libm::log(uniform(&mut self.generator));
        let there = self.density.exact(&self.proposal.z);
        // A draw from the prior is proposed with its prior density, which leaves the likelihoods and where the prior ends.
        let gain = if from_prior && there.log_density.is_finite() {
            there.log_likelihood - self.exact.log_likelihood
        } else {
            there.log_density - self.exact.log_density
        };
        if gain >= threshold {
            std::mem::swap(&mut self.z, &mut self.proposal.z);
            self.exact = there;
            self.coarse = self.density.force(&self.z, &mut self.gradient);
        }
    }

    /// Lᵀ∇ of the proposal.
    fn pull(&mut self, scale: &[f64]) {
        let Proposal { gradient, pulled, .. } = &mut self.proposal;
        upper_times(scale, gradient, pulled);
    }

    /// p += t Lᵀ∇.
    fn kick(&mut self, time: f64) {
        let Proposal { momentum, pulled, .. } = &mut self.proposal;
        for (p, pulled) in momentum.iter_mut().zip(pulled) {
            *p += time * *pulled;
        }
    }

    /// The same, with reflection at the wall if there is one: where n·z becomes 0 the momentum is mirrored at m = Lᵀn.
    fn drift_reflected(&mut self, time: f64, scale: &[f64]) {
        self.drift(time, scale);
        let Some(wall) = self.density.wall() else { return };
        let Proposal { z, momentum, step, .. } = &mut self.proposal;
        let (beyond, speed) = (dot(wall, z), dot(wall, step));
        if !(beyond < 0.0 && speed < 0.0) {
            return;
        }
        let mut mirror = vec![0.0; wall.len()];
        upper_times(scale, wall, &mut mirror);
        let along = 2.0 * dot(&mirror, momentum) / dot(&mirror, &mirror);
        for (p, m) in momentum.iter_mut().zip(&mirror) {
            *p -= along * m;
        }
        // Back to the wall, then on for the time that is left.
        let overrun = beyond / speed;
        for (z, step) in z.iter_mut().zip(step.iter()) {
            *z -= overrun * *step;
        }
        self.drift(overrun, scale);
    }

    /// z += t L p.
    fn drift(&mut self, time: f64, scale: &[f64]) {
        let Proposal { z, momentum, step, .. } = &mut self.proposal;
        lower_times(scale, momentum, step);
        for (z, step) in z.iter_mut().zip(step) {
            *z += time * *step;
        }
    }
}
