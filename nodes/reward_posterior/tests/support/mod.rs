//! A node on a bench, a row of states to walk along, and things a person may say about it.

#![allow(dead_code, reason = "each test file uses its part")]

use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::geometry_msgs::{Point, Pose, Quaternion, Vector3};
use apprentice_msgs::msg::{
    ActionDemonstration, CritiqueSegment, EvidenceReceipt, FeatureTrajectory, LearnerHistory, PlacementDemonstration,
    Posterior, PosteriorPreview, Retraction, SceneObject, SegmentCritique, TableScene, TabularWorld,
    TrajectoryPreference,
};
use apprentice_msgs::std_msgs::Header;
use apprentice_msgs::to_cdr;
use reward_posterior::{Event, MAGIC, Output, RewardPosterior, Settings};

/// Actions in the row.
pub const LEFT: u32 = 0;
pub const RIGHT: u32 = 1;

/// Settings with few draws, so that tests are quick.
pub fn settings() -> Settings {
    Settings { n_draws: 400, threads: 1, ..Settings::default() }
}

/// `n` states in a row; each has a feature of its own. Left and right lead to the neighbour, at the ends nowhere else.
pub fn row(id: &str, n: u32) -> TabularWorld {
    let moves = (0..n).flat_map(|s| [(s, LEFT, s.saturating_sub(1)), (s, RIGHT, (s + 1).min(n - 1))]);
    let moves: Vec<(u32, u32, u32)> = moves.collect();
    TabularWorld {
        id: id.into(),
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

fn object(id: &str, x: f64, y: f64) -> SceneObject {
    SceneObject {
        id: id.into(),
        label: id.into(),
        shape: SceneObject::SHAPE_CYLINDER,
        size_m: Vector3 { x: 0.1, y: 0.1, z: 0.1 },
        pose: Pose { position: Point { x, y, z: 0.0 }, orientation: Quaternion { x: 0.0, y: 0.0, z: 0.0, w: 1.0 } },
        supports: false,
    }
}

/// A table with two objects: eleven weights.
pub fn table() -> TableScene {
    TableScene {
        id: "task".into(),
        width_m: 1.0,
        depth_m: 1.0,
        objects: vec![object("cup", 0.25, 0.25), object("plate", 0.75, 0.75)],
        target: object("vase", 0.0, 0.0),
        ..TableScene::default()
    }
}

pub fn shown(id: &str, x: f64, y: f64) -> PlacementDemonstration {
    PlacementDemonstration {
        header: Header { stamp: Time { sec: 7, nanosec: 5 }, frame_id: String::new() },
        id: id.into(),
        source: "test".into(),
        scene: table(),
        placement: Point { x, y, z: 0.0 },
        ..PlacementDemonstration::default()
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

pub fn trajectory(id: &str, features: &[f64]) -> FeatureTrajectory {
    FeatureTrajectory { id: id.into(), features: features.to_vec() }
}

/// Trajectories from worst to best.
pub fn ranked(id: &str, trajectories: &[FeatureTrajectory]) -> TrajectoryPreference {
    TrajectoryPreference {
        id: id.into(),
        source: "test".into(),
        trajectories: trajectories.to_vec(),
        ..TrajectoryPreference::default()
    }
}

pub fn history(id: &str, demonstrations: &[FeatureTrajectory]) -> LearnerHistory {
    LearnerHistory {
        id: id.into(),
        source: "test".into(),
        demonstrations: demonstrations.to_vec(),
        ..LearnerHistory::default()
    }
}

pub fn back(id: &str, evidence_id: &str) -> Retraction {
    Retraction { id: id.into(), evidence_id: evidence_id.into(), source: "test".into(), ..Retraction::default() }
}

/// A node, what it has written to its journal, and what it has warned of.
pub struct Bench {
    pub node: RewardPosterior,
    pub journal: Vec<u8>,
    pub warnings: Vec<String>,
    pub previews: Vec<PosteriorPreview>,
    newest: Option<Posterior>,
}

impl Bench {
    pub fn new(settings: Settings) -> Self {
        let node = RewardPosterior::new(settings);
        Self { node, journal: MAGIC.to_vec(), warnings: Vec::new(), previews: Vec::new(), newest: None }
    }

    /// A bench whose lesson is about a row of `n` states.
    pub fn in_row(settings: Settings, n: u32) -> Self {
        let mut bench = Self::new(settings);
        bench.step(Event::World(Box::new(row("row", n))));
        bench
    }

    pub fn step(&mut self, event: Event) -> Vec<Output> {
        let outputs = self.node.step(Time::default(), event);
        for output in &outputs {
            match output {
                Output::Journal(bytes) => self.journal.extend(bytes),
                Output::Warn(text) => self.warnings.push(text.clone()),
                Output::Preview(preview) => self.previews.push((**preview).clone()),
                Output::Posterior(posterior) => self.newest = Some((**posterior).clone()),
                _ => {}
            }
        }
        outputs
    }

    pub fn receipts(&mut self, event: Event) -> Vec<EvidenceReceipt> {
        let receipt = |output| if let Output::Receipt(receipt) = output { Some(receipt) } else { None };
        self.step(event).into_iter().filter_map(receipt).collect()
    }

    pub fn receipt(&mut self, event: Event) -> EvidenceReceipt {
        let mut receipts = self.receipts(event);
        assert_eq!(receipts.len(), 1, "{receipts:?}");
        receipts.remove(0)
    }

    /// Takes evidence that must be accepted.
    pub fn take(&mut self, event: Event) -> u64 {
        let receipt = self.receipt(event);
        assert_eq!(receipt.outcome, EvidenceReceipt::ACCEPTED, "{}", receipt.reason);
        receipt.revision
    }

    /// The sentence with which evidence is refused, nothing else having changed.
    pub fn refused(&mut self, event: Event) -> String {
        let before = (self.node.evidence().revision(), self.journal.len());
        let receipt = self.receipt(event);
        assert_eq!((receipt.outcome, receipt.revision), (EvidenceReceipt::REFUSED, 0), "{receipt:?}");
        assert_eq!((self.node.evidence().revision(), self.journal.len()), before);
        assert!(!receipt.reason.contains('\n') && !receipt.reason.is_empty(), "{}", receipt.reason);
        receipt.reason
    }

    /// The posterior of everything accepted so far.
    pub fn posterior(&mut self) -> Posterior {
        while self.step(Event::Recompute).iter().any(|output| matches!(output, Output::Recompute)) {}
        let newest = self.newest.clone().unwrap_or_else(|| panic!("there is no posterior: {:?}", self.warnings));
        assert_eq!(newest.revision, self.node.evidence().revision(), "{:?}", self.warnings);
        newest
    }
}

/// The bytes of everything in a posterior that speaks of the evidence in force, and not of how it came about.
pub fn bits(posterior: &Posterior) -> Vec<u8> {
    to_cdr(&Posterior { header: Header::default(), revision: 0, n_answers: 0, ..posterior.clone() })
}

/// Mean of every weight over the draws.
pub fn mean(posterior: &Posterior) -> Vec<f64> {
    let k = posterior.feature_names.len();
    let n = f64::from(posterior.n_draws);
    (0..k).map(|i| posterior.draws.iter().skip(i).step_by(k).map(|&w| f64::from(w)).sum::<f64>() / n).collect()
}

/// Returns of a trajectory under every draw.
pub fn returns(posterior: &Posterior, features: &[f64]) -> Vec<f64> {
    let of = |w: &[f32]| w.iter().zip(features).map(|(&w, phi)| f64::from(w) * phi).sum();
    posterior.draws.chunks_exact(features.len()).map(of).collect()
}
