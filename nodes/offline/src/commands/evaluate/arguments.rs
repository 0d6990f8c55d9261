//! The flags of `apprentice evaluate`.

use std::path::PathBuf;

use clap::Parser;

use crate::judgement::LevelArguments;

/// Judges policies under the draws of a reward posterior: expected feature counts, losses, and high-confidence bounds on loss
/// and return.
///
/// The loss of a policy under a reward is what it falls short of the best policy (equation 4.4); it needs --mdp. Bounds on
/// the return need feature counts alone. All bounds of one kind hold together, whatever the number of policies: they share
/// delta. Policies are ranked by what is certain of them; one whose mean is high and whose bound is low is warned of.
///
/// Exit code 0: answered, also where there is no bound; 2: bad input, named with file and line; 1: a file could not be
/// written.
#[derive(Debug, Parser)]
#[command(
    name = "apprentice evaluate",
    after_help = "\
Examples:
  apprentice evaluate --mdp config/examples/kitchen.json --draws config/examples/draws.csv \\
    --policy config/examples/around.json config/examples/along.json config/examples/wander.json
  apprentice evaluate --draws config/examples/draws.csv --feature-counts config/examples/feature-counts.csv \\
    --trajectories config/examples/rollouts.csv --json

CSV: comma-separated, '.' decimals, header line optional. nodes/offline/README.md describes every file."
)]
pub struct Arguments {
    /// Draws of the weights, as apprentice infer --out writes them: a row per draw, chains one after another
    #[arg(long, value_name = "CSV")]
    pub(super) draws: PathBuf,
    /// Chains in --draws [default: 4]
    #[arg(long, value_name = "M")]
    pub(super) chains: Option<usize>,
    /// Decision process
    #[arg(long, value_name = "JSON")]
    pub(super) mdp: Option<PathBuf>,

    /// Policies of --mdp: {"policy": [a, ...]}, an action for each state, or rows of probabilities
    #[arg(long, value_name = "JSON", num_args = 1.., requires = "mdp", help_heading = "Policies: any of these, one or more")]
    pub(super) policy: Vec<PathBuf>,
    /// Expected feature counts, a policy for each row
    #[arg(long, value_name = "CSV", num_args = 1.., help_heading = "Policies: any of these, one or more")]
    pub(super) feature_counts: Vec<PathBuf>,
    /// Features of rollouts, a policy for each file and a rollout for each row; their mean is judged
    #[arg(long, value_name = "CSV", num_args = 1.., help_heading = "Policies: any of these, one or more")]
    pub(super) trajectories: Vec<PathBuf>,

    /// Feature counts of the expert, one row, for the worst-case feature count bound
    #[arg(long, value_name = "CSV", conflicts_with = "demonstrations", help_heading = "What is known of the expert")]
    pub(super) expert_features: Option<PathBuf>,
    /// The same from demonstrations: state,action[,verdict[,confidence[,trajectory]]] in the order of time
    #[arg(long, value_name = "CSV", requires = "mdp", help_heading = "What is known of the expert")]
    pub(super) demonstrations: Option<PathBuf>,
    /// Demonstrations behind the expert's feature counts, for the Hoeffding bound [default: those of --demonstrations]
    #[arg(long, value_name = "N", requires = "mdp", help_heading = "What is known of the expert")]
    pub(super) n_demonstrations: Option<u64>,

    #[command(flatten)]
    pub(super) levels: LevelArguments,
    /// Largest loss that there can be, for the CVaR [default: found where all draws lie on an L1 or L2 sphere]
    #[arg(long, value_name = "X", help_heading = "Claim")]
    pub(super) worst_loss: Option<f64>,
    /// Smallest return that there can be, for the CVaR [default: as for --worst-loss]
    #[arg(long, value_name = "X", allow_negative_numbers = true, help_heading = "Claim")]
    pub(super) worst_return: Option<f64>,
    /// Least loss of the uniform random policy that normalised losses are divided by [default: a hundredth of its mean]
    #[arg(long, value_name = "X", requires = "mdp", help_heading = "Claim")]
    pub(super) floor: Option<f64>,

    /// File for the losses, a row per draw and a column per policy
    #[arg(long, value_name = "CSV", requires = "mdp", help_heading = "Answer")]
    pub(super) losses: Option<PathBuf>,
    /// Threads; the answer does not depend on it [default: as many as the machine has]
    #[arg(long, value_name = "N", help_heading = "Answer")]
    pub(super) threads: Option<usize>,
    /// Taken, as every command does; nothing here is random
    #[arg(long, value_name = "SEED", help_heading = "Answer")]
    pub(super) seed: Option<u64>,
    /// One JSON object on standard output
    #[arg(long, help_heading = "Answer")]
    pub(super) json: bool,
}
