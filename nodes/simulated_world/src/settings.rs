//! The world as ROS parameters.

use bus::{NodeSettings, ParameterSpec, Range};
use serde::{Deserialize, Serialize};

/// What kind of world.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Cells with moves up, down, left and right.
    Grid,
    /// A car on a road with slower traffic.
    Driving,
}

/// Parameters of `simulated_world`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Id of the world.
    pub world_id: String,
    /// What kind of world.
    pub kind: Kind,
    /// Rows of a grid.
    pub rows: i64,
    /// Columns of a grid.
    pub columns: i64,
    /// What there may be in a cell of a grid: one weight each.
    pub features: Vec<String>,
    /// What there is in each cell, row by row from the top left.
    pub cells: Vec<String>,
    /// Probability of slipping to each of the two directions at right angles to the chosen one.
    pub slip: f64,
    /// Discount of a grid; the road has its own.
    pub gamma: f64,
    /// Cells of a grid to start in, counted from 0; empty: all.
    pub starts: Vec<i64>,
    /// Cells of a grid where it ends.
    pub terminals: Vec<i64>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            world_id: "world".to_owned(),
            kind: Kind::Driving,
            rows: 1,
            columns: 1,
            features: Vec::new(),
            cells: Vec::new(),
            slip: 0.0,
            gamma: 0.9,
            starts: Vec::new(),
            terminals: Vec::new(),
        }
    }
}

const SIDE: Range = Range::Integer { min: 1, max: 1000 };
const CELL: Range = Range::Integer { min: 0, max: 999_999 };

impl NodeSettings for Settings {
    const NODE: &'static str = "simulated_world";
    const ABOUT: &'static str = "A simulated world to teach: a grid of cells, or a road with traffic.";
    const PARAMETERS: &'static [ParameterSpec] = &[
        ParameterSpec { name: "world_id", about: "id of the world", range: Range::Any },
        ParameterSpec {
            name: "kind",
            about: "a grid of cells, or a road with traffic; what follows is about grids",
            range: Range::Choice(&["grid", "driving"]),
        },
        ParameterSpec { name: "rows", about: "rows of the grid", range: SIDE },
        ParameterSpec { name: "columns", about: "columns of the grid", range: SIDE },
        ParameterSpec { name: "features", about: "what there may be in a cell; one weight each", range: Range::Any },
        ParameterSpec {
            name: "cells",
            about: "what there is in each cell, by the names in features, row by row from the top left",
            range: Range::Any,
        },
        ParameterSpec {
            name: "slip",
            about: "probability of slipping to each of the two directions at right angles to the chosen one",
            range: Range::Float { min: 0.0, max: 0.5 },
        },
        ParameterSpec { name: "gamma", about: "discount per step", range: Range::Float { min: 0.0, max: 0.9999 } },
        ParameterSpec {
            name: "starts",
            about: "cells to start in, counted from 0 row by row; empty: all of them",
            range: CELL,
        },
        ParameterSpec { name: "terminals", about: "cells where it ends, counted from 0 row by row", range: CELL },
    ];

    fn check(&self) -> Result<(), String> {
        crate::world(self).map(drop).map_err(|error| error.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::Settings;

    #[test]
    fn the_table_of_parameters_matches_the_settings() {
        bus::testing::check_parameters::<Settings>();
    }
}
