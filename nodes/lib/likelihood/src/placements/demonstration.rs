//! One placement shown by a person, and the lesson it belongs to: weights mean the same in all of its scenes.

use scene::{FIXED_CENTRES, Point, Scene, SceneError};

/// More demonstrations than this are refused.
pub const MAX_DEMONSTRATIONS: usize = 1000;

/// How sure a person was.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Confidence {
    /// This is the place.
    Sure,
    /// About here.
    Fairly,
    /// A guess.
    Guess,
}

/// A person showed where the target belongs in a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Demonstration {
    /// Unique within a session.
    pub id: String,
    /// What stood on the table.
    pub scene: Scene,
    /// Where the target was put; normalised coordinates.
    pub placement: Point,
    /// How sure they were.
    pub confidence: Confidence,
}

/// The objects a lesson is about, in order: each has one weight, then each fixed centre has one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lesson {
    object_ids: Vec<String>,
}

/// Why a demonstration cannot be learned from.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum EvidenceError {
    /// The scene itself is bad.
    #[error("demonstration '{id}': {source}")]
    Scene {
        /// Of the demonstration.
        id: String,
        /// What is wrong.
        source: SceneError,
    },
    /// Other objects, or another order.
    #[error("demonstration '{id}' is about the objects {got:?}, but the lesson is about {expected:?}, in this order")]
    OtherObjects {
        /// Of the demonstration.
        id: String,
        /// Object ids of its scene.
        got: Vec<String>,
        /// Object ids of the lesson.
        expected: Vec<String>,
    },
    /// The placement is not on the table.
    #[error("demonstration '{id}' puts the target at ({x}, {y}), outside the unit square of the table")]
    OffTable {
        /// Of the demonstration.
        id: String,
        /// Normalised.
        x: f64,
        /// Normalised.
        y: f64,
    },
    /// The target fits nowhere, so no placement says anything.
    #[error("demonstration '{id}': the target fits nowhere on the table of scene '{scene}'")]
    NoFreePlace {
        /// Of the demonstration.
        id: String,
        /// Of its scene.
        scene: String,
    },
    /// A rate of placements at random that is none.
    #[error("the rate of wrong placements is {got}, but must be at least 0 and below 1")]
    WrongRate {
        /// Got.
        got: f64,
    },
    /// See [`MAX_DEMONSTRATIONS`].
    #[error("{got} demonstrations, but at most {MAX_DEMONSTRATIONS} are supported")]
    TooMany {
        /// Demonstrations given.
        got: usize,
    },
}

impl Lesson {
    /// The lesson about the objects of a scene.
    pub fn new(scene: &Scene) -> Self {
        Self { object_ids: object_ids(scene) }
    }

    /// The lesson about the objects with these ids.
    pub fn of_objects(object_ids: Vec<String>) -> Self {
        Self { object_ids }
    }

    /// Number of weights: one per object and fixed centre.
    pub fn n_features(&self) -> usize {
        self.object_ids.len() + FIXED_CENTRES.len()
    }

    /// Number of objects.
    pub fn n_objects(&self) -> usize {
        self.object_ids.len()
    }

    /// Checks that a demonstration is well formed and about this lesson's objects. The placement may lie on an occupied
    /// spot (people are a few millimetres off), but not off the table.
    ///
    /// # Errors
    /// Everything of [`EvidenceError`] but `NoFreePlace`, `WrongRate` and `TooMany`.
    pub fn check(&self, demonstration: &Demonstration) -> Result<(), EvidenceError> {
        let id = || demonstration.id.clone();
        let scene = &demonstration.scene;
        scene.check().map_err(|source| EvidenceError::Scene { id: id(), source })?;
        if !scene.objects.iter().map(|object| &object.id).eq(&self.object_ids) {
            return Err(EvidenceError::OtherObjects {
                id: id(),
                got: object_ids(scene),
                expected: self.object_ids.clone(),
            });
        }
        let Point { x, y } = demonstration.placement;
        if !((0.0..=1.0).contains(&x) && (0.0..=1.0).contains(&y)) {
            return Err(EvidenceError::OffTable { id: id(), x, y });
        }
        Ok(())
    }
}

fn object_ids(scene: &Scene) -> Vec<String> {
    scene.objects.iter().map(|object| object.id.clone()).collect()
}
