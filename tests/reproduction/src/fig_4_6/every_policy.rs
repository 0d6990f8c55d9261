//! All deterministic policies of a small deterministic world with two starts, as far as they differ in what they are worth.

use mdp::{Mdp, Solver};
use std::collections::{BTreeMap, HashMap};

/// A way through the world: its states with the action taken in each. It ends in a terminal state, or repeats itself from some
/// place on for ever.
type Way = Vec<(usize, usize)>;

/// For each start, the feature counts that some policy has from there, and a way that has them.
#[derive(Debug, Clone)]
pub struct EveryPolicy {
    ways: [Vec<([f64; 2], Way)>; 2],
    /// What to do where no way leads.
    elsewhere: Vec<usize>,
}

impl EveryPolicy {
    /// Follows every way from both starts of a deterministic world with two features.
    pub fn of(mdp: &Mdp, starts: [usize; 2]) -> Self {
        let from = |start: usize| {
            let mut found = HashMap::new();
            follow(mdp, start, &mut Vec::new(), &mut found);
            let mut ways: Vec<([f64; 2], Way)> = found.into_values().collect();
            ways.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]).then(a.0[1].total_cmp(&b.0[1])));
            ways
        };
        let elsewhere = Solver::new(mdp).solve(&[-1.0, -2.0]).policy().to_vec();
        Self { ways: starts.map(from), elsewhere }
    }

    /// Ways from a start that differ in their feature counts.
    pub fn n_walks(&self, start: usize) -> usize {
        self.ways[start].len()
    }

    /// The least α-value at risk of V*_w − wᵀΦ over `draws` of the weights, and a policy that has it.
    ///
    /// Branch and bound over pairs of ways: the loss from one start alone, which has half the weight, is a bound from below for every
    /// pair. Pairs that disagree where they meet are no policy.
    pub fn safest(&self, draws: &[f64], alpha: f64) -> (f64, Vec<usize>) {
        let losses = [0, 1].map(|start| half_losses(&self.ways[start], draws));
        let order = [0, 1].map(|start| {
            let mut order: Vec<(f64, usize)> =
                losses[start].iter().map(|(way, losses)| (quantile(losses.iter().copied(), alpha), *way)).collect();
            order.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
            order
        });
        let mut least: Option<(f64, Vec<usize>)> = None;
        for &(alone, a) in &order[0] {
            if least.as_ref().is_some_and(|least| alone >= least.0) {
                break;
            }
            for &(alone, b) in &order[1] {
                if least.as_ref().is_some_and(|least| alone >= least.0) {
                    break;
                }
                let Some(policy) = self.policy(a, b) else { continue };
                let sums = losses[0][&a].iter().zip(&losses[1][&b]).map(|(x, y)| x + y);
                let risk = quantile(sums, alpha);
                if least.as_ref().is_none_or(|least| risk < least.0) {
                    least = Some((risk, policy));
                }
            }
        }
        least.expect("going to the end by the same way from both starts is a policy")
    }

    /// The policy that follows both ways, if they agree wherever they meet.
    fn policy(&self, a: usize, b: usize) -> Option<Vec<usize>> {
        let mut policy = self.elsewhere.clone();
        for &(state, action) in &self.ways[0][a].1 {
            policy[state] = action;
        }
        for &(state, action) in &self.ways[1][b].1 {
            let met = self.ways[0][a].1.iter().find(|step| step.0 == state);
            if met.is_some_and(|step| step.1 != action) {
                return None;
            }
            policy[state] = action;
        }
        Some(policy)
    }
}

/// Extends a way by every action; finished ones are found by their feature counts, rounded.
fn follow(mdp: &Mdp, state: usize, way: &mut Way, found: &mut HashMap<[i64; 2], ([f64; 2], Way)>) {
    let finished = mdp.is_terminal(state) || way.iter().any(|step| step.0 == state);
    if finished {
        let counts = counts(mdp, way, state);
        let key = counts.map(|count| (count * 1e9).round() as i64);
        found.entry(key).or_insert_with(|| (counts, way.clone()));
        return;
    }
    for action in 0..mdp.n_actions() {
        let (next, _) = mdp.successors(state, action).next().expect("a state that is no end leads somewhere");
        way.push((state, action));
        follow(mdp, next, way, found);
        way.pop();
    }
}

/// Discounted feature counts of a way that comes to `last`: an end, or a state of the way that it repeats from.
fn counts(mdp: &Mdp, way: &Way, last: usize) -> [f64; 2] {
    let phi = |state: usize| [mdp.features(state, 0)[0], mdp.features(state, 0)[1]];
    let repeats_from = way.iter().position(|step| step.0 == last);
    let mut sums = [0.0; 2];
    let mut discount = 1.0;
    let add = |sums: &mut [f64; 2], state: usize, discount: f64| {
        let phi = phi(state);
        sums[0] += discount * phi[0];
        sums[1] += discount * phi[1];
    };
    let (mut cycle, mut cycle_length) = ([0.0; 2], 0.0);
    for (i, &(state, _)) in way.iter().enumerate() {
        if repeats_from.is_some_and(|from| i >= from) {
            add(&mut cycle, state, discount);
            cycle_length += 1.0;
        } else {
            add(&mut sums, state, discount);
        }
        discount *= mdp.gamma();
    }
    match repeats_from {
        None => add(&mut sums, last, discount),
        Some(_) => {
            // The cycle again and again: a geometric series.
            let again = 1.0 / (1.0 - libm::pow(mdp.gamma(), cycle_length));
            sums[0] += again * cycle[0];
            sums[1] += again * cycle[1];
        }
    }
    sums
}

/// Indices of the ways that no other is at least as good as under every draw. Draws of two weights between two directions less than
/// half a turn apart: better under both is better under all.
fn undominated(ways: &[([f64; 2], Way)], draws: &[f64]) -> Vec<usize> {
    let mut rays: Vec<[f64; 2]> = draws.chunks_exact(2).map(|w| [w[0], w[1]]).collect();
    let middle = rays.iter().fold([0.0; 2], |sum, w| [sum[0] + w[0], sum[1] + w[1]]);
    let turn = |w: &[f64; 2]| libm::atan2(middle[0] * w[1] - middle[1] * w[0], middle[0] * w[0] + middle[1] * w[1]);
    rays.sort_by(|a, b| turn(a).total_cmp(&turn(b)));
    let (Some(first), Some(last)) = (rays.first().copied(), rays.last().copied()) else {
        return (0..ways.len()).collect();
    };
    if turn(&last) - turn(&first) >= std::f64::consts::PI {
        return (0..ways.len()).collect();
    }
    let worth = |counts: &[f64; 2]| [first, last].map(|w| w[0] * counts[0] + w[1] * counts[1]);
    let mut order: Vec<(usize, [f64; 2])> = ways.iter().enumerate().map(|(i, way)| (i, worth(&way.0))).collect();
    order.sort_by(|a, b| b.1[0].total_cmp(&a.1[0]).then(b.1[1].total_cmp(&a.1[1])));
    let mut kept = Vec::new();
    let mut best = f64::NEG_INFINITY;
    for (i, worth) in order {
        if worth[1] > best {
            best = worth[1];
            kept.push(i);
        }
    }
    kept
}

/// Half of the loss from one start under every draw, for every way that is not dominated.
fn half_losses(ways: &[([f64; 2], Way)], draws: &[f64]) -> BTreeMap<usize, Vec<f64>> {
    let kept = undominated(ways, draws);
    let worth = |w: &[f64], way: usize| 0.5 * (w[0] * ways[way].0[0] + w[1] * ways[way].0[1]);
    let best: Vec<f64> = draws
        .chunks_exact(2)
        .map(|w| kept.iter().map(|&way| worth(w, way)).fold(f64::NEG_INFINITY, f64::max))
        .collect();
    let losses = |way: usize| draws.chunks_exact(2).zip(&best).map(|(w, best)| best - worth(w, way)).collect();
    kept.iter().map(|&way| (way, losses(way))).collect()
}

/// The empirical α-value at risk.
fn quantile(losses: impl Iterator<Item = f64>, alpha: f64) -> f64 {
    let mut losses: Vec<f64> = losses.collect();
    let n = losses.len();
    let rank = (libm::ceil(alpha * n as f64 - 1e-9) as usize).clamp(1, n);
    let (_, value, _) = losses.select_nth_unstable_by(rank - 1, f64::total_cmp);
    *value
}

#[cfg(test)]
mod tests {
    use super::EveryPolicy;
    use mdp::worlds::maze;
    use mdp::{Policy, feature_counts, policy_losses};

    /// Every way's feature counts are those of a policy that follows it, and no policy tried at random is safer than the safest.
    #[test]
    fn the_safest_of_all_is_a_policy_with_that_risk() {
        let mdp = maze::world().mdp().expect("a world");
        let every = EveryPolicy::of(&mdp, maze::STARTS);
        let draws: Vec<f64> =
            (0..200).flat_map(|i| [-0.5 + 0.002 * f64::from(i), -0.5 - 0.002 * f64::from(i)]).collect();
        let (risk, policy) = every.safest(&draws, 0.9);
        let counts = feature_counts(&mdp, &Policy::Deterministic(policy)).expect("a policy");
        let mut losses = policy_losses(&mdp, &counts, &draws, 1).expect("losses");
        losses.sort_by(f64::total_cmp);
        assert!((losses[179] - risk).abs() < 1e-9, "{} {risk}", losses[179]);
    }
}
