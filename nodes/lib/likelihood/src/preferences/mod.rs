//! The likelihood of comparisons of trajectories: Bradley–Terry over linear returns (eq. 6.4), with "about equal",
//! "can't tell", confidence and wrong clicks.

mod cycles;
mod error;
mod evaluator;
mod kernel;
mod layout;
mod logarithm;
mod model;
mod orders;
mod span;

pub use cycles::cycles;
pub use error::PreferenceError;
pub use evaluator::PreferenceEvaluator;
pub use model::{AnswerModel, AnswerProbabilities};
pub use orders::{ranking, time_ordered};
pub use span::Basis;

use layout::Layout;
use pulp::Arch;

/// More features than this are refused.
pub const MAX_FEATURES: usize = 4096;
/// More items than this are refused.
pub const MAX_ITEMS: usize = 100_000;
/// More feature values in all than this are refused.
pub const MAX_NUMBERS: usize = 1 << 24;
/// Largest magnitude of a feature value.
pub const MAX_VALUE: f64 = 1e100;
/// More answers than this are refused.
pub const MAX_ANSWERS: usize = 1_000_000;
/// Largest confidence factor.
pub const MAX_FACTOR: f64 = 1e6;

/// What a person said about a pair of items.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// `more` is better than `less`.
    Strict,
    /// They are about equal.
    Equal,
    /// The person cannot tell.
    CantTell,
}

/// One answer about a pair of items.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Answer {
    /// Row of the item that is worse, or just the one of the pair.
    pub less: usize,
    /// Row of the item that is better, or just the other of the pair.
    pub more: usize,
    /// Confidence: multiplies the rationality β of this answer; in (0, [`MAX_FACTOR`]].
    pub factor: f64,
    /// What was said.
    pub verdict: Verdict,
}

/// Log-likelihood of comparisons as a function of θ = β w, by [`AnswerModel`] at d = factor × ⟨θ, Φ_more − Φ_less⟩. Concave where
/// no clicks are random and "can't tell" was not offered.
#[derive(Debug, Clone)]
pub struct PreferenceLikelihood {
    n_features: usize,
    features: Vec<f64>,
    answers: Vec<Answer>,
    model: AnswerModel,
    layout: Layout,
    arch: Arch,
}

impl PreferenceLikelihood {
    /// The likelihood of `answers` about items with `features`: a row of `n_features` per item, Φ_τ = Σ_t φ(s_t). Without
    /// answers it is 1 for every θ. The result does not depend on the order of the answers.
    ///
    /// # Errors
    /// Sizes out of bounds, features that are ragged, too large or not finite, items that do not exist, factors or parameters out of range,
    /// and answers that the model never gives.
    pub fn new(
        n_features: usize,
        features: Vec<f64>,
        answers: Vec<Answer>,
        model: AnswerModel,
    ) -> Result<Self, PreferenceError> {
        model.check()?;
        let n_items = check_items(n_features, &features)?;
        check_answers(n_items, &answers, &model)?;
        Ok(Self::trusted(n_features, n_items, features, answers, model))
    }

    /// As [`Self::new`] from checked parts; here `n_features` may be 0.
    fn trusted(
        n_features: usize,
        n_items: usize,
        features: Vec<f64>,
        answers: Vec<Answer>,
        model: AnswerModel,
    ) -> Self {
        let layout = Layout::new(n_items, n_features, &features, &answers);
        Self { n_features, features, answers, model, layout, arch: Arch::new() }
    }

    /// An evaluator with buffers of its own, for one thread.
    pub fn evaluator(&self) -> PreferenceEvaluator<'_> {
        PreferenceEvaluator::new(self)
    }

    /// Number of weights.
    pub fn n_features(&self) -> usize {
        self.n_features
    }

    /// Number of items.
    pub fn n_items(&self) -> usize {
        self.layout.n_items
    }

    /// Features of the items: `n_items` rows of `n_features`.
    pub fn items(&self) -> &[f64] {
        &self.features
    }

    /// The answers as given.
    pub fn answers(&self) -> &[Answer] {
        &self.answers
    }

    /// How answers come about.
    pub fn model(&self) -> &AnswerModel {
        &self.model
    }

    /// log P(answers | θ) in nats, by buffers made for this call: see [`PreferenceEvaluator::value`].
    pub fn value(&self, theta: &[f64]) -> f64 {
        self.evaluator().value(theta)
    }
}

/// Gives the number of items.
fn check_items(n_features: usize, features: &[f64]) -> Result<usize, PreferenceError> {
    if !(1..=MAX_FEATURES).contains(&n_features) {
        return Err(PreferenceError::FeatureCount { got: n_features });
    }
    if !features.len().is_multiple_of(n_features) {
        return Err(PreferenceError::Ragged { got: features.len(), n_features });
    }
    let n_items = features.len() / n_features;
    if n_items > MAX_ITEMS || features.len() > MAX_NUMBERS {
        return Err(PreferenceError::TooManyItems { got: n_items, n_features });
    }
    if let Some(at) = features.iter().position(|value| value.is_nan() || value.abs() > MAX_VALUE) {
        let (item, feature) = (at / n_features, at % n_features);
        return Err(PreferenceError::FeatureValue { item, feature, got: features[at] });
    }
    Ok(n_items)
}

fn check_answers(n_items: usize, answers: &[Answer], model: &AnswerModel) -> Result<(), PreferenceError> {
    if answers.len() > MAX_ANSWERS {
        return Err(PreferenceError::TooManyAnswers { got: answers.len() });
    }
    for (position, answer) in answers.iter().enumerate() {
        for item in [answer.less, answer.more] {
            if item >= n_items {
                return Err(PreferenceError::UnknownItem { answer: position, got: item, n_items });
            }
        }
        if answer.less == answer.more {
            return Err(PreferenceError::SameItem { answer: position, item: answer.less });
        }
        if !(answer.factor > 0.0 && answer.factor <= MAX_FACTOR) {
            return Err(PreferenceError::Factor { answer: position, got: answer.factor });
        }
        model.check_offered(position, answer.verdict)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{Answer, AnswerModel, PreferenceLikelihood, Verdict};
    use pulp::Arch;

    #[test]
    fn every_vector_width_gives_the_same_bits() {
        let (n_items, n_features) = (45, 11);
        let features: Vec<f64> =
            (0..n_items * n_features).map(|at| f64::from((at * at % 97) as u32) / 50.0 - 1.0).collect();
        let verdicts = [Verdict::Strict, Verdict::Equal, Verdict::CantTell];
        let answers: Vec<Answer> = (0..2000)
            .map(|at| Answer {
                less: at % n_items,
                more: (at + 1 + at * at % (n_items - 1)) % n_items,
                factor: 1.0 + (at % 3) as f64,
                verdict: verdicts[at % 3],
            })
            .collect();
        let theta: Vec<f64> = (0..n_features).map(|at| f64::from((at * 5 % 7) as u32) - 3.0).collect();
        let strict: Vec<Answer> = answers.iter().map(|answer| Answer { verdict: Verdict::Strict, ..*answer }).collect();
        let full = AnswerModel { equal_threshold: 0.5, cant_tell: 0.3, wrong_rate: 0.0 };
        for (answers, model) in
            [(&strict, AnswerModel::default()), (&answers, full), (&answers, AnswerModel { wrong_rate: 0.1, ..full })]
        {
            let widest = PreferenceLikelihood::new(n_features, Vec::clone(&features), answers.clone(), model)
                .expect("good answers");
            let scalar = PreferenceLikelihood { arch: Arch::Scalar, ..widest.clone() };
            let of = |likelihood: &PreferenceLikelihood| {
                let mut gradient = vec![0.0; n_features];
                let value = likelihood.evaluator().value_and_gradient(&theta, &mut gradient);
                (value.to_bits(), gradient)
            };
            assert_eq!(of(&widest), of(&scalar));
        }
    }
}
