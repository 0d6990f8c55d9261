//! The node on the graph and on the web.

use crate::access::{Access, random_token};
use crate::hub::Hub;
use crate::server::{Limits, Server};
use crate::{Event, OperatorUi, Output, Recorded, Settings, recordings};
use apprentice_msgs::msg::{
    ActionDemonstration, LearnerHistory, PlacementDemonstration, QueryResponse, Retraction, RiskPreference,
    SegmentCritique, TrajectoryPreference,
};
use apprentice_msgs::visualization_msgs::{
    GetInteractiveMarkers, GetInteractiveMarkersResponse, InteractiveMarkerUpdate, MarkerArray,
};
use bus::{Arguments, Bus, EventSender, Graph, Level, NodeError, Qos};
use std::fs::File;
use std::io::{Read, Write};
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, TcpListener};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use uuid::Uuid;

/// More wishes to read recordings are not kept.
const MAX_WANTED: usize = 4;
/// A longer token file is refused, bytes.
const MAX_TOKEN_FILE: u64 = 1024;

/// Runs the node until it is asked to stop.
pub fn run(graph: &Graph, arguments: &Arguments) -> Result<(), NodeError> {
    let settings: Settings = arguments.settings()?;
    let listener = listen(&settings)?;
    let address = listener.local_addr().map_err(|error| start(&error))?;
    let token = token_of(&settings.token_file)?;
    let access = Access::new(token.as_deref(), address.ip(), address.port(), &settings.allowed_hosts)
        .map_err(|error| start(&error))?;
    let url = format!("http://{}/?{}", shown(address), access.query());

    let mut bus = Bus::open(graph, arguments, &settings)?;
    let demonstration = bus.publisher::<PlacementDemonstration>("demonstration", Qos::Event)?;
    let actions = bus.publisher::<ActionDemonstration>("action_demonstration", Qos::Event)?;
    let critique = bus.publisher::<SegmentCritique>("critique", Qos::Event)?;
    let comparison = bus.publisher::<TrajectoryPreference>("preference", Qos::Event)?;
    let history = bus.publisher::<LearnerHistory>("learner_history", Qos::Event)?;
    let retraction = bus.publisher::<Retraction>("retraction", Qos::Event)?;
    let response = bus.publisher::<QueryResponse>("response", Qos::Event)?;
    let preference = bus.publisher::<RiskPreference>("risk_preference", Qos::State)?;
    let markers = bus.publisher::<MarkerArray>("markers", Qos::State)?;
    let handles = bus.publisher::<InteractiveMarkerUpdate>("question/update", Qos::Event)?;
    bus.subscribe("question/feedback", Qos::Event, |message| {
        Event::Handled(Box::new(message), Uuid::new_v4().to_string())
    })?;
    // Who comes later asks for everything, and takes the updates after it.
    let all_handles = Arc::new(Mutex::new(GetInteractiveMarkersResponse::default()));
    let asked_for = Arc::clone(&all_handles);
    bus.serve::<GetInteractiveMarkers>("question/get_interactive_markers", move |_| {
        asked_for.lock().unwrap_or_else(PoisonError::into_inner).clone()
    })?;
    bus.subscribe("scene", Qos::State, |message| Event::Scene(Box::new(message)))?;
    bus.subscribe("query", Qos::State, |message| Event::Query(Box::new(message)))?;
    bus.subscribe("lesson", Qos::State, |message| Event::Lesson(Box::new(message)))?;
    bus.subscribe("bounds", Qos::State, |message| Event::Bounds(Box::new(message)))?;
    bus.subscribe("posterior", Qos::State, |message| Event::Posterior(Box::new(message)))?;
    bus.subscribe("guess", Qos::State, |message| Event::Guess(Box::new(message)))?;
    bus.subscribe("plan", Qos::State, |message| Event::Plan(Box::new(message)))?;
    bus.subscribe("receipt", Qos::Event, |message| Event::Receipt(Box::new(message)))?;
    bus.subscribe("evidence", Qos::State, |message| Event::Evidence(Box::new(message)))?;
    bus.subscribe("world", Qos::State, |message| Event::World(Box::new(message)))?;
    bus.subscribe("world_query", Qos::State, |message| Event::WorldQuery(Box::new(message)))?;
    bus.subscribe("robust_policy", Qos::State, |message| Event::Policy(Box::new(message)))?;
    bus.subscribe("policy_frontier", Qos::State, |message| Event::Frontier(Box::new(message)))?;
    bus.subscribe("policy_bounds", Qos::State, |message| Event::PolicyBounds(Box::new(message)))?;
    bus.subscribe("arm_model", Qos::State, |message| Event::ArmModel(Box::new(message)))?;
    bus.subscribe("arm_pose", Qos::Stream, |message| Event::ArmPose(Box::new(message)))?;
    bus.subscribe("arm_motion", Qos::State, |message| Event::ArmMotion(Box::new(message)))?;
    bus.subscribe("carrying", Qos::State, |message| Event::Carrying(Box::new(message)))?;
    bus.subscribe("heartbeat", Qos::Event, |message| Event::Heartbeat(Box::new(message)))?;
    bus.every(Duration::from_millis(500), || Event::Tick);

    let files = files(PathBuf::from(&settings.recordings), bus.sender())?;
    let hub = Hub::new(usize::try_from(settings.max_pages).unwrap_or(1));
    let events = bus.sender();
    let server = Server::start(listener, access, hub.clone(), Limits::default(), move |event| events.send(event))
        .map_err(|error| start(&error))?;
    announce(&settings, &url)?;
    if !address.ip().is_loopback() {
        log::warn!("the page can be reached from the network, unencrypted: whoever listens in can read the token");
    }

    let mut node = OperatorUi::new(settings);
    let mut pages = usize::MAX;
    while let Some((now, event)) = bus.next() {
        for output in node.step(now, event) {
            match output {
                Output::Demonstration(message) => demonstration.publish(&message)?,
                Output::Actions(message) => actions.publish(&message)?,
                Output::Critique(message) => critique.publish(&message)?,
                Output::Comparison(message) => comparison.publish(&message)?,
                Output::History(message) => history.publish(&message)?,
                Output::Retraction(message) => retraction.publish(&message)?,
                Output::Response(message) => response.publish(&message)?,
                Output::Preference(message) => preference.publish(&message)?,
                Output::Markers(message) => markers.publish(&message)?,
                Output::Handles { update, all } => {
                    let now = GetInteractiveMarkersResponse { sequence_number: update.seq_num, markers: all };
                    *all_handles.lock().unwrap_or_else(PoisonError::into_inner) = now;
                    handles.publish(&update)?;
                }
                // A page that asks for more than can be read asks again.
                Output::LookUp => drop(files.try_send(Wanted::List)),
                Output::Read { id, name } => drop(files.try_send(Wanted::Log { id, name })),
                Output::Told(told) => hub.tell(told),
                Output::Warn(text) => log::warn!("{text}"),
            }
        }
        if hub.len() != pages {
            pages = hub.len();
            let facts = [("pages", pages.to_string()), ("address", server.address().to_string())];
            bus.status(Level::Ok, format!("{pages} pages are open"), &facts);
        }
    }
    Ok(())
}

/// What is wanted of the recordings.
enum Wanted {
    List,
    Log { id: String, name: String },
}

/// Reads recordings beside everything else: a long one takes a while.
fn files(folder: PathBuf, events: EventSender<Event>) -> Result<SyncSender<Wanted>, NodeError> {
    let (wanted, received) = sync_channel(MAX_WANTED);
    let work = move || {
        for wanted in received {
            events.send(match wanted {
                Wanted::List => Event::Recordings(recordings::list(&folder)),
                Wanted::Log { id, name } => {
                    let log = recordings::read(&folder, &name);
                    Event::Recorded(Box::new(Recorded { id, name, log }))
                }
            });
        }
    };
    std::thread::Builder::new().name("recordings".into()).spawn(work).map_err(|error| start(&error))?;
    Ok(wanted)
}

fn start(error: &dyn std::fmt::Display) -> NodeError {
    NodeError::Start(format!("the operator page cannot be served: {error}"))
}

fn listen(settings: &Settings) -> Result<TcpListener, NodeError> {
    let address = settings.address().unwrap_or(IpAddr::V4(Ipv4Addr::LOCALHOST));
    let port = u16::try_from(settings.port).map_err(|error| start(&error))?;
    TcpListener::bind((address, port)).map_err(|error| {
        let what = match error.kind() {
            std::io::ErrorKind::AddrInUse => format!("port {port} on {address} is in use"),
            std::io::ErrorKind::PermissionDenied => format!("port {port} on {address} is not permitted"),
            _ => format!("port {port} on {address} cannot be had ({error})"),
        };
        let advice = "choose another with -p port:=N, or any free one with -p port:=0";
        NodeError::Start(format!("the operator page cannot be served: {what}; {advice}"))
    })
}

/// The address as a browser on this machine reaches it.
fn shown(address: SocketAddr) -> SocketAddr {
    let ip = match address.ip() {
        IpAddr::V4(Ipv4Addr::UNSPECIFIED) => IpAddr::V4(Ipv4Addr::LOCALHOST),
        IpAddr::V6(Ipv6Addr::UNSPECIFIED) => IpAddr::V6(Ipv6Addr::LOCALHOST),
        other => other,
    };
    SocketAddr::new(ip, address.port())
}

/// The token in a file, which is made with a random one where there is none: the page then outlives a restart.
fn token_of(path: &str) -> Result<Option<String>, NodeError> {
    if path.is_empty() {
        return Ok(None);
    }
    let failed = |what: &str, error: &dyn std::fmt::Display| {
        NodeError::Start(format!("token_file '{path}' cannot be {what}: {error}"))
    };
    match File::open(path) {
        Ok(file) => {
            let mut text = String::new();
            file.take(MAX_TOKEN_FILE).read_to_string(&mut text).map_err(|error| failed("read", &error))?;
            Ok(Some(text.trim().to_owned()))
        }
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            let token = random_token().map_err(|error| start(&error))?;
            write_privately(Path::new(path), &token).map_err(|error| failed("written", &error))?;
            Ok(Some(token))
        }
        Err(error) => Err(failed("read", &error)),
    }
}

/// Says where the page is. Not through the log: that goes onto the graph and into bags, and the address is a secret.
fn announce(settings: &Settings, url: &str) -> Result<(), NodeError> {
    eprintln!("operator page: {url}");
    if settings.url_file.is_empty() {
        return Ok(());
    }
    write_privately(Path::new(&settings.url_file), url)
        .map_err(|error| NodeError::Start(format!("url_file '{}' cannot be written: {error}", settings.url_file)))
}

/// Writes a file that only its owner can read, at once and whole.
fn write_privately(path: &Path, text: &str) -> std::io::Result<()> {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".part");
    let part = path.with_file_name(name);
    let mut options = File::options();
    options.write(true).create(true).truncate(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    let mut file = options.open(&part)?;
    writeln!(file, "{text}")?;
    file.sync_all()?;
    std::fs::rename(&part, path)
}
