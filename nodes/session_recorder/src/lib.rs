//! TEMPORARY skeleton of session_recorder.
