//! Robust policies from an uncertain reward: ours and SciPy's HiGHS on the same linear programs, and what a frontier costs.

use mdp::random::{l1_sphere, normal};
use mdp::worlds::GridWorld;
use mdp::worlds::garnet::Garnet;
use mdp::{Mdp, MdpError};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use robust::{Objective, Outcome, Problem, Settings, performance};
use serde::Serialize;

use crate::clock::{timed, timed_by_the_wall};
use crate::error::PeersError;
use crate::highs::{self, Form, Report};
use crate::memory;

const N_FEATURES: usize = 8;
const ALPHA: f64 = 0.95;
/// Points of a frontier.
const POINTS: usize = 21;
/// Seconds that HiGHS may take for one program.
const LIMIT: f64 = 300.0;
/// Largest relative difference between two optima that are the same.
const SAME: f64 = 1e-6;
const MIB: f64 = 1024.0 * 1024.0;

/// What a world is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
enum World {
    /// Cells side by side, moves that slip.
    Grid,
    /// Transitions without any structure.
    Garnet,
}

/// A problem to be solved.
#[derive(Debug, Clone, Copy)]
struct Case {
    world: World,
    n_states: usize,
    n_draws: usize,
    /// Whether the tail is of the return or of minus the loss.
    evd: bool,
    lambda: f64,
    /// Forms that HiGHS solves.
    forms: &'static [Form],
    /// Times ours is timed; the median counts.
    repeats: usize,
    /// CPU seconds that ours may take.
    target: f64,
    frontier: bool,
}

const BOTH: &[Form] = &[Form::Dense, Form::Factors];
const FACTORS: &[Form] = &[Form::Factors];

const fn case(world: World, n_states: usize, n_draws: usize, lambda: f64, forms: &'static [Form]) -> Case {
    let (repeats, target) = if n_states >= 10_000 { (1, 30.0) } else { (9, 0.5) };
    Case { world, n_states, n_draws, evd: false, lambda, forms, repeats, target, frontier: lambda == 0.0 }
}

const CASES: [Case; 10] = [
    case(World::Grid, 100, 2000, 0.0, BOTH),
    case(World::Grid, 100, 2000, 0.5, BOTH),
    case(World::Garnet, 100, 2000, 0.0, BOTH),
    case(World::Grid, 400, 2000, 0.0, FACTORS),
    case(World::Garnet, 400, 2000, 0.0, FACTORS),
    Case { evd: true, repeats: 3, ..case(World::Grid, 100, 2000, 0.0, BOTH) },
    Case { evd: true, repeats: 1, target: 30.0, ..case(World::Grid, 400, 2000, 0.0, FACTORS) },
    case(World::Grid, 10_000, 10_000, 0.0, FACTORS),
    case(World::Garnet, 10_000, 10_000, 0.0, FACTORS),
    // No other program is asked: what is compared is the cost of the many optimal values.
    Case { evd: true, target: f64::INFINITY, ..case(World::Grid, 10_000, 1000, 0.0, &[]) },
];

/// One problem, measured.
#[derive(Debug, Clone, Serialize)]
pub struct Compared {
    world: World,
    n_states: usize,
    n_draws: usize,
    n_features: usize,
    objective: &'static str,
    alpha: f64,
    lambda: f64,
    /// CPU seconds of ours, from the draws to the checked policy: median.
    seconds: f64,
    /// The part of them that is not the search: the problem itself, under evd with the optimal value of each draw.
    problem_seconds: f64,
    optimum: f64,
    /// Share of the unit that a better policy may still bring, as ours proves it.
    gap: f64,
    outcome: &'static str,
    method: &'static str,
    rounds: usize,
    target: f64,
    /// Most memory while ours was at work, MiB above what this program had before.
    memory_mib: f64,
    /// Seconds of a frontier of 21 λ, the problem included: of the CPU, and by the wall on two threads.
    frontier_seconds: Option<[f64; 2]>,
    /// By the wall over λ = 0 alone; CPU seconds over those of λ = 0, and over the mean of the 21 when each is solved alone.
    frontier_ratio: Option<[f64; 3]>,
    highs: Vec<Against>,
}

/// HiGHS on the same problem.
#[derive(Debug, Clone, Serialize)]
struct Against {
    report: Report,
    /// CPU seconds of its faster method that ended with an optimum.
    seconds: Option<f64>,
    /// Those over ours.
    times: Option<f64>,
    /// Relative difference of the optima.
    difference: Option<f64>,
}

/// Compares on every problem and prints a table.
pub fn compare(seed: u64, with_highs: bool) -> Result<Vec<Compared>, PeersError> {
    let mut all = vec![];
    for case in &CASES {
        let compared = case.compare(seed, with_highs)?;
        print(&compared);
        all.push(compared);
    }
    let optima: Vec<f64> = all.iter().flat_map(|c| &c.highs).filter_map(|h| h.difference).collect();
    let worst = optima.iter().copied().fold(0.0, f64::max);
    let verdict = if worst <= SAME { "the same" } else { "NOT the same" };
    println!("\n{} optima compared, largest relative difference {worst:.1e}: {verdict} to {SAME:.0e}", optima.len());
    Ok(all)
}

impl Case {
    fn mdp(&self, rng: &mut ChaCha8Rng) -> Result<Mdp, MdpError> {
        match self.world {
            World::Grid => {
                let side = libm::sqrt(self.n_states as f64).round() as usize;
                GridWorld { gamma: 0.95, slip: 0.1, ..GridWorld::random(side, side, N_FEATURES, rng) }.mdp()
            }
            World::Garnet => {
                let (n_states, n_actions, branching) = (self.n_states, 4, 5);
                let garnet = Garnet {
                    n_states,
                    n_actions,
                    n_features: N_FEATURES,
                    branching,
                    gamma: 0.95,
                    terminal: 0.0,
                    by_action: false,
                };
                garnet.random(rng)
            }
        }
    }

    fn compare(&self, seed: u64, with_highs: bool) -> Result<Compared, PeersError> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mdp = self.mdp(&mut rng)?;
        // A posterior about as wide as the weights are large.
        let center = l1_sphere(N_FEATURES, &mut rng);
        let spread = 1.0 / N_FEATURES as f64;
        let draws: Vec<f64> =
            (0..self.n_draws).flat_map(|_| center.clone()).map(|w| w + spread * normal(&mut rng)).collect();
        let objective = if self.evd { Objective::Loss } else { Objective::Robust };
        let settings = Settings::default();
        let make = || Problem::new(&mdp, &draws, None, objective, 1);

        let before = memory::start();
        let mut times = vec![];
        let mut found = None;
        for _ in 0..self.repeats {
            let (problem, making) = timed(make);
            let (solution, solving) = timed(|| problem?.solve(ALPHA, self.lambda, &settings));
            times.push((making + solving, making));
            found = Some(solution?);
        }
        let memory_mib = memory::peak_since(before) / MIB;
        let solution = found.ok_or(PeersError::Seconds { got: 0.0 })?;
        times.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (seconds, problem_seconds) = times[times.len() / 2];

        let (mut frontier_seconds, mut frontier_ratio) = (None, None);
        if self.frontier {
            let on_two = Problem::new(&mdp, &draws, None, objective, 2)?;
            let (seconds, ratio) = self.frontier(&on_two, problem_seconds, &settings)?;
            frontier_seconds = Some(seconds);
            frontier_ratio = Some(ratio);
        }
        let mut against = vec![];
        if with_highs && !self.forms.is_empty() {
            // b of the draws: what ψ of a policy without any features falls short of 0.
            let offsets: Vec<f64> = performance(&mdp, &draws, objective, &[0.0; N_FEATURES], 1)?;
            let offsets: Vec<f64> = offsets.iter().map(|value| -value).collect();
            let data = highs::Data { mdp: &mdp, draws: &draws, offsets: &offsets, alpha: ALPHA, lambda: self.lambda };
            for &form in self.forms {
                let report = highs::run(&data, form, LIMIT)?;
                let best = report.best();
                against.push(Against {
                    seconds: best.map(|run| run.cpu_seconds),
                    times: best.map(|run| run.cpu_seconds / seconds),
                    difference: best.and_then(|run| run.objective).map(|optimum| relative(solution.objective, optimum)),
                    report,
                });
            }
        }
        Ok(Compared {
            world: self.world,
            n_states: self.n_states,
            n_draws: self.n_draws,
            n_features: N_FEATURES,
            objective: objective.name(),
            alpha: ALPHA,
            lambda: self.lambda,
            seconds,
            problem_seconds,
            optimum: solution.objective,
            gap: solution.gap() / solution.unit,
            outcome: solution.outcome.name(),
            method: solution.method.name(),
            rounds: solution.rounds,
            target: self.target,
            memory_mib,
            frontier_seconds,
            frontier_ratio,
            highs: against,
        })
    }

    /// Seconds of a frontier with its problem, of the CPU and by the wall; and the ratios that are told of it.
    fn frontier(
        &self,
        problem: &Problem<'_>,
        making: f64,
        settings: &Settings,
    ) -> Result<([f64; 2], [f64; 3]), PeersError> {
        let lambdas: Vec<f64> = (0..POINTS).map(|i| i as f64 / (POINTS - 1) as f64).collect();
        let mut alone = [0.0; POINTS];
        let mut first_by_wall = 0.0;
        let mut together = [0.0; 2];
        let share = 1.0 / self.repeats as f64;
        for _ in 0..self.repeats {
            for (i, (sum, &lambda)) in alone.iter_mut().zip(&lambdas).enumerate() {
                let ((solution, seconds), by_wall) =
                    timed_by_the_wall(|| timed(|| problem.solve(ALPHA, lambda, settings)));
                solution?;
                *sum += share * seconds;
                first_by_wall += if i == 0 { share * by_wall } else { 0.0 };
            }
            let ((frontier, seconds), by_wall) =
                timed_by_the_wall(|| timed(|| problem.frontier(ALPHA, &lambdas, settings)));
            if let Some(point) = frontier?.iter().find(|point| point.outcome != Outcome::Optimal) {
                println!("λ = {}: {}", point.lambda, point.outcome.name());
            }
            together[0] += share * seconds;
            together[1] += share * by_wall;
        }
        let [cpu, wall] = together.map(|seconds| seconds + making);
        let mean = alone.iter().sum::<f64>() / POINTS as f64 + making;
        Ok(([cpu, wall], [wall / (first_by_wall + making), cpu / (alone[0] + making), cpu / mean]))
    }
}

fn relative(ours: f64, theirs: f64) -> f64 {
    (ours - theirs).abs() / theirs.abs().max(1e-9)
}

fn print(compared: &Compared) {
    let Compared { world, n_states, n_draws, objective, lambda, .. } = compared;
    println!("\n{world:?}, S = {n_states}, N = {n_draws}, k = {N_FEATURES}, {objective}, α = {ALPHA}, λ = {lambda}");
    println!(
        "  ours             {:>10.4} CPU-s (problem {:.4}), {} by {} in {} rounds, gap {:.0e}, {:.0} MiB; optimum {:.9}",
        compared.seconds,
        compared.problem_seconds,
        compared.outcome,
        compared.method,
        compared.rounds,
        compared.gap,
        compared.memory_mib,
        compared.optimum
    );
    if let (Some([cpu, wall]), Some([by_wall, first, mean])) = (compared.frontier_seconds, compared.frontier_ratio) {
        println!(
            "  frontier of {POINTS}   {wall:>10.4} s on two threads, {by_wall:.1} times λ = 0 alone; {cpu:.4} CPU-s, {first:.1} times \
             λ = 0 alone, {mean:.1} times the mean λ alone"
        );
    }
    for against in &compared.highs {
        for run in &against.report.runs {
            let end = run.objective.map_or_else(|| run.message.clone(), |optimum| format!("optimum {optimum:.9}"));
            println!(
                "  {:<9} {:<7} {:>9.3} CPU-s, {:.0} times ours, {:.0} MiB; {end}",
                run.method,
                against.report.form.name(),
                run.cpu_seconds,
                run.cpu_seconds / compared.seconds,
                against.report.peak_mib
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Case, World, case, relative};

    #[test]
    fn a_small_problem_is_solved_and_its_frontier_timed() {
        let small = Case { repeats: 1, ..case(World::Grid, 25, 100, 0.0, &[]) };
        let compared = small.compare(3, true).expect("a solution");
        assert_eq!(compared.outcome, "optimal");
        assert!(compared.gap <= 1e-8 && compared.seconds > 0.0 && compared.problem_seconds <= compared.seconds);
        assert!(compared.frontier_ratio.is_some_and(|ratios| ratios.iter().all(|ratio| *ratio > 0.0)));
        let json = serde_json::to_value(&compared).expect("JSON");
        assert_eq!(json["objective"], "robust");
        // The same problem again has the same optimum.
        let again = small.compare(3, true).expect("a solution");
        assert!(relative(again.optimum, compared.optimum) == 0.0);
    }
}
