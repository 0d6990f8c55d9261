//! TEMPORARY skeleton of risk.
