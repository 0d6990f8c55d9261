//! Whole lessons: the executable with every node in a process of its own, over DDS on loopback, as a person starts it.

mod asking;
mod bad_command_lines;
mod caution;
mod chromium;
mod foreign_bags;
mod killed_nodes;
mod operator_page;
mod peer;
mod python;
mod recorded;
mod replayed;
mod suite;
mod tabular;
mod taught;
mod whole_loop;
mod worlds;
