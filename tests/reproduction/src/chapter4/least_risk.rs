//! Draws of the weights with their optimal values, losses under them, and the policy with the least risk, among all or among a few.

use crate::harness::sum_in_order;
use mdp::{Mdp, Solver};
use risk::Tail;

/// Steps of the descent; the risk changes by less than a thousandth of itself after half as many.
const STEPS: usize = 200;
/// Losses below this share of Σ |w_i Φ_i| are rounding, and zero: as in `mdp::policy_losses`.
const ROUNDING: f64 = 1e-9;

/// Draws of the weights, each solved once however many policies are judged.
#[derive(Debug, Clone)]
pub struct Solved {
    /// Row-major.
    draws: Vec<f64>,
    /// V*_w of every draw.
    values: Vec<f64>,
}

impl Solved {
    /// Solves `draws`, row-major.
    pub fn new(mdp: &Mdp, draws: &[f64]) -> Self {
        let mut solver = Solver::new(mdp);
        let values = draws.chunks_exact(mdp.n_features()).map(|w| solver.solve(w).value()).collect();
        Self { draws: draws.to_vec(), values }
    }

    /// Expected value difference V*_w − wᵀΦ of a policy under every draw (equation 4.4).
    pub fn losses(&self, counts: &[f64]) -> Vec<f64> {
        let of = |(value, w): (&f64, &[f64])| {
            let products = || w.iter().zip(counts).map(|(w, phi)| w * phi);
            let loss = value - products().fold(0.0, |sum, x| sum + x);
            let size = products().fold(0.0, |sum, x| sum + x.abs());
            if loss.abs() > ROUNDING * size { loss } else { 0.0 }
        };
        self.values.iter().zip(self.draws.chunks_exact(counts.len())).map(of).collect()
    }

    /// The first and the second halves of `n_chains` chains that follow one another.
    pub fn halves(&self, n_chains: usize, n_features: usize) -> [Self; 2] {
        let per_chain = self.values.len() / n_chains;
        let half = per_chain / 2;
        let part = |from: usize, to: usize| Self {
            draws: self
                .draws
                .chunks_exact(per_chain * n_features)
                .flat_map(|chain| chain[from * n_features..to * n_features].iter().copied())
                .collect(),
            values: self.values.chunks_exact(per_chain).flat_map(|chain| chain[from..to].iter().copied()).collect(),
        };
        [part(0, half), part(half, per_chain)]
    }

    /// The α-value at risk of a policy's loss.
    pub fn value_at_risk(&self, counts: &[f64], alpha: f64) -> f64 {
        let mut losses = self.losses(counts);
        losses.sort_unstable_by(f64::total_cmp);
        risk::value_at_risk(&losses, alpha, Tail::Upper).unwrap_or(f64::INFINITY)
    }

    /// Feature counts of the mixture of policies whose α-value at risk is smallest along a descent of its conditional value at
    /// risk, which is convex in Φ.
    ///
    /// Frank–Wolfe: the conditional value at risk of V*_w − wᵀΦ falls fastest towards the policy that is optimal under the mean of
    /// the weights in the tail. A mixture chooses one of its policies at the start, and has the mean of their feature counts.
    pub fn least_risk_counts(&self, mdp: &Mdp, alpha: f64) -> Vec<f64> {
        let n = self.values.len();
        let n_tail = (((1.0 - alpha) * n as f64) as usize).clamp(1, n);
        let mut solver = Solver::new(mdp);
        let mut counts = solver.solve(&self.mean(mdp.n_features(), 0..n)).feature_counts().to_vec();
        let mut best = (f64::INFINITY, counts.clone());
        let mut order: Vec<usize> = (0..n).collect();
        for step in 0..STEPS {
            let losses = self.losses(&counts);
            // The largest first, equal ones in the order of the draws. Only the tail has to be known.
            let larger = |a: &usize, b: &usize| losses[*b].total_cmp(&losses[*a]).then(a.cmp(b));
            order.select_nth_unstable_by(n_tail - 1, larger);
            order[..n_tail].sort_unstable_by(larger);
            let value_at_risk = losses[order[n_tail - 1]];
            if value_at_risk < best.0 {
                best = (value_at_risk, counts.clone());
            }
            let tail = self.mean(mdp.n_features(), order[..n_tail].iter().copied());
            let towards = solver.solve(&tail).feature_counts();
            let share = 1.0 / (step as f64 + 2.0);
            for (count, towards) in counts.iter_mut().zip(towards) {
                *count += share * (towards - *count);
            }
        }
        best.1
    }

    /// Of `candidates`, feature counts of policies, those with the smallest α-value at risk; the first of equals.
    pub fn safest_counts<'a>(&self, alpha: f64, candidates: &'a [Vec<f64>]) -> &'a [f64] {
        let mut best: Option<(f64, &[f64])> = None;
        for counts in candidates {
            let value_at_risk = self.value_at_risk(counts, alpha);
            if best.is_none_or(|(least, _)| value_at_risk < least) {
                best = Some((value_at_risk, counts));
            }
        }
        best.expect("there is a policy to choose").1
    }

    /// Mean weights of some draws.
    fn mean(&self, k: usize, which: impl Iterator<Item = usize> + Clone) -> Vec<f64> {
        let n = which.clone().count() as f64;
        let of = |j: usize| sum_in_order(&which.clone().map(|i| self.draws[i * k + j]).collect::<Vec<f64>>()) / n;
        (0..k).map(of).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Solved;
    use mdp::random::l1_sphere;
    use mdp::worlds::chapter4;
    use mdp::{Policy, feature_counts, policy_losses};
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;

    #[test]
    fn losses_are_those_of_the_library_and_the_least_risk_is_no_larger_than_that_of_other_policies() {
        let mut generator = ChaCha8Rng::seed_from_u64(8);
        let mdp = chapter4::random(&mut generator).mdp().expect("a good world");
        let k = mdp.n_features();
        let draws: Vec<f64> = (0..40).flat_map(|_| l1_sphere(k, &mut generator)).collect();
        let solved = Solved::new(&mdp, &draws);
        let mut others = Vec::new();
        for action in 0..4 {
            let policy = Policy::Deterministic(vec![action; mdp.n_states()]);
            others.push(feature_counts(&mdp, &policy).expect("a policy of this world"));
        }
        // One that is optimal for a draw: its loss there is nothing but rounding.
        others.push(mdp::Solver::new(&mdp).solve(&draws[..k]).feature_counts().to_vec());
        for counts in &others {
            let want = policy_losses(&mdp, counts, &draws, 1).expect("losses");
            for (got, want) in solved.losses(counts).iter().zip(&want) {
                assert!((got - want).abs() < 1e-12, "{got} vs {want}");
            }
        }
        assert_eq!(solved.losses(&others[4])[0], 0.0);
        let least = solved.value_at_risk(&solved.least_risk_counts(&mdp, 0.8), 0.8);
        let safest = solved.value_at_risk(solved.safest_counts(0.8, &others), 0.8);
        assert!(least <= safest + 1e-9, "{least} vs {safest}");
        assert!(others.iter().all(|counts| solved.value_at_risk(counts, 0.8) >= safest));
        let [first, second] = solved.halves(2, k);
        assert_eq!(first.draws, [&draws[..10 * k], &draws[20 * k..30 * k]].concat());
        assert_eq!(second.values, [&solved.values[10..20], &solved.values[30..]].concat());
    }
}
