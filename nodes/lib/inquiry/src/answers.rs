//! How probable each answer to a question is under each draw.

use crate::error::{check_length, check_numbers};
use crate::{Belief, InquiryError};

/// Steps of a critique, at most: it has 2^steps answers.
pub const MAX_STEPS: usize = 12;
/// By how much probabilities may miss 1 in sum.
const ROUNDING: f64 = 1e-6;

/// P(answer | draw) for every answer that a question can have.
#[derive(Debug, Clone, PartialEq)]
pub struct Answers {
    n_draws: usize,
    kind: Kind,
}

#[derive(Debug, Clone, PartialEq)]
enum Kind {
    /// One row of n probabilities an answer.
    Table(Vec<f64>),
    /// One row of n probabilities of "good" a step; an answer labels every step, bit t of its number set where step t is
    /// good. Labels are independent given the reward.
    Steps(Vec<f64>),
}

impl Answers {
    /// Any answers: `probabilities` has one row of n draws per answer.
    ///
    /// # Errors
    /// No draws or answers, probabilities outside [0, 1], or that do not sum to 1 over the answers.
    pub fn table(n_draws: usize, probabilities: Vec<f64>) -> Result<Self, InquiryError> {
        check_rows(n_draws, &probabilities, "answers")?;
        for draw in 0..n_draws {
            let got: f64 = probabilities[draw..].iter().step_by(n_draws).sum();
            if (got - 1.0).abs() > ROUNDING {
                return Err(InquiryError::NotADistribution { draw, got });
            }
        }
        Ok(Self { n_draws, kind: Kind::Table(probabilities) })
    }

    /// A critique: `good` has one row of n draws per step, the probability that the step is called good and not bad. A
    /// person may also leave steps unjudged; that says nothing of the reward, so it is no answer of its own.
    ///
    /// # Errors
    /// No draws, no step or more than [`MAX_STEPS`], probabilities outside [0, 1].
    pub fn segments(n_draws: usize, good: Vec<f64>) -> Result<Self, InquiryError> {
        check_rows(n_draws, &good, "steps")?;
        let got = good.len() / n_draws;
        if got > MAX_STEPS {
            return Err(InquiryError::Steps { got, most: MAX_STEPS });
        }
        Ok(Self { n_draws, kind: Kind::Steps(good) })
    }

    /// Some answers out of very many, such as places: `densities` has one row of n per answer that was drawn from what the belief
    /// expects, the probability density of that answer under each draw. Each then stands for an equal share of all answers
    /// (importance sampling): expectations over answers are right but for the drawing, whatever the unit of the densities. For scores
    /// alone: which answers are a surprise, and whether answers fit, takes all of them.
    ///
    /// # Errors
    /// No answers, rows of another length, densities that are negative, not finite, or zero under every draw.
    pub fn sampled(belief: &Belief, mut densities: Vec<f64>) -> Result<Self, InquiryError> {
        let n_draws = belief.n();
        if densities.is_empty() {
            return Err(InquiryError::Empty { what: "answers" });
        }
        check_length("densities", densities.len(), densities.len() / n_draws * n_draws)?;
        check_numbers("density", &densities, "finite and at least 0", |p| p.is_finite() && p >= 0.0)?;
        let share = n_draws as f64 / densities.len() as f64;
        for row in densities.chunks_exact_mut(n_draws) {
            let mean = belief.mean(row);
            if mean <= 0.0 {
                return Err(InquiryError::Empty { what: "draws that allow a drawn answer" });
            }
            row.iter_mut().for_each(|p| *p *= share / mean);
        }
        Ok(Self { n_draws, kind: Kind::Table(densities) })
    }

    /// Draws.
    pub fn n_draws(&self) -> usize {
        self.n_draws
    }

    /// Answers that are possible.
    pub fn n(&self) -> usize {
        match &self.kind {
            Kind::Table(rows) => rows.len() / self.n_draws,
            Kind::Steps(good) => 1 << (good.len() / self.n_draws),
        }
    }

    /// Calls `f` with every answer in order and its probability under each draw.
    pub fn for_each(&self, mut f: impl FnMut(usize, &[f64])) {
        match &self.kind {
            Kind::Table(rows) => rows.chunks_exact(self.n_draws).enumerate().for_each(|(answer, row)| f(answer, row)),
            Kind::Steps(good) => {
                // From the last step to the first, so that answers come in the order of their numbers.
                let n_steps = good.len() / self.n_draws;
                let mut products = vec![1.0; (n_steps + 1) * self.n_draws];
                self.label(good, n_steps, 0, &mut products, &mut f);
            }
        }
    }

    /// Labels the steps below `left`; `answer` holds the labels of those from `left` on, and row `left` of `products` their
    /// probability.
    fn label(&self, good: &[f64], left: usize, answer: usize, products: &mut [f64], f: &mut impl FnMut(usize, &[f64])) {
        let n = self.n_draws;
        if left == 0 {
            return f(answer, &products[..n]);
        }
        let step = left - 1;
        for bit in [0, 1] {
            let (below, above) = products.split_at_mut(left * n);
            let row = &mut below[step * n..];
            for ((to, from), p) in row.iter_mut().zip(&above[..n]).zip(&good[step * n..][..n]) {
                *to = from * if bit == 1 { *p } else { 1.0 - p };
            }
            self.label(good, step, answer | (bit << step), products, f);
        }
    }

    /// Probability of one answer under each draw.
    ///
    /// # Errors
    /// No such answer.
    pub fn likelihood(&self, answer: usize) -> Result<Vec<f64>, InquiryError> {
        if answer >= self.n() {
            return Err(InquiryError::Length { what: "answers", got: self.n(), expected: answer + 1 });
        }
        let n = self.n_draws;
        Ok(match &self.kind {
            Kind::Table(rows) => rows[answer * n..][..n].to_vec(),
            Kind::Steps(good) => {
                let mut row = vec![1.0; n];
                // In the order of `for_each`, for the same bits.
                for (step, good) in good.chunks_exact(n).enumerate().rev() {
                    let is_good = (answer >> step) & 1 == 1;
                    row.iter_mut().zip(good).for_each(|(row, p)| *row *= if is_good { *p } else { 1.0 - p });
                }
                row
            }
        })
    }

    /// Σ_a −p log p under each draw, nats: how undecided the person would be.
    pub fn entropies(&self) -> Vec<f64> {
        let mut entropies = vec![0.0; self.n_draws];
        match &self.kind {
            Kind::Table(rows) => {
                for row in rows.chunks_exact(self.n_draws) {
                    entropies.iter_mut().zip(row).for_each(|(sum, p)| *sum += surprise(*p));
                }
            }
            Kind::Steps(good) => {
                for row in good.chunks_exact(self.n_draws) {
                    entropies.iter_mut().zip(row).for_each(|(sum, p)| *sum += surprise(*p) + surprise(1.0 - p));
                }
            }
        }
        entropies
    }
}

/// −p ln p, 0 at 0.
pub(crate) fn surprise(p: f64) -> f64 {
    if p > 0.0 { -p * libm::log(p) } else { 0.0 }
}

fn check_rows(n_draws: usize, rows: &[f64], what: &'static str) -> Result<(), InquiryError> {
    if n_draws == 0 {
        return Err(InquiryError::Empty { what: "draws" });
    }
    if rows.is_empty() {
        return Err(InquiryError::Empty { what });
    }
    check_length("probabilities", rows.len(), rows.len() / n_draws * n_draws)?;
    check_numbers("probability", rows, "between 0 and 1", |p| (0.0..=1.0 + ROUNDING).contains(&p))
}

#[cfg(test)]
mod tests {
    use super::Answers;
    use crate::{Belief, InquiryError, reward_information};

    #[test]
    fn a_critique_labels_every_step_in_every_way() {
        // Two draws, three steps.
        let good = vec![0.9, 0.5, 0.2, 0.5, 0.7, 1.0];
        let answers = Answers::segments(2, good).expect("a critique");
        assert_eq!(answers.n(), 8);
        let mut seen = Vec::new();
        let mut sum = [0.0, 0.0];
        answers.for_each(|answer, p| {
            assert_eq!(p, answers.likelihood(answer).expect("an answer"));
            seen.push(answer);
            sum.iter_mut().zip(p).for_each(|(sum, p)| *sum += p);
        });
        assert_eq!(seen, (0..8).collect::<Vec<_>>());
        assert!(sum.iter().all(|sum| (sum - 1.0).abs() < 1e-15));
        // Good, bad, good: .9 · .8 · .7 and .5 · .5 · 1.
        let p = answers.likelihood(0b101).expect("an answer");
        assert!((p[0] - 0.504).abs() < 1e-15 && (p[1] - 0.25).abs() < 1e-15);
        let mut direct = [0.0, 0.0];
        answers.for_each(|_, p| direct.iter_mut().zip(p).for_each(|(sum, p)| *sum += super::surprise(*p)));
        assert!(direct.iter().zip(answers.entropies()).all(|(a, b)| (a - b).abs() < 1e-14));
    }

    /// Two normal answers of spread 1 whose means lie 2 apart, equally probable: the information of the answer is that of a
    /// binary-input Gaussian channel at 0 dB, .4859 bit. Drawn evenly by quantile, so that hardly any error of drawing is left.
    #[test]
    fn drawn_answers_stand_for_all() {
        let belief = Belief::equal(2).expect("draws");
        let n = 2000;
        let mut densities = Vec::new();
        for i in 0..n {
            // Half of the answers under either draw; the quantiles of a normal by bisection.
            let mean = if i % 2 == 0 { -1.0 } else { 1.0 };
            let share = (f64::from(i / 2) + 0.5) / (0.5 * f64::from(n));
            let (mut low, mut high) = (-9.0, 9.0);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if 0.5 * libm::erfc(-middle * std::f64::consts::FRAC_1_SQRT_2) < share {
                    low = middle
                } else {
                    high = middle
                }
            }
            let x = mean + low;
            densities.extend([-1.0, 1.0].map(|m| 7.0 * (-0.5 * (x - m) * (x - m)).exp()));
        }
        let answers = Answers::sampled(&belief, densities).expect("densities");
        let bits = reward_information(&answers, &belief).expect("fits") / std::f64::consts::LN_2;
        assert!((bits - 0.4859).abs() < 5e-4, "{bits}");
        let mut total = 0.0;
        answers.for_each(|_, p| total += belief.mean(p));
        assert!((total - 1.0).abs() < 1e-12);
        assert!(Answers::sampled(&belief, vec![0.0, 0.0]).is_err() && Answers::sampled(&belief, vec![1.0]).is_err());
        assert!(Answers::sampled(&belief, vec![]).is_err() && Answers::sampled(&belief, vec![-1.0, 1.0]).is_err());
    }

    #[test]
    fn what_is_no_distribution_is_refused() {
        assert!(Answers::table(2, vec![0.5, 1.0, 0.5, 0.0]).is_ok());
        assert!(matches!(
            Answers::table(2, vec![0.5, 1.0, 0.4, 0.0]),
            Err(InquiryError::NotADistribution { draw: 0, .. })
        ));
        assert!(Answers::table(2, vec![1.0, 1.0, 1.0]).is_err());
        assert!(Answers::table(1, vec![1.5, -0.5]).is_err());
        assert!(Answers::table(0, vec![]).is_err() && Answers::table(1, vec![]).is_err());
        assert!(Answers::segments(1, vec![0.5; 13]).is_err());
        assert!(Answers::segments(1, vec![0.5]).expect("one step").likelihood(2).is_err());
    }
}
