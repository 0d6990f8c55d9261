//! Tabular Markov decision processes: exact solvers, policies and the worlds of the dissertation.
//!
//! Rewards are linear in k features (dissertation section 3.2), so every answer is kept as features until weights come in:
//! a policy has feature counts Φ(π) and its value is wᵀΦ(π); an optimal policy has successor features, the gradient of Q*.

mod check;
mod error;
mod evaluate;
mod finite_horizon;
mod improve;
mod json;
mod limits;
mod linear;
mod losses;
mod model;
mod parts;
mod policy;
mod projection;
pub mod random;
mod rollout;
mod solver;
pub mod worlds;

pub use error::MdpError;
pub use evaluate::{feature_counts, occupancy, successor_features, values};
pub use finite_horizon::{FiniteOptimum, finite_feature_counts, finite_optimum, finite_values};
pub use improve::{Improvement, improve_policy};
pub use limits::{
    MAX_GAMMA, MAX_GAMMA_LARGE, MAX_NUMBERS, MAX_STATES, MAX_STATES_LONG, MAX_TRANSITIONS, SUM_TOLERANCE,
};
pub use losses::policy_losses;
pub use model::Mdp;
pub use parts::{Features, MdpParts};
pub use policy::Policy;
pub use projection::{Projection, projection};
pub use rollout::rollout;
pub use solver::{Optimum, Solver};
