//! The posterior of a table lesson: placements alone.

use likelihood::placements::{Demonstration, EvidenceError, Lesson};

use crate::{
    Draws, EvidenceKind, Model, ModelError, PlacementTerm, Settings, SettingsError, Term, TermLikelihood, draw,
    evidence_hash,
};

/// Why there are no draws.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PosteriorError {
    /// A setting out of range.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// A demonstration that cannot be learned from.
    #[error(transparent)]
    Evidence(#[from] EvidenceError),
    /// A model that does not fit together.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// Given up, as was asked.
    #[error("sampling was given up because its draws were no longer wanted")]
    Stopped,
}

/// Draws from the posterior of the weights given `demonstrations`, all about the same `lesson`.
///
/// The same for any number of threads and whatever was sampled before. Without demonstrations: draws from the prior.
///
/// # Errors
/// Settings out of range; a demonstration that is malformed, about other objects, or whose target fits nowhere.
pub fn sample(
    settings: &Settings,
    seed: u64,
    lesson: &Lesson,
    demonstrations: &[Demonstration],
) -> Result<Draws, PosteriorError> {
    settings.check()?;
    let model = Model {
        n_features: lesson.n_features(),
        prior: settings.prior,
        nonnegative_return: None,
        terms: vec![settings.placements(lesson, demonstrations)?],
    };
    draw(&model, &settings.run(), seed, &evidence_hash(demonstrations))
}

impl Settings {
    /// Placements as a term of a posterior.
    ///
    /// # Errors
    /// A demonstration that is malformed, about other objects, or whose target fits nowhere.
    pub fn placements(
        &self,
        lesson: &Lesson,
        demonstrations: &[Demonstration],
    ) -> Result<Term<'static>, EvidenceError> {
        let beta = self.rationality.median();
        let term = PlacementTerm::new(lesson, demonstrations, self.grid_side, self.confidence_factors, beta)?;
        Ok(Term {
            kind: EvidenceKind::Placements,
            rationality: self.rationality,
            likelihood: TermLikelihood::Placements(term),
        })
    }
}
