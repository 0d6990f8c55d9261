//! Figure G.1: sparse rewards, where a random question seldom meets what matters.

use crate::chapter8::compare::{Plan, Situation, compare, curve_table, queries_table};
use crate::chapter8::{ACTIVE_VAR, Ask, BETA, Curve, OURS, RANDOM, Teacher, curve_panel, first_demonstration, purpose};
use crate::harness::plot::{Content, Picture};
use crate::harness::{Claim, Options, Outcome, ReproductionError, generator};
use inquiry::tabular::Over;
use mdp::random::index;
use mdp::worlds::sparse;
use posterior::Run;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// Environments.
const REPLICATES: usize = 100;
/// Questions of a lesson, at most.
const QUESTIONS: usize = 100;
/// A worst loss that is low.
const LOW: f64 = 0.01;
/// Resamples of the ratio.
const RESAMPLES: usize = 4000;

/// Makes the figure.
///
/// # Errors
/// Too few replicates.
pub fn run(options: &Options) -> Result<Outcome, ReproductionError> {
    let n = options.count(REPLICATES)?;
    let plan = Plan {
        ask: Ask::Actions,
        n_questions: QUESTIONS,
        run: Run { n_draws: 200, n_chains: 4, warmup: 100, threads: 1 },
        beta: BETA,
        enough: LOW,
        over: Over::WorstStart,
    };
    let lessons = compare(options, n, &plan, &[RANDOM, ACTIVE_VAR, OURS], |i| situation(options.seed, i))?;
    let curves = lessons.curves(|step| step.worst);
    let needed: Vec<Vec<f64>> = curves.iter().map(needed).collect();
    let [by_var, by_ours] = [1, 2].map(|i| ratio(&needed[0], &needed[i], options.seed));
    let said = |(found, [low, high]): (f64, [f64; 2])| format!("{found:.2} times [{low:.2}, {high:.2}]");
    let claims = vec![
        Claim::matched(
            "Random needs at least 3.45 times the questions of ActiveVaR until the worst loss is below .01",
            by_var.0 >= 3.45,
            said(by_var),
        ),
        Claim::beaten("Random needs at least 5 times the questions of ours", by_ours.1[0] >= 5.0, said(by_ours)),
        Claim::smaller(
            "ours needs fewer questions than ActiveVaR",
            &needed[2].iter().zip(&needed[1]).map(|(a, b)| a - b).collect::<Vec<_>>(),
            options.seed,
        ),
    ];
    Ok(Outcome {
        name: "fig-g.1",
        title: "Action queries in sparse 8 × 8 grids, every cell a start",
        replicates: n,
        seed: options.seed,
        notes: vec![
            "The dissertation shows one such grid and no numbers of it; these are drawn at random: one cell worth reaching, five walls, no other features.".into(),
            "Lessons end once the true worst loss over all cells is below .01; the first demonstration is two steps.".into(),
        ],
        tables: vec![
            queries_table("Questions until the true worst loss of the MAP policy is for the first time", &curves, &[0.1, LOW]),
            curve_table("True worst loss after so many answers", &curves, &[0, 1, 2, 3, 5, 10, 20, 50, QUESTIONS]),
            lessons.seconds_table(&[]),
        ],
        claims,
        picture: Picture {
            title: "Figure G.1: worst loss over action queries in sparse grids".into(),
            content: Content::Panels(vec![curve_panel(&curves, "questions answered", "worst loss over all cells")]),
        },
        data: lessons.data(),
    })
}

/// The grid of a replicate with every cell a start, and two steps of a demonstration.
fn situation(seed: u64, replicate: usize) -> Result<Situation, ReproductionError> {
    let (mut grid, weights) = sparse::random(&mut generator(seed, replicate, purpose::WORLD));
    grid.starts = (0..sparse::SIDE * sparse::SIDE).collect();
    let mdp = grid.mdp()?;
    let teacher = Teacher::new(&mdp, &weights);
    let shown = first_demonstration(&mdp, &teacher, &mut generator(seed, replicate, purpose::SHOWN));
    Ok(Situation { mdp, weights, shown })
}

/// Questions until the worst loss is low; one more than there were where it never is.
fn needed(curve: &Curve) -> Vec<f64> {
    let of = |lesson: &Vec<f64>| lesson.iter().position(|worst| *worst < LOW).unwrap_or(lesson.len()) as f64;
    curve.lessons.iter().map(of).collect()
}

/// Ratio of the means and its 95 % bootstrap interval over environments.
fn ratio(above: &[f64], below: &[f64], seed: u64) -> (f64, [f64; 2]) {
    let of = |pick: &dyn Fn(usize) -> usize| {
        let sum = |values: &[f64]| (0..values.len()).map(|i| values[pick(i)]).fold(0.0, |sum, y| sum + y);
        sum(above) / sum(below)
    };
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut ratios: Vec<f64> = (0..RESAMPLES)
        .map(|_| {
            let picked: Vec<usize> = above.iter().map(|_| index(above.len(), &mut rng)).collect();
            of(&|i| picked[i])
        })
        .collect();
    ratios.sort_unstable_by(f64::total_cmp);
    let at = |share: f64| ratios[(share * (RESAMPLES - 1) as f64).round() as usize];
    (of(&|i| i), [at(0.025), at(0.975)])
}

#[cfg(test)]
mod tests {
    use super::{ACTIVE_VAR, Ask, BETA, OURS, Over, Plan, RANDOM, Run, compare, ratio, situation};
    use crate::chapter8::Step;
    use crate::harness::Options;

    fn options(threads: usize) -> Options {
        Options { replicates: None, seed: 3, threads, json: None, svg: None }
    }

    #[test]
    fn lessons_are_the_same_for_any_number_of_threads() {
        let plan = Plan {
            ask: Ask::Critiques(4),
            n_questions: 3,
            run: Run { n_draws: 80, n_chains: 4, warmup: 100, threads: 1 },
            beta: BETA,
            enough: 0.0,
            over: Over::Starts,
        };
        let of = |threads| {
            let methods = [RANDOM, ACTIVE_VAR, OURS];
            let lessons = compare(&options(threads), 2, &plan, &methods, |i| situation(3, i)).expect("lessons");
            let number = |step: &Step| step.loss + step.asked.map_or(0.0, |state| state as f64);
            lessons.curves(number).into_iter().map(|curve| curve.lessons).collect::<Vec<_>>()
        };
        let one = of(1);
        assert_eq!(one, of(2));
        assert!(one.iter().all(|lessons| lessons.iter().all(|lesson| lesson.len() == 4)));
    }

    #[test]
    fn ratios_are_those_of_the_means() {
        let (found, [low, high]) = ratio(&[10.0, 20.0, 30.0], &[2.0, 4.0, 6.0], 1);
        assert!((found - 5.0).abs() < 1e-12 && (low - 5.0).abs() < 1e-12 && (high - 5.0).abs() < 1e-12);
        assert!(ratio(&[1.0, 9.0], &[1.0, 1.0], 1).1[0] < 2.0);
    }
}
