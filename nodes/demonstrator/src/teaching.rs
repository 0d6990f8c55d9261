//! When the person gives the next piece of evidence: once the last one has been taken in, and while the lesson goes on.

use crate::{Piece, Settings, Teacher};
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{EvidenceReceipt, LessonStatus, TabularWorld};
use exchange::{MAX_ID, world_from_message, world_hash};

/// After this long without a word about the lesson the person goes on anyway, nanoseconds.
const PATIENCE_NS: i128 = 10_000_000_000;

/// The lesson about a world, as the person sees it.
#[derive(Debug)]
pub(crate) struct Teaching {
    settings: Settings,
    teacher: Option<(String, Teacher)>,
    refused: Option<String>,
    /// Pieces given so far.
    given: usize,
    /// The piece that has no receipt yet.
    open: Option<String>,
    /// When the last piece was taken in, nanoseconds, and as which revision.
    taken: Option<(i128, u64)>,
    lesson: Option<(u64, u8)>,
}

impl Teaching {
    pub fn new(settings: &Settings) -> Self {
        Self {
            settings: settings.clone(),
            teacher: None,
            refused: None,
            given: 0,
            open: None,
            taken: None,
            lesson: None,
        }
    }

    /// Whether the person still has something to show unasked; until then questions wait.
    pub fn is_showing(&self) -> bool {
        self.open.is_some() || self.teacher.as_ref().is_some_and(|(_, teacher)| self.given < teacher.n_pieces())
    }

    /// The person in the world that was taken, if any was.
    pub fn teacher(&self) -> Option<&Teacher> {
        self.teacher.as_ref().map(|(_, teacher)| teacher)
    }

    /// Takes the first world that can be used. A text is what to tell.
    pub fn world(&mut self, message: &TabularWorld) -> Option<String> {
        if self.teacher.is_some() {
            return None;
        }
        let hash = world_hash(message);
        if self.refused.as_ref() == Some(&hash) {
            return None;
        }
        match world_from_message(message) {
            Ok(world) => {
                let teacher = Teacher::new(&self.settings, world);
                let unknown = teacher.unknown_features();
                // Who wants nothing of this world has nothing to say about it.
                if unknown.len() == self.settings.reward_names.len() && teacher.n_pieces() == 0 {
                    self.refused = Some(hash);
                    return None;
                }
                let unknown = unknown.join(", ");
                self.teacher = Some((hash, teacher));
                let text = format!("the person's reward names features that are not in this world: {unknown}");
                (!unknown.is_empty()).then_some(text)
            }
            Err(error) => {
                self.refused = Some(hash);
                let id: String = message.id.chars().take(MAX_ID).collect();
                Some(format!("cannot teach in the world '{id}': {error}"))
            }
        }
    }

    pub fn lesson(&mut self, lesson: &LessonStatus) {
        self.lesson = Some((lesson.revision, lesson.state));
    }

    /// Notes that a piece was taken in, or refused.
    pub fn settle(&mut self, now_ns: i128, receipt: &EvidenceReceipt) {
        if self.open.as_ref() != Some(&receipt.id) {
            return;
        }
        self.open = None;
        // After a refusal the next piece is tried.
        let revision = if receipt.outcome == EvidenceReceipt::REFUSED { 0 } else { receipt.revision };
        self.taken = Some((now_ns, revision));
    }

    /// The piece that is to be given now, if any, or what to tell.
    pub fn next(&mut self, now: &Time) -> Option<Result<Piece, String>> {
        let (_, teacher) = self.teacher.as_ref()?;
        if self.open.is_some() || self.given >= teacher.n_pieces() || !self.is_wanted(now.nanoseconds()) {
            return None;
        }
        let index = self.given;
        self.given += 1;
        match teacher.piece(index) {
            Ok(mut piece) => {
                match &mut piece {
                    Piece::Show(message) => message.header.stamp = *now,
                    Piece::Compare(message) => message.header.stamp = *now,
                }
                self.open = Some(piece.id().to_owned());
                Some(Ok(piece))
            }
            Err(error) => Some(Err(format!("cannot show anything in this world: {error}"))),
        }
    }

    /// Whether the lesson goes on, and has taken in what was said before.
    fn is_wanted(&self, now_ns: i128) -> bool {
        let over = self.lesson.is_some_and(|(_, state)| state != LessonStatus::ASKING);
        let Some((at, revision)) = self.taken else { return !over };
        let heard = self.lesson.is_some_and(|(of, _)| of >= revision);
        // A clock that jumped back must not silence the person.
        let waited = now_ns - at;
        (heard && !over) || (!heard && !(0..PATIENCE_NS).contains(&waited))
    }
}
