//! The parameter services as a client that is not ours calls them: ros2-client's, in both mappings.

use std::time::{Duration, Instant};

use futures::FutureExt;
use ros2_client::{
    Context, Message, Name, Node, NodeName, NodeOptions, QosProfile, ServiceMapping, ServiceTypeName,
    dds::rustdds::DomainParticipantBuilder,
};
use serde::{Deserialize, Serialize, de::DeserializeOwned};

use crate::{PATIENCE, common::open};

// The services' halves as this test understands them, written down independently of the generated ones.

#[derive(Debug, Clone, Serialize, Deserialize)]
struct ListRequest {
    prefixes: Vec<String>,
    depth: u64,
}
impl Message for ListRequest {}

#[derive(Debug, Clone, Serialize, Deserialize)]
struct ListResponse {
    names: Vec<String>,
    prefixes: Vec<String>,
}
impl Message for ListResponse {}

#[derive(Debug, Clone, Serialize, Deserialize)]
struct Names {
    names: Vec<String>,
}
impl Message for Names {}

#[derive(Debug, Clone, Serialize, Deserialize)]
struct Values {
    values: Vec<Value>,
}
impl Message for Values {}

#[derive(Debug, Clone, Default, Serialize, Deserialize)]
struct Value {
    kind: u8,
    boolean: bool,
    integer: i64,
    double: f64,
    text: String,
    bytes: Vec<u8>,
    booleans: Vec<bool>,
    integers: Vec<i64>,
    doubles: Vec<f64>,
    texts: Vec<String>,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
struct SetRequest {
    parameters: Vec<(String, Value)>,
}
impl Message for SetRequest {}

#[derive(Debug, Clone, Serialize, Deserialize)]
struct SetResponse {
    results: Vec<(bool, String)>,
}
impl Message for SetResponse {}

pub fn enhanced() {
    check("enhanced", ServiceMapping::Enhanced);
}

pub fn cyclone() {
    check("cyclone", ServiceMapping::Cyclone);
}

/// Lists, reads and tries to set a parameter.
fn check(name: &str, mapping: ServiceMapping) {
    let served = format!("served_{name}");
    let remap = format!("__node:={served}");
    let parameter = format!("service_mapping:={name}");
    let _node = open(&["--ros-args", "-r", &remap, "-p", &parameter, "-p", "speed:=0.25"]);
    let mut client = client_node();
    let service = |service: &str| format!("/apprentice/{served}/{service}");
    let listed: ListResponse = call(
        &mut client,
        mapping,
        &service("list_parameters"),
        "ListParameters",
        ListRequest { prefixes: Vec::new(), depth: 0 },
    );
    assert_eq!(listed.names, ["speed", "use_sim_time", "service_mapping"]);
    assert!(listed.prefixes.is_empty());
    let read: Values = call(
        &mut client,
        mapping,
        &service("get_parameters"),
        "GetParameters",
        Names { names: vec!["speed".to_owned(), "service_mapping".to_owned()] },
    );
    assert_eq!((read.values[0].kind, read.values[0].double), (3, 0.25));
    assert_eq!(read.values[1].text, name);
    let set: SetResponse = call(
        &mut client,
        mapping,
        &service("set_parameters"),
        "SetParameters",
        SetRequest { parameters: vec![("speed".to_owned(), Value::default())] },
    );
    assert!(!set.results[0].0 && set.results[0].1.contains("read-only"), "{set:?}");
}

/// A node of ros2-client on the domain of this run.
pub fn client_node() -> Node {
    let domain = std::env::var("ROS_DOMAIN_ID").expect("the starter sets it");
    let participant = DomainParticipantBuilder::new(domain.parse().expect("a number"))
        .with_only_networks([std::net::Ipv4Addr::LOCALHOST])
        .build()
        .expect("a participant");
    Context::from_domain_participant(participant)
        .expect("a context")
        .new_node(NodeName::new("/", "client").expect("a name"), NodeOptions::new())
        .expect("a node")
}

/// Calls a service, again and again until it answers: the first request may be lost before both sides are matched.
#[expect(clippy::disallowed_methods, reason = "a test gives up some time")]
fn call<Request, Response>(
    node: &mut Node,
    mapping: ServiceMapping,
    service: &str,
    kind: &str,
    request: Request,
) -> Response
where
    Request: Message + Clone + Serialize + DeserializeOwned + 'static,
    Response: Message + Clone + DeserializeOwned + 'static,
{
    let qos = QosProfile::publisher_default();
    let client = node
        .create_client::<Request, Response>(
            mapping,
            &Name::parse(service).expect("a service name"),
            &ServiceTypeName::new("rcl_interfaces", kind),
            qos.clone(),
            qos,
        )
        .expect("a client");
    let until = Instant::now() + PATIENCE;
    while Instant::now() < until {
        let id = client.send_request(request.clone()).expect("a request goes out");
        let answer = smol::block_on(async {
            futures::select! {
                answer = client.async_receive_response(id).fuse() => answer.ok(),
                _ = FutureExt::fuse(smol::Timer::after(Duration::from_millis(500))) => None,
            }
        });
        if let Some(answer) = answer {
            return answer;
        }
    }
    panic!("{service} did not answer");
}
