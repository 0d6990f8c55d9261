//! The node as a state machine: posterior, question, table, robot and lesson in; guess, plan and motion out.

use crate::asked::SAME_START;
use crate::carrying::{Carrier, Deed, Heard};
use crate::sharing::{Sharing, Way};
use crate::{RobotFiles, Settings, convert};
use apprentice_msgs::action::{PlaceObject, PlaceObjectResult};
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::control_msgs::{FollowJointTrajectory, GripperCommandAction};
use apprentice_msgs::geometry_msgs::{Pose, PoseStamped};
use apprentice_msgs::moveit_msgs::PlanningScene;
use apprentice_msgs::msg::{
    ArmModel, ArmMotion, ArmPose, LessonStatus, PlacementPlan as PlanMessage, PlacementQuery, Posterior, TableReach,
    TableScene,
};
use apprentice_msgs::sensor_msgs::JointState;
use apprentice_msgs::tf2_msgs::TFMessage;
use apprentice_msgs::visualization_msgs::MarkerArray;
use bus::{ActionEvent, ActionRequest, GoalId};
use exchange::{check_posterior, is_about_a_table, is_about_scene, scene_from_message, stands_as};
use placement::{LossBatch, MAP_SIDE, Manipulator, Planner};
use scene::Scene;

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
    /// An SRDF: which of its links may touch.
    RobotSemantics(String),
    /// Where the arm is.
    Joints(JointState),
    /// Where the target stands.
    TargetPose(Box<PoseStamped>),
    /// Somebody asks for an object to be placed, or not any more.
    Place(ActionRequest<PlaceObject>),
    /// The controller tells of a motion.
    Controller(Box<ActionEvent<FollowJointTrajectory>>),
    /// The gripper's controller tells of the fingers.
    Gripper(Box<ActionEvent<GripperCommandAction>>),
    /// Some time has passed; which controllers can be heard.
    Tick(Heard),
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
    /// What is to be done about a motion.
    Deed(Deed),
    /// A goal of `place_object` is taken.
    Accept(GoalId),
    /// The table for MoveIt.
    PlanningScene(Box<PlanningScene>),
    /// Where things stand, for tf.
    Transforms(TFMessage),
    /// The plan, drawn.
    Markers(Box<MarkerArray>),
    /// What the arm looks like.
    ArmModel(Box<ArmModel>),
    /// Where its links are.
    ArmPose(ArmPose),
    /// How it would carry out the plan.
    ArmMotion(Box<ArmMotion>),
    /// What the arm reaches of the table.
    Reach(Box<TableReach>),
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
    /// Where the target stands, to be picked up from there: the middle of its base, not numbers where nobody knows. None: it is in
    /// the hand.
    pub pick: Option<&'a Pose>,
    /// Whether the robot may move.
    pub inside_bound: bool,
}

/// See the crate.
pub struct PlacementPlanner {
    pub(crate) settings: Settings,
    pub(crate) planner: Planner,
    pub(crate) files: RobotFiles,
    pub(crate) robot_hash: String,
    /// As last received, whether it could be used or not.
    urdf: Option<String>,
    semantics: Option<String>,
    pub(crate) joints: Vec<(String, f64)>,
    pub(crate) joints_at: Option<Time>,
    joints_wrong: bool,
    /// Where the target was seen last, in the table's frame, and when that was heard.
    pub(crate) target: Option<(Pose, Time)>,
    pub(crate) target_wrong: bool,
    pub(crate) posterior: Option<Box<Posterior>>,
    query: Option<Box<PlacementQuery>>,
    pub(crate) scene: Option<Box<TableScene>>,
    pub(crate) taught: Option<u64>,
    guess: Option<Box<PlanMessage>>,
    pub(crate) plan: Option<Box<PlanMessage>>,
    /// The revision whose plan was carried out, or begun to be, and the one whose target was put down.
    moved: Option<u64>,
    pub(crate) put_down: Option<u64>,
    pub(crate) carrier: Carrier,
    pub(crate) sharing: Sharing,
    /// As it was told last.
    pub(crate) reach: Option<Box<TableReach>>,
    /// Whether robot or table have changed since.
    pub(crate) reach_is_old: bool,
}

impl PlacementPlanner {
    /// A planner that has seen nothing, and takes robots that need no files.
    pub fn new(settings: Settings) -> Self {
        let files = RobotFiles::none(&settings);
        Self::with_files(settings, files)
    }

    /// A planner that has seen nothing, with the files that the settings name.
    pub fn with_files(settings: Settings, files: RobotFiles) -> Self {
        Self {
            planner: Planner::new(settings.motion()),
            carrier: Carrier::new(!settings.controller.is_empty(), settings.fingers(), settings.patience_s),
            settings,
            files,
            robot_hash: String::new(),
            urdf: None,
            semantics: None,
            joints: Vec::new(),
            joints_at: None,
            joints_wrong: false,
            target: None,
            target_wrong: false,
            posterior: None,
            query: None,
            scene: None,
            taught: None,
            guess: None,
            plan: None,
            moved: None,
            put_down: None,
            sharing: Sharing::default(),
            reach: None,
            reach_is_old: true,
        }
    }

    /// Takes one event. A plan depends on the settings and on what it names, never on `now`; whether and when the arm moves
    /// does.
    pub fn step(&mut self, now: Time, event: Event) -> Vec<Output> {
        let again = matches!(event, Event::Republish);
        let mut outputs = self.supervise(now, &event);
        outputs.extend(self.take(now, event));
        outputs.extend(self.share(now, &outputs, again));
        outputs.extend(self.tell_reach(again));
        outputs
    }

    /// What other programs are to be shown after `outputs`.
    fn share(&mut self, now: Time, outputs: &[Output], again: bool) -> Vec<Output> {
        let mut shown = Vec::new();
        let joints = &self.joints;
        let way = |arm: Option<&Manipulator>, plan| arm.map(|arm| Way::new(arm, plan, joints)).unwrap_or_default();
        for output in outputs {
            if let Output::Plan(plan) = output {
                shown.extend(self.sharing.draw(plan, &way(self.planner.manipulator(), plan)));
            }
        }
        if self.carrier.has_target() {
            self.sharing.picked_up();
        }
        if let Some(plan) = self.carrier.take_put_down() {
            self.put_down = Some(plan.revision);
            self.sharing.put_down(&plan, &way(self.planner.manipulator(), &plan));
        }
        if self.plan.is_none() {
            shown.extend(self.sharing.wipe());
        }
        shown.extend(self.sharing.show(now, self.scene.as_deref(), again));
        if let (Some(arm), Some(scene)) = (self.planner.manipulator(), self.scene.as_deref()) {
            shown.extend(self.sharing.show_arm(now, arm, &self.robot_hash, scene, &self.joints, again));
        }
        shown
    }

    fn take(&mut self, now: Time, event: Event) -> Vec<Output> {
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
                self.sharing.scene_changed(self.scene.as_deref(), &scene);
                // Where one thing stands says nothing of another.
                if self.scene.as_ref().is_some_and(|known| known.target.id != scene.target.id) {
                    self.target = None;
                }
                self.scene = Some(scene);
                self.plan = None;
                self.reach_is_old = true;
            }
            Event::Lesson(lesson) => {
                let taught = (lesson.state == LessonStatus::TAUGHT).then_some(lesson.revision);
                if self.taught == taught {
                    return Vec::new();
                }
                self.taught = taught;
                self.plan = None;
            }
            Event::RobotDescription(urdf) => {
                if self.urdf.as_ref() == Some(&urdf) {
                    return Vec::new();
                }
                self.urdf = Some(urdf);
                return self.take_robot(now);
            }
            Event::RobotSemantics(srdf) => {
                if self.semantics.as_ref() == Some(&srdf) || self.files.has_srdf() {
                    return Vec::new();
                }
                self.semantics = Some(srdf);
                return self.take_robot(now);
            }
            Event::Joints(joints) => return self.take_joints(now, &joints),
            Event::Place(request) => return self.place(now, request),
            Event::TargetPose(message) => return self.take_target(now, &message),
            Event::Controller(event) => return deeds(self.carrier.hear(now, &event)),
            Event::Gripper(event) => return deeds(self.carrier.hear_gripper(now, &event)),
            Event::Tick(heard) => return deeds(self.carrier.tick(now, heard, &self.joints)),
            Event::Republish => {
                let guess = self.guess.iter().cloned().map(Output::Guess);
                return guess.chain(self.plan.iter().cloned().map(Output::Plan)).collect();
            }
        }
        self.update(now)
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
        let source = convert::source(request.pick);
        let plan = self.planner.plan_from(&scene, &batch, self.settings.alpha, &joints, &source);
        let [grip_open, grip] = plan.grip.unwrap_or([f64::NAN; 2]);
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
            picks: request.pick.is_some(),
            pick: request.pick.copied().unwrap_or_else(convert::unseen),
            approach: convert::trajectory(&header, plan.approach),
            trajectory: convert::trajectory(&header, plan.trajectory),
            retreat: convert::trajectory(&header, plan.retreat),
            grip_open,
            grip,
            map_side: u32::try_from(MAP_SIDE).unwrap_or(0),
            reward_map: plan.reward_map,
            cell_state: plan.cell_state.into_iter().map(convert::cell).collect(),
            header,
        })
    }

    fn take_robot(&mut self, now: Time) -> Vec<Output> {
        let Some(urdf) = self.urdf.take() else { return Vec::new() };
        let (semantics, before) = (self.semantics.take(), self.robot_hash.clone());
        let taken = self.set_robot(&urdf, semantics.as_deref());
        (self.urdf, self.semantics) = (Some(urdf), semantics);
        let told = match taken {
            Ok(told) => told,
            Err(error) => return vec![Output::Warn(format!("the robot description is ignored: {error}"))],
        };
        let mut outputs: Vec<Output> =
            told.into_iter().map(|text| Output::Warn(format!("robot description: {text}"))).collect();
        if self.robot_hash != before {
            self.reach_is_old = true;
            (self.guess, self.plan) = (None, None);
            outputs.extend(self.update(now));
        }
        outputs
    }

    fn take_joints(&mut self, now: Time, message: &JointState) -> Vec<Output> {
        match convert::joints(message) {
            Ok(joints) => {
                self.joints = joints;
                self.joints_at = Some(now);
                self.joints_wrong = false;
                if self.rests_on_another_start() {
                    (self.guess, self.plan) = (None, None);
                    return self.update(now);
                }
                self.execute(now)
            }
            Err(_) if self.joints_wrong => Vec::new(),
            Err(reason) => {
                self.joints_wrong = true;
                vec![Output::Warn(format!("joint states are ignored: {reason}"))]
            }
        }
    }

    /// Whether a plan or guess failed because of where the arm was, or was not known to be, and that changed since.
    fn rests_on_another_start(&self) -> bool {
        [&self.plan, &self.guess].into_iter().flatten().any(|plan| match plan.outcome {
            PlanMessage::JOINTS_UNKNOWN => {
                self.planner.manipulator().is_some_and(|arm| arm.unheard(&self.joints).is_empty())
            }
            PlanMessage::START_IN_COLLISION | PlanMessage::OUTSIDE_LIMITS => {
                let was = plan.start.name.iter().zip(&plan.start.position);
                let now_at = |name| self.joints.iter().find(|(joint, _)| joint == name).map(|(_, at)| *at);
                was.into_iter().any(|(name, at)| now_at(name).is_some_and(|now_at| (now_at - at).abs() > SAME_START))
            }
            _ => false,
        })
    }

    /// Makes what is missing and can be made.
    pub(crate) fn update(&mut self, now: Time) -> Vec<Output> {
        let Some(posterior) = self.posterior.take() else { return Vec::new() };
        let names = self.planner.manipulator().map(Manipulator::joint_names).unwrap_or_default();
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
                // Nobody sees where the target would be on a table that is only imagined.
                pick: None,
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
            let pick = self.pick(scene);
            let pick = pick.as_ref();
            let request = Request { posterior: &posterior, query_id: "", scene, start: &start, pick, inside_bound };
            match self.plan(&request) {
                Ok(plan) => {
                    let plan = Box::new(plan);
                    self.plan = Some(plan.clone());
                    outputs.push(Output::Plan(plan));
                }
                Err(reason) => outputs.push(Output::Warn(format!("no plan for scene '{}': {reason}", scene.id))),
            }
        }
        self.scene = scene;
        self.posterior = Some(posterior);
        outputs.extend(self.execute(now));
        outputs
    }

    /// Moves by itself once the lesson is taught, once per revision, if the arm is known to be where the plan starts.
    pub(crate) fn execute(&mut self, now: Time) -> Vec<Output> {
        let Some(plan) = &self.plan else { return Vec::new() };
        let may = self.settings.execute && plan.inside_bound && plan.outcome == PlanMessage::PLANNED;
        if !may || self.moved == Some(plan.revision) || self.carrier.is_busy() || self.obstacle(&now, plan).is_some() {
            return Vec::new();
        }
        let plan = plan.clone();
        deeds(self.start(now, plan, None))
    }

    /// Starts a motion; what was carried out for somebody is not carried out once more by itself.
    pub(crate) fn start(&mut self, now: Time, plan: Box<PlanMessage>, asked: Option<GoalId>) -> Vec<Deed> {
        self.moved = Some(plan.revision);
        self.carrier.start(now, plan, asked)
    }

    /// Calls a motion off that rests on what is not so any more.
    fn supervise(&mut self, now: Time, event: &Event) -> Vec<Output> {
        if !self.carrier.is_busy() {
            return Vec::new();
        }
        match event {
            Event::Scene(scene) if self.scene.as_ref().is_some_and(|known| !stands_as(known, scene)) => {
                let reason = "what stands on the table changed on the way";
                deeds(self.carrier.stop(now, PlaceObjectResult::SCENE_CHANGED, reason))
            }
            Event::Lesson(lesson) if lesson.state != LessonStatus::TAUGHT => {
                deeds(self.carrier.stop(now, PlaceObjectResult::NOT_TAUGHT, "the lesson is not taught any more"))
            }
            _ => Vec::new(),
        }
    }
}

/// Deeds as outputs.
pub(crate) fn deeds(deeds: Vec<Deed>) -> Vec<Output> {
    deeds.into_iter().map(Output::Deed).collect()
}

/// Whether a table is the one that the lesson, and so the bound, is about.
pub fn is_task(scene: &TableScene, posterior: &Posterior) -> bool {
    stands_as(scene, &posterior.task)
}

/// Whether two messages show the same table; perception stamps each anew.
fn same_table(a: &TableScene, b: &TableScene) -> bool {
    a.objects == b.objects && a.target == b.target && a.id == b.id && a.width_m == b.width_m && a.depth_m == b.depth_m
}
