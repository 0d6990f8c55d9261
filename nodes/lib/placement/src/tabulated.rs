//! Scenes that differ in few objects, tabulated so that what they share is computed once per draw.
//!
//! A basis function is a product of one factor per axis. Of 50 scenes with one object moved each, all but one object's
//! terms are the same; so per draw there is one sum for every *set* of moved features, and per (draw, scene) only the
//! moved ones are added to it. Rewards on the grid are `f32`: they only choose the hill, whose top is then found in `f64`.

use scene::{Basis, Field, Grid, Point, Rbf, Region, Scene, climb};
use std::collections::BTreeMap;

/// Grid points per axis on which hills are told apart.
pub(crate) const SIDE: usize = 32;
const CELLS: usize = SIDE * SIDE;

pub(crate) struct Tabulated {
    n_features: usize,
    /// `[k][i]` along x, `[k][j]` along y, at the position of feature k that most scenes share.
    common_x: Vec<[f32; SIDE]>,
    common_y: Vec<[f32; SIDE]>,
    /// Sets of features that are elsewhere in some scene, sorted.
    moved_sets: Vec<Vec<usize>>,
    scenes: Vec<TabulatedScene>,
}

struct TabulatedScene {
    /// Index into `moved_sets`.
    set: usize,
    /// Factors of the features of that set.
    moved_x: Vec<[f32; SIDE]>,
    moved_y: Vec<[f32; SIDE]>,
    /// Free stretches of the grid: (row, first column, end).
    runs: Vec<(usize, usize, usize)>,
    grid_m: Vec<Point>,
    basis: Basis,
    region: Region,
    reach_m: f64,
}

/// Room for one draw.
pub(crate) struct Scratch {
    /// One grid per moved set.
    partial: Vec<f32>,
    w: Vec<f64>,
}

impl Tabulated {
    /// # Panics
    /// When a scene has not `n_features` − 9 objects.
    pub fn new(scenes: &[Scene], n_features: usize) -> Self {
        let grid = Grid::midpoints(SIDE);
        let bases: Vec<Rbf> = scenes.iter().map(Rbf::new).collect();
        for (scene, basis) in scenes.iter().zip(&bases) {
            assert_eq!(basis.n(), n_features, "scene '{}' and the weights have different features", scene.id);
        }
        let common = Rbf { centres: (0..n_features).map(|k| commonest(bases.iter().map(|b| b.centres[k]))).collect() };
        let field = Field::new(&common, &grid, None);
        let narrow = |factors: &[f64]| -> [f32; SIDE] { std::array::from_fn(|i| factors[i] as f32) };
        let mut sets: BTreeMap<Vec<usize>, usize> = BTreeMap::new();
        let mut tabulated = Vec::with_capacity(scenes.len());
        for (scene, basis) in scenes.iter().zip(&bases) {
            let moved: Vec<usize> = (0..n_features).filter(|&k| basis.centres[k] != common.centres[k]).collect();
            let own = Field::new(basis, &grid, Some(scene));
            let next = sets.len();
            tabulated.push(TabulatedScene {
                moved_x: moved.iter().map(|&k| narrow(own.gx(k))).collect(),
                moved_y: moved.iter().map(|&k| narrow(own.gy(k))).collect(),
                set: *sets.entry(moved).or_insert(next),
                runs: runs(own.free()),
                grid_m: (0..CELLS).map(|i| scene.metres(grid.at(i))).collect(),
                basis: Basis::new(scene),
                region: Region::new(scene),
                reach_m: scene.width_m.max(scene.depth_m) / SIDE as f64,
            });
        }
        let mut moved_sets = vec![Vec::new(); sets.len()];
        for (set, index) in sets {
            moved_sets[index] = set;
        }
        Self {
            n_features,
            common_x: (0..n_features).map(|k| narrow(field.gx(k))).collect(),
            common_y: (0..n_features).map(|k| narrow(field.gy(k))).collect(),
            moved_sets,
            scenes: tabulated,
        }
    }

    pub fn n_scenes(&self) -> usize {
        self.scenes.len()
    }

    /// Whether a scene has a free grid point.
    pub fn has_free(&self, scene: usize) -> bool {
        !self.scenes[scene].runs.is_empty()
    }

    pub fn scratch(&self) -> Scratch {
        Scratch { partial: vec![0.0; CELLS * self.moved_sets.len()], w: vec![0.0; self.n_features] }
    }

    /// The best free placement under `w` in every scene, metres; scenes without a free grid point give (0, 0).
    pub fn optima(&self, w: impl Iterator<Item = f64>, scratch: &mut Scratch, mut found: impl FnMut(usize, Point)) {
        for (to, from) in scratch.w.iter_mut().zip(w) {
            *to = from;
        }
        let Scratch { partial, w } = scratch;
        for (set, partial) in self.moved_sets.iter().zip(partial.chunks_exact_mut(CELLS)) {
            self.sum_common(set, w, partial);
        }
        for (s, scene) in self.scenes.iter().enumerate() {
            let partial = &partial[scene.set * CELLS..(scene.set + 1) * CELLS];
            let moved = &self.moved_sets[scene.set];
            let top = scene.best_cell(partial, moved, w).map_or(Point::default(), |cell| {
                climb(&scene.basis, &scene.region, w, scene.grid_m[cell], scene.reach_m)
            });
            found(s, top);
        }
    }

    /// The rewards of all features that are not in a set.
    fn sum_common(&self, without: &[usize], w: &[f64], out: &mut [f32]) {
        out.fill(0.0);
        for (k, &w) in w.iter().enumerate().filter(|(k, _)| !without.contains(k)) {
            let (gx, gy) = (&self.common_x[k], &self.common_y[k]);
            for (row, gy) in out.chunks_exact_mut(SIDE).zip(gy) {
                let scale = w as f32 * gy;
                for (out, gx) in row.iter_mut().zip(gx) {
                    *out += scale * gx;
                }
            }
        }
    }
}

impl TabulatedScene {
    /// The free grid point of largest reward, the first of equals; `None` when none is free. Rewards that are not numbers
    /// lose.
    fn best_cell(&self, partial: &[f32], moved: &[usize], w: &[f64]) -> Option<usize> {
        let mut top = f32::NEG_INFINITY;
        let &(mut place) = self.runs.first()?;
        let mut buffer = [0.0_f32; SIDE];
        for &run in &self.runs {
            let (_, first, end) = run;
            let best = match self.reward_run(run, partial, moved, w, &mut buffer) {
                Run::Sum { row, gx, scale } => largest(&row[first..end], &gx[first..end], scale),
                Run::Whole(row) => largest(&row[first..end], &row[first..end], 0.0),
            };
            if best > top {
                (top, place) = (best, run);
            }
        }
        let (j, first, end) = place;
        let value = |i: usize| match self.reward_run(place, partial, moved, w, &mut buffer.clone()) {
            Run::Sum { row, gx, scale } => row[i] + scale * gx[i],
            Run::Whole(row) => row[i],
        };
        let column = (first..end).find(|&i| value(i) == top).unwrap_or(first);
        Some(j * SIDE + column)
    }

    /// The rewards of one row, as a sum of two parts when one feature has moved.
    fn reward_run<'a>(
        &'a self,
        (j, ..): (usize, usize, usize),
        partial: &'a [f32],
        moved: &[usize],
        w: &[f64],
        buffer: &'a mut [f32; SIDE],
    ) -> Run<'a> {
        let row = &partial[j * SIDE..(j + 1) * SIDE];
        match moved {
            [] => Run::Whole(row),
            [k] => Run::Sum { row, gx: &self.moved_x[0], scale: w[*k] as f32 * self.moved_y[0][j] },
            _ => {
                buffer.copy_from_slice(row);
                for (m, &k) in moved.iter().enumerate() {
                    let scale = w[k] as f32 * self.moved_y[m][j];
                    for (out, gx) in buffer.iter_mut().zip(&self.moved_x[m]) {
                        *out += scale * gx;
                    }
                }
                Run::Whole(buffer)
            }
        }
    }
}

enum Run<'a> {
    Whole(&'a [f32]),
    Sum { row: &'a [f32], gx: &'a [f32; SIDE], scale: f32 },
}

/// max_i a_i + scale·b_i, eight at a time.
fn largest(a: &[f32], b: &[f32], scale: f32) -> f32 {
    let mut lanes = [f32::NEG_INFINITY; 8];
    let (a_chunks, a_rest) = a.as_chunks::<8>();
    let (b_chunks, b_rest) = b.as_chunks::<8>();
    for (a, b) in a_chunks.iter().zip(b_chunks) {
        for i in 0..8 {
            let value = a[i] + scale * b[i];
            lanes[i] = if value > lanes[i] { value } else { lanes[i] };
        }
    }
    for (i, (a, b)) in a_rest.iter().zip(b_rest).enumerate() {
        let value = a + scale * b;
        lanes[i] = if value > lanes[i] { value } else { lanes[i] };
    }
    lanes.into_iter().fold(f32::NEG_INFINITY, |best, value| if value > best { value } else { best })
}

/// Free stretches of each row.
fn runs(free: &[bool]) -> Vec<(usize, usize, usize)> {
    let mut runs = Vec::new();
    for (j, row) in free.chunks_exact(SIDE).enumerate() {
        let mut i = 0;
        while i < SIDE {
            let length = row[i..].iter().take_while(|&&free| free).count();
            if length > 0 {
                runs.push((j, i, i + length));
            }
            i += length + 1;
        }
    }
    runs
}

/// The point that occurs most often, the first of equals.
fn commonest(points: impl Iterator<Item = Point> + Clone) -> Point {
    let count = |p: Point| points.clone().filter(|&q| q == p).count();
    let mut best = (0, Point::default());
    for p in points.clone() {
        let n = count(p);
        if n > best.0 {
            best = (n, p);
        }
    }
    best.1
}
