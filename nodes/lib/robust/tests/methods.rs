//! Both methods, every λ of a frontier and every way of asking give the same answer.
#![allow(clippy::unwrap_used)]

mod common;

use common::{Shape, close};
use mdp::worlds::GridWorld;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use robust::{Method, MethodChoice, Objective, Outcome, Problem, Settings, Solution, SolverStatus};

const COLUMNS: Settings =
    Settings { method: MethodChoice::ColumnGeneration, tolerance: 1e-8, max_rounds: 5000, max_iterations: 200 };
const DIRECT: Settings = Settings { method: MethodChoice::Direct, ..COLUMNS };

fn medium(seed: u64) -> Shape {
    Shape {
        seed,
        n_states: 90,
        n_actions: 3,
        n_features: 8,
        n_draws: 800,
        gamma: 0.95,
        by_action: seed.is_multiple_of(2),
        terminal_every: if seed.is_multiple_of(3) { 9 } else { 0 },
        spread: 0.6 + 0.4 * (seed % 3) as f64,
    }
}

fn assert_optimal(solution: &Solution, method: Method) {
    assert_eq!((solution.outcome, solution.method), (Outcome::Optimal, method), "{:?}", solution.checks);
    assert!(solution.gap() >= 0.0 && solution.gap() <= 1e-8 * solution.unit);
    assert!(solution.checks.hold());
}

#[test]
fn column_generation_and_the_linear_program_agree() {
    for seed in 20..26 {
        let case = medium(seed).case();
        let k = case.mdp.n_features();
        let mut expert = vec![0.0; k];
        for (e, x) in expert.iter_mut().zip(&case.expert) {
            *e = 2.0 * x;
        }
        for objective in [Objective::Robust, Objective::Regret { expert: &expert }, Objective::Loss] {
            let weights = seed.is_multiple_of(2).then_some(&case.weights[..]);
            let problem = Problem::new(&case.mdp, &case.draws, weights, objective, 2).unwrap();
            let (alpha, lambda) = [(0.95, 0.0), (0.5, 0.3), (0.99, 0.8), (0.9, 0.1)][seed as usize % 4];
            let columns = problem.solve(alpha, lambda, &COLUMNS).unwrap();
            let direct = problem.solve(alpha, lambda, &DIRECT).unwrap();
            assert_optimal(&columns, Method::ColumnGeneration);
            assert_optimal(&direct, Method::Direct);
            close(columns.objective, direct.objective, 1e-6 * columns.unit);
            assert!(columns.objective <= direct.upper_bound && direct.objective <= columns.upper_bound);
        }
    }
}

#[test]
fn the_scale_of_rewards_and_features_does_not_matter() {
    let case = medium(21).case();
    let problem = Problem::new(&case.mdp, &case.draws, None, Objective::Robust, 1).unwrap();
    for settings in [COLUMNS, DIRECT] {
        let plain = problem.solve(0.9, 0.2, &settings).unwrap();
        for scale in [1e-9, 1e12] {
            let draws: Vec<f64> = case.draws.iter().map(|w| scale * w).collect();
            let scaled = Problem::new(&case.mdp, &draws, None, Objective::Robust, 1).unwrap();
            let scaled = scaled.solve(0.9, 0.2, &settings).unwrap();
            assert_eq!(scaled.outcome, Outcome::Optimal);
            close(scaled.objective / scale, plain.objective, 2e-8 * plain.unit);
        }
    }
}

#[test]
fn a_frontier_is_its_points() {
    let lambdas: Vec<f64> = (0..=20).map(|i| f64::from(i) / 20.0).collect();
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let grid = GridWorld { gamma: 0.95, ..GridWorld::random(7, 7, 6, &mut rng) }.mdp().unwrap();
    let draws: Vec<f64> = (0..500 * 6).map(|_| mdp::random::normal(&mut rng)).collect();
    let case = medium(22).case();
    for (mdp, draws) in [(&grid, &draws), (&case.mdp, &case.draws)] {
        let problem = Problem::new(mdp, draws, None, Objective::Robust, 1).unwrap();
        for settings in [COLUMNS, DIRECT, Settings::default()] {
            let frontier = problem.frontier(0.9, &lambdas, &settings).unwrap();
            assert_eq!(frontier.len(), lambdas.len());
            for (solution, &lambda) in frontier.iter().zip(&lambdas) {
                assert_eq!((solution.outcome, solution.lambda), (Outcome::Optimal, lambda));
                let alone = problem.solve(0.9, lambda, &settings).unwrap();
                close(solution.objective, alone.objective, 2e-8 * alone.unit);
            }
            // The more the mean counts, the larger it is and the worse the tail; the optimum is convex in λ.
            for pair in frontier.windows(2) {
                let slack = 1e-5 * pair[0].unit;
                assert!(pair[1].expected_return >= pair[0].expected_return - slack);
                assert!(pair[1].conditional_value_at_risk <= pair[0].conditional_value_at_risk + slack);
            }
            for three in frontier.windows(3) {
                let chord = 0.5 * (three[0].objective + three[2].objective);
                assert!(three[1].objective <= chord + 1e-7 * three[1].unit);
            }
            // Points come in the order asked for, and may be asked for twice.
            let again = problem.frontier(0.9, &[0.5, 0.0, 1.0, 0.5], &settings).unwrap();
            for (solution, index) in again.iter().zip([10, 0, 20, 10]) {
                close(solution.objective, frontier[index].objective, 2e-8 * solution.unit);
            }
        }
    }
}

#[test]
fn answers_are_the_same_bits_every_time() {
    let case = medium(23).case();
    let ask = |threads| {
        let problem = Problem::new(&case.mdp, &case.draws, None, Objective::Loss, threads).unwrap();
        [COLUMNS, DIRECT].map(|settings| problem.frontier(0.95, &[0.3, 0.0], &settings).unwrap())
    };
    let once = ask(1);
    assert_eq!(once, ask(1));
    assert_eq!(once, ask(3));
}

#[test]
fn a_frontier_has_the_same_bits_on_any_number_of_threads_and_every_point_is_told_once() {
    let case = medium(23).case();
    // Out of order, and one of them twice.
    let lambdas: Vec<f64> = (0..21).map(|i| f64::from(i * 8 % 21) / 20.0).chain([0.4]).collect();
    let ask = |threads, settings: &Settings| {
        let problem = Problem::new(&case.mdp, &case.draws, None, Objective::Robust, threads).unwrap();
        let mut told = vec![];
        let mut watch = |solution: &Solution| told.push(solution.lambda);
        let frontier = problem.frontier_watched(0.95, &lambdas, settings, &mut watch).unwrap();
        told.sort_by(f64::total_cmp);
        (frontier, told)
    };
    let mut ascending = lambdas.clone();
    ascending.sort_by(f64::total_cmp);
    for settings in [COLUMNS, DIRECT] {
        let (once, told) = ask(1, &settings);
        assert_eq!(told, ascending);
        assert!(once.iter().zip(&lambdas).all(|(solution, lambda)| solution.lambda == *lambda));
        for threads in [2, 3, 8] {
            assert_eq!(ask(threads, &settings), (once.clone(), ascending.clone()), "{threads} threads");
        }
    }
}

#[test]
fn limits_end_in_an_outcome_with_bounds_that_hold() {
    let case = medium(25).case();
    let problem = Problem::new(&case.mdp, &case.draws, None, Objective::Robust, 1).unwrap();
    let best = problem.solve(0.95, 0.0, &COLUMNS).unwrap();
    for settings in [Settings { max_rounds: 3, ..COLUMNS }, Settings { max_iterations: 4, ..DIRECT }] {
        let cut = problem.solve(0.95, 0.0, &settings).unwrap();
        assert_eq!((cut.outcome, cut.status), (Outcome::IterationLimit, SolverStatus::IterationLimit));
        assert!(cut.objective < best.objective && best.objective <= cut.upper_bound);
        assert!(cut.gap() > 1e-6 * cut.unit && cut.checks.hold());
        cut.policy.check(&case.mdp).unwrap();
    }
    // Where column generation is cut off, the linear program is tried, and says so.
    let settings = Settings { max_rounds: 3, method: MethodChoice::Automatic, ..COLUMNS };
    assert_optimal(&problem.solve(0.95, 0.0, &settings).unwrap(), Method::Direct);
}

#[test]
fn a_long_horizon_is_answered_or_refused_but_never_wrong() {
    for gamma in [0.999, 0.9999, 1.0 - 1e-6] {
        let case = Shape { gamma, ..medium(24) }.case();
        let problem = Problem::new(&case.mdp, &case.draws, None, Objective::Robust, 1).unwrap();
        for settings in [COLUMNS, DIRECT] {
            let solution = problem.solve(0.9, 0.1, &settings).unwrap();
            let exact = problem.risk(&solution.policy, 0.9, 0.1).unwrap().objective;
            close(exact, solution.objective, 1e-8 * solution.unit);
            match solution.outcome {
                Outcome::Optimal => assert!(solution.gap() <= 1e-8 * solution.unit),
                outcome => assert_eq!(outcome, Outcome::Inaccurate),
            }
        }
        assert_eq!(problem.solve(0.9, 0.1, &Settings::default()).unwrap().outcome, Outcome::Optimal);
    }
}

#[test]
fn draws_without_consequence_leave_nothing_to_gain() {
    let case = medium(22).case();
    let nothing = vec![0.0; case.draws.len()];
    for objective in [Objective::Robust, Objective::Loss, Objective::Regret { expert: &case.expert }] {
        let problem = Problem::new(&case.mdp, &nothing, None, objective, 1).unwrap();
        for settings in [COLUMNS, DIRECT] {
            let solution = problem.solve(0.95, 0.5, &settings).unwrap();
            assert_eq!((solution.outcome, solution.objective, solution.gap()), (Outcome::Optimal, 0.0, 0.0));
        }
    }
}

#[test]
fn ties_do_not_stop_the_search() {
    // Whole-number draws on a deterministic grid: most draws are equal and most policies tie.
    let mut numbers = common::Numbers(8);
    for seed in 0..12 {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let grid = GridWorld { slip: 0.0, terminals: vec![3], ..GridWorld::random(4, 5, 4, &mut rng) };
        let grid = grid.mdp().unwrap();
        let draws: Vec<f64> = (0..300 * 4).map(|_| (3.0 * numbers.uniform()).floor() - 1.0).collect();
        let problem = Problem::new(&grid, &draws, None, Objective::Robust, 1).unwrap();
        assert!(problem.n_draws() <= 81);
        for alpha in [0.3, 0.9, 0.999] {
            let columns = problem.solve(alpha, 0.1, &COLUMNS).unwrap();
            let direct = problem.solve(alpha, 0.1, &DIRECT).unwrap();
            assert_optimal(&columns, Method::ColumnGeneration);
            close(columns.objective, direct.objective, 1e-7 * columns.unit);
        }
    }
}
