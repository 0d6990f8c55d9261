//! Policies judged against each other under one posterior: a function of the settings and the messages alone.

use crate::Settings;
use crate::policy_loss::Losses;
use crate::risk_message::{not_judged, not_mixed, risk_message};
use apprentice_msgs::msg::{PolicyBound, PolicyBounds, PolicySet, Posterior, RiskBound};
use exchange::{Form, World, check_policies};
use mdp::feature_counts;
use risk::{ErrorBudget, RankedPolicy, Tail, rank_policies};
use std::borrow::Cow;

/// Bounds on every policy of a set. `world` is the one that the posterior names, if it names one.
///
/// All bounds on policies of a session hold together: look t at set number s spends 36 δ / (π⁴ t² s²), which its bounds share.
///
/// # Errors
/// What is wrong with the set: its policies are judged together or not at all.
pub fn judge_policies(
    settings: &Settings,
    posterior: &Posterior,
    set: &PolicySet,
    world: Option<&World>,
) -> Result<PolicyBounds, String> {
    let posterior = &*judges(posterior, set.draws_used)?;
    let k = posterior.feature_names.len();
    let checked = check_policies(set, k, world).map_err(|error| error.to_string())?;
    let world = world.filter(|world| world.mdp.n_features() == k);
    let look = posterior.revision + 1;
    let n_measures = if world.is_some() { 4 } else { 1 };
    let budget = ErrorBudget::new(settings.delta).map_err(|error| error.to_string())?;
    let share = budget.at_look(look).at_look(set.number).shared_by(n_measures).delta();

    let draws: Vec<f64> = posterior.draws.iter().map(|&w| f64::from(w)).collect();
    let judged =
        checked.iter().map(|policy| Judged::new(&policy.form, world, &draws, k)).collect::<Result<Vec<_>, _>>()?;
    let n_chains = posterior.n_chains as usize;
    let returns: Vec<&[f64]> = judged.iter().map(|judged| judged.returns.as_slice()).collect();
    let alpha = settings.alpha;
    let ranking =
        rank_policies(&returns, n_chains, None, alpha, share, Tail::Lower).map_err(|error| error.to_string())?;
    let delta = ranking.delta_each;
    let losses = world.map(|world| Losses::new(settings, posterior, world, &draws, delta)).transpose()?;

    let mut bounds: Vec<PolicyBound> = Vec::with_capacity(checked.len());
    for (policy, judged) in checked.iter().zip(&judged) {
        let (form, n_rollouts) = match &policy.form {
            Form::FeatureCounts(_) => (0, 0),
            Form::Tabular(_) => (1, 0),
            Form::Rollouts(rollouts) => (2, rollouts.len() as u64),
        };
        let [loss_bound, loss_cvar, normalised_loss] = match &losses {
            Some(losses) => losses.bounds(&judged.counts, &judged.returns)?,
            None => [(); 3].map(|()| not_judged("no bound, because this lesson is about no world to lose anything in")),
        };
        bounds.push(PolicyBound {
            id: policy.id.clone(),
            form,
            feature_counts: judged.counts.clone(),
            n_rollouts,
            rollout_standard_error: standard_error(&policy.form, &draws, k),
            loss_bound,
            loss_cvar,
            normalised_loss,
            ..PolicyBound::default()
        });
    }
    for (place, ranked) in (1..).zip(&ranking.policies) {
        let bound = &mut bounds[ranked.policy];
        bound.return_bound = risk_message(&ranked.outcome);
        bound.probability_best = ranked.probability_best;
        bound.rank = place;
        bound.warning = warning(ranked);
    }
    rank_by_mean(&mut bounds);
    if posterior.outcome != Posterior::READY {
        let reason = &posterior.reason;
        for bound in &mut bounds {
            for one in
                [&mut bound.return_bound, &mut bound.loss_bound, &mut bound.loss_cvar, &mut bound.normalised_loss]
            {
                *one = not_mixed(std::mem::take(one), reason);
            }
        }
    }
    Ok(receipt(settings, posterior, set, world, delta, bounds))
}

/// The posterior with those draws alone that did not choose the policies: a policy looks better to the draws it was chosen
/// by, and a bound of these would not hold.
fn judges(posterior: &Posterior, draws_used: u32) -> Result<Cow<'_, Posterior>, String> {
    if draws_used == 0 {
        return Ok(Cow::Borrowed(posterior));
    }
    let k = posterior.feature_names.len();
    let per_chain = posterior.n_draws / posterior.n_chains;
    let left = per_chain.checked_sub(draws_used).filter(|left| *left > 0).ok_or_else(|| {
        format!("its policies were chosen by {draws_used} draws of each chain, which has {per_chain}: none is left to judge them")
    })?;
    let later = |chain: &[f32]| chain[draws_used as usize * k..].to_vec();
    Ok(Cow::Owned(Posterior {
        n_draws: left * posterior.n_chains,
        draws: posterior.draws.chunks_exact(per_chain as usize * k).flat_map(later).collect(),
        ..posterior.clone()
    }))
}

/// What one policy collects, and its return under every draw.
struct Judged {
    counts: Vec<f64>,
    returns: Vec<f64>,
}

impl Judged {
    fn new(form: &Form, world: Option<&World>, draws: &[f64], k: usize) -> Result<Self, String> {
        let counts = match (form, world) {
            (Form::FeatureCounts(counts), _) => counts.clone(),
            // Mean of the rollouts (dissertation eq. E.4).
            (Form::Rollouts(rollouts), _) => {
                let sum = |i: usize| rollouts.iter().map(|rollout| rollout[i]).sum::<f64>();
                (0..k).map(|i| sum(i) / rollouts.len() as f64).collect()
            }
            (Form::Tabular(policy), Some(world)) => {
                feature_counts(&world.mdp, policy).map_err(|error| error.to_string())?
            }
            (Form::Tabular(_), None) => return Err("its tables are about another world".into()),
        };
        let returns = draws.chunks_exact(k).map(|w| dot(w, &counts)).collect();
        Ok(Self { counts, returns })
    }
}

/// Inner product.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Standard error of the mean return of rollouts under the mean weights; not a number without at least two.
fn standard_error(form: &Form, draws: &[f64], k: usize) -> f64 {
    let Form::Rollouts(rollouts) = form else { return f64::NAN };
    let n_draws = (draws.len() / k) as f64;
    let mean: Vec<f64> = (0..k).map(|i| draws.iter().skip(i).step_by(k).sum::<f64>() / n_draws).collect();
    let returns: Vec<f64> = rollouts.iter().map(|rollout| dot(rollout, &mean)).collect();
    let n = returns.len() as f64;
    let centre = returns.iter().sum::<f64>() / n;
    let squares: f64 = returns.iter().map(|x| (x - centre) * (x - centre)).sum();
    (squares / (n - 1.0) / n).sqrt()
}

fn warning(ranked: &RankedPolicy) -> String {
    let Some(warning) = ranked.warning else { return String::new() };
    format!(
        "its mean return, {:.4}, is above that of the others (median {:.4}), but what is certain of it, {:.4}, is below \
         (median {:.4}): it may profit from what the evidence does not say; compare a run of it with the others before \
         trusting it",
        ranked.mean,
        warning.others_mean,
        ranked.outcome.bound().unwrap_or(ranked.value_at_risk),
        warning.others_floor
    )
}

fn rank_by_mean(bounds: &mut [PolicyBound]) {
    let mut order: Vec<usize> = (0..bounds.len()).collect();
    order.sort_by(|&a, &b| bounds[b].return_bound.mean.total_cmp(&bounds[a].return_bound.mean));
    for (place, policy) in (1..).zip(order) {
        bounds[policy].rank_by_mean = place;
    }
}

fn receipt(
    settings: &Settings,
    posterior: &Posterior,
    set: &PolicySet,
    world: Option<&World>,
    delta_spent: f64,
    policies: Vec<PolicyBound>,
) -> PolicyBounds {
    let of_returns = || policies.iter().map(|policy| &policy.return_bound);
    let all = || policies.iter().flat_map(|p| [&p.return_bound, &p.loss_bound, &p.loss_cvar, &p.normalised_loss]);
    let outcome = of_returns().map(|bound| bound.outcome).find(|&outcome| outcome != RiskBound::BOUND);
    let finite = |pick: fn(&RiskBound) -> f64| all().map(pick).filter(|x| x.is_finite());
    PolicyBounds {
        header: posterior.header.clone(),
        revision: posterior.revision,
        set_id: set.id.clone(),
        set_number: set.number,
        world: world.map(World::reference).unwrap_or_default(),
        outcome: outcome.unwrap_or(RiskBound::BOUND),
        reason: reason(settings, &policies),
        alpha: settings.alpha,
        delta: settings.delta,
        look: posterior.revision + 1,
        delta_spent,
        n: u64::from(posterior.n_draws),
        n_chains: posterior.n_chains,
        ess_min: finite(|bound| bound.ess).fold(f64::INFINITY, f64::min),
        rhat_max: finite(|bound| bound.rhat).fold(posterior.rhat_max, f64::max),
        acceptance: posterior.acceptance,
        rationalities: posterior.rationalities.clone(),
        prior: posterior.prior.clone(),
        prior_scale: posterior.prior_scale,
        evidence_hash: posterior.evidence_hash.clone(),
        seed: posterior.seed,
        version: posterior.version.clone(),
        policies,
    }
}

/// The claim about the policy that ranks first, or why there is none.
fn reason(settings: &Settings, policies: &[PolicyBound]) -> String {
    if let Some(without) = policies.iter().find(|policy| policy.return_bound.outcome != RiskBound::BOUND) {
        return format!("policy '{}': {}", without.id, without.return_bound.reason);
    }
    let Some(best) = policies.iter().find(|policy| policy.rank == 1) else { return String::new() };
    let (sure, share) = (100.0 * (1.0 - settings.delta), 100.0 * settings.alpha);
    let loss = match best.loss_bound.outcome {
        RiskBound::BOUND => {
            format!(", and lose no more than {:.4} against the best that can be done", best.loss_bound.bound)
        }
        _ => String::new(),
    };
    format!(
        "{sure:.0} % sure: with policy '{}', which ranks first of {}, {share:.0} in 100 of the rewards that fit the evidence \
         return at least {:.4}{loss}",
        best.id,
        policies.len(),
        best.return_bound.bound
    )
}
