//! The loss of a policy under each of many weight vectors.

use std::thread;

use crate::error::{MdpError, check_finite};
use crate::model::Mdp;
use crate::solver::Solver;

/// Expected value difference of a policy under each draw, V*_w − wᵀΦ(π) (dissertation eq. 4.4): n numbers, none negative where
/// Φ(π) is that of a policy. What rounding may have made of zero is zero: ranks of its noise would look like chains that disagree.
/// With Φ = 0 they are V*_w itself. `feature_counts` is Φ(π), `draws` n × k row by row. The same for any number of threads.
///
/// # Errors
/// Counts or draws of the wrong length or not finite.
pub fn policy_losses(mdp: &Mdp, feature_counts: &[f64], draws: &[f64], threads: usize) -> Result<Vec<f64>, MdpError> {
    let k = mdp.n_features();
    if feature_counts.len() != k {
        let (name, got) = ("feature_counts", feature_counts.len());
        return Err(MdpError::Length { name, got, expected: k, why: "one per feature" });
    }
    if !draws.len().is_multiple_of(k) {
        let (got, expected) = (draws.len(), draws.len() / k * k);
        return Err(MdpError::Length { name: "draws", got, expected, why: "a multiple of the number of features" });
    }
    check_finite("feature_counts", feature_counts)?;
    check_finite("draws", draws)?;
    let mut losses = vec![0.0; draws.len() / k];
    // Fixed blocks, each with a solver of its own: what a solver remembers never depends on the number of threads.
    let blocks: Vec<_> = losses.chunks_mut(BLOCK).zip(draws.chunks(BLOCK * k)).collect();
    let threads = threads.clamp(1, blocks.len().max(1));
    let mut shares: Vec<Vec<_>> = (0..threads).map(|_| Vec::new()).collect();
    for (index, block) in blocks.into_iter().enumerate() {
        shares[index % threads].push(block);
    }
    thread::scope(|scope| {
        for share in shares {
            scope.spawn(move || {
                for (losses, draws) in share {
                    let mut solver = Solver::new(mdp);
                    for (loss, w) in losses.iter_mut().zip(draws.chunks(k)) {
                        let value: f64 = w.iter().zip(feature_counts).map(|(w, phi)| w * phi).sum();
                        let size: f64 = w.iter().zip(feature_counts).map(|(w, phi)| (w * phi).abs()).sum();
                        let difference = solver.solve(w).value() - value;
                        *loss = if difference.abs() > ROUNDING * size { difference } else { 0.0 };
                    }
                }
            });
        }
    });
    Ok(losses)
}

/// Draws that share a solver.
const BLOCK: usize = 256;

/// Losses below this share of Σ |w_i Φ_i| are rounding.
const ROUNDING: f64 = 1e-9;
