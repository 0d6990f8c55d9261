//! What the commands read and write, each file checked where it is read.

mod choices;
mod field;
mod json;
mod lines;
mod orders;
mod preferences;
mod records;
mod table;
mod write;

pub use choices::{read_critiques, read_demonstrations, read_trajectories};
pub use json::{read_map, read_mdp, read_policy};
pub use lines::MAX_LINE_BYTES;
pub use orders::read_orders;
pub use preferences::Preferences;
pub use table::{MAX_NUMBERS, Table, Wanted};
pub use write::{write_table, write_text};
