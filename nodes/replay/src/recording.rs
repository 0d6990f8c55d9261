//! What a bag holds of a session, sorted by what it is.

use crate::ReplayError;
use active_query::unjudged;
use apprentice_msgs::msg::{
    Candidates, EvidenceLog, LessonStatus, NodeSettings, PerformanceBounds, PlacementPlan, PlacementQuery,
    PolicyBounds, PolicyFrontier, PolicySet, Posterior, PosteriorPreview, RiskPreference, RobustPolicy, TableReach,
    TabularWorld, WorldQuery,
};
use apprentice_msgs::{Message, from_cdr, std_msgs, to_cdr};
use exchange::world_hash;
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, BTreeSet};

/// Every distinct recorded output, by revision. A repetition of the same bytes counts once.
#[derive(Debug, Clone, Default)]
pub struct Recording {
    /// Parameters by node.
    pub settings: BTreeMap<String, NodeSettings>,
    /// The longest log of evidence.
    pub evidence: EvidenceLog,
    /// Recorded posteriors.
    pub posterior: Recorded<Posterior>,
    /// Recorded previews.
    pub preview: Recorded<PosteriorPreview>,
    /// Recorded bounds on policies.
    pub policy_bounds: Recorded<PolicyBounds>,
    /// Sets of policies, as often as they differ.
    pub policies: Vec<PolicySet>,
    /// What stands for bounds on recorded robust policies that nobody judges.
    pub(crate) unjudged: BTreeMap<u64, Vec<PolicyBounds>>,
    /// Recorded robust policies.
    pub robust_policy: Recorded<RobustPolicy>,
    /// Recorded frontiers.
    pub frontier: Recorded<PolicyFrontier>,
    /// Preferences between mean and worst case, by number and id.
    pub preferences: BTreeMap<(u64, String), RiskPreference>,
    /// Worlds by their hash.
    pub worlds: BTreeMap<String, TabularWorld>,
    /// Recorded candidates.
    pub candidates: Recorded<Candidates>,
    /// Recorded bounds.
    pub bounds: Recorded<PerformanceBounds>,
    /// What arms reached of tables, as often as it differs.
    pub reach: Vec<TableReach>,
    /// Recorded questions.
    pub query: Recorded<PlacementQuery>,
    /// Recorded questions about a world.
    pub world_query: Recorded<WorldQuery>,
    /// Recorded states of the lesson.
    pub lesson: Recorded<LessonStatus>,
    /// Recorded plans and guesses.
    pub plan: Recorded<PlacementPlan>,
    /// Robot descriptions by the SHA-256 of their text, hex.
    pub robots: BTreeMap<String, String>,
    /// Their SRDF texts, as often as they differ.
    pub semantics: BTreeSet<String>,
}

/// Recorded messages of one type: revision → distinct messages with their bytes, in recorded order.
pub type Recorded<M> = BTreeMap<u64, Vec<(M, Vec<u8>)>>;

impl Recording {
    /// Sorts the messages of a bag: (topic, type, CDR with header).
    ///
    /// With `namespace` only topics in it count, else there must be one with evidence.
    pub fn collect<'a>(
        messages: impl IntoIterator<Item = (&'a str, &'a str, &'a [u8])>,
        namespace: Option<&str>,
    ) -> Result<Self, ReplayError> {
        let mut all: BTreeMap<String, Self> = BTreeMap::new();
        let (mut robots, mut semantics) = (BTreeMap::new(), BTreeSet::new());
        for (index, (topic, type_name, cdr)) in messages.into_iter().enumerate() {
            if type_name == std_msgs::String::TYPE && topic.ends_with("/robot_description") {
                let text = decode::<std_msgs::String>(topic, index, cdr)?.data;
                let hash = Sha256::digest(text.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect();
                robots.insert(hash, text);
                continue;
            }
            if type_name == std_msgs::String::TYPE && topic.ends_with("/robot_description_semantic") {
                semantics.insert(decode::<std_msgs::String>(topic, index, cdr)?.data);
                continue;
            }
            if !type_name.starts_with("apprentice_msgs/msg/") {
                continue;
            }
            let of = topic.rsplit_once('/').map_or("", |(namespace, _)| namespace);
            if namespace.is_none_or(|wanted| wanted.trim_end_matches('/') == of) {
                let one = all.entry(of.to_owned()).or_default();
                one.take(topic, type_name, index, cdr)?;
            }
        }
        let with_evidence: BTreeSet<String> =
            all.iter().filter(|(_, one)| one.evidence != EvidenceLog::default()).map(|(of, _)| of.clone()).collect();
        match with_evidence.len() {
            0 => Err(ReplayError::NoEvidence(EvidenceLog::TYPE)),
            1 => {
                let of = with_evidence.iter().next().expect("there is one");
                let mut one = all.remove(of).expect("it was found there");
                (one.robots, one.semantics) = (robots, semantics);
                Ok(one)
            }
            _ => Err(ReplayError::SeveralSessions(with_evidence.into_iter().collect())),
        }
    }

    fn take(&mut self, topic: &str, type_name: &str, index: usize, cdr: &[u8]) -> Result<(), ReplayError> {
        match type_name {
            Posterior::TYPE => insert(&mut self.posterior, topic, index, cdr, |m| m.revision),
            PosteriorPreview::TYPE => insert(&mut self.preview, topic, index, cdr, |m| m.revision),
            PolicyBounds::TYPE => insert(&mut self.policy_bounds, topic, index, cdr, |m| m.revision),
            PolicySet::TYPE => {
                let set: PolicySet = decode(topic, index, cdr)?;
                if !self.policies.contains(&set) {
                    self.policies.push(set);
                }
                Ok(())
            }
            RobustPolicy::TYPE => {
                let policy: RobustPolicy = decode(topic, index, cdr)?;
                let known = self.unjudged.entry(policy.revision).or_default();
                // It is sent again and again.
                let is_new = |bounds: &PolicyBounds| !known.iter().any(|known| to_cdr(known) == to_cdr(bounds));
                let new = unjudged(&policy).filter(is_new);
                known.extend(new);
                insert(&mut self.robust_policy, topic, index, cdr, |m| m.revision)
            }
            PolicyFrontier::TYPE => insert(&mut self.frontier, topic, index, cdr, |m| m.revision),
            RiskPreference::TYPE => {
                let said: RiskPreference = decode(topic, index, cdr)?;
                self.preferences.entry((said.number, said.id.clone())).or_insert(said);
                Ok(())
            }
            TableReach::TYPE => {
                let reach: TableReach = decode(topic, index, cdr)?;
                if !self.reach.contains(&reach) {
                    self.reach.push(reach);
                }
                Ok(())
            }
            TabularWorld::TYPE => {
                let world: TabularWorld = decode(topic, index, cdr)?;
                self.worlds.insert(world_hash(&world), world);
                Ok(())
            }
            Candidates::TYPE => insert(&mut self.candidates, topic, index, cdr, |m| m.revision),
            PerformanceBounds::TYPE => insert(&mut self.bounds, topic, index, cdr, |m| m.revision),
            PlacementQuery::TYPE => insert(&mut self.query, topic, index, cdr, |m| m.revision),
            WorldQuery::TYPE => insert(&mut self.world_query, topic, index, cdr, |m| m.revision),
            LessonStatus::TYPE => insert(&mut self.lesson, topic, index, cdr, |m| m.revision),
            PlacementPlan::TYPE => insert(&mut self.plan, topic, index, cdr, |m| m.revision),
            EvidenceLog::TYPE => self.evidence(decode(topic, index, cdr)?),
            NodeSettings::TYPE => self.setting(decode(topic, index, cdr)?),
            _ => Ok(()),
        }
    }

    fn evidence(&mut self, log: EvidenceLog) -> Result<(), ReplayError> {
        let mut before = 0;
        for record in &log.records {
            if record.sequence != before + 1 {
                return Err(ReplayError::Gap { before, after: record.sequence });
            }
            before = record.sequence;
        }
        if self.evidence == EvidenceLog::default() {
            self.evidence = log;
            return Ok(());
        }
        if (&log.task, &log.world) != (&self.evidence.task, &self.evidence.world) {
            return Err(ReplayError::TwoHistories { sequence: 0 });
        }
        if let Some((_, theirs)) = self.evidence.records.iter().zip(&log.records).find(|(a, b)| a != b) {
            return Err(ReplayError::TwoHistories { sequence: theirs.sequence });
        }
        if log.records.len() > self.evidence.records.len() {
            self.evidence = log;
        }
        Ok(())
    }

    fn setting(&mut self, settings: NodeSettings) -> Result<(), ReplayError> {
        match self.settings.get(&settings.node) {
            Some(before) if before.parameters != settings.parameters => {
                Err(ReplayError::TwoSettings { node: settings.node })
            }
            _ => {
                self.settings.insert(settings.node.clone(), settings);
                Ok(())
            }
        }
    }
}

fn decode<M: Message>(topic: &str, index: usize, cdr: &[u8]) -> Result<M, ReplayError> {
    from_cdr(cdr).map_err(|source| ReplayError::Malformed { topic: topic.into(), type_name: M::TYPE, index, source })
}

fn insert<M: Message>(
    recorded: &mut Recorded<M>,
    topic: &str,
    index: usize,
    cdr: &[u8],
    revision: impl Fn(&M) -> u64,
) -> Result<(), ReplayError> {
    let message: M = decode(topic, index, cdr)?;
    // Encoded anew, since DDS pads payloads to a multiple of four; numbers keep their bits.
    let bytes = to_cdr(&message);
    let same = recorded.entry(revision(&message)).or_default();
    if !same.iter().any(|(_, known)| *known == bytes) {
        same.push((message, bytes));
    }
    Ok(())
}
