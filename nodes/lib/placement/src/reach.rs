//! Which cells of an empty table an arm can put the target on. It depends on the robot, the table and the target's shape
//! alone, so it is computed once and kept.

use crate::MAP_SIDE;
use crate::manipulator::{Cell, Manipulator};
use scene::{Grid, Obstruction, Scene, Shape};
use std::collections::VecDeque;

/// Random starts for a cell next to one that was solved, and for one that is not.
const RESTARTS: (usize, usize) = (8, 24);

/// A configuration for every cell that is in reach.
#[derive(Debug, Clone)]
pub struct ReachMap {
    side: usize,
    key: Key,
    configurations: Vec<Option<Vec<f64>>>,
}

#[derive(Debug, Clone, PartialEq)]
struct Key {
    frame: String,
    width_m: f64,
    depth_m: f64,
    target: Shape,
}

impl Key {
    fn of(scene: &Scene) -> Self {
        let Scene { frame, width_m, depth_m, target, .. } = scene;
        Self { frame: frame.clone(), width_m: *width_m, depth_m: *depth_m, target: target.shape }
    }
}

impl ReachMap {
    /// Solves `side` × `side` cells; `None` when the scene's frame is no fixed link of the robot. Objects of the scene
    /// play no part.
    ///
    /// Cells are visited from the middle outwards, each starting from the configuration of a neighbour; what that misses
    /// is tried again from every neighbour that was solved.
    pub fn new(manipulator: &Manipulator, scene: &Scene, side: usize) -> Option<Self> {
        let cell = manipulator.at_table(scene, false)?;
        let empty = Scene { objects: Vec::new(), ..scene.clone() };
        let occupied = empty.occupied();
        let grid = Grid::midpoints(side);
        let inside: Vec<bool> =
            (0..grid.n()).map(|i| occupied.reason(scene.metres(grid.at(i))) != Some(Obstruction::Edge)).collect();
        let mut map = Self { side, key: Key::of(scene), configurations: vec![None; grid.n()] };
        let mut seen = vec![false; grid.n()];
        let middle = (side / 2) * side + side / 2;
        let mut queue = VecDeque::from([middle]);
        seen[middle] = true;
        while let Some(i) = queue.pop_front() {
            if inside[i] {
                let neighbour = map.neighbours(i).find_map(|j| map.configurations[j].clone());
                let restarts = if neighbour.is_some() { RESTARTS.0 } else { RESTARTS.1 };
                let start = neighbour.unwrap_or_else(|| manipulator.robot.rest());
                map.configurations[i] = map.solve(&cell, scene, &grid, i, &start, restarts);
            }
            for j in map.neighbours(i) {
                if !std::mem::replace(&mut seen[j], true) {
                    queue.push_back(j);
                }
            }
        }
        let mut again: VecDeque<usize> =
            (0..grid.n()).filter(|&i| inside[i] && map.configurations[i].is_none()).collect();
        while let Some(i) = again.pop_front() {
            let starts: Vec<Vec<f64>> = map.neighbours(i).filter_map(|j| map.configurations[j].clone()).collect();
            if map.configurations[i].is_none() {
                map.configurations[i] = starts.iter().find_map(|start| map.solve(&cell, scene, &grid, i, start, 0));
                if map.configurations[i].is_some() {
                    again.extend(map.neighbours(i).filter(|&j| inside[j] && map.configurations[j].is_none()));
                }
            }
        }
        Some(map)
    }

    /// The map that was `kept`, when it is of this table and target, or a new one in its place.
    pub(crate) fn kept<'a>(kept: &'a mut Option<Self>, manipulator: &Manipulator, scene: &Scene) -> Option<&'a Self> {
        if kept.as_ref().is_none_or(|map| !map.fits(scene)) {
            *kept = Self::new(manipulator, scene, MAP_SIDE);
        }
        kept.as_ref()
    }

    /// Whether it holds for a scene: same table and target.
    pub fn fits(&self, scene: &Scene) -> bool {
        self.key == Key::of(scene)
    }

    /// Cells per axis.
    pub fn side(&self) -> usize {
        self.side
    }

    /// The configuration found for a cell, row-major, first row nearest to the robot; `None` out of reach.
    pub fn configuration(&self, cell: usize) -> Option<&[f64]> {
        self.configurations[cell].as_deref()
    }

    /// How many cells are in reach.
    pub fn n_reachable(&self) -> usize {
        self.configurations.iter().flatten().count()
    }

    fn solve(
        &self,
        cell: &Cell,
        scene: &Scene,
        grid: &Grid,
        i: usize,
        start: &[f64],
        restarts: usize,
    ) -> Option<Vec<f64>> {
        cell.place(scene.metres(grid.at(i)), cell.manipulator.settings.release_m, start, restarts)
    }

    /// The cells around one.
    fn neighbours(&self, i: usize) -> impl Iterator<Item = usize> + use<> {
        let side = self.side;
        let (row, column) = (i / side, i % side);
        let rows = row.saturating_sub(1)..=(row + 1).min(side - 1);
        rows.flat_map(move |r| {
            let columns = column.saturating_sub(1)..=(column + 1).min(side - 1);
            columns.map(move |c| r * side + c).filter(move |&j| j != i)
        })
    }
}
