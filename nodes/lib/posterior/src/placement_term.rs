//! Placements as a term of evidence: the exact likelihood, and a coarser one that drives trajectories.

use likelihood::placements::{
    Demonstration, EvidenceError, Lesson, MAX_DEMONSTRATIONS, Placement, PlacementLikelihood,
};
use scene::Grid;

/// Cells per axis that the forces need at β = 100; sharper likelihoods need more.
const FORCE_SIDE: usize = 16;

/// The placements of a lesson.
#[derive(Debug, Clone)]
pub struct PlacementTerm {
    exact: PlacementLikelihood,
    coarse: Option<PlacementLikelihood>,
}

impl PlacementTerm {
    /// The term of `demonstrations`, all about the same `lesson`, normalised on `grid_side`² cells. A demonstration counts
    /// with the factor of its confidence (sure, fairly, a guess). `beta` is what rationality to expect: it decides how coarse
    /// the forces may be, never what is sampled.
    ///
    /// # Errors
    /// Too many demonstrations; one that is malformed, about other objects, or whose target fits nowhere.
    pub fn new(
        lesson: &Lesson,
        demonstrations: &[Demonstration],
        grid_side: usize,
        confidence_factors: [f64; 3],
        beta: f64,
    ) -> Result<Self, EvidenceError> {
        if demonstrations.len() > MAX_DEMONSTRATIONS {
            return Err(EvidenceError::TooMany { got: demonstrations.len() });
        }
        for demonstration in demonstrations {
            lesson.check(demonstration)?;
        }
        let placements: Vec<Placement<'_>> = demonstrations
            .iter()
            .map(|demonstration| Placement {
                scene: &demonstration.scene,
                at: demonstration.placement,
                factor: confidence_factors[demonstration.confidence as usize],
                masked: true,
            })
            .collect();
        let grid = Grid::midpoints(grid_side);
        let exact = PlacementLikelihood::new(lesson.n_features(), &placements, &grid);
        for (demonstration, n_free) in demonstrations.iter().zip(exact.n_free()) {
            if n_free == 0 {
                let (id, scene) = (demonstration.id.clone(), demonstration.scene.id.clone());
                return Err(EvidenceError::NoFreePlace { id, scene });
            }
        }
        // Cells as wide as the sharpness allows: errors in the force cost acceptance, never exactness.
        let side = FORCE_SIDE as f64 * libm::sqrt(beta / 100.0).max(1.0);
        let widest = (grid_side as f64 / side) as usize;
        let coarse = (2..=widest).rev().find_map(|factor| exact.coarsened(&placements, &grid, factor));
        Ok(Self { exact, coarse })
    }

    /// The same with a rate in [0, 1) of placements at random on the free part of the table.
    ///
    /// # Errors
    /// A rate out of range.
    pub fn with_wrong_rate(self, wrong_rate: f64) -> Result<Self, EvidenceError> {
        let coarse = self.coarse.map(|coarse| coarse.with_wrong_rate(wrong_rate)).transpose()?;
        Ok(Self { exact: self.exact.with_wrong_rate(wrong_rate)?, coarse })
    }

    /// Number of weights.
    pub fn n_features(&self) -> usize {
        self.exact.n_features()
    }

    /// The likelihood.
    pub fn exact(&self) -> &PlacementLikelihood {
        &self.exact
    }

    /// What drives the trajectories.
    pub(crate) fn force(&self) -> &PlacementLikelihood {
        self.coarse.as_ref().unwrap_or(&self.exact)
    }

    /// Whether that is another one.
    pub(crate) fn force_is_coarse(&self) -> bool {
        self.coarse.is_some()
    }
}
