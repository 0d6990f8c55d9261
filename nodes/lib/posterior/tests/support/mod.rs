//! Random worlds, evidence drawn from the likelihood in use, and the statistics of simulation-based calibration.
#![allow(dead_code)]

use diagnostics::normal_quantile;
use likelihood::actions::{Choice, ChoiceVerdict};
use likelihood::preferences::{Answer, AnswerModel, Verdict};
use mdp::Mdp;
use mdp::worlds::GridWorld;
use posterior::{Draws, Run};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Draws of one world that are ranked.
pub const KEPT: usize = 63;
/// Bins of ranks.
pub const BINS: usize = 16;
/// The 99.9 % quantile of χ² with 15 degrees of freedom.
pub const LIMIT: f64 = 37.7;

/// The generator of one world of one test.
pub fn generator(test: u64, world: u64) -> ChaCha8Rng {
    let mut generator = ChaCha8Rng::seed_from_u64(test);
    generator.set_stream(world);
    generator
}

pub fn uniform(generator: &mut ChaCha8Rng) -> f64 {
    ((generator.next_u64() >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
}

pub fn normal(generator: &mut ChaCha8Rng) -> f64 {
    normal_quantile(uniform(generator))
}

/// Uniform on the L1 sphere, by another route than the sampler's.
pub fn l1_sphere(k: usize, generator: &mut ChaCha8Rng) -> Vec<f64> {
    let x: Vec<f64> =
        (0..k).map(|_| -uniform(generator).ln() * if generator.next_u32() & 1 == 0 { 1.0 } else { -1.0 }).collect();
    let norm: f64 = x.iter().map(|x| x.abs()).sum();
    x.iter().map(|x| x / norm).collect()
}

/// Uniform on the L2 sphere.
pub fn l2_sphere(k: usize, generator: &mut ChaCha8Rng) -> Vec<f64> {
    let x: Vec<f64> = (0..k).map(|_| normal(generator)).collect();
    let norm = x.iter().map(|x| x * x).sum::<f64>().sqrt();
    x.iter().map(|x| x / norm).collect()
}

/// A grid of 4 × 4 cells with one of `k` features each.
pub fn grid(k: usize, gamma: f64, generator: &mut ChaCha8Rng) -> Mdp {
    let starts = vec![0, 5, 10, 15];
    let world = GridWorld { slip: 0.1, gamma, starts, ..GridWorld::random(4, 4, k, generator) };
    world.mdp().expect("a good world")
}

/// π_θ of one state at θ = `beta` w, from the optimal values.
pub fn boltzmann(mdp: &Mdp, w: &[f64], beta: f64, state: usize) -> Vec<f64> {
    let mut solver = mdp::Solver::new(mdp);
    let optimum = solver.solve(w);
    let q: Vec<f64> = (0..mdp.n_actions()).map(|a| beta * optimum.q(state, a)).collect();
    let top = q.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let p: Vec<f64> = q.iter().map(|q| (q - top).exp()).collect();
    let sum: f64 = p.iter().sum();
    p.iter().map(|p| p / sum).collect()
}

pub fn categorical(p: &[f64], generator: &mut ChaCha8Rng) -> usize {
    let mut left = uniform(generator) * p.iter().sum::<f64>();
    p.iter()
        .position(|p| {
            left -= p;
            left < 0.0
        })
        .unwrap_or(p.len() - 1)
}

/// `n` actions taken by the Boltzmann-rational person in random states, of the first `n_states`.
pub fn taken(
    mdp: &Mdp,
    w: &[f64],
    beta: f64,
    (n, n_states): (usize, usize),
    generator: &mut ChaCha8Rng,
) -> Vec<Choice> {
    let one = |_| {
        let state = (uniform(generator) * n_states as f64) as usize;
        Choice::taken(state, categorical(&boltzmann(mdp, w, beta, state), generator))
    };
    (0..n).map(one).collect()
}

/// `n` random state–action pairs, each called good with the probability that the person would take it, else bad.
pub fn judged(mdp: &Mdp, w: &[f64], beta: f64, n: usize, generator: &mut ChaCha8Rng) -> Vec<Choice> {
    let one = |_| {
        let state = (uniform(generator) * mdp.n_states() as f64) as usize;
        let action = (uniform(generator) * mdp.n_actions() as f64) as usize;
        let good = uniform(generator) < boltzmann(mdp, w, beta, state)[action];
        let verdict = if good { ChoiceVerdict::Good } else { ChoiceVerdict::Bad };
        Choice { state, action, verdict, factor: 1.0 }
    };
    (0..n).map(one).collect()
}

/// Features of `m` items, and `n` answers about random pairs of them.
pub fn answers(
    w: &[f64],
    beta: f64,
    model: &AnswerModel,
    (m, n): (usize, usize),
    generator: &mut ChaCha8Rng,
) -> (Vec<f64>, Vec<Answer>) {
    let k = w.len();
    let features: Vec<f64> = (0..m * k).map(|_| normal(generator)).collect();
    let value = |item: usize| w.iter().zip(&features[item * k..]).map(|(w, x)| w * x).sum::<f64>();
    let one = |_| {
        let a = (uniform(generator) * m as f64) as usize;
        let b = (a + 1 + (uniform(generator) * (m - 1) as f64) as usize) % m;
        let factor = if uniform(generator) < 0.5 { 1.0 } else { 0.5 };
        let p = model.probabilities(factor * beta * (value(b) - value(a)));
        let (less, more, verdict) = match categorical(&[p.more, p.less, p.equal, p.cant_tell], generator) {
            0 => (a, b, Verdict::Strict),
            1 => (b, a, Verdict::Strict),
            2 => (a, b, Verdict::Equal),
            _ => (a, b, Verdict::CantTell),
        };
        Answer { less, more, factor, verdict }
    };
    let answers = (0..n).map(one).collect();
    (features, answers)
}

/// A short run whose every fourth draw is ranked.
pub fn short_run() -> Run {
    Run { n_draws: 4 * KEPT, n_chains: 4, warmup: 150, threads: 1 }
}

/// Rank of the truth among every fourth of `draws`, 0 to [`KEPT`].
pub fn rank(draws: impl Iterator<Item = f64>, truth: f64) -> usize {
    draws.step_by(4).filter(|x| *x < truth).count()
}

/// Ranks of w_0, |w_0| and the log-likelihood.
pub fn ranks(draws: &Draws, w: &[f64], log_likelihood: f64) -> [usize; 3] {
    let first = draws.feature(0);
    [
        rank(first.iter().copied(), w[0]),
        rank(first.iter().map(|w| w.abs()), w[0].abs()),
        rank(draws.log_likelihood.iter().copied(), log_likelihood),
    ]
}

/// χ² of the ranks of each statistic over many worlds, run on two threads.
pub fn chi_squared<const N: usize>(worlds: u64, one: impl Fn(u64) -> [usize; N] + Sync) -> [f64; N] {
    let ranks: Vec<[usize; N]> = in_parallel(worlds, one);
    std::array::from_fn(|statistic| {
        let mut bins = [0.0; BINS];
        for ranks in &ranks {
            bins[ranks[statistic] * BINS / (KEPT + 1)] += 1.0;
        }
        let expected = worlds as f64 / BINS as f64;
        bins.iter().map(|n: &f64| (n - expected) * (n - expected) / expected).sum()
    })
}

/// One result per world, in the order of the worlds of each half.
pub fn in_parallel<T: Send>(worlds: u64, one: impl Fn(u64) -> T + Sync) -> Vec<T> {
    std::thread::scope(|scope| {
        let one = &one;
        let halves = [0, 1].map(|half| {
            scope.spawn(move || (0..worlds).filter(|world| world % 2 == half).map(one).collect::<Vec<_>>())
        });
        halves.into_iter().flat_map(|half| half.join().expect("no panic")).collect()
    })
}
