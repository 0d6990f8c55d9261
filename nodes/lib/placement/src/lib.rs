//! TEMPORARY skeleton of placement.
