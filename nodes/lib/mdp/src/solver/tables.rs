//! A process laid out for speed: discounted transitions by action, features without their zeros.

use crate::model::Mdp;
use crate::parts::Features;

/// Transitions of a row, padded to the longest, are worth their padding while they take at most this many times the room.
const PADDING: usize = 2;

/// What one solver needs of its process. Row r = a·S + s everywhere: all states of an action stand together.
#[derive(Debug, Clone)]
pub(super) struct Tables<'a> {
    pub(super) mdp: &'a Mdp,
    /// γp of each row.
    transitions: Transitions,
    /// Non-zero features (index, value) of each row, or of each state if actions do not matter.
    feature_starts: Vec<u32>,
    feature_entries: Vec<(u32, f64)>,
    features_by_action: bool,
    /// max |φ_j| for each feature.
    largest: Vec<f64>,
}

/// Targets and weights γp.
#[derive(Debug, Clone)]
enum Transitions {
    /// `width` slots of S·A rows each; empty slots have weight 0.
    Padded { width: usize, targets: Vec<u32>, weights: Vec<f64> },
    /// Row after row.
    Ragged { starts: Vec<u32>, targets: Vec<u32>, weights: Vec<f64> },
}

impl<'a> Tables<'a> {
    pub(super) fn new(mdp: &'a Mdp) -> Self {
        let (values, features_by_action) = match mdp.feature_table() {
            Features::State(values) => (values, false),
            Features::StateAction(values) => (values, true),
        };
        let (n, k) = (mdp.n_states(), mdp.n_features());
        let mut largest = vec![0.0_f64; k];
        for row in values.chunks(k) {
            for (most, phi) in largest.iter_mut().zip(row) {
                *most = most.max(phi.abs());
            }
        }
        let n_rows = if features_by_action { n * mdp.n_actions() } else { n };
        let mut feature_starts = vec![0];
        let mut feature_entries = Vec::new();
        for row in 0..n_rows {
            let phi = mdp.features(row % n, row / n);
            feature_entries.extend(phi.iter().enumerate().filter(|(_, x)| **x != 0.0).map(|(j, x)| (j as u32, *x)));
            feature_starts.push(feature_entries.len() as u32);
        }
        let transitions = Transitions::new(mdp);
        Self { mdp, transitions, feature_starts, feature_entries, features_by_action, largest }
    }

    /// Largest possible size of a value under weights `w`: Σ_j |w_j| max|φ_j| / (1 − γ).
    pub(super) fn scale(&self, w: &[f64]) -> f64 {
        let reward: f64 = w.iter().zip(&self.largest).map(|(w, most)| w.abs() * most).sum();
        reward / (1.0 - self.mdp.gamma())
    }

    /// wᵀφ of every row into `rewards`, or of every state if actions do not matter.
    pub(super) fn rewards(&self, w: &[f64], rewards: &mut Vec<f64>) {
        rewards.clear();
        rewards.extend(self.feature_starts.windows(2).map(|ends| {
            let entries = &self.feature_entries[ends[0] as usize..ends[1] as usize];
            entries.iter().map(|&(j, phi)| w[j as usize] * phi).sum::<f64>()
        }));
    }

    /// Index into [`Tables::rewards`] of a state and action.
    pub(super) fn reward_index(&self, state: usize, action: usize) -> usize {
        if self.features_by_action { action * self.mdp.n_states() + state } else { state }
    }

    /// Q(s, a) = r(s, a) + γ Σ p V(s′) for every row into `q`.
    pub(super) fn backup(&self, rewards: &[f64], values: &[f64], q: &mut [f64]) {
        let n = self.mdp.n_states();
        for (action, q) in q.chunks_exact_mut(n).enumerate() {
            let rewards = if self.features_by_action { &rewards[action * n..][..n] } else { &rewards[..n] };
            self.transitions.backup(action * n, rewards, values, q);
        }
    }
}

impl Transitions {
    fn new(mdp: &Mdp) -> Self {
        let (n, gamma) = (mdp.n_states(), mdp.gamma());
        let n_rows = n * mdp.n_actions();
        let row = |row: usize| mdp.row(row % n, row / n);
        let width = (0..n_rows).map(|r| row(r).0.len()).max().unwrap_or(0);
        if width * n_rows <= PADDING * mdp.n_transitions().max(n_rows) {
            let (mut targets, mut weights) = (vec![0; width * n_rows], vec![0.0; width * n_rows]);
            for r in 0..n_rows {
                let (row_targets, probabilities) = row(r);
                for (slot, (target, p)) in row_targets.iter().zip(probabilities).enumerate() {
                    targets[slot * n_rows + r] = *target;
                    weights[slot * n_rows + r] = gamma * p;
                }
            }
            return Self::Padded { width, targets, weights };
        }
        let (mut starts, mut targets, mut weights) = (vec![0], vec![], vec![]);
        for r in 0..n_rows {
            let (row_targets, probabilities) = row(r);
            targets.extend_from_slice(row_targets);
            weights.extend(probabilities.iter().map(|p| gamma * p));
            starts.push(targets.len() as u32);
        }
        Self::Ragged { starts, targets, weights }
    }

    /// Backs up the rows from `first` on.
    fn backup(&self, first: usize, rewards: &[f64], values: &[f64], q: &mut [f64]) {
        match self {
            Self::Padded { width, targets, weights } => {
                let slots = Slots { first, targets, weights };
                match width {
                    0 => q.copy_from_slice(rewards),
                    1 => slots.backup::<1>(rewards, values, q),
                    2 => slots.backup::<2>(rewards, values, q),
                    3 => slots.backup::<3>(rewards, values, q),
                    4 => slots.backup::<4>(rewards, values, q),
                    width => slots.backup_any(*width, rewards, values, q),
                }
            }
            Self::Ragged { starts, targets, weights } => {
                for (row, (q, reward)) in q.iter_mut().zip(rewards).enumerate() {
                    let range = starts[first + row] as usize..starts[first + row + 1] as usize;
                    let mut sum = *reward;
                    for (target, weight) in targets[range.clone()].iter().zip(&weights[range]) {
                        sum += weight * values[*target as usize];
                    }
                    *q = sum;
                }
            }
        }
    }
}

/// Padded transitions, seen from one row on.
struct Slots<'a> {
    first: usize,
    targets: &'a [u32],
    weights: &'a [f64],
}

impl Slots<'_> {
    fn slot(&self, slot: usize, n_slots: usize, n: usize) -> (&[u32], &[f64]) {
        let start = slot * (self.targets.len() / n_slots) + self.first;
        (&self.targets[start..][..n], &self.weights[start..][..n])
    }

    /// All slots of a row at once, unrolled.
    fn backup<const WIDTH: usize>(&self, rewards: &[f64], values: &[f64], q: &mut [f64]) {
        let n = q.len();
        let slots: [_; WIDTH] = std::array::from_fn(|slot| self.slot(slot, WIDTH, n));
        let rewards = &rewards[..n];
        for row in 0..n {
            let mut sum = rewards[row];
            for (targets, weights) in slots {
                sum += weights[row] * values[targets[row] as usize];
            }
            q[row] = sum;
        }
    }

    /// One slot of all rows after another.
    fn backup_any(&self, width: usize, rewards: &[f64], values: &[f64], q: &mut [f64]) {
        q.copy_from_slice(rewards);
        for slot in 0..width {
            let (targets, weights) = self.slot(slot, width, q.len());
            for ((q, target), weight) in q.iter_mut().zip(targets).zip(weights) {
                *q += weight * values[*target as usize];
            }
        }
    }
}
