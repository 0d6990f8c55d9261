//! Which of the imagined tables to ask about, when it is not simply the one with the largest bound.

use crate::settings::{Settings, Strategy};
use apprentice_msgs::msg::Posterior;
use inquiry::table::{TableDraws, sampled_placement_answers};
use inquiry::{Belief, InquiryError, Judged, reward_information};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use scene::Scene;

/// Draws that answers are judged by: evenly spaced ones.
const SCORED: usize = 200;
/// Answers drawn for each table.
const ANSWERS: usize = 24;
/// Points a side of the grid on which densities are normalised.
const GRID_SIDE: usize = 24;
/// Keeps these random numbers apart from those of the imagined tables.
const OWN_STREAM: u64 = 1 << 63;

/// The table to ask about among those on which the target has a place; `largest` is the one with the largest bound, which it is
/// for [`Strategy::Var`]. A function of settings, posterior and tables alone.
///
/// # Errors
/// A posterior whose numbers do not fit together.
pub(crate) fn table_to_ask(
    settings: &Settings,
    posterior: &Posterior,
    tables: &[Scene],
    judged: &[Judged],
    largest: usize,
) -> Result<usize, InquiryError> {
    let possible: Vec<usize> = (0..tables.len()).filter(|&i| !judged[i].point_estimate_m.is_nan()).collect();
    let mut rng = ChaCha8Rng::seed_from_u64(settings.seed.unsigned_abs());
    rng.set_stream(OWN_STREAM | posterior.revision);
    match settings.strategy {
        _ if possible.len() < 2 => Ok(largest),
        Strategy::Var => Ok(largest),
        Strategy::Random => Ok(possible[mdp::random::index(possible.len(), &mut rng)]),
        Strategy::Information | Strategy::Entropy | Strategy::RewardInformation | Strategy::LookAhead => {
            most_informative(posterior, tables, &possible, &mut rng)
        }
    }
}

/// The table on which the answer is expected to tell most about the reward, the first of equals.
fn most_informative(
    posterior: &Posterior,
    tables: &[Scene],
    possible: &[usize],
    rng: &mut ChaCha8Rng,
) -> Result<usize, InquiryError> {
    let k = posterior.feature_names.len();
    let n_draws = posterior.draws.len() / k.max(1);
    let n = SCORED.min(n_draws);
    let chosen = || (0..n).map(|i| i * n_draws / n);
    let weights: Vec<f64> =
        chosen().flat_map(|draw| &posterior.draws[draw * k..][..k]).map(|w| f64::from(*w)).collect();
    let kinds = &posterior.learned_kinds;
    let betas: Vec<f64> = match kinds.iter().position(|kind| kind == PLACEMENTS) {
        Some(kind) => {
            let beta = |draw| posterior.learned_betas.get(draw * kinds.len() + kind).copied().unwrap_or(f32::NAN);
            chosen().map(|draw| f64::from(beta(draw))).collect()
        }
        None => vec![posterior.beta],
    };
    let draws = TableDraws { weights: &weights, n_features: k, betas: &betas };
    let belief = Belief::equal(n)?;
    let mut best = (possible[0], f64::NEG_INFINITY);
    for &index in possible {
        let answers = sampled_placement_answers(&tables[index], &draws, &belief, ANSWERS, GRID_SIDE, rng)?;
        if let Some(answers) = answers {
            let information = reward_information(&answers, &belief)?;
            if information > best.1 {
                best = (index, information);
            }
        }
    }
    Ok(best.0)
}

/// The kind of evidence whose rationality counts.
const PLACEMENTS: &str = "placements";
