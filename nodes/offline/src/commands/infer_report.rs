//! What an inference found, as JSON and as tables.

use std::path::Path;

use data_encoding::HEXLOWER;
use posterior::{Draws, Prior, Rationality};
use serde_json::{Map, Value, json};

use crate::answer::{aligned, cells, short};
use crate::evidence::Evidence;
use crate::sampling::{Sample, Summary};

/// Fewer effective draws a chain do not carry a bound.
const MIN_ESS_PER_CHAIN: f64 = 100.0;
/// Weights shown in a table; the JSON has all.
const SHOWN: usize = 30;

/// Whether draws can be used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Verdict {
    /// They can.
    Ready,
    /// The chains disagree.
    NotMixed,
    /// They are worth too few independent ones.
    NotEnoughSamples,
}

impl Verdict {
    pub(super) fn of(draws: &Draws) -> Self {
        let needed = MIN_ESS_PER_CHAIN * draws.n_chains as f64;
        if draws.rhat_max.is_nan() || draws.rhat_max > risk::MAX_RHAT {
            Self::NotMixed
        } else if !(draws.ess_bulk_min >= needed && draws.ess_tail_min >= needed) {
            Self::NotEnoughSamples
        } else {
            Self::Ready
        }
    }

    fn word(self) -> &'static str {
        match self {
            Self::Ready => "ready",
            Self::NotMixed => "not_mixed",
            Self::NotEnoughSamples => "not_enough_samples",
        }
    }

    fn reason(self, draws: &Draws) -> String {
        let (rhat, most) = (draws.rhat_max, risk::MAX_RHAT);
        let ess = draws.ess_bulk_min.min(draws.ess_tail_min);
        let needed = MIN_ESS_PER_CHAIN * draws.n_chains as f64;
        match self {
            Self::Ready => format!("the chains agree (R-hat {rhat:.4}) and the draws are worth {ess:.0} at least"),
            Self::NotMixed => format!("R-hat is {rhat:.4}, at most {most} is wanted: take more --draws or --warmup"),
            Self::NotEnoughSamples => {
                format!("the draws are worth {ess:.0}, at least {needed:.0} are wanted: take more --draws")
            }
        }
    }
}

/// All there is to tell.
pub(super) struct Inference<'a> {
    pub(super) evidence: &'a Evidence,
    pub(super) sample: &'a Sample,
    /// Of the weights, then of the learned βs.
    pub(super) summaries: &'a [Summary],
    pub(super) verdict: Verdict,
    pub(super) seed: u64,
    pub(super) sampler: String,
}

impl Inference<'_> {
    /// A warning where even the most probable weights explain strict evidence no better than indifference does.
    pub(super) fn no_better_than_chance(&self) -> Option<&'static str> {
        let n: usize = self.evidence.counts().iter().map(|(_, n)| n).sum();
        let likely = self.sample.draws.map_log_likelihood > self.sample.indifferent + 1e-9;
        (n > 0 && !likely && !self.evidence.has_undecided()).then_some(
            "even the most probable weights explain the evidence no better than answers at random would: it contradicts \
             itself, says nothing about these features, or beta is too large",
        )
    }

    pub(super) fn json(&self, cycles: &[Vec<usize>], warnings: &[String], seconds: f64, cpu_seconds: f64) -> Value {
        let draws = &self.sample.draws;
        let weights = &self.summaries[..draws.n_features];
        let each = |of: fn(&Summary) -> f64| weights.iter().map(of).collect::<Vec<f64>>();
        json!({
            "outcome": self.verdict.word(),
            "reason": self.verdict.reason(draws),
            "mean": each(|s| s.mean),
            "sd": each(|s| s.sd),
            "q05": each(|s| s.q05),
            "q95": each(|s| s.q95),
            "mcse": each(|s| s.mcse),
            "rhat": each(|s| s.rhat),
            "ess_bulk": each(|s| s.ess_bulk),
            "ess_tail": each(|s| s.ess_tail),
            "map": draws.map_weights,
            "log_likelihood_mean": draws.log_likelihood_mean(),
            "map_log_likelihood": draws.map_log_likelihood,
            "beta": self.single_beta(),
            "betas": self.betas(),
            "evidence": self.evidence.counts().iter().map(|(kind, n)| (kind.name().to_owned(), json!(n))).collect::<Map<_, _>>(),
            "n_trajectories": self.evidence.n_items(),
            "evidence_hash": HEXLOWER.encode(&self.sample.evidence_hash),
            "answer_model": self.evidence.answer_model_json(),
            "prior": prior_json(self.sample.prior),
            "sampler": self.sampler,
            "seed": self.seed,
            "rhat_max": draws.rhat_max,
            "ess_min": draws.ess_bulk_min,
            "ess_median": draws.ess_bulk_median,
            "ess_tail_min": draws.ess_tail_min,
            "acceptance": draws.acceptance,
            "n_draws": draws.n(),
            "n_chains": draws.n_chains,
            "n_features": draws.n_features,
            "cycles": cycles,
            "warnings": warnings,
            "seconds": seconds,
            "cpu_seconds": cpu_seconds,
            "version": env!("CARGO_PKG_VERSION"),
        })
    }

    /// β where all kinds have the same: its mean. Nothing where they differ.
    fn single_beta(&self) -> Option<f64> {
        let betas: Vec<f64> = self.sample.draws.betas.iter().map(posterior::BetaDraws::mean).collect();
        let first = *betas.first()?;
        betas.iter().all(|beta| *beta == first).then_some(first)
    }

    /// The βs with what is known of them, by kind.
    fn betas(&self) -> Value {
        let mut learned = self.summaries[self.sample.draws.n_features..].iter();
        let mut map = Map::new();
        for (i, betas) in self.sample.draws.betas.iter().enumerate() {
            let value = match (self.evidence.rationality(betas.kind), learned_summary(betas, &mut learned)) {
                (Rationality::Learned { median, log_sd }, Some(s)) => json!({
                    "learned": true, "mean": s.mean, "sd": s.sd, "q05": s.q05, "q95": s.q95, "mcse": s.mcse,
                    "map": self.sample.draws.map_betas[i], "rhat": s.rhat, "ess_bulk": s.ess_bulk, "ess_tail": s.ess_tail,
                    "prior": { "median": median, "log_sd": log_sd },
                }),
                _ => {
                    let beta = betas.mean();
                    json!({ "learned": false, "mean": beta, "q05": beta, "q95": beta, "map": beta })
                }
            };
            map.insert(betas.kind.name().to_owned(), value);
        }
        Value::Object(map)
    }

    pub(super) fn text(&self, warnings: &[String], seconds: f64, out: Option<&Path>) -> String {
        let draws = &self.sample.draws;
        let mut text = format!("Posterior of {} weights: {}\n", draws.n_features, self.verdict.word());
        text += &format!("  {}\n", self.verdict.reason(draws));
        for warning in warnings {
            text += &format!("  warning: {warning}\n");
        }
        text += "\nEvidence and rationality\n";
        text += &self.evidence_table();
        text += "\nWeights\n";
        text += &self.weights_table();
        if draws.n_features > SHOWN {
            text += &format!("  … the {SHOWN} largest of {}; --json has all\n", draws.n_features);
        }
        text += "\nSampling\n";
        let figure = |name: &str, value: String| vec![name.to_owned(), value];
        text += &aligned(&[
            figure("prior", prior_words(self.sample.prior)),
            figure("sampler, seed", format!("{}, {}", self.sampler, self.seed)),
            figure("draws", format!("{} in {} chains", draws.n(), draws.n_chains)),
            figure("R-hat, largest", format!("{:.4}", draws.rhat_max)),
            figure("effective draws, least", format!("{:.0}", draws.ess_bulk_min)),
            figure("effective draws, median", format!("{:.0}", draws.ess_bulk_median)),
            figure("effective draws in the tails, least", format!("{:.0}", draws.ess_tail_min)),
            figure("acceptance", format!("{:.3}", draws.acceptance)),
            figure("log-likelihood, mean (nats)", short(draws.log_likelihood_mean())),
            figure("log-likelihood, most probable weights (nats)", short(draws.map_log_likelihood)),
            figure("evidence", HEXLOWER.encode(&self.sample.evidence_hash[..8])),
            figure("time (s)", format!("{seconds:.2}")),
        ]);
        if let Some(out) = out {
            text += &format!("\nDraws written to {}\n", out.display());
        }
        text
    }

    fn evidence_table(&self) -> String {
        let mut rows = vec![cells(["kind", "n", "beta", "5 %", "95 %", ""])];
        let mut learned = self.summaries[self.sample.draws.n_features..].iter();
        for (betas, (kind, n)) in self.sample.draws.betas.iter().zip(self.evidence.counts()) {
            let (name, n) = (kind.name().to_owned(), n.to_string());
            rows.push(match learned_summary(betas, &mut learned) {
                Some(s) => vec![name, n, short(s.mean), short(s.q05), short(s.q95), "learned".to_owned()],
                None => vec![name, n, short(betas.mean()), String::new(), String::new(), "fixed".to_owned()],
            });
        }
        aligned(&rows)
    }

    fn weights_table(&self) -> String {
        let mut order: Vec<usize> = (0..self.sample.draws.n_features).collect();
        if order.len() > SHOWN {
            order.sort_by(|a, b| self.summaries[*b].mean.abs().total_cmp(&self.summaries[*a].mean.abs()));
            order.truncate(SHOWN);
        }
        let mut rows = vec![cells(["feature", "mean", "± error", "sd", "5 %", "95 %", "most probable"])];
        for k in order {
            let s = &self.summaries[k];
            let numbers = [s.mean, s.mcse, s.sd, s.q05, s.q95, self.sample.draws.map_weights[k]];
            rows.push(std::iter::once(k.to_string()).chain(numbers.map(short)).collect());
        }
        aligned(&rows)
    }
}

/// The summary of a learned β, which come in the order of the terms.
fn learned_summary<'a>(
    betas: &posterior::BetaDraws,
    learned: &mut impl Iterator<Item = &'a Summary>,
) -> Option<&'a Summary> {
    if betas.is_learned() { learned.next() } else { None }
}

fn prior_json(prior: Prior) -> Value {
    match prior {
        Prior::L2Sphere => json!({ "name": "l2-sphere" }),
        Prior::L1Sphere => json!({ "name": "l1-sphere" }),
        Prior::Gaussian { scale } => json!({ "name": "gaussian", "scale": scale }),
        Prior::Laplace { scale } => json!({ "name": "laplace", "scale": scale }),
    }
}

fn prior_words(prior: Prior) -> String {
    match prior {
        Prior::L2Sphere => "l2-sphere".to_owned(),
        Prior::L1Sphere => "l1-sphere".to_owned(),
        Prior::Gaussian { scale } => format!("gaussian, scale {scale}"),
        Prior::Laplace { scale } => format!("laplace, scale {scale}"),
    }
}
