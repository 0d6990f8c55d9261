//! The claims about topics, discovery, time and signals.

use std::{
    process::{Command, Stdio},
    time::Duration,
};

use apprentice_msgs::{Message, msg::Heartbeat, rosgraph_msgs::Clock, std_msgs::String as Text, to_cdr};
use bus::{Durability, Next, Qos, QosProfile, Reliability};

use crate::{
    Peer, ROLE,
    common::{Event, open, text, until, until_gone, wait_for},
    this_program,
};

pub fn peer_process() {
    let _peer = Peer::start();
    let mut node = open(&["-r", "__node:=asker"]);
    let ping = node.publisher::<Text>("ping", Qos::Event).expect("a publisher");
    node.subscribe("pong", Qos::Event, |message: Text| Event::Text(message.data)).expect("a subscription");
    until("the peer listens", || ping.subscriptions() == 1);
    // The peer's publisher may be matched a little later than its subscription.
    let mut index = 0;
    node.every(Duration::from_millis(50), || Event::Tick);
    wait_for(&mut node, "a pong", |event| match event {
        Event::Tick => {
            index += 1;
            ping.publish(&text(&format!("ping {index}"))).expect("published");
            None
        }
        Event::Text(data) => data.ends_with(" back").then_some(()),
        _ => None,
    });
    let mut late = open(&["-r", "__node:=late"]);
    late.subscribe("peer_state", Qos::State, |message: Text| Event::Text(message.data)).expect("a subscription");
    late.subscribe("peer_log", Qos::Log, |message: Text| Event::Text(message.data)).expect("a subscription");
    let (mut logs, mut state) = (Vec::new(), String::new());
    wait_for(&mut late, "state and log", |event| {
        match event {
            Event::Text(data) if data.starts_with("log") => logs.push(data),
            Event::Text(data) => state = data,
            _ => {}
        }
        (logs.len() == 5 && state == "state 4").then_some(())
    });
    assert_eq!(logs, ["log 0", "log 1", "log 2", "log 3", "log 4"]);
}

pub fn burst() {
    const N: usize = 20_000;
    let mut receiver = open(&["-r", "__node:=receiver"]);
    receiver.subscribe("burst", Qos::Event, |message: Text| Event::Text(message.data)).expect("a subscription");
    let mut sender = open(&["-r", "__node:=sender"]);
    let burst = sender.publisher::<Text>("burst", Qos::Event).expect("a publisher");
    until("the two are matched", || burst.subscriptions() == 1);
    std::thread::sleep(Duration::from_millis(200));
    let thread = std::thread::spawn(move || {
        for index in 0..N {
            burst.publish(&text(&index.to_string())).expect("published");
        }
        (burst, sender)
    });
    for wanted in 0..N {
        let got = wait_for(&mut receiver, "the burst", |event| match event {
            Event::Text(data) => Some(data),
            _ => None,
        });
        assert_eq!(got, wanted.to_string());
    }
    thread.join().expect("the sender ends");
}

pub fn large() {
    let mut receiver = open(&["-r", "__node:=receiver"]);
    receiver.subscribe("large", Qos::State, |message: Text| Event::Text(message.data)).expect("a subscription");
    let mut sender = open(&["-r", "__node:=sender"]);
    let large = sender.publisher::<Text>("large", Qos::State).expect("a publisher");
    let data = "0123456789".repeat(100_000);
    large.publish(&text(&data)).expect("published");
    let got = wait_for(&mut receiver, "a megabyte", |event| match event {
        Event::Text(data) => Some(data),
        _ => None,
    });
    assert!(got == data, "{} of {} bytes", got.len(), data.len());
}

pub fn malformed() {
    let mut receiver = open(&["-r", "__node:=receiver"]);
    receiver.subscribe("bad", Qos::Event, |message: Text| Event::Text(message.data)).expect("a subscription");
    let mut sender = open(&["-r", "__node:=sender"]);
    let raw = sender.publisher_raw("bad", Text::TYPE, Qos::Event.profile()).expect("a publisher");
    until("the two are matched", || raw.subscriptions() == 1);
    std::thread::sleep(Duration::from_millis(200));
    for bytes in [&[0, 1, 0, 0][..], &[0, 1, 0, 0, 255, 255, 255, 127, 65, 66, 67]] {
        raw.publish(bytes).expect("published");
    }
    raw.publish(&to_cdr(&text("good"))).expect("published");
    let got = wait_for(&mut receiver, "the good message", |event| match event {
        Event::Text(data) => Some(data),
        _ => None,
    });
    assert_eq!(got, "good");
}

/// Waits for a warning of the node `warned` that holds all `words`.
fn wait_for_warning(watcher: &mut bus::Bus<Event>, words: &[&str]) {
    wait_for(watcher, &format!("a warning with {words:?}"), |event| match event {
        Event::Log(log) => {
            words.iter().all(|word| log.msg.contains(word) && log.name == "apprentice.warned").then_some(())
        }
        _ => None,
    });
}

pub fn foreign_type() {
    let mut watcher = open(&["-r", "__node:=watcher"]);
    watcher.subscribe("/rosout", Qos::Log, Event::Log).expect("a subscription");
    let mut sender = open(&["-r", "__node:=sender"]);
    let beats = sender.publisher::<Heartbeat>("mixed", Qos::State).expect("a publisher");
    let mut warned = open(&["-r", "__node:=warned"]);
    warned.subscribe("mixed", Qos::State, |message: Text| Event::Text(message.data)).expect("a subscription");
    beats.publish(&Heartbeat { node: "x".to_owned(), ..Heartbeat::default() }).expect("published");
    wait_for_warning(
        &mut watcher,
        &["/apprentice/mixed: /apprentice/sender", "apprentice_msgs/msg/Heartbeat", "std_msgs/msg/String"],
    );
    assert_eq!(warned.next_timeout(Duration::from_millis(500)), Next::Timeout);
}

pub fn qos_mismatch() {
    let mut watcher = open(&["-r", "__node:=watcher"]);
    watcher.subscribe("/rosout", Qos::Log, Event::Log).expect("a subscription");
    let mut sender = open(&["-r", "__node:=sender"]);
    let _stream = sender.publisher::<Text>("weak", Qos::Stream).expect("a publisher");
    let mut warned = open(&["-r", "__node:=warned"]);
    warned.subscribe("weak", Qos::State, |message: Text| Event::Text(message.data)).expect("a subscription");
    wait_for_warning(&mut watcher, &["/apprentice/weak: /apprentice/sender", "reliability", "BestEffort", "Reliable"]);
}

pub fn raw_bytes() {
    let qos = Qos::Log.profile();
    let mut sender = open(&["-r", "__node:=sender"]);
    let typed = sender.publisher::<Text>("recorded", Qos::Log).expect("a publisher");
    typed.publish(&text("one")).expect("published");
    let mut recorder = open(&["-r", "__node:=recorder"]);
    let _subscription =
        recorder.subscribe_raw("/apprentice/recorded", Text::TYPE, qos.clone(), Event::Raw).expect("a subscription");
    let raw = wait_for(&mut recorder, "a recording", |event| match event {
        Event::Raw(raw) => Some(raw),
        _ => None,
    });
    assert_eq!(raw.cdr, to_cdr(&text("one")));
    assert!(raw.source_timestamp.is_some());
    let replayed = recorder.publisher_raw("/replayed", Text::TYPE, qos).expect("a publisher");
    replayed.publish(&raw.cdr).expect("published");
    sender.subscribe("/replayed", Qos::Log, |message: Text| Event::Text(message.data)).expect("a subscription");
    let got = wait_for(&mut sender, "the replay", |event| match event {
        Event::Text(data) => Some(data),
        _ => None,
    });
    assert_eq!(got, "one");
}

pub fn discovery() {
    let mut sender = open(&["-r", "__node:=sender"]);
    let _state = sender.publisher::<Text>("seen", Qos::State).expect("a publisher");
    let watcher = open(&["-r", "__node:=watcher"]);
    let mut last = String::new();
    until("the topic is known with its node", || {
        let topics = watcher.topics();
        last = format!("{topics:?}");
        topics.iter().any(|topic| {
            topic.name == "/apprentice/seen"
                && topic.type_name == "std_msgs/msg/String"
                && topic.qos.reliability == Reliability::Reliable
                && topic.qos.durability == Durability::TransientLocal
                && topic.publishers[0].node.as_deref() == Some("/apprentice/sender")
        })
    });
    assert!(!last.contains("ros_discovery_info"), "{last}");
}

pub fn sim_time() {
    let mut sender = open(&["-r", "__node:=sender"]);
    let qos = QosProfile::new(Reliability::BestEffort, Durability::Volatile, 1);
    let clock = sender.publisher::<Clock>("/clock", Qos::Custom(qos)).expect("a publisher");
    let mut node = open(&["-p", "use_sim_time:=true"]);
    node.every(Duration::from_secs(5), || Event::Tick);
    let mut time = Clock::default();
    until("the simulated time arrives", || {
        time.clock.sec += 1;
        clock.publish(&time).expect("published");
        node.now().sec > 5
    });
    assert!(matches!(node.next(), Some((_, Event::Tick))));
}

pub fn sigterm() {
    let mut peer = Peer::start();
    let mut node = open(&["-r", "__node:=watcher"]);
    let ping = node.publisher::<Text>("ping", Qos::Event).expect("a publisher");
    until("the peer listens", || ping.subscriptions() == 1);
    let sent = Command::new("kill").args(["-TERM", &peer.0.id().to_string()]).status().expect("kill runs");
    assert!(sent.success());
    let status = peer.0.wait().expect("the peer ends");
    assert_eq!(status.code(), Some(0));
    until_gone("the peer has left the graph", || ping.subscriptions() == 0);
}

pub fn orphan() {
    let mut node = open(&["-r", "__node:=watcher"]);
    let ping = node.publisher::<Text>("ping", Qos::Event).expect("a publisher");
    let program = std::env::current_exe().expect("this program has a path");
    let mut parent = Command::new("sh")
        .args(["-c", "APPRENTICE_PARENT_PID=$$ \"$0\" & wait"])
        .arg(program)
        .env(ROLE, "peer")
        .stderr(Stdio::piped())
        .spawn()
        .expect("a shell");
    until("the peer listens", || ping.subscriptions() == 1);
    parent.kill().expect("the shell can be killed");
    let output = parent.wait_with_output().expect("the shell ends, and the peer with it");
    until_gone("the peer has left the graph", || ping.subscriptions() == 0);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(errors.contains("[WARN] [apprentice.peer]: the process"), "{errors}");
}

pub fn wrong_environment() {
    for (variables, words) in [
        (vec![("ROS_DOMAIN_ID", "233")], "ROS_DOMAIN_ID=`233`: expected an integer from 0 to 232"),
        (vec![("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCAL")], "one of SUBNET, LOCALHOST, OFF"),
        (vec![("ROS_SECURITY_ENABLE", "true"), ("ROS_SECURITY_STRATEGY", "Enforce")], "DDS security is not built"),
    ] {
        let output = this_program("peer").envs(variables).output().expect("the peer starts");
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{errors}");
        assert!(errors.starts_with("error: peer: ") && errors.contains(words), "{errors}");
        assert_eq!(errors.lines().count(), 1, "{errors}");
    }
}
