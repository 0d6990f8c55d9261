//! Conjugate directions for equations without symmetry (the generalised conjugate residual method, Eisenstat, Elman and Schultz
//! 1983), of which the last few are kept.

use crate::linear::dot;

/// Steps that the next takes into account.
const HISTORY: usize = 6;

/// A direction d, and (I − Wᵀ) d.
#[derive(Debug, Clone)]
pub(super) struct Step {
    pub(super) direction: Vec<f64>,
    pub(super) image: Vec<f64>,
    /// |image|².
    square: f64,
}

/// The last steps, whose images are orthogonal.
pub(super) struct History {
    steps: Vec<Step>,
    n: usize,
    /// Steps taken since the start.
    taken: usize,
}

impl History {
    pub(super) fn new(n: usize) -> Self {
        Self { steps: vec![], n, taken: 0 }
    }

    /// Room for the next step, in place of the oldest.
    pub(super) fn next(&mut self) -> &mut Step {
        if self.steps.len() < HISTORY {
            self.steps.push(Step { direction: vec![0.0; self.n], image: vec![0.0; self.n], square: 0.0 });
        }
        let place = self.taken % HISTORY;
        self.taken += 1;
        &mut self.steps[place]
    }

    pub(super) fn last(&self) -> &Step {
        &self.steps[(self.taken - 1) % HISTORY]
    }

    /// Begins anew: no step so far is taken into account any more.
    pub(super) fn clear(&mut self) {
        self.steps.iter_mut().for_each(|step| step.square = 0.0);
    }

    /// Takes the parts along the others out of the last step; the share of it that leaves least of `left`.
    pub(super) fn conjugate(&mut self, left: &[f64]) -> f64 {
        let place = (self.taken - 1) % HISTORY;
        let (older, rest) = self.steps.split_at_mut(place);
        let (step, newer) = rest.split_first_mut().expect("a step was taken");
        for other in older.iter().chain(&*newer).filter(|other| other.square > 0.0) {
            let part = dot(&step.image, &other.image) / other.square;
            step.image.iter_mut().zip(&other.image).for_each(|(x, y)| *x -= part * y);
            step.direction.iter_mut().zip(&other.direction).for_each(|(x, y)| *x -= part * y);
        }
        step.square = dot(&step.image, &step.image);
        if step.square > 0.0 { dot(left, &step.image) / step.square } else { 1.0 }
    }
}
