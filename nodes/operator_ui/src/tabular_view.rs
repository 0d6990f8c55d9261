//! Messages about a world as the pages see them: checked, with `null` for what is not finite.

use crate::protocol::{
    BoundView, FrontierView, PictureView, PointView, PolicyView, RobustBoundsView, WayView, WeightView,
    WorldQuestionView, WorldView,
};
use crate::view::finite;
use apprentice_msgs::msg::{PolicyBounds, PolicyFrontier, Posterior, RiskBound, RobustPolicy, WorldQuery};
use exchange::{Picture, ROBUST_POLICY, World, check_posterior};

/// More states than this are not drawn.
pub(crate) const MAX_DRAWN: usize = 2500;
/// Longer reasons are cut, characters.
const MAX_REASON: usize = 2000;
/// More weights than this are not listed.
const MAX_WEIGHTS: usize = 64;
/// More points than this are not drawn.
const MAX_POINTS: usize = 500;

/// A world, with a picture when it can be drawn.
pub(crate) fn world_view(world: &World) -> WorldView {
    let mdp = &world.mdp;
    let n_actions = mdp.n_actions();
    let drawn = mdp.n_states() <= MAX_DRAWN;
    let picture = match world.picture {
        Picture::Cells { rows, columns } if drawn => {
            let shift = |from: usize, to: usize| {
                [to / columns, to % columns].map(|x| x as f64).into_iter().zip([from / columns, from % columns])
            };
            let moves = (0..n_actions).map(|action| {
                let mut sum = [0.0; 2];
                for from in 0..mdp.n_states() {
                    for (to, p) in mdp.successors(from, action) {
                        for (sum, (to, from)) in sum.iter_mut().zip(shift(from, to)) {
                            *sum += p * (to - from as f64);
                        }
                    }
                }
                let length = f64::hypot(sum[0], sum[1]);
                if length > 1e-9 { sum.map(|x| x / length) } else { [0.0; 2] }
            });
            PictureView::Cells { rows, columns, moves: moves.collect() }
        }
        Picture::Road { lanes, places } if drawn => {
            let lane = |state: usize| (state / ((lanes - 2) * places)) as f64;
            let moves = (0..n_actions).map(|action| {
                let steps =
                    (0..mdp.n_states()).flat_map(|from| mdp.successors(from, action).map(move |(to, p)| (from, to, p)));
                let sum: f64 = steps.map(|(from, to, p)| p * (lane(to) - lane(from))).sum();
                if sum.abs() > 1e-9 { sum.signum() } else { 0.0 }
            });
            PictureView::Road { lanes, places, moves: moves.collect() }
        }
        _ => PictureView::None,
    };
    let states = if picture == PictureView::None { 0 } else { mdp.n_states() };
    let largest = |state: usize| {
        let features = mdp.features(state, 0);
        let best = (0..features.len()).max_by(|&a, &b| features[a].total_cmp(&features[b]).then(b.cmp(&a)))?;
        (features[best] > 0.0).then_some(best)
    };
    let actions = if mdp.actions().is_empty() {
        (0..n_actions).map(|action| format!("action {action}")).collect()
    } else {
        mdp.actions().to_vec()
    };
    WorldView {
        id: world.id.clone(),
        hash: world.hash.clone(),
        picture,
        n_states: mdp.n_states(),
        actions,
        features: world.feature_names.clone(),
        cells: (0..states).map(largest).collect(),
        starts: (0..states).filter(|&state| mdp.initial()[state] > 0.0).collect(),
        terminals: (0..states).filter(|&state| mdp.is_terminal(state)).collect(),
    }
}

/// A question that was checked; whether it is open is for the caller to say.
pub(crate) fn world_question_view(query: &WorldQuery, open: bool) -> WorldQuestionView {
    WorldQuestionView {
        id: query.id.clone(),
        revision: query.revision,
        kind: match query.kind {
            WorldQuery::ACTION => "action",
            WorldQuery::CRITIQUE => "critique",
            _ => "comparison",
        },
        state: query.state,
        ways: query
            .trajectories
            .iter()
            .map(|way| WayView { id: way.id.clone(), states: way.states.clone(), actions: way.actions.clone() })
            .collect(),
        reason: query.reason.chars().take(MAX_REASON).collect(),
        held_out: query.held_out,
        n_candidates: query.n_candidates,
        open,
    }
}

fn outcome(outcome: u8) -> &'static str {
    match outcome {
        RobustPolicy::OPTIMAL => "optimal",
        RobustPolicy::INACCURATE => "inaccurate",
        RobustPolicy::ITERATION_LIMIT => "iteration_limit",
        RobustPolicy::TIMED_OUT => "timed_out",
        RobustPolicy::INFEASIBLE => "infeasible",
        RobustPolicy::UNBOUNDED => "unbounded",
        RobustPolicy::CONSTRAINTS_VIOLATED => "constraints_violated",
        RobustPolicy::NOT_COMPUTED => "not_computed",
        _ => "unknown",
    }
}

fn objective(objective: u8) -> &'static str {
    match objective {
        RobustPolicy::ROBUST => "robust",
        RobustPolicy::REGRET => "regret",
        RobustPolicy::EVD => "evd",
        _ => "unknown",
    }
}

/// What the robot would do; its table only when it can be drawn.
pub(crate) fn policy_view(message: &RobustPolicy) -> PolicyView {
    let drawn = message.n_states as usize <= MAX_DRAWN;
    let interval = [message.held_out_cvar_low, message.held_out_cvar_high];
    PolicyView {
        revision: message.revision,
        outcome: outcome(message.outcome),
        reason: message.reason.clone(),
        objective: objective(message.objective),
        alpha: finite(message.alpha),
        lambda: finite(message.lambda),
        preference_id: message.preference_id.clone(),
        gap: finite(message.gap),
        expected_return: finite(message.expected_return),
        value_at_risk: finite(message.value_at_risk),
        conditional_value_at_risk: finite(message.conditional_value_at_risk),
        n_draws: message.n_draws,
        held_out: message.held_out,
        held_out_cvar: finite(message.held_out_cvar),
        held_out_interval: interval.iter().all(|x| x.is_finite()).then_some(interval),
        confidence: finite(message.confidence),
        table: if drawn { message.action_probabilities.clone() } else { Vec::new() },
        visits: if drawn { message.visits.clone() } else { Vec::new() },
    }
}

/// What every caution buys; tables only when their number fits.
pub(crate) fn frontier_view(message: &PolicyFrontier) -> FrontierView {
    let points = message.points.iter().take(MAX_POINTS).filter(|point| point.lambda.is_finite());
    let points: Vec<PointView> = points
        .map(|point| PointView {
            lambda: point.lambda,
            optimal: point.outcome == RobustPolicy::OPTIMAL,
            expected_return: finite(point.expected_return),
            value_at_risk: finite(point.value_at_risk),
            conditional_value_at_risk: finite(point.conditional_value_at_risk),
        })
        .collect();
    let numbers = (points.len() as u64) * u64::from(message.n_states) * u64::from(message.n_actions);
    let fits = message.policies.len() as u64 == numbers && message.policies.iter().all(|p| (0.0..=1.0).contains(p));
    FrontierView {
        revision: message.revision,
        outcome: outcome(message.outcome),
        reason: message.reason.clone(),
        objective: objective(message.objective),
        alpha: finite(message.alpha),
        tables: if fits { message.policies.clone() } else { Vec::new() },
        points,
    }
}

/// The bounds on the robot's policy, if these are of it.
pub(crate) fn robust_bounds_view(message: &PolicyBounds) -> Option<RobustBoundsView> {
    if !message.set_id.starts_with("robust-") {
        return None;
    }
    let robust = message.policies.iter().find(|policy| policy.id == ROBUST_POLICY)?;
    let mean = message.policies.iter().find(|policy| policy.id == "mean");
    let bound = |of: &RiskBound| BoundView {
        bound: finite(of.bound).filter(|_| of.outcome == RiskBound::BOUND),
        reason: of.reason.clone(),
    };
    Some(RobustBoundsView {
        revision: message.revision,
        set_id: message.set_id.clone(),
        least_return: bound(&robust.return_bound),
        loss: bound(&robust.loss_bound),
        normalised_loss: bound(&robust.normalised_loss),
        least_return_of_mean: mean
            .map_or(BoundView { bound: None, reason: String::new() }, |mean| bound(&mean.return_bound)),
        alpha: finite(message.alpha),
        delta: finite(message.delta),
        look: message.look,
        delta_spent: finite(message.delta_spent),
        n: message.n,
        n_chains: message.n_chains,
        ess_min: finite(message.ess_min),
        rhat_max: finite(message.rhat_max),
        acceptance: finite(message.acceptance),
        prior: message.prior.clone(),
        evidence_hash: message.evidence_hash.clone(),
        seed: message.seed.to_string(),
        version: message.version.clone(),
    })
}

/// What each weight may be, in a lesson about a world.
pub(crate) fn weights_view(message: &Posterior) -> Vec<WeightView> {
    let k = message.feature_names.len();
    if k > MAX_WEIGHTS || check_posterior(message).is_err() {
        return Vec::new();
    }
    let weight = |(i, name): (usize, &String)| {
        let mut values: Vec<f64> = message.draws.iter().skip(i).step_by(k).map(|&w| f64::from(w)).collect();
        let n = values.len();
        let mean = values.iter().sum::<f64>() / n as f64;
        values.sort_by(f64::total_cmp);
        let at = |share: f64| values[((share * n as f64) as usize).min(n - 1)];
        WeightView { name: shown_name(message, name), mean, low: at(0.05), high: at(0.95) }
    };
    message.feature_names.iter().enumerate().map(weight).collect()
}

/// A thing on the table by its label, where no other is called the same.
fn shown_name(message: &Posterior, name: &str) -> String {
    let objects = &message.task.objects;
    let label = objects.iter().find(|object| object.id == name).map(|object| object.label.as_str()).unwrap_or_default();
    let is_unique = objects.iter().filter(|object| object.label == label).count() == 1;
    if label.is_empty() || !is_unique { name.to_owned() } else { label.to_owned() }
}
