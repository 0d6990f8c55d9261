//! The node as a state machine: a posterior and the tables to judge in, bounds with their receipt out.

use crate::Settings;
use crate::policies::Policies;
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{
    Candidates, PerformanceBounds, PlacementBound, PolicyBounds, PolicySet, Posterior, TabularWorld,
};
use exchange::{check_posterior, is_about_scene, point_to_message, scene_from_message};
use placement::{LossBatch, placement_losses};
use risk::{Outcome, delta_spent, upper_bound};
use scene::Scene;

/// More tables than this are not judged in one look.
const MAX_SCENES: usize = 1000;

/// What reaches the node.
#[derive(Debug, Clone)]
pub enum Event {
    /// A new (or repeated) posterior.
    Posterior(Box<Posterior>),
    /// The tables to judge it on.
    Candidates(Box<Candidates>),
    /// A world: losses of policies are measured in it.
    World(Box<TabularWorld>),
    /// Policies to judge.
    Policies(Box<PolicySet>),
    /// Time to send the newest bounds again.
    Republish,
}

/// What the node sends.
#[derive(Debug, Clone)]
pub enum Output {
    /// The bounds of one look.
    Bounds(Box<PerformanceBounds>),
    /// The bounds on the policies of a set.
    PolicyBounds(Box<PolicyBounds>),
    /// Something a person should know.
    Warn(String),
}

/// See the crate.
pub struct PerformanceBoundsNode {
    settings: Settings,
    posterior: Option<Box<Posterior>>,
    candidates: Option<Box<Candidates>>,
    newest: Option<Box<PerformanceBounds>>,
    refused: Option<Box<Candidates>>,
    policies: Policies,
}

impl PerformanceBoundsNode {
    /// A node that has seen nothing.
    pub fn new(settings: Settings) -> Self {
        Self { settings, posterior: None, candidates: None, newest: None, refused: None, policies: Policies::default() }
    }

    /// Takes one event. Outputs depend on the settings and the messages alone, never on `_now`.
    pub fn step(&mut self, _now: Time, event: Event) -> Vec<Output> {
        let taken = match event {
            Event::Posterior(posterior) => match check_posterior(&posterior) {
                Ok(()) => {
                    self.posterior = Some(posterior);
                    Ok(())
                }
                Err(reason) => Err(format!("posterior {} is ignored: {reason}", posterior.revision)),
            },
            // Candidates are sent again until they are judged; what is wrong with them is said once.
            Event::Candidates(candidates) if self.refused.as_ref() == Some(&candidates) => Ok(()),
            Event::Candidates(candidates) => {
                self.candidates = Some(candidates);
                Ok(())
            }
            Event::World(world) => self.policies.take_world(&world),
            Event::Policies(set) => self.policies.take_set(set),
            Event::Republish => return self.republish(),
        };
        if let Err(text) = taken {
            return vec![Output::Warn(text)];
        }
        let mut outputs = self.tables();
        if let Some(posterior) = &self.posterior {
            outputs.extend(match self.policies.judge(&self.settings, posterior) {
                Some(Ok(bounds)) => Some(Output::PolicyBounds(bounds)),
                Some(Err(text)) => Some(Output::Warn(text)),
                None => None,
            });
        }
        outputs
    }

    fn republish(&mut self) -> Vec<Output> {
        let missing = self.policies.missing(self.posterior.as_deref()).map(Output::Warn);
        let bounds = self.newest.iter().cloned().map(Output::Bounds);
        bounds.chain(self.policies.newest().map(Output::PolicyBounds)).chain(missing).collect()
    }

    /// Bounds on the candidates, once there are some for the posterior at hand.
    fn tables(&mut self) -> Vec<Output> {
        let (Some(posterior), Some(candidates)) = (&self.posterior, &self.candidates) else { return Vec::new() };
        let judged = self.newest.as_ref().is_some_and(|newest| newest.revision == posterior.revision);
        if judged || posterior.revision != candidates.revision {
            return Vec::new();
        }
        match self.judge(posterior, candidates) {
            Ok(bounds) => {
                let bounds = Box::new(bounds);
                self.newest = Some(bounds.clone());
                vec![Output::Bounds(bounds)]
            }
            Err(reason) => {
                let warning = format!("the candidates of revision {} are ignored: {reason}", posterior.revision);
                self.refused = self.candidates.take();
                vec![Output::Warn(warning)]
            }
        }
    }

    fn judge(&self, posterior: &Posterior, candidates: &Candidates) -> Result<PerformanceBounds, String> {
        if candidates.scenes.is_empty() || candidates.scenes.len() > MAX_SCENES {
            return Err(format!("{} tables to judge; 1 to {MAX_SCENES} are supported", candidates.scenes.len()));
        }
        let scenes = candidates
            .scenes
            .iter()
            .map(|message| scene_from_message(message).map_err(|error| error.to_string()))
            .collect::<Result<Vec<Scene>, String>>()?;
        for scene in &scenes {
            if !is_about_scene(posterior, scene) {
                return Err(format!("the objects of scene '{}' are not those of the posterior", scene.id));
            }
        }
        let look = posterior.revision + 1;
        // Every look spends its share of δ, and the tables of a look share it: all bounds hold together.
        let delta = delta_spent(self.settings.delta, look) / scenes.len() as f64;
        let batch = LossBatch {
            draws: &posterior.draws,
            n_features: posterior.feature_names.len(),
            map_weights: &posterior.map_weights,
            threads: self.settings.n_threads(),
        };
        let n_chains = posterior.n_chains as usize;
        let mut bounds = Vec::with_capacity(scenes.len());
        for (scene, losses) in scenes.iter().zip(placement_losses(&scenes, &batch)) {
            bounds.push(match losses {
                None => no_placement(scene, u64::from(posterior.n_draws)),
                Some(judged) => {
                    let outcome = upper_bound(&judged.losses_m, n_chains, self.settings.alpha, delta)
                        .map_err(|error| format!("scene '{}': {error}", scene.id))?;
                    bound_message(scene, judged.map_placement_m, &outcome)
                }
            });
        }
        Ok(self.receipt(posterior, look, delta, bounds))
    }

    fn receipt(
        &self,
        posterior: &Posterior,
        look: u64,
        delta_spent: f64,
        bounds: Vec<PlacementBound>,
    ) -> PerformanceBounds {
        let worst = worst(&bounds);
        let of_worst = &bounds[worst];
        let all_bounded =
            bounds.iter().all(|b| matches!(b.outcome, PlacementBound::BOUND | PlacementBound::NO_PLACEMENT));
        let any_bounded = of_worst.outcome == PlacementBound::BOUND;
        let mixed = posterior.outcome == Posterior::READY;
        let outcome = match (mixed, all_bounded && any_bounded) {
            (true, true) => PlacementBound::BOUND,
            (false, _) => PlacementBound::NOT_MIXED,
            (true, false) => of_worst.outcome,
        };
        let bound_m = if outcome == PlacementBound::BOUND { of_worst.bound_m } else { f64::NAN };
        let finite = |pick: fn(&PlacementBound) -> f64| bounds.iter().map(pick).filter(|v| v.is_finite());
        PerformanceBounds {
            header: posterior.header.clone(),
            revision: posterior.revision,
            outcome,
            reason: self.reason(posterior, outcome, of_worst, bounds.len()),
            bound_m,
            worst: u32::try_from(worst).unwrap_or(u32::MAX),
            alpha: self.settings.alpha,
            delta: self.settings.delta,
            look,
            delta_spent,
            n: u64::from(posterior.n_draws),
            n_chains: posterior.n_chains,
            ess_min: finite(|b| b.ess).fold(f64::INFINITY, f64::min),
            rhat_max: finite(|b| b.rhat).fold(posterior.rhat_max, f64::max),
            acceptance: posterior.acceptance,
            beta: posterior.beta,
            prior: posterior.prior.clone(),
            evidence_hash: posterior.evidence_hash.clone(),
            seed: posterior.seed,
            version: posterior.version.clone(),
            bounds,
        }
    }

    fn reason(&self, posterior: &Posterior, outcome: u8, worst: &PlacementBound, n_scenes: usize) -> String {
        let sure = 100.0 * (1.0 - self.settings.delta);
        let share = 100.0 * self.settings.alpha;
        let tables =
            if n_scenes == 1 { "this table".into() } else { format!("each of {n_scenes} tables, this one among them") };
        match outcome {
            PlacementBound::BOUND => format!(
                "{sure:.0} % sure: {share:.0} in 100 of the rewards that fit the answers put the target within {:.1} cm of where I would, on {tables}",
                100.0 * worst.bound_m
            ),
            PlacementBound::NOT_ENOUGH_SAMPLES => format!(
                "no bound, because {:.0} effective draws are too few: it would take {}; raise n_draws of reward_posterior",
                worst.ess, worst.needed
            ),
            PlacementBound::NO_PLACEMENT => {
                "no bound, because there is no free spot for the target on any of the tables".into()
            }
            _ if posterior.outcome == Posterior::NOT_MIXED => {
                format!("no bound, because the chains disagree: {}", posterior.reason)
            }
            _ => format!(
                "no bound, because the chains disagree about the loss (R-hat {:.3}, at most 1.01 is allowed); raise n_draws of reward_posterior",
                worst.rhat
            ),
        }
    }
}

/// The scene to speak of: one without a bound before those with one, the larger loss first.
fn worst(bounds: &[PlacementBound]) -> usize {
    let key = |b: &PlacementBound| match b.outcome {
        PlacementBound::NO_PLACEMENT => (0, 0.0),
        PlacementBound::BOUND => (1, b.bound_m),
        _ => (2, b.point_estimate_m),
    };
    let mut best = 0;
    for i in 1..bounds.len() {
        let ((a, x), (b, y)) = (key(&bounds[best]), key(&bounds[i]));
        if b > a || (b == a && y > x) {
            best = i;
        }
    }
    best
}

fn bound_message(scene: &Scene, placement_m: scene::Point, outcome: &Outcome) -> PlacementBound {
    let (code, bound_m, index) = match outcome {
        Outcome::Bound(bound) => (PlacementBound::BOUND, bound.value, bound.index),
        Outcome::NotEnoughSamples(_) => (PlacementBound::NOT_ENOUGH_SAMPLES, f64::NAN, 0),
        Outcome::NotMixed(_) => (PlacementBound::NOT_MIXED, f64::NAN, 0),
    };
    let facts = outcome.receipt();
    PlacementBound {
        scene_id: scene.id.clone(),
        outcome: code,
        placement: point_to_message(placement_m),
        bound_m,
        point_estimate_m: facts.point_estimate,
        cvar_m: facts.cvar,
        mean_m: facts.mean,
        n: facts.n as u64,
        ess: facts.ess,
        rhat: facts.rhat,
        index: index as u64,
        needed: facts.needed as u64,
    }
}

fn no_placement(scene: &Scene, n: u64) -> PlacementBound {
    PlacementBound {
        scene_id: scene.id.clone(),
        outcome: PlacementBound::NO_PLACEMENT,
        bound_m: f64::NAN,
        point_estimate_m: f64::NAN,
        cvar_m: f64::NAN,
        mean_m: f64::NAN,
        n,
        ess: f64::NAN,
        rhat: f64::NAN,
        ..PlacementBound::default()
    }
}
