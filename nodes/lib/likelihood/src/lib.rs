//! How probable evidence is under a reward: placements on a table, actions in a decision process, comparisons of
//! trajectories.
//!
//! Every likelihood here is a function of θ = β w alone, rationality times weights: utilities are linear in the weights.
//! So one gradient ∇_θ gives both others: ∂/∂w = β ∇_θ and ∂/∂ log β = ⟨∇_θ, θ⟩.

pub mod actions;
pub mod placements;
pub mod preferences;
