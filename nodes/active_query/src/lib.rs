//! TEMPORARY skeleton of active_query.
