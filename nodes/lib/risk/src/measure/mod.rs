//! Risk measures: what one number says of an uncertain loss or return, with the bad tail named.

mod entropic;
mod semideviation;
mod tail_mean;

use crate::distribution::Distribution;
use crate::empirical::Tail;
use crate::error::{RiskError, check_level};

/// A risk measure. All depend on the distribution alone and never fall when a loss becomes stochastically larger, so a
/// distribution that dominates bounds every one of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Measure {
    /// The expectation.
    Mean,
    /// The α-quantile of a loss, the (1 − α)-quantile of a return.
    ValueAtRisk {
        /// Level in (0, 1).
        alpha: f64,
    },
    /// The mean of the worst share 1 − α.
    ConditionalValueAtRisk {
        /// Level in (0, 1).
        alpha: f64,
    },
    /// (1/θ) ln E exp(θX) of a loss, −(1/θ) ln E exp(−θX) of a return.
    Entropic {
        /// Risk aversion θ > 0, in one over the unit of the losses: near 0 the mean, large the worst case.
        aversion: f64,
    },
    /// E X + c E (X − E X)₊ of a loss, E X − c E (E X − X)₊ of a return.
    Semideviation {
        /// Coefficient c in [0, 1]; above 1 the measure would no longer be monotone.
        coefficient: f64,
    },
}

impl Measure {
    /// The measure of `distribution`, where `tail` says which end is bad: a number in the unit of its values.
    ///
    /// # Errors
    /// A parameter of the measure outside its range.
    pub fn of(self, distribution: &Distribution, tail: Tail) -> Result<f64, RiskError> {
        self.check()?;
        Ok(match tail {
            Tail::Upper => self.of_loss(distribution),
            Tail::Lower => -self.of_loss(&distribution.negated()),
        })
    }

    /// Whether its parameter lies in its range.
    pub(crate) fn check(self) -> Result<(), RiskError> {
        let parameter = |name, got, inside, expected| {
            if inside { Ok(()) } else { Err(RiskError::Parameter { name, got, expected }) }
        };
        match self {
            Self::Mean => Ok(()),
            Self::ValueAtRisk { alpha } | Self::ConditionalValueAtRisk { alpha } => check_level("alpha", alpha),
            Self::Entropic { aversion } => {
                parameter("the risk aversion", aversion, aversion > 0.0 && aversion.is_finite(), "positive and finite")
            }
            Self::Semideviation { coefficient } => parameter(
                "the semideviation's coefficient",
                coefficient,
                (0.0..=1.0).contains(&coefficient),
                "from 0 to 1",
            ),
        }
    }

    /// Of a loss; the parameter was checked.
    pub(crate) fn of_loss(self, loss: &Distribution) -> f64 {
        match self {
            Self::Mean => loss.mean(),
            Self::ValueAtRisk { alpha } => loss.quantile(alpha),
            Self::ConditionalValueAtRisk { alpha } => tail_mean::conditional_value_at_risk(loss, alpha),
            Self::Entropic { aversion } => entropic::entropic_risk(loss, aversion),
            Self::Semideviation { coefficient } => semideviation::mean_semideviation(loss, coefficient),
        }
    }
}
