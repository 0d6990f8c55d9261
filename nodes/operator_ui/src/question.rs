//! From a page's command to evidence: what may be answered, and the sentence a person reads when it may not.

use crate::answers::Answers;
use crate::evidence::Evidence;
use crate::protocol::{Confidence, FromPage, Kind};
use crate::world_answers::{acted, asked_again, compared, compared_places, marked};
use apprentice_msgs::geometry_msgs::Point;
use apprentice_msgs::msg::{
    LessonStatus, PlacementDemonstration, PlacementQuery, QueryResponse, Retraction, TableScene, WorldQuery,
};
use apprentice_msgs::std_msgs::Header;
use bus::Time;

/// Longer reasons are refused, bytes.
const MAX_REASON: usize = 1000;

/// What a command is judged by.
pub(crate) struct Context<'a> {
    pub source: &'a str,
    pub scene: Option<&'a TableScene>,
    pub query: Option<&'a PlacementQuery>,
    pub world_query: Option<&'a WorldQuery>,
    pub lesson: Option<&'a LessonStatus>,
    pub answers: &'a Answers,
}

impl Context<'_> {
    /// Whether the newest question about a table waits for an answer.
    pub fn is_open(&self) -> bool {
        self.query.is_some_and(|query| self.waits(&query.id, query.revision))
    }

    /// Whether the newest question about a world does.
    pub fn is_world_open(&self) -> bool {
        self.world_query.is_some_and(|query| self.waits(&query.id, query.revision))
    }

    /// Whether nobody has answered a question, and the lesson has not moved on.
    fn waits(&self, id: &str, revision: u64) -> bool {
        let moved_on = self.lesson.is_some_and(|lesson| lesson.revision >= revision && lesson.query_id != id);
        !moved_on && !self.answers.has_answered(id)
    }

    /// The open question about a table, when it has this id.
    fn open(&self, id: &str) -> Result<&PlacementQuery, String> {
        self.query.filter(|query| self.is_open() && query.id == id).ok_or_else(|| self.closed(id))
    }

    /// The open question about a world, when it has this id.
    fn world_open(&self, id: &str) -> Result<&WorldQuery, String> {
        self.world_query.filter(|query| self.is_world_open() && query.id == id).ok_or_else(|| self.closed(id))
    }

    fn closed(&self, id: &str) -> String {
        let of_table = self.query.filter(|_| self.is_open()).map(|query| &query.id);
        let of_world = self.world_query.filter(|_| self.is_world_open()).map(|query| &query.id);
        let now = match of_table.or(of_world) {
            Some(open) => format!("the open question is '{open}'"),
            None => "no question is open now".to_owned(),
        };
        format!("question '{}' is no longer open, so the answer was not sent; {now}", shown(id))
    }

    /// The evidence a command stands for; `None` when its id is known already.
    pub fn evidence(&self, now: &Time, command: FromPage) -> Result<Option<Evidence>, String> {
        let id = id_of(&command);
        if !is_uuid(id) {
            return Err("the id of a command must be a version 4 UUID".into());
        }
        if self.answers.knows(id) {
            return Ok(None);
        }
        let source = self.source.to_owned();
        Ok(Some(match command {
            FromPage::Place { id, query_id, x_m, y_m, confidence } => {
                let scene = if query_id.is_empty() {
                    self.scene.ok_or("there is no table yet to place anything on")?.clone()
                } else {
                    self.open(&query_id)?.scene.clone()
                };
                let on = |v: f64, extent_m: f64| (0.0..=extent_m).contains(&v);
                if !on(x_m, scene.width_m) || !on(y_m, scene.depth_m) {
                    return Err(format!(
                        "({x_m}, {y_m}) m is off the table of {} m x {} m",
                        scene.width_m, scene.depth_m
                    ));
                }
                Evidence::Demonstration(Box::new(PlacementDemonstration {
                    header: Header { stamp: *now, frame_id: scene.header.frame_id.clone() },
                    id,
                    query_id,
                    source,
                    scene,
                    placement: Point { x: x_m, y: y_m, z: 0.0 },
                    confidence: number(confidence),
                }))
            }
            FromPage::Act { id, query_id, action, confidence } => {
                let evidence = acted(self.world_open(&query_id)?, action, number(confidence))?;
                evidence.again(Header { stamp: *now, frame_id: String::new() }, id, query_id, source)
            }
            FromPage::Mark { id, query_id, segments, confidence } => {
                let evidence = marked(self.world_open(&query_id)?, &segments, number(confidence))?;
                evidence.again(Header { stamp: *now, frame_id: String::new() }, id, query_id, source)
            }
            FromPage::Compare { id, query_id, better, confidence } => {
                let evidence = match self.open(&query_id) {
                    Ok(query) => compared_places(query, better, number(confidence))?,
                    Err(_) => compared(self.world_open(&query_id)?, better, number(confidence))?,
                };
                evidence.again(Header { stamp: *now, frame_id: String::new() }, id, query_id, source)
            }
            FromPage::Respond { id, query_id, kind, reason } => {
                let kind = match kind {
                    Kind::Placement => return Err("a placement is sent with 'place', not with 'respond'".into()),
                    Kind::Actions | Kind::Preference | Kind::Critique | Kind::History => {
                        return Err("evidence about a world is no response".into());
                    }
                    Kind::Skip => QueryResponse::SKIP,
                    Kind::CantTell => QueryResponse::CANT_TELL,
                    Kind::Stop => QueryResponse::STOP,
                    Kind::Pause => QueryResponse::PAUSE,
                    Kind::Start => QueryResponse::START,
                    Kind::Finish => QueryResponse::FINISH,
                    Kind::NewLesson => QueryResponse::NEW_LESSON,
                };
                if reason.len() > MAX_REASON {
                    return Err(format!("the reason has {} bytes; at most {MAX_REASON} are taken", reason.len()));
                }
                // A word about the lesson is heard whatever is being asked.
                if [QueryResponse::SKIP, QueryResponse::CANT_TELL].contains(&kind) {
                    self.open(&query_id).map(drop).or_else(|_| self.world_open(&query_id).map(drop))?;
                }
                let header = Header { stamp: *now, frame_id: String::new() };
                let query_id = shown(&query_id);
                Evidence::Response(Box::new(QueryResponse { header, id, query_id, source, kind, reason }))
            }
            FromPage::Retract { id, evidence_id } => Evidence::Retraction(Box::new(Retraction {
                header: Header { stamp: *now, frame_id: String::new() },
                id,
                evidence_id,
                source,
                reason: "taken back on the operator page".into(),
            })),
            FromPage::Caution { .. } | FromPage::Recordings { .. } | FromPage::Load { .. } => {
                return Err("it is no evidence".into());
            }
            FromPage::Again { id, evidence_id } => {
                let before = self.answers.undone(&evidence_id)?.clone();
                let open = self.world_query.filter(|_| self.is_world_open());
                let (evidence, query_id) = asked_again(before, open);
                evidence.again(Header { stamp: *now, frame_id: String::new() }, id, query_id, source)
            }
        }))
    }
}

/// The id of a command.
pub(crate) fn id_of(command: &FromPage) -> &str {
    match command {
        FromPage::Place { id, .. }
        | FromPage::Act { id, .. }
        | FromPage::Mark { id, .. }
        | FromPage::Compare { id, .. }
        | FromPage::Respond { id, .. }
        | FromPage::Retract { id, .. }
        | FromPage::Again { id, .. }
        | FromPage::Recordings { id }
        | FromPage::Load { id, .. }
        | FromPage::Caution { id, .. } => id,
    }
}

fn number(confidence: Confidence) -> u8 {
    match confidence {
        Confidence::Sure => PlacementDemonstration::CONFIDENCE_SURE,
        Confidence::Fairly => PlacementDemonstration::CONFIDENCE_FAIRLY,
        Confidence::Guess => PlacementDemonstration::CONFIDENCE_GUESS,
    }
}

/// An id cut to what fits a message to a person.
fn shown(id: &str) -> String {
    id.chars().take(128).collect()
}

/// Whether a text is a version 4 UUID in lower case.
pub(crate) fn is_uuid(text: &str) -> bool {
    text.len() == 36
        && text.bytes().enumerate().all(|(i, byte)| match i {
            8 | 13 | 18 | 23 => byte == b'-',
            14 => byte == b'4',
            19 => matches!(byte, b'8' | b'9' | b'a' | b'b'),
            _ => matches!(byte, b'0'..=b'9' | b'a'..=b'f'),
        })
}

#[cfg(test)]
mod tests {
    use super::is_uuid;

    #[test]
    fn only_version_4_uuids_are_ids() {
        assert!(is_uuid("0f8fad5b-d9cb-469f-a165-70867728950e"));
        for bad in [
            "",
            "0f8fad5b-d9cb-169f-a165-70867728950e",
            "0F8FAD5B-d9cb-469f-a165-70867728950e",
            "é".repeat(18).as_str(),
        ] {
            assert!(!is_uuid(bad), "{bad}");
        }
    }
}
