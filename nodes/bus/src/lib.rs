//! TEMPORARY skeleton of bus.
