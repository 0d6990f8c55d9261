//! TEMPORARY skeleton of simulated_table.
