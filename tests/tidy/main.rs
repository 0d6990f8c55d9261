//! The rules of the tree that no compiler checks: who may depend on what, what pure crates must not touch, what a file looks like.

mod files;
mod python_messages;
mod rules;
mod shipped;
