//! Have the chains mixed, and how many independent draws are they worth? Rank-normalised split R̂, effective sample sizes
//! and Monte Carlo standard errors after Vehtari, Gelman, Simpson, Carpenter and Bürkner (2021), "Rank-normalization,
//! folding, and localization"; and Pareto smoothing of importance weights.

mod beta;
mod deviation;
mod effective;
mod generalised_pareto;
mod indicator;
mod mean;
mod normal;
mod pareto_smoothing;
mod quantile;
mod rank;
mod series;

pub use mean::ess_of_mean;
pub use normal::normal_quantile;
pub use pareto_smoothing::{Smoothed, WeightsError, khat_threshold, pareto_smooth, pareto_smooth_correlated};
pub use series::{MIN_DRAWS_PER_CHAIN, Series, SeriesError};
