//! Active sampling (AS, Lopes, Melo and Montesano 2009): ask where the belief about the action is spread widest.

use crate::answers::surprise;
use crate::{Answers, Belief, InquiryError};

/// Intervals that [0, 1] is cut into, as in the author's program.
pub const BINS: usize = 10;

/// H̄(s) = (1/A) Σ_a H(μ_sa) in nats, where μ_sa is the distribution of π(a|s) over the draws, [0, 1] cut into 10 intervals.
///
/// # Errors
/// Answers of other draws than the belief's.
pub fn action_entropy(answers: &Answers, belief: &Belief) -> Result<f64, InquiryError> {
    crate::error::check_length("draws with answers", answers.n_draws(), belief.n())?;
    let (mut sum, mut n_actions) = (0.0, 0.0);
    answers.for_each(|_, p| {
        let mut mass = [0.0; BINS];
        for (p, weight) in p.iter().zip(belief.weights()) {
            // The intervals are (k/10, (k+1)/10]; 0 belongs to the first.
            let bin = (libm::ceil(p * BINS as f64) as usize).clamp(1, BINS) - 1;
            mass[bin] += weight;
        }
        sum += mass.iter().map(|p| surprise(*p)).sum::<f64>();
        n_actions += 1.0;
    });
    Ok(sum / n_actions)
}

#[cfg(test)]
mod tests {
    use super::action_entropy;
    use crate::{Answers, Belief};

    #[test]
    fn by_hand() {
        // Action 0 has .05, .05, .95, action 1 the rest: each spread over two intervals as 2 : 1.
        let answers = Answers::table(3, vec![0.05, 0.05, 0.95, 0.95, 0.95, 0.05]).expect("answers");
        let belief = Belief::equal(3).expect("draws");
        let expected = -(2.0 / 3.0_f64) * (2.0 / 3.0_f64).ln() - (1.0 / 3.0_f64) * (1.0 / 3.0_f64).ln();
        assert!((action_entropy(&answers, &belief).expect("fits") - expected).abs() < 1e-15);
        // Indecision that all draws share is no reason to ask.
        let shared = Answers::table(3, vec![0.5; 6]).expect("answers");
        assert_eq!(action_entropy(&shared, &belief).expect("fits"), 0.0);
        let edges = Answers::table(2, vec![0.0, 1.0, 1.0, 0.0]).expect("answers");
        let ln_2 = std::f64::consts::LN_2;
        assert!((action_entropy(&edges, &Belief::equal(2).expect("draws")).expect("fits") - ln_2).abs() < 1e-15);
    }
}
