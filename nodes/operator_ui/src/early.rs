//! Answers to a question that a node, just started anew, has not heard of: they wait a moment for it, since the page has sent them
//! again as soon as it was connected.

use crate::hub::PageId;
use crate::protocol::FromPage;
use crate::question::Context;
use bus::Time;

/// They wait this long, nanoseconds.
const WAIT_NS: i128 = 5_000_000_000;
/// When there are more, they wait no longer.
const MAX_EARLY: usize = 32;

/// What pages have said and nobody has judged yet.
#[derive(Debug, Clone, Default)]
pub(crate) struct Early {
    said: Vec<(Time, PageId, FromPage)>,
}

impl Early {
    /// A page has said something.
    pub fn add(&mut self, now: Time, page: PageId, command: FromPage) {
        self.said.push((now, page, command));
    }

    /// What is to be judged now, in the order in which it was said.
    pub fn ready(&mut self, now: &Time, context: &Context<'_>) -> Vec<(PageId, FromPage)> {
        let is_full = self.said.len() > MAX_EARLY;
        let (wait, ready): (Vec<_>, Vec<_>) =
            std::mem::take(&mut self.said).into_iter().partition(|(since, _, command)| {
                !is_full && now.nanoseconds_since(since) < WAIT_NS && is_early(context, command)
            });
        self.said = wait;
        ready.into_iter().map(|(_, page, command)| (page, command)).collect()
    }
}

/// Whether a command answers a question that is not known, where the lesson is not known to ask another one.
fn is_early(context: &Context<'_>, command: &FromPage) -> bool {
    let id = match command {
        FromPage::Place { query_id, .. }
        | FromPage::Act { query_id, .. }
        | FromPage::Mark { query_id, .. }
        | FromPage::Compare { query_id, .. }
        | FromPage::Respond { query_id, .. } => query_id,
        _ => return false,
    };
    let is_known = context.query.is_some_and(|query| query.id == *id)
        || context.world_query.is_some_and(|query| query.id == *id)
        || context.answers.has_answered(id);
    !id.is_empty() && !is_known && context.lesson.is_none_or(|lesson| lesson.query_id == *id)
}
