//! One DDS participant for one node, with the thread that serves its readers.

use std::{
    collections::BTreeMap,
    net::{IpAddr, Ipv4Addr},
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{Arc, Mutex, PoisonError, Weak},
    thread::JoinHandle,
    time::Duration,
};

use ros2_client::dds::rustdds::{
    CDRDeserializerAdapter, CDRSerializerAdapter, DomainParticipant, DomainParticipantBuilder, Publisher, QosPolicies,
    RTPSEntity, Subscriber, Topic, TopicKind, no_key,
};
use smol::{Executor, channel};

use crate::{
    dds::{
        client::DdsCaller,
        discovery::{self, Gid, GraphView, LocalEndpoint},
        environment::{Environment, Range, ServiceMapping},
        mangle,
        node_info::{self, NodeInfo, ParticipantInfo},
        policies, reader, service,
        writer::DdsSink,
    },
    error::BusError,
    logging,
    names::NodeName,
    qos::{Durability, QosProfile, Reliability},
    stop::Stopper,
    transport::{Answered, Caller, Deliver, EndpointInfo, Guard, Handler, Sink, TopicInfo, Transport, weakest},
};

/// Writes what nodes this participant holds.
type InfoWriter = no_key::DataWriter<ParticipantInfo, CDRSerializerAdapter<ParticipantInfo>>;

/// What endpoints share.
pub(crate) struct Shared {
    pub(crate) participant: DomainParticipant,
    pub(crate) publisher: Publisher,
    pub(crate) subscriber: Subscriber,
    pub(crate) view: Arc<GraphView>,
    pub(crate) mapping: ServiceMapping,
    node: NodeName,
    info: InfoWriter,
}

/// The graph over DDS as one node sees it.
pub(crate) struct DdsTransport {
    shared: Arc<Shared>,
    executor: Arc<Executor<'static>>,
    sinks: Mutex<Vec<Weak<DdsSink>>>,
    stop: channel::Sender<()>,
    thread: Option<JoinHandle<()>>,
}

/// An error of RustDDS in the bus's words.
pub(crate) fn refused(what: impl Into<String>) -> impl FnOnce(&dyn std::fmt::Display) -> BusError {
    let what = what.into();
    move |reason| BusError::Dds { what, reason: reason.to_string() }
}

impl DdsTransport {
    /// Joins the DDS domain.
    ///
    /// # Errors
    /// When there are no sockets to be had, or the name is refused.
    pub(crate) fn join(
        environment: &Environment,
        name: &NodeName,
        log_id: u64,
        stopper: &Stopper,
    ) -> Result<DdsTransport, BusError> {
        let what = format!("join the DDS domain {}", environment.domain);
        let mut builder = DomainParticipantBuilder::new(environment.domain);
        if environment.range != Range::Subnet {
            builder = builder.with_only_networks([IpAddr::V4(Ipv4Addr::LOCALHOST)]);
        }
        let participant = builder.build().map_err(|error| refused(&what)(&error))?;
        let none = QosPolicies::qos_none();
        let publisher = participant.create_publisher(&none).map_err(|error| refused(&what)(&error))?;
        let subscriber = participant.create_subscriber(&none).map_err(|error| refused(&what)(&error))?;
        let info_qos = policies::for_writer(&QosProfile::new(Reliability::Reliable, Durability::TransientLocal, 1));
        let info_topic = participant
            .create_topic(node_info::TOPIC.to_owned(), node_info::TYPE.to_owned(), &info_qos, TopicKind::NoKey)
            .map_err(|error| refused(&what)(&error))?;
        let info =
            publisher.create_datawriter_no_key(&info_topic, Some(info_qos)).map_err(|error| refused(&what)(&error))?;
        let view = Arc::new(GraphView::new());
        let shared = Arc::new(Shared {
            participant,
            publisher,
            subscriber,
            view,
            mapping: environment.mapping,
            node: name.clone(),
            info,
        });
        let executor = Arc::new(Executor::new());
        executor.spawn(discovery::watch(shared.participant.clone(), Arc::clone(&shared.view))).detach();
        executor.spawn(discovery::report(Arc::clone(&shared.view))).detach();
        executor.spawn(follow_nodes(&shared, &info_topic).map_err(|error| refused(&what)(&error))?).detach();
        let (stop, stopped) = channel::bounded(1);
        let running = Arc::clone(&executor);
        let stopper = stopper.clone();
        let thread = std::thread::Builder::new()
            .name("readers".to_owned())
            .spawn(move || {
                logging::enter(log_id);
                let work = AssertUnwindSafe(|| {
                    // Either way of ending means that the transport is gone.
                    let _ = smol::block_on(running.run(stopped.recv()));
                });
                if catch_unwind(work).is_err() {
                    log::error!("the thread that reads from the graph has failed; this node ends");
                    stopper.stop();
                }
            })
            .map_err(|source| BusError::System { what: "a thread", source })?;
        shared.announce();
        Ok(DdsTransport { shared, executor, sinks: Mutex::new(Vec::new()), stop, thread: Some(thread) })
    }
}

/// Reads which nodes the other participants hold.
fn follow_nodes(
    shared: &Arc<Shared>,
    topic: &Topic,
) -> Result<impl Future<Output = ()> + Send + use<>, ros2_client::dds::rustdds::dds::CreateError> {
    use futures::StreamExt;
    let qos = policies::for_reader(&QosProfile::new(Reliability::Reliable, Durability::TransientLocal, 0));
    let reader = shared
        .subscriber
        .create_simple_datareader_no_key::<ParticipantInfo, CDRDeserializerAdapter<_>>(topic, Some(qos))?;
    let view = Arc::clone(&shared.view);
    Ok(async move {
        let mut infos = std::pin::pin!(reader.as_async_stream());
        while let Some(info) = infos.next().await {
            if let Ok(info) = info {
                view.learn(info.into_value());
            }
        }
    })
}

impl Shared {
    /// Adds an endpoint of this node and tells the graph.
    pub(crate) fn add(&self, gid: Gid, endpoint: LocalEndpoint) {
        self.view.add_local(gid, endpoint);
        self.announce();
    }

    /// Forgets an endpoint of this node and tells the graph.
    pub(crate) fn remove(&self, gid: Gid) {
        self.view.remove_local(gid);
        self.announce();
    }

    /// Tells the graph which endpoints the node has, so that `ros2 node info` shows them.
    fn announce(&self) {
        let (writers, readers): (Vec<_>, Vec<_>) =
            self.view.local().into_iter().partition(|(_, endpoint)| endpoint.writes);
        let gids = |endpoints: Vec<(Gid, LocalEndpoint)>| endpoints.into_iter().map(|(gid, _)| gid).collect();
        let info = ParticipantInfo {
            gid: self.participant.guid().to_bytes(),
            nodes: vec![NodeInfo {
                namespace: self.node.namespace.clone(),
                name: self.node.name.clone(),
                readers: gids(readers),
                writers: gids(writers),
            }],
        };
        if let Err(error) = self.info.write(info, None) {
            log::debug!("the node's endpoints were not announced: {error}");
        }
    }

    /// The topic of an endpoint.
    pub(crate) fn topic(&self, dds_name: &str, dds_type: &str, qos: &QosPolicies) -> Result<Topic, BusError> {
        self.participant
            .create_topic(dds_name.to_owned(), dds_type.to_owned(), qos, TopicKind::NoKey)
            .map_err(|error| refused(format!("make the topic {dds_name}"))(&error))
    }

    /// The DDS type name of a remote writer, if it is known.
    pub(crate) fn writer_type(&self, gid: Gid) -> Option<String> {
        self.participant
            .discovered_writers()
            .into_iter()
            .find(|writer| writer.publication_topic_data.key.to_bytes() == gid)
            .map(|writer| writer.publication_topic_data.type_name)
    }
}

impl Transport for DdsTransport {
    fn publisher(&self, topic: &str, type_name: &str, qos: &QosProfile) -> Result<Arc<dyn Sink>, BusError> {
        let dds_type = mangle::type_name(type_name)?;
        let sink = Arc::new(DdsSink::new(&self.shared, topic, &dds_type, qos)?);
        for reader in self.shared.participant.discovered_readers() {
            let data = &reader.subscription_topic_data;
            self.shared.view.check_type(data.key().to_bytes(), data.topic_name(), data.type_name(), false);
        }
        let mut sinks = self.sinks.lock().unwrap_or_else(PoisonError::into_inner);
        sinks.retain(|sink| sink.strong_count() > 0);
        sinks.push(Arc::downgrade(&sink));
        Ok(sink)
    }

    fn subscribe(&self, topic: &str, type_name: &str, qos: &QosProfile, deliver: Deliver) -> Result<Guard, BusError> {
        let dds_type = mangle::type_name(type_name)?;
        let guard = reader::subscribe(&self.shared, &self.executor, topic, &dds_type, qos, deliver)?;
        for writer in self.shared.participant.discovered_writers() {
            let data = &writer.publication_topic_data;
            self.shared.view.check_type(data.key.to_bytes(), &data.topic_name, &data.type_name, true);
        }
        Ok(guard)
    }

    fn serve(&self, name: &str, type_name: &str, handler: Handler) -> Result<Guard, BusError> {
        service::serve(&self.shared, &self.executor, name, type_name, handler)
    }

    fn client(&self, name: &str, type_name: &str, answered: Answered) -> Result<Arc<dyn Caller>, BusError> {
        Ok(Arc::new(DdsCaller::new(&self.shared, &self.executor, name, type_name, answered)?))
    }

    fn topics(&self) -> Vec<TopicInfo> {
        let mut topics = BTreeMap::new();
        let own_node = Some(self.shared.node.full());
        for (gid, local) in self.shared.view.local() {
            let info = EndpointInfo { node: own_node.clone(), gid, qos: local.qos };
            add_endpoint(&mut topics, &local.topic, &local.type_name, info, local.writes);
        }
        let own = self.shared.participant.guid().to_bytes();
        let is_own = |gid: &Gid| gid[..12] == own[..12];
        for writer in self.shared.participant.discovered_writers() {
            let data = &writer.publication_topic_data;
            let gid = data.key.to_bytes();
            if !is_own(&gid) {
                let info =
                    EndpointInfo { node: self.shared.view.owner(gid), gid, qos: policies::to_profile(&data.qos()) };
                add_endpoint(&mut topics, &data.topic_name, &data.type_name, info, true);
            }
        }
        for reader in self.shared.participant.discovered_readers() {
            let data = &reader.subscription_topic_data;
            let gid = data.key().to_bytes();
            if !is_own(&gid) {
                let info =
                    EndpointInfo { node: self.shared.view.owner(gid), gid, qos: policies::to_profile(&data.qos()) };
                add_endpoint(&mut topics, data.topic_name(), data.type_name(), info, false);
            }
        }
        let mut topics: Vec<TopicInfo> = topics.into_values().collect();
        for topic in &mut topics {
            if let Some(qos) = weakest(&topic.publishers) {
                topic.qos = qos;
            }
        }
        topics
    }

    fn flush(&self, limit: Duration) {
        let sinks: Vec<_> =
            self.sinks.lock().unwrap_or_else(PoisonError::into_inner).iter().filter_map(Weak::upgrade).collect();
        let mut left = limit;
        for sink in sinks {
            left = sink.wait_for_acknowledgments(left);
        }
    }
}

/// Adds one endpoint to the list of topics, if it is one of ROS.
fn add_endpoint(
    topics: &mut BTreeMap<(String, String), TopicInfo>,
    dds_topic: &str,
    dds_type: &str,
    info: EndpointInfo,
    writes: bool,
) {
    let Some(name) = mangle::ros_topic(dds_topic) else {
        return;
    };
    let type_name = mangle::ros_type(dds_type);
    let topic = topics.entry((name.to_owned(), type_name.clone())).or_insert_with(|| TopicInfo {
        name: name.to_owned(),
        type_name,
        qos: info.qos.clone(),
        publishers: Vec::new(),
        subscriptions: Vec::new(),
    });
    if writes {
        topic.publishers.push(info);
    } else {
        topic.subscriptions.push(info);
    }
}

impl Drop for DdsTransport {
    fn drop(&mut self) {
        // A full channel means that the thread has been told already.
        let _ = self.stop.try_send(());
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}
