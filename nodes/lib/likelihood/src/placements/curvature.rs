//! Fisher information of the likelihood: how fast it falls away from a weight vector, in every direction.

use super::PlacementLikelihood;
use super::cells::{FIXED_SIDE, LANES, Lanes};
use super::kernel::{Scratch, exponentials, fixed_rewards, sum_lanes};

/// Σ f_d² Cov_d φ, row-major and symmetric.
#[inline(always)]
pub(super) fn information(likelihood: &PlacementLikelihood, w: &[f64], scratch: &mut Scratch) -> Vec<f64> {
    let n = likelihood.n_features;
    let mut information = vec![0.0; n * n];
    fixed_rewards(likelihood, w, scratch);
    let mut first = vec![[0.0; LANES]; n];
    let mut second = vec![[0.0; LANES]; n * n];
    let mut features = vec![[0.0; LANES]; n];
    let fixed = &likelihood.fixed;
    let (side, row_length) = (fixed.side(), fixed.gx.len() / FIXED_SIDE);
    for cells in &likelihood.cells {
        let (_, sum) = exponentials(cells, w, scratch);
        first.fill([0.0; LANES]);
        second.fill([0.0; LANES]);
        let n_objects = cells.n_objects;
        for (index, p) in scratch.cells.iter().enumerate() {
            let (row, chunk) = (index / row_length, index % row_length);
            let factors = |k: usize| -> (&Lanes, f64) {
                if k < n_objects {
                    (&cells.gx[chunk * n_objects + k], cells.gy[k * side + row])
                } else {
                    let (a, b) = ((k - n_objects) % FIXED_SIDE, (k - n_objects) / FIXED_SIDE);
                    (&fixed.gx[chunk * FIXED_SIDE + a], fixed.gy[b * side + row])
                }
            };
            for (k, feature) in features.iter_mut().enumerate() {
                let (gx, gy) = factors(k);
                for lane in 0..LANES {
                    feature[lane] = gx[lane] * gy;
                }
            }
            for i in 0..n {
                let mut weighted = features[i];
                for lane in 0..LANES {
                    weighted[lane] *= p[lane];
                    first[i][lane] += weighted[lane];
                }
                for (second, feature) in second[i * n..].iter_mut().zip(&features[..=i]) {
                    for lane in 0..LANES {
                        second[lane] += weighted[lane] * feature[lane];
                    }
                }
            }
        }
        let mean: Vec<f64> = first.iter().map(|first| sum_lanes(first) / sum).collect();
        for i in 0..n {
            for j in 0..=i {
                let covariance = sum_lanes(&second[i * n + j]) / sum - mean[i] * mean[j];
                information[i * n + j] += cells.factor * cells.factor * covariance;
            }
        }
    }
    for i in 0..n {
        for j in 0..i {
            information[j * n + i] = information[i * n + j];
        }
    }
    information
}
