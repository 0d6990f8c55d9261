//! TEMPORARY skeleton of inquiry.
