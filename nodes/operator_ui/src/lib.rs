//! TEMPORARY skeleton of operator_ui.
