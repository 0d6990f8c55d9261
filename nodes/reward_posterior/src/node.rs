//! The node as a state machine: evidence in; receipts, the log of evidence and posteriors out.

use crate::journal::Entry;
use crate::receive::{self, Open, Verdict};
use crate::{Evidence, Settings};
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{
    EvidenceLog, EvidenceReceipt, EvidenceRecord, PlacementDemonstration, PlacementQuery, Posterior, QueryResponse,
    Retraction, TableScene,
};
use apprentice_msgs::std_msgs::Header;
use posterior::{Demonstration, Draws, Lesson, evidence_hash};
use std::collections::VecDeque;

/// Ticks an answer to an unheard-of question is kept for, in case the question is still on its way.
const PATIENCE_TICKS: u32 = 2;
/// Answers to unheard-of questions kept at a time.
const MAX_WAITING: usize = 16;
/// Questions remembered as asked before.
const MAX_KNOWN: usize = 1000;

/// What reaches the node.
#[derive(Debug, Clone)]
pub enum Event {
    /// The table as it stands; the first one names the weights.
    Scene(Box<TableScene>),
    /// A person shows where the target belongs.
    Demonstration(Box<PlacementDemonstration>),
    /// A person takes something back.
    Retraction(Box<Retraction>),
    /// A person answers otherwise.
    Response(Box<QueryResponse>),
    /// A question was asked.
    Query(Box<PlacementQuery>),
    /// Time to compute what [`Output::Recompute`] asked for.
    Recompute,
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
    /// The node wants [`Event::Recompute`] as soon as nothing else waits: sampling takes a while, receipts do not.
    Recompute,
    /// The posterior of the newest revision.
    Posterior(Box<Posterior>),
    /// Something a person should know.
    Warn(String),
}

/// An answer whose question has not been heard of.
enum Waiting {
    Demonstration(Box<PlacementDemonstration>),
    Response(Box<QueryResponse>),
}

/// See the crate.
pub struct RewardPosterior {
    settings: Settings,
    evidence: Evidence,
    query: Option<Box<PlacementQuery>>,
    known: Vec<String>,
    waiting: VecDeque<(u32, Waiting)>,
    draws: Option<(String, Draws)>,
    newest: Option<Box<Posterior>>,
    ticks: u32,
}

impl RewardPosterior {
    /// A node that has seen nothing.
    pub fn new(settings: Settings) -> Self {
        Self {
            settings,
            evidence: Evidence::default(),
            query: None,
            known: Vec::new(),
            waiting: VecDeque::new(),
            draws: None,
            newest: None,
            ticks: 0,
        }
    }

    /// Takes up a session from its journal. An error names the entry that does not fit.
    pub fn restore(&mut self, entries: Vec<Entry>) -> Result<Vec<Output>, String> {
        for (i, entry) in entries.into_iter().enumerate() {
            match entry {
                Entry::Task(scene) => {
                    self.evidence.set_task(*scene).map_err(|error| format!("entry {i} of the journal: {error}"))?;
                }
                Entry::Record(record) if record.sequence == self.evidence.revision() + 1 => {
                    self.evidence.append(*record);
                }
                Entry::Record(record) => {
                    return Err(format!(
                        "entry {i} of the journal has sequence {}, {} was expected",
                        record.sequence,
                        self.evidence.revision() + 1
                    ));
                }
            }
        }
        self.evidence
            .active_demonstrations()
            .map_err(|error| format!("the journal holds unusable evidence: {error}"))?;
        if self.evidence.task().is_none() {
            return Ok(Vec::new());
        }
        Ok(vec![Output::Evidence(Box::new(self.log())), Output::Recompute])
    }

    /// The evidence so far.
    pub fn evidence(&self) -> &Evidence {
        &self.evidence
    }

    /// Takes one event. Outputs depend on the settings and on the evidence in accepted order, never on `_now`.
    pub fn step(&mut self, _now: Time, event: Event) -> Vec<Output> {
        match event {
            Event::Scene(scene) => self.scene(*scene),
            Event::Demonstration(message) => self.demonstration(message),
            Event::Retraction(message) => {
                let verdict = receive::retraction(&self.evidence, &message);
                self.settle(&message.header, &message.id, &message.source, "retraction", verdict)
            }
            Event::Response(message) => self.response(message),
            Event::Query(query) => self.asked(query),
            Event::Recompute => self.recompute(),
            Event::Tick => self.tick(),
        }
    }

    fn scene(&mut self, scene: TableScene) -> Vec<Output> {
        if self.evidence.task().is_some() {
            return Vec::new();
        }
        let entry = Entry::Task(Box::new(scene.clone()));
        match self.evidence.set_task(scene) {
            Ok(()) => {
                vec![Output::Journal(entry.to_bytes()), Output::Evidence(Box::new(self.log())), Output::Recompute]
            }
            Err(error) => vec![Output::Warn(format!("the scene is ignored: {error}"))],
        }
    }

    fn demonstration(&mut self, message: Box<PlacementDemonstration>) -> Vec<Output> {
        let mut outputs = Vec::new();
        let verdict = receive::demonstration(&self.evidence, self.open(), &message);
        if self.evidence.task().is_none() && matches!(verdict, Verdict::Accept(_)) {
            outputs = self.scene(message.scene.clone());
        }
        if let Verdict::Unknown(_) = verdict {
            return self.wait(message.id.clone(), Waiting::Demonstration(message));
        }
        outputs.extend(self.settle(&message.header, &message.id, &message.source, "demonstration", verdict));
        outputs
    }

    fn response(&mut self, message: Box<QueryResponse>) -> Vec<Output> {
        let verdict = receive::response(&self.evidence, self.open(), &message);
        if let Verdict::Unknown(_) = verdict {
            return self.wait(message.id.clone(), Waiting::Response(message));
        }
        self.settle(&message.header, &message.id, &message.source, "response", verdict)
    }

    fn asked(&mut self, query: Box<PlacementQuery>) -> Vec<Output> {
        if !self.known.contains(&query.id) {
            if self.known.len() == MAX_KNOWN {
                self.known.remove(0);
            }
            self.known.push(query.id.clone());
        }
        if query.revision == self.evidence.revision() {
            self.query = Some(query);
        }
        let waiting = std::mem::take(&mut self.waiting);
        waiting.into_iter().flat_map(|(_, answer)| self.retry(answer)).collect()
    }

    fn retry(&mut self, answer: Waiting) -> Vec<Output> {
        match answer {
            Waiting::Demonstration(message) => self.demonstration(message),
            Waiting::Response(message) => self.response(message),
        }
    }

    fn wait(&mut self, id: String, answer: Waiting) -> Vec<Output> {
        let same = |(_, waiting): &(u32, Waiting)| match waiting {
            Waiting::Demonstration(message) => message.id == id,
            Waiting::Response(message) => message.id == id,
        };
        if self.waiting.iter().any(same) {
            return Vec::new();
        }
        let mut outputs = Vec::new();
        if self.waiting.len() == MAX_WAITING
            && let Some((_, oldest)) = self.waiting.pop_front()
        {
            outputs = self.give_up(&oldest);
        }
        self.waiting.push_back((PATIENCE_TICKS, answer));
        outputs
    }

    fn give_up(&mut self, answer: &Waiting) -> Vec<Output> {
        let (header, id, source, what, verdict) = match answer {
            Waiting::Demonstration(m) => {
                (&m.header, &m.id, &m.source, "demonstration", receive::demonstration(&self.evidence, self.open(), m))
            }
            Waiting::Response(m) => {
                (&m.header, &m.id, &m.source, "response", receive::response(&self.evidence, self.open(), m))
            }
        };
        let verdict = if let Verdict::Unknown(reason) = verdict { Verdict::Refuse(reason) } else { verdict };
        self.settle(header, id, source, what, verdict)
    }

    fn tick(&mut self) -> Vec<Output> {
        let mut outputs = Vec::new();
        for (patience, _) in &mut self.waiting {
            *patience = patience.saturating_sub(1);
        }
        while self.waiting.front().is_some_and(|(patience, _)| *patience == 0) {
            if let Some((_, answer)) = self.waiting.pop_front() {
                outputs.extend(self.give_up(&answer));
            }
        }
        self.ticks += 1;
        if f64::from(self.ticks) >= self.settings.republish_period_s {
            self.ticks = 0;
            if self.evidence.task().is_some() {
                outputs.push(Output::Evidence(Box::new(self.log())));
            }
            outputs.extend(self.newest.clone().map(Output::Posterior));
        }
        outputs
    }

    fn settle(&mut self, header: &Header, id: &str, source: &str, what: &str, verdict: Verdict) -> Vec<Output> {
        let receipt = |outcome, reason: String, revision| {
            let header = Header { stamp: header.stamp, frame_id: String::new() };
            Output::Receipt(EvidenceReceipt { header, id: id.chars().take(128).collect(), outcome, reason, revision })
        };
        match verdict {
            Verdict::Accept(record) => {
                let revision = record.sequence;
                let journal = Entry::Record(record.clone()).to_bytes();
                self.evidence.append(*record);
                self.query = None;
                vec![
                    Output::Journal(journal),
                    receipt(EvidenceReceipt::ACCEPTED, String::new(), revision),
                    Output::Evidence(Box::new(self.log())),
                    Output::Recompute,
                ]
            }
            Verdict::Duplicate(revision) => {
                vec![receipt(
                    EvidenceReceipt::DUPLICATE,
                    format!("it was accepted before, as revision {revision}"),
                    revision,
                )]
            }
            Verdict::Refuse(reason) | Verdict::Unknown(reason) => {
                let id: String = id.chars().take(128).collect();
                let source: String = source.chars().take(128).collect();
                let warning = format!("{what} '{id}' from '{source}' is refused: {reason}");
                vec![receipt(EvidenceReceipt::REFUSED, reason, 0), Output::Warn(warning)]
            }
        }
    }

    fn recompute(&mut self) -> Vec<Output> {
        let Some(scene) = self.evidence.newest_scene().cloned() else { return Vec::new() };
        if self.newest.as_ref().is_some_and(|newest| newest.revision == self.evidence.revision()) {
            return Vec::new();
        }
        let demonstrations = match self.evidence.active_demonstrations() {
            Ok(demonstrations) => demonstrations,
            Err(error) => {
                return vec![Output::Warn(format!("no posterior, because the evidence is unusable: {error}"))];
            }
        };
        let names = self.evidence.feature_names();
        let hash: String = evidence_hash(&demonstrations).iter().map(|byte| format!("{byte:02x}")).collect();
        let draws = match self.draws.take() {
            // A skipped question changes nothing that the draws depend on.
            Some((of, draws)) if of == hash => draws,
            _ => match self.sample(&demonstrations) {
                Ok(draws) => draws,
                Err(error) => return vec![Output::Warn(format!("no posterior: {error}"))],
            },
        };
        let message = Box::new(self.message(scene, names, &hash, demonstrations.len(), &draws));
        self.draws = Some((hash, draws));
        self.newest = Some(message.clone());
        vec![Output::Posterior(message)]
    }

    fn sample(&self, demonstrations: &[Demonstration]) -> Result<Draws, String> {
        let (_, task) = self.evidence.task().ok_or("no scene has named the weights yet")?;
        let (settings, seed) = (self.settings.sampler(), self.settings.seed.unsigned_abs());
        posterior::sample(&settings, seed, &Lesson::new(task), demonstrations).map_err(|error| error.to_string())
    }

    fn message(&self, scene: TableScene, names: Vec<String>, hash: &str, n: usize, draws: &Draws) -> Posterior {
        let (outcome, reason) = if draws.rhat_max <= risk::MAX_RHAT {
            (Posterior::READY, String::new())
        } else {
            let reason = format!(
                "R-hat of the weights is {:.3}, at most {} is allowed; raise n_draws",
                draws.rhat_max,
                risk::MAX_RHAT
            );
            (Posterior::NOT_MIXED, reason)
        };
        let n_draws = draws.n_chains * draws.per_chain;
        Posterior {
            header: self.evidence.header(),
            revision: self.evidence.revision(),
            evidence_hash: hash.to_owned(),
            n_demonstrations: n as u64,
            n_answers: self.evidence.n_answers(),
            stopped: self.evidence.stopped(),
            task: self.evidence.task().map(|(message, _)| message.clone()).unwrap_or_default(),
            scene,
            outcome,
            reason,
            feature_names: names,
            n_chains: u32::try_from(draws.n_chains).unwrap_or(u32::MAX),
            n_draws: u32::try_from(n_draws).unwrap_or(u32::MAX),
            draws: draws.values.clone(),
            map_weights: draws.map_weights.clone(),
            map_log_likelihood: draws.map_log_likelihood,
            log_likelihood_mean: draws.log_likelihood_mean(),
            rhat_max: draws.rhat_max,
            ess_bulk_min: draws.ess_bulk_min,
            ess_tail_min: draws.ess_tail_min,
            acceptance: draws.acceptance,
            beta: self.settings.beta,
            prior: self.settings.prior.name().to_owned(),
            seed: self.settings.seed.unsigned_abs(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
        }
    }

    fn open(&self) -> Open<'_> {
        let query = self.query.as_deref().filter(|query| query.revision == self.evidence.revision());
        Open { query, known: &self.known }
    }

    fn log(&self) -> EvidenceLog {
        EvidenceLog {
            header: self.evidence.header(),
            task: self.evidence.task().map(|(message, _)| message.clone()).unwrap_or_default(),
            records: self.evidence.records().to_vec(),
        }
    }
}

/// Feeds a node the task and the records of a log, as they were accepted, and gives the posterior after each: revisions
/// 0, 1, … in order. An error ends it.
///
/// What a replay does; the rules of acceptance are not applied again, since which question was open is not in the log.
pub fn replay_records(
    settings: Settings,
    task: TableScene,
    records: &[EvidenceRecord],
) -> impl Iterator<Item = Result<Posterior, String>> {
    let mut node = RewardPosterior::new(settings);
    let entries = [Entry::Task(Box::new(task))]
        .into_iter()
        .chain(records.iter().map(|record| Entry::Record(Box::new(record.clone()))));
    entries.map(move |entry| {
        node.restore(vec![entry])?;
        match node.recompute().pop() {
            Some(Output::Posterior(posterior)) => Ok(*posterior),
            Some(Output::Warn(text)) => Err(text),
            _ => Err("it has no posterior".into()),
        }
    })
}
