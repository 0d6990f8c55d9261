//! The planner and the simulated world in one process and in one's own time, and what a gripper's controller may do.

use apprentice_msgs::action::{PlaceObjectFeedback, PlaceObjectGoal, PlaceObjectResult};
use apprentice_msgs::action_msgs::GoalStatus;
use apprentice_msgs::builtin_interfaces::{Duration, Time};
use apprentice_msgs::control_msgs::GripperCommandResult;
use apprentice_msgs::geometry_msgs::PoseStamped;
use apprentice_msgs::msg::{Carrying, LessonStatus, PlacementPlan, Posterior, TableScene};
use apprentice_msgs::trajectory_msgs::{JointTrajectory, JointTrajectoryPoint};
use bus::{ActionEvent, ActionRequest, GoalId};
use placement_planner::{Deed, Event, Heard, Output, PlacementPlanner, Settings};
use scene::Rbf;
use simulated_table::{BUILT_IN_URDF, SimulatedTableNode};

/// Where the thing to place stands at first: beside the table.
pub(crate) const TRAY_M: [f64; 2] = [1.1, 0.15];
pub(crate) const STEP_NS: i64 = 50_000_000;

/// How a gripper's controller of ros2_control's kind takes goals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Manner {
    /// Fingers that something stops have arrived: `allow_stalling: true`.
    AllowsStalling,
    /// They have failed, and the result says that they stalled: the default.
    AbortsOnStalling,
    Refuses,
    Deaf,
    /// It takes a goal, fails and says nothing of stalling.
    Fails,
    /// It says that it stalled at once, and has not moved: something is stuck.
    Stuck,
}

/// The planner, the world, and what the planner said.
pub(crate) struct World {
    pub(crate) planner: PlacementPlanner,
    pub(crate) table: SimulatedTableNode,
    pub(crate) now_ns: i64,
    pub(crate) scene: TableScene,
    pub(crate) pose: Option<PoseStamped>,
    /// Whether the planner is told where the target is, and where it is told that it is, when that is not so.
    pub(crate) sees: bool,
    pub(crate) seen_at: Option<[f64; 2]>,
    /// The gripper's controller, and what it is at: until when, the goal, and where the fingers are to go.
    pub(crate) manner: Option<Manner>,
    pub(crate) gripping: Option<(i64, GoalId, f64)>,
    pub(crate) grips: usize,
    pub(crate) plan: Option<PlacementPlan>,
    pub(crate) carryings: Vec<Carrying>,
    pub(crate) stages: Vec<u8>,
    pub(crate) results: Vec<PlaceObjectResult>,
}

/// A cup, a mat on which things may stand, and a thing to place.
pub(crate) fn table(target: &[f64; 3], shape: &str, at_m: &[f64]) -> simulated_table::Settings {
    let words = |of: &[&str]| of.iter().map(|word| (*word).to_owned()).collect::<Vec<_>>();
    simulated_table::Settings {
        object_ids: words(&["cup", "mat"]),
        object_shapes: words(&["cylinder", "box"]),
        object_sizes_m: vec![0.1, 0.1, 0.09, 0.2, 0.2, 0.01],
        object_positions_m: vec![0.2, 0.25, 0.8, 0.8],
        object_supports: vec![false, true],
        target_shape: shape.to_owned(),
        target_size_m: target.to_vec(),
        target_position_m: at_m.to_vec(),
        target_yaw_rad: 0.4,
        gripper_joint: "finger_left".to_owned(),
        start_positions: vec![0.0, -0.6, 2.2, 0.0, 1.54, 0.0, 0.05],
        ..simulated_table::Settings::default()
    }
}

/// All draws want the middle of the table.
pub(crate) fn posterior(scene: &TableScene) -> Posterior {
    let names = Rbf::names(&exchange::scene_from_message(scene).expect("a sound scene"));
    let k = names.len();
    let middle = names.iter().position(|name| name == "table centre").expect("a feature");
    let weight = |i: usize| f64::from(u8::from(i % k == middle));
    Posterior {
        revision: 3,
        task: scene.clone(),
        n_chains: 4,
        n_draws: 8,
        draws: (0..8 * k).map(|i| weight(i) as f32).collect(),
        map_weights: (0..k).map(weight).collect(),
        feature_names: names,
        ..Posterior::default()
    }
}

pub(crate) fn settings() -> Settings {
    Settings { gripper_joint: "finger_left".into(), pick: true, execute: false, speed: 1.0, ..Settings::default() }
}

impl World {
    pub(crate) fn new(settings: Settings, table: &simulated_table::Settings) -> Self {
        let table = SimulatedTableNode::new(table, BUILT_IN_URDF.to_owned()).expect("a sound world");
        let scene = exchange::scene_to_message(table.scene(), Time::default());
        let mut world = Self {
            planner: PlacementPlanner::new(settings),
            table,
            now_ns: 0,
            scene: scene.clone(),
            pose: None,
            sees: true,
            seen_at: None,
            manner: None,
            gripping: None,
            grips: 0,
            plan: None,
            carryings: Vec::new(),
            stages: Vec::new(),
            results: Vec::new(),
        };
        world.tell(Event::Scene(Box::new(scene.clone())));
        world.tell(Event::RobotDescription(BUILT_IN_URDF.into()));
        let lesson = LessonStatus { state: LessonStatus::TAUGHT, revision: 3, ..LessonStatus::default() };
        world.tell(Event::Lesson(lesson));
        world.tell(Event::Posterior(Box::new(posterior(&scene))));
        world
    }

    pub(crate) fn now(&self) -> Time {
        Time::from_nanoseconds(i128::from(self.now_ns))
    }

    /// Tells the planner something; what it sends reaches the world.
    pub(crate) fn tell(&mut self, event: Event) {
        for output in self.planner.step(self.now(), event) {
            match output {
                Output::Plan(plan) => self.plan = Some(*plan),
                Output::Deed(Deed::Publish(trajectory)) => {
                    let now = self.now();
                    let said = self.table.step(now, simulated_table::Event::Trajectory(*trajectory));
                    assert!(said.is_empty(), "the world follows: {said:?}");
                }
                Output::Deed(Deed::Tell(carrying)) => self.carryings.push(*carrying),
                Output::Deed(Deed::Grip(goal_id, goal)) => self.grip(goal_id, goal.command.position),
                Output::Deed(Deed::Feedback(_, feedback)) if self.stages.last() != Some(&feedback.stage) => {
                    self.stages.push(feedback.stage);
                }
                Output::Deed(Deed::Finish(_, _, result)) => self.results.push(*result),
                _ => {}
            }
        }
    }

    /// The gripper's controller gets a goal.
    pub(crate) fn grip(&mut self, goal_id: GoalId, to: f64) {
        self.grips += 1;
        let accepted = match self.manner {
            None => panic!("there is no controller of the gripper"),
            Some(Manner::Deaf) => return,
            Some(Manner::Refuses) => false,
            Some(_) => true,
        };
        if accepted && self.manner == Some(Manner::Stuck) && self.grips == 2 {
            self.gripping = Some((self.now_ns + 100_000_000, goal_id, to));
        } else if accepted {
            let point = JointTrajectoryPoint {
                positions: vec![to],
                time_from_start: Duration::from_seconds(0.5),
                ..JointTrajectoryPoint::default()
            };
            let joint_names = vec!["finger_left".to_owned()];
            let trajectory = JointTrajectory { joint_names, points: vec![point], ..JointTrajectory::default() };
            self.table.step(self.now(), simulated_table::Event::Trajectory(trajectory));
            self.gripping = Some((self.now_ns + 600_000_000, goal_id, to));
        }
        self.tell(Event::Gripper(Box::new(ActionEvent::Answered { goal_id, accepted })));
    }

    /// The gripper's controller tells how it went.
    pub(crate) fn gripped(&mut self, goal_id: GoalId, to: f64) {
        let finger = self.joints()[6];
        let stalled = (finger - to).abs() > 1e-4 && self.manner != Some(Manner::Fails);
        let failed = self.manner == Some(Manner::Fails) || (stalled && self.manner == Some(Manner::AbortsOnStalling));
        let status = if failed { GoalStatus::STATUS_ABORTED } else { GoalStatus::STATUS_SUCCEEDED };
        let result = GripperCommandResult { position: finger, effort: 0.0, stalled, reached_goal: !stalled };
        self.tell(Event::Gripper(Box::new(ActionEvent::Finished { goal_id, status, result })));
    }

    /// A twentieth of a second passes.
    pub(crate) fn pass(&mut self) {
        self.now_ns += STEP_NS;
        for output in self.table.step(self.now(), simulated_table::Event::Tick) {
            match output {
                simulated_table::Output::Joints(joints) => self.tell(Event::Joints(joints)),
                simulated_table::Output::TargetPose(mut pose) => {
                    self.pose = Some(pose.clone());
                    if let Some([x, y]) = self.seen_at {
                        (pose.pose.position.x, pose.pose.position.y) = (x, y);
                    }
                    if self.sees {
                        self.tell(Event::TargetPose(Box::new(pose)));
                    }
                }
                other => panic!("{other:?}"),
            }
        }
        if let Some((_, goal_id, to)) = self.gripping.take_if(|(until_ns, ..)| *until_ns <= self.now_ns) {
            self.gripped(goal_id, to);
        }
        self.tell(Event::Tick(Heard { arm: false, gripper: true }));
    }

    /// Long enough for everything to have been said.
    pub(crate) fn look(&mut self) {
        (0..12).for_each(|_| self.pass());
    }

    pub(crate) fn ask(&mut self, n: u8) {
        let goal = PlaceObjectGoal { object_id: String::new(), plan_only: false };
        let goal_id = GoalId { uuid: [n; 16] };
        self.tell(Event::Place(ActionRequest::Goal { goal_id, goal }));
    }

    /// Until the goal is over, or something holds.
    pub(crate) fn until(&mut self, what: &str, mut holds: impl FnMut(&Self) -> bool) {
        for _ in 0..2000 {
            if holds(self) {
                return;
            }
            self.pass();
        }
        panic!("{what} did not happen; results {:?}, plan {:?}", self.results, self.plan.as_ref().map(|p| &p.reason));
    }

    pub(crate) fn place(&mut self) -> PlaceObjectResult {
        self.look();
        self.ask(1);
        self.until("an end", |world| !world.results.is_empty());
        self.results.remove(0)
    }

    pub(crate) fn joints(&mut self) -> Vec<f64> {
        let outputs = self.table.step(self.now(), simulated_table::Event::Tick);
        let joints = outputs.into_iter().find_map(|output| match output {
            simulated_table::Output::Joints(joints) => Some(joints.position),
            _ => None,
        });
        joints.expect("the world says where they are")
    }

    pub(crate) fn at(&self) -> [f64; 3] {
        let at = &self.pose.as_ref().expect("it is seen").pose.position;
        [at.x, at.y, at.z]
    }

    pub(crate) fn plan(&self) -> &PlacementPlan {
        self.plan.as_ref().expect("a plan")
    }
}

pub(crate) fn near(a: [f64; 3], b: [f64; 3], within_m: f64) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < within_m)
}

pub(crate) const ALL_STAGES: [u8; 5] = [
    PlaceObjectFeedback::APPROACHING,
    PlaceObjectFeedback::GRASPING,
    PlaceObjectFeedback::MOVING,
    PlaceObjectFeedback::RELEASING,
    PlaceObjectFeedback::RETREATING,
];
