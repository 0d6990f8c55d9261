//! TEMPORARY skeleton of demonstrator.
