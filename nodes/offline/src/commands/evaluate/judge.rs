//! Losses, returns and bounds of every policy.

use mdp::{Mdp, Policy, feature_counts, policy_losses};
use risk::{Measure, Reference, Tail, normalised_losses};

use super::Arguments;
use super::expert::{Expert, hoeffding};
use super::policies::{Form, Judged, dot, of_feature_counts, of_policies, of_rollouts, read_counts};
use super::standing::{Standing, standings};
use super::worst::{Family, WorstLosses};
use crate::OfflineError;
use crate::evidence::flag;
use crate::files::{Table, Wanted, read_mdp, read_trajectories};
use crate::judgement::{Draws, Judgement, Levels, n_chains};
use crate::sampling::available_threads;

/// Losses below zero by no more than this share of the best return are rounding.
const ROUNDING: f64 = 1e-9;
/// Least loss of the reference policy that divides, as a share of its mean.
const FLOOR_SHARE: f64 = 0.01;
/// The reference policy of normalised losses.
const REFERENCE: &str = "uniform random";

/// Everything that was found.
#[derive(Debug)]
pub(super) struct Evaluation {
    pub(super) n_draws: usize,
    pub(super) n_features: usize,
    pub(super) n_chains: usize,
    pub(super) levels: Levels,
    /// δ of each bound of one kind.
    pub(super) delta_each: f64,
    pub(super) policies: Vec<Found>,
    /// Floor under the losses of the reference policy, and draws in which it divides.
    pub(super) floor: Option<(f64, usize)>,
    pub(super) expert: Option<Expert>,
    pub(super) n_demonstrations: Option<u64>,
    pub(super) hoeffding: Option<f64>,
    pub(super) warnings: Vec<String>,
}

/// What was found of one policy.
#[derive(Debug)]
pub(super) struct Found {
    pub(super) judged: Judged,
    /// V* − V^π under each draw.
    pub(super) losses: Option<Vec<f64>>,
    pub(super) loss: Option<Bounds>,
    pub(super) returns: Bounds,
    /// Loss as a share of that of the reference policy.
    pub(super) normalised_loss: Option<Judgement>,
    /// Of the mean return over rollouts, under the mean weights.
    pub(super) standard_error: Option<f64>,
    /// Worst-case feature count bound.
    pub(super) worst_case: Option<f64>,
    pub(super) standing: Standing,
    /// Place, from 1, by upper bound on the loss.
    pub(super) rank_by_loss: Option<usize>,
}

/// Bounds on one quantity.
#[derive(Debug)]
pub(super) struct Bounds {
    /// On the value at risk.
    pub(super) var: Judgement,
    /// On the conditional value at risk.
    pub(super) cvar: Judgement,
}

/// What losses are computed from.
struct Optimal {
    /// V* under each draw.
    values: Vec<f64>,
    /// Losses of the reference policy.
    reference: Vec<f64>,
    floor: f64,
    worst: Option<WorstLosses>,
}

impl Evaluation {
    /// Reads and judges everything that the arguments name.
    pub(super) fn of(arguments: &Arguments) -> Result<Self, OfflineError> {
        let levels = arguments.levels.check()?;
        let threads = threads(arguments)?;
        let mdp = arguments.mdp.as_ref().map(|path| read_mdp(path)).transpose()?;
        let columns = mdp.as_ref().map(|mdp| (mdp.n_features(), "one weight for each feature of --mdp"));
        let draws = Table::read(&arguments.draws, &Wanted { name: "weight", columns, largest: 1e100 })?;
        let k = draws.n_columns;
        let judged = read_policies(arguments, mdp.as_ref(), k)?;
        let mut warnings: Vec<String> = draws.suspicion().into_iter().collect();
        let n_chains = n_chains(&draws.file, draws.n_rows(), arguments.chains, levels.alpha, levels.delta_spent)?;
        let delta_each = levels.delta_spent / judged.len() as f64;
        let family = Family::of(&draws.values, k);
        let judge = Judge { alpha: levels.alpha, delta: delta_each, n_chains };
        let optimal = mdp.as_ref().map(|mdp| Optimal::of(mdp, &draws, family, threads, arguments)).transpose()?;
        let (expert, n_demonstrations) = read_expert(arguments, mdp.as_ref(), k)?;

        let returns: Vec<Vec<f64>> = judged
            .iter()
            .map(|policy| draws.values.chunks_exact(k).map(|w| dot(w, &policy.counts)).collect())
            .collect();
        let bounds_on_returns = judged
            .iter()
            .zip(&returns)
            .map(|(policy, returns)| {
                let worst = arguments.worst_return.or_else(|| family.worst_return(&policy.counts));
                judge.bounds(returns, worst, Tail::Lower)
            })
            .collect::<Result<Vec<_>, _>>()?;
        let of_var: Vec<Judgement> = bounds_on_returns.iter().map(|bounds| bounds.var.clone()).collect();
        let standings = standings(&returns, &of_var, n_chains, levels.alpha, levels.delta_spent)?;
        let mean_weights: Vec<f64> =
            (0..k).map(|i| draws.values.iter().skip(i).step_by(k).sum::<f64>() / draws.n_rows() as f64).collect();

        let mut n_floored = 0;
        let mut policies = Vec::with_capacity(judged.len());
        for (((policy, returns), of_returns), standing) in
            judged.into_iter().zip(returns).zip(bounds_on_returns).zip(standings)
        {
            let losses = optimal.as_ref().map(|optimal| optimal.losses(&policy, &returns, &mut warnings));
            let mut found = Found {
                loss: None,
                normalised_loss: None,
                returns: of_returns,
                standard_error: policy.return_standard_error(&mean_weights),
                worst_case: expert.as_ref().map(|expert| expert.worst_case(&policy.counts)).transpose()?,
                standing,
                losses: None,
                rank_by_loss: None,
                judged: policy,
            };
            if let (Some(optimal), Some(losses)) = (&optimal, losses) {
                let worst = arguments.worst_loss.or_else(|| Some(optimal.worst.as_ref()?.of(&found.judged.counts)));
                found.loss = Some(judge.bounds(&losses, worst, Tail::Upper)?);
                let reference = Reference { name: REFERENCE, losses: &optimal.reference };
                let normalised = normalised_losses(&losses, &reference, optimal.floor)?;
                n_floored = normalised.n_floored;
                found.normalised_loss = Some(judge.quantile(&normalised.values, Tail::Upper)?);
                found.losses = Some(losses);
            }
            if let Some(warning) = &found.standing.warning {
                warnings.push(format!("{}: {warning}", found.judged.name));
            }
            policies.push(found);
        }
        rank_by_loss(&mut policies);
        let mut hoeffding_bound = None;
        if let (Some(mdp), Some(n)) = (&mdp, n_demonstrations) {
            let (bound, warning) = hoeffding(mdp, n, levels.delta_spent)?;
            hoeffding_bound = Some(bound);
            warnings.extend(warning);
        }
        Ok(Self {
            n_draws: draws.n_rows(),
            n_features: k,
            n_chains,
            levels,
            delta_each,
            policies,
            floor: optimal.map(|optimal| (optimal.floor, n_floored)),
            expert,
            n_demonstrations,
            hoeffding: hoeffding_bound,
            warnings,
        })
    }

    /// Name of the reference policy of normalised losses.
    pub(super) fn reference() -> &'static str {
        REFERENCE
    }
}

/// With which confidence bounds hold.
struct Judge {
    alpha: f64,
    delta: f64,
    n_chains: usize,
}

impl Judge {
    fn quantile(&self, values: &[f64], tail: Tail) -> Result<Judgement, OfflineError> {
        let draws = Draws { values, n_chains: self.n_chains, weights: None, tail };
        draws.judge(Measure::ValueAtRisk { alpha: self.alpha }, self.alpha, self.delta, None)
    }

    fn bounds(&self, values: &[f64], worst: Option<f64>, tail: Tail) -> Result<Bounds, OfflineError> {
        let draws = Draws { values, n_chains: self.n_chains, weights: None, tail };
        let cvar = Measure::ConditionalValueAtRisk { alpha: self.alpha };
        Ok(Bounds { var: self.quantile(values, tail)?, cvar: draws.judge(cvar, self.alpha, self.delta, worst)? })
    }
}

impl Optimal {
    fn of(
        mdp: &Mdp,
        draws: &Table,
        family: Family,
        threads: usize,
        arguments: &Arguments,
    ) -> Result<Self, OfflineError> {
        let wrong = |error| OfflineError::Mdp { file: arguments.draws.display().to_string(), error };
        // The loss of a policy that collects nothing is the best return: each draw is solved once, however many policies.
        let values = policy_losses(mdp, &vec![0.0; mdp.n_features()], &draws.values, threads).map_err(wrong)?;
        let counts = feature_counts(mdp, &Policy::uniform(mdp)).map_err(wrong)?;
        let reference: Vec<f64> = values
            .iter()
            .zip(draws.values.chunks_exact(mdp.n_features()))
            .map(|(best, w)| f64::max(best - dot(w, &counts), 0.0))
            .collect();
        let mean = reference.iter().sum::<f64>() / reference.len() as f64;
        let floor = match arguments.floor {
            Some(floor) if floor > 0.0 && floor.is_finite() => floor,
            Some(floor) => return Err(flag("--floor", format!("got {floor}, expected a positive number"))),
            None => (FLOOR_SHARE * mean).max(f64::MIN_POSITIVE),
        };
        let worst = match arguments.worst_loss {
            Some(_) => None,
            None => WorstLosses::new(mdp, family, threads).map_err(wrong)?,
        };
        Ok(Self { values, reference, floor, worst })
    }

    /// Losses of a policy; warns where the counts that were given for it are more than any policy collects.
    fn losses(&self, policy: &Judged, returns: &[f64], warnings: &mut Vec<String>) -> Vec<f64> {
        let mut losses: Vec<f64> = self.values.iter().zip(returns).map(|(best, got)| best - got).collect();
        let is_rounding = |loss: f64, best: f64| loss > -ROUNDING * best.abs().max(1.0);
        let n_better = losses.iter().zip(&self.values).filter(|(loss, best)| !is_rounding(**loss, **best)).count();
        if policy.form == Form::Tabular || n_better == 0 {
            losses.iter_mut().for_each(|loss| *loss = loss.max(0.0));
        } else {
            warnings.push(format!(
                "{}: under {n_better} draws its feature counts are worth more than the best policy of --mdp: are they of that \
                 process, and discounted as it does?",
                policy.name
            ));
        }
        losses
    }
}

/// Fills in the places by upper bound on the loss: those with a bound first, the others by their value at risk.
fn rank_by_loss(policies: &mut [Found]) {
    let key = |found: &Found| {
        let var = &found.loss.as_ref()?.var;
        Some((var.bound.is_none(), var.bound.unwrap_or(var.point_estimate), var.mean))
    };
    let mut order: Vec<(usize, (bool, f64, f64))> =
        policies.iter().enumerate().filter_map(|(i, found)| Some((i, key(found)?))).collect();
    order.sort_by(|(i, a), (j, b)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.total_cmp(&b.2)).then(i.cmp(j)));
    for (place, (policy, _)) in order.into_iter().enumerate() {
        policies[policy].rank_by_loss = Some(place + 1);
    }
}

fn threads(arguments: &Arguments) -> Result<usize, OfflineError> {
    let threads = arguments.threads.unwrap_or_else(available_threads);
    if posterior::THREADS_RANGE.contains(&threads) {
        return Ok(threads);
    }
    Err(flag("--threads", format!("got {threads}, expected 1 to {}", posterior::THREADS_RANGE.end())))
}

fn read_policies(arguments: &Arguments, mdp: Option<&Mdp>, k: usize) -> Result<Vec<Judged>, OfflineError> {
    let mut judged = match mdp {
        Some(mdp) => of_policies(&arguments.policy, mdp)?,
        None => Vec::new(),
    };
    judged.append(&mut of_feature_counts(&arguments.feature_counts, k)?);
    judged.append(&mut of_rollouts(&arguments.trajectories, k)?);
    if judged.is_empty() {
        return Err(flag("policies", "got none, expected --policy, --feature-counts or --trajectories"));
    }
    Ok(judged)
}

type KnownExpert = (Option<Expert>, Option<u64>);

/// The expert's feature counts and the number of demonstrations, where they are known.
fn read_expert(arguments: &Arguments, mdp: Option<&Mdp>, k: usize) -> Result<KnownExpert, OfflineError> {
    if arguments.n_demonstrations == Some(0) {
        return Err(flag("--n-demonstrations", "got 0, expected at least 1"));
    }
    if let (Some(path), Some(mdp)) = (&arguments.demonstrations, mdp) {
        let trajectories = read_trajectories(path, mdp)?;
        let n = arguments.n_demonstrations.unwrap_or(trajectories.len() as u64);
        return Ok((Some(Expert::of_trajectories(&trajectories, mdp)), Some(n)));
    }
    let Some(path) = &arguments.expert_features else { return Ok((None, arguments.n_demonstrations)) };
    let table = read_counts(path, "feature count", k)?;
    if table.n_rows() != 1 {
        let (what, got, expected, other) = ("rows", table.n_rows(), 1, "one expert".to_owned());
        return Err(OfflineError::Widths { file: table.file, what, got, other, expected });
    }
    Ok((Some(Expert { counts: table.values }), arguments.n_demonstrations))
}
