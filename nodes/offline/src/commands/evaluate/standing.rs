//! Where each policy stands among those it was judged with.

use risk::{Tail, rank_policies};

use crate::OfflineError;
use crate::judgement::Judgement;

/// Its places, from 1, and whether it deserves distrust.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Standing {
    /// By lower bound on the return (by value at risk where there is none).
    pub(super) rank: usize,
    /// By mean return.
    pub(super) rank_by_mean: usize,
    /// Share of the draws under which no other policy has a higher return.
    pub(super) probability_best: f64,
    pub(super) warning: Option<String>,
}

/// One for each policy. `returns` are draws of their returns, `judged` what those say; `delta` is for all policies together.
pub(super) fn standings(
    returns: &[Vec<f64>],
    judged: &[Judgement],
    n_chains: usize,
    alpha: f64,
    delta: f64,
) -> Result<Vec<Standing>, OfflineError> {
    let means: Vec<f64> = judged.iter().map(|judgement| judgement.mean).collect();
    let mut by_mean: Vec<usize> = (0..judged.len()).collect();
    by_mean.sort_by(|a, b| means[*b].total_cmp(&means[*a]).then(a.cmp(b)));
    let mut standings = vec![Standing { rank: 0, rank_by_mean: 0, probability_best: 0.0, warning: None }; judged.len()];
    for (place, policy) in by_mean.into_iter().enumerate() {
        standings[policy].rank_by_mean = place + 1;
    }
    if judged.iter().any(|judgement| judgement.ess.is_none()) || n_chains < crate::judgement::MIN_CHAINS {
        // Too few draws or chains to judge mixing: places by estimates alone.
        let mut order: Vec<usize> = (0..judged.len()).collect();
        let estimate = |policy: usize| judged[policy].point_estimate;
        order
            .sort_by(|a, b| estimate(*b).total_cmp(&estimate(*a)).then(means[*b].total_cmp(&means[*a])).then(a.cmp(b)));
        for (place, policy) in order.into_iter().enumerate() {
            standings[policy].rank = place + 1;
        }
        for draw in 0..returns[0].len() {
            let best = returns.iter().map(|returns| returns[draw]).fold(f64::NEG_INFINITY, f64::max);
            let n_best = returns.iter().filter(|returns| returns[draw] == best).count();
            for (standing, returns) in standings.iter_mut().zip(returns) {
                if returns[draw] == best {
                    standing.probability_best += 1.0 / (n_best * returns.len()) as f64;
                }
            }
        }
        return Ok(standings);
    }
    let policies: Vec<&[f64]> = returns.iter().map(Vec::as_slice).collect();
    let ranking = rank_policies(&policies, n_chains, None, alpha, delta, Tail::Lower)?;
    for (place, ranked) in ranking.policies.iter().enumerate() {
        let standing = &mut standings[ranked.policy];
        (standing.rank, standing.probability_best) = (place + 1, ranked.probability_best);
        standing.warning = ranked.warning.map(|warning| {
            format!(
                "its mean return {:.4} beats the others' {:.4}, but what is certain of it falls short of their {:.4}: it may \
                 exploit what the evidence does not say, as policies that do nothing can",
                ranked.mean, warning.others_mean, warning.others_floor
            )
        });
    }
    Ok(standings)
}

#[cfg(test)]
mod tests {
    use super::standings;
    use crate::judgement::Draws;
    use risk::{Measure, Tail};

    #[test]
    fn places_come_from_estimates_where_there_are_few_draws() {
        let returns = vec![vec![1.0, 2.0], vec![0.0, 5.0], vec![1.0, 1.5]];
        let judged: Vec<_> = returns
            .iter()
            .map(|values| {
                let draws = Draws { values, n_chains: 1, weights: None, tail: Tail::Lower };
                draws.judge(Measure::ValueAtRisk { alpha: 0.9 }, 0.9, 0.05, None).expect("an answer")
            })
            .collect();
        let found = standings(&returns, &judged, 1, 0.9, 0.05).expect("places");
        assert_eq!(found.iter().map(|s| s.rank).collect::<Vec<_>>(), [1, 3, 2]);
        assert_eq!(found.iter().map(|s| s.rank_by_mean).collect::<Vec<_>>(), [2, 1, 3]);
        assert_eq!(found.iter().map(|s| s.probability_best).collect::<Vec<_>>(), [0.25, 0.5, 0.25]);
    }
}
