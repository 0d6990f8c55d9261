//! The worst that can be under any reward of the family that the draws are from.

use mdp::{Mdp, MdpError, policy_losses};

/// How far a norm of weights may be from 1 and still be taken for 1: draws may have been rounded to single precision.
const SLACK: f64 = 1e-5;

/// The family that all draws belong to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Family {
    /// The sizes of the weights sum to 1.
    L1Sphere,
    /// The squares of the weights sum to 1.
    L2Sphere,
    /// Neither: rewards may be arbitrarily large.
    Unbounded,
}

impl Family {
    /// Of draws, rows of `k` weights.
    pub(super) fn of(draws: &[f64], k: usize) -> Self {
        let all = |norm: fn(&[f64]) -> f64| draws.chunks_exact(k).all(|w| (norm(w) - 1.0).abs() <= SLACK);
        if all(|w| w.iter().map(|w| w.abs()).sum()) {
            Self::L1Sphere
        } else if all(|w| libm::sqrt(w.iter().map(|w| w * w).sum())) {
            Self::L2Sphere
        } else {
            Self::Unbounded
        }
    }

    /// Smallest return of a policy: −‖Φ‖∞, or −‖Φ‖₂.
    pub(super) fn worst_return(self, counts: &[f64]) -> Option<f64> {
        let size = match self {
            Self::L1Sphere => counts.iter().fold(0.0_f64, |most, x| most.max(x.abs())),
            Self::L2Sphere => libm::sqrt(counts.iter().map(|x| x * x).sum()),
            Self::Unbounded => return None,
        };
        Some(-size * (1.0 + SLACK))
    }
}

/// Largest losses of policies under rewards of a family.
///
/// A loss L is convex in w and grows with it, so L(w) ≤ Σ_i |w_i| l_i, where l_i is the larger of its values at ±e_i, each an
/// ordinary planning problem. That is at most max l_i on the L1 sphere, where a vertex attains it, and at most ‖l‖₂ on the L2
/// sphere.
#[derive(Debug, Clone)]
pub(super) struct WorstLosses {
    /// V* at e_0, −e_0, e_1, …
    optimal: Vec<f64>,
    family: Family,
}

impl WorstLosses {
    /// `None` where rewards may be arbitrarily large.
    pub(super) fn new(mdp: &Mdp, family: Family, threads: usize) -> Result<Option<Self>, MdpError> {
        if family == Family::Unbounded {
            return Ok(None);
        }
        let k = mdp.n_features();
        let mut vertices = vec![0.0; 2 * k * k];
        for feature in 0..k {
            vertices[2 * feature * k + feature] = 1.0;
            vertices[(2 * feature + 1) * k + feature] = -1.0;
        }
        Ok(Some(Self { optimal: policy_losses(mdp, &vec![0.0; k], &vertices, threads)?, family }))
    }

    /// Of the policy with these feature counts.
    pub(super) fn of(&self, counts: &[f64]) -> f64 {
        let largest =
            self.optimal.chunks_exact(2).zip(counts).map(|(of, phi)| f64::max(of[0] - phi, of[1] + phi).max(0.0));
        let worst = match self.family {
            Family::L2Sphere => libm::sqrt(largest.map(|l| l * l).sum()),
            _ => largest.fold(0.0, f64::max),
        };
        worst * (1.0 + SLACK)
    }
}

#[cfg(test)]
mod tests {
    use super::{Family, WorstLosses};
    use mdp::worlds::chapter4;
    use mdp::{Policy, feature_counts, policy_losses};
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;

    #[test]
    fn no_reward_of_the_family_loses_more() {
        let mdp = chapter4::rep_0().mdp().expect("a process");
        let counts = feature_counts(&mdp, &Policy::uniform(&mdp)).expect("counts");
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let l1: Vec<f64> = (0..500).flat_map(|_| mdp::random::l1_sphere(8, &mut rng)).collect();
        let l2: Vec<f64> = l1
            .chunks(8)
            .flat_map(|w| {
                let norm = libm::sqrt(w.iter().map(|w| w * w).sum());
                w.iter().map(move |w| w / norm)
            })
            .collect();
        for (draws, family) in [(l1, Family::L1Sphere), (l2, Family::L2Sphere)] {
            assert_eq!(Family::of(&draws, 8), family);
            let worst = WorstLosses::new(&mdp, family, 2).expect("solved").expect("bounded").of(&counts);
            let losses = policy_losses(&mdp, &counts, &draws, 2).expect("losses");
            let largest = losses.iter().fold(0.0_f64, |most, loss| most.max(*loss));
            assert!(largest < worst && worst < 20.0 * largest, "{family:?}: {largest} {worst}");
            let least = family.worst_return(&counts).expect("bounded");
            assert!(draws.chunks(8).all(|w| super::super::policies::dot(w, &counts) >= least));
        }
        assert_eq!(Family::of(&[1.0, 1.0], 2), Family::Unbounded);
    }
}
