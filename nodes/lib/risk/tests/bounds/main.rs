//! Bounds keep their promises on draws of which the truth is known.

mod draws;
mod envelope;
mod literal_index;
mod order_statistic;
mod ranking;
mod weighted;
