//! The nodes on a graph within one process: every kind of evidence, undo to the bit, policies judged, and what they make of bad
//! evidence and damaged bytes; and things picked up and put down in a simulated world.

mod bad_evidence;
mod evidence;
mod graph;
mod graph_file;
mod hand;
mod log_lines;
mod malformed;
mod moved;
mod picking;
mod policies;
mod row;
mod rviz;
mod trajectories;
mod undo;
mod waiting;
