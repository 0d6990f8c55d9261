//! Sampling apart from the node, which goes on hearing and acknowledging meanwhile.

use crate::inference::infer;
use crate::{Evidence, Settings};
use posterior::Draws;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// A posterior to be computed, of the evidence as it stood when it became due.
#[derive(Debug, Clone)]
pub struct Work {
    pub(crate) settings: Settings,
    pub(crate) evidence: Evidence,
    /// Fingerprint of the evidence.
    pub(crate) digest: [u8; 32],
    /// The draws, where they are at hand.
    pub(crate) known: Option<Draws>,
    /// Set when the draws are not wanted any more, which is for when there is newer evidence.
    pub(crate) stop: Arc<AtomicBool>,
}

/// What came of it.
#[derive(Debug, Clone)]
pub struct Worked {
    /// Fingerprint of the evidence.
    pub(crate) digest: [u8; 32],
    /// The draws, or why there are none.
    pub(crate) draws: Result<Draws, String>,
}

impl Work {
    /// Computes it: a function of settings and evidence alone, wherever and whenever it runs. It is given up soon after it is
    /// stopped.
    pub fn run(self) -> Worked {
        let Self { settings, evidence, digest, known, stop } = self;
        let draws = match known {
            Some(draws) => Ok(draws),
            None => infer(&stop, &settings, &evidence, &digest),
        };
        Worked { digest, draws }
    }
}

/// What the node is to do when nothing else waits.
#[derive(Debug)]
pub enum Due {
    /// Nothing: the newest posterior is that of the evidence.
    Nothing,
    /// A preview goes out first; the draws themselves never depend on it.
    Preview(Box<crate::Output>),
    /// A posterior is to be computed.
    Posterior(Box<Work>),
}
