//! A policy with what is known about it, and a bounded memory of such policies.

use std::sync::{Arc, OnceLock};

use crate::evaluate::{state_visits, successor_features};
use crate::linear::Sweeps;
use crate::model::Mdp;
use crate::policy::Policy;

/// Policies remembered at most.
const MAX_ENTRIES: usize = 256;
/// Numbers remembered at most.
const MAX_NUMBERS: usize = 4_000_000;

/// A policy; its successor features once they were needed.
#[derive(Debug)]
pub(super) struct Evaluated {
    pub(super) policy: Vec<usize>,
    /// The same as numbers to compare with.
    pub(super) actions: Vec<f64>,
    /// Successor features k × S: all states of a feature together.
    psi: OnceLock<Vec<f64>>,
    counts: OnceLock<Vec<f64>>,
    /// Discounted visits of every state, where counts were computed from them.
    visits: OnceLock<Arc<Vec<f64>>>,
}

/// What makes it cheaper to evaluate a policy.
#[derive(Debug, Clone, Default)]
pub(super) struct Help {
    /// Its chain, where that is laid out already.
    pub(super) sweeps: Option<Arc<Sweeps>>,
    /// The visits of a policy that was found shortly before.
    pub(super) near: Option<Arc<Vec<f64>>>,
}

impl Evaluated {
    /// A policy, not evaluated yet.
    pub(super) fn new(policy: Vec<usize>) -> Self {
        let actions = policy.iter().map(|&action| action as f64).collect();
        Self { policy, actions, psi: OnceLock::new(), counts: OnceLock::new(), visits: OnceLock::new() }
    }

    /// A policy with its successor features, k × S.
    pub(super) fn with_psi(policy: Vec<usize>, psi: Vec<f64>) -> Self {
        let evaluated = Self::new(policy);
        evaluated.psi.get_or_init(|| psi);
        evaluated
    }

    /// Successor features k × S if they are known.
    pub(super) fn known_psi(&self) -> Option<&[f64]> {
        self.psi.get().map(Vec::as_slice)
    }

    /// Successor features k × S.
    pub(super) fn psi(&self, mdp: &Mdp) -> &[f64] {
        self.psi.get_or_init(|| {
            let rows = successor_features(mdp, &Policy::Deterministic(self.policy.clone()))
                .expect("a greedy policy is valid, and processes of horizons too long for sweeps are not built");
            transposed(&rows, mdp.n_features())
        })
    }

    /// Expected feature counts: k numbers.
    pub(super) fn counts(&self, mdp: &Mdp, help: &Help) -> &[f64] {
        self.counts.get_or_init(|| {
            let Some(psi) = self.known_psi() else {
                let visits = self.all_visits(mdp, help);
                let mut counts = vec![0.0; mdp.n_features()];
                for ((state, &action), visits) in self.policy.iter().enumerate().zip(&visits) {
                    for (count, phi) in counts.iter_mut().zip(mdp.features(state, action)) {
                        *count += visits * phi;
                    }
                }
                self.visits.get_or_init(|| Arc::new(visits));
                return counts;
            };
            let mean = |psi: &[f64]| psi.iter().zip(mdp.initial()).map(|(psi, p)| p * psi).sum();
            psi.chunks_exact(mdp.n_states()).map(mean).collect()
        })
    }
}

impl Evaluated {
    /// Discounted visits of every state if they are known.
    pub(super) fn known_visits(&self) -> Option<&Arc<Vec<f64>>> {
        self.visits.get()
    }

    fn all_visits(&self, mdp: &Mdp, help: &Help) -> Vec<f64> {
        let Some(sweeps) = &help.sweeps else {
            let policy = Policy::Deterministic(self.policy.clone());
            return state_visits(mdp, &policy).expect("a greedy policy is valid");
        };
        let mut visits = mdp.initial().to_vec();
        match &help.near {
            Some(near) => sweeps.visits_near(&mut visits, near),
            None => sweeps.visits(&mut visits),
        }
        visits
    }
}

/// A table of rows of `width` by columns.
pub(super) fn transposed(table: &[f64], width: usize) -> Vec<f64> {
    let height = table.len() / width;
    let mut turned = vec![0.0; table.len()];
    for (i, row) in table.chunks_exact(width).enumerate() {
        for (j, x) in row.iter().enumerate() {
            turned[j * height + i] = *x;
        }
    }
    turned
}

/// Policies seen, the least recently used forgotten first.
#[derive(Debug, Clone)]
pub(super) struct Memory {
    entries: Vec<(u64, u64, Arc<Evaluated>)>,
    capacity: usize,
    clock: u64,
}

impl Memory {
    pub(super) fn new(numbers_per_policy: usize) -> Self {
        Self { entries: vec![], capacity: (MAX_NUMBERS / numbers_per_policy.max(1)).clamp(2, MAX_ENTRIES), clock: 0 }
    }

    /// The entry of the policy given as numbers, if it is remembered.
    pub(super) fn find(&mut self, actions: &[f64]) -> Option<Arc<Evaluated>> {
        let key = hash(actions);
        self.clock += 1;
        let entry = self.entries.iter_mut().find(|entry| entry.0 == key && entry.2.actions == actions)?;
        entry.1 = self.clock;
        Some(Arc::clone(&entry.2))
    }

    /// Remembers a policy that was not found.
    pub(super) fn add(&mut self, evaluated: Evaluated) -> Arc<Evaluated> {
        let entry = (hash(&evaluated.actions), self.clock, Arc::new(evaluated));
        let added = Arc::clone(&entry.2);
        if self.entries.len() < self.capacity {
            self.entries.push(entry);
        } else if let Some(oldest) = self.entries.iter_mut().min_by_key(|entry| entry.1) {
            *oldest = entry;
        }
        added
    }
}

/// A hash of small whole numbers.
fn hash(actions: &[f64]) -> u64 {
    let mut lanes = [0x9e37_79b9_7f4a_7c15_u64, 0xbf58_476d_1ce4_e5b9, 0x94d0_49bb_1331_11eb, 0xd6e8_feb8_6659_fd93];
    for chunk in actions.chunks(4) {
        for (lane, action) in lanes.iter_mut().zip(chunk) {
            *lane = (lane.rotate_left(5) ^ action.to_bits()).wrapping_mul(0x517c_c1b7_2722_0a95);
        }
    }
    lanes.into_iter().fold(0, |sum, lane| (sum.rotate_left(23) ^ lane).wrapping_mul(0x517c_c1b7_2722_0a95))
}
