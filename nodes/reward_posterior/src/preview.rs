//! A preview: the old draws re-weighted by what was said since, at hand while the full run proceeds.

use crate::inference::{model, worst_ranked};
use crate::{Evidence, Settings};
use apprentice_msgs::msg::PosteriorPreview;
use diagnostics::{Smoothed, WeightsError, khat_threshold, pareto_smooth_correlated};
use posterior::{BetaDraws, Draws, log_weights};
use std::collections::HashSet;

/// Draws, and what was in force when they were made.
pub(crate) struct Sampled {
    /// Fingerprint of the evidence.
    pub(crate) hash: String,
    /// What was in force.
    pub(crate) evidence: Evidence,
    /// The draws.
    pub(crate) draws: Draws,
}

/// The preview of the posterior of `evidence` from draws of an earlier one, whose revision is `base_revision`. A function of
/// the arguments alone.
///
/// # Errors
/// Evidence that the core cannot use, or a likelihood that is no number at some draw.
pub(crate) fn preview(
    settings: &Settings,
    evidence: &Evidence,
    hash: String,
    sampled: &Sampled,
    base_revision: u64,
) -> Result<PosteriorPreview, String> {
    let draws = thinned(&sampled.draws, settings.preview_draws());
    let mut weights = change(settings, &sampled.evidence, evidence, &draws)?;
    let known_return = |evidence| if settings.nonnegative_return { worst_ranked(evidence) } else { None };
    let (before, now) = (known_return(&sampled.evidence), known_return(evidence));
    if let Some(features) = &now {
        for (draw, weight) in weights.iter_mut().enumerate() {
            let known: f64 = draws.weights(draw).iter().zip(features).map(|(w, phi)| w * phi).sum();
            if known < 0.0 {
                *weight = f64::NEG_INFINITY;
            }
        }
    }
    // Correlated draws have a longer tail than as many independent ones.
    let efficiency = (draws.ess_bulk_min / draws.n() as f64).clamp(1e-3, 1.0);
    let smoothed = match pareto_smooth_correlated(&weights, efficiency) {
        Ok(smoothed) => smoothed,
        // Not one of the old draws is possible any more.
        Err(WeightsError::AllZero { n }) => {
            Smoothed { log_weights: vec![f64::NEG_INFINITY; n], khat: f64::INFINITY, effective_size: 0.0 }
        }
        Err(error) => return Err(error.to_string()),
    };
    let shares = smoothed.weights();
    let mut mean_weights = vec![0.0; draws.n_features];
    for (draw, share) in shares.iter().enumerate() {
        for (mean, w) in mean_weights.iter_mut().zip(draws.weights(draw)) {
            *mean += share * w;
        }
    }
    // What the new posterior gives each draw is what the old one gave it, times its weight.
    let likely = shares.iter().zip(&weights).zip(&draws.log_likelihood).filter(|((share, _), _)| **share > 0.0);
    let expected_log_likelihood = likely.map(|((share, weight), before)| share * (before + weight)).sum();
    let other_support = before.is_some() && before != now;
    let (outcome, reason) = outcome(&smoothed, other_support);
    Ok(PosteriorPreview {
        header: evidence.header(),
        revision: evidence.revision(),
        base_revision,
        evidence_hash: hash,
        outcome,
        reason,
        mean_weights,
        expected_log_likelihood,
        khat: smoothed.khat,
        effective_size: smoothed.effective_size,
        n_draws: u32::try_from(draws.n()).unwrap_or(u32::MAX),
        seed: settings.seed.unsigned_abs(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
    })
}

/// By how much the log-likelihood of every draw has changed: what was said since counts for it, what was taken back no longer
/// does. Only that is computed, since the pieces of evidence are independent given the weights.
fn change(settings: &Settings, before: &Evidence, now: &Evidence, draws: &Draws) -> Result<Vec<f64>, String> {
    let (then, today) = (before.ids_in_force(), now.ids_in_force());
    // Only what the pieces of evidence give is wanted here, not a difference to what the draws have from all others.
    let plain = Draws { log_likelihood: vec![0.0; draws.n()], ..draws.clone() };
    let log_likelihood = |evidence: &Evidence, other: &HashSet<String>| -> Result<Vec<f64>, String> {
        let evidence = evidence.with_only(|id| !other.contains(id));
        let model = model(settings, &evidence)?;
        Ok(if model.terms.is_empty() { vec![0.0; plain.n()] } else { log_weights(&model, &plain) })
    };
    let (said, taken_back) = (log_likelihood(now, &then)?, log_likelihood(before, &today)?);
    Ok(said.iter().zip(&taken_back).map(|(said, taken_back)| said - taken_back).collect())
}

fn outcome(smoothed: &Smoothed, other_support: bool) -> (u8, String) {
    let far = "the new evidence moves the posterior too far for the old draws: ";
    if smoothed.is_reliable() && other_support {
        let reason =
            format!("{far}another trajectory is the worst ranked one, whose return is known not to be negative");
        return (PosteriorPreview::UNRELIABLE, reason);
    }
    if smoothed.is_reliable() {
        return (PosteriorPreview::READY, String::new());
    }
    let most = khat_threshold(smoothed.log_weights.len());
    let reason = format!("{far}k-hat is {:.2}, at most {most:.2} is allowed", smoothed.khat);
    (PosteriorPreview::UNRELIABLE, reason)
}

/// At most `n` of the draws, evenly spread over all of them, as one chain.
fn thinned(draws: &Draws, n: usize) -> Draws {
    let kept: Vec<usize> = (0..draws.n()).step_by(draws.n().div_ceil(n.max(1))).collect();
    let betas = draws.betas.iter().map(|betas| BetaDraws {
        kind: betas.kind,
        values: if betas.is_learned() {
            kept.iter().map(|&draw| betas.at(draw)).collect()
        } else {
            betas.values.clone()
        },
    });
    Draws {
        n_chains: 1,
        per_chain: kept.len(),
        values: kept.iter().flat_map(|&draw| draws.weights(draw).iter().copied()).collect(),
        log_likelihood: kept.iter().map(|&draw| draws.log_likelihood[draw]).collect(),
        betas: betas.collect(),
        // Draws further apart are less correlated, up to none at all.
        ess_bulk_min: draws.ess_bulk_min.min(kept.len() as f64),
        ..draws.clone()
    }
}
