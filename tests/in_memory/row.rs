//! A row of states to walk along, and what a person may say about it.

use crate::evidence::retraction;
use crate::graph::Lesson;
use apprentice_msgs::msg::{
    ActionDemonstration, CritiqueSegment, FeatureTrajectory, LearnerHistory, PolicySet, PolicyToJudge, SegmentCritique,
    TabularWorld, TrajectoryPreference,
};
use bus::{Publisher, Qos};

/// Actions in the row.
pub const LEFT: u32 = 0;
pub const RIGHT: u32 = 1;

/// `n` states in a row; each has a feature of its own. Left and right lead to the neighbour, at the ends nowhere else.
pub fn row(n: u32) -> TabularWorld {
    let moves = (0..n).flat_map(|s| [(s, LEFT, s.saturating_sub(1)), (s, RIGHT, (s + 1).min(n - 1))]);
    let moves: Vec<(u32, u32, u32)> = moves.collect();
    TabularWorld {
        id: "row".into(),
        gamma: 0.9,
        n_states: n,
        n_actions: 2,
        feature_names: (0..n).map(|s| format!("at {s}")).collect(),
        initial: (0..n).map(|s| f64::from(u8::from(s == n / 2))).collect(),
        from_state: moves.iter().map(|m| m.0).collect(),
        action: moves.iter().map(|m| m.1).collect(),
        to_state: moves.iter().map(|m| m.2).collect(),
        probability: vec![1.0; moves.len()],
        features: (0..n * n).map(|i| f64::from(u8::from(i / n == i % n))).collect(),
        ..TabularWorld::default()
    }
}

pub fn acted(id: &str, steps: &[(u32, u32)]) -> ActionDemonstration {
    ActionDemonstration {
        id: id.into(),
        source: "test".into(),
        world_id: "row".into(),
        states: steps.iter().map(|step| step.0).collect(),
        actions: steps.iter().map(|step| step.1).collect(),
        ..ActionDemonstration::default()
    }
}

pub fn critique(id: &str, steps: &[(u32, u32)], segments: &[(u32, u32, u8)]) -> SegmentCritique {
    let segment = |&(start, end, verdict): &(u32, u32, u8)| CritiqueSegment { start, end, verdict };
    SegmentCritique {
        id: id.into(),
        source: "test".into(),
        world_id: "row".into(),
        states: steps.iter().map(|step| step.0).collect(),
        actions: steps.iter().map(|step| step.1).collect(),
        segments: segments.iter().map(segment).collect(),
        ..SegmentCritique::default()
    }
}

/// Two trajectories that visit one state each.
pub fn pair(n: usize, worse: usize, better: usize) -> Vec<FeatureTrajectory> {
    let at = |state: usize| (0..n).map(|i| f64::from(u8::from(i == state))).collect();
    [worse, better].map(|state| FeatureTrajectory { id: format!("at {state}"), features: at(state) }).to_vec()
}

pub fn preferred(id: &str, trajectories: Vec<FeatureTrajectory>) -> TrajectoryPreference {
    TrajectoryPreference { id: id.into(), source: "test".into(), trajectories, ..TrajectoryPreference::default() }
}

pub fn history(id: &str, demonstrations: Vec<FeatureTrajectory>) -> LearnerHistory {
    LearnerHistory { id: id.into(), source: "test".into(), demonstrations, ..LearnerHistory::default() }
}

/// The policies that go one way, always.
pub fn both_ways(number: u64, n: usize) -> PolicySet {
    let always = |id: &str, action: u32| PolicyToJudge {
        id: id.into(),
        form: PolicyToJudge::TABULAR,
        actions: vec![action; n],
        ..PolicyToJudge::default()
    };
    PolicySet {
        id: format!("set {number}"),
        number,
        world_id: "row".into(),
        policies: vec![always("left", LEFT), always("right", RIGHT)],
        ..PolicySet::default()
    }
}

/// The topics on which a person speaks of worlds and trajectories.
pub struct Person {
    pub world: Publisher<TabularWorld>,
    pub actions: Publisher<ActionDemonstration>,
    pub preference: Publisher<TrajectoryPreference>,
    pub critique: Publisher<SegmentCritique>,
    pub history: Publisher<LearnerHistory>,
    pub policies: Publisher<PolicySet>,
}

impl Person {
    pub fn new(lesson: &mut Lesson) -> Person {
        Person {
            world: lesson.publisher("world", Qos::State),
            actions: lesson.publisher("action_demonstration", Qos::Event),
            preference: lesson.publisher("preference", Qos::Event),
            critique: lesson.publisher("critique", Qos::Event),
            history: lesson.publisher("learner_history", Qos::Event),
            policies: lesson.publisher("policies", Qos::State),
        }
    }

    /// Says one thing of each kind that is about a row of `n` states, and waits until each is accepted.
    pub fn says_everything(&self, lesson: &mut Lesson, n: u32) -> Vec<&'static str> {
        const TAKES_EVERYTHING: &str = "memory takes everything";
        let (middle, n) = (n / 2, n as usize);
        self.actions.publish(&acted("a", &[(middle, RIGHT), (middle + 1, RIGHT)])).expect(TAKES_EVERYTHING);
        lesson.accepted("a");
        self.preference.publish(&preferred("p", pair(n, 0, 2))).expect(TAKES_EVERYTHING);
        lesson.accepted("p");
        let bad = critique("c", &[(middle, LEFT)], &[(0, 1, CritiqueSegment::BAD)]);
        self.critique.publish(&bad).expect(TAKES_EVERYTHING);
        lesson.accepted("c");
        self.history.publish(&history("h", pair(n, 0, 1))).expect(TAKES_EVERYTHING);
        lesson.accepted("h");
        vec!["a", "p", "c", "h"]
    }

    /// Takes everything back, and waits until that is accepted.
    pub fn takes_back(lesson: &mut Lesson, ids: &[&str]) -> u64 {
        let mut revision = 0;
        for id in ids {
            lesson.retraction.publish(&retraction(&format!("undo-{id}"), id)).expect("memory takes everything");
            revision = lesson.accepted(&format!("undo-{id}"));
        }
        revision
    }
}
