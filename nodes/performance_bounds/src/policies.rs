//! Which set of policies is to be judged, and when everything it takes has come.

use crate::{Settings, judge_policies};
use apprentice_msgs::msg::{PolicyBounds, PolicySet, Posterior, TabularWorld};
use apprentice_msgs::std_msgs::Header;
use apprentice_msgs::to_cdr;
use exchange::{MAX_ID, World, world_from_message, world_hash};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// Sets of one session; more are refused.
const MAX_SETS: usize = 10_000;

/// The newest set, the newest world, and what has been said of them.
#[derive(Debug, Default)]
pub(crate) struct Policies {
    set: Option<Box<PolicySet>>,
    /// Content of each set by its number: δ is shared by numbers, so each stands for one set.
    numbers: BTreeMap<u64, Vec<u8>>,
    world: Option<World>,
    newest: Option<Box<PolicyBounds>>,
    told: Option<String>,
    waits: bool,
}

impl Policies {
    /// Takes a set. An error is what to tell a person.
    pub(crate) fn take_set(&mut self, set: Box<PolicySet>) -> Result<(), String> {
        let content = Sha256::digest(to_cdr(&PolicySet { header: Header::default(), ..(*set).clone() })).to_vec();
        let id: String = set.id.chars().take(MAX_ID).collect();
        match self.numbers.get(&set.number) {
            Some(known) if *known != content => {
                let text = format!("policies '{id}' are ignored: another set came with number {} before", set.number);
                return self.tell(text);
            }
            None if self.numbers.len() >= MAX_SETS => {
                return self.tell(format!("policies '{id}' are ignored: {MAX_SETS} sets are all that a session takes"));
            }
            _ => {}
        }
        self.numbers.insert(set.number, content);
        self.set = Some(set);
        Ok(())
    }

    /// Takes a world, if it can be used. An error is what to tell a person.
    pub(crate) fn take_world(&mut self, message: &TabularWorld) -> Result<(), String> {
        if self.world.as_ref().is_some_and(|world| world.hash == world_hash(message)) {
            return Ok(());
        }
        match world_from_message(message) {
            Ok(world) => {
                self.world = Some(world);
                Ok(())
            }
            Err(error) => {
                let id: String = message.id.chars().take(MAX_ID).collect();
                self.tell(format!("the world '{id}' is ignored: {error}"))
            }
        }
    }

    /// An error once, until there is something else to tell: worlds and sets come again and again.
    fn tell(&mut self, text: String) -> Result<(), String> {
        if self.told.as_ref() == Some(&text) {
            return Ok(());
        }
        self.told = Some(text.clone());
        Err(text)
    }

    /// The newest bounds.
    pub(crate) fn newest(&self) -> Option<Box<PolicyBounds>> {
        self.newest.clone()
    }

    /// Bounds on the newest set under a posterior, unless they have been given or something is still missing. Always with the world
    /// that the posterior names, so that what is said of a revision does not depend on what came first.
    pub(crate) fn judge(
        &mut self,
        settings: &Settings,
        posterior: &Posterior,
    ) -> Option<Result<Box<PolicyBounds>, String>> {
        let set = self.set.as_deref()?;
        let done = |bounds: &PolicyBounds| bounds.revision == posterior.revision && bounds.set_number == set.number;
        if self.newest.as_deref().is_some_and(done) {
            return None;
        }
        let named = !posterior.world.hash.is_empty();
        let world = self.world.as_ref().filter(|world| world.hash == posterior.world.hash);
        self.waits = named && world.is_none();
        if self.waits {
            return None;
        }
        match judge_policies(settings, posterior, set, world) {
            Ok(bounds) => {
                let bounds = Box::new(bounds);
                self.newest = Some(bounds.clone());
                Some(Ok(bounds))
            }
            Err(reason) => {
                let id: String = set.id.chars().take(MAX_ID).collect();
                let told = self.tell(format!("policies '{id}' are ignored: {reason}"));
                told.err().map(Err)
            }
        }
    }

    /// What a person should know when bounds have been due for a while.
    pub(crate) fn missing(&mut self, posterior: Option<&Posterior>) -> Option<String> {
        let (set, posterior) = (self.set.as_deref().filter(|_| self.waits)?, posterior?);
        let id: String = set.id.chars().take(MAX_ID).collect();
        let text = format!(
            "policies '{id}' wait for the world '{}' that the lesson is about: it must be on the topic world or lesson_world",
            posterior.world.id
        );
        self.tell(text).err()
    }
}
