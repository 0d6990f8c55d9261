//! Would these rewards have given such answers? A posterior-predictive check (Gelman, Meng and Stern 1996): the sign of a
//! feature that is missing, or of a person who answers by something else.

use mdp::random::{categorical, uniform};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use crate::{Answers, Belief, InquiryError};

/// Draws of whole lessons from the belief.
const REPLICATES: usize = 2000;

/// A question that was answered, its answers judged by the draws at hand now.
#[derive(Debug, Clone, Copy)]
pub struct Answered<'a> {
    /// What could be answered.
    pub answers: &'a Answers,
    /// What was.
    pub given: usize,
}

/// What the check found.
#[derive(Debug, Clone, PartialEq)]
pub struct PredictiveCheck {
    /// Probability with which answers drawn from the belief are as improbable as those given, or more. Near 0: the features cannot
    /// explain the answers. Conservative, since the belief was learned from the same answers.
    pub p_value: f64,
    /// The answers that fit worst, by place in the list, at most three; worst first.
    pub worst: Vec<usize>,
}

impl PredictiveCheck {
    /// Whether the answers do not fit, at the given level.
    pub fn warns(&self, level: f64) -> bool {
        self.p_value < level
    }
}

/// Compares how improbable the given answers are, −Σ ln P(answer | draw), with the same of answers drawn under the same
/// draws, which `seed` decides. Without answers all is well: p = 1.
///
/// # Errors
/// Answers about other draws than the belief's; answers that do not exist.
pub fn predictive_check(
    answered: &[Answered<'_>],
    belief: &Belief,
    seed: u64,
) -> Result<PredictiveCheck, InquiryError> {
    if answered.is_empty() {
        return Ok(PredictiveCheck { p_value: 1.0, worst: Vec::new() });
    }
    let mut given = Vec::with_capacity(answered.len());
    for question in answered {
        crate::error::check_length("draws with answers", question.answers.n_draws(), belief.n())?;
        given.push(question.answers.likelihood(question.given)?);
    }
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let chosen: Vec<usize> =
        (0..REPLICATES).map(|_| categorical(belief.weights().iter().copied(), 1.0, &mut rng)).collect();
    let mut excess = vec![0.0; REPLICATES];
    for (question, given) in answered.iter().zip(&given) {
        let lots: Vec<f64> = chosen.iter().map(|_| uniform(&mut rng)).collect();
        let mut drawn = vec![f64::NAN; REPLICATES];
        let mut passed = vec![0.0; REPLICATES];
        // The answer at which the cumulated probability passes the lot; the last possible one where rounding leaves a rest.
        question.answers.for_each(|_, p| {
            for (replicate, &draw) in chosen.iter().enumerate() {
                if p[draw] > 0.0 && passed[replicate] <= lots[replicate] {
                    drawn[replicate] = p[draw];
                    passed[replicate] += p[draw];
                }
            }
        });
        for ((excess, &draw), p) in excess.iter_mut().zip(&chosen).zip(drawn) {
            *excess += libm::log(given[draw]) - libm::log(p);
        }
    }
    // Excess ≥ 0: drawn answers as improbable as the given ones. −∞ where a given answer is impossible.
    let as_improbable = excess.iter().filter(|excess| **excess >= -1e-9).count();
    let mut by_fit: Vec<(f64, usize)> =
        given.iter().enumerate().map(|(index, given)| (belief.mean(given), index)).collect();
    by_fit.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let worst = by_fit.iter().take(3).map(|(_, index)| *index).collect();
    Ok(PredictiveCheck { p_value: as_improbable as f64 / REPLICATES as f64, worst })
}

#[cfg(test)]
mod tests {
    use super::{Answered, predictive_check};
    use crate::{Answers, Belief};

    #[test]
    fn answers_that_no_reward_explains_are_told() {
        // Both rewards say "first" with .95, a person keeps saying "second".
        let answers = Answers::table(2, vec![0.95, 0.9, 0.05, 0.1]).expect("answers");
        let belief = Belief::equal(2).expect("draws");
        let odd = [Answered { answers: &answers, given: 1 }; 5];
        let check = predictive_check(&odd, &belief, 1).expect("fits");
        assert!(check.p_value < 0.001 && check.warns(0.01), "{check:?}");
        assert_eq!(check.worst, [0, 1, 2]);
        let even = [Answered { answers: &answers, given: 0 }; 5];
        assert_eq!(predictive_check(&even, &belief, 1).expect("fits").p_value, 1.0);
    }

    /// One reward, one question: p is the probability of the answers that are as improbable as the given one.
    #[test]
    fn the_p_value_is_exact_but_for_the_drawing() {
        let answers = Answers::table(1, vec![0.6, 0.3, 0.1]).expect("answers");
        let belief = Belief::equal(1).expect("a draw");
        for (given, expected) in [(0, 1.0), (1, 0.4), (2, 0.1)] {
            let check = predictive_check(&[Answered { answers: &answers, given }], &belief, 7).expect("fits");
            // Standard error .011 at .4.
            assert!((check.p_value - expected).abs() < 0.04, "{given}: {check:?}");
        }
        assert_eq!(predictive_check(&[], &belief, 7).expect("fits").p_value, 1.0);
        let impossible = Answers::table(1, vec![1.0, 0.0]).expect("answers");
        let check = predictive_check(&[Answered { answers: &impossible, given: 1 }], &belief, 7).expect("fits");
        assert_eq!(check.p_value, 0.0);
        assert!(predictive_check(&[Answered { answers: &answers, given: 3 }], &belief, 7).is_err());
    }
}
