//! What speaks of something that has not been heard of waits a little: topics come in no order.

use crate::piece::Piece;
use std::collections::VecDeque;

/// Ticks that a piece waits.
const PATIENCE_TICKS: u32 = 2;
/// Pieces that wait at a time.
const MAX_WAITING: usize = 16;

/// Pieces that wait, the oldest first.
#[derive(Debug, Default)]
pub(crate) struct Waiting {
    pieces: VecDeque<(u32, Piece)>,
}

impl Waiting {
    /// Lets a piece wait, a repetition not twice. Gives the oldest back when too many wait.
    pub(crate) fn add(&mut self, piece: Piece) -> Option<Piece> {
        if self.pieces.iter().any(|(_, waiting)| waiting.id() == piece.id()) {
            return None;
        }
        let oldest = if self.pieces.len() == MAX_WAITING { self.pieces.pop_front() } else { None };
        self.pieces.push_back((PATIENCE_TICKS, piece));
        oldest.map(|(_, piece)| piece)
    }

    /// Everything that waits, which waits no longer.
    pub(crate) fn take(&mut self) -> Vec<Piece> {
        self.pieces.drain(..).map(|(_, piece)| piece).collect()
    }

    /// A tick later: what has waited long enough.
    pub(crate) fn tick(&mut self) -> Vec<Piece> {
        for (patience, _) in &mut self.pieces {
            *patience = patience.saturating_sub(1);
        }
        let (over, left) = self.pieces.drain(..).partition(|(patience, _)| *patience == 0);
        self.pieces = left;
        VecDeque::into_iter(over).map(|(_, piece)| piece).collect()
    }
}
