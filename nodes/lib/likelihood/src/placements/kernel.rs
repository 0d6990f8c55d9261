//! The inner loops: rewards of all cells, their exponentials, and expectations of the features under them.
//!
//! Everything is `inline(always)` so that it is compiled anew inside each `pulp` dispatch for that machine's vectors.
//! Additions happen in the same order for every vector width.

use super::GRID_SIDE_RANGE;
use pulp::Simd;
use scene::exp;

use super::PlacementLikelihood;
use super::cells::{Cells, FIXED_SIDE, LANES, Lanes, chunks};

/// With rewards known to lie within this many nats of 0, no maximum has to be found before exponentials are taken.
const SAFE_RANGE: f64 = 300.0;

/// Exponents below this are those of occupied cells or of cells that do not count: exactly zero, because products with
/// subnormal numbers are slow.
const NEGLIGIBLE: f64 = -2.0 * SAFE_RANGE;
/// Cells per axis, at most.
const MAX_SIDE: usize = *GRID_SIDE_RANGE.end();

/// Buffers of one thread of evaluation.
#[derive(Debug, Clone)]
pub struct Scratch {
    /// Rewards of the fixed centres, per cell.
    pub(super) fixed: Vec<Lanes>,
    /// Exponentials per cell.
    pub(super) cells: Vec<Lanes>,
    /// Σ_d f_d p_d per cell.
    pub(super) visits: Vec<Lanes>,
    /// β w_k gy_k of one row.
    coefficients: Vec<f64>,
}

impl Scratch {
    pub(super) fn new(side: usize, n_features: usize) -> Self {
        let cells = vec![[0.0; LANES]; side * chunks(side)];
        Self { fixed: cells.clone(), visits: cells.clone(), cells, coefficients: vec![0.0; n_features] }
    }
}

#[inline(always)]
pub(super) fn value(likelihood: &PlacementLikelihood, w: &[f64], scratch: &mut Scratch) -> f64 {
    fixed_rewards(likelihood, w, scratch);
    let wrong_rate = likelihood.wrong_rate;
    let mut value = if wrong_rate > 0.0 { 0.0 } else { inner(&likelihood.shown, w) };
    for (cells, shown) in likelihood.cells.iter().zip(likelihood.shown_each.chunks_exact(likelihood.n_features)) {
        let (log_sum, _) = exponentials(cells, w, scratch);
        let log_mean = log_sum - cells.log_n_free;
        if wrong_rate > 0.0 {
            value += mixed(inner(shown, w) - log_mean, wrong_rate).0;
        } else {
            value -= log_mean;
        }
    }
    value
}

/// log((1 − ε) p + ε), p the probability relative to a uniform placement, and the chance that the placement is not at random.
#[inline(always)]
fn mixed(log_p: f64, wrong_rate: f64) -> (f64, f64) {
    let (meant, random) = (libm::log1p(-wrong_rate) + log_p, libm::log(wrong_rate));
    let most = if meant > random { meant } else { random };
    let log_sum = most + libm::log(libm::exp(meant - most) + libm::exp(random - most));
    (log_sum, libm::exp(meant - log_sum))
}

#[inline(always)]
pub(super) fn value_and_gradient<S: Simd>(
    simd: S,
    likelihood: &PlacementLikelihood,
    w: &[f64],
    gradient: &mut [f64],
    scratch: &mut Scratch,
) -> f64 {
    let fixed = &likelihood.fixed;
    let side = fixed.side();
    fixed_rewards(likelihood, w, scratch);
    scratch.visits.fill([0.0; LANES]);
    let wrong_rate = likelihood.wrong_rate;
    let mut value = 0.0;
    if wrong_rate > 0.0 {
        gradient.fill(0.0);
    } else {
        gradient.copy_from_slice(&likelihood.shown);
        value = inner(&likelihood.shown, w);
    }
    for (cells, shown) in likelihood.cells.iter().zip(likelihood.shown_each.chunks_exact(likelihood.n_features)) {
        let (log_sum, sum) = exponentials(cells, w, scratch);
        let log_mean = log_sum - cells.log_n_free;
        let mut scale = cells.factor / sum;
        if wrong_rate > 0.0 {
            let (log_p, meant) = mixed(inner(shown, w) - log_mean, wrong_rate);
            value += log_p;
            scale *= meant;
            for (g, shown) in gradient.iter_mut().zip(shown) {
                *g += meant * shown;
            }
        } else {
            value -= log_mean;
        }
        for (visits, p) in scratch.visits.as_flattened_mut().iter_mut().zip(scratch.cells.as_flattened()) {
            *visits += scale * p;
        }
        for (k, (g, gy)) in gradient.iter_mut().zip(cells.gy.chunks_exact(side)).enumerate() {
            let gx = cells.gx[k..].iter().step_by(cells.n_objects);
            *g -= scale * expectation(simd, &scratch.cells, gx, gy);
        }
    }
    let first = likelihood.n_features - FIXED_SIDE * FIXED_SIDE;
    for (k, g) in gradient[first..].iter_mut().enumerate() {
        let gx = fixed.gx[k % FIXED_SIDE..].iter().step_by(FIXED_SIDE);
        *g -= expectation(simd, &scratch.visits, gx, &fixed.gy[k / FIXED_SIDE * side..][..side]);
    }
    value
}

/// R of the fixed centres for every cell, into `scratch.fixed`.
#[inline(always)]
pub(super) fn fixed_rewards(likelihood: &PlacementLikelihood, w: &[f64], scratch: &mut Scratch) {
    let w = &w[likelihood.n_features - FIXED_SIDE * FIXED_SIDE..];
    let fixed = &likelihood.fixed;
    let row_length = fixed.gx.len() / FIXED_SIDE;
    for (j, row) in scratch.fixed.chunks_exact_mut(row_length).enumerate() {
        let gy: [f64; FIXED_SIDE] = std::array::from_fn(|b| fixed.gy[b * fixed.side() + j]);
        let c: [f64; FIXED_SIDE] =
            std::array::from_fn(|a| w[a] * gy[0] + w[FIXED_SIDE + a] * gy[1] + w[2 * FIXED_SIDE + a] * gy[2]);
        for (out, gx) in row.iter_mut().zip(fixed.gx.chunks_exact(FIXED_SIDE)) {
            for lane in 0..LANES {
                out[lane] = c[0] * gx[0][lane] + c[1] * gx[1][lane] + c[2] * gx[2][lane];
            }
        }
    }
}

/// exp(β R + log weight − shift) of every cell, into `scratch.cells`; gives (log Σ, Σ of the shifted exponentials).
#[inline(always)]
pub(super) fn exponentials(cells: &Cells, w: &[f64], scratch: &mut Scratch) -> (f64, f64) {
    exponents(cells, w, scratch);
    // Every feature lies in [0, 1], so |β R| ≤ β ‖w‖₁.
    let reach = cells.factor * w.iter().map(|w| w.abs()).sum::<f64>();
    let shift = if reach <= SAFE_RANGE { 0.0 } else { largest(&scratch.cells) };
    for cell in scratch.cells.as_flattened_mut() {
        let exponent = *cell - shift;
        *cell = if exponent > NEGLIGIBLE { exp(exponent) } else { 0.0 };
    }
    let mut sum = [0.0; LANES];
    for cell in &scratch.cells {
        for lane in 0..LANES {
            sum[lane] += cell[lane];
        }
    }
    let sum = sum_lanes(&sum);
    (shift + libm::log(sum), sum)
}

/// β R + log weight of every cell.
#[inline(always)]
fn exponents(cells: &Cells, w: &[f64], scratch: &mut Scratch) {
    let (n, side) = (cells.n_objects, scratch.fixed.len() / cells.row_length);
    let coefficients = &mut scratch.coefficients[..n];
    let rows = scratch.cells.chunks_exact_mut(cells.row_length);
    let tables = scratch.fixed.chunks_exact(cells.row_length).zip(cells.log_weight.chunks_exact(cells.row_length));
    for (row, (out, (fixed, log_weight))) in rows.zip(tables).enumerate() {
        for (k, c) in coefficients.iter_mut().enumerate() {
            *c = cells.factor * w[k] * cells.gy[k * side + row];
        }
        for (chunk, (out, (fixed, log_weight))) in out.iter_mut().zip(fixed.iter().zip(log_weight)).enumerate() {
            let mut t = *log_weight;
            for lane in 0..LANES {
                t[lane] += cells.factor * fixed[lane];
            }
            for (c, gx) in coefficients.iter().zip(&cells.gx[chunk * n..(chunk + 1) * n]) {
                for lane in 0..LANES {
                    t[lane] += c * gx[lane];
                }
            }
            *out = t;
        }
    }
}

/// Σ over the rows of gy p for every column. Elementwise, so that the bits do not depend on the width of `S`.
#[inline(always)]
fn sum_columns<S: Simd>(simd: S, p: &[f64], gy: &[f64], columns: &mut [f64]) {
    // Rows are whole vectors of eight: nothing is left over for any S.
    let (p, _) = S::as_simd_f64s(p);
    let (columns, _) = S::as_mut_simd_f64s(columns);
    let row_length = columns.len();
    for (first, column) in columns.iter_mut().enumerate() {
        let mut sum = simd.splat_f64s(0.0);
        for (p, gy) in p[first..].iter().step_by(row_length).zip(gy) {
            sum = simd.add_f64s(sum, simd.mul_f64s(simd.splat_f64s(*gy), *p));
        }
        *column = sum;
    }
}

/// Σ over the cells of p φ for a feature with factors `gx` (one vector per chunk) and `gy` (one number per row).
#[inline(always)]
fn expectation<'a, S: Simd>(simd: S, p: &[Lanes], gx: impl ExactSizeIterator<Item = &'a Lanes>, gy: &[f64]) -> f64 {
    let mut columns = [0.0; MAX_SIDE];
    let (columns, p) = (&mut columns[..gx.len() * LANES], p.as_flattened());
    sum_columns(simd, p, gy, columns);
    let mut sum = [0.0; LANES];
    for (columns, gx) in columns.chunks_exact(LANES).zip(gx) {
        for lane in 0..LANES {
            sum[lane] += columns[lane] * gx[lane];
        }
    }
    sum_lanes(&sum)
}

#[inline(always)]
fn largest(cells: &[Lanes]) -> f64 {
    let mut largest = [f64::NEG_INFINITY; LANES];
    for cell in cells {
        for lane in 0..LANES {
            largest[lane] = if cell[lane] > largest[lane] { cell[lane] } else { largest[lane] };
        }
    }
    largest.iter().fold(f64::NEG_INFINITY, |a, &b| if b > a { b } else { a })
}

#[inline(always)]
pub(super) fn sum_lanes(lanes: &Lanes) -> f64 {
    let [a, b, c, d, e, f, g, h] = lanes;
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}

#[inline(always)]
fn inner(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
