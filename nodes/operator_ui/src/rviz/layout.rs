//! Where the states of a world lie when it is drawn as a map: metres, x to the right, y away from the reader.

use crate::protocol::{PictureView, WorldView};

/// A cell of the map.
pub(super) const CELL_M: f64 = 0.1;

/// The map of a world.
#[derive(Debug, Clone, Copy)]
pub(super) struct Layout<'a> {
    world: &'a WorldView,
}

impl<'a> Layout<'a> {
    /// Of a world.
    pub fn new(world: &'a WorldView) -> Self {
        Self { world }
    }

    /// States that are drawn.
    pub fn n_drawn(self) -> usize {
        self.world.cells.len()
    }

    /// Extent to the right and away.
    pub fn size_m(self) -> [f64; 2] {
        match self.world.picture {
            PictureView::None => [0.0, 0.0],
            PictureView::Cells { rows, columns, .. } => [columns as f64 * CELL_M, rows as f64 * CELL_M],
            // A panel for each lane that the traffic may be in, and a lane's width between two.
            PictureView::Road { lanes, places, .. } => {
                [((lanes - 2) * (lanes + 1) - 1) as f64 * CELL_M, places as f64 * CELL_M]
            }
        }
    }

    /// The middle of a state; `None` when it is not drawn.
    pub fn middle_m(self, state: usize) -> Option<[f64; 2]> {
        if state >= self.n_drawn() {
            return None;
        }
        let (column, row, rows) = match self.world.picture {
            PictureView::None => return None,
            PictureView::Cells { rows, columns, .. } => (state % columns, state / columns, rows),
            PictureView::Road { lanes, places, .. } => {
                let (place, both) = (state % places, state / places);
                let (traffic, lane) = (both % (lanes - 2), both / (lanes - 2));
                (traffic * (lanes + 1) + lane, place, places)
            }
        };
        Some([(column as f64 + 0.5) * CELL_M, (rows as f64 - row as f64 - 0.5) * CELL_M])
    }

    /// Where an action leads on the map, a vector of length 1, or 0 for staying.
    pub fn towards(self, action: usize) -> [f64; 2] {
        match &self.world.picture {
            PictureView::None => [0.0; 2],
            PictureView::Cells { moves, .. } => moves.get(action).map_or([0.0; 2], |&[down, right]| [right, -down]),
            // On a road everything goes ahead.
            PictureView::Road { moves, .. } => match moves.get(action) {
                Some(&right) if right != 0.0 => [right, 0.0],
                _ => [0.0, 1.0],
            },
        }
    }
}
