//! The linear program (dissertation eq. 7.6 and F.1–F.4) with feature counts as k variables of their own: N × k numbers for
//! the draws instead of N × S·A for their rewards.

use mdp::Mdp;

use super::active::Active;
use super::program::{Answer, Effort, Prepared, Program};

use super::units::Units;
use crate::level::Level;
use crate::reachable::Reachable;
use crate::scenarios::{Scenarios, dot};

/// The program of one process for some active draws and one α; λ may be changed.
///
/// Variables, in this order: visits u of every reachable state and action, scaled feature counts v, τ, z of active draws.
/// Rows: flow of every reachable state, what v is, then τ − z_i − a_iᵀv ≤ (w_iᵀμ_ref − b_i − σ_ref) / unit per active draw.
pub(super) struct Broil {
    prepared: Prepared,
    units: Units,
    n_visits: usize,
    n_equal: usize,
}

/// What the program answers, in the units of the process.
pub(super) struct Solved {
    /// u: S × A.
    pub(super) occupancy: Vec<f64>,
    /// σ; −∞ where only the mean reward matters.
    pub(super) edge: f64,
    /// q of the active draws, up to a factor.
    pub(super) duals: Vec<f64>,
}

impl Broil {
    pub(super) fn new(
        mdp: &Mdp,
        reachable: &Reachable,
        scenarios: &Scenarios,
        active: &Active,
        units: Units,
        level: Level,
        effort: Effort,
    ) -> Self {
        let (n_flows, n_actions) = (reachable.states.len(), mdp.n_actions());
        let n_equal = n_flows + mdp.n_features();
        let mut right: Vec<f64> = reachable.states.iter().map(|&state| mdp.initial()[state] / units.visits).collect();
        right.extend(units.reference.iter().zip(&units.scale).map(|(x, s)| x / s));
        right.extend(active.draws.iter().map(|&i| {
            let i = i as usize;
            (dot(scenarios.draw(i), &units.reference) - scenarios.offsets[i] - units.edge) / units.unit
        }));
        let mut program = Program::new(right, n_equal);
        for (place, &state) in reachable.states.iter().enumerate() {
            for action in 0..n_actions {
                let flow = reachable.flow(mdp, place, state, action);
                let counts = mdp.features(state, action).iter().zip(&units.scale).enumerate();
                let counts = counts.map(|(j, (phi, s))| (n_flows + j, phi * units.visits / s));
                program.nonnegative(flow.into_iter().chain(counts));
            }
        }
        let draw = |row: usize, i: u32| (n_equal + row, scenarios.draw(i as usize));
        let rows = || active.draws.iter().enumerate().map(|(row, &i)| draw(row, i));
        for (j, s) in units.scale.iter().enumerate() {
            let slopes = rows().map(|(row, w)| (row, -w[j] * s / units.unit));
            program.free([(n_flows + j, -1.0)].into_iter().chain(slopes));
        }
        if !level.is_neutral() {
            program.free(rows().map(|(row, _)| (row, 1.0)));
            for (row, &i) in active.draws.iter().enumerate() {
                if level.held(scenarios.masses[i as usize]) < 1.0 {
                    program.nonnegative([(n_equal + row, -1.0)]);
                }
            }
        }
        let n_visits = n_flows * n_actions;
        let prepared = program.prepare(&costs(n_visits, scenarios, active, &units, level), effort);
        Self { prepared, units, n_visits, n_equal }
    }

    /// Another λ. It must be below 1 exactly if the first one was.
    pub(super) fn set_level(&mut self, scenarios: &Scenarios, active: &Active, level: Level) {
        self.prepared.set_costs(&costs(self.n_visits, scenarios, active, &self.units, level));
    }

    /// The answer; `None` where it is not even numbers.
    pub(super) fn solve(&mut self, mdp: &Mdp, reachable: &Reachable, level: Level) -> (Answer, Option<Solved>) {
        let answer = self.prepared.solve();
        if answer.variables.iter().chain(&answer.duals).any(|x| !x.is_finite()) {
            return (answer, None);
        }
        let n_actions = mdp.n_actions();
        let mut occupancy = vec![0.0; mdp.n_states() * n_actions];
        for (&state, row) in reachable.states.iter().zip(answer.variables[..self.n_visits].chunks(n_actions)) {
            for (u, x) in occupancy[state * n_actions..].iter_mut().zip(row) {
                *u = self.units.visits * x.max(0.0);
            }
        }
        let edge = if level.is_neutral() {
            f64::NEG_INFINITY
        } else {
            self.units.edge + self.units.unit * answer.variables[self.n_visits + mdp.n_features()]
        };
        let duals = answer.duals[self.n_equal..].to_vec();
        (answer, Some(Solved { occupancy, edge, duals }))
    }
}

/// Costs of all variables: (1 − λ)(−τ + Σ c_i z_i) − λ w̄ᵀ(s ∘ v) / unit with c_i = p_i / (1 − α).
fn costs(n_visits: usize, scenarios: &Scenarios, active: &Active, units: &Units, level: Level) -> Vec<f64> {
    let mean = if level.is_neutral() { 1.0 } else { level.lambda };
    let mut costs = vec![0.0; n_visits];
    costs.extend(scenarios.mean.iter().zip(&units.scale).map(|(w, s)| -mean * w * s / units.unit));
    if !level.is_neutral() {
        costs.push(-level.risk());
        // A draw that can hold the whole tail is never worth falling below: it has no z.
        let held = active.draws.iter().map(|&i| level.held(scenarios.masses[i as usize]));
        costs.extend(held.filter(|held| *held < 1.0).map(|held| level.risk() * held));
    }
    costs
}
