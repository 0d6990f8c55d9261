//! The worlds of the dissertation.

mod grid;

pub mod chapter4;
pub mod chapter6;
pub mod corridor;
pub mod driving;
pub mod garnet;
pub mod machine_replacement;
pub mod maze;
pub mod sparse;

pub use grid::{ACTIONS, DOWN, GridWorld, LEFT, RIGHT, UP};
