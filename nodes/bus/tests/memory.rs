//! Claims about the graph within a process: what is published arrives, in order, to whom it should.

use std::time::Duration;

use apprentice_msgs::{
    diagnostic_msgs::DiagnosticArray,
    msg::{Heartbeat, NodeSettings as NodeSettingsMessage},
    rcl_interfaces::{
        DescribeParameters, DescribeParametersRequest, GetParameters, GetParametersRequest, ListParameters,
        ListParametersRequest, Log, Parameter, SetParameters, SetParametersRequest,
    },
    rosgraph_msgs::Clock,
    std_msgs::String as Text,
    std_srvs::{SetBool, SetBoolRequest, SetBoolResponse},
};
use bus::{
    Arguments, Bus, Graph, Level, MemoryGraph, Next, NodeSettings, ParameterSpec, Qos, Range, settings_from_yaml,
};
use serde::{Deserialize, Serialize};

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Settings {
    speed: f64,
    count: i64,
}

impl Default for Settings {
    fn default() -> Self {
        Settings { speed: 0.1, count: 3 }
    }
}

impl NodeSettings for Settings {
    const NODE: &'static str = "tested";
    const ABOUT: &'static str = "A node under test.";
    const PARAMETERS: &'static [ParameterSpec] = &[
        ParameterSpec { name: "speed", about: "metres per second", range: Range::Float { min: 0.0, max: 1.0 } },
        ParameterSpec { name: "count", about: "how many", range: Range::Integer { min: 1, max: 10 } },
    ];
}

#[derive(Debug, Clone, PartialEq)]
enum Event {
    Text(String),
    Tick,
    Settings(Box<NodeSettingsMessage>),
    Heartbeat(Heartbeat),
    Log(Log),
    Diagnostics(DiagnosticArray),
    Raw(Vec<u8>),
}

fn arguments(args: &[&str]) -> Arguments {
    let args: Vec<String> = args.iter().map(|arg| (*arg).to_owned()).collect();
    Arguments::parse(&args).expect("good arguments")
}

fn open(graph: &MemoryGraph, args: &[&str]) -> Bus<Event> {
    let arguments = arguments(args);
    let settings: Settings = arguments.settings().expect("good settings");
    Bus::open(&Graph::Memory(graph.clone()), &arguments, &settings).expect("a graph in memory")
}

fn text(data: &str) -> Text {
    Text { data: data.to_owned() }
}

/// Events until nothing comes for a while.
fn drain(bus: &mut Bus<Event>) -> Vec<Event> {
    let mut events = Vec::new();
    while let Next::Event(_, event) = bus.next_timeout(Duration::from_millis(20)) {
        events.push(event);
    }
    events
}

#[test]
fn what_is_published_arrives_in_order() {
    let graph = MemoryGraph::new();
    let mut sender = open(&graph, &["-r", "__node:=sender"]);
    let mut receiver = open(&graph, &["-r", "__node:=receiver"]);
    receiver.subscribe("words", Qos::Event, |message: Text| Event::Text(message.data)).expect("a subscription");
    let words = sender.publisher::<Text>("words", Qos::Event).expect("a publisher");
    assert_eq!(words.subscriptions(), 1);
    for index in 0..2000 {
        words.publish(&text(&index.to_string())).expect("published");
    }
    for index in 0..2000 {
        let (_, event) = receiver.next().expect("an event");
        assert_eq!(event, Event::Text(index.to_string()));
    }
}

#[test]
fn late_joiners_get_states_and_logs_but_no_events() {
    let graph = MemoryGraph::new();
    let mut sender = open(&graph, &["-r", "__node:=sender"]);
    for (topic, qos) in [("state", Qos::State), ("log", Qos::Log), ("event", Qos::Event)] {
        let publisher = sender.publisher::<Text>(topic, qos).expect("a publisher");
        publisher.publish(&text(&format!("{topic} 1"))).expect("published");
        publisher.publish(&text(&format!("{topic} 2"))).expect("published");
        // The publisher must live for its history to live.
        std::mem::forget(publisher);
    }
    let mut receiver = open(&graph, &["-r", "__node:=receiver"]);
    for (topic, qos) in [("state", Qos::State), ("log", Qos::Log), ("event", Qos::Event)] {
        receiver.subscribe(topic, qos, |message: Text| Event::Text(message.data)).expect("a subscription");
    }
    let got = drain(&mut receiver);
    let wanted: Vec<Event> = ["state 2", "log 1", "log 2"].iter().map(|text| Event::Text((*text).to_owned())).collect();
    assert_eq!(got, wanted);
}

#[test]
fn quality_of_service_and_types_must_fit() {
    let graph = MemoryGraph::new();
    let mut node = open(&graph, &[]);
    let stream = node.publisher::<Text>("words", Qos::Stream).expect("a publisher");
    node.subscribe("words", Qos::Event, |message: Text| Event::Text(message.data)).expect("a subscription");
    node.subscribe("words", Qos::Stream, Event::Heartbeat).expect("a subscription");
    assert_eq!(stream.subscriptions(), 0);
    stream.publish(&text("unheard")).expect("published");
    assert!(drain(&mut node).is_empty());
}

#[test]
fn malformed_messages_are_counted_and_left_out() {
    let graph = MemoryGraph::new();
    let mut node = open(&graph, &[]);
    node.subscribe("words", Qos::Event, |message: Text| Event::Text(message.data)).expect("a subscription");
    let topic = "/apprentice/words";
    for bytes in [&[][..], &[0, 1], &[0, 1, 0, 0], &[0, 1, 0, 0, 255, 255, 255, 255, 65]] {
        assert_eq!(graph.inject_raw(topic, "std_msgs/msg/String", bytes), 1);
    }
    let good = apprentice_msgs::to_cdr(&text("good"));
    graph.inject_raw(topic, "std_msgs/msg/String", &good);
    assert_eq!(drain(&mut node), [Event::Text("good".to_owned())]);
}

#[test]
fn remapping_and_namespaces_move_topics() {
    let graph = MemoryGraph::new();
    let mut sender = open(&graph, &["--ros-args", "-r", "words:=/shared/text", "-r", "__ns:=/a/b"]);
    let publisher = sender.publisher::<Text>("words", Qos::Event).expect("a publisher");
    assert_eq!(publisher.topic(), "/shared/text");
    assert_eq!(sender.publisher::<Text>("~/own", Qos::Event).expect("a publisher").topic(), "/a/b/tested/own");
    let names: Vec<String> = sender.topics().into_iter().map(|topic| topic.name).collect();
    for name in ["/shared/text", "/a/b/heartbeat", "/a/b/settings", "/rosout", "/diagnostics"] {
        assert!(names.iter().any(|known| known == name), "{name} is not in {names:?}");
    }
}

#[test]
fn every_node_tells_how_it_was_started_and_that_it_lives() {
    let graph = MemoryGraph::new();
    let node = open(&graph, &["-p", "speed:=0.7"]);
    node.status(Level::Warn, "a little warm", &[("temperature", "40".to_owned())]);
    let mut watcher = open(&graph, &["-r", "__node:=watcher"]);
    watcher.subscribe("settings", Qos::Log, |message| Event::Settings(Box::new(message))).expect("a subscription");
    watcher.subscribe("heartbeat", Qos::Event, Event::Heartbeat).expect("a subscription");
    watcher.subscribe("/rosout", Qos::Log, Event::Log).expect("a subscription");
    watcher.subscribe("/diagnostics", Qos::Event, Event::Diagnostics).expect("a subscription");
    let mut settings = None;
    let mut heartbeats = 0;
    let mut diagnosed = false;
    for _ in 0..200 {
        let Next::Event(_, event) = watcher.next_timeout(Duration::from_millis(200)) else {
            continue;
        };
        match event {
            Event::Settings(message) if message.name == "/apprentice/tested" => {
                settings = Some(settings_from_yaml::<Settings>(&message.parameters));
            }
            Event::Heartbeat(beat) if beat.node == "/apprentice/tested" => heartbeats += 1,
            Event::Diagnostics(array) => {
                let status = &array.status[0];
                diagnosed |= status.name == "apprentice/tested"
                    && status.message == "a little warm"
                    && status.values.iter().any(|value| value.key == "temperature");
            }
            _ => {}
        }
        if settings.is_some() && heartbeats >= 3 && diagnosed {
            break;
        }
    }
    assert_eq!(settings, Some(Ok(Settings { speed: 0.7, count: 3 })));
    assert!(heartbeats >= 3 && diagnosed);
}

#[test]
fn parameters_can_be_listed_read_and_described_but_not_set() {
    let graph = MemoryGraph::new();
    let _node = open(&graph, &["-p", "speed:=0.7"]);
    let service = |name: &str| format!("/apprentice/tested/{name}");
    let list = graph
        .call::<ListParameters>(&service("list_parameters"), &ListParametersRequest::default())
        .expect("an answer");
    assert_eq!(list.result.names, ["speed", "count", "use_sim_time", "service_mapping"]);
    let names = vec!["speed".to_owned(), "nonsense".to_owned()];
    let values = graph
        .call::<GetParameters>(&service("get_parameters"), &GetParametersRequest { names: names.clone() })
        .expect("an answer")
        .values;
    assert_eq!(values[0].double_value, 0.7);
    assert_eq!(values[1].r#type, 0);
    let described = graph
        .call::<DescribeParameters>(&service("describe_parameters"), &DescribeParametersRequest { names })
        .expect("an answer")
        .descriptors;
    assert_eq!(described[0].description, "metres per second");
    assert_eq!(described[0].floating_point_range[0].to_value, 1.0);
    let set = graph
        .call::<SetParameters>(
            &service("set_parameters"),
            &SetParametersRequest { parameters: vec![Parameter { name: "speed".to_owned(), ..Parameter::default() }] },
        )
        .expect("an answer");
    assert!(!set.results[0].successful && set.results[0].reason.contains("restart"));
}

#[test]
fn services_answer() {
    let graph = MemoryGraph::new();
    let mut node = open(&graph, &[]);
    node.serve::<SetBool>("switch", |request| SetBoolResponse { success: request.data, message: "done".to_owned() })
        .expect("a service");
    let answer = graph.call::<SetBool>("/apprentice/switch", &SetBoolRequest { data: true });
    assert_eq!(answer.map(|answer| answer.success), Some(true));
    assert!(graph.call::<SetBool>("/switch", &SetBoolRequest { data: true }).is_none());
}

#[test]
fn simulated_time_drives_now_and_timers() {
    let graph = MemoryGraph::new();
    let mut node = open(&graph, &["-p", "use_sim_time:=true"]);
    node.every(Duration::from_secs(10), || Event::Tick);
    assert_eq!(node.now().sec, 0);
    assert_eq!(node.next_timeout(Duration::from_millis(20)), Next::Timeout);
    let mut clock = Clock::default();
    clock.clock.sec = 35;
    graph.inject_raw("/clock", "rosgraph_msgs/msg/Clock", &apprentice_msgs::to_cdr(&clock));
    assert_eq!(node.now().sec, 35);
    assert_eq!(drain(&mut node), [Event::Tick], "missed periods are skipped");
}

#[test]
fn a_malformed_clock_is_counted_and_time_stands() {
    let graph = MemoryGraph::new();
    let mut watcher = open(&graph, &["-r", "__node:=watcher"]);
    watcher.subscribe("/diagnostics", Qos::Event, Event::Diagnostics).expect("a subscription");
    let node = open(&graph, &["-p", "use_sim_time:=true"]);
    let mut clock = Clock::default();
    clock.clock.sec = 35;
    graph.inject_raw("/clock", "rosgraph_msgs/msg/Clock", &apprentice_msgs::to_cdr(&clock));
    assert_eq!(graph.inject_raw("/clock", "rosgraph_msgs/msg/Clock", &[0, 1, 0, 0, 7]), 1);
    assert_eq!(node.now().sec, 35);
    let told = (0..50).any(|_| match watcher.next_timeout(Duration::from_millis(200)) {
        Next::Event(_, Event::Diagnostics(array)) => array.status.iter().any(|status| {
            let counted = status.values.iter().any(|value| value.key == "malformed" && value.value == "1");
            status.name == "apprentice/tested" && counted
        }),
        _ => false,
    });
    assert!(told, "the diagnostics do not count it");
}

#[test]
fn timers_events_and_senders_meet_in_one_queue() {
    let graph = MemoryGraph::new();
    let mut node = open(&graph, &[]);
    node.every(Duration::from_millis(5), || Event::Tick);
    let sender = node.sender();
    let thread = std::thread::spawn(move || sender.send(Event::Text("from a thread".to_owned())));
    thread.join().expect("the thread ends");
    let mut ticks = 0;
    let mut texts = 0;
    while ticks < 3 || texts < 1 {
        match node.next() {
            Some((_, Event::Tick)) => ticks += 1,
            Some((_, Event::Text(_))) => texts += 1,
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn a_timer_that_is_always_due_does_not_keep_events_away() {
    let graph = MemoryGraph::new();
    let mut node = open(&graph, &[]);
    node.every(Duration::from_millis(1), || Event::Tick);
    std::thread::sleep(Duration::from_millis(3));
    let sender = node.sender();
    for index in 0..5 {
        sender.send(Event::Text(index.to_string()));
    }
    let mut texts = Vec::new();
    for _ in 0..11 {
        std::thread::sleep(Duration::from_millis(3));
        if let Some((_, Event::Text(data))) = node.next() {
            texts.push(data);
        }
    }
    assert_eq!(texts, ["0", "1", "2", "3", "4"]);
}

#[test]
fn shutdown_and_stoppers_end_nodes() {
    let graph = MemoryGraph::new();
    let mut first = open(&graph, &["-r", "__node:=first"]);
    let mut second = open(&graph, &["-r", "__node:=second"]);
    let stopper = first.stopper();
    let thread = std::thread::spawn(move || {
        std::thread::sleep(Duration::from_millis(20));
        stopper.stop();
    });
    assert_eq!(first.next(), None);
    thread.join().expect("the thread ends");
    assert_eq!(second.next_timeout(Duration::ZERO), Next::Timeout);
    graph.shutdown();
    assert_eq!(second.next(), None);
    assert_eq!(open(&graph, &[]).next_timeout(Duration::ZERO), Next::Shutdown);
}

#[test]
fn raw_messages_pass_through_unchanged() {
    let graph = MemoryGraph::new();
    let mut node = open(&graph, &[]);
    let qos = Qos::Event.profile();
    let subscription =
        node.subscribe_raw("/x", "pkg/msg/Unknown", qos.clone(), |raw| Event::Raw(raw.cdr)).expect("a subscription");
    let publisher = node.publisher_raw("/x", "pkg/msg/Unknown", qos.clone()).expect("a publisher");
    let bytes = [0, 1, 0, 0, 9, 8, 7];
    publisher.publish(&bytes).expect("published");
    assert!(publisher.publish(&bytes[..3]).is_err());
    assert_eq!(drain(&mut node), [Event::Raw(bytes.to_vec())]);
    drop(subscription);
    publisher.publish(&bytes).expect("published");
    assert!(drain(&mut node).is_empty());
    assert!(node.publisher_raw("/x", "not a type", qos).is_err());
}
