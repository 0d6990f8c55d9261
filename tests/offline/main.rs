//! The commands without ROS, as a person runs them: files in, an answer out.

mod answers;
mod bad_input;
mod bounds;
mod command;
mod documentation;
mod evidence;
mod golden;
mod interrupted;
mod optimize;
mod optimize_bad_input;
mod sameness;
