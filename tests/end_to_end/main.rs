//! Whole lessons: the executable with every node in a process of its own, over DDS on loopback, as a person starts it.

mod asking;
mod bad_command_lines;
mod caller;
mod caution;
mod chromium;
mod foreign_bags;
mod hostile_pages;
mod killed_nodes;
mod killed_page;
mod operator_page;
mod pair;
mod peer;
mod python;
mod rapid_answers;
mod recorded;
mod replayed;
mod seated;
mod session_controls;
mod setting;
mod suite;
mod tabular;
mod taught;
mod two_tabs;
mod whole_loop;
mod worlds;
