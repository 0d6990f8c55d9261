//! Actions against a foreign implementation, ros2-client's, both ways and in both mappings.

use std::time::{Duration, Instant};

use apprentice_msgs::{
    action::{PlaceObject, PlaceObjectFeedback, PlaceObjectGoal, PlaceObjectResult},
    action_msgs::GoalStatus,
};
use bus::{ActionEvent, ActionRequest, Arguments, Bus, End, GoalId, Graph, Next};
use futures::FutureExt;
use ros2_client::{
    ActionTypeName, Message, Name, Node, ServiceMapping, action,
    action::{ActionClientQosPolicies, ActionServerQosPolicies, AsyncActionServer, GoalEndStatus},
    ros2::{QosPolicies, QosPolicyBuilder, policy},
};
use serde::{Deserialize, Serialize};

use crate::{PATIENCE, common::Settings, services::client_node};

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
struct Foreign<T>(T);
impl<T: Serialize + for<'de> Deserialize<'de>> Message for Foreign<T> {}

type ForeignServer =
    action::ActionServer<Foreign<PlaceObjectGoal>, Foreign<PlaceObjectResult>, Foreign<PlaceObjectFeedback>>;
type ForeignClient =
    action::ActionClient<Foreign<PlaceObjectGoal>, Foreign<PlaceObjectResult>, Foreign<PlaceObjectFeedback>>;

pub fn enhanced() {
    our_server("enhanced", ServiceMapping::Enhanced);
    our_client("enhanced", ServiceMapping::Enhanced);
}

pub fn cyclone() {
    our_server("cyclone", ServiceMapping::Cyclone);
    our_client("cyclone", ServiceMapping::Cyclone);
}

fn qos(transient: bool) -> QosPolicies {
    let durability = if transient { policy::Durability::TransientLocal } else { policy::Durability::Volatile };
    QosPolicyBuilder::new()
        .reliability(policy::Reliability::Reliable { max_blocking_time: ros2_client::ros2::Duration::from_millis(100) })
        .durability(durability)
        .history(policy::History::KeepLast { depth: 10 })
        .build()
}

fn open<E: Send + 'static>(name: &str, mapping: &str) -> Bus<E> {
    let (name, mapping) = (format!("__node:={name}_{mapping}"), format!("service_mapping:={mapping}"));
    let args = ["--ros-args", "-r", &name, "-p", &mapping].map(str::to_owned);
    let arguments = Arguments::parse(&args).expect("good arguments");
    Bus::open(&Graph::Dds, &arguments, &Settings::default()).expect("a DDS participant")
}

fn goal() -> PlaceObjectGoal {
    PlaceObjectGoal { object_id: "vase".to_owned(), plan_only: true }
}

fn result() -> PlaceObjectResult {
    PlaceObjectResult { reason: "it stands".to_owned(), ..PlaceObjectResult::default() }
}

fn feedback() -> PlaceObjectFeedback {
    PlaceObjectFeedback { stage: 3, description: "it moves".to_owned(), progress: 0.25 }
}

fn foreign_client(node: &mut Node, mapping: ServiceMapping, name: &str) -> ForeignClient {
    let qos_policies = ActionClientQosPolicies {
        goal_service: (&qos(false)).into(),
        result_service: (&qos(false)).into(),
        cancel_service: (&qos(false)).into(),
        feedback_subscription: (&qos(false)).into(),
        status_subscription: (&qos(true)).into(),
    };
    let name = Name::parse(name).expect("a name");
    node.create_action_client(mapping, &name, &ActionTypeName::new("apprentice_msgs", "PlaceObject"), qos_policies)
        .expect("a client")
}

/// Our server takes a goal of a foreign client, tells how far it is, and its result is fetched; a second one is cancelled.
#[expect(clippy::disallowed_methods, reason = "a test gives up some time")]
fn our_server(mapping_name: &str, mapping: ServiceMapping) {
    let mut node = open::<ActionRequest<PlaceObject>>("serving", mapping_name);
    let action = format!("/apprentice/serve_{mapping_name}");
    let server = node.action_server::<PlaceObject>(&action, |request| request).expect("a server");
    let ended = std::thread::spawn(move || {
        let until = Instant::now() + PATIENCE;
        let mut cancelled = false;
        while !cancelled && Instant::now() < until {
            match node.next_timeout(Duration::from_millis(100)) {
                Next::Event(_, ActionRequest::Goal { goal_id, goal: asked }) => {
                    assert_eq!(asked, goal());
                    server.accept(goal_id);
                    server.feedback(goal_id, feedback());
                }
                Next::Event(_, ActionRequest::Cancel { goal_id }) => {
                    server.finish(goal_id, End::Canceled, result());
                    cancelled = true;
                }
                _ => {}
            }
        }
        // The answer has to leave before the node does.
        std::thread::sleep(Duration::from_millis(500));
        cancelled
    });
    let mut foreign = client_node();
    let client = foreign_client(&mut foreign, mapping, &action);
    let until = Instant::now() + PATIENCE;
    let mut taken = None;
    while taken.is_none() && Instant::now() < until {
        taken = smol::block_on(async {
            futures::select! {
                answer = client.async_send_goal(Foreign(goal())).fuse() => answer.ok(),
                _ = FutureExt::fuse(smol::Timer::after(Duration::from_millis(1000))) => None,
            }
        });
    }
    let (goal_id, response) = taken.expect("our server answers");
    assert!(response.accepted);
    let mut finished = None;
    while finished.is_none() && Instant::now() < until {
        finished = smol::block_on(async {
            let cancel = client.async_cancel_goal(goal_id, ros2_client::builtin_interfaces::Time::ZERO);
            let both = async {
                let cancelled = cancel.await.ok()?;
                let _ = cancelled;
                client.async_request_result(goal_id).await.ok()
            };
            futures::select! {
                result = Box::pin(both).fuse() => result,
                _ = FutureExt::fuse(smol::Timer::after(Duration::from_millis(1000))) => None,
            }
        });
    }
    let (status, Foreign(got)) = finished.expect("our server gives the result");
    assert_eq!((status, got), (ros2_client::action_msgs::GoalStatusEnum::Canceled, result()));
    assert!(ended.join().expect("the server"), "it was never asked to cancel");
}

/// A foreign server takes our client's goal, and its feedback, status and result come back.
#[expect(clippy::disallowed_methods, reason = "a test gives up some time")]
fn our_client(mapping_name: &str, mapping: ServiceMapping) {
    let action = format!("/apprentice/ask_{mapping_name}");
    let mut foreign = client_node();
    let qos_policies = ActionServerQosPolicies {
        goal_service: (&qos(false)).into(),
        result_service: (&qos(false)).into(),
        cancel_service: (&qos(false)).into(),
        feedback_publisher: (&qos(false)).into(),
        status_publisher: (&qos(true)).into(),
    };
    let name = Name::parse(&action).expect("a name");
    let type_name = ActionTypeName::new("apprentice_msgs", "PlaceObject");
    let server: ForeignServer =
        foreign.create_action_server(mapping, &name, &type_name, qos_policies).expect("a server");
    std::thread::spawn(move || {
        let server = AsyncActionServer::new(server);
        smol::block_on(async {
            let handle = server.receive_new_goal().await.expect("a goal");
            assert_eq!(server.get_new_goal(handle.clone()), Some(Foreign(goal())));
            let accepted = server.accept_goal(handle).await.expect("accepted");
            let running = server.start_executing_goal(accepted).await.expect("running");
            for _ in 0..20 {
                server.publish_feedback(running.clone(), Foreign(feedback())).await.expect("published");
                smol::Timer::after(Duration::from_millis(50)).await;
            }
            let end = GoalEndStatus::Succeeded;
            server.send_result_response(running, end, Foreign(result())).await.expect("sent");
            smol::Timer::after(Duration::from_secs(2)).await;
        });
    });
    let mut node = open::<ActionEvent<PlaceObject>>("asking", mapping_name);
    let client = node.action_client::<PlaceObject>(&action, |event| event).expect("a client");
    crate::common::until("the foreign server is found", || client.has_server());
    // That both sides are matched here does not mean that they are there; a goal may still be lost.
    let (mut attempt, mut heard) = (0, Vec::new());
    let until = Instant::now() + PATIENCE;
    while Instant::now() < until {
        let accepted = heard.iter().find_map(|event| match event {
            ActionEvent::Answered { goal_id, accepted: true } => Some(*goal_id),
            ActionEvent::Status { goal_id, .. } => Some(*goal_id),
            _ => None,
        });
        match accepted {
            None => {
                attempt += 1;
                client.send_goal(GoalId { uuid: [attempt; 16] }, goal()).expect("sent");
            }
            Some(goal_id) => client.request_result(goal_id).expect("sent"),
        }
        while let Next::Event(_, event) = node.next_timeout(Duration::from_millis(500)) {
            heard.push(event);
        }
        if heard.iter().any(|event| matches!(event, ActionEvent::Finished { .. })) {
            break;
        }
    }
    let has = |pick: &dyn Fn(&ActionEvent<PlaceObject>) -> bool| heard.iter().any(pick);
    let succeeded = GoalStatus::STATUS_SUCCEEDED;
    assert!(
        has(
            &|event| matches!(event, ActionEvent::Finished { status, result: got, .. } if *status == succeeded && *got == result())
        ),
        "{heard:?}"
    );
    assert!(
        has(&|event| matches!(event, ActionEvent::Feedback { feedback: got, .. } if *got == feedback())),
        "{heard:?}"
    );
    assert!(has(&|event| matches!(event, ActionEvent::Status { .. })), "{heard:?}");
}
