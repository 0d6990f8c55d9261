//! Every answer known here: the evidence that was accepted, and what this node's pages sent that is still on its way.
//!
//! What a page said is published again each second until its receipt, or the evidence log, names it. The evidence log
//! is the truth: it overrides anything a receipt said, and it may begin anew with another session.

use crate::evidence::Evidence;
use crate::protocol::{AnswerView, Fate, Kind, MAX_ANSWERS, UndoView};
use apprentice_msgs::msg::{EvidenceLog, EvidenceReceipt, EvidenceRecord, Retraction};
use bus::Time;
use exchange::record_id;

/// What is not acknowledged is published again after this long, nanoseconds.
const REPUBLISH_NS: i128 = 990_000_000;
/// More than this many unacknowledged messages are not kept.
const MAX_WAITING: usize = 1024;

/// Why an answer cannot be taken back.
const EARLIER: &str = "the answer belongs to an earlier lesson";

/// An answer with what is needed to give it again.
#[derive(Debug, Clone)]
struct Entry {
    view: AnswerView,
    given: Option<Evidence>,
    /// Highest revision known when it appeared: its place in the list while it has none of its own.
    after: u64,
}

/// Evidence that has no receipt yet.
#[derive(Debug, Clone)]
struct Waiting {
    evidence: Evidence,
    /// Goes out once evidence with this id is accepted.
    held_for: Option<String>,
    sent: Option<Time>,
}

/// See the module.
#[derive(Debug, Clone, Default)]
pub(crate) struct Answers {
    entries: Vec<Entry>,
    waiting: Vec<Waiting>,
    taken: usize,
    last_id: String,
}

impl Answers {
    /// Whether an id has been used for an answer or a retraction.
    pub fn knows(&self, id: &str) -> bool {
        self.waiting.iter().any(|waiting| waiting.evidence.id() == id)
            || self.entries.iter().any(|entry| entry.view.id == id || entry.undo_id() == Some(id))
    }

    /// Whether a question has an answer, in force, on its way or taken back.
    pub fn has_answered(&self, query_id: &str) -> bool {
        self.entries.iter().any(|entry| entry.view.query_id == query_id && entry.view.state != Fate::Refused)
    }

    /// Takes an answer of this node's pages.
    pub fn add(&mut self, evidence: Evidence) -> Result<(), String> {
        if self.waiting.len() >= MAX_WAITING {
            return Err(format!("{MAX_WAITING} answers are waiting to be taken in; is reward_posterior running?"));
        }
        if let Evidence::Retraction(message) = &evidence {
            return self.retract(message.clone());
        }
        let Some(mut view) = evidence.view() else { return Ok(()) };
        view.mine = true;
        self.entries.push(Entry { view, given: Some(evidence.clone()), after: self.revision() });
        self.waiting.push(Waiting { evidence, held_for: None, sent: None });
        Ok(())
    }

    /// Begins a new lesson with what was said in another one, which goes out once the word that begins it is accepted.
    pub fn take_up(&mut self, begin: Evidence, pieces: Vec<Evidence>) -> Result<(), String> {
        let room = MAX_WAITING.saturating_sub(self.waiting.len() + 1);
        if pieces.len() > room {
            return Err(format!("{} answers are too many to take up at once; {room} are taken now", pieces.len()));
        }
        let held_for = begin.id().to_owned();
        self.add(begin)?;
        for evidence in pieces {
            let Some(view) = evidence.view() else { continue };
            self.entries.push(Entry { view, given: Some(evidence.clone()), after: self.revision() });
            self.waiting.push(Waiting { evidence, held_for: Some(held_for.clone()), sent: None });
        }
        Ok(())
    }

    fn retract(&mut self, message: Box<Retraction>) -> Result<(), String> {
        let begins = self.begins();
        let Some(entry) = self.entries.iter_mut().find(|entry| entry.view.id == message.evidence_id) else {
            return Err("the answer that is to be taken back is not known".into());
        };
        match entry.view.state {
            Fate::Accepted if entry.view.revision < begins => return Err(EARLIER.into()),
            Fate::Past => return Err(EARLIER.into()),
            Fate::Accepted | Fate::Pending | Fate::Held => {}
            Fate::Refused => return Err("the answer was refused, so there is nothing to take back".into()),
            Fate::Undone => return Err("the answer has been taken back before".into()),
        }
        if entry.view.undo.as_ref().is_some_and(|undo| undo.state != Fate::Refused) {
            return Err("the answer is being taken back already".into());
        }
        let held = entry.view.state != Fate::Accepted;
        let state = if held { Fate::Held } else { Fate::Pending };
        entry.view.undo = Some(UndoView { id: message.id.clone(), state, revision: None, reason: String::new() });
        let held_for = held.then(|| message.evidence_id.clone());
        self.waiting.push(Waiting { evidence: Evidence::Retraction(message), held_for, sent: None });
        Ok(())
    }

    /// What was taken back, to be given once more.
    pub fn undone(&self, id: &str) -> Result<&Evidence, String> {
        let Some(entry) = self.entries.iter().find(|entry| entry.view.id == id) else {
            return Err("the answer that is to be given again is not known".into());
        };
        match &entry.given {
            _ if entry.view.state != Fate::Undone => {
                Err("the answer has not been taken back, so it needs no giving again".into())
            }
            // Skipping says nothing; what was skipped may be asked again as it is.
            Some(Evidence::Response(_)) | None if entry.view.kind != Kind::Stop => {
                Err("only what was shown, marked or compared can be given again".into())
            }
            Some(given) => Ok(given),
            None => Err("the answer that is to be given again was not kept".into()),
        }
    }

    /// What has to be published now, first time or again.
    pub fn due(&mut self, now: &Time) -> Vec<Evidence> {
        let mut due = Vec::new();
        for waiting in self.waiting.iter_mut().filter(|waiting| waiting.held_for.is_none()) {
            if waiting.sent.as_ref().is_none_or(|sent| now.nanoseconds_since(sent) >= REPUBLISH_NS) {
                waiting.sent = Some(*now);
                due.push(waiting.evidence.clone());
            }
        }
        due
    }

    /// Takes a receipt. Returns whether anything here was meant, and the reason when a retraction that no longer
    /// shows on any answer was refused.
    pub fn receipt(&mut self, receipt: &EvidenceReceipt) -> (bool, Option<String>) {
        let accepted = receipt.outcome != EvidenceReceipt::REFUSED;
        let waited = self.waiting.iter().position(|waiting| waiting.evidence.id() == receipt.id);
        if let Some(index) = waited {
            self.waiting.remove(index);
        }
        let id = receipt.id.as_str();
        if let Some(index) = self.entries.iter().position(|entry| entry.view.id == id) {
            if accepted {
                self.accept(index, receipt.revision);
            } else if self.entries[index].view.state == Fate::Pending {
                self.refuse(index, &receipt.reason);
            }
            return (true, None);
        }
        let Some(entry) = self.entries.iter_mut().find(|entry| entry.undo_id() == Some(id)) else {
            let orphan = waited.is_some() && !accepted;
            return (waited.is_some(), orphan.then(|| receipt.reason.clone()));
        };
        let undo = entry.view.undo.as_mut().expect("the entry was found by its retraction's id");
        if accepted {
            (undo.state, undo.revision) = (Fate::Accepted, Some(receipt.revision));
            entry.view.state = Fate::Undone;
        } else if undo.state != Fate::Accepted {
            (undo.state, undo.reason) = (Fate::Refused, receipt.reason.clone());
        }
        (true, None)
    }

    fn accept(&mut self, index: usize, revision: u64) {
        let view = &mut self.entries[index].view;
        view.revision = Some(revision);
        view.reason = String::new();
        if view.state != Fate::Undone {
            view.state = Fate::Accepted;
        }
        if let Some(undo) = view.undo.as_mut().filter(|undo| undo.state == Fate::Held) {
            undo.state = Fate::Pending;
        }
        let id = view.id.clone();
        for waiting in self.waiting.iter_mut().filter(|waiting| waiting.held_for.as_ref() == Some(&id)) {
            waiting.held_for = None;
        }
    }

    fn refuse(&mut self, index: usize, reason: &str) {
        let view = &mut self.entries[index].view;
        (view.state, view.reason) = (Fate::Refused, reason.to_owned());
        if let Some(undo) = &mut view.undo {
            (undo.state, undo.reason) = (Fate::Refused, "the answer itself was refused".into());
        }
        let id = view.id.clone();
        // What waited for it does not come either.
        let held: Vec<String> = self
            .waiting
            .extract_if(.., |waiting| waiting.held_for.as_ref() == Some(&id))
            .map(|waiting| waiting.evidence.id().to_owned())
            .collect();
        for entry in self.entries.iter_mut().filter(|entry| held.contains(&entry.view.id)) {
            entry.view.state = Fate::Refused;
            "the new lesson was refused".clone_into(&mut entry.view.reason);
        }
    }

    /// Takes the evidence log: everything accepted so far. Returns whether anything changed.
    pub fn log(&mut self, log: &EvidenceLog) -> bool {
        let same = log.records.len() >= self.taken
            && (self.taken == 0 || record_id(&log.records[self.taken - 1]) == self.last_id);
        if !same {
            self.entries.retain(|entry| entry.view.state == Fate::Pending);
            self.taken = 0;
        }
        let changed = !same || log.records.len() > self.taken;
        for record in &log.records[self.taken..] {
            self.record(record);
        }
        self.taken = log.records.len();
        self.last_id = log.records.last().map_or("", record_id).to_owned();
        changed
    }

    fn record(&mut self, record: &EvidenceRecord) {
        self.waiting.retain(|waiting| waiting.evidence.id() != record_id(record));
        if let Some(evidence) = Evidence::of_record(record) {
            let view = evidence.view();
            self.accepted(view, Some(evidence), record.sequence);
        } else if let Some(message) = record.retraction.first() {
            let entry = self.entries.iter_mut().find(|entry| entry.view.id == message.evidence_id);
            if let Some(entry) = entry {
                entry.view.state = Fate::Undone;
                entry.view.undo = Some(UndoView {
                    id: message.id.clone(),
                    state: Fate::Accepted,
                    revision: Some(record.sequence),
                    reason: String::new(),
                });
            }
        }
    }

    fn accepted(&mut self, view: Option<AnswerView>, given: Option<Evidence>, sequence: u64) {
        let Some(view) = view else { return };
        let index = self.entries.iter().position(|entry| entry.view.id == view.id).unwrap_or_else(|| {
            self.entries.push(Entry { view, given, after: sequence });
            self.entries.len() - 1
        });
        self.accept(index, sequence);
    }

    fn revision(&self) -> u64 {
        self.entries.iter().filter_map(|entry| entry.view.revision).max().unwrap_or(0)
    }

    /// The newest answers in accepted order, then those on their way.
    pub fn views(&self) -> Vec<AnswerView> {
        let mut sorted: Vec<&Entry> = self.entries.iter().collect();
        sorted.sort_by_key(|entry| (entry.view.revision.unwrap_or(entry.after), entry.view.revision.is_none()));
        let skipped = sorted.len().saturating_sub(MAX_ANSWERS);
        let begins = self.begins();
        let shown = |entry: &&Entry| {
            let mut view = entry.view.clone();
            if view.state == Fate::Accepted && view.revision < begins {
                view.state = Fate::Past;
            }
            view
        };
        sorted[skipped..].iter().map(shown).collect()
    }

    /// The revision with which the lesson began, if a word of the person began it.
    fn begins(&self) -> Option<u64> {
        let begun = |entry: &&Entry| entry.view.kind == Kind::NewLesson && entry.view.state == Fate::Accepted;
        self.entries.iter().filter(begun).filter_map(|entry| entry.view.revision).max()
    }
}

impl Entry {
    fn undo_id(&self) -> Option<&str> {
        self.view.undo.as_ref().map(|undo| undo.id.as_str())
    }
}
