//! The node as a state machine: posterior, question, table, robot and lesson in; guess, plan and motion out.

use crate::{Settings, convert};
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{
    LessonStatus, PlacementPlan as PlanMessage, PlacementQuery, Posterior, SceneObject, TableScene,
};
use apprentice_msgs::sensor_msgs::JointState;
use apprentice_msgs::trajectory_msgs::JointTrajectory;
use exchange::{check_posterior, is_about_a_table, is_about_scene, scene_from_message};
use placement::{LossBatch, MAP_SIDE, ManipulatorError, Planner};
use scene::Scene;
use sha2::{Digest, Sha256};

/// Perception is this exact: an object that moved less stands where it stood, metres.
const SAME_PLACE_M: f64 = 0.01;

/// What reaches the node.
#[derive(Debug, Clone)]
pub enum Event {
    /// A new (or repeated) posterior.
    Posterior(Box<Posterior>),
    /// The open question.
    Query(Box<PlacementQuery>),
    /// The table as it is.
    Scene(Box<TableScene>),
    /// Where the lesson stands.
    Lesson(LessonStatus),
    /// A URDF.
    RobotDescription(String),
    /// Where the arm is.
    Joints(JointState),
    /// Time to send the newest outputs again.
    Republish,
}

/// What the node sends.
#[derive(Debug, Clone)]
pub enum Output {
    /// The robot's guess for the open question.
    Guess(Box<PlanMessage>),
    /// The plan for the table as it is.
    Plan(Box<PlanMessage>),
    /// The motion to make now.
    Trajectory(JointTrajectory),
    /// Something a person should know.
    Warn(String),
}

/// Everything a plan is a function of, the robot and the settings aside.
#[derive(Debug, Clone, Copy)]
pub struct Request<'a> {
    /// The rewards.
    pub posterior: &'a Posterior,
    /// The question the plan is a guess for; empty for the table as it is.
    pub query_id: &'a str,
    /// What stands on the table.
    pub scene: &'a TableScene,
    /// Where the arm is.
    pub start: &'a JointState,
    /// Whether the robot may move.
    pub inside_bound: bool,
}

/// See the crate.
pub struct PlacementPlanner {
    settings: Settings,
    planner: Planner,
    robot_hash: String,
    refused_robot: Option<String>,
    joints: Vec<(String, f64)>,
    joints_wrong: bool,
    posterior: Option<Box<Posterior>>,
    query: Option<Box<PlacementQuery>>,
    scene: Option<Box<TableScene>>,
    taught: Option<u64>,
    guess: Option<Box<PlanMessage>>,
    plan: Option<Box<PlanMessage>>,
    moved: Option<u64>,
}

impl PlacementPlanner {
    /// A planner that has seen nothing.
    pub fn new(settings: Settings) -> Self {
        Self {
            planner: Planner::new(settings.motion()),
            settings,
            robot_hash: String::new(),
            refused_robot: None,
            joints: Vec::new(),
            joints_wrong: false,
            posterior: None,
            query: None,
            scene: None,
            taught: None,
            guess: None,
            plan: None,
            moved: None,
        }
    }

    /// Takes one event. A plan depends on the settings and on what it names, never on `_now`.
    pub fn step(&mut self, _now: Time, event: Event) -> Vec<Output> {
        match event {
            Event::Posterior(posterior) => {
                if self.posterior.as_ref().is_some_and(|known| known.revision == posterior.revision) {
                    return Vec::new();
                }
                if let Err(reason) = check_posterior(&posterior) {
                    return vec![Output::Warn(format!("posterior {} is ignored: {reason}", posterior.revision))];
                }
                // A lesson that is about no table places nothing on any.
                if !is_about_a_table(&posterior) {
                    return Vec::new();
                }
                self.posterior = Some(posterior);
                (self.guess, self.plan) = (None, None);
            }
            Event::Query(query) => {
                if self.query.as_ref().is_some_and(|known| known.id == query.id) {
                    return Vec::new();
                }
                self.query = Some(query);
                self.guess = None;
            }
            Event::Scene(scene) => {
                if self.scene.as_ref().is_some_and(|known| same_table(known, &scene)) {
                    return Vec::new();
                }
                self.scene = Some(scene);
                self.plan = None;
            }
            Event::Lesson(lesson) => {
                let taught = (lesson.state == LessonStatus::TAUGHT).then_some(lesson.revision);
                if self.taught == taught {
                    return Vec::new();
                }
                self.taught = taught;
                self.plan = None;
            }
            Event::RobotDescription(urdf) => return self.robot(&urdf),
            Event::Joints(joints) => return self.joints(&joints),
            Event::Republish => {
                let guess = self.guess.iter().cloned().map(Output::Guess);
                return guess.chain(self.plan.iter().cloned().map(Output::Plan)).collect();
            }
        }
        self.update()
    }

    /// Takes a robot description, in place of an earlier one; plans name it by its hash.
    pub fn set_robot(&mut self, urdf: &str) -> Result<(), ManipulatorError> {
        self.planner.set_robot(urdf)?;
        self.robot_hash = Sha256::digest(urdf.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(())
    }

    /// Plans: a function of the settings, the robot and the request.
    pub fn plan(&mut self, request: &Request<'_>) -> Result<PlanMessage, String> {
        check_posterior(request.posterior).map_err(|error| error.to_string())?;
        let scene: Scene = scene_from_message(request.scene).map_err(|error| error.to_string())?;
        if !is_about_scene(request.posterior, &scene) {
            return Err(format!("the objects of scene '{}' are not those of the posterior", scene.id));
        }
        let joints = convert::joints(request.start)?;
        let batch = LossBatch {
            draws: &request.posterior.draws,
            n_features: request.posterior.feature_names.len(),
            map_weights: &request.posterior.map_weights,
            threads: self.settings.n_threads(),
        };
        let plan = self.planner.plan(&scene, &batch, self.settings.alpha, &joints);
        let header = request.posterior.header.clone();
        Ok(PlanMessage {
            revision: request.posterior.revision,
            query_id: request.query_id.to_owned(),
            scene: request.scene.clone(),
            robot_hash: self.robot_hash.clone(),
            start: request.start.clone(),
            outcome: convert::outcome(plan.outcome),
            reason: plan.reason,
            map_placement: convert::place(plan.map_placement_m),
            robust_placement: convert::place(plan.robust_placement_m),
            map_cvar_m: plan.map_cvar_m,
            robust_cvar_m: plan.robust_cvar_m,
            alpha: self.settings.alpha,
            choice: self.settings.choice.clone(),
            candidates: plan.candidates.into_iter().map(convert::candidate).collect(),
            inside_bound: request.inside_bound,
            trajectory: convert::trajectory(&header, plan.trajectory),
            map_side: u32::try_from(MAP_SIDE).unwrap_or(0),
            reward_map: plan.reward_map,
            cell_state: plan.cell_state.into_iter().map(convert::cell).collect(),
            header,
        })
    }

    fn robot(&mut self, urdf: &str) -> Vec<Output> {
        let hash: String = Sha256::digest(urdf.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect();
        if hash == self.robot_hash || self.refused_robot.as_ref() == Some(&hash) {
            return Vec::new();
        }
        if let Err(error) = self.set_robot(urdf) {
            self.refused_robot = Some(hash);
            return vec![Output::Warn(format!("the robot description is ignored: {error}"))];
        }
        (self.guess, self.plan) = (None, None);
        self.update()
    }

    fn joints(&mut self, message: &JointState) -> Vec<Output> {
        match convert::joints(message) {
            Ok(joints) => {
                let first = self.joints.is_empty();
                self.joints = joints;
                self.joints_wrong = false;
                if first && !self.joints.is_empty() {
                    // What was planned from an unknown position is planned anew.
                    (self.guess, self.plan) = (None, None);
                    return self.update();
                }
                Vec::new()
            }
            Err(_) if self.joints_wrong => Vec::new(),
            Err(reason) => {
                self.joints_wrong = true;
                vec![Output::Warn(format!("joint states are ignored: {reason}"))]
            }
        }
    }

    /// Makes what is missing and can be made.
    fn update(&mut self) -> Vec<Output> {
        let Some(posterior) = self.posterior.take() else { return Vec::new() };
        let names = self.planner.manipulator().map(placement::Manipulator::joint_names).unwrap_or_default();
        let start = convert::start(&names, &self.joints);
        let mut outputs = Vec::new();
        let query = self.query.take();
        if let Some(query) = query.as_ref().filter(|query| query.revision == posterior.revision && self.guess.is_none())
        {
            let request = Request {
                posterior: &posterior,
                query_id: &query.id,
                scene: &query.scene,
                start: &start,
                inside_bound: false,
            };
            match self.plan(&request) {
                Ok(guess) => {
                    let guess = Box::new(guess);
                    self.guess = Some(guess.clone());
                    outputs.push(Output::Guess(guess));
                }
                Err(reason) => outputs.push(Output::Warn(format!("no guess for question '{}': {reason}", query.id))),
            }
        }
        self.query = query;
        let scene = self.scene.take();
        if let Some(scene) = scene.as_ref().filter(|_| self.plan.is_none()) {
            let inside_bound = self.taught == Some(posterior.revision) && is_task(scene, &posterior);
            let request = Request { posterior: &posterior, query_id: "", scene, start: &start, inside_bound };
            match self.plan(&request) {
                Ok(plan) => {
                    let plan = Box::new(plan);
                    self.plan = Some(plan.clone());
                    outputs.push(Output::Plan(plan.clone()));
                    outputs.extend(self.execute(*plan));
                }
                Err(reason) => outputs.push(Output::Warn(format!("no plan for scene '{}': {reason}", scene.id))),
            }
        }
        self.scene = scene;
        self.posterior = Some(posterior);
        outputs
    }

    /// Nothing moves unless the lesson is taught and the arm's position is known, and then once per revision.
    fn execute(&mut self, plan: PlanMessage) -> Option<Output> {
        let known = plan.trajectory.joint_names.iter().all(|name| plan.start.name.contains(name));
        let may = self.settings.execute && plan.inside_bound && known && plan.outcome == PlanMessage::PLANNED;
        if !may || self.moved == Some(plan.revision) {
            return None;
        }
        self.moved = Some(plan.revision);
        Some(Output::Trajectory(plan.trajectory))
    }
}

/// Whether a table is the one that the lesson, and so the bound, is about: the same things, each within 1 cm.
pub fn is_task(scene: &TableScene, posterior: &Posterior) -> bool {
    let task = &posterior.task;
    let near = |a: &SceneObject, b: &SceneObject| {
        let (p, q) = (&a.pose.position, &b.pose.position);
        a.id == b.id && a.shape == b.shape && (p.x - q.x).hypot(p.y - q.y) <= SAME_PLACE_M
    };
    scene.objects.len() == task.objects.len()
        && scene.objects.iter().zip(&task.objects).all(|(a, b)| near(a, b))
        && scene.target.id == task.target.id
        && scene.width_m == task.width_m
        && scene.depth_m == task.depth_m
}

/// Whether two messages show the same table; perception stamps each anew.
fn same_table(a: &TableScene, b: &TableScene) -> bool {
    a.objects == b.objects && a.target == b.target && a.id == b.id && a.width_m == b.width_m && a.depth_m == b.depth_m
}
