//! TEMPORARY skeleton of posterior.
