//! What a planner must know of a mechanism and what is around it.

/// The configurations of a mechanism. Methods take `&mut self` so that a space may keep room for its computations.
pub trait Space {
    /// Smallest position of every joint; finite. A joint without ends gives a turn about where it is.
    fn lower(&self) -> &[f64];

    /// Largest position of every joint; finite, at least the smallest.
    fn upper(&self) -> &[f64];

    /// Whether a configuration touches nothing and is within limits.
    fn is_free(&mut self, q: &[f64]) -> bool;

    /// Whether every configuration on the straight edge from `a` to `b` is free, both ends among them.
    fn edge_is_free(&mut self, a: &[f64], b: &[f64]) -> bool;
}
