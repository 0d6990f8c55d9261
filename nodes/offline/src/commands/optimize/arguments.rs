//! The flags of `apprentice optimize`.

use std::path::PathBuf;

use clap::{Parser, ValueEnum};
use robust::MethodChoice;

/// Finds the policy that does well under an uncertain reward: it maximises (1 - lambda) CVaR + lambda mean over the draws of a
/// posterior (BROIL, dissertation chapter 7).
///
/// The CVaR at level alpha is the mean over the worst share 1 - alpha of the draws. What is counted there is the return
/// (robust), the return above that of an expert (regret), or the return less that of the best policy for the same reward
/// (evd). With lambda = 1 only the mean counts, with lambda = 0 only the bad end; --frontier shows what each costs. The policy
/// may be stochastic: where nobody knows what is good, a mixture hedges.
///
/// Answers `optimal`, when the gap to a bound that no policy exceeds is within the tolerance, or what is missing:
/// `inaccurate`, `iteration_limit`, ... with the gap that is left. The answer is a policy file for apprentice evaluate.
///
/// Exit code 0: answered; 2: bad input, named with file and line; 1: a file could not be written.
#[derive(Debug, Parser)]
#[command(
    name = "apprentice optimize",
    after_help = "\
Examples:
  apprentice optimize --mdp config/examples/kitchen.json --draws config/examples/draws.csv --lambda 0.2
  apprentice optimize --mdp config/examples/corridor.json --draws config/examples/corridor-draws.csv \\
    --objective regret --demonstrations config/examples/corridor-demonstration.csv --frontier --baselines \\
    --svg frontier.svg --policy-svg policies.svg

CSV: comma-separated, '.' decimals, header line optional. nodes/offline/README.md describes every file."
)]
pub struct Arguments {
    /// Decision process
    #[arg(long, value_name = "JSON")]
    pub(super) mdp: PathBuf,
    /// Draws of the weights, as apprentice infer --out writes them: a row per draw, chains one after another
    #[arg(long, value_name = "CSV")]
    pub(super) draws: PathBuf,
    /// Posterior weights of the draws, one a line, not negative; divided by their sum [default: all equal]
    #[arg(long, value_name = "CSV")]
    pub(super) weights: Option<PathBuf>,

    /// Level: the worst share 1 - ALPHA of the draws is the bad end, from 0 to below 1
    #[arg(long, value_name = "ALPHA", default_value_t = 0.95, allow_negative_numbers = true, help_heading = "Aim")]
    pub(super) alpha: f64,
    /// Weight of the mean against the bad end: 0 is averse to risk, 1 does not care
    #[arg(long, value_name = "LAMBDA", default_value_t = 0.5, allow_negative_numbers = true, help_heading = "Aim")]
    pub(super) lambda: f64,
    /// What the bad end is of
    #[arg(long, value_name = "WHAT", default_value = "robust", help_heading = "Aim")]
    pub(super) objective: ObjectiveName,
    /// Feature counts of the expert, one row, discounted
    #[arg(long, value_name = "CSV", conflicts_with = "demonstrations", help_heading = "Aim")]
    pub(super) expert_features: Option<PathBuf>,
    /// The same from demonstrations: state,action[,verdict[,confidence[,trajectory]]] in the order of time, the last state
    /// included
    #[arg(long, value_name = "CSV", help_heading = "Aim")]
    pub(super) demonstrations: Option<PathBuf>,

    /// The best policies for --points values of lambda from 0 to 1 as well
    #[arg(long, help_heading = "More to compare")]
    pub(super) frontier: bool,
    /// Points of the frontier, at least 2
    #[arg(long, value_name = "N", default_value_t = 21, requires = "frontier", help_heading = "More to compare")]
    pub(super) points: usize,
    /// Baselines as well: the best policies for the mean and the most probable reward, hill climbing on the VaR, and with an
    /// expert LPAL and Maximum Entropy IRL
    #[arg(long, help_heading = "More to compare")]
    pub(super) baselines: bool,
    /// The most probable reward for --baselines: a CSV row, or the answer of apprentice infer --json (*.json)
    #[arg(long, value_name = "FILE", requires = "baselines", help_heading = "More to compare")]
    pub(super) map: Option<PathBuf>,
    /// Rationality of the expert for Maximum Entropy IRL, whose weights have length 1
    #[arg(long, value_name = "BETA", default_value_t = 10.0, requires = "baselines", help_heading = "More to compare")]
    pub(super) maxent_beta: f64,
    /// Other draws, to judge the policy by: those it was chosen by flatter it
    #[arg(long, value_name = "CSV", help_heading = "More to compare")]
    pub(super) out_of_sample: Option<PathBuf>,
    /// Chains in --out-of-sample [default: 4]
    #[arg(long, value_name = "M", requires = "out_of_sample", help_heading = "More to compare")]
    pub(super) chains: Option<usize>,
    /// Confidence of the interval around the CVaR on --out-of-sample
    #[arg(
        long,
        value_name = "P",
        default_value_t = 0.95,
        requires = "out_of_sample",
        help_heading = "More to compare"
    )]
    pub(super) confidence: f64,

    /// How to look: auto is columns, and lp where that does not end and the process is small
    #[arg(long, value_name = "HOW", default_value = "auto", help_heading = "Search")]
    pub(super) method: MethodName,
    /// Largest gap that counts as none, as a share of the typical size of returns
    #[arg(long, value_name = "X", default_value_t = 1e-8, help_heading = "Search")]
    pub(super) tolerance: f64,
    /// Most rounds of planning for one lambda
    #[arg(long, value_name = "N", default_value_t = 5000, help_heading = "Search")]
    pub(super) max_rounds: usize,
    /// Most iterations of the linear-programming solver each time
    #[arg(long, value_name = "N", default_value_t = 200, help_heading = "Search")]
    pub(super) max_iterations: usize,

    /// File for a picture of the frontier: CVaR against mean, with the baselines
    #[arg(long, value_name = "SVG", requires = "frontier", help_heading = "Answer")]
    pub(super) svg: Option<PathBuf>,
    /// File for a picture of the policy, and of the baselines, on a grid: --mdp needs a shape, and actions up, down, left,
    /// right, stay. The area of an arrow is the probability of its action
    #[arg(long, value_name = "SVG", help_heading = "Answer")]
    pub(super) policy_svg: Option<PathBuf>,
    /// What the cells of --policy-svg are shaded by
    #[arg(long, value_name = "WHAT", default_value = "occupancy", requires = "policy_svg", help_heading = "Answer")]
    pub(super) shade: ShadeName,
    /// Threads for evd; the answer does not depend on it [default: as many as the machine has]
    #[arg(long, value_name = "N", help_heading = "Answer")]
    pub(super) threads: Option<usize>,
    /// Seed of the interval around the CVaR on --out-of-sample; nothing else is random
    #[arg(long, value_name = "SEED", default_value_t = 0, help_heading = "Answer")]
    pub(super) seed: u64,
    /// One JSON object on standard output
    #[arg(long, help_heading = "Answer")]
    pub(super) json: bool,
}

/// What a policy is judged by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum ObjectiveName {
    /// The return
    Robust,
    /// The return above that of the expert, of --expert-features or --demonstrations
    Regret,
    /// The return less that of the best policy for the same reward: minus the loss, or expected value difference
    Evd,
}

/// How the policy is looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum MethodName {
    /// Columns, then lp
    Auto,
    /// One linear program over all visits
    Lp,
    /// Column generation: planning for one reward at a time
    Columns,
}

impl MethodName {
    pub(super) fn choice(self) -> MethodChoice {
        match self {
            Self::Auto => MethodChoice::Automatic,
            Self::Lp => MethodChoice::Direct,
            Self::Columns => MethodChoice::ColumnGeneration,
        }
    }
}

/// What a cell is shaded by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum ShadeName {
    /// How often the policy is there
    Occupancy,
    /// The largest feature of the cell
    Feature,
}
