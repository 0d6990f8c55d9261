//! The likelihood of comparisons with buffers of its own, dispatched to the widest vectors of the machine.

use pulp::{Simd, WithSimd};

use super::PreferenceLikelihood;
use super::kernel::{self, Constants, Scratch};

/// Evaluates a [`PreferenceLikelihood`]; one per thread.
#[derive(Debug, Clone)]
pub struct PreferenceEvaluator<'a> {
    likelihood: &'a PreferenceLikelihood,
    constants: Constants,
    scratch: Scratch,
}

impl<'a> PreferenceEvaluator<'a> {
    pub(super) fn new(likelihood: &'a PreferenceLikelihood) -> Self {
        let constants = Constants::new(&likelihood.model);
        Self { likelihood, constants, scratch: Scratch::new(&likelihood.layout) }
    }

    /// log P(answers | θ) in nats, for `n_features` numbers θ. Not a number where θ or a return ⟨θ, Φ⟩ is not finite.
    ///
    /// # Panics
    /// On another number of weights.
    pub fn value(&mut self, theta: &[f64]) -> f64 {
        assert_eq!(theta.len(), self.likelihood.n_features, "a weight per feature");
        self.likelihood.arch.dispatch(Value { evaluator: self, theta })
    }

    /// log P(answers | θ) in nats, the same bits as [`Self::value`]; its gradient in θ goes to `gradient`.
    ///
    /// # Panics
    /// On another number of weights or derivatives.
    pub fn value_and_gradient(&mut self, theta: &[f64], gradient: &mut [f64]) -> f64 {
        assert_eq!(theta.len(), self.likelihood.n_features, "a weight per feature");
        assert_eq!(gradient.len(), self.likelihood.n_features, "a derivative per feature");
        self.likelihood.arch.dispatch(ValueAndGradient { evaluator: self, theta, gradient })
    }
}

// Named operations, because a closure would not be inlined into the dispatch and miss the machine's vectors.

struct Value<'e, 'a> {
    evaluator: &'e mut PreferenceEvaluator<'a>,
    theta: &'e [f64],
}

impl WithSimd for Value<'_, '_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> f64 {
        let PreferenceEvaluator { likelihood, constants, scratch } = self.evaluator;
        kernel::differences(&likelihood.layout, self.theta, scratch);
        kernel::answers(&likelihood.layout, constants, scratch)
    }
}

struct ValueAndGradient<'e, 'a> {
    evaluator: &'e mut PreferenceEvaluator<'a>,
    theta: &'e [f64],
    gradient: &'e mut [f64],
}

impl WithSimd for ValueAndGradient<'_, '_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> f64 {
        let PreferenceEvaluator { likelihood, constants, scratch } = self.evaluator;
        kernel::differences(&likelihood.layout, self.theta, scratch);
        let value = kernel::answers(&likelihood.layout, constants, scratch);
        kernel::gradient(&likelihood.layout, scratch, self.gradient);
        value
    }
}
