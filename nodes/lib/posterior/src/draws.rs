//! Draws from the posterior and how far they can be trusted.

use diagnostics::Series;

use crate::EvidenceKind;

/// Draws of the weights, chains one after another.
#[derive(Debug, Clone, PartialEq)]
pub struct Draws {
    /// Chains.
    pub n_chains: usize,
    /// Draws per chain.
    pub per_chain: usize,
    /// Weights per draw.
    pub n_features: usize,
    /// Weights, row-major, one row per draw.
    pub values: Vec<f64>,
    /// Log-likelihood of each draw, nats.
    pub log_likelihood: Vec<f64>,
    /// The rationality of every term of the model, in its order.
    pub betas: Vec<BetaDraws>,
    /// The most probable weights a posteriori; on a sphere, where the prior is uniform, the most likely ones. Without evidence
    /// all equal and positive. Ties within half a thousandth of a nat go to the weights of smaller sum of squares.
    pub map_weights: Vec<f64>,
    /// The β of every term that goes with them.
    pub map_betas: Vec<f64>,
    /// Their log-likelihood.
    pub map_log_likelihood: f64,
    /// Mean probability with which proposals were accepted.
    pub acceptance: f64,
    /// Largest rank-normalised split R̂ over the weights, the learned βs and the log-likelihood.
    pub rhat_max: f64,
    /// Smallest bulk effective sample size over the same.
    pub ess_bulk_min: f64,
    /// Median bulk effective sample size over the same.
    pub ess_bulk_median: f64,
    /// Smallest tail effective sample size over the same.
    pub ess_tail_min: f64,
    /// What a later run on a little more evidence can start from.
    pub warm: Warm,
}

/// Where the chains ended, and the step size and scale they used: a start for a run on more evidence.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Warm {
    pub(crate) positions: Vec<Vec<f64>>,
    pub(crate) scale: Vec<f64>,
    pub(crate) step_size: f64,
}

/// The rationality of one term.
#[derive(Debug, Clone, PartialEq)]
pub struct BetaDraws {
    /// Of the term.
    pub kind: EvidenceKind,
    /// One per draw where β is learned, else a single one: the fixed β.
    pub values: Vec<f64>,
}

impl BetaDraws {
    /// β of one draw.
    pub fn at(&self, draw: usize) -> f64 {
        self.values[if self.values.len() == 1 { 0 } else { draw }]
    }

    /// Mean over the draws.
    pub fn mean(&self) -> f64 {
        self.values.iter().sum::<f64>() / self.values.len() as f64
    }

    /// Whether it was sampled.
    pub fn is_learned(&self) -> bool {
        self.values.len() > 1
    }
}

impl Draws {
    /// Draws over all chains.
    pub fn n(&self) -> usize {
        self.n_chains * self.per_chain
    }

    /// The weights of one draw, an index below [`Draws::n`].
    pub fn weights(&self, draw: usize) -> &[f64] {
        &self.values[draw * self.n_features..(draw + 1) * self.n_features]
    }

    /// All draws of one weight, an index below `n_features`.
    pub fn feature(&self, k: usize) -> Vec<f64> {
        self.values.iter().skip(k).step_by(self.n_features).copied().collect()
    }

    /// Mean of every weight over the draws.
    pub fn mean_weights(&self) -> Vec<f64> {
        let mut mean = vec![0.0; self.n_features];
        for w in self.values.chunks_exact(self.n_features) {
            for (mean, w) in mean.iter_mut().zip(w) {
                *mean += w;
            }
        }
        mean.iter_mut().for_each(|mean| *mean /= self.n() as f64);
        mean
    }

    /// Mean log-likelihood of the draws.
    pub fn log_likelihood_mean(&self) -> f64 {
        self.log_likelihood.iter().sum::<f64>() / self.log_likelihood.len() as f64
    }

    /// Fills in R̂ and the effective sample sizes.
    pub(crate) fn diagnose(&mut self, threads: usize) {
        let learned = self.betas.iter().filter(|betas| betas.is_learned()).map(|betas| betas.values.clone());
        let all: Vec<Vec<f64>> =
            (0..self.n_features).map(|k| self.feature(k)).chain(learned).chain([self.log_likelihood.clone()]).collect();
        let n_chains = self.n_chains;
        let judge = |draws: &Vec<f64>| {
            let series = Series::new(draws, n_chains).expect("chains are equally long, draws finite");
            (series.rhat(), series.ess_bulk(), series.ess_tail())
        };
        let share = all.len().div_ceil(threads.max(1));
        let judged: Vec<(f64, f64, f64)> = if threads < 2 {
            all.iter().map(judge).collect()
        } else {
            std::thread::scope(|scope| {
                let part = |part: &'_ [Vec<f64>]| part.iter().map(judge).collect::<Vec<_>>();
                let running: Vec<_> = all.chunks(share).map(|chunk| scope.spawn(move || part(chunk))).collect();
                running.into_iter().flat_map(|part| part.join().expect("diagnostics do not panic")).collect()
            })
        };
        self.rhat_max = judged.iter().fold(0.0, |worst, x| x.0.max(worst));
        self.ess_tail_min = judged.iter().fold(f64::INFINITY, |worst, x| x.2.min(worst));
        let mut bulk: Vec<f64> = judged.iter().map(|x| x.1).collect();
        bulk.sort_unstable_by(f64::total_cmp);
        self.ess_bulk_min = bulk[0];
        self.ess_bulk_median = bulk[bulk.len() / 2];
    }
}

/// What one chain keeps.
#[derive(Debug, Clone, Default)]
pub(crate) struct Kept {
    pub(crate) values: Vec<f64>,
    pub(crate) betas: Vec<f64>,
    pub(crate) log_likelihood: Vec<f64>,
}

impl Kept {
    pub(crate) fn push(&mut self, w: &[f64], betas: &[f64], log_likelihood: f64) {
        self.values.extend_from_slice(w);
        self.betas.extend_from_slice(betas);
        self.log_likelihood.push(log_likelihood);
    }
}
