//! Why there is no picture.

/// What cannot be drawn.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum PictureError {
    /// Nothing to draw.
    #[error("a picture needs at least one {what}")]
    Empty {
        /// Of what.
        what: &'static str,
    },
    /// A number that has no place on an axis.
    #[error("the {what} at {index} of '{label}' is {got}, but must be finite")]
    NotFinite {
        /// `x` or `y`.
        what: &'static str,
        /// Which point of the line, from 0.
        index: usize,
        /// Which line.
        label: String,
        /// Its value.
        got: String,
    },
    /// A grid whose cells do not fill whole rows.
    #[error("a grid has {cells} cells, but its rows have {columns}")]
    Ragged {
        /// Cells.
        cells: usize,
        /// Cells of a row.
        columns: usize,
    },
    /// A grid with more cells than anybody can see.
    #[error("a grid has {got} cells, but at most {most} can be drawn")]
    TooLarge {
        /// Cells.
        got: usize,
        /// Most of them.
        most: usize,
    },
    /// What the drawing library says.
    #[error("the picture cannot be drawn: {0}")]
    Drawing(String),
}
