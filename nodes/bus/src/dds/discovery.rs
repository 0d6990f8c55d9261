//! What discovery tells: who is on the graph, who is matched with whom, and what does not fit together.

use std::{
    collections::{BTreeMap, BTreeSet, HashSet},
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::Duration,
};

use futures::StreamExt;
use ros2_client::dds::rustdds::{
    DomainParticipant, DomainParticipantStatusEvent as Event, EndpointDescription, GUID, QosPolicies, StatusEvented,
};
use smol::{Timer, channel};

use crate::{
    dds::{
        mangle,
        node_info::{NodeInfo, ParticipantInfo},
        policies,
    },
    qos::QosProfile,
};

/// The identity of an endpoint or a participant.
pub(crate) type Gid = [u8; 16];

/// How often and how many times the name of a new node is looked for.
const NAME_PERIOD: Duration = Duration::from_millis(100);
const NAME_PERIODS: u32 = 15;

/// Most participants whose nodes are remembered.
const MAX_PARTICIPANTS: usize = 1000;

/// One endpoint of this node.
#[derive(Debug, Clone)]
pub(crate) struct LocalEndpoint {
    /// Name on DDS.
    pub(crate) topic: String,
    /// Type on DDS.
    pub(crate) type_name: String,
    /// What it offers or asks for.
    pub(crate) qos: QosProfile,
    /// Writes, or reads.
    pub(crate) writes: bool,
}

/// Something that the user should know about a remote endpoint, said once its node's name is known.
struct Report {
    remote: Gid,
    /// The text, around the name of the remote node.
    before: String,
    after: String,
}

/// The graph as this participant knows it.
pub(crate) struct GraphView {
    inner: Mutex<Inner>,
    reports: channel::Sender<Report>,
    to_say: channel::Receiver<Report>,
}

/// What the lock guards.
#[derive(Default)]
struct Inner {
    local: BTreeMap<Gid, LocalEndpoint>,
    matched: BTreeMap<Gid, BTreeSet<Gid>>,
    participants: BTreeMap<Gid, Vec<NodeInfo>>,
    reported: HashSet<(Gid, Gid)>,
}

impl GraphView {
    /// An empty view.
    pub(crate) fn new() -> GraphView {
        let (reports, to_say) = channel::bounded(100);
        GraphView { inner: Mutex::default(), reports, to_say }
    }

    /// Has something said; when far too much is to be said, the rest is left out.
    fn report(&self, remote: Gid, before: String, after: String) {
        let _ = self.reports.try_send(Report { remote, before, after });
    }

    /// Takes the lock; a panic elsewhere leaves the view usable.
    fn lock(&self) -> MutexGuard<'_, Inner> {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Adds an endpoint of this node.
    pub(crate) fn add_local(&self, gid: Gid, endpoint: LocalEndpoint) {
        self.lock().local.insert(gid, endpoint);
    }

    /// Forgets an endpoint of this node.
    pub(crate) fn remove_local(&self, gid: Gid) {
        let mut inner = self.lock();
        inner.local.remove(&gid);
        inner.matched.remove(&gid);
    }

    /// The endpoints of this node.
    pub(crate) fn local(&self) -> Vec<(Gid, LocalEndpoint)> {
        self.lock().local.iter().map(|(gid, endpoint)| (*gid, endpoint.clone())).collect()
    }

    /// How many remote endpoints are matched with one of this node.
    pub(crate) fn matched(&self, gid: Gid) -> usize {
        self.lock().matched.get(&gid).map_or(0, BTreeSet::len)
    }

    /// The node that an endpoint belongs to.
    pub(crate) fn owner(&self, gid: Gid) -> Option<String> {
        self.lock().participants.values().flatten().find(|node| node.owns(gid)).map(NodeInfo::full_name)
    }

    /// Whether this pair is reported for the first time.
    fn first_report(&self, local: Gid, remote: Gid) -> bool {
        let mut inner = self.lock();
        if inner.reported.len() > 10_000 {
            inner.reported.clear();
        }
        inner.reported.insert((local, remote))
    }

    /// Takes in what a participant says of its nodes.
    pub(crate) fn learn(&self, info: ParticipantInfo) {
        let mut inner = self.lock();
        if inner.participants.len() >= MAX_PARTICIPANTS {
            inner.participants.pop_first();
        }
        inner.participants.insert(info.gid, info.nodes);
    }

    /// Takes in one event of discovery, and reports what does not fit.
    fn take(&self, event: Event) {
        match event {
            Event::RemoteReaderMatched { local_writer: local, remote_reader: remote }
            | Event::RemoteWriterMatched { local_reader: local, remote_writer: remote } => {
                self.lock().matched.entry(local.to_bytes()).or_default().insert(remote.to_bytes());
            }
            Event::ReaderLost { guid, .. } | Event::WriterLost { guid, .. } => {
                let gid = guid.to_bytes();
                for remotes in self.lock().matched.values_mut() {
                    remotes.remove(&gid);
                }
            }
            // When the participant's own goodbye comes first, its endpoints are not lost one by one.
            Event::ParticipantLost { id, .. } => {
                for remotes in self.lock().matched.values_mut() {
                    remotes.retain(|gid| !gid.starts_with(id.as_ref()));
                }
            }
            Event::ReaderDetected { reader } => self.check_types(&reader, false),
            Event::WriterDetected { writer } => self.check_types(&writer, true),
            Event::RemoteReaderQosIncompatible { local_writer, remote_reader, requested_qos, offered_qos } => {
                self.report_qos(local_writer, remote_reader, &requested_qos, &offered_qos)
            }
            Event::RemoteWriterQosIncompatible { local_reader, remote_writer, requested_qos, offered_qos } => {
                self.report_qos(local_reader, remote_writer, &requested_qos, &offered_qos)
            }
            _ => {}
        }
    }

    /// Reports endpoints of this node that meet a remote one of another type.
    pub(crate) fn check_types(&self, remote: &EndpointDescription, remote_writes: bool) {
        self.check_type(remote.guid.to_bytes(), &remote.topic_name, &remote.type_name, remote_writes);
    }

    /// The same by name.
    pub(crate) fn check_type(&self, remote: Gid, topic: &str, type_name: &str, remote_writes: bool) {
        let clashes: Vec<(Gid, LocalEndpoint)> = self
            .lock()
            .local
            .iter()
            .filter(|(_, local)| local.topic == topic && local.type_name != type_name && local.writes != remote_writes)
            .map(|(gid, local)| (*gid, local.clone()))
            .collect();
        for (gid, local) in clashes {
            if !self.first_report(gid, remote) {
                continue;
            }
            let name = mangle::ros_topic(topic).unwrap_or(topic);
            let theirs = mangle::ros_type(type_name);
            let ours = mangle::ros_type(&local.type_name);
            let after = if remote_writes {
                format!(" publishes the type {theirs} but this node expects {ours}; its messages are left out")
            } else {
                format!(" expects the type {theirs} but this node publishes {ours}; it cannot read them")
            };
            self.report(remote, format!("{name}: "), after);
        }
    }

    /// Reports a pair that is kept apart by its quality of service.
    fn report_qos(&self, local: GUID, remote: GUID, requested: &QosPolicies, offered: &QosPolicies) {
        let (local, remote) = (local.to_bytes(), remote.to_bytes());
        let Some(endpoint) = self.lock().local.get(&local).cloned() else {
            return;
        };
        let Some(name) = mangle::ros_topic(&endpoint.topic) else {
            return;
        };
        if !self.first_report(local, remote) {
            return;
        }
        let requested = policies::to_profile(requested);
        let offered = policies::to_profile(offered);
        let policy = requested.incompatibility(&offered).unwrap_or("quality of service");
        let (asked, given) = match policy {
            "reliability" => (format!("{:?}", requested.reliability), format!("{:?}", offered.reliability)),
            "durability" => (format!("{:?}", requested.durability), format!("{:?}", offered.durability)),
            "deadline" => (format!("{:?}", requested.deadline), format!("{:?}", offered.deadline)),
            _ => ("more".to_owned(), "less".to_owned()),
        };
        let after = if endpoint.writes {
            format!(" asks for {policy} {asked} but this node offers {given}; it gets no messages")
        } else {
            format!(" offers {policy} {given} but this node asks for {asked}; no messages come from it")
        };
        self.report(remote, format!("{name}: "), after);
    }

    /// A remote endpoint in words.
    fn who(&self, remote: Gid) -> String {
        self.owner(remote).unwrap_or_else(|| {
            let hex: String = remote.iter().map(|byte| format!("{byte:02x}")).collect();
            format!("the endpoint {hex}")
        })
    }
}

/// Follows the events of discovery for ever.
pub(crate) async fn watch(participant: DomainParticipant, view: Arc<GraphView>) {
    let listener = participant.status_listener();
    let mut events = std::pin::pin!(listener.as_async_status_stream());
    while let Some(event) = events.next().await {
        view.take(event);
    }
}

/// Says what is to be said, when the remote node's name has come or is not to be expected any more.
pub(crate) async fn report(view: Arc<GraphView>) {
    while let Ok(report) = view.to_say.recv().await {
        let mut waited = 0;
        while view.owner(report.remote).is_none() && waited < NAME_PERIODS {
            Timer::after(NAME_PERIOD).await;
            waited += 1;
        }
        log::warn!("{}{}{}", report.before, view.who(report.remote), report.after);
    }
}
