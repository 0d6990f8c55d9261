//! Successor features of many policies from the factors of one: changing the action in m states changes m rows of
//! I − γP, and Ψ by a matrix of rank m (Sherman, Morrison and Woodbury). Every policy is reached from the base directly,
//! so rounding errors do not build up.

use crate::linear::{Banded, Order};
use crate::solver::evaluated::transposed;
use crate::solver::tables::Tables;

/// Numbers that inverse columns may take in all.
const MAX_COLUMN_NUMBERS: usize = 4_000_000;

/// A policy with factors of its I − γP.
#[derive(Debug, Clone)]
pub(super) struct Base {
    policy: Vec<usize>,
    factors: Banded,
    /// Ψ of the policy, k × S.
    psi: Vec<f64>,
    /// Columns of (I − γP)⁻¹ of states whose action once differed.
    columns: Vec<Option<Box<[f64]>>>,
    n_columns: usize,
    /// Multiplications that a newer base would have saved.
    spent: f64,
}

impl Base {
    pub(super) fn new(tables: &Tables<'_>, order: &Order, policy: &[usize]) -> Self {
        let mdp = tables.mdp;
        let entries = policy.iter().enumerate().flat_map(|(state, &action)| {
            mdp.successors(state, action).map(move |(target, p)| (state, target, mdp.gamma() * p))
        });
        let factors = Banded::new(order, entries);
        let k = mdp.n_features();
        let mut psi = Vec::with_capacity(mdp.n_states() * k);
        for (state, &action) in policy.iter().enumerate() {
            psi.extend_from_slice(mdp.features(state, action));
        }
        factors.solve(&mut psi, k);
        let columns = vec![None; policy.len()];
        Self { policy: policy.to_vec(), factors, psi: transposed(&psi, k), columns, n_columns: 0, spent: 0.0 }
    }

    /// Ψ of the base policy, k × S.
    pub(super) fn psi(&self) -> &[f64] {
        &self.psi
    }

    /// Ψ of `policy`, k × S; may make `policy` the new base.
    pub(super) fn successor_features(&mut self, tables: &Tables<'_>, order: &Order, policy: &[usize]) -> Vec<f64> {
        let changed: Vec<usize> = (0..policy.len()).filter(|&s| policy[s] != self.policy[s]).collect();
        let (n, k, m) = (policy.len() as f64, tables.mdp.n_features() as f64, changed.len() as f64);
        let missing = changed.iter().filter(|&&s| self.columns[s].is_none()).count();
        let column = 3.0 * n * order.bandwidth as f64;
        self.spent += m * n * k + m * m * (m / 3.0 + k + 4.0) + missing as f64 * column;
        let renewal = Banded::work(policy.len(), order.bandwidth) + k * column;
        if self.spent > renewal || (self.n_columns + missing) * policy.len() > MAX_COLUMN_NUMBERS {
            *self = Self::new(tables, order, policy);
            return self.psi.clone();
        }
        for &state in &changed {
            self.need_column(state);
        }
        self.updated(tables, policy, &changed)
    }

    fn need_column(&mut self, state: usize) {
        if self.columns[state].is_none() {
            let mut column = vec![0.0; self.policy.len()];
            column[state] = 1.0;
            self.factors.solve(&mut column, 1);
            self.columns[state] = Some(column.into_boxed_slice());
            self.n_columns += 1;
        }
    }

    /// Ψ' = Ψ + X Y, where X are the inverse columns of the changed states and (I + D X) Y = F − D Ψ; D is the change of
    /// their rows of I − γP and F that of their features.
    fn updated(&self, tables: &Tables<'_>, policy: &[usize], changed: &[usize]) -> Vec<f64> {
        let mdp = tables.mdp;
        let (n, k, m) = (policy.len(), mdp.n_features(), changed.len());
        let columns: Vec<&[f64]> =
            changed.iter().map(|&s| self.columns[s].as_deref().expect("columns were made before")).collect();
        // Row i of `system` is row i of I + D X, then row i of F − D Ψ.
        let width = m + k;
        let mut system = vec![0.0; m * width];
        for (i, (&state, row)) in changed.iter().zip(system.chunks_exact_mut(width)).enumerate() {
            let (new, old) = (policy[state], self.policy[state]);
            for (x, (phi_new, phi_old)) in
                row[m..].iter_mut().zip(mdp.features(state, new).iter().zip(mdp.features(state, old)))
            {
                *x = phi_new - phi_old;
            }
            row[i] = 1.0;
            for (action, sign) in [(new, 1.0), (old, -1.0)] {
                for (target, p) in mdp.successors(state, action) {
                    let weight = sign * (mdp.gamma() * p);
                    for (x, column) in row[..m].iter_mut().zip(&columns) {
                        *x -= weight * column[target];
                    }
                    for (x, psi) in row[m..].iter_mut().zip(self.psi[target..].iter().step_by(n)) {
                        *x += weight * psi;
                    }
                }
            }
        }
        solve_system(&mut system, m, width);
        let mut updated = self.psi.clone();
        for (j, psi) in updated.chunks_exact_mut(n).enumerate() {
            for (i, column) in columns.iter().enumerate() {
                let y = system[i * width + m + j];
                if y != 0.0 {
                    for (psi, x) in psi.iter_mut().zip(*column) {
                        *psi += y * x;
                    }
                }
            }
        }
        updated
    }
}

/// Gauss–Jordan elimination with partial pivoting on m rows of `width`; the solutions replace the columns from m on.
fn solve_system(system: &mut [f64], m: usize, width: usize) {
    for p in 0..m {
        let pivot = (p..m).fold(
            p,
            |best, i| {
                if system[i * width + p].abs() > system[best * width + p].abs() { i } else { best }
            },
        );
        if pivot != p {
            let (upper, lower) = system.split_at_mut(pivot * width);
            upper[p * width..][..width].swap_with_slice(&mut lower[..width]);
        }
        let (above, rest) = system.split_at_mut(p * width);
        let (row, below) = rest.split_at_mut(width);
        let diagonal = row[p];
        row[p..].iter_mut().for_each(|x| *x /= diagonal);
        for other in above.chunks_exact_mut(width).chain(below.chunks_exact_mut(width)) {
            let factor = other[p];
            if factor != 0.0 {
                for (x, y) in other[p..].iter_mut().zip(&row[p..]) {
                    *x -= factor * y;
                }
            }
        }
    }
}
