//! What a simulated person shows in a world: walks of a good hand, and which of two walks is better.

use crate::comparing::{Comparing, TIE};
use crate::identity::{answer_id, generator};
use crate::{Noise, Settings};
use apprentice_msgs::msg::{ActionDemonstration, FeatureTrajectory, TrajectoryPreference};
use bus::NodeSettings;
use exchange::World;
use mdp::random::{categorical, l1_sphere};
use mdp::{Mdp, MdpError, Policy, Solver, rollout};
use rand_chacha::ChaCha8Rng;

/// A piece of evidence that nobody asked for.
#[derive(Debug, Clone, PartialEq)]
pub enum Piece {
    /// What to do.
    Show(Box<ActionDemonstration>),
    /// Which is better.
    Compare(Box<TrajectoryPreference>),
}

impl Piece {
    /// Of the evidence.
    pub fn id(&self) -> &str {
        match self {
            Self::Show(message) => &message.id,
            Self::Compare(message) => &message.id,
        }
    }
}

/// A person who knows a world and what is good in it.
#[derive(Debug, Clone)]
pub struct Teacher {
    pub(crate) settings: Settings,
    pub(crate) world: World,
    weights: Vec<f64>,
    /// What the person does in each state.
    pub(crate) hand: Policy,
}

impl Teacher {
    /// The person that the settings describe, in a world.
    pub fn new(settings: &Settings, world: World) -> Self {
        let of = |name: &String| {
            let at = settings.reward_names.iter().position(|known| known == name);
            at.map_or(0.0, |at| settings.reward_weights[at])
        };
        let weights: Vec<f64> = world.feature_names.iter().map(of).collect();
        let hand = hand(settings, &world.mdp, &weights);
        Self { settings: settings.clone(), world, weights, hand }
    }

    /// Weights of the world's features, in their order.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Features with a reward that the world does not have.
    pub fn unknown_features(&self) -> Vec<&str> {
        let names = &self.world.feature_names;
        self.settings.reward_names.iter().filter(|name| !names.contains(name)).map(String::as_str).collect()
    }

    /// How many pieces of evidence the person has to give.
    pub fn n_pieces(&self) -> usize {
        let n = |wanted: i64| usize::try_from(wanted).unwrap_or(0);
        n(self.settings.shows) + n(self.settings.compares)
    }

    /// Piece `index`, from 0: a function of the settings and the world. Walks and comparisons take turns while there are both.
    ///
    /// # Errors
    /// A world in which no walk begins.
    pub fn piece(&self, index: usize) -> Result<Piece, MdpError> {
        let shows = usize::try_from(self.settings.shows).unwrap_or(0);
        let compares = usize::try_from(self.settings.compares).unwrap_or(0);
        let both = 2 * shows.min(compares);
        let is_show = if index < both { index.is_multiple_of(2) } else { shows > compares };
        let name = format!("{} {index}", self.world.hash);
        let id = answer_id(&self.settings.source, &name, self.settings.seed());
        let mut random = generator(&self.settings.source, &name, self.settings.seed());
        if is_show { self.show(id, &mut random) } else { self.compare(id, &mut random) }
    }

    fn show(&self, id: String, random: &mut ChaCha8Rng) -> Result<Piece, MdpError> {
        let steps = self.walk(&self.hand, self.start(random), self.settings.show_steps, random)?;
        let number = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        Ok(Piece::Show(Box::new(ActionDemonstration {
            id,
            source: self.settings.source.clone(),
            world_id: self.world.id.clone(),
            states: steps.iter().map(|step| number(step.0)).collect(),
            actions: steps.iter().map(|step| number(step.1)).collect(),
            confidence: ActionDemonstration::CONFIDENCE_SURE,
            ..ActionDemonstration::default()
        })))
    }

    /// Two walks from one start, each good for some reward or other, so that they differ in what they collect.
    fn compare(&self, id: String, random: &mut ChaCha8Rng) -> Result<Piece, MdpError> {
        let start = self.start(random);
        let mut collected = <[FeatureTrajectory; 2]>::default();
        for (walk, name) in collected.iter_mut().zip(["a", "b"]) {
            let taste = l1_sphere(self.world.mdp.n_features(), random);
            let policy = Policy::Deterministic(Solver::new(&self.world.mdp).solve(&taste).policy().to_vec());
            let steps = self.walk(&policy, start, self.settings.compare_steps, random)?;
            *walk = FeatureTrajectory { id: format!("{id}-{name}"), features: self.features(&steps) };
        }
        let (answer, second_is_better) = self.compares(&collected, random);
        if !second_is_better {
            collected.swap(0, 1);
        }
        Ok(Piece::Compare(Box::new(TrajectoryPreference {
            id,
            source: self.settings.source.clone(),
            trajectories: collected.into(),
            answer,
            confidence: TrajectoryPreference::CONFIDENCE_SURE,
            ..TrajectoryPreference::default()
        })))
    }

    /// How the person answers which of two is better, and which it is, whatever is answered.
    pub(crate) fn compares(&self, of: &[FeatureTrajectory; 2], random: &mut ChaCha8Rng) -> (u8, bool) {
        let worth = |of: &FeatureTrajectory| of.features.iter().zip(&self.weights).map(|(f, w)| f * w).sum();
        Comparing::new(&self.settings).say([worth(&of[0]), worth(&of[1])], random)
    }

    fn start(&self, random: &mut ChaCha8Rng) -> usize {
        categorical(self.world.mdp.initial().iter().copied(), 1.0, random)
    }

    fn walk(
        &self,
        policy: &Policy,
        start: usize,
        length: i64,
        random: &mut ChaCha8Rng,
    ) -> Result<Vec<(usize, usize)>, MdpError> {
        rollout(&self.world.mdp, policy, start, usize::try_from(length).unwrap_or(1).max(1), random)
    }

    /// Σ γ^t φ(s_t, a_t).
    fn features(&self, steps: &[(usize, usize)]) -> Vec<f64> {
        let mdp = &self.world.mdp;
        let mut sum = vec![0.0; mdp.n_features()];
        let mut weight = 1.0;
        for &(state, action) in steps {
            sum.iter_mut().zip(mdp.features(state, action)).for_each(|(sum, phi)| *sum += weight * phi);
            weight *= mdp.gamma();
        }
        sum
    }
}

/// What the person does: the best action, one of them where several are; or each in proportion to exp(β Q); and now and then any.
fn hand(settings: &Settings, mdp: &Mdp, weights: &[f64]) -> Policy {
    let mut solver = Solver::new(mdp);
    let optimum = solver.solve(weights);
    let n_actions = mdp.n_actions();
    let mut table = Vec::with_capacity(mdp.n_states() * n_actions);
    for state in 0..mdp.n_states() {
        let q: Vec<f64> = (0..n_actions).map(|action| optimum.q(state, action)).collect();
        let best = q.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let size = q.iter().fold(0.0_f64, |size, q| size.max(q.abs()));
        let mass: Vec<f64> = q
            .iter()
            .map(|q| match settings.noise {
                Noise::None => f64::from(u8::from(best - q <= TIE * size)),
                Noise::Boltzmann => scene::exp(settings.beta * (q - best)),
            })
            .collect();
        let total: f64 = mass.iter().sum();
        let any = settings.mistake_rate / n_actions as f64;
        let row: Vec<f64> = mass.iter().map(|mass| (1.0 - settings.mistake_rate) * mass / total + any).collect();
        table.extend(row.iter().map(|p| p.clamp(0.0, 1.0)));
    }
    Policy::Stochastic(table)
}
