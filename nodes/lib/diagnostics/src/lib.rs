//! Have the chains mixed, and how many independent draws are they worth? Rank-normalised split R̂ and effective sample
//! sizes after Vehtari, Gelman, Simpson, Carpenter and Bürkner (2021), "Rank-normalization, folding, and localization".

mod effective;
mod rank;
mod series;

pub use series::{MIN_DRAWS_PER_CHAIN, Series, SeriesError};
