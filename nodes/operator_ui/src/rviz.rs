//! The open question as interactive markers (`visualization_msgs/InteractiveMarker`), for RViz and whoever else speaks their
//! protocol: what is drawn can be moved and pressed, and that becomes the same commands as a page sends.
//!
//! The protocol is that of the `interactive_markers` package in ROS 2: a client asks the service for everything at a sequence
//! number and then takes the updates after it, one number after another; what people do comes back as feedback. Names of
//! handles carry the question's id, so that what was meant for one question never answers the next.

mod draft;
mod layout;
mod map;
mod table;
mod tiles;
mod world;

pub(crate) use map::map;

use crate::protocol::{Better, Confidence, FromPage, Kind, SceneView, Segment, WorldView};
use apprentice_msgs::msg::{PlacementQuery, WorldQuery};
use apprentice_msgs::visualization_msgs::{
    InteractiveMarker, InteractiveMarkerFeedback as Feedback, InteractiveMarkerUpdate,
};
use draft::Draft;
use scene::Point;
use tiles::{Column, FAIRLY, GUESS, PASS, STOP, SURE};

/// Longer hints are cut, characters.
const MAX_HINT: usize = 160;
/// A shorter way is no move.
const TOUCH_M: f64 = 1e-4;

/// What is asked at the moment.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Asked<'a> {
    /// Nothing.
    Nothing,
    /// Where something belongs, or in which of two places it is better.
    Table(&'a PlacementQuery, &'a SceneView),
    /// Something about a world, drawn in that frame.
    World(&'a WorldQuery, &'a WorldView, &'a str),
}

impl Asked<'_> {
    fn id(&self) -> &str {
        match self {
            Self::Nothing => "",
            Self::Table(query, _) => &query.id,
            Self::World(query, ..) => &query.id,
        }
    }
}

/// The handles, as clients have them.
#[derive(Debug, Clone, Default)]
pub(crate) struct Handles {
    shown: Vec<InteractiveMarker>,
    sequence: u64,
    draft: Draft,
}

impl Handles {
    /// Everything that is shown.
    pub fn all(&self) -> &[InteractiveMarker] {
        &self.shown
    }

    /// What is to be published so that clients show what is asked; `None` when they do.
    pub fn refresh(&mut self, asked: Asked<'_>, server_id: &str) -> Option<InteractiveMarkerUpdate> {
        // An answer that is refused opens its question again, with everything as it was.
        if !matches!(asked, Asked::Nothing) && self.draft.question != asked.id() {
            let n_steps = match asked {
                Asked::World(query, ..) if query.kind == WorldQuery::CRITIQUE => {
                    query.trajectories.first().map_or(0, |way| way.states.len())
                }
                _ => 0,
            };
            self.draft = Draft::new(asked.id(), n_steps);
        }
        let wanted = match asked {
            Asked::Nothing => Vec::new(),
            Asked::Table(query, scene) => table::handles(query, scene, &self.draft),
            Asked::World(query, world, frame) => world::handles(query, world, frame, &self.draft),
        };
        let known = |of: &[InteractiveMarker], name: &str| of.iter().position(|marker| marker.name == name);
        let changed =
            wanted.iter().filter(|marker| known(&self.shown, &marker.name).map(|i| &self.shown[i]) != Some(marker));
        let markers: Vec<InteractiveMarker> = changed.cloned().collect();
        let erases: Vec<String> = self
            .shown
            .iter()
            .filter(|marker| known(&wanted, &marker.name).is_none())
            .map(|marker| marker.name.clone())
            .collect();
        if markers.is_empty() && erases.is_empty() {
            return None;
        }
        self.shown = wanted;
        self.sequence += 1;
        Some(InteractiveMarkerUpdate {
            server_id: server_id.to_owned(),
            seq_num: self.sequence,
            r#type: InteractiveMarkerUpdate::UPDATE,
            markers,
            poses: Vec::new(),
            erases,
        })
    }

    /// Says something to the person at the handles, until they do the next thing.
    pub fn hint(&mut self, text: &str) {
        self.draft.hint = text.chars().take(MAX_HINT).collect();
    }

    /// Takes what a person did; a command of that id where it says something.
    ///
    /// # Errors
    /// In a sentence, when it cannot be meant.
    pub fn take(&mut self, asked: Asked<'_>, feedback: &Feedback, id: &str) -> Result<Option<FromPage>, String> {
        let is_press = feedback.event_type == Feedback::BUTTON_CLICK;
        let is_menu = feedback.event_type == Feedback::MENU_SELECT;
        let of_question = || feedback.marker_name.strip_prefix(asked.id())?.strip_prefix('/');
        let Some(what) = of_question().filter(|_| !matches!(asked, Asked::Nothing)) else {
            // Only what would have said something is worth a word.
            return if is_press || is_menu { Err("that question is no longer open".into()) } else { Ok(None) };
        };
        if let (Asked::Table(query, scene), "target", Feedback::MOUSE_UP) = (asked, what, feedback.event_type) {
            self.put(query, scene, feedback);
            return Ok(None);
        }
        if !is_press && !is_menu {
            return Ok(None);
        }
        self.draft.hint.clear();
        let confidence = match (is_menu, feedback.menu_entry_id) {
            (false, _) | (true, SURE) => Some(Confidence::Sure),
            (true, FAIRLY) => Some(Confidence::Fairly),
            (true, GUESS) => Some(Confidence::Guess),
            _ => None,
        };
        let (id, query_id) = (id.to_owned(), asked.id().to_owned());
        let respond =
            |kind| FromPage::Respond { id: id.clone(), query_id: query_id.clone(), kind, reason: String::new() };
        let is_comparison = match asked {
            Asked::Nothing => false,
            Asked::Table(query, _) => query.options.len() == 2,
            Asked::World(query, ..) => query.kind == WorldQuery::COMPARISON,
        };
        match (what, feedback.menu_entry_id) {
            ("skip", _) => return Ok(Some(respond(Kind::Skip))),
            ("stop", _) => return Ok(Some(respond(Kind::Stop))),
            ("target", table::SKIP) if is_menu => return Ok(Some(respond(Kind::Skip))),
            ("target", table::CANT_TELL) if is_menu && !is_comparison => return Ok(Some(respond(Kind::CantTell))),
            ("cant_tell", _) if !is_comparison => return Ok(Some(respond(Kind::CantTell))),
            ("all_good", _) => {
                self.draft.marks.fill(Some(true));
                return Ok(None);
            }
            _ => {}
        }
        if let Some(step) = numbered(what, "step ") {
            self.draft.press(step as usize);
            return Ok(None);
        }
        let says_nothing = is_menu && what == "target" && feedback.menu_entry_id == table::CANT_TELL;
        let Some(confidence) = confidence.or(says_nothing.then_some(Confidence::Sure)) else { return Ok(None) };
        let better = |better| FromPage::Compare { id: id.clone(), query_id: query_id.clone(), better, confidence };
        Ok(Some(match what {
            "target" if says_nothing => better(Better::CantTell),
            "target" | "place" => {
                let at_m = self.draft.at_m.ok_or("first move it to where it belongs")?;
                if self.draft.is_blocked {
                    return Err("it does not fit there".into());
                }
                FromPage::Place { id, query_id, x_m: at_m[0], y_m: at_m[1], confidence }
            }
            "first" | "first tile" => better(Better::First),
            "second" | "second tile" => better(Better::Second),
            "equal" => better(Better::Equal),
            "cant_tell" => better(Better::CantTell),
            "send" => {
                let segments: Vec<Segment> = self.draft.segments();
                if segments.is_empty() {
                    return Err("first press the steps that are good or bad".into());
                }
                FromPage::Mark { id, query_id, segments, confidence }
            }
            _ => match numbered(what, "action ") {
                Some(action) => FromPage::Act { id, query_id, action, confidence },
                None => return Ok(None),
            },
        }))
    }

    /// The target was let go.
    fn put(&mut self, query: &PlacementQuery, scene: &SceneView, feedback: &Feedback) {
        let at = feedback.pose.position;
        if feedback.header.frame_id != scene.frame_id {
            self.hint(&format!("its place has to be told in the frame '{}'", scene.frame_id));
            return;
        }
        // Who only touches it has not moved it.
        let shown =
            self.shown.iter().find(|marker| marker.name == feedback.marker_name).map(|marker| &marker.pose.position);
        if shown.is_some_and(|shown| f64::hypot(shown.x - at.x, shown.y - at.y) < TOUCH_M) {
            return;
        }
        let occupied = exchange::scene_from_message(&query.scene).map(|scene| scene.occupied());
        let obstruction = |[x, y]: [f64; 2]| match &occupied {
            Ok(occupied) => occupied.reason(Point { x, y }).map(|reason| reason.to_string()),
            Err(_) => None,
        };
        self.draft.put(scene, obstruction, [at.x, at.y]);
    }
}

/// The name of a handle of a question.
fn named(query_id: &str, what: &str) -> String {
    format!("{query_id}/{what}")
}

/// The number in a name.
fn numbered(what: &str, before: &str) -> Option<u32> {
    what.strip_prefix(before)?.parse().ok()
}

/// The tiles that give no answer.
fn passes(frame: &str, id: &str, column: &mut Column) -> [InteractiveMarker; 3] {
    [("cant_tell", "Can't tell", PASS), ("skip", "Skip", PASS), ("stop", "None of this: stop", STOP)]
        .map(|(what, word, rgba)| column.tile(frame, named(id, what), word, rgba))
}
