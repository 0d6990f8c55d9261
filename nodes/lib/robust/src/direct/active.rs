//! The draws that the linear program needs to know: those that may be in the tail.

use crate::level::Level;
use crate::scenarios::Scenarios;

/// Least probability, in tails, of the draws that are known at first, and of those looked at again later.
const AT_FIRST: f64 = 3.0;
const LATER: f64 = 1.5;

/// Draws of whose excess z_i a program knows. Leaving one out can only raise the optimum, and changes nothing while its ψ_i
/// is at least σ: so a few times the tail is enough, and what turns out to be missing is added.
#[derive(Debug, Clone)]
pub(super) struct Active {
    pub(super) draws: Vec<u32>,
    is_active: Vec<bool>,
}

impl Active {
    /// Those lowest in `values`: N numbers. None where only the mean reward matters.
    pub(super) fn new(scenarios: &Scenarios, level: Level, values: &[f64]) -> Self {
        let mut active = Self { draws: vec![], is_active: vec![false; scenarios.n()] };
        if !level.is_neutral() {
            active.include(scenarios, level, values, f64::NEG_INFINITY, AT_FIRST);
        }
        active
    }

    /// Adds those that are in the tail of `values` or nearly so, or below `edge`; whether there were any.
    pub(super) fn extend(&mut self, scenarios: &Scenarios, level: Level, values: &[f64], edge: f64) -> bool {
        !level.is_neutral() && self.include(scenarios, level, values, edge, LATER)
    }

    fn include(&mut self, scenarios: &Scenarios, level: Level, values: &[f64], edge: f64, tails: f64) -> bool {
        let before = self.draws.len();
        let mut order: Vec<u32> = (0..values.len() as u32).collect();
        order.sort_unstable_by(|&i, &j| values[i as usize].total_cmp(&values[j as usize]).then(i.cmp(&j)));
        let mut mass = 0.0;
        for index in order {
            let i = index as usize;
            if mass > tails * (1.0 - level.alpha) && values[i] >= edge {
                break;
            }
            mass += scenarios.masses[i];
            if !self.is_active[i] {
                self.is_active[i] = true;
                self.draws.push(index);
            }
        }
        self.draws.len() > before
    }
}
