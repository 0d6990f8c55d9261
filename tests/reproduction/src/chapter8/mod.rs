//! What the figures of chapter 8 have in common: lessons in which a simulated person answers, chosen by one method or another.

mod arc_by_chains;
pub mod compare;
mod curves;
mod grids;
mod heat;
mod learner;
mod lesson;
mod method;
mod queries;
pub mod stopping;
mod stopwatch;
pub mod table_lesson;
pub mod tables;
mod teacher;

pub use arc_by_chains::arc_by_chains;
pub use curves::{Curve, curve_panel, mean_curve};
pub use grids::{dense_world, first_demonstration};
pub use heat::heat_maps;
pub use learner::{BETA, Learner};
pub use lesson::{Ask, Course, Step, hold, some};
pub use method::{ACTIVE_VAR, ARC, AS, Method, OURS, OURS_TABLE, RANDOM};
pub use queries::{fewer_queries, queries_to};
pub use stopwatch::cpu_seconds;
pub use teacher::Teacher;

/// What generators are for.
pub mod purpose {
    /// The world and its true reward.
    pub const WORLD: u32 = 0;
    /// What is shown before the first question.
    pub const SHOWN: u32 = 1;
    /// Chains; those of question n have this plus n. They are the same for every method.
    pub const CHAINS: u32 = 1000;
    /// Questions drawn at random.
    pub const QUESTIONS: u32 = 2;
    /// What the person leaves to chance.
    pub const PERSON: u32 = 3;
    /// Tables to test on.
    pub const TESTS: u32 = 4;
    /// Chains that are longer because shorter ones gave no bound.
    pub const MORE_CHAINS: u32 = 5;
}
