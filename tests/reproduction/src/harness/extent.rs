//! How much work a figure does.

/// `full`, but `in_tests` when the figure is made by a test, which asks whether it can be made and not what it shows.
pub const fn extent(full: usize, in_tests: usize) -> usize {
    if cfg!(test) { in_tests } else { full }
}
