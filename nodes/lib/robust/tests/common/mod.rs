//! Problems that the tests share, and that a program in another language can make again.
#![allow(dead_code, reason = "each test uses a part")]

use mdp::{Features, Mdp, MdpParts};

/// SplitMix64.
pub struct Numbers(pub u64);

impl Numbers {
    /// Uniform in [0, 1).
    pub fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        (z >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform in [−1, 1).
    pub fn signed(&mut self) -> f64 {
        2.0 * self.uniform() - 1.0
    }

    /// `n` positive numbers that sum to 1.
    pub fn distribution(&mut self, n: usize) -> Vec<f64> {
        let shares: Vec<f64> = (0..n).map(|_| self.uniform()).collect();
        let total: f64 = shares.iter().sum();
        shares.iter().map(|share| share / total).collect()
    }
}

/// What a random problem looks like.
#[derive(Debug, Clone, Copy)]
pub struct Shape {
    pub seed: u64,
    pub n_states: usize,
    pub n_actions: usize,
    pub n_features: usize,
    pub n_draws: usize,
    pub gamma: f64,
    /// Features of states and actions, not of states alone.
    pub by_action: bool,
    /// Every so many states one is terminal; none for 0.
    pub terminal_every: usize,
    /// How far draws are from each other.
    pub spread: f64,
}

/// A process, draws of its reward weights and weights of the draws.
pub struct Case {
    pub mdp: Mdp,
    pub draws: Vec<f64>,
    pub weights: Vec<f64>,
    /// Feature counts of somebody.
    pub expert: Vec<f64>,
}

impl Shape {
    pub fn case(&self) -> Case {
        let Self { n_states, n_actions, n_features, n_draws, .. } = *self;
        let mut numbers = Numbers(self.seed);
        let mut transitions = vec![];
        for state in 0..n_states {
            if self.terminal_every > 0 && state % self.terminal_every == self.terminal_every - 1 {
                continue;
            }
            for action in 0..n_actions {
                let mut targets: Vec<usize> = (0..3).map(|_| (numbers.uniform() * n_states as f64) as usize).collect();
                targets.sort_unstable();
                targets.dedup();
                let shares = numbers.distribution(targets.len());
                transitions.extend(targets.into_iter().zip(shares).map(|(target, p)| (state, action, target, p)));
            }
        }
        let rows = if self.by_action { n_states * n_actions } else { n_states };
        let values: Vec<f64> = (0..rows * n_features).map(|_| numbers.signed()).collect();
        let initial = numbers.distribution(n_states);
        let center: Vec<f64> = (0..n_features).map(|_| numbers.signed()).collect();
        let draws = (0..n_draws).flat_map(|_| center.clone()).map(|x| x + self.spread * numbers.signed()).collect();
        let weights = numbers.distribution(n_draws);
        let mdp = Mdp::new(MdpParts {
            gamma: self.gamma,
            n_states,
            n_actions,
            n_features,
            initial,
            transitions,
            features: if self.by_action { Features::StateAction(values) } else { Features::State(values) },
            actions: vec![],
            shape: None,
        })
        .expect("a valid process");
        let expert = (0..n_features).map(|j| 0.3 * (j + 1) as f64 * if j % 2 == 0 { 1.0 } else { -1.0 }).collect();
        Case { mdp, draws, weights, expert }
    }
}

/// The five problems that were solved with another program too.
pub fn shape(seed: u64) -> Shape {
    let (sizes, gamma, by_action, terminal_every, spread) = match seed {
        1 => ([12, 2, 3, 60], 0.9, false, 0, 0.5),
        2 => ([20, 3, 4, 100], 0.95, true, 0, 1.0),
        3 => ([30, 3, 5, 150], 0.9, false, 7, 1.0),
        4 => ([25, 4, 6, 120], 0.99, true, 5, 2.0),
        _ => ([40, 2, 8, 200], 0.8, false, 0, 0.3),
    };
    let [n_states, n_actions, n_features, n_draws] = sizes;
    Shape { seed, n_states, n_actions, n_features, n_draws, gamma, by_action, terminal_every, spread }
}

/// Fails unless `got` is within `tolerance` of `want`.
#[track_caller]
pub fn close(got: f64, want: f64, tolerance: f64) {
    assert!((got - want).abs() <= tolerance, "{got}, but {want} is expected within {tolerance:e}");
}
