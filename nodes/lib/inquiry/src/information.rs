//! How much an answer tells: of the reward (ARC, Cui and Niekum 2018), or of whether the loss is large (ours). Exact for the
//! draws: answers are enumerated and draws re-weighted, no chain is run.

use crate::answers::surprise;
use crate::{Answers, Belief, InquiryError};

/// I(answer; reward) in nats: how much the answer is expected to change the belief about the reward, E KL(after ‖ before).
/// Over all labellings of a trajectory this is what ARC seeks to make largest.
///
/// # Errors
/// Answers of other draws than the belief's.
pub fn reward_information(answers: &Answers, belief: &Belief) -> Result<f64, InquiryError> {
    check(answers, belief)?;
    let mut marginal = 0.0;
    answers.for_each(|_, p| marginal += surprise(belief.mean(p)));
    Ok((marginal - belief.mean(&answers.entropies())).max(0.0))
}

/// I(answer; class) in nats, where `classes` holds a class below `n_classes` for every draw.
///
/// # Errors
/// Answers or classes of other draws than the belief's; a class that is not below `n_classes`.
pub fn class_information(
    answers: &Answers,
    belief: &Belief,
    classes: &[usize],
    n_classes: usize,
) -> Result<f64, InquiryError> {
    check(answers, belief)?;
    crate::error::check_length("classes", classes.len(), belief.n())?;
    if let Some(index) = classes.iter().position(|&class| class >= n_classes) {
        let (what, expected) = ("class", "below the number of classes");
        return Err(InquiryError::Number { what, index, got: classes[index] as f64, expected });
    }
    let mut of_class = vec![0.0; n_classes];
    for (class, weight) in classes.iter().zip(belief.weights()) {
        of_class[*class] += weight;
    }
    let mut joint = vec![0.0; n_classes];
    let mut information: f64 = of_class.iter().map(|p| surprise(*p)).sum();
    // H(class) − H(class | answer), where H(class | answer) = Σ p(a, c) ln (p(a) / p(a, c)).
    answers.for_each(|_, p| {
        joint.fill(0.0);
        for ((class, weight), p) in classes.iter().zip(belief.weights()).zip(p) {
            joint[*class] += weight * p;
        }
        let total: f64 = joint.iter().sum();
        information -= joint.iter().map(|p| surprise(*p)).sum::<f64>() - surprise(total);
    });
    Ok(information.max(0.0))
}

/// I(answer; loss > ε) in nats: how much the answer is expected to settle whether the current policy is good enough, `losses`
/// being its loss under each draw.
///
/// # Errors
/// Answers or losses of other draws than the belief's.
pub fn risk_information(answers: &Answers, belief: &Belief, losses: &[f64], epsilon: f64) -> Result<f64, InquiryError> {
    let classes: Vec<usize> = losses.iter().map(|&loss| usize::from(loss > epsilon)).collect();
    class_information(answers, belief, &classes, 2)
}

fn check(answers: &Answers, belief: &Belief) -> Result<(), InquiryError> {
    crate::error::check_length("draws with answers", answers.n_draws(), belief.n())
}

#[cfg(test)]
mod tests {
    use super::{class_information, reward_information, risk_information};
    use crate::{Answers, Belief};
    use proptest::prelude::{prop_assert, proptest};

    #[test]
    fn an_answer_that_settles_everything_is_worth_its_entropy() {
        let belief = Belief::equal(4).expect("draws");
        let settles = Answers::table(4, vec![1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0]).expect("answers");
        let ln_2 = std::f64::consts::LN_2;
        assert!((reward_information(&settles, &belief).expect("fits") - ln_2).abs() < 1e-15);
        // The same split of the losses is settled, the other is not touched.
        assert!((risk_information(&settles, &belief, &[0.3, 0.2, 0.0, 0.1], 0.1).expect("fits") - ln_2).abs() < 1e-15);
        assert!(risk_information(&settles, &belief, &[0.3, 0.0, 0.3, 0.0], 0.1).expect("fits").abs() < 1e-15);
        let says_nothing = Answers::table(4, vec![0.3, 0.3, 0.3, 0.3, 0.7, 0.7, 0.7, 0.7]).expect("answers");
        assert!(reward_information(&says_nothing, &belief).expect("fits") < 1e-15);
    }

    #[test]
    fn a_binary_channel_by_hand() {
        // Loss large with probability .3; "bad" said with .8 when it is, .1 when not.
        let belief = Belief::weighted(&[0.3, 0.7]).expect("weights");
        let answers = Answers::table(2, vec![0.8, 0.1, 0.2, 0.9]).expect("answers");
        let h = |p: f64| -p * p.ln() - (1.0 - p) * (1.0 - p).ln();
        let expected = h(0.3 * 0.8 + 0.7 * 0.1) - 0.3 * h(0.8) - 0.7 * h(0.1);
        let got = risk_information(&answers, &belief, &[1.0, 0.0], 0.5).expect("fits");
        assert!((got - expected).abs() < 1e-15, "{got} {expected}");
        assert!((reward_information(&answers, &belief).expect("fits") - expected).abs() < 1e-15);
    }

    #[test]
    fn one_draw_or_no_loss_leaves_nothing_to_learn() {
        let answers = Answers::table(1, vec![0.5, 0.5]).expect("answers");
        let belief = Belief::equal(1).expect("a draw");
        assert_eq!(reward_information(&answers, &belief).expect("fits"), 0.0);
        let answers = Answers::table(2, vec![0.9, 0.1, 0.1, 0.9]).expect("answers");
        let belief = Belief::equal(2).expect("draws");
        assert_eq!(risk_information(&answers, &belief, &[0.0, 0.0], 0.0).expect("fits"), 0.0);
        assert!(class_information(&answers, &belief, &[0, 2], 2).is_err());
        assert!(reward_information(&answers, &Belief::equal(3).expect("draws")).is_err());
    }

    proptest! {
        /// Σ_a Σ_c p(a, c) ln p(a, c) / (p(a) p(c)), written out; and knowing a class of the reward is never more than the reward.
        #[test]
        fn critiques_against_exhaustive_computation(
            good in proptest::collection::vec(0.01..0.99_f64, 15..16), weights in proptest::collection::vec(0.1..1.0_f64, 5..6),
            classes in proptest::collection::vec(0..3_usize, 5..6),
        ) {
            let belief = Belief::weighted(&weights).expect("weights");
            let answers = Answers::segments(5, good).expect("three steps");
            let joint = |answer: usize, class: usize| -> f64 {
                let p = answers.likelihood(answer).expect("an answer");
                (0..5).filter(|&i| classes[i] == class).map(|i| belief.weights()[i] * p[i]).sum()
            };
            let of_class = |class: usize| (0..8).map(|a| joint(a, class)).sum::<f64>();
            let of_answer = |answer: usize| (0..3).map(|c| joint(answer, c)).sum::<f64>();
            let mut expected = 0.0;
            for answer in 0..8 {
                for class in (0..3).filter(|&class| of_class(class) > 0.0) {
                    expected += joint(answer, class) * (joint(answer, class) / of_class(class) / of_answer(answer)).ln();
                }
            }
            let got = class_information(&answers, &belief, &classes, 3).expect("fits");
            prop_assert!((got - expected).abs() < 1e-12, "{} {}", got, expected);
            // ARC by brute force: Σ_a p(a) KL(after ‖ before).
            let mut gain = 0.0;
            for answer in 0..8 {
                let p = answers.likelihood(answer).expect("an answer");
                let after = belief.after(&p).expect("possible");
                let kl: f64 = after.weights().iter().zip(belief.weights()).map(|(q, p)| q * (q / p).ln()).sum();
                gain += belief.mean(&p) * kl;
            }
            let information = reward_information(&answers, &belief).expect("fits");
            prop_assert!((information - gain).abs() < 1e-12);
            prop_assert!(got <= information + 1e-12);
        }
    }
}
