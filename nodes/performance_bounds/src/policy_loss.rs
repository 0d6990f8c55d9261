//! What a policy loses against the best that can be done, under every draw, and bounds on it.

use crate::Settings;
use crate::policy_bounds::dot;
use crate::risk_message::risk_message;
use apprentice_msgs::msg::{Posterior, RiskBound};
use exchange::World;
use mdp::{Policy, feature_counts, policy_losses};
use risk::{Measure, Reference, Sample, Tail, normalised_losses, risk_bound};

/// The share of its mean loss below which choosing at random is nearly optimal, and its loss no longer divides.
const LOSS_FLOOR: f64 = 1e-3;
/// Losses below this share of Σ |w_i Phi_i| are rounding, as in `mdp::policy_losses`.
const NO_LOSS: f64 = 1e-9;
/// Draws on a sphere in single precision pass its radius by up to this share.
const ROUNDING: f64 = 1e-6;

/// What losses are measured against: the best return of every draw, and what choosing at random loses.
pub(crate) struct Losses<'a> {
    settings: &'a Settings,
    posterior: &'a Posterior,
    world: &'a World,
    draws: &'a [f64],
    delta: f64,
    optimal: Vec<f64>,
    random: Vec<f64>,
    floor: f64,
    /// Best return of each vertex ±e_i of the L1 sphere; none where the prior has no size.
    vertices: Vec<f64>,
    /// Largest ‖w‖₁ that the prior allows; none when it allows any.
    size: Option<f64>,
}

impl<'a> Losses<'a> {
    pub(crate) fn new(
        settings: &'a Settings,
        posterior: &'a Posterior,
        world: &'a World,
        draws: &'a [f64],
        delta: f64,
    ) -> Result<Self, String> {
        let k = world.mdp.n_features();
        let uniform = feature_counts(&world.mdp, &Policy::uniform(&world.mdp)).map_err(|error| error.to_string())?;
        let threads = settings.n_threads();
        // The best return is what choosing at random returns and what it loses.
        let best = |weights: &[f64], random: &[f64]| -> Vec<f64> {
            weights.chunks_exact(k).zip(random).map(|(w, loss)| dot(w, &uniform) + loss).collect()
        };
        let lost_at_random =
            |weights: &[f64]| policy_losses(&world.mdp, &uniform, weights, threads).map_err(|error| error.to_string());
        let random = lost_at_random(draws)?;
        let mean = random.iter().sum::<f64>() / random.len() as f64;
        let size = match posterior.prior.as_str() {
            "l1_sphere" => Some(1.0),
            "l2_sphere" => Some((k as f64).sqrt()),
            _ => None,
        };
        let vertices: Vec<f64> = match size {
            Some(_) => (0..2 * k).flat_map(|i| (0..k).map(move |j| vertex(i, j))).collect(),
            None => Vec::new(),
        };
        Ok(Self {
            settings,
            posterior,
            world,
            draws,
            delta,
            vertices: best(&vertices, &lost_at_random(&vertices)?),
            size,
            optimal: best(draws, &random),
            floor: (LOSS_FLOOR * mean).max(f64::MIN_POSITIVE),
            random,
        })
    }

    /// Bounds on the quantile and on the tail mean of the losses, and on the quantile of the normalised ones.
    pub(crate) fn bounds(&self, counts: &[f64], returns: &[f64]) -> Result<[RiskBound; 3], String> {
        let alpha = self.settings.alpha;
        let size = |w: &[f64]| w.iter().zip(counts).map(|(w, phi)| (w * phi).abs()).sum::<f64>();
        let draws = self.draws.chunks_exact(counts.len());
        let compared = self.optimal.iter().zip(returns).zip(draws);
        let losses: Vec<f64> = compared.map(|((best, own), w)| loss(best - own, size(w))).collect();
        let reference = Reference { name: "uniform random", losses: &self.random };
        let normalised = normalised_losses(&losses, &reference, self.floor).map_err(|error| error.to_string())?;
        let bound = |values: &[f64], measure, worst| {
            let sample = Sample { values, n_chains: self.posterior.n_chains as usize, weights: None };
            let outcome = risk_bound(&sample, measure, self.delta, worst, Tail::Upper);
            outcome.map(|outcome| risk_message(&outcome)).map_err(|error| error.to_string())
        };
        let quantile = Measure::ValueAtRisk { alpha };
        Ok([
            bound(&losses, quantile, None)?,
            bound(&losses, Measure::ConditionalValueAtRisk { alpha }, self.worst(counts))?,
            bound(&normalised.values, quantile, None)?,
        ])
    }

    /// The largest loss that weights of the prior can give: a loss is convex in w, so it is largest at a vertex.
    fn worst(&self, counts: &[f64]) -> Option<f64> {
        let k = self.world.mdp.n_features();
        let own = |i: usize| (0..k).map(|j| vertex(i, j) * counts[j]).sum::<f64>();
        let losses = self.vertices.iter().enumerate().map(|(i, best)| best - own(i));
        Some(self.size? * (1.0 + ROUNDING) * losses.fold(0.0, f64::max))
    }
}

/// V* − w.Phi, where what rounding may have made of zero is zero: ranks of its noise would look like chains that disagree.
fn loss(difference: f64, size: f64) -> f64 {
    if difference > NO_LOSS * size { difference } else { 0.0 }
}

/// Coordinate j of vertex i of the L1 sphere: e_0, −e_0, e_1, …
fn vertex(i: usize, j: usize) -> f64 {
    match (i / 2 == j, i % 2) {
        (false, _) => 0.0,
        (true, 0) => 1.0,
        (true, _) => -1.0,
    }
}
