//! What reaches the node, and what it wants done.

use crate::hub::PageId;
use crate::protocol::RecordingView;
use apprentice_msgs::msg::{
    ActionDemonstration, ArmModel, ArmMotion, ArmPose, Carrying, EvidenceLog, EvidenceReceipt, Heartbeat,
    LearnerHistory, LessonStatus, PerformanceBounds, PlacementDemonstration, PlacementPlan, PlacementQuery,
    PolicyBounds, PolicyFrontier, Posterior, QueryResponse, Retraction, RiskPreference, RobustPolicy, SegmentCritique,
    TableScene, TabularWorld, TrajectoryPreference, WorldQuery,
};
use apprentice_msgs::visualization_msgs::{
    InteractiveMarker, InteractiveMarkerFeedback, InteractiveMarkerUpdate, MarkerArray,
};

/// What happens to the node.
#[derive(Debug, Clone, PartialEq)]
pub enum Event {
    /// The table as it is.
    Scene(Box<TableScene>),
    /// The open question.
    Query(Box<PlacementQuery>),
    /// Where the lesson stands.
    Lesson(Box<LessonStatus>),
    /// A bound.
    Bounds(Box<PerformanceBounds>),
    /// A posterior.
    Posterior(Box<Posterior>),
    /// The robot's placement in the question's scene.
    Guess(Box<PlacementPlan>),
    /// The robot's placement on the table as it is.
    Plan(Box<PlacementPlan>),
    /// What became of some evidence.
    Receipt(Box<EvidenceReceipt>),
    /// Everything accepted so far.
    Evidence(Box<EvidenceLog>),
    /// The world of a lesson that is about one.
    World(Box<TabularWorld>),
    /// The open question about it.
    WorldQuery(Box<WorldQuery>),
    /// What the robot would do in it.
    Policy(Box<RobustPolicy>),
    /// What every caution buys.
    Frontier(Box<PolicyFrontier>),
    /// Bounds on policies, the robot's among them.
    PolicyBounds(Box<PolicyBounds>),
    /// What the arm looks like.
    ArmModel(Box<ArmModel>),
    /// Where its links are.
    ArmPose(Box<ArmPose>),
    /// How it would carry out the plan.
    ArmMotion(Box<ArmMotion>),
    /// What it is doing about the plan.
    Carrying(Box<Carrying>),
    /// A node is alive.
    Heartbeat(Box<Heartbeat>),
    /// The recordings that there are.
    Recordings(Vec<RecordingView>),
    /// What was said in a recording that a page wants to take up.
    Recorded(Box<Recorded>),
    /// A page has connected.
    Joined(PageId),
    /// A page has sent a text.
    Said(PageId, String),
    /// A person has moved or pressed an interactive marker; the second is a fresh id for what that says.
    Handled(Box<InteractiveMarkerFeedback>, String),
    /// Half a second has passed.
    Tick,
}

/// What was found in a recording.
#[derive(Debug, Clone, PartialEq)]
pub struct Recorded {
    /// Of the command that asked for it.
    pub id: String,
    /// Of the recording.
    pub name: String,
    /// Everything that was said in it, or why that cannot be had.
    pub log: Result<EvidenceLog, String>,
}

/// A text for pages.
#[derive(Debug, Clone, PartialEq)]
pub struct Told {
    /// For this page; `None`: for all.
    pub to: Option<PageId>,
    /// JSON of a [`ToPage`](crate::protocol::ToPage).
    pub text: String,
}

/// What the node wants done.
#[derive(Debug, Clone, PartialEq)]
pub enum Output {
    /// Publish, now and again until there is a receipt.
    Demonstration(Box<PlacementDemonstration>),
    /// Publish, now and again until there is a receipt.
    Actions(Box<ActionDemonstration>),
    /// Publish, now and again until there is a receipt.
    Critique(Box<SegmentCritique>),
    /// Publish, now and again until there is a receipt.
    Comparison(Box<TrajectoryPreference>),
    /// Publish, now and again until there is a receipt.
    History(Box<LearnerHistory>),
    /// Publish, now and again until there is a receipt.
    Retraction(Box<Retraction>),
    /// Publish, now and again until there is a receipt.
    Response(Box<QueryResponse>),
    /// Publish, now and again until a policy follows it.
    Preference(Box<RiskPreference>),
    /// Publish for RViz.
    Markers(Box<MarkerArray>),
    /// Publish for those who show interactive markers, and let the service tell all of them to who comes later.
    Handles {
        /// What has changed.
        update: Box<InteractiveMarkerUpdate>,
        /// All there are after it.
        all: Vec<InteractiveMarker>,
    },
    /// Look up the recordings, and answer with [`Event::Recordings`].
    LookUp,
    /// Read a recording of this name for the command of this id, and answer with [`Event::Recorded`].
    Read {
        /// Of the command.
        id: String,
        /// Of the recording.
        name: String,
    },
    /// Send to pages.
    Told(Told),
    /// Log.
    Warn(String),
}
