//! Figure 7.3: machines that are repaired the more, the less risk is taken.

use crate::chapter7::{POINTS, lambdas, lower_mean, purpose, quantiles};
use crate::harness::plot::{Content, Picture};
use crate::harness::{
    Claim, Estimate, Options, Outcome, ReproductionError, TextTable, extent, generator, replicates, to_value,
};
use mdp::Mdp;
use mdp::worlds::machine_replacement::{N_STATES, REPAIR, SCALES, WAIT, draws, world};
use picture::{Chart, Line, Mark, Stroke, charts};
use robust::{Bootstrap, Objective, Problem, Settings, Solution, out_of_sample, performance};
use serde::Serialize;

/// Level of the tail and draws of the dissertation; draws that the fast solver allows; draws that policies are judged by.
const ALPHA: f64 = 0.99;
const N_DRAWS: usize = 2000;
const MANY_DRAWS: usize = extent(20_000, 3000);
const N_FRESH: usize = extent(200_000, 10_000);
/// E(return) of never repairing: every age is visited 1 / (4 (1 − γ)) = 5 times and costs scale / 2 on average.
const NEVER_REPAIR: f64 = -5.0 * 0.5 * (20.0 + 40.0 + 80.0 + 190.0);
/// λ that are told of.
const SHOWN: [usize; 5] = [0, 5, 10, 15, 20];

/// What one sample of rewards leads to, by λ.
#[derive(Debug, Clone, Serialize)]
struct Sample {
    /// Probability of a repair by λ and age.
    repairs: Vec<Vec<f64>>,
    /// E(return) and CVaR by the draws that the policy was chosen by.
    chosen_by: Vec<[f64; 2]>,
    /// The same by fresh draws.
    fresh: Vec<[f64; 2]>,
    /// Fresh CVaR at λ = 0 of the policy chosen by ten times as many draws.
    many: f64,
    /// Largest |E + u · mean cost|, and largest difference of CVaR from the mean of the worst 20.
    errors: [f64; 2],
    /// Whether all 21 solutions are optimal.
    optimal: bool,
}

/// Makes the figure.
pub fn run(options: &Options) -> Result<Outcome, ReproductionError> {
    let n = options.count(100)?;
    let mdp = world(N_STATES)?;
    let fresh = draws(N_FRESH, &mut generator(options.seed, usize::MAX, purpose::FRESH));
    let samples = replicates("fig-7.3", n, options.threads, |replicate| one(&mdp, &fresh, options.seed, replicate))?;
    Ok(Outcome {
        name: "fig-7.3",
        title: "machine replacement: policies over λ, frontier, return distributions",
        replicates: n,
        seed: options.seed,
        notes: vec![
            "a replicate is a sample of 2,000 rewards from the prior, as in the dissertation, which has one; α = .99"
                .into(),
            "fresh: the policy judged by 200,000 other rewards".into(),
            "ages are numbered from 1 here, as in figure 7.2".into(),
        ],
        tables: vec![repairs_table(&samples), frontier_table(&mdp, &fresh, &samples, options.seed)?],
        claims: claims(&samples, options.seed),
        picture: picture(&mdp, &samples, &fresh)?,
        data: to_value(&samples),
    })
}

fn one(mdp: &Mdp, fresh: &[f64], seed: u64, replicate: usize) -> Result<Sample, ReproductionError> {
    let mut rng = generator(seed, replicate, purpose::DRAWS);
    let rewards = draws(N_DRAWS, &mut rng);
    let settings = Settings::default();
    let problem = Problem::new(mdp, &rewards, None, Objective::Robust, 1)?;
    let frontier = problem.frontier(ALPHA, &lambdas(), &settings)?;
    let many = draws(MANY_DRAWS, &mut rng);
    let many = Problem::new(mdp, &many, None, Objective::Robust, 1)?.solve(ALPHA, 0.0, &settings)?;
    let returns = |counts: &[f64], draws: &[f64]| performance(mdp, draws, Objective::Robust, counts, 1);
    let (mut fresh_values, mut errors) = (vec![], [0.0_f64; 2]);
    for solution in &frontier {
        let values = returns(&solution.feature_counts, fresh)?;
        let mean = crate::harness::sum_in_order(&values) / N_FRESH as f64;
        fresh_values.push([mean, lower_mean(&values, ALPHA)]);
        // Feature a·S + s is the reward of action a at age s.
        let weight = |state: usize, action: usize| problem.mean_weights()[action * N_STATES + state];
        let cost: f64 = (0..N_STATES)
            .flat_map(|state| {
                [WAIT, REPAIR].map(|action| solution.occupancy[2 * state + action] * weight(state, action))
            })
            .sum();
        errors[0] = errors[0].max((solution.expected_return - cost).abs());
        let worst = lower_mean(&returns(&solution.feature_counts, &rewards)?, ALPHA);
        errors[1] = errors[1].max((solution.conditional_value_at_risk - worst).abs());
    }
    Ok(Sample {
        repairs: frontier.iter().map(repairs).collect(),
        chosen_by: frontier.iter().map(|s| [s.expected_return, s.conditional_value_at_risk]).collect(),
        fresh: fresh_values,
        many: lower_mean(&returns(&many.feature_counts, fresh)?, ALPHA),
        errors,
        optimal: frontier.iter().all(|s| s.outcome.name() == "optimal"),
    })
}

fn repairs(solution: &Solution) -> Vec<f64> {
    (0..N_STATES).map(|age| solution.policy.probability(2, age, REPAIR)).collect()
}

fn estimate(samples: &[Sample], of: impl Fn(&Sample) -> f64) -> Estimate {
    Estimate::of(&samples.iter().map(of).collect::<Vec<f64>>())
}

fn repairs_table(samples: &[Sample]) -> TextTable {
    let mut table = TextTable::new(
        "Probability of a repair by age, mean ± s.e. over samples",
        &["λ", "age 1", "age 2", "age 3", "age 4"],
    );
    for i in SHOWN {
        let cells = (0..N_STATES).map(|age| estimate(samples, |sample| sample.repairs[i][age]).text());
        table.row(format!("{}", lambdas()[i]), cells);
    }
    table
}

fn frontier_table(mdp: &Mdp, fresh: &[f64], samples: &[Sample], seed: u64) -> Result<TextTable, ReproductionError> {
    let mut table = TextTable::new(
        "Mean and CVaR of the return, mean ± s.e. over samples",
        &[
            "λ",
            "mean, chosen by",
            "mean, fresh",
            "CVaR, chosen by",
            "CVaR, fresh",
            "95 % of the first sample's fresh CVaR",
        ],
    );
    for i in SHOWN {
        // The counts of the first sample's policy, from its repairs.
        let policy: Vec<f64> = samples[0].repairs[i].iter().flat_map(|p| [1.0 - p, *p]).collect();
        let counts = mdp::feature_counts(mdp, &mdp::Policy::Stochastic(policy))?;
        let values = performance(mdp, fresh, Objective::Robust, &counts, 1)?;
        let interval = out_of_sample(&values, 0, None, ALPHA, &Bootstrap { seed, ..Bootstrap::default() })?.interval;
        table.row(
            format!("{}", lambdas()[i]),
            [
                estimate(samples, |s| s.chosen_by[i][0]).text(),
                estimate(samples, |s| s.fresh[i][0]).text(),
                estimate(samples, |s| s.chosen_by[i][1]).text(),
                estimate(samples, |s| s.fresh[i][1]).text(),
                format!("[{:.0}, {:.0}]", interval[0], interval[1]),
            ],
        );
    }
    Ok(table)
}

fn claims(samples: &[Sample], seed: u64) -> Vec<Claim> {
    let n = samples.len();
    let last = POINTS - 1;
    let count = |holds: &dyn Fn(&Sample) -> bool| samples.iter().filter(|sample| holds(sample)).count();
    let all = |claim: &str, holds: &dyn Fn(&Sample) -> bool| {
        let held = count(holds);
        Claim::matched(claim, held == n, format!("in {held} of {n} samples"))
    };
    let between = |p: f64| p > 1e-6 && p < 1.0 - 1e-6;
    let pattern = |sample: &Sample| {
        let p = &sample.repairs[0];
        p[0] <= 1e-6 && between(p[1]) && between(p[2]) && p[3] >= 1.0 - 1e-6
    };
    let seen = count(&pattern);
    let never = count(&|sample| sample.repairs[last].iter().all(|p| *p == 0.0));
    let neutral = estimate(samples, |sample| sample.chosen_by[last][0]);
    let worst = |i: usize| samples.iter().map(|sample| sample.errors[i]).fold(0.0, f64::max);
    let gain = estimate(samples, |s| s.fresh[0][1] - s.fresh[last][1]);
    let price = estimate(samples, |s| s.fresh[last][0] - s.fresh[0][0]);
    let monotone = |sample: &Sample| {
        sample.chosen_by.windows(2).all(|pair| pair[1][0] >= pair[0][0] - 1e-4 && pair[1][1] <= pair[0][1] + 1e-4)
    };
    let flattery = estimate(samples, |s| s.chosen_by[0][1] - s.fresh[0][1]);
    let differences: Vec<f64> = samples.iter().map(|sample| sample.fresh[0][1] - sample.many).collect();
    let mean_scale: f64 = SCALES.iter().sum::<f64>();
    vec![
        all("every solution is proved optimal", &|sample| sample.optimal),
        Claim::matched(
            "λ = 1 never repairs (in most samples)",
            2 * never > n,
            format!("in {never} of {n} samples: in the others the mean cost of age 4 is above that of a repair"),
        ),
        Claim::matched("E = −u · mean cost, exactly", worst(0) < 1e-8, format!("largest difference {:.0e}", worst(0))),
        Claim::matched(
            format!("λ = 1: E is that of never repairing, −5 · ½ · {mean_scale} = {NEVER_REPAIR}"),
            neutral.agrees_with(NEVER_REPAIR, 0.0),
            neutral.text(),
        ),
        Claim::matched(
            "CVaR at .99 of 2,000 equal draws is the mean of the worst 20, exactly",
            worst(1) < 1e-8,
            format!("largest difference {:.0e}", worst(1)),
        ),
        Claim::matched(
            "λ = 0 repairs with probability at ages 2 and 3 and always at age 4 (in most samples)",
            2 * seen > n,
            format!(
                "in {seen} of {n} samples; mean {}",
                (0..N_STATES).map(|age| estimate(samples, |s| s.repairs[0][age]).text()).collect::<Vec<_>>().join(", ")
            ),
        ),
        all("the mean rises and the CVaR falls with λ", &monotone),
        Claim::matched(
            "λ = 0 instead of 1: a small loss of the mean for a large gain of CVaR, by fresh draws",
            gain.mean > price.mean && gain.mean > 3.0 * gain.standard_error,
            format!("CVaR {:+.0} for a mean of {:+.0}", gain.mean, -price.mean),
        ),
        Claim::beaten(
            "the CVaR by the draws that chose the policy flatters it, and ours says by how much",
            flattery.mean > 2.0 * flattery.standard_error,
            format!("by {} of {:.0}", flattery.text(), estimate(samples, |s| s.fresh[0][1]).mean),
        ),
        Claim::smaller("2,000 draws: fresh CVaR below that of a policy chosen by 20,000", &differences, seed),
    ]
}

fn picture(mdp: &Mdp, samples: &[Sample], fresh: &[f64]) -> Result<Picture, ReproductionError> {
    let sample = &samples[0];
    let xs = lambdas();
    let line = |label: &str, colour, stroke, points| Line { label: label.to_owned(), colour, stroke, points };
    let ages = (0..N_STATES).map(|age| {
        let points = xs.iter().zip(&sample.repairs).map(|(x, repairs)| (*x, repairs[age])).collect();
        line(&format!("age {}", age + 1), age, Stroke::Dotted, points)
    });
    let frontier = |of: &[[f64; 2]]| of.iter().map(|[mean, cvar]| (*cvar, *mean)).collect::<Vec<_>>();
    let (chosen, judged) = (frontier(&sample.chosen_by), frontier(&sample.fresh));
    let marks =
        vec![Mark { text: "λ = 0".into(), at: chosen[0] }, Mark { text: "λ = 1".into(), at: chosen[POINTS - 1] }];
    let mut distributions = vec![];
    for (colour, i) in [(1, POINTS - 1), (2, 10), (0, 0)] {
        let policy: Vec<f64> = sample.repairs[i].iter().flat_map(|p| [1.0 - p, *p]).collect();
        let counts = mdp::feature_counts(mdp, &mdp::Policy::Stochastic(policy))?;
        let values = performance(mdp, &fresh[..N_FRESH / 10 * 2 * N_STATES], Objective::Robust, &counts, 1)?;
        distributions.push(line(&format!("λ = {}", xs[i]), colour, Stroke::Solid, quantiles(&values)));
    }
    let drawn = charts(
        "Figure 7.3: machine replacement, the first sample (α = .99)",
        &[
            Chart { x: "λ".into(), y: "probability of a repair".into(), lines: ages.collect(), marks: vec![] },
            Chart {
                x: "CVaR of the return".into(),
                y: "mean return".into(),
                lines: vec![
                    line("frontier, draws that chose it", 5, Stroke::Dotted, chosen),
                    line("frontier, fresh draws", 6, Stroke::Dotted, judged),
                ],
                marks,
            },
            Chart { x: "share of rewards".into(), y: "return, sorted".into(), lines: distributions, marks: vec![] },
        ],
    )?;
    Ok(Picture { title: "Figure 7.3".into(), content: Content::Drawn(drawn) })
}
