//! The node as a state machine: evidence in; receipts, the log of evidence and posteriors out.

use crate::inference::{evidence_hash, model};
use crate::journal::Entry;
use crate::message::posterior_message;
use crate::piece::Piece;
use crate::preview::{Sampled, preview};
use crate::receive::{Open, Verdict, judge};
use crate::subject::Elsewhere;
use crate::waiting::Waiting;
use crate::work::{Due, Work, Worked};
use crate::{Evidence, Settings};
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{
    ActionDemonstration, EvidenceLog, EvidenceReceipt, EvidenceRecord, LearnerHistory, PlacementDemonstration,
    PlacementQuery, Posterior, PosteriorPreview, QueryResponse, Retraction, SegmentCritique, TableScene, TabularWorld,
    TrajectoryPreference, WorldQuery,
};
use apprentice_msgs::std_msgs::Header;
use exchange::{MAX_ID, world_from_message};
use std::sync::Arc;

/// Questions remembered as asked before.
const MAX_KNOWN: usize = 1000;

/// What reaches the node.
#[derive(Debug, Clone)]
pub enum Event {
    /// The table as it stands; the first one is the lesson's.
    Scene(Box<TableScene>),
    /// A world; the first one is the lesson's.
    World(Box<TabularWorld>),
    /// A person shows where the target belongs.
    Demonstration(Box<PlacementDemonstration>),
    /// A person shows what to do.
    Actions(Box<ActionDemonstration>),
    /// A person says which trajectory is better.
    Preference(Box<TrajectoryPreference>),
    /// A person marks what is good and what is bad.
    Critique(Box<SegmentCritique>),
    /// What a learner did, in the order of time.
    History(Box<LearnerHistory>),
    /// A person takes something back.
    Retraction(Box<Retraction>),
    /// A person answers otherwise.
    Response(Box<QueryResponse>),
    /// A question about a table was asked.
    Query(Box<PlacementQuery>),
    /// A question about a world was asked.
    WorldQuery(Box<WorldQuery>),
    /// Time to compute what [`Output::Recompute`] asked for, here and now.
    Recompute,
    /// A posterior was computed elsewhere.
    Worked(Box<Worked>),
    /// Once a second.
    Tick,
}

/// What the node sends.
#[derive(Debug, Clone)]
pub enum Output {
    /// Bytes to append to the journal, safely on disk before any later output goes out.
    Journal(Vec<u8>),
    /// What was done with a piece of evidence.
    Receipt(EvidenceReceipt),
    /// All accepted evidence.
    Evidence(Box<EvidenceLog>),
    /// The world that the lesson is about: whoever sent it may be gone.
    World(Box<TabularWorld>),
    /// The node wants [`Event::Recompute`] as soon as nothing else waits: sampling takes a while, receipts do not.
    Recompute,
    /// What the posterior of the newest revision will be about like.
    Preview(Box<PosteriorPreview>),
    /// The posterior of the newest revision.
    Posterior(Box<Posterior>),
    /// Something a person should know.
    Warn(String),
}

/// See the crate.
pub struct RewardPosterior {
    settings: Settings,
    pub(crate) evidence: Evidence,
    /// The world of the evidence, or one that it may take up next.
    offered: Option<Box<TabularWorld>>,
    query: Option<Box<PlacementQuery>>,
    world_query: Option<Box<WorldQuery>>,
    known: Vec<String>,
    waiting: Waiting,
    sampled: Option<Sampled>,
    newest: Option<Box<Posterior>>,
    previewed: Option<u64>,
    /// What was said last of a table or a world that cannot be used: they come again and again.
    pub(crate) told: Option<String>,
    /// The table as it is seen now, where that is not as the lesson has it.
    pub(crate) elsewhere: Option<Elsewhere>,
    ticks: u32,
}

impl RewardPosterior {
    /// A node that has seen nothing.
    pub fn new(settings: Settings) -> Self {
        Self {
            settings,
            evidence: Evidence::default(),
            offered: None,
            query: None,
            world_query: None,
            known: Vec::new(),
            waiting: Waiting::default(),
            sampled: None,
            newest: None,
            previewed: None,
            told: None,
            elsewhere: None,
            ticks: 0,
        }
    }

    /// Takes up a session from its journal. An error names the entry that does not fit.
    pub fn restore(&mut self, entries: Vec<Entry>) -> Result<Vec<Output>, String> {
        for (i, entry) in entries.into_iter().enumerate() {
            self.restore_entry(entry).map_err(|error| format!("entry {i} of the journal: {error}"))?;
        }
        model(&self.settings, &self.evidence)
            .map_err(|error| format!("the journal holds evidence that is unusable with these settings: {error}"))?;
        if self.evidence.is_blank() {
            return Ok(Vec::new());
        }
        Ok(self.about())
    }

    /// What everybody must know of the evidence, and that the posterior is due.
    pub(crate) fn about(&self) -> Vec<Output> {
        let world = self.offered.clone().filter(|_| self.evidence.world().is_some());
        let log = Output::Evidence(Box::new(self.evidence.log()));
        world.map(Output::World).into_iter().chain([log, Output::Recompute]).collect()
    }

    pub(crate) fn restore_entry(&mut self, entry: Entry) -> Result<(), String> {
        match entry {
            Entry::Task(scene) => self.evidence.begin_with_table(*scene).map_err(|error| error.to_string()),
            Entry::World(message) => {
                let world = Arc::new(world_from_message(&message).map_err(|error| error.to_string())?);
                self.offered = Some(message);
                if self.evidence.is_blank() {
                    self.evidence.begin_with_world(world);
                } else {
                    self.evidence.offer_world(world);
                }
                Ok(())
            }
            Entry::Record(record) => self.evidence.append(*record),
        }
    }

    /// The evidence so far.
    pub fn evidence(&self) -> &Evidence {
        &self.evidence
    }

    /// Takes one event. Outputs depend on the settings and on the evidence in accepted order, never on `_now`.
    pub fn step(&mut self, _now: Time, event: Event) -> Vec<Output> {
        match event {
            Event::Scene(scene) => self.scene(*scene),
            Event::World(world) => self.world(&world),
            Event::Demonstration(message) => self.piece(Piece::Demonstration(message)),
            Event::Actions(message) => self.piece(Piece::Actions(message)),
            Event::Preference(message) => self.piece(Piece::Preference(message)),
            Event::Critique(message) => self.piece(Piece::Critique(message)),
            Event::History(message) => self.piece(Piece::History(message)),
            Event::Retraction(message) => self.piece(Piece::Retraction(message)),
            Event::Response(message) => self.piece(Piece::Response(message)),
            Event::Query(query) => {
                self.know(&query.id);
                if query.revision == self.evidence.revision() {
                    self.query = Some(query);
                }
                self.look_again()
            }
            Event::WorldQuery(query) => {
                self.know(&query.id);
                if query.revision == self.evidence.revision() {
                    self.world_query = Some(query);
                }
                self.look_again()
            }
            Event::Recompute => self.recompute(),
            Event::Worked(worked) => self.worked(*worked),
            Event::Tick => self.tick(),
        }
    }

    fn judge(&self, piece: &Piece) -> Verdict {
        judge(&self.settings, &self.evidence, self.open(), piece)
    }

    fn piece(&mut self, piece: Piece) -> Vec<Output> {
        let mut verdict = self.judge(&piece);
        let mut outputs = Vec::new();
        if let (Verdict::Accept(_), Piece::Demonstration(message)) = (&verdict, &piece)
            && self.evidence.task().is_none()
        {
            // Without a table yet, the lesson is about that of its first placement.
            outputs = self.scene(message.scene.clone());
            verdict = self.judge(&piece);
        }
        if let Verdict::Unknown(_) = verdict {
            if let Some(oldest) = self.waiting.add(piece) {
                outputs.extend(self.give_up(&oldest));
            }
            return outputs;
        }
        outputs.extend(self.settle(&piece, verdict));
        outputs
    }

    /// Remembers that a question was asked.
    fn know(&mut self, id: &str) {
        if !self.known.iter().any(|known| known == id) {
            if self.known.len() == MAX_KNOWN {
                self.known.remove(0);
            }
            self.known.push(id.to_owned());
        }
    }

    /// What was asked before is asked no more.
    pub(crate) fn close_questions(&mut self) {
        (self.query, self.world_query) = (None, None);
    }

    /// Judges everything that waits anew.
    pub(crate) fn look_again(&mut self) -> Vec<Output> {
        let waiting = self.waiting.take();
        waiting.into_iter().flat_map(|piece| self.piece(piece)).collect()
    }

    /// Judges what has waited long enough: what it speaks of does not come.
    fn give_up(&mut self, piece: &Piece) -> Vec<Output> {
        let verdict = match (self.judge(piece), piece) {
            // Nothing else names the weights, so the trajectories count them.
            (Verdict::Unknown(_), Piece::Preference(_) | Piece::History(_)) => {
                Verdict::Accept(Box::new(piece.record(self.evidence.revision() + 1)))
            }
            (Verdict::Unknown(reason), _) => Verdict::Refuse(reason),
            (verdict, _) => verdict,
        };
        self.settle(piece, verdict)
    }

    fn tick(&mut self) -> Vec<Output> {
        let mut outputs = Vec::new();
        for piece in self.waiting.tick() {
            outputs.extend(self.give_up(&piece));
        }
        outputs.extend(self.stood_still());
        self.ticks += 1;
        if f64::from(self.ticks) >= self.settings.republish_period_s {
            self.ticks = 0;
            if !self.evidence.is_blank() {
                outputs.push(Output::Evidence(Box::new(self.evidence.log())));
            }
            outputs.extend(self.newest.clone().map(Output::Posterior));
        }
        outputs
    }

    fn settle(&mut self, piece: &Piece, verdict: Verdict) -> Vec<Output> {
        let short = |text: &str| text.chars().take(MAX_ID).collect::<String>();
        let receipt = |outcome, reason: String, revision| {
            let header = Header { stamp: piece.header().stamp, frame_id: String::new() };
            Output::Receipt(EvidenceReceipt { header, id: short(piece.id()), outcome, reason, revision })
        };
        match verdict {
            Verdict::Accept(record) => {
                let revision = record.sequence;
                let journal = Entry::Record(record.clone()).to_bytes();
                self.evidence.append(*record).expect("it was checked just now");
                self.close_questions();
                vec![
                    Output::Journal(journal),
                    receipt(EvidenceReceipt::ACCEPTED, String::new(), revision),
                    Output::Evidence(Box::new(self.evidence.log())),
                    Output::Recompute,
                ]
            }
            Verdict::Duplicate(revision) => {
                let reason = format!("it was accepted before, as revision {revision}");
                vec![receipt(EvidenceReceipt::DUPLICATE, reason, revision)]
            }
            Verdict::Refuse(reason) | Verdict::Unknown(reason) => {
                let (what, id, source) = (piece.what(), short(piece.id()), short(piece.source()));
                let warning = format!("{what} '{id}' from '{source}' is refused: {reason}");
                vec![receipt(EvidenceReceipt::REFUSED, reason, 0), Output::Warn(warning)]
            }
        }
    }

    fn recompute(&mut self) -> Vec<Output> {
        match self.due() {
            Due::Nothing => Vec::new(),
            Due::Preview(preview) => vec![*preview, Output::Recompute],
            Due::Posterior(work) => self.worked(work.run()),
        }
    }

    /// What is to be done about the evidence that came since the newest posterior.
    pub fn due(&mut self) -> Due {
        let revision = self.evidence.revision();
        if !self.evidence.weights().are_known()
            || self.newest.as_ref().is_some_and(|newest| newest.revision == revision)
        {
            return Due::Nothing;
        }
        match self.preview_due() {
            Some(preview) => Due::Preview(Box::new(preview)),
            None => Due::Posterior(Box::new(self.work())),
        }
    }

    /// The preview of the newest revision, once.
    pub fn preview_due(&mut self) -> Option<Output> {
        let revision = self.evidence.revision();
        if self.previewed == Some(revision) {
            return None;
        }
        let preview = self.preview(&self.evidence)?;
        self.previewed = Some(revision);
        Some(preview)
    }

    fn work(&self) -> Work {
        let digest = evidence_hash(&self.evidence);
        let known = self.sampled.as_ref().filter(|sampled| sampled.hash == hex(&digest));
        Work {
            settings: self.settings.clone(),
            evidence: self.evidence.clone(),
            digest,
            known: known.map(|sampled| sampled.draws.clone()),
            stop: Arc::default(),
        }
    }

    /// Whether these draws would be those of the newest revision: a skipped question changes nothing that they depend on.
    pub fn wants(&self, digest: &[u8; 32]) -> bool {
        evidence_hash(&self.evidence) == *digest
    }

    /// Takes a posterior that was computed. One of other evidence is of no use: what would be asked by it could not be answered.
    fn worked(&mut self, worked: Worked) -> Vec<Output> {
        if !self.wants(&worked.digest) {
            return vec![Output::Recompute];
        }
        vec![match self.take(worked) {
            Ok(message) => Output::Posterior(message),
            Err(reason) => Output::Warn(format!("no posterior: {reason}")),
        }]
    }

    fn take(&mut self, worked: Worked) -> Result<Box<Posterior>, String> {
        let (hash, draws) = (hex(&worked.digest), worked.draws?);
        let message = Box::new(posterior_message(&self.settings, &self.evidence, hash.clone(), &draws));
        self.sampled = Some(Sampled { hash, evidence: self.evidence.clone(), draws });
        self.newest = Some(message.clone());
        Ok(message)
    }

    /// The posterior of the newest revision. `None` while nothing has said how many weights there are.
    ///
    /// # Errors
    /// Why there is none.
    pub fn posterior(&mut self) -> Result<Option<Posterior>, String> {
        if !self.evidence.weights().are_known() {
            return Ok(None);
        }
        let worked = self.work().run();
        self.take(worked).map(|message| Some(*message))
    }

    /// The preview that goes out when the records come after the newest posterior.
    ///
    /// # Errors
    /// A record that does not follow.
    pub fn preview_after(&self, records: &[EvidenceRecord]) -> Result<Option<PosteriorPreview>, String> {
        let mut evidence = self.evidence.clone();
        records.iter().try_for_each(|record| evidence.append(record.clone()))?;
        match self.preview(&evidence) {
            Some(Output::Preview(message)) => Ok(Some(*message)),
            Some(Output::Warn(text)) => Err(text),
            _ => Ok(None),
        }
    }

    fn preview(&self, evidence: &Evidence) -> Option<Output> {
        let sampled = self.sampled.as_ref().filter(|_| self.settings.preview_draws > 0)?;
        let base_revision = self.newest.as_ref()?.revision;
        let hash = hex(&evidence_hash(evidence));
        if sampled.hash == hash {
            return None;
        }
        Some(match preview(&self.settings, evidence, hash, sampled, base_revision) {
            Ok(message) => Output::Preview(Box::new(message)),
            Err(reason) => Output::Warn(format!("no preview: {reason}")),
        })
    }

    fn open(&self) -> Open<'_> {
        let revision = self.evidence.revision();
        let query = self.query.as_deref().filter(|query| query.revision == revision);
        let world_query = self.world_query.as_deref().filter(|query| query.revision == revision);
        Open { query, world_query, known: &self.known }
    }
}

fn hex(digest: &[u8; 32]) -> String {
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}
