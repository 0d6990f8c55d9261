//! TEMPORARY skeleton of performance_bounds.
