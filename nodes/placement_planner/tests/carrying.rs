//! `place_object` and the controller's action from end to end on a graph in this process: the node as it runs, and a server that
//! behaves like ros2_control's joint_trajectory_controller.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use apprentice_msgs::action::{PlaceObject, PlaceObjectGoal, PlaceObjectResult};
use apprentice_msgs::action_msgs::GoalStatus;
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::control_msgs::{
    FollowJointTrajectory, FollowJointTrajectoryGoal, FollowJointTrajectoryResult as Followed,
};
use apprentice_msgs::msg::{LessonStatus, PlacementPlan, Posterior, TableScene};
use apprentice_msgs::sensor_msgs::JointState;
use apprentice_msgs::std_msgs;
use bus::{
    ActionClient, ActionEvent, ActionRequest, Arguments, Bus, End, GoalId, Graph, MemoryGraph, Next, NodeSettings,
    ParameterSpec, Publisher, Qos,
};
use exchange::scene_to_message;
use scene::{Object, Point, Rbf, Scene, Shape};
use serde::{Deserialize, Serialize};

const URDF: &str = include_str!("../../../config/urdf/table_arm.urdf");
const PATIENCE: Duration = Duration::from_secs(60);

#[derive(Debug, Clone, Default, Serialize, Deserialize)]
struct Nothing {}

impl NodeSettings for Nothing {
    const NODE: &'static str = "tester";
    const ABOUT: &'static str = "A node of a test.";
    const PARAMETERS: &'static [ParameterSpec] = &[];
}

fn open<E: Send + 'static>(graph: &MemoryGraph, name: &str) -> Bus<E> {
    let args = ["--ros-args", "-r", &format!("__node:={name}")].map(str::to_owned);
    let arguments = Arguments::parse(&args).expect("arguments");
    Bus::open(&Graph::Memory(graph.clone()), &arguments, &Nothing::default()).expect("a node")
}

/// What the controller does with a goal.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Manner {
    /// Gets there at once.
    Success,
    /// Says that the arm left its path.
    PathTolerance,
    /// Refuses it.
    Refuse,
    /// Takes it and moves until it is told to stop.
    Endless,
    /// Takes it, and is gone.
    Vanish,
    /// Does not answer.
    Deaf,
}

/// A joint_trajectory_controller as far as a client sees one.
fn controller(graph: &MemoryGraph, manner: Manner) -> (JoinHandle<()>, Arc<Mutex<Vec<FollowJointTrajectoryGoal>>>) {
    let mut bus = open::<ActionRequest<FollowJointTrajectory>>(graph, "controller");
    let server = bus.action_server::<FollowJointTrajectory>("/arm/follow", |request| request).expect("a server");
    let goals: Arc<Mutex<Vec<FollowJointTrajectoryGoal>>> = Arc::default();
    let seen = Arc::clone(&goals);
    let thread = std::thread::spawn(move || {
        while let Some((_, request)) = bus.next() {
            match request {
                ActionRequest::Goal { goal_id, goal } => {
                    seen.lock().expect("whole").push(goal);
                    match manner {
                        Manner::Deaf => continue,
                        Manner::Refuse => server.reject(goal_id),
                        _ => server.accept(goal_id),
                    }
                    let ended =
                        |error_code, error_string: &str| Followed { error_code, error_string: error_string.into() };
                    match manner {
                        Manner::Success => server.finish(goal_id, End::Succeeded, ended(0, "")),
                        Manner::PathTolerance => {
                            let result = ended(Followed::PATH_TOLERANCE_VIOLATED, "joint 'elbow' is 0.3 rad off");
                            server.finish(goal_id, End::Aborted, result);
                        }
                        Manner::Vanish => return,
                        _ => {}
                    }
                }
                ActionRequest::Cancel { goal_id } => server.finish(goal_id, End::Canceled, Followed::default()),
            }
        }
    });
    (thread, goals)
}

fn object(id: &str, x: f64, y: f64) -> Object {
    Object {
        id: id.into(),
        label: id.into(),
        shape: Shape::Cylinder { radius_m: 0.04, height_m: 0.2 },
        position_m: Point::new(x, y),
        yaw_rad: 0.0,
        supports: false,
    }
}

fn table(cup_x: f64) -> Scene {
    Scene {
        id: "task".into(),
        frame: "table".into(),
        width_m: 1.0,
        depth_m: 1.0,
        objects: vec![object("cup", cup_x, 0.25)],
        target: object("vase", 0.0, 0.0),
    }
}

fn message(scene: &Scene) -> TableScene {
    scene_to_message(scene, Time::default())
}

/// All draws want the middle.
fn posterior() -> Posterior {
    let weights = |k: usize| if k == 5 { 1.0 } else { 0.0 };
    Posterior {
        revision: 3,
        task: message(&table(0.2)),
        feature_names: Rbf::names(&table(0.2)),
        n_chains: 4,
        n_draws: 8,
        draws: (0..80).map(|i| weights(i % 10) as f32).collect(),
        map_weights: (0..10).map(weights).collect(),
        ..Posterior::default()
    }
}

fn joints() -> JointState {
    let names = ["shoulder_yaw", "shoulder_pitch", "elbow", "forearm_roll", "wrist_pitch", "wrist_roll", "finger_left"];
    JointState {
        name: names.map(String::from).to_vec(),
        position: vec![0.0, -0.6, 2.2, 0.0, 1.54, 0.0, 0.05],
        ..JointState::default()
    }
}

#[derive(Debug, Clone)]
enum Heard {
    Place(ActionEvent<PlaceObject>),
    Plan(Box<PlacementPlan>),
}

/// The node under test, and a client of it.
struct World {
    graph: MemoryGraph,
    bus: Bus<Heard>,
    client: ActionClient<PlaceObject>,
    scene: Publisher<TableScene>,
    lesson: Publisher<LessonStatus>,
    talking: Arc<AtomicBool>,
    threads: Vec<JoinHandle<()>>,
    next: u8,
}

impl World {
    /// The planner with a table, a posterior, a robot whose joints are heard, and a lesson that is taught or not.
    fn new(taught: bool, parameters: &[&str]) -> Self {
        let graph = MemoryGraph::new();
        let mut args = vec!["--ros-args".to_owned()];
        for parameter in ["controller:=/arm/follow", "execute:=false", "speed:=1.0"].iter().chain(parameters) {
            args.extend(["-p".to_owned(), (*parameter).to_owned()]);
        }
        let arguments = Arguments::parse(&args).expect("arguments");
        let running = Graph::Memory(graph.clone());
        let node = std::thread::spawn(move || placement_planner::run(&running, &arguments).expect("the node runs"));
        let mut bus = open::<Heard>(&graph, "client");
        let client = bus.action_client::<PlaceObject>("place_object", Heard::Place).expect("a client");
        bus.subscribe("plan", Qos::State, |plan| Heard::Plan(Box::new(plan))).expect("a subscription");
        let scene = bus.publisher::<TableScene>("scene", Qos::State).expect("a publisher");
        let lesson = bus.publisher::<LessonStatus>("lesson", Qos::State).expect("a publisher");
        let posteriors = bus.publisher::<Posterior>("posterior", Qos::State).expect("a publisher");
        let urdf = bus.publisher::<std_msgs::String>("/robot_description", Qos::State).expect("a publisher");
        let states = bus.publisher::<JointState>("/joint_states", Qos::Stream).expect("a publisher");
        let talking = Arc::new(AtomicBool::new(true));
        let talks = Arc::clone(&talking);
        let stopper = bus.stopper();
        let talker = std::thread::spawn(move || {
            while !stopper.stopped() {
                if talks.load(Ordering::SeqCst) {
                    states.publish(&joints()).expect("published");
                }
                std::thread::sleep(Duration::from_millis(20));
            }
        });
        let mut world = Self { graph, bus, client, scene, lesson, talking, threads: vec![node, talker], next: 0 };
        world.wait("the planner is there", |world| world.client.has_server().then_some(()));
        scene_publish(&world, 0.2);
        urdf.publish(&std_msgs::String { data: URDF.into() }).expect("published");
        posteriors.publish(&posterior()).expect("published");
        if taught {
            let status = LessonStatus { state: LessonStatus::TAUGHT, revision: 3, ..LessonStatus::default() };
            world.lesson.publish(&status).expect("published");
        }
        world.wait_for("a plan that knows the joints", |heard| match heard {
            Heard::Plan(plan) if plan.outcome == PlacementPlan::PLANNED && !plan.start.name.is_empty() => {
                (plan.inside_bound == taught).then_some(())
            }
            _ => None,
        });
        world
    }

    fn controller(&mut self, manner: Manner) -> Arc<Mutex<Vec<FollowJointTrajectoryGoal>>> {
        let (thread, goals) = controller(&self.graph, manner);
        self.threads.push(thread);
        goals
    }

    fn ask(&mut self, goal: PlaceObjectGoal) -> GoalId {
        self.next += 1;
        let goal_id = GoalId { uuid: [self.next; 16] };
        self.client.send_goal(goal_id, goal).expect("sent");
        self.client.request_result(goal_id).expect("sent");
        goal_id
    }

    /// Asks, and waits for what comes of it.
    fn place(&mut self, goal: PlaceObjectGoal) -> (i8, PlaceObjectResult) {
        let goal_id = self.ask(goal);
        self.result(goal_id)
    }

    fn result(&mut self, wanted: GoalId) -> (i8, PlaceObjectResult) {
        self.wait_for("a result", |heard| match heard {
            Heard::Place(ActionEvent::Finished { goal_id, status, result }) if goal_id == wanted => {
                Some((status, result))
            }
            _ => None,
        })
    }

    fn moving(&mut self, wanted: GoalId) {
        self.wait_for("it moves", |heard| match heard {
            Heard::Place(ActionEvent::Feedback { goal_id, .. }) if goal_id == wanted => Some(()),
            _ => None,
        });
    }

    fn wait_for<T>(&mut self, what: &str, mut pick: impl FnMut(Heard) -> Option<T>) -> T {
        self.wait(what, |world| match world.bus.next_timeout(Duration::from_millis(50)) {
            Next::Event(_, heard) => pick(heard),
            _ => None,
        })
    }

    #[expect(clippy::disallowed_methods, reason = "a test gives up some time")]
    fn wait<T>(&mut self, what: &str, mut found: impl FnMut(&mut Self) -> Option<T>) -> T {
        let until = Instant::now() + PATIENCE;
        while Instant::now() < until {
            if let Some(found) = found(self) {
                return found;
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        panic!("waited in vain until {what}");
    }
}

fn scene_publish(world: &World, cup_x: f64) {
    world.scene.publish(&message(&table(cup_x))).expect("published");
}

impl Drop for World {
    fn drop(&mut self) {
        self.graph.shutdown();
        for thread in self.threads.drain(..) {
            // A thread that failed has said so.
            let _ = thread.join();
        }
    }
}

#[test]
fn a_taught_robot_places_the_object_through_the_controller() {
    let mut world = World::new(true, &[]);
    let goals = world.controller(Manner::Success);
    let (status, result) = world.place(PlaceObjectGoal { object_id: "vase".into(), plan_only: false });
    assert_eq!((status, result.outcome), (GoalStatus::STATUS_SUCCEEDED, PlaceObjectResult::DONE), "{}", result.reason);
    assert!((result.placement.x - 0.5).abs() < 0.01 && result.revision == 3);
    let goals = goals.lock().expect("whole");
    let trajectory = &goals[0].trajectory;
    assert_eq!((goals.len(), trajectory.joint_names.len()), (1, 6));
    assert!(trajectory.points.iter().all(|point| point.positions.len() == 6 && point.accelerations.len() == 6));
}

#[test]
fn a_controller_that_fails_is_told_with_its_own_words() {
    for (manner, words) in [
        (Manner::PathTolerance, "the arm left its path (joint 'elbow' is 0.3 rad off)"),
        (Manner::Refuse, "the controller refused the trajectory"),
        (Manner::Deaf, "the controller does not answer"),
        (Manner::Endless, "s instead of"),
    ] {
        let mut world = World::new(true, &["patience_s:=0.2"]);
        let goals = world.controller(manner);
        let (status, result) = world.place(PlaceObjectGoal::default());
        assert_eq!((status, result.outcome), (GoalStatus::STATUS_ABORTED, PlaceObjectResult::CONTROLLER_FAILED));
        assert!(result.reason.contains(words), "{manner:?}: {}", result.reason);
        let sent = goals.lock().expect("whole").len();
        assert_eq!(sent, if manner == Manner::Deaf { 3 } else { 1 });
    }
}

#[test]
fn a_controller_that_is_gone_or_never_was_is_told() {
    let mut world = World::new(true, &[]);
    world.controller(Manner::Vanish);
    let (_, result) = world.place(PlaceObjectGoal::default());
    assert_eq!(result.outcome, PlaceObjectResult::CONTROLLER_FAILED);
    assert!(result.reason.contains("the controller is gone"), "{}", result.reason);
    let (_, result) = world.place(PlaceObjectGoal::default());
    assert_eq!(result.outcome, PlaceObjectResult::CONTROLLER_FAILED, "{}", result.reason);
}

#[test]
fn it_can_be_cancelled_and_one_is_carried_at_a_time() {
    let mut world = World::new(true, &[]);
    world.controller(Manner::Endless);
    let first = world.ask(PlaceObjectGoal::default());
    world.moving(first);
    let (_, busy) = world.place(PlaceObjectGoal::default());
    assert_eq!(busy.outcome, PlaceObjectResult::BUSY);
    world.client.cancel(first).expect("sent");
    let (status, result) = world.result(first);
    assert_eq!(
        (status, result.outcome),
        (GoalStatus::STATUS_CANCELED, PlaceObjectResult::CANCELED),
        "{}",
        result.reason
    );
}

#[test]
fn what_changes_on_the_way_stops_the_arm() {
    let mut world = World::new(true, &[]);
    world.controller(Manner::Endless);
    let goal = world.ask(PlaceObjectGoal::default());
    world.moving(goal);
    // Perception trembles by millimetres; that is no change.
    scene_publish(&world, 0.203);
    scene_publish(&world, 0.6);
    let (status, result) = world.result(goal);
    assert_eq!((status, result.outcome), (GoalStatus::STATUS_ABORTED, PlaceObjectResult::SCENE_CHANGED));
    scene_publish(&world, 0.2);
    let goal = world.ask(PlaceObjectGoal::default());
    world.moving(goal);
    let asking = LessonStatus { state: LessonStatus::ASKING, revision: 4, ..LessonStatus::default() };
    world.lesson.publish(&asking).expect("published");
    assert_eq!(world.result(goal).1.outcome, PlaceObjectResult::NOT_TAUGHT);
}

#[test]
fn nothing_is_sent_that_may_not_be() {
    let mut world = World::new(false, &["joint_age_s:=0.5"]);
    let goals = world.controller(Manner::Success);
    let (_, result) = world.place(PlaceObjectGoal::default());
    assert_eq!(result.outcome, PlaceObjectResult::NOT_TAUGHT, "{}", result.reason);
    let (status, result) = world.place(PlaceObjectGoal { plan_only: true, ..PlaceObjectGoal::default() });
    assert_eq!((status, result.outcome), (GoalStatus::STATUS_SUCCEEDED, PlaceObjectResult::PLANNED));
    let (_, result) = world.place(PlaceObjectGoal { object_id: "fork".into(), ..PlaceObjectGoal::default() });
    assert_eq!(result.outcome, PlaceObjectResult::UNKNOWN_OBJECT);
    assert_eq!(result.reason, "'fork' is not the object to place; that is 'vase'");
    let taught = LessonStatus { state: LessonStatus::TAUGHT, revision: 3, ..LessonStatus::default() };
    world.lesson.publish(&taught).expect("published");
    world.talking.store(false, Ordering::SeqCst);
    std::thread::sleep(Duration::from_millis(800));
    let (_, result) = world.place(PlaceObjectGoal::default());
    assert_eq!(result.outcome, PlaceObjectResult::STALE_JOINTS, "{}", result.reason);
    assert!(result.reason.contains("s old; 0.5 s are allowed"), "{}", result.reason);
    assert!(goals.lock().expect("whole").is_empty());
}

#[test]
fn without_a_controller_the_joints_say_how_it_went() {
    // The joints of this world never move, so the arm does not arrive.
    let mut world = World::new(true, &["controller:=''", "patience_s:=0.2"]);
    let (status, result) = world.place(PlaceObjectGoal::default());
    assert_eq!((status, result.outcome), (GoalStatus::STATUS_ABORTED, PlaceObjectResult::CONTROLLER_FAILED));
    assert!(result.reason.starts_with("the arm did not arrive: joint '"), "{}", result.reason);
}
