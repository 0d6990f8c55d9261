//! The flags of what is claimed, and with which confidence.

use clap::ValueEnum;
use risk::{ErrorBudget, RiskError, Tail};

use crate::OfflineError;
use crate::evidence::flag;

/// Level, confidence and the look that spends it.
#[derive(Debug, Clone, Copy, clap::Args)]
#[command(next_help_heading = "Claim")]
pub struct LevelArguments {
    /// Level of the quantile: a bound is to hold for this share of the rewards that fit
    #[arg(long, value_name = "ALPHA", default_value_t = 0.95)]
    alpha: f64,
    /// A bound is to hold with confidence 1 - DELTA
    #[arg(long, value_name = "DELTA", default_value_t = 0.05)]
    delta: f64,
    /// Number of this look, from 1, where a bound is taken after every answer: look T spends 6 DELTA / (pi^2 T^2), so that
    /// the bounds of all looks hold together
    #[arg(long, value_name = "T")]
    look: Option<u64>,
}

/// Those, checked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Levels {
    pub(crate) alpha: f64,
    /// As given.
    pub(crate) delta: f64,
    pub(crate) look: Option<u64>,
    /// What this look may spend.
    pub(crate) delta_spent: f64,
}

impl LevelArguments {
    pub(crate) fn check(&self) -> Result<Levels, OfflineError> {
        let Self { alpha, delta, look } = *self;
        if !(alpha > 0.0 && alpha < 1.0) {
            return Err(RiskError::Level { name: "alpha", got: alpha }.into());
        }
        let budget = ErrorBudget::new(delta)?;
        if look == Some(0) {
            return Err(flag("--look", "got 0, expected the number of the look, from 1"));
        }
        let delta_spent = look.map_or(budget, |look| budget.at_look(look)).delta();
        Ok(Levels { alpha, delta, look, delta_spent })
    }
}

/// Which end is the bad one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum TailName {
    /// Large values are bad: losses
    Upper,
    /// Small values are bad: returns
    Lower,
}

impl TailName {
    pub(crate) fn tail(self) -> Tail {
        match self {
            Self::Upper => Tail::Upper,
            Self::Lower => Tail::Lower,
        }
    }
}
