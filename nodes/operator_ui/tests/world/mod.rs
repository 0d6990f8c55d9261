//! A table, a question and the other nodes' messages, as the tests need them.

#![allow(dead_code, reason = "each test file uses its part")]

pub mod garden;
pub mod table;

use apprentice_msgs::geometry_msgs::{Point, Pose, Quaternion, Vector3};
use apprentice_msgs::msg::{
    EvidenceLog, EvidenceReceipt, EvidenceRecord, FeatureTrajectory, LessonStatus, PerformanceBounds, PlacementBound,
    PlacementDemonstration, PlacementOption, PlacementPlan, PlacementQuery, Posterior, Retraction, SceneObject,
    TableScene,
};
use apprentice_msgs::std_msgs::Header;
use apprentice_msgs::trajectory_msgs::{JointTrajectory, JointTrajectoryPoint};

/// Cells along a side of the maps.
pub const SIDE: u32 = 32;

/// A thing 5 cm high.
pub fn object(id: &str, at: (f64, f64), size: (f64, f64), shape: u8) -> SceneObject {
    SceneObject {
        id: id.into(),
        label: id.replace('_', " "),
        shape,
        size_m: Vector3 { x: size.0, y: size.1, z: 0.05 },
        pose: Pose {
            position: Point { x: at.0, y: at.1, z: 0.0 },
            orientation: Quaternion { x: 0.0, y: 0.0, z: 0.0, w: 1.0 },
        },
        supports: id == "bowl",
    }
}

/// A metre square of table with a plate, a cup, a napkin box and a bowl; a vase is to be placed.
pub fn scene(id: &str, shift: f64) -> TableScene {
    TableScene {
        header: Header { frame_id: "table".into(), ..Header::default() },
        id: id.into(),
        width_m: 1.0,
        depth_m: 1.0,
        objects: vec![
            object("plate", (0.25 + shift, 0.72), (0.22, 0.22), SceneObject::SHAPE_CYLINDER),
            object("cup", (0.76, 0.75), (0.09, 0.09), SceneObject::SHAPE_CYLINDER),
            object("napkin_box", (0.27, 0.25), (0.16, 0.09), SceneObject::SHAPE_BOX),
            object("bowl", (0.74, 0.27), (0.16, 0.16), SceneObject::SHAPE_CYLINDER),
        ],
        target: object("vase", (0.0, 0.0), (0.1, 0.1), SceneObject::SHAPE_CYLINDER),
    }
}

/// A question from a revision.
pub fn query(revision: u64) -> PlacementQuery {
    let id = format!("q{revision}-7");
    PlacementQuery {
        scene: scene(&id, 0.03 * (revision % 4) as f64 - 0.03),
        id,
        revision,
        reason: "Of 50 tables I imagined, this is the one I know least about.".into(),
        bound_m: bound(revision),
        epsilon_m: 0.1,
        n_candidates: 50,
        ..PlacementQuery::default()
    }
}

/// A question from a revision that offers two places.
pub fn pair(revision: u64) -> PlacementQuery {
    let asked = query(revision);
    let option = |name: &str, (x, y): (f64, f64)| PlacementOption {
        placement: Point { x, y, z: 0.0 },
        trajectory: FeatureTrajectory { id: format!("{}-{name}", asked.id), features: vec![x, y] },
    };
    let reason = "Which of the two places is better for the vase with the plate at (0.25, 0.72) m? I drew this question at \
                  random, to see whether you answer as I expect; now and then I do.";
    let options = vec![option("a", (0.5, 0.52)), option("b", (0.45, 0.9))];
    PlacementQuery { reason: reason.into(), options, held_out: true, ..asked }
}

/// The bound after a revision; none at first.
pub fn bound(revision: u64) -> f64 {
    if revision < 2 { f64::NAN } else { 0.05 + 0.4 * (-0.25 * revision as f64).exp() }
}

/// The bound's message.
pub fn bounds(revision: u64) -> PerformanceBounds {
    let bound_m = bound(revision);
    let (outcome, reason) = if bound_m.is_nan() {
        let reason = "no bound, because 120 effective draws are too few; 299 would do";
        (PlacementBound::NOT_ENOUGH_SAMPLES, reason.to_owned())
    } else {
        let reason = format!(
            "95 % sure: in at least 95 of 100 of the rewards that fit, I am no more than {:.1} cm off on any of 50 tables",
            100.0 * bound_m
        );
        (PlacementBound::BOUND, reason)
    };
    PerformanceBounds {
        revision,
        outcome,
        reason,
        bound_m,
        alpha: 0.95,
        delta: 0.05,
        look: revision + 1,
        delta_spent: 0.0004,
        n: 2000,
        n_chains: 4,
        ess_min: 812.25,
        rhat_max: 1.0031,
        acceptance: 0.31,
        beta: 100.0,
        prior: "uniform on the L1 sphere".into(),
        evidence_hash: "9f2c".repeat(16),
        seed: u64::MAX,
        version: "0.1.0".into(),
        ..PerformanceBounds::default()
    }
}

/// A lesson that asks the question of a revision.
pub fn lesson(revision: u64) -> LessonStatus {
    let taught = bound(revision) < 0.1;
    LessonStatus {
        revision,
        state: if taught { LessonStatus::TAUGHT } else { LessonStatus::ASKING },
        reason: if taught {
            format!("The bound of {:.1} cm is below the goal of 10.0 cm.", 100.0 * bound(revision))
        } else {
            String::new()
        },
        query_id: if taught { String::new() } else { query(revision).id },
        questions_asked: revision as u32 + 1,
        demonstrations: revision as u32,
        bound_m: bound(revision),
        epsilon_m: 0.1,
        ..LessonStatus::default()
    }
}

/// A posterior without draws.
pub fn posterior(revision: u64) -> Posterior {
    Posterior { revision, n_demonstrations: revision, ..Posterior::default() }
}

/// A plan for a scene, with maps.
pub fn plan(scene: &TableScene, query_id: &str, revision: u64) -> PlacementPlan {
    let cells = || (0..SIDE * SIDE).map(|cell| ((cell % SIDE) as f64 + 0.5, (cell / SIDE) as f64 + 0.5));
    let unit = |(i, j): (f64, f64)| (i / f64::from(SIDE), j / f64::from(SIDE));
    let reward = |(x, y): (f64, f64)| {
        (0.6 * (-((x - 0.5).powi(2) + (y - 0.52).powi(2)) / 0.15).exp()
            - 0.2 * (-((x - 0.25).powi(2) + (y - 0.72).powi(2)) / 0.1).exp()) as f32
    };
    let state = |(x, y): (f64, f64)| match (x, y) {
        (x, y) if !(0.05..=0.95).contains(&x) || !(0.05..=0.95).contains(&y) => PlacementPlan::CELL_OCCUPIED,
        (x, y) if (x - 0.5).hypot(y + 0.05) > 0.93 => PlacementPlan::CELL_UNREACHABLE,
        _ => PlacementPlan::CELL_FREE,
    };
    let mut last = JointTrajectoryPoint::default();
    last.time_from_start.sec = 4;
    PlacementPlan {
        revision,
        query_id: query_id.into(),
        scene: scene.clone(),
        map_placement: Point { x: 0.47, y: 0.56, z: 0.0 },
        robust_placement: Point { x: 0.5, y: 0.5, z: 0.0 },
        map_cvar_m: 0.08,
        robust_cvar_m: 0.06,
        alpha: 0.95,
        trajectory: JointTrajectory { points: vec![last], ..JointTrajectory::default() },
        map_side: SIDE,
        reward_map: cells().map(unit).map(reward).collect(),
        cell_state: cells().map(unit).map(state).collect(),
        ..PlacementPlan::default()
    }
}

/// A receipt.
pub fn receipt(id: &str, outcome: u8, revision: u64) -> EvidenceReceipt {
    let reason = if outcome == EvidenceReceipt::REFUSED { "it would stand on 'plate'" } else { "" };
    EvidenceReceipt { id: id.into(), outcome, revision, reason: reason.into(), ..EvidenceReceipt::default() }
}

/// The record of a demonstration.
pub fn record(sequence: u64, demonstration: &PlacementDemonstration) -> EvidenceRecord {
    EvidenceRecord {
        sequence,
        kind: EvidenceRecord::DEMONSTRATION,
        demonstration: vec![demonstration.clone()],
        ..EvidenceRecord::default()
    }
}

/// The record of a retraction.
pub fn retraction_record(sequence: u64, retraction: &Retraction) -> EvidenceRecord {
    EvidenceRecord {
        sequence,
        kind: EvidenceRecord::RETRACTION,
        retraction: vec![retraction.clone()],
        ..EvidenceRecord::default()
    }
}

/// The log of records.
pub fn log(records: Vec<EvidenceRecord>) -> EvidenceLog {
    EvidenceLog { task: scene("task", 0.0), records, ..EvidenceLog::default() }
}

/// A version 4 UUID that ends in a number.
pub fn id(n: u32) -> String {
    format!("00000000-0000-4000-8000-{n:012x}")
}
