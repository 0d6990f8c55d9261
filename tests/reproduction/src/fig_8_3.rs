//! Figure 8.3: which trajectories to have criticised, and how long it takes to decide.

use crate::chapter8::compare::{Plan, compare, curve_table, differences, fifth_fewer, match_order, queries_table};
use crate::chapter8::{ACTIVE_VAR, ARC, Ask, BETA, OURS, RANDOM, arc_by_chains, curve_panel};
use crate::fig_8_2::{sampling, situation};
use crate::harness::plot::{Content, Picture};
use crate::harness::{Claim, Options, Outcome, ReproductionError, bootstrap_interval};
use inquiry::tabular::Over;
use serde_json::json;

/// The dissertation does not say over how many worlds it averages.
const REPLICATES: usize = 50;
/// Questions of a lesson.
const QUESTIONS: usize = 12;
/// Steps of a trajectory.
const LENGTH: usize = 8;
/// Losses to get to.
const LEVELS: [f64; 4] = [0.5, 0.2, 0.1, 0.05];
/// Seconds a query may take.
const FAST_S: f64 = 0.1;
/// A loss at most this share above ARC's is of the same level.
const SAME: f64 = 0.1;

/// Makes the figure.
///
/// # Errors
/// Too few replicates.
pub fn run(options: &Options) -> Result<Outcome, ReproductionError> {
    let n = options.count(REPLICATES)?;
    let plan = Plan {
        ask: Ask::Critiques(LENGTH),
        n_questions: QUESTIONS,
        run: sampling(),
        beta: BETA,
        enough: 0.0,
        over: Over::Starts,
    };
    let lessons = compare(options, n, &plan, &[RANDOM, ACTIVE_VAR, ARC, OURS], |i| situation(options.seed, i))?;
    let by_chains = arc_by_chains(&situation(options.seed, 0)?, LENGTH, options.seed)?;
    let curves = lessons.curves(|step| step.loss);
    let of_mean = lessons.curves(|step| step.loss_of_mean);
    let [random, risk, arc, ours] = [0, 1, 2, 3].map(|i| &curves[i]);
    let at = [0, 1, 2, 3, 5, 7, 10, QUESTIONS];
    let seconds = lessons.seconds();
    let gaps = differences(ours, arc, QUESTIONS);
    let [low, high] = bootstrap_interval(&gaps, options.seed);
    let of_arc = crate::chapter8::compare::mean_after(arc, QUESTIONS);
    let level = of_arc.iter().fold(0.0, |sum, y| sum + y) / of_arc.len() as f64;
    let gap = gaps.iter().fold(0.0, |sum, y| sum + y) / gaps.len() as f64;
    let slow = by_chains.seconds / seconds[1].1.mean;
    let claims = vec![
        match_order(arc, risk, QUESTIONS, options.seed),
        match_order(risk, random, QUESTIONS, options.seed),
        Claim::matched(
            "ARC as published takes at least 1,000 times as long as ActiveVaR",
            slow >= 1000.0,
            format!("{slow:.0} times, the draws of ActiveVaR solved anew"),
        ),
        Claim::beaten(
            format!("ours loses at most {:.0} % more than ARC, mean over {QUESTIONS} questions", 100.0 * SAME),
            high <= SAME * level,
            format!("difference {gap:+.4} [{low:+.4}, {high:+.4}] of {level:.4}"),
        ),
        Claim::beaten(
            format!("ours takes at most {FAST_S} s of processor time a query, draws solved anew"),
            seconds[3].1.mean <= FAST_S,
            format!("{:.4} s", seconds[3].1.mean),
        ),
        Claim::smaller(
            format!("ours loses less than ActiveVaR, mean over {QUESTIONS} questions"),
            &differences(ours, risk, QUESTIONS),
            options.seed,
        ),
        fifth_fewer(ours, risk, 10, options.seed),
    ];
    Ok(Outcome {
        name: "fig-8.3",
        title: "Critique queries in 8 × 8 grids with 48 features",
        replicates: n,
        seed: options.seed,
        notes: vec![
            "The losses of the figure are printed without numbers. Worlds, first demonstration, γ = .95 and β = 100 are those of the author's program.".into(),
            "All methods learn alike, choose among the 64 trajectories of the MAP policy of 8 steps, and are judged by their MAP policy. ARC is the exact information about the reward over all labellings, by re-weighting.".into(),
            format!(
                "ARC as published runs a chain for every label of every step of 8 trajectories: {} chains of {} steps take {:.0} s for the first query of the first world, reckoned from an eighth of them, without the divergences between chains.",
                by_chains.n_chains, by_chains.steps, by_chains.seconds
            ),
            "A person's label is taken as the likelihood of Cui and Niekum has it: good with probability π(a|s), bad with 1 − π(a|s).".into(),
        ],
        tables: vec![
            curve_table("True loss V* − V^π of the MAP policy, mean over states, after so many critiques", &curves, &at),
            lessons.seconds_table(&[("Random", "0.0015"), ("ActiveVaR", "0.0101"), ("ARC", "865.6993")]),
            queries_table("Critiques until the loss of the MAP policy is for the first time", &curves, &LEVELS),
            curve_table("Loss of the policy that is optimal for the mean reward", &of_mean, &at),
        ],
        claims,
        picture: Picture {
            title: "Figure 8.3: loss over critique queries".into(),
            content: Content::Panels(vec![
                curve_panel(&curves, "critiques answered", "loss of the MAP policy"),
                curve_panel(&of_mean, "critiques answered", "loss of the policy for the mean reward"),
            ]),
        },
        data: json!({ "lessons": lessons.data(), "arc_by_chains_s": by_chains.seconds }),
    })
}
