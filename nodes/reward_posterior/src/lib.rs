//! TEMPORARY skeleton of reward_posterior.
