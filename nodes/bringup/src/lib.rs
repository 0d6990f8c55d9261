//! TEMPORARY skeleton of bringup.
