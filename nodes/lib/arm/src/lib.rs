//! TEMPORARY skeleton of arm.
