//! The node as a state machine: a posterior, its world and what is known of both in; policy, frontier and what to judge out.

use crate::inputs::Inputs;
use crate::settings::Objective;
use crate::{Settings, frontier, policy};
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{
    EvidenceLog, PolicyFrontier, PolicySet, Posterior, RiskPreference, RobustPolicy, TabularWorld,
};
use exchange::{
    MAX_ID, World, check_posterior, check_preference_of_risk, demonstrations_in_force, world_from_message, world_hash,
};

/// What reaches the node.
#[derive(Debug, Clone)]
pub enum Event {
    /// A new (or repeated) posterior.
    Posterior(Box<Posterior>),
    /// A world.
    World(Box<TabularWorld>),
    /// Everything accepted so far: regret is measured against the demonstrations in it.
    Evidence(Box<EvidenceLog>),
    /// How cautious to be.
    Preference(Box<RiskPreference>),
    /// Compute what is due: it was asked for with [`Output::Compute`].
    Compute,
    /// Time to send the newest outputs again.
    Republish,
}

/// What the node sends.
#[derive(Debug, Clone, PartialEq)]
pub enum Output {
    /// The policy to follow.
    Policy(Box<RobustPolicy>),
    /// What every balance buys.
    Frontier(Box<PolicyFrontier>),
    /// Policies to judge.
    Judge(Box<PolicySet>),
    /// Give [`Event::Compute`] once everything that waits has been taken in: of several posteriors only the last counts.
    Compute,
    /// Something a person should know.
    Warn(String),
}

/// What outputs belong to: the posterior, and the preference.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Key {
    revision: u64,
    evidence_hash: String,
    world_hash: String,
    preference: (u64, String),
}

impl Key {
    /// Whether the frontier is that of another key, too.
    fn is_same_posterior(&self, other: &Self) -> bool {
        (self.revision, &self.evidence_hash, &self.world_hash)
            == (other.revision, &other.evidence_hash, &other.world_hash)
    }
}

/// See the crate.
pub struct PolicyOptimizer {
    settings: Settings,
    posterior: Option<Box<Posterior>>,
    world: Option<World>,
    log: Option<Box<EvidenceLog>>,
    preference: Option<Box<RiskPreference>>,
    policy: Option<(Key, Box<RobustPolicy>)>,
    set: Option<Box<PolicySet>>,
    frontier: Option<(Key, Box<PolicyFrontier>)>,
    asked: bool,
    told: Option<String>,
}

impl PolicyOptimizer {
    /// A node that has seen nothing.
    pub fn new(settings: Settings) -> Self {
        Self {
            settings,
            posterior: None,
            world: None,
            log: None,
            preference: None,
            policy: None,
            set: None,
            frontier: None,
            asked: false,
            told: None,
        }
    }

    /// Takes one event. Outputs depend on the settings and the messages alone, never on `_now`.
    pub fn step(&mut self, _now: Time, event: Event) -> Vec<Output> {
        let mut outputs = match event {
            Event::Posterior(message) => self.take_posterior(message),
            Event::World(message) => self.take_world(&message),
            Event::Evidence(message) => {
                self.log = Some(message);
                Vec::new()
            }
            Event::Preference(message) => self.take_preference(message),
            Event::Compute => {
                self.asked = false;
                self.compute()
            }
            Event::Republish => return self.republish(),
        };
        if !self.asked && self.is_due() {
            self.asked = true;
            outputs.push(Output::Compute);
        }
        outputs
    }

    fn take_posterior(&mut self, message: Box<Posterior>) -> Vec<Output> {
        match check_posterior(&message) {
            Ok(()) => {
                self.posterior = Some(message);
                Vec::new()
            }
            Err(reason) => self.tell(format!("posterior {} is ignored: {reason}", message.revision)),
        }
    }

    fn take_world(&mut self, message: &TabularWorld) -> Vec<Output> {
        if self.world.as_ref().is_some_and(|world| world.hash == world_hash(message)) {
            return Vec::new();
        }
        match world_from_message(message) {
            // The world that the posterior names is kept, whatever else comes.
            Ok(world) => {
                if self.world.as_ref().is_none_or(|known| !self.is_named(&known.hash)) {
                    self.world = Some(world);
                }
                Vec::new()
            }
            Err(error) => {
                let id: String = message.id.chars().take(MAX_ID).collect();
                self.tell(format!("the world '{id}' is ignored: {error}"))
            }
        }
    }

    fn is_named(&self, hash: &str) -> bool {
        self.posterior.as_ref().is_some_and(|posterior| posterior.world.hash == hash)
    }

    fn take_preference(&mut self, message: Box<RiskPreference>) -> Vec<Output> {
        if let Err(error) = check_preference_of_risk(&message) {
            let id: String = message.id.chars().take(MAX_ID).collect();
            return self.tell(format!("the preference '{id}' between mean and worst case is ignored: {error}"));
        }
        // The largest number counts, then the larger id: so it does not matter in which order they come.
        let rank = |of: &RiskPreference| (of.number, of.id.clone());
        if self.preference.as_ref().is_none_or(|known| rank(&message) > rank(known)) {
            self.preference = Some(message);
        }
        Vec::new()
    }

    /// What the next outputs belong to; none while something is missing.
    fn key(&self) -> Option<Key> {
        let (posterior, world) = (self.posterior.as_ref()?, self.world.as_ref()?);
        if posterior.world.hash.is_empty() || posterior.world.hash != world.hash {
            return None;
        }
        if self.settings.objective == Objective::Regret {
            demonstrations_in_force(self.log.as_ref()?, posterior.revision, &world.id)?;
        }
        let preference = self.preference.as_ref().map_or((0, String::new()), |said| (said.number, said.id.clone()));
        let (revision, evidence_hash) = (posterior.revision, posterior.evidence_hash.clone());
        Some(Key { revision, evidence_hash, world_hash: world.hash.clone(), preference })
    }

    fn is_due(&self) -> bool {
        self.key().is_some_and(|key| self.policy_is_due(&key) || self.frontier_is_due(&key))
    }

    fn policy_is_due(&self, key: &Key) -> bool {
        self.policy.as_ref().is_none_or(|(known, _)| known != key)
    }

    fn frontier_is_due(&self, key: &Key) -> bool {
        self.frontier.as_ref().is_none_or(|(known, _)| !known.is_same_posterior(key))
    }

    /// The policy first, and at the next event the frontier: who follows the policy does not wait for the picture.
    fn compute(&mut self) -> Vec<Output> {
        let Some(key) = self.key() else { return Vec::new() };
        let (Some(posterior), Some(world)) = (&self.posterior, &self.world) else { return Vec::new() };
        let demonstrations = match (self.settings.objective, &self.log) {
            (Objective::Regret, Some(log)) => {
                demonstrations_in_force(log, posterior.revision, &world.id).unwrap_or_default()
            }
            _ => Vec::new(),
        };
        let inputs = Inputs { posterior, world, demonstrations: &demonstrations };
        let mut outputs = Vec::new();
        if self.policy_is_due(&key) {
            let found = policy(&self.settings, &inputs, self.preference.as_deref());
            let message = Box::new(found.policy);
            self.set = found.set.map(Box::new);
            outputs.push(Output::Policy(message.clone()));
            outputs.extend(self.set.clone().map(Output::Judge));
            self.policy = Some((key, message));
        } else if self.frontier_is_due(&key) {
            let message = Box::new(frontier(&self.settings, &inputs));
            outputs.push(Output::Frontier(message.clone()));
            self.frontier = Some((key, message));
        }
        outputs
    }

    fn republish(&mut self) -> Vec<Output> {
        let policy = self.policy.iter().map(|(_, message)| Output::Policy(message.clone()));
        let judge = self.set.iter().cloned().map(Output::Judge);
        let frontier = self.frontier.iter().map(|(_, message)| Output::Frontier(message.clone()));
        let outputs: Vec<Output> = policy.chain(judge).chain(frontier).collect();
        let missing = self.missing().map(|text| self.tell(text)).unwrap_or_default();
        outputs.into_iter().chain(missing).collect()
    }

    /// What a person should know when a policy has been due for a while.
    fn missing(&self) -> Option<String> {
        let named = &self.posterior.as_ref()?.world;
        if named.hash.is_empty() || self.key().is_some() {
            return None;
        }
        let id: String = named.id.chars().take(MAX_ID).collect();
        if self.world.as_ref().is_none_or(|world| world.hash != named.hash) {
            return Some(format!(
                "the policy waits for the world '{id}': it must be on the topic world or lesson_world"
            ));
        }
        Some("the policy waits for the topic evidence: regret is measured against the demonstrations in it".to_owned())
    }

    /// Says something once, until there is something else to say.
    fn tell(&mut self, text: String) -> Vec<Output> {
        if self.told.as_ref() == Some(&text) {
            return Vec::new();
        }
        self.told = Some(text.clone());
        vec![Output::Warn(text)]
    }
}
