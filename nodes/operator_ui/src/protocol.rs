//! What travels between the node and a page: JSON texts over one WebSocket.
//!
//! The node sends the whole state when a page joins and afterwards the sections that changed ([`ToPage::State`]).
//! The page sends commands ([`FromPage`]), each with an id of its own making, and sends them again after a lost
//! connection until it has seen what became of them; a command with a known id changes nothing. Numbers keep their
//! full precision; what is not finite is `null`. Lengths are metres, the frame is the scene's.

mod arm;
mod shown;
mod world;

pub use arm::{ArmMotionView, ArmView, CarryingView, PartShape, PartView};
pub use shown::{
    AnswerView, BoundsView, CandidateView, Fate, LessonView, NodeView, ObjectView, PlanView, PosteriorView,
    QuestionView, RecordingView, SceneView, SpotView, TrendPoint, UndoView,
};
pub use world::{
    BoundView, CautionView, FrontierView, LossPoint, PictureView, PointView, PolicyView, RobustBoundsView, WayView,
    WeightView, WorldQuestionView, WorldView,
};

use serde::{Deserialize, Serialize};

/// Version of this protocol; a page with another one loads itself anew.
pub const PROTOCOL: u32 = 1;
/// A longer text from a page ends its connection, bytes.
pub const MAX_FROM_PAGE: usize = 64 * 1024;
/// At most this many answers are shown, the newest.
pub const MAX_ANSWERS: usize = 200;

/// From the node to a page.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum ToPage {
    /// New sections of the state.
    State {
        /// [`PROTOCOL`].
        protocol: u32,
        /// The sections that changed; all of them for a page that has just joined.
        sections: Box<Sections>,
    },
    /// A command was not carried out.
    Refused {
        /// Of the command; `null` when it could not be read.
        id: Option<String>,
        /// One sentence.
        reason: String,
    },
    /// Something a person should know.
    Notice {
        /// One sentence.
        text: String,
    },
    /// The node is alive. Every two seconds.
    Tick,
}

/// Parts of the state; absent when unchanged, `null` when there is none.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Sections {
    /// The table as it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scene: Option<Option<SceneView>>,
    /// The newest question, open or not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub question: Option<Option<QuestionView>>,
    /// Where the robot would place the target in the question's scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub guess: Option<Option<PlanView>>,
    /// Where the robot would place the target on the table as it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plan: Option<Option<PlanView>>,
    /// Where the lesson stands.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lesson: Option<Option<LessonView>>,
    /// The newest bound with its receipt.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bounds: Option<Option<BoundsView>>,
    /// The newest posterior, without its draws.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub posterior: Option<Option<PosteriorView>>,
    /// One point a revision, oldest first.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trend: Option<Vec<TrendPoint>>,
    /// Answers in accepted order, then those on their way; the newest [`MAX_ANSWERS`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub answers: Option<Vec<AnswerView>>,
    /// The world that the lesson is about.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub world: Option<Option<WorldView>>,
    /// The newest question about it, open or not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub world_question: Option<Option<WorldQuestionView>>,
    /// What the robot would do in it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub policy: Option<Option<PolicyView>>,
    /// What every caution buys.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frontier: Option<Option<FrontierView>>,
    /// Bounds on what the robot would do.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub robust_bounds: Option<Option<RobustBoundsView>>,
    /// How cautious a page asked the robot to be.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub caution: Option<Option<CautionView>>,
    /// What each weight of the world may be.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub weights: Option<Vec<WeightView>>,
    /// The bound on the loss, one point a revision, oldest first.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub loss_trend: Option<Vec<LossPoint>>,
    /// Every node that was heard of.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nodes: Option<Vec<NodeView>>,
    /// What the arm looks like.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub arm: Option<Option<ArmView>>,
    /// Where it is: the poses of all links.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub arm_pose: Option<Option<Vec<f64>>>,
    /// How it would carry out the plan for the table as it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub arm_motion: Option<Option<ArmMotionView>>,
    /// How far it is with that, or how it came out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub carrying: Option<Option<CarryingView>>,
    /// Recordings that a lesson can be taken up from, the newest first.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recordings: Option<Vec<RecordingView>>,
}

/// What kind of answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// The target's place was shown.
    Placement,
    /// Ask later.
    Skip,
    /// No opinion.
    CantTell,
    /// Nothing is acceptable.
    Stop,
    /// Ask nothing for a while.
    Pause,
    /// Begin to ask, or go on.
    Start,
    /// Enough has been said.
    Finish,
    /// What was said before counts no more.
    NewLesson,
    /// It was shown what to do in states of a world.
    Actions,
    /// Trajectories were compared.
    Preference,
    /// Parts of a trajectory were marked.
    Critique,
    /// Attempts of somebody who was learning.
    History,
}

/// How sure a person is of a placement.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Confidence {
    /// Sure.
    Sure,
    /// Fairly sure.
    Fairly,
    /// A guess.
    Guess,
}

/// From a page to the node. Every `id` is a version 4 UUID.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
pub enum FromPage {
    /// The target belongs here.
    Place {
        /// Of the answer.
        id: String,
        /// The open question; empty for a placement on the table as it is.
        query_id: String,
        /// To the right.
        x_m: f64,
        /// Away from the robot.
        y_m: f64,
        /// How sure the person is.
        confidence: Confidence,
    },
    /// This is what to do in the state of the open question.
    Act {
        /// Of the answer.
        id: String,
        /// The open question.
        query_id: String,
        /// Counted from 0.
        action: u32,
        /// How sure the person is.
        confidence: Confidence,
    },
    /// These parts of the way of the open question are good or bad.
    Mark {
        /// Of the answer.
        id: String,
        /// The open question.
        query_id: String,
        /// One or more, none overlapping another.
        segments: Vec<Segment>,
        /// How sure the person is.
        confidence: Confidence,
    },
    /// Which of the two ways or places of the open question is better.
    Compare {
        /// Of the answer.
        id: String,
        /// The open question.
        query_id: String,
        /// What is said.
        better: Better,
        /// How sure the person is.
        confidence: Confidence,
    },
    /// An answer that is none of these.
    Respond {
        /// Of the answer.
        id: String,
        /// The open question; may be empty for a word about the lesson.
        query_id: String,
        /// [`Kind::Skip`], [`Kind::CantTell`], or a word about the lesson.
        kind: Kind,
        /// May be empty.
        #[serde(default)]
        reason: String,
    },
    /// Takes an answer back.
    Retract {
        /// Of the retraction.
        id: String,
        /// What is taken back.
        evidence_id: String,
    },
    /// Gives what was taken back once more.
    Again {
        /// Of the new answer.
        id: String,
        /// Which.
        evidence_id: String,
    },
    /// Looks up the recordings anew.
    Recordings {
        /// Of the command.
        id: String,
    },
    /// Begins a new lesson with what was said in a recording.
    Load {
        /// Of the command.
        id: String,
        /// Of the recording.
        name: String,
    },
    /// How cautious the robot is to be in a world.
    Caution {
        /// Of the preference.
        id: String,
        /// From 0, only the worst case counts, to 1, only the mean counts.
        lambda: f64,
    },
}

/// Steps that a person marked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Segment {
    /// First step, counted from 0.
    pub start: u32,
    /// The step after the last.
    pub end: u32,
    /// Whether that is how it should be done.
    pub good: bool,
}

/// Which of two ways or places.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Better {
    /// The first: on the left, or called A.
    First,
    /// The second.
    Second,
    /// Neither.
    Equal,
    /// No opinion.
    CantTell,
}
