//! Pictures as SVG text: line charts with numbers on both axes ([`charts`]) and policies on grids of cells ([`policy_grids`]).
//!
//! Who asks writes the text where it belongs; nothing here touches a file.

mod arrow;
mod chart;
mod colour;
mod error;
mod grid;
mod ticks;

pub use arrow::Direction;
pub use chart::{Chart, Line, Mark, Stroke, charts};
pub use error::PictureError;
pub use grid::{Cell, GridPicture, MAX_CELLS, Shade, policy_grids};
