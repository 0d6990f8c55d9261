//! Actions between two nodes of ours in one process: every way in which a goal can go, and what is lost on the way.

use std::time::Duration;

use apprentice_msgs::action::{PlaceObject, PlaceObjectFeedback, PlaceObjectGoal, PlaceObjectResult};
use apprentice_msgs::action_msgs::{CancelGoal, CancelGoalRequest, CancelGoalResponse, GoalInfo, GoalStatus};
use bus::{
    ActionClient, ActionEvent, ActionRequest, ActionServer, Arguments, Bus, End, GoalId, Graph, MemoryGraph, Next,
    NodeSettings, ParameterSpec,
};
use serde::{Deserialize, Serialize};

#[derive(Debug, Clone, Default, Serialize, Deserialize)]
struct Nothing {}

impl NodeSettings for Nothing {
    const NODE: &'static str = "tester";
    const ABOUT: &'static str = "A node under test.";
    const PARAMETERS: &'static [ParameterSpec] = &[];
}

type Heard = ActionEvent<PlaceObject>;
type Asked = ActionRequest<PlaceObject>;

fn open<E: Send + 'static>(graph: &MemoryGraph, name: &str) -> Bus<E> {
    let args = ["--ros-args", "-r", &format!("__node:={name}")].map(str::to_owned);
    let arguments = Arguments::parse(&args).expect("arguments");
    Bus::open(&Graph::Memory(graph.clone()), &arguments, &Nothing::default()).expect("a node")
}

fn drain<E: Send + 'static>(node: &mut Bus<E>) -> Vec<E> {
    let mut events = Vec::new();
    while let Next::Event(_, event) = node.next_timeout(Duration::from_millis(20)) {
        events.push(event);
    }
    events
}

fn id(byte: u8) -> GoalId {
    GoalId { uuid: [byte; 16] }
}

fn goal() -> PlaceObjectGoal {
    PlaceObjectGoal { object_id: "vase".to_owned(), plan_only: false }
}

struct Pair {
    graph: MemoryGraph,
    client_node: Bus<Heard>,
    client: ActionClient<PlaceObject>,
    server_node: Bus<Asked>,
    server: ActionServer<PlaceObject>,
}

fn pair() -> Pair {
    let graph = MemoryGraph::new();
    let mut client_node = open::<Heard>(&graph, "client");
    let client = client_node.action_client::<PlaceObject>("place", |event| event).expect("a client");
    assert!(!client.has_server());
    let mut server_node = open::<Asked>(&graph, "server");
    let server = server_node.action_server::<PlaceObject>("place", |request| request).expect("a server");
    assert!(client.has_server());
    Pair { graph, client_node, client, server_node, server }
}

#[test]
fn a_goal_is_taken_watched_and_finished() {
    let mut p = pair();
    p.client.send_goal(id(1), goal()).expect("sent");
    assert_eq!(drain(&mut p.server_node), [ActionRequest::Goal { goal_id: id(1), goal: goal() }]);
    p.client.request_result(id(1)).expect("sent");
    assert_eq!(drain(&mut p.client_node), [], "nothing is decided yet");
    p.server.accept(id(1));
    let feedback = PlaceObjectFeedback { stage: 2, progress: 0.5, ..PlaceObjectFeedback::default() };
    p.server.feedback(id(1), feedback.clone());
    let result = PlaceObjectResult { reason: "it stands".to_owned(), ..PlaceObjectResult::default() };
    p.server.finish(id(1), End::Succeeded, result.clone());
    let (status, goal_id) = (GoalStatus::STATUS_SUCCEEDED, id(1));
    assert_eq!(
        drain(&mut p.client_node),
        [
            ActionEvent::Status { goal_id, status: GoalStatus::STATUS_EXECUTING },
            ActionEvent::Answered { goal_id, accepted: true },
            ActionEvent::Feedback { goal_id, feedback },
            ActionEvent::Status { goal_id, status },
            ActionEvent::Finished { goal_id, status, result: result.clone() },
        ]
    );
    // A result is kept for those who ask late, or again.
    p.client.request_result(id(1)).expect("sent");
    assert_eq!(drain(&mut p.client_node), [ActionEvent::Finished { goal_id, status, result }]);
}

#[test]
fn a_goal_that_is_sent_again_is_the_same_goal() {
    let mut p = pair();
    p.client.send_goal(id(1), goal()).expect("sent");
    p.client.send_goal(id(1), goal()).expect("sent");
    assert_eq!(drain(&mut p.server_node).len(), 1);
    p.server.accept(id(1));
    p.client.send_goal(id(1), goal()).expect("sent");
    assert!(drain(&mut p.server_node).is_empty());
    let answers = drain(&mut p.client_node);
    let accepted = |event: &&Heard| matches!(event, ActionEvent::Answered { accepted: true, .. });
    assert_eq!(answers.iter().filter(accepted).count(), 2, "{answers:?}");
}

#[test]
fn goals_are_refused_and_forgotten() {
    let mut p = pair();
    p.client.send_goal(id(1), goal()).expect("sent");
    p.server.reject(id(1));
    p.client.request_result(id(1)).expect("sent");
    let heard = drain(&mut p.client_node);
    assert_eq!(heard[0], ActionEvent::Answered { goal_id: id(1), accepted: false });
    let unknown = GoalStatus::STATUS_UNKNOWN;
    assert!(matches!(heard[1], ActionEvent::Finished { status, .. } if status == unknown), "{heard:?}");
    // What is over cannot be ended again.
    p.server.finish(id(1), End::Succeeded, PlaceObjectResult::default());
    p.server.accept(id(2));
    assert!(drain(&mut p.client_node).is_empty());
}

#[test]
fn cancelling_means_what_ros_says() {
    let mut p = pair();
    for n in 1..=3 {
        p.client.send_goal(id(n), goal()).expect("sent");
        p.server.accept(id(n));
    }
    drain(&mut p.server_node);
    drain(&mut p.client_node);
    let code = |p: &Pair, goal_id| {
        let goal_info = GoalInfo { goal_id, ..GoalInfo::default() };
        let name = "/apprentice/place/_action/cancel_goal";
        p.graph.call::<CancelGoal>(name, &CancelGoalRequest { goal_info }).expect("an answer")
    };
    assert_eq!(code(&p, id(9)).return_code, CancelGoalResponse::ERROR_UNKNOWN_GOAL_ID);
    p.client.cancel(id(2)).expect("sent");
    assert_eq!(drain(&mut p.server_node), [ActionRequest::Cancel { goal_id: id(2) }]);
    p.server.finish(id(2), End::Canceled, PlaceObjectResult::default());
    assert_eq!(code(&p, id(2)).return_code, CancelGoalResponse::ERROR_GOAL_TERMINATED);
    let heard = drain(&mut p.client_node);
    assert!(heard.contains(&ActionEvent::Cancelling { goal_id: id(2), code: CancelGoalResponse::ERROR_NONE }));
    assert!(heard.contains(&ActionEvent::Status { goal_id: id(2), status: GoalStatus::STATUS_CANCELED }), "{heard:?}");
    // Neither id nor time: everything that still runs.
    let all = code(&p, GoalId::default());
    let ids: Vec<GoalId> = all.goals_canceling.iter().map(|info| info.goal_id).collect();
    assert_eq!(ids, [id(1), id(3)]);
}

#[test]
fn too_many_goals_are_refused_and_old_results_forgotten() {
    let mut p = pair();
    for n in 0..80 {
        p.client.send_goal(id(n), goal()).expect("sent");
    }
    assert_eq!(drain(&mut p.server_node).len(), 64);
    let refused = drain(&mut p.client_node);
    assert_eq!(refused.len(), 16);
    assert!(refused.iter().all(|event| matches!(event, ActionEvent::Answered { accepted: false, .. })));
    for n in 0..64 {
        p.server.accept(id(n));
        p.server.finish(id(n), End::Succeeded, PlaceObjectResult::default());
    }
    p.client.send_goal(id(100), goal()).expect("sent");
    p.server.accept(id(100));
    p.server.finish(id(100), End::Succeeded, PlaceObjectResult::default());
    drain(&mut p.client_node);
    p.client.request_result(id(0)).expect("sent");
    p.client.request_result(id(100)).expect("sent");
    let heard = drain(&mut p.client_node);
    let status = |event: &Heard| if let ActionEvent::Finished { status, .. } = event { *status } else { -1 };
    assert_eq!([status(&heard[0]), status(&heard[1])], [GoalStatus::STATUS_UNKNOWN, GoalStatus::STATUS_SUCCEEDED]);
}

#[test]
fn without_a_server_requests_are_lost_and_malformed_ones_are_not_answered() {
    let graph = MemoryGraph::new();
    let mut client_node = open::<Heard>(&graph, "client");
    let client = client_node.action_client::<PlaceObject>("place", |event| event).expect("a client");
    client.send_goal(id(1), goal()).expect("sent");
    assert!(drain(&mut client_node).is_empty());
    let mut p = pair();
    let feedback = "/apprentice/place/_action/feedback";
    let of_type = "apprentice_msgs/action/PlaceObject_FeedbackMessage";
    assert_eq!(p.graph.inject_raw(feedback, of_type, &[0, 1, 0, 0, 7]), 1);
    assert!(drain(&mut p.client_node).is_empty());
}

#[test]
fn a_server_that_goes_before_its_node_leaves_the_graph_usable() {
    let Pair { graph, mut client_node, client, server_node, server } = pair();
    // The node's services then hold the last of what tells the status.
    drop(server);
    drop(server_node);
    assert!(!client.has_server());
    drop(client);
    drop(drain(&mut client_node));
    graph.shutdown();
}
