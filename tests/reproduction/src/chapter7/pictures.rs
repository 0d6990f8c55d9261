//! Policies on the grid of figure 7.4 as pictures.

use super::compared::Judged;
use mdp::Mdp;
use mdp::worlds::corridor::{DEMONSTRATION, TERMINAL};
use mdp::worlds::{DOWN, LEFT, RIGHT};
use picture::{Cell, Direction, GridPicture, Shade};

const DIRECTIONS: [Direction; 4] = [Direction::Up, Direction::Down, Direction::Left, Direction::Right];

const RED: Shade = Shade::Kind(2);

/// What the colours of cells mean.
pub fn legend() -> Vec<(Shade, String)> {
    vec![(RED, "red".into()), (Shade::Kind(0), "white".into())]
}

/// A policy; arrows have the area of their probabilities.
pub fn grid(mdp: &Mdp, policy: &Judged, caption: &str, detail: String) -> GridPicture {
    let arrows = |state: usize| -> Vec<(Direction, f64)> {
        DIRECTIONS.into_iter().enumerate().map(|(action, to)| (to, policy.probability(state, action))).collect()
    };
    drawn(mdp, caption, detail, &arrows)
}

/// The demonstration: an arrow in each cell that it shows.
pub fn demonstration_grid(mdp: &Mdp) -> GridPicture {
    let arrows = |state: usize| -> Vec<(Direction, f64)> {
        let shown = DEMONSTRATION.iter().filter(|(at, _)| *at == state);
        shown.map(|(_, action)| (DIRECTIONS[*action], 1.0)).collect()
    };
    drawn(mdp, "demonstration", "from the second cell".into(), &arrows)
}

fn drawn(mdp: &Mdp, caption: &str, detail: String, arrows: &dyn Fn(usize) -> Vec<(Direction, f64)>) -> GridPicture {
    let cell = |state: usize| {
        let red = mdp.features(state, 0)[1] > 0.0;
        let arrows = arrows(state);
        let taken: Vec<String> = arrows.iter().map(|(to, p)| format!("{to:?} {p:.2}").to_lowercase()).collect();
        Cell {
            shade: if red { RED } else { Shade::Kind(0) },
            terminal: state == TERMINAL,
            start: mdp.initial()[state] > 0.0,
            visited: true,
            about: format!("cell {state}: {}", taken.join(", ")),
            arrows,
        }
    };
    let columns = mdp.shape().map_or(5, |[_, columns]| columns);
    GridPicture { caption: caption.to_owned(), detail, columns, cells: (0..mdp.n_states()).map(cell).collect() }
}

/// The directions agree with the actions of grids.
const _: () = assert!(DOWN == 1 && LEFT == 2 && RIGHT == 3);
