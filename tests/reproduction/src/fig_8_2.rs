//! Figure 8.2: which actions to ask for in grids with 48 features.

use crate::chapter8::compare::{
    Plan, Situation, compare, curve_table, differences, fifth_fewer, match_order, queries_table,
};
use crate::chapter8::{
    ACTIVE_VAR, AS, Ask, BETA, OURS, RANDOM, Teacher, curve_panel, dense_world, first_demonstration, purpose,
};
use crate::harness::plot::{Content, Picture};
use crate::harness::{Claim, Options, Outcome, ReproductionError, extent, generator};
use inquiry::tabular::Over;
use posterior::Run;

/// The dissertation does not say over how many worlds it averages.
const REPLICATES: usize = 50;
/// Questions of a lesson.
const QUESTIONS: usize = 15;
/// Losses to get to.
const LEVELS: [f64; 4] = [0.5, 0.2, 0.1, 0.05];

/// How the robot learns in figures 8.2 and 8.3.
pub fn sampling() -> Run {
    Run { n_draws: extent(200, 40), n_chains: 4, warmup: 100, threads: 1 }
}

/// The world of a replicate, in both figures.
///
/// # Errors
/// Never for these sizes.
pub fn situation(seed: u64, replicate: usize) -> Result<Situation, ReproductionError> {
    let (mdp, weights) = dense_world(&mut generator(seed, replicate, purpose::WORLD))?;
    let teacher = Teacher::new(&mdp, &weights);
    let shown = first_demonstration(&mdp, &teacher, &mut generator(seed, replicate, purpose::SHOWN));
    Ok(Situation { mdp, weights, shown })
}

/// Makes the figure.
///
/// # Errors
/// Too few replicates.
pub fn run(options: &Options) -> Result<Outcome, ReproductionError> {
    let n = options.count(REPLICATES)?;
    let plan = Plan {
        ask: Ask::Actions,
        n_questions: QUESTIONS,
        run: sampling(),
        beta: BETA,
        enough: 0.0,
        over: Over::Starts,
    };
    let lessons = compare(options, n, &plan, &[RANDOM, AS, ACTIVE_VAR, OURS], |i| situation(options.seed, i))?;
    let curves = lessons.curves(|step| step.loss);
    let of_mean = lessons.curves(|step| step.loss_of_mean);
    let [random, entropy, risk, ours] = [0, 1, 2, 3].map(|i| &curves[i]);
    let at = [0, 1, 2, 3, 5, 7, 10, 12, QUESTIONS];
    let claims = vec![
        match_order(risk, random, QUESTIONS, options.seed),
        match_order(risk, entropy, QUESTIONS, options.seed),
        Claim::smaller(
            format!("ours loses less than ActiveVaR, mean over {QUESTIONS} questions"),
            &differences(ours, risk, QUESTIONS),
            options.seed,
        ),
        fifth_fewer(ours, risk, 10, options.seed),
    ];
    Ok(Outcome {
        name: "fig-8.2",
        title: "Action queries in 8 × 8 grids with 48 features",
        replicates: n,
        seed: options.seed,
        notes: vec![
            "The dissertation prints the figure without numbers. Worlds, first demonstration, γ = .95 and β = 100 are those of its author's program.".into(),
            "All methods learn alike (Hamiltonian chains of one seed) and are judged by their MAP policy; only the question differs.".into(),
        ],
        tables: vec![
            curve_table("True loss V* − V^π of the MAP policy, mean over states, after so many answers", &curves, &at),
            curve_table("The same of the policy that is optimal for the mean reward", &of_mean, &at),
            queries_table("Questions until the loss of the MAP policy is for the first time", &curves, &LEVELS),
            lessons.seconds_table(&[]),
        ],
        claims,
        picture: Picture {
            title: "Figure 8.2: loss over action queries".into(),
            content: Content::Panels(vec![
                curve_panel(&curves, "questions answered", "loss of the MAP policy"),
                curve_panel(&of_mean, "questions answered", "loss of the policy for the mean reward"),
            ]),
        },
        data: lessons.data(),
    })
}
