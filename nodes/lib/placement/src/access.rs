//! Where in one scene the arm can put the target: the reach map, with the objects in the way.

use crate::manipulator::{Cell, resting_height_m};
use crate::reach::ReachMap;
use scene::{Grid, Point, Scene};

/// Random starts for a cell whose known configuration touches an object.
const RESTARTS: usize = 4;

pub(crate) struct Access<'a> {
    pub cell: Cell<'a>,
    scene: &'a Scene,
    grid: Grid,
    reach: &'a ReachMap,
    /// Where the joints are that do not move the tool.
    current: Vec<f64>,
    configurations: Vec<Option<Vec<f64>>>,
}

impl<'a> Access<'a> {
    /// Checks the free cells of a scene against its objects. `current` sets the joints that do not move the tool.
    pub fn new(cell: Cell<'a>, scene: &'a Scene, reach: &'a ReachMap, free: &[bool], current: &[f64]) -> Self {
        let grid = Grid::midpoints(reach.side());
        let (current, configurations) = (current.to_vec(), vec![None; free.len()]);
        let mut access = Self { cell, scene, grid, reach, current, configurations };
        for i in (0..free.len()).filter(|&i| free[i]) {
            let start = reach.configuration(i).map(|known| access.with_others_of(known));
            access.configurations[i] = start.and_then(|start| access.solve(access.at_m(i), &start, RESTARTS));
        }
        access
    }

    /// Centre of a cell, metres.
    pub fn at_m(&self, cell: usize) -> Point {
        self.scene.metres(self.grid.at(cell))
    }

    /// Whether a cell can be used.
    pub fn is_open(&self, cell: usize) -> bool {
        self.configurations[cell].is_some()
    }

    /// What keeps the arm from using a cell that it would reach on an empty table: two names, or none where the touch is
    /// only on the way up. `None` for a cell that is out of reach or open.
    pub fn blocked_by(&self, cell: usize) -> Option<Option<(String, String)>> {
        let known = self.reach.configuration(cell).filter(|_| !self.is_open(cell))?;
        Some(self.cell.contact(&self.with_others_of(known)))
    }

    /// A configuration that puts the target at any point, started from the nearest cell that can be used or its neighbour.
    pub fn configuration(&self, at_m: Point) -> Option<Vec<f64>> {
        let side = self.grid.side();
        let at = self.scene.normalised(at_m);
        let index = |v: f64| ((v * side as f64) as usize).min(side - 1);
        let (column, row) = (index(at.x), index(at.y));
        let rows = row.saturating_sub(1)..=(row + 1).min(side - 1);
        let around =
            rows.flat_map(|r| (column.saturating_sub(1)..=(column + 1).min(side - 1)).map(move |c| r * side + c));
        let mut starts: Vec<(f64, &Vec<f64>)> =
            around.filter_map(|i| self.configurations[i].as_ref().map(|q| (self.at_m(i).distance(at_m), q))).collect();
        starts.sort_by(|a, b| a.0.total_cmp(&b.0));
        starts.iter().take(3).find_map(|(_, start)| self.solve(at_m, start, 0))
    }

    /// A configuration that puts the target at a point, near a given one.
    pub fn near(&self, at_m: Point, start: &[f64]) -> Option<Vec<f64>> {
        self.solve(at_m, start, 0)
    }

    /// Height of the target's base when it is released at a point, metres: above what supports it.
    pub fn base_m(&self, at_m: Point) -> f64 {
        resting_height_m(self.scene, at_m) + self.cell.manipulator.settings.release_m
    }

    fn solve(&self, at_m: Point, start: &[f64], restarts: usize) -> Option<Vec<f64>> {
        self.cell.place(at_m, self.base_m(at_m), start, restarts)
    }

    fn with_others_of(&self, known: &[f64]) -> Vec<f64> {
        let mut q = self.current.clone();
        for &entry in &self.cell.manipulator.chain.entries {
            q[entry] = known[entry];
        }
        q
    }
}
