//! The nodes on a graph within one process: undo to the bit, and what they make of bad evidence and damaged bytes.

mod bad_evidence;
mod evidence;
mod graph;
mod graph_file;
mod log_lines;
mod malformed;
mod undo;
