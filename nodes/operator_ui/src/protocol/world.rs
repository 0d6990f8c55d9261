//! What a page is shown of a lesson about a world, with `null` for what is not finite.

use serde::Serialize;

/// How the states of a world are drawn.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum PictureView {
    /// Not at all: too many, or in no order that can be drawn.
    None,
    /// As the cells of a grid, row by row from the top left.
    Cells {
        /// Rows.
        rows: usize,
        /// Columns.
        columns: usize,
        /// Where each action leads on average: rows down, columns to the right, of length 1, or 0 for staying.
        moves: Vec<[f64; 2]>,
    },
    /// As a car on a road: see `TabularWorld`.
    Road {
        /// Lanes, the outer two off the road.
        lanes: usize,
        /// Places of the traffic, the farthest ahead first.
        places: usize,
        /// Lanes to the right that each action leads, on average.
        moves: Vec<f64>,
    },
}

/// A world.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WorldView {
    /// Unique within a session.
    pub id: String,
    /// SHA-256, hex.
    pub hash: String,
    /// How to draw it.
    pub picture: PictureView,
    /// States.
    pub n_states: usize,
    /// What can be done.
    pub actions: Vec<String>,
    /// What counts.
    pub features: Vec<String>,
    /// The feature that is largest in each state, `null` where none is; empty without a picture.
    pub cells: Vec<Option<usize>>,
    /// States where it may start; empty without a picture.
    pub starts: Vec<usize>,
    /// States where it ends; empty without a picture.
    pub terminals: Vec<usize>,
}

/// What the robot would do.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PolicyView {
    /// Of the posterior.
    pub revision: u64,
    /// `optimal`, `inaccurate`, `iteration_limit`, …, `not_computed`.
    pub outcome: &'static str,
    /// What it promises, or why there is none.
    pub reason: String,
    /// `robust`, `regret` or `evd`.
    pub objective: &'static str,
    /// The worst 1 − α of the rewards are the worst case.
    pub alpha: Option<f64>,
    /// Weight of the mean against the worst case.
    pub lambda: Option<f64>,
    /// Of the preference that chose λ; empty: a parameter did.
    pub preference_id: String,
    /// How much better another policy may be.
    pub gap: Option<f64>,
    /// Mean return.
    pub expected_return: Option<f64>,
    /// α of the rewards give more.
    pub value_at_risk: Option<f64>,
    /// Mean of the worst case.
    pub conditional_value_at_risk: Option<f64>,
    /// Draws that chose it.
    pub n_draws: u64,
    /// Draws that did not choose it and judge it.
    pub held_out: u64,
    /// Mean of the worst case of these.
    pub held_out_cvar: Option<f64>,
    /// Confidence interval of it.
    pub held_out_interval: Option<[f64; 2]>,
    /// Confidence of the interval.
    pub confidence: Option<f64>,
    /// π(a|s), state by state; empty without a policy or a picture.
    pub table: Vec<f64>,
    /// Discounted visits of each state; empty without a policy or a picture.
    pub visits: Vec<f32>,
}

/// The best policy for one λ.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PointView {
    /// λ.
    pub lambda: f64,
    /// Whether it is proved the best.
    pub optimal: bool,
    /// Mean return.
    pub expected_return: Option<f64>,
    /// α of the rewards give more.
    pub value_at_risk: Option<f64>,
    /// Mean of the worst case.
    pub conditional_value_at_risk: Option<f64>,
}

/// What every caution buys.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FrontierView {
    /// Of the posterior.
    pub revision: u64,
    /// As in [`PolicyView::outcome`].
    pub outcome: &'static str,
    /// In words.
    pub reason: String,
    /// As in [`PolicyView::objective`].
    pub objective: &'static str,
    /// The worst 1 − α of the rewards are the worst case.
    pub alpha: Option<f64>,
    /// λ ascending.
    pub points: Vec<PointView>,
    /// π(a|s) of every point, one after another; empty when they were too many to be sent.
    pub tables: Vec<f32>,
}

/// A bound and why there is none.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BoundView {
    /// The bound.
    pub bound: Option<f64>,
    /// Why there is none; empty with one.
    pub reason: String,
}

/// High-confidence bounds on the robot's policy.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RobustBoundsView {
    /// Of the posterior.
    pub revision: u64,
    /// Of the policy's set: it names revision and preference.
    pub set_id: String,
    /// The return is at least this.
    pub least_return: BoundView,
    /// The loss is at most this.
    pub loss: BoundView,
    /// The loss is at most this share of what choosing at random loses.
    pub normalised_loss: BoundView,
    /// The least return of the policy that is best for the mean reward.
    pub least_return_of_mean: BoundView,
    /// Share of the rewards covered.
    pub alpha: Option<f64>,
    /// Chance that a bound is wrong.
    pub delta: Option<f64>,
    /// How many posteriors were looked at so far.
    pub look: u64,
    /// Share of δ spent on each bound.
    pub delta_spent: Option<f64>,
    /// Draws that judge.
    pub n: u64,
    /// Their chains.
    pub n_chains: u32,
    /// Least effective sample size.
    pub ess_min: Option<f64>,
    /// Worst split R-hat.
    pub rhat_max: Option<f64>,
    /// Acceptance of the sampler.
    pub acceptance: Option<f64>,
    /// Prior.
    pub prior: String,
    /// SHA-256 over the evidence, hex.
    pub evidence_hash: String,
    /// Decimal; a JSON number would lose digits.
    pub seed: String,
    /// Of the program.
    pub version: String,
}

/// How cautious a page asked the robot to be.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CautionView {
    /// Of the preference.
    pub id: String,
    /// λ.
    pub lambda: f64,
    /// Whether the robot's policy follows it, or a newer one.
    pub taken: bool,
}

/// What one weight may be.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WeightView {
    /// What it is about.
    pub name: String,
    /// Mean of the draws.
    pub mean: f64,
    /// 5 in 100 are below.
    pub low: f64,
    /// 5 in 100 are above.
    pub high: f64,
}

/// The bound on the loss after one revision.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LossPoint {
    /// Of the posterior.
    pub revision: u64,
    /// The bound, as a share of what choosing at random loses.
    pub bound: Option<f64>,
    /// The goal.
    pub goal: Option<f64>,
    /// The claim, or why there is none.
    pub reason: String,
}

/// The newest question about the world.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WorldQuestionView {
    /// Unique within a session.
    pub id: String,
    /// Of the posterior.
    pub revision: u64,
    /// `action`, `critique` or `comparison`.
    pub kind: &'static str,
    /// That it is about.
    pub state: u32,
    /// None, one or two by kind; the first of two belongs on the left.
    pub ways: Vec<WayView>,
    /// What is asked, and why, in words.
    pub reason: String,
    /// Whether it was drawn at random to be held out.
    pub held_out: bool,
    /// How many questions it was chosen from.
    pub n_candidates: u32,
    /// Whether it may be answered.
    pub open: bool,
}

/// A way through the world.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WayView {
    /// Unique within a session.
    pub id: String,
    /// In the order of time.
    pub states: Vec<u32>,
    /// Taken in each of the states.
    pub actions: Vec<u32>,
}
