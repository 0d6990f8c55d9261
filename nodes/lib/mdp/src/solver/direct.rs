//! Policy iteration with successor features of every policy, for processes whose factors are cheap.

use std::sync::Arc;

use crate::linear::Order;
use crate::solver::Working;
use crate::solver::base::Base;
use crate::solver::evaluated::{Evaluated, Memory};
use crate::solver::greedy::Tolerances;
use crate::solver::tables::Tables;

/// Improvements after which a gain within the tie tolerance is taken for rounding.
const MANY_ROUNDS: usize = 1000;
/// Improvements after which any gain is: policy iteration takes tens.
const MAX_ROUNDS: usize = 10 * MANY_ROUNDS;

#[derive(Debug, Clone)]
pub(super) struct Direct {
    order: Order,
    base: Base,
    memory: Memory,
    current: Arc<Evaluated>,
}

impl Direct {
    pub(super) fn new(tables: &Tables<'_>, order: Order) -> Self {
        let policy = vec![0; tables.mdp.n_states()];
        let base = Base::new(tables, &order, &policy);
        let mut memory = Memory::new(policy.len() * (tables.mdp.n_features() + 2));
        let current = memory.add(Evaluated::with_psi(policy, base.psi().to_vec()));
        Self { order, base, memory, current }
    }

    /// The policy last found, evaluated.
    pub(super) fn current(&self) -> Arc<Evaluated> {
        Arc::clone(&self.current)
    }

    /// The first optimal policy under `w`; its V and Q into `values` and `q`.
    pub(super) fn solve(
        &mut self,
        tables: &Tables<'_>,
        w: &[f64],
        tolerances: Tolerances,
        working: &mut Working,
        values: &mut [f64],
        q: &mut [f64],
    ) -> Arc<Evaluated> {
        let Tolerances { tie, rounding } = tolerances;
        for round in 0..MAX_ROUNDS {
            combine(self.current.psi(tables.mdp), w, values);
            tables.backup(&working.rewards, values, q);
            working.greedy.set(q, tie);
            let enough = if round < MANY_ROUNDS { rounding } else { tie };
            if working.greedy.gain(values) <= enough {
                // Optimal. Which of the optimal policies it is must not depend on the way here.
                if working.greedy.first != self.current.actions {
                    self.turn_to(tables, &working.greedy.first);
                }
                break;
            }
            improve(working, values, q, rounding);
            if working.next == self.current.actions {
                break;
            }
            self.turn_to(tables, &working.next);
        }
        self.current()
    }

    /// Makes the policy given as numbers the current one.
    fn turn_to(&mut self, tables: &Tables<'_>, actions: &[f64]) {
        self.current = self.memory.find(actions).unwrap_or_else(|| {
            let policy: Vec<usize> = actions.iter().map(|&action| action as usize).collect();
            let psi = self.base.successor_features(tables, &self.order, &policy);
            self.memory.add(Evaluated::with_psi(policy, psi))
        });
    }
}

/// V = Ψ w, Ψ given k × S.
fn combine(psi: &[f64], w: &[f64], values: &mut [f64]) {
    let n = values.len();
    values.fill(0.0);
    let mut blocks = psi.chunks_exact(4 * n);
    let mut weights = w.chunks_exact(4);
    for (block, w) in blocks.by_ref().zip(weights.by_ref()) {
        let ([a, b], [c, d]) = ([&block[..n], &block[n..2 * n]], [&block[2 * n..3 * n], &block[3 * n..]]);
        for ((((value, a), b), c), d) in values.iter_mut().zip(a).zip(b).zip(c).zip(d) {
            *value = *value + w[0] * a + w[1] * b + w[2] * c + w[3] * d;
        }
    }
    for (psi, w) in blocks.remainder().chunks_exact(n).zip(weights.remainder()) {
        for (value, psi) in values.iter_mut().zip(psi) {
            *value += w * psi;
        }
    }
}

/// A better policy into `next`: the first of the best actions where that loses nothing, the very best where the first would
/// gain nothing.
fn improve(working: &mut Working, values: &[f64], q: &[f64], rounding: f64) {
    let n = values.len();
    for (state, next) in working.next.iter_mut().enumerate() {
        let (first, best, value) = (working.greedy.first[state], working.greedy.best[state], values[state]);
        let gains = best > value + rounding;
        let least = if gains { value + rounding } else { value - rounding };
        *next = if q[first as usize * n + state] >= least {
            first
        } else {
            q[state..].iter().step_by(n).position(|q| *q == best).unwrap_or(0) as f64
        };
    }
}
