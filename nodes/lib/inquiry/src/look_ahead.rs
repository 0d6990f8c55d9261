//! One step ahead: what the bound is expected to be once an answer is in and the robot has taken up the policy that is then
//! best. The policies it may take up are few: the current one and those that are optimal under some of the draws.

use crate::error::{check_length, check_numbers};
use crate::value_at_risk::{check_alpha, descending_quantile};
use crate::{Answers, Belief, InquiryError};

/// Answers less probable than this are taken to change nothing.
const RARE: f64 = 1e-4;

/// Losses of m policies under n draws.
#[derive(Debug, Clone, PartialEq)]
pub struct Alternatives {
    n_draws: usize,
    /// One row of n a policy.
    losses: Vec<f64>,
    /// Draws by descending loss, one row of n a policy.
    order: Vec<u32>,
}

/// What the robot wants to be small.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Objective {
    /// The expected loss.
    Mean,
    /// The α-VaR of the loss: what is bounded.
    ValueAtRisk {
        /// α in (0, 1).
        alpha: f64,
    },
}

impl Alternatives {
    /// `losses` holds one row of n draws per policy, the current policy first.
    ///
    /// # Errors
    /// No draws or policies, rows of another length, losses that are not finite.
    pub fn new(n_draws: usize, losses: Vec<f64>) -> Result<Self, InquiryError> {
        if n_draws == 0 {
            return Err(InquiryError::Empty { what: "draws" });
        }
        if losses.is_empty() {
            return Err(InquiryError::Empty { what: "policies" });
        }
        check_length("losses", losses.len(), losses.len() / n_draws * n_draws)?;
        check_numbers("loss", &losses, "finite", f64::is_finite)?;
        let mut order: Vec<u32> = (0..losses.len()).map(|i| (i % n_draws) as u32).collect();
        for (order, losses) in order.chunks_exact_mut(n_draws).zip(losses.chunks_exact(n_draws)) {
            order.sort_unstable_by(|&a, &b| losses[b as usize].total_cmp(&losses[a as usize]).then(a.cmp(&b)));
        }
        Ok(Self { n_draws, losses, order })
    }

    /// Draws.
    pub fn n_draws(&self) -> usize {
        self.n_draws
    }

    /// Policies.
    pub fn n(&self) -> usize {
        self.losses.len() / self.n_draws
    }

    /// Loss of one policy under each draw.
    ///
    /// # Panics
    /// When there is no such policy.
    pub fn of(&self, policy: usize) -> &[f64] {
        &self.losses[policy * self.n_draws..][..self.n_draws]
    }

    /// The policy that is best under the belief, the first of equals, and its objective.
    ///
    /// # Errors
    /// A belief about other draws; α outside (0, 1).
    pub fn best(&self, belief: &Belief, objective: Objective) -> Result<(usize, f64), InquiryError> {
        check_length("draws with alternatives", self.n_draws, belief.n())?;
        objective.check()?;
        Ok(self.least(belief.weights(), 1.0, objective))
    }

    /// The same for weights of any sum `total`; the objective is multiplied by it only for [`Objective::Mean`].
    fn least(&self, weights: &[f64], total: f64, objective: Objective) -> (usize, f64) {
        let mut best = (0, f64::INFINITY);
        for (policy, losses) in self.losses.chunks_exact(self.n_draws).enumerate() {
            let value = match objective {
                Objective::Mean => dot(losses, weights),
                Objective::ValueAtRisk { alpha } => {
                    let order = &self.order[policy * self.n_draws..][..self.n_draws];
                    descending_quantile(losses, order, weights, (1.0 - alpha) * total)
                }
            };
            if value < best.1 {
                best = (policy, value);
            }
        }
        best
    }
}

impl Objective {
    fn check(self) -> Result<(), InquiryError> {
        match self {
            Self::Mean => Ok(()),
            Self::ValueAtRisk { alpha } => check_alpha(alpha),
        }
    }
}

/// By how much the objective of the best policy is expected to fall: min_π J(π) − E_answer min_π J(π | answer), in the unit of the
/// losses. Never negative for [`Objective::Mean`]; an expected value at risk may also rise.
///
/// # Errors
/// Parts about other draws; α outside (0, 1).
pub fn expected_drop(
    answers: &Answers,
    belief: &Belief,
    alternatives: &Alternatives,
    objective: Objective,
) -> Result<f64, InquiryError> {
    check_length("draws with answers", answers.n_draws(), belief.n())?;
    let (_, now) = alternatives.best(belief, objective)?;
    let mut weights = vec![0.0; belief.n()];
    let mut drop = 0.0;
    answers.for_each(|_, p| {
        let mut total = 0.0;
        for ((to, weight), p) in weights.iter_mut().zip(belief.weights()).zip(p) {
            *to = weight * p;
            total += *to;
        }
        if total >= RARE {
            let (_, then) = alternatives.least(&weights, total, objective);
            drop += match objective {
                Objective::Mean => total * now - then,
                Objective::ValueAtRisk { .. } => total * (now - then),
            };
        }
    });
    Ok(drop)
}

/// xᵀy, summed in four lanes.
fn dot(x: &[f64], y: &[f64]) -> f64 {
    let (x_blocks, x_rest) = x.as_chunks::<4>();
    let (y_blocks, y_rest) = y.as_chunks::<4>();
    let mut lanes = [0.0; 4];
    for (x, y) in x_blocks.iter().zip(y_blocks) {
        for i in 0..4 {
            lanes[i] += x[i] * y[i];
        }
    }
    let rest: f64 = x_rest.iter().zip(y_rest).map(|(x, y)| x * y).sum();
    (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]) + rest
}

#[cfg(test)]
mod tests {
    use super::{Alternatives, Objective, expected_drop};
    use crate::{Answers, Belief};
    use proptest::prelude::{prop_assert, proptest};
    use risk::Distribution;

    #[test]
    fn by_hand() {
        // Two rewards, two policies, each right under one of them; policy 0 costs 1 when wrong, policy 1 costs 3.
        let alternatives = Alternatives::new(2, vec![0.0, 1.0, 3.0, 0.0]).expect("losses");
        let belief = Belief::equal(2).expect("draws");
        assert_eq!(alternatives.best(&belief, Objective::Mean).expect("fits"), (0, 0.5));
        let settles = Answers::table(2, vec![1.0, 0.0, 0.0, 1.0]).expect("answers");
        let var = Objective::ValueAtRisk { alpha: 0.9 };
        // Whatever the answer, the loss is then 0: the mean falls by ½, the VaR by 1.
        assert_eq!(expected_drop(&settles, &belief, &alternatives, Objective::Mean).expect("fits"), 0.5);
        assert_eq!(expected_drop(&settles, &belief, &alternatives, var).expect("fits"), 1.0);
        // An answer that is right in 9 of 10: policy 0 after "first" (.9 · 0 + .1 · 1), 1 after "second" (.1 · 3 = .3).
        let hints = Answers::table(2, vec![0.9, 0.1, 0.1, 0.9]).expect("answers");
        let drop = expected_drop(&hints, &belief, &alternatives, Objective::Mean).expect("fits");
        assert!((drop - (0.5 - 0.5 * 0.1 - 0.5 * 0.3)).abs() < 1e-15, "{drop}");
    }

    #[test]
    fn degenerate_beliefs_leave_nothing_to_gain() {
        let one = Alternatives::new(1, vec![0.0, 2.0]).expect("losses");
        let answers = Answers::table(1, vec![0.5, 0.5]).expect("answers");
        let belief = Belief::equal(1).expect("a draw");
        for objective in [Objective::Mean, Objective::ValueAtRisk { alpha: 0.95 }] {
            assert_eq!(expected_drop(&answers, &belief, &one, objective).expect("fits"), 0.0);
        }
        assert!(Alternatives::new(2, vec![]).is_err() && Alternatives::new(2, vec![1.0]).is_err());
        assert!(one.best(&belief, Objective::ValueAtRisk { alpha: 1.0 }).is_err());
    }

    proptest! {
        #[test]
        fn against_exhaustive_computation(
            losses in proptest::collection::vec(0.0..2.0_f64, 24..25), weights in proptest::collection::vec(0.1..1.0_f64, 6..7),
            good in proptest::collection::vec(0.05..0.95_f64, 12..13), alpha in 0.5..0.95_f64,
        ) {
            let belief = Belief::weighted(&weights).expect("weights");
            let alternatives = Alternatives::new(6, losses).expect("losses");
            let answers = Answers::segments(6, good).expect("two steps");
            for objective in [Objective::Mean, Objective::ValueAtRisk { alpha }] {
                let least = |belief: &Belief| {
                    (0..4).map(|policy| {
                        let distribution =
                            Distribution::weighted(alternatives.of(policy), belief.weights()).expect("a distribution");
                        match objective {
                            Objective::Mean => distribution.mean(),
                            Objective::ValueAtRisk { alpha } => distribution.quantile(alpha),
                        }
                    }).fold(f64::INFINITY, f64::min)
                };
                let mut expected = least(&belief);
                for answer in 0..4 {
                    let p = answers.likelihood(answer).expect("an answer");
                    expected -= belief.mean(&p) * least(&belief.after(&p).expect("possible"));
                }
                let got = expected_drop(&answers, &belief, &alternatives, objective).expect("fits");
                prop_assert!((got - expected).abs() < 1e-12, "{} {}", got, expected);
                if objective == Objective::Mean {
                    prop_assert!(got > -1e-12);
                }
            }
        }
    }
}
