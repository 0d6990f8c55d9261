//! Seconds for a posterior in a world of 10,000 states.

use likelihood::actions::{ActionLikelihood, Choice};
use mdp::random::{index, l1_sphere};
use mdp::worlds::GridWorld;
use mdp::{Policy, Solver, rollout};
use posterior::{EvidenceKind, Model, Prior, Rationality, Run, Term, TermLikelihood, draw};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use serde::Serialize;

use crate::clock::{timed, timed_by_the_wall};
use crate::error::PeersError;

const SIDE: usize = 100;
const N_FEATURES: usize = 8;
const BETA: f64 = 100.0;
const N_DEMONSTRATIONS: usize = 5;
const LENGTH: usize = 100;
const THREADS: usize = 2;
/// Draws over four chains: worth more than the 400 that a bound needs of four chains.
const N_DRAWS: usize = 2000;
/// Iterations of warm-up per chain.
const WARMUP: usize = 100;

/// How long it took and what came out.
#[derive(Debug, Clone, Serialize)]
pub struct Measured {
    n_states: usize,
    n_draws: usize,
    threads: usize,
    /// On the wall.
    seconds: f64,
    cpu_seconds: f64,
    ess_bulk_min: f64,
    rhat_max: f64,
    /// CPU milliseconds of one exact solution from nothing.
    solve_ms: f64,
}

/// Measures and prints.
pub fn measure(seed: u64) -> Result<Measured, PeersError> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let cells: Vec<usize> = (0..SIDE * SIDE).map(|_| index(N_FEATURES, &mut rng)).collect();
    let starts: Vec<usize> = (0..N_DEMONSTRATIONS).map(|_| index(SIDE * SIDE, &mut rng)).collect();
    let world = GridWorld { slip: 0.15, starts: starts.clone(), ..GridWorld::one_hot(SIDE, SIDE, &cells, N_FEATURES) };
    let mdp = world.mdp()?;
    let w = l1_sphere(N_FEATURES, &mut rng);
    let (policy, solve_seconds) = timed(|| Solver::new(&mdp).solve(&w).policy().to_vec());
    let policy = Policy::Deterministic(policy);
    let mut choices = Vec::new();
    for start in starts {
        let steps = rollout(&mdp, &policy, start, LENGTH, &mut rng)?;
        choices.extend(steps.into_iter().map(|(state, action)| Choice::taken(state, action)));
    }
    let term = Term {
        kind: EvidenceKind::Actions,
        rationality: Rationality::Fixed(BETA),
        likelihood: TermLikelihood::Actions(ActionLikelihood::new(&mdp, choices)?),
    };
    let model = Model { n_features: N_FEATURES, prior: Prior::L1Sphere, nonnegative_return: None, terms: vec![term] };
    let run = Run { n_draws: N_DRAWS, warmup: WARMUP, threads: THREADS, ..Run::default() };
    let ((draws, cpu_seconds), seconds) = timed_by_the_wall(|| timed(|| draw(&model, &run, seed, &[0; 32])));
    let draws = draws?;
    let measured = Measured {
        n_states: mdp.n_states(),
        n_draws: draws.n(),
        threads: THREADS,
        seconds,
        cpu_seconds,
        ess_bulk_min: draws.ess_bulk_min,
        rhat_max: draws.rhat_max,
        solve_ms: 1e3 * solve_seconds,
    };
    println!(
        "{} states, {} demonstrations of {LENGTH} steps: {} draws in {:.1} s on {THREADS} threads ({:.1} CPU-s); smallest ESS {:.0}, R-hat {:.4}; one exact solution from nothing {:.1} ms",
        measured.n_states,
        N_DEMONSTRATIONS,
        measured.n_draws,
        seconds,
        cpu_seconds,
        measured.ess_bulk_min,
        measured.rhat_max,
        measured.solve_ms
    );
    Ok(measured)
}
