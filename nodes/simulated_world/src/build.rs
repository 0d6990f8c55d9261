//! From parameters to the world.

use crate::settings::{Kind, Settings};
use apprentice_msgs::msg::TabularWorld;
use exchange::{Picture, WorldError, world_from_message, world_to_message};
use mdp::MdpError;
use mdp::worlds::{GridWorld, driving};
use thiserror::Error;

/// What each weight of the road is about.
const ROAD_FEATURES: [&str; driving::N_FEATURES] =
    ["collision", "left roadside", "left lane", "centre lane", "right lane", "right roadside"];

/// Why parameters make no world.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum WorldSettingsError {
    /// One entry per cell.
    #[error("cells has {got} entries; {rows} rows of {columns} columns need {expected}")]
    Cells {
        /// Got.
        got: usize,
        /// Rows.
        rows: i64,
        /// Columns.
        columns: i64,
        /// Needed.
        expected: i64,
    },
    /// A grid of nothing.
    #[error("features names nothing; a grid needs one at least")]
    NoFeatures,
    /// A cell holds something that is no feature.
    #[error("cell {index} holds '{name}', which features does not name")]
    Unknown {
        /// The cell, from 0.
        index: usize,
        /// What it holds.
        name: String,
    },
    /// What the process objects to.
    #[error(transparent)]
    Process(#[from] MdpError),
    /// What the message's readers would object to.
    #[error(transparent)]
    World(#[from] WorldError),
}

/// The world of the settings, without a header.
///
/// # Errors
/// Parameters that make no world.
pub fn world(settings: &Settings) -> Result<TabularWorld, WorldSettingsError> {
    let message = match settings.kind {
        Kind::Grid => {
            let (rows, columns) = (settings.rows as usize, settings.columns as usize);
            let picture = Picture::Cells { rows, columns };
            world_to_message(&settings.world_id, &settings.features, &grid(settings)?.mdp()?, picture)
        }
        Kind::Driving => {
            let names = ROAD_FEATURES.map(String::from);
            let picture = Picture::Road { lanes: driving::N_LANES, places: driving::N_PLACES };
            world_to_message(&settings.world_id, &names, &driving::world(), picture)
        }
    };
    world_from_message(&message)?;
    Ok(message)
}

fn grid(settings: &Settings) -> Result<GridWorld, WorldSettingsError> {
    let Settings { rows, columns, features, cells, .. } = settings;
    let expected = rows.saturating_mul(*columns);
    if i64::try_from(cells.len()) != Ok(expected) {
        return Err(WorldSettingsError::Cells { got: cells.len(), rows: *rows, columns: *columns, expected });
    }
    if features.is_empty() {
        return Err(WorldSettingsError::NoFeatures);
    }
    let feature = |(index, name): (usize, &String)| {
        let known = features.iter().position(|feature| feature == name);
        known.ok_or_else(|| WorldSettingsError::Unknown { index, name: name.chars().take(80).collect() })
    };
    let one_hot = cells.iter().enumerate().map(feature).collect::<Result<Vec<_>, _>>()?;
    let grid = GridWorld::one_hot(*rows as usize, *columns as usize, &one_hot, features.len());
    let states =
        |list: &[i64]| list.iter().map(|&cell| usize::try_from(cell).unwrap_or(usize::MAX)).collect::<Vec<_>>();
    let starts = if settings.starts.is_empty() { grid.starts.clone() } else { states(&settings.starts) };
    Ok(GridWorld { slip: settings.slip, gamma: settings.gamma, starts, terminals: states(&settings.terminals), ..grid })
}

#[cfg(test)]
mod tests {
    use super::world;
    use crate::settings::{Kind, Settings};
    use apprentice_msgs::msg::TabularWorld;
    use exchange::{Picture, world_from_message};
    use mdp::worlds::driving;

    fn garden() -> Settings {
        let names = |list: &[&str]| list.iter().map(|&name| name.to_owned()).collect::<Vec<_>>();
        Settings {
            kind: Kind::Grid,
            rows: 2,
            columns: 2,
            features: names(&["path", "flowers", "gate"]),
            cells: names(&["path", "flowers", "path", "gate"]),
            starts: vec![0],
            terminals: vec![3],
            ..Settings::default()
        }
    }

    #[test]
    fn a_grid_is_what_the_parameters_say() {
        let message = world(&garden()).expect("a good garden");
        let read = world_from_message(&message).expect("a good message");
        assert_eq!(read.picture, Picture::Cells { rows: 2, columns: 2 });
        assert_eq!(read.mdp.successors(0, mdp::worlds::DOWN).collect::<Vec<_>>(), [(2, 1.0)]);
        assert_eq!((read.mdp.features(1, 0), read.mdp.is_terminal(3)), ([0.0, 1.0, 0.0].as_slice(), true));
        assert_eq!(read.mdp.initial(), [1.0, 0.0, 0.0, 0.0]);
    }

    #[test]
    fn the_road_is_that_of_the_dissertation_and_says_how_to_picture_it() {
        let message = world(&Settings::default()).expect("the road");
        assert_eq!((message.shape.as_slice(), message.shape_of), ([5, 7].as_slice(), TabularWorld::ROAD));
        let read = world_from_message(&message).expect("a good message");
        assert_eq!(read.mdp, driving::world());
        assert_eq!(read.feature_names[driving::COLLISION], "collision");
    }

    #[test]
    fn parameters_that_make_no_world_are_told() {
        let told = |settings: Settings| world(&settings).expect_err("no world").to_string();
        assert_eq!(told(Settings { rows: 3, ..garden() }), "cells has 4 entries; 3 rows of 2 columns need 6");
        let mut sea = garden();
        sea.cells[2] = "sea".into();
        assert_eq!(told(sea), "cell 2 holds 'sea', which features does not name");
        assert!(told(Settings { starts: vec![9], ..garden() }).contains("start"));
        assert!(told(Settings { world_id: String::new(), ..garden() }).contains("its id"));
        let nothing = Settings { features: vec![], cells: vec![], rows: 1, columns: 0, ..garden() };
        assert_eq!(told(nothing), "features names nothing; a grid needs one at least");
    }
}
