//! The dissertation's walk over preference weights as its author's program runs it (appendix E.1): normal noise of σ = .005 on
//! every weight, division by the norm, one likelihood per proposal.

use likelihood::preferences::PreferenceLikelihood;
use posterior::walks::{Walk, l2_proposal, metropolis};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use crate::preference_data::on_sphere;

/// σ of the proposals.
pub const SIGMA: f64 = 0.005;
/// Every so manyth place is kept.
pub const KEPT_EVERY: usize = 20;

/// One chain from a random start: the kept places of `n_steps` steps.
pub fn walk(likelihood: &PreferenceLikelihood, n_steps: usize, seed: u64) -> Walk {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut evaluator = likelihood.evaluator();
    let n = likelihood.n_features();
    let mut start = on_sphere(n, &mut rng);
    let mut kept = Walk { values: Vec::new(), log_likelihood: Vec::new(), acceptance: 0.0 };
    let rounds = n_steps / KEPT_EVERY;
    for _ in 0..rounds {
        let part = metropolis(|w| evaluator.value(w), start, KEPT_EVERY, |w, rng| l2_proposal(w, SIGMA, rng), &mut rng);
        start = part.values[part.values.len() - n..].to_vec();
        kept.values.extend_from_slice(&start);
        kept.log_likelihood.push(part.log_likelihood[KEPT_EVERY - 1]);
        kept.acceptance += part.acceptance / rounds as f64;
    }
    kept
}
