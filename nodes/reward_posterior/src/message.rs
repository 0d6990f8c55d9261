//! Draws as the message that everybody computes with.

use crate::inference::preference_cycles;
use crate::{Evidence, Settings};
use apprentice_msgs::msg::{Posterior, PreferenceCycle, Rationality};
use diagnostics::normal_quantile;
use posterior::{Draws, EvidenceKind};

/// More cycles are not told.
const MAX_CYCLES: usize = 100;

/// The posterior of the evidence in force.
pub(crate) fn posterior_message(settings: &Settings, evidence: &Evidence, hash: String, draws: &Draws) -> Posterior {
    let (outcome, reason) = outcome(draws);
    let (learned_kinds, learned_betas) = learned(draws);
    let cycles = preference_cycles(settings, evidence).into_iter().take(MAX_CYCLES);
    Posterior {
        header: evidence.header(),
        revision: evidence.revision(),
        evidence_hash: hash,
        n_demonstrations: evidence.placements().count() as u64,
        n_answers: evidence.n_answers(),
        wish: evidence.wish(),
        task: evidence.task().map(|(message, _)| message.clone()).unwrap_or_default(),
        scene: evidence.newest_scene().cloned().unwrap_or_default(),
        world: evidence.world_reference(),
        outcome,
        reason,
        feature_names: evidence.feature_names().to_vec(),
        n_chains: u32::try_from(draws.n_chains).unwrap_or(u32::MAX),
        n_draws: u32::try_from(draws.n()).unwrap_or(u32::MAX),
        draws: draws.values.iter().map(|&w| w as f32).collect(),
        map_weights: draws.map_weights.clone(),
        map_log_likelihood: draws.map_log_likelihood,
        log_likelihood_mean: draws.log_likelihood_mean(),
        rhat_max: draws.rhat_max,
        ess_bulk_min: draws.ess_bulk_min,
        ess_tail_min: draws.ess_tail_min,
        acceptance: draws.acceptance,
        beta: rationality(settings, evidence, draws, EvidenceKind::Placements).mean,
        rationalities: EvidenceKind::ALL.map(|kind| rationality(settings, evidence, draws, kind)).to_vec(),
        learned_kinds,
        learned_betas,
        cycles: cycles.map(|trajectories| PreferenceCycle { trajectories }).collect(),
        prior: settings.prior.name().to_owned(),
        prior_scale: if settings.prior.has_scale() { settings.prior_scale } else { 0.0 },
        seed: settings.seed.unsigned_abs(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
    }
}

fn outcome(draws: &Draws) -> (u8, String) {
    if draws.rhat_max <= risk::MAX_RHAT {
        return (Posterior::READY, String::new());
    }
    let reason =
        format!("R-hat of the weights is {:.3}, at most {} is allowed; raise n_draws", draws.rhat_max, risk::MAX_RHAT);
    (Posterior::NOT_MIXED, reason)
}

/// Kinds with a learned β that have evidence in force, and its draws, row by row.
fn learned(draws: &Draws) -> (Vec<String>, Vec<f32>) {
    let learned: Vec<_> = draws.betas.iter().filter(|betas| betas.is_learned()).collect();
    let rows = (0..draws.n()).flat_map(|draw| learned.iter().map(move |betas| betas.at(draw) as f32));
    (learned.iter().map(|betas| betas.kind.name().to_owned()).collect(), rows.collect())
}

fn rationality(settings: &Settings, evidence: &Evidence, draws: &Draws, kind: EvidenceKind) -> Rationality {
    let (median, log_sd) = match settings.rationality(kind) {
        posterior::Rationality::Fixed(beta) => (beta, 0.0),
        posterior::Rationality::Learned { median, log_sd } => (median, log_sd),
    };
    let n = match kind {
        EvidenceKind::Placements => evidence.placements().count(),
        EvidenceKind::Actions => evidence.actions().count(),
        EvidenceKind::Preferences => evidence.preferences().count(),
        EvidenceKind::Critiques => evidence.critiques().count(),
        EvidenceKind::Progress => evidence.histories().count(),
    };
    let drawn = draws.betas.iter().find(|betas| betas.kind == kind && betas.is_learned());
    let (mean, [quantile_05, quantile_95]) = match drawn {
        Some(betas) => (betas.mean(), quantiles(&betas.values)),
        // Without evidence what is known is the prior: ln beta is normal, or fixed.
        None => {
            let at = |p| median * libm::exp(log_sd * normal_quantile(p));
            (median * libm::exp(0.5 * log_sd * log_sd), [at(0.05), at(0.95)])
        }
    };
    let (prior_median, prior_log_sd, wrong_rate) = (median, log_sd, settings.wrong_rate(kind));
    Rationality {
        kind: kind.name().to_owned(),
        n: n as u64,
        prior_median,
        prior_log_sd,
        mean,
        quantile_05,
        quantile_95,
        wrong_rate,
    }
}

/// Empirical 5 % and 95 % quantiles.
fn quantiles(values: &[f64]) -> [f64; 2] {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let at = |p: f64| sorted[((p * sorted.len() as f64) as usize).min(sorted.len() - 1)];
    [at(0.05), at(0.95)]
}
