//! Old draws under new evidence: importance weights that are at hand at once, while a full run proceeds.

use diagnostics::normal_quantile;

use crate::{Draws, Model, Rationality};

/// ln of the importance weight of every draw for the posterior of `model`: how much more likely its evidence is than that of the
/// posterior the draws are from. Both must have the same prior and weights.
///
/// βs of kinds that the draws do not know come from their prior, one quantile per draw in an order that is even in every
/// stretch (van der Corput's), so that no random number is needed.
///
/// Smooth and judge them with `diagnostics::pareto_smooth`; above its threshold of k̂ they say nothing.
pub fn log_weights(model: &Model<'_>, draws: &Draws) -> Vec<f64> {
    let mut evaluator = model.evaluator();
    let mut betas = model.median_betas();
    (0..draws.n())
        .map(|draw| {
            for (beta, term) in betas.iter_mut().zip(&model.terms) {
                let known = draws.betas.iter().find(|known| known.kind == term.kind);
                *beta = match (known, term.rationality) {
                    (Some(known), _) => known.at(draw),
                    (None, Rationality::Fixed(beta)) => beta,
                    (None, Rationality::Learned { median, log_sd }) => {
                        median * libm::exp(log_sd * normal_quantile(van_der_corput(draw as u64 + 1)))
                    }
                };
            }
            evaluator.log_likelihood(draws.weights(draw), &betas) - draws.log_likelihood[draw]
        })
        .collect()
}

/// The bits of n mirrored at the binary point: in (0, 1) for n > 0.
fn van_der_corput(n: u64) -> f64 {
    (n.reverse_bits() >> 11) as f64 / (1_u64 << 53) as f64
}
