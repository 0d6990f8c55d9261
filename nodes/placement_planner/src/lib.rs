//! TEMPORARY skeleton of placement_planner.
