//! When to stop asking, and what to say when not (section 8.3).

use crate::error::check_numbers;
use crate::prediction::{Prediction, predict};
use crate::{HoldOut, InquiryError, PredictiveCheck, Selection};

/// When a lesson is over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StoppingRule {
    /// The bound on the (normalised) loss that is good enough.
    pub epsilon: f64,
    /// Probability with which a lesson may be stopped although the loss exceeds ε, if the model is right.
    pub delta: f64,
    /// Gain per second of the person's time below which questions are not worth asking; 0: none is too small.
    pub least_gain_per_second: f64,
    /// Share of surprises among answers to random questions that is still tolerable, in (0, 1]: nothing is taught before they show,
    /// with confidence 1 − δ, that there are no more. 1: they need not.
    pub most_surprises: f64,
    /// Level at which hold-out questions and the predictive check count as proof of a wrong model.
    pub misfit_level: f64,
}

/// The levels that the bound of one look has to be computed with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LookLevels {
    /// α: the share of rewards that fit for which the bound has to hold.
    pub alpha: f64,
    /// δ of this look: the confidence in the bound as an estimate from finitely many draws is 1 − δ.
    pub delta: f64,
}

/// What is known at a look.
#[derive(Debug, Clone, Copy)]
pub struct Look<'a> {
    /// The bound of every look so far, this one last; `None` where there was none.
    pub bounds: &'a [Option<f64>],
    /// What would be asked next.
    pub next: &'a Selection,
    /// Expected drop of the bound by the next answer, where it is known.
    pub drop: Option<f64>,
    /// Answers to random questions.
    pub hold_out: HoldOut,
    /// Whether the answers fit the features.
    pub fit: Option<&'a PredictiveCheck>,
}

/// Where a lesson stands.
#[derive(Debug, Clone, PartialEq)]
pub enum Standing {
    /// The bound is below ε, and nothing speaks against the model.
    Taught {
        /// The bound.
        bound: f64,
    },
    /// The bound is below ε, but too few random questions confirm the model that it rests on.
    Confirming {
        /// The bound.
        bound: f64,
        /// Random questions to ask, if none of their answers is a surprise.
        about: u32,
    },
    /// More answers are needed.
    NotYet {
        /// About how many, where anything can be said.
        about: Option<Prediction>,
    },
    /// More answers will not help.
    CannotBeReached {
        /// Why.
        because: Obstacle,
        /// What the check of the fit found, when it warns: a feature that the person goes by is missing.
        missing_feature: Option<PredictiveCheck>,
    },
}

/// Why ε cannot be reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Obstacle {
    /// Answers to random questions were surprises too often for the model to be right.
    Surprises {
        /// Counts.
        hold_out: HoldOut,
        /// 95 % interval of their true share.
        interval: [f64; 2],
    },
    /// The answers cannot be explained with these features.
    Misfit {
        /// Of the posterior-predictive check.
        p_value: f64,
    },
    /// No question can be carried out.
    NothingFeasible,
    /// No answer would change anything, but the bound is not below ε.
    NothingToLearn,
    /// The best question gains too little for the time it takes.
    NotWorthIt {
        /// Its gain per second.
        gain_per_second: f64,
    },
}

impl StoppingRule {
    /// Refuses a rule that makes no sense.
    ///
    /// # Errors
    /// ε that is not positive, δ or the misfit level outside (0, 1), a negative gain.
    pub fn check(&self) -> Result<(), InquiryError> {
        let positive = |x: f64| x > 0.0 && x.is_finite();
        check_numbers("epsilon", &[self.epsilon], "positive and finite", positive)?;
        let share = [self.most_surprises];
        check_numbers("most surprises", &share, "above 0 and at most 1", |x| x > 0.0 && x <= 1.0)?;
        let levels = [self.delta, self.misfit_level];
        check_numbers("level", &levels, "strictly between 0 and 1", |x| x > 0.0 && x < 1.0)?;
        let gain = [self.least_gain_per_second];
        check_numbers("least gain", &gain, "at least 0 and finite", |x| x >= 0.0 && x.is_finite())
    }

    /// Levels of look number `look`, from 1. One half of δ is what rewards that fit may lose more than the bound (1 − α); the
    /// other is shared by all looks for the chance that draws mislead: δ_t = 3 δ/(π² t²). Beliefs stay right however
    /// the time to stop is chosen, so the former is spent once: in all, P(stopped and loss > ε) ≤ δ.
    pub fn at_look(&self, look: u64) -> LookLevels {
        LookLevels { alpha: 1.0 - 0.5 * self.delta, delta: risk::delta_spent(0.5 * self.delta, look) }
    }

    /// Where the lesson stands. A model that is refuted is told first: then no bound holds.
    ///
    /// # Errors
    /// A rule that makes no sense.
    pub fn standing(&self, look: &Look<'_>) -> Result<Standing, InquiryError> {
        self.check()?;
        let bound = look.bounds.last().copied().flatten();
        let missing_feature = look.fit.filter(|fit| fit.warns(self.misfit_level)).cloned();
        let hopeless = |because| Standing::CannotBeReached { because, missing_feature: missing_feature.clone() };
        if look.hold_out.refutes(self.misfit_level)? {
            let interval = look.hold_out.interval(0.95)?;
            return Ok(hopeless(Obstacle::Surprises { hold_out: look.hold_out, interval }));
        }
        if let Some(fit) = &missing_feature {
            return Ok(hopeless(Obstacle::Misfit { p_value: fit.p_value }));
        }
        if let Some(bound) = bound.filter(|bound| *bound < self.epsilon) {
            let about = look.hold_out.missing(self.most_surprises, self.delta)?;
            return Ok(if about == 0 { Standing::Taught { bound } } else { Standing::Confirming { bound, about } });
        }
        Ok(match look.next {
            Selection::NothingFeasible => hopeless(Obstacle::NothingFeasible),
            Selection::NothingToLearn => hopeless(Obstacle::NothingToLearn),
            Selection::Ask(chosen) => match chosen.per_second {
                Some(gain_per_second) if gain_per_second < self.least_gain_per_second && !chosen.is_hold_out => {
                    hopeless(Obstacle::NotWorthIt { gain_per_second })
                }
                _ => Standing::NotYet { about: predict(look.bounds, self.epsilon, look.drop) },
            },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{Look, Obstacle, Standing, StoppingRule};
    use crate::{Chosen, HoldOut, PredictiveCheck, Selection};

    const RULE: StoppingRule = StoppingRule {
        epsilon: 0.1,
        delta: 0.05,
        least_gain_per_second: 0.01,
        most_surprises: 1.0,
        misfit_level: 0.01,
    };
    const ASK: Selection =
        Selection::Ask(Chosen { question: 0, score: 0.5, per_second: Some(0.05), is_hold_out: false });

    fn look<'a>(bounds: &'a [Option<f64>], next: &'a Selection) -> Look<'a> {
        Look { bounds, next, drop: None, hold_out: HoldOut::default(), fit: None }
    }

    #[test]
    fn taught_only_below_epsilon_and_with_a_bound() {
        let standing = |bound: Option<f64>| RULE.standing(&look(&[bound], &ASK)).expect("a rule");
        assert_eq!(standing(Some(0.09)), Standing::Taught { bound: 0.09 });
        assert_eq!(standing(Some(0.1)), Standing::NotYet { about: None });
        assert_eq!(standing(None), Standing::NotYet { about: None });
        // Nothing left to ask is no obstacle when the bound is below ε.
        let done = RULE.standing(&look(&[Some(0.0)], &Selection::NothingToLearn)).expect("a rule");
        assert_eq!(done, Standing::Taught { bound: 0.0 });
    }

    #[test]
    fn a_bound_may_have_to_be_confirmed() {
        let rule = StoppingRule { most_surprises: 0.5, ..RULE };
        let standing = |n, surprises| {
            let look = Look { hold_out: HoldOut { n, surprises }, ..look(&[Some(0.05)], &ASK) };
            rule.standing(&look).expect("a rule")
        };
        // Without a surprise the share is at most 1 − .05^(1/n): .527 at 4, .451 at 5.
        assert_eq!(standing(0, 0), Standing::Confirming { bound: 0.05, about: 5 });
        assert_eq!(standing(4, 0), Standing::Confirming { bound: 0.05, about: 1 });
        assert_eq!(standing(5, 0), Standing::Taught { bound: 0.05 });
        // With one, 7 of 8 have to be none: P(X ≤ 1; 8, ½) = .035.
        assert_eq!(standing(5, 1), Standing::Confirming { bound: 0.05, about: 3 });
        assert!(StoppingRule { most_surprises: 0.0, ..RULE }.check().is_err());
    }

    #[test]
    fn what_cannot_be_reached_says_why() {
        let because = |look: &Look<'_>| match RULE.standing(look).expect("a rule") {
            Standing::CannotBeReached { because, missing_feature } => (because, missing_feature.is_some()),
            other => panic!("{other:?}"),
        };
        let high = [Some(0.5)];
        assert_eq!(because(&look(&high, &Selection::NothingFeasible)), (Obstacle::NothingFeasible, false));
        assert_eq!(because(&look(&high, &Selection::NothingToLearn)), (Obstacle::NothingToLearn, false));
        let dear = Selection::Ask(Chosen { question: 0, score: 0.01, per_second: Some(0.001), is_hold_out: false });
        assert_eq!(because(&look(&high, &dear)), (Obstacle::NotWorthIt { gain_per_second: 0.001 }, false));
        // A low bound of a wrong model is worth nothing.
        let low = [Some(0.01)];
        let surprised = Look { hold_out: HoldOut { n: 8, surprises: 6 }, ..look(&low, &ASK) };
        assert!(matches!(because(&surprised), (Obstacle::Surprises { .. }, false)));
        let fit = PredictiveCheck { p_value: 0.001, worst: vec![2] };
        let odd = Look { fit: Some(&fit), ..look(&low, &ASK) };
        assert_eq!(because(&odd), (Obstacle::Misfit { p_value: 0.001 }, true));
    }

    #[test]
    fn a_falling_bound_has_a_prediction() {
        let bounds = [1.6, 0.8, 0.4].map(Some);
        let Standing::NotYet { about: Some(about) } = RULE.standing(&look(&bounds, &ASK)).expect("a rule") else {
            panic!("a prediction was expected")
        };
        assert_eq!(about.answers, 2);
    }

    #[test]
    fn the_levels_of_all_looks_spend_delta() {
        let spent: f64 = (1..10_000).map(|t| RULE.at_look(t).delta).sum();
        let in_all = spent + 1.0 - RULE.at_look(1).alpha;
        assert!(in_all < 0.05 && in_all > 0.0499, "{in_all}");
        assert!(StoppingRule { delta: 1.0, ..RULE }.check().is_err());
        assert!(StoppingRule { epsilon: 0.0, ..RULE }.check().is_err());
        assert!(StoppingRule { least_gain_per_second: -1.0, ..RULE }.check().is_err());
    }
}
