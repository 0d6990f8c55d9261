"""Reads a bag with three libraries that are not ours and prints, as one line of JSON, what each of them found.

For every reader: the number of messages, and per topic its type, count, how many messages were decoded into fields, and
a SHA-256 over log time (8 bytes, little endian) and bytes of all messages in order. Equal digests mean equal bytes.
"""

import argparse
import hashlib
import json
from pathlib import Path

from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore


class Tally:
    """Counts and digests messages by topic."""

    def __init__(self):
        self.topics = {}

    def topic(self, name, kind):
        empty = {"type": kind, "count": 0, "decoded": 0, "digest": hashlib.sha256()}
        return self.topics.setdefault(name, empty)

    def add(self, name, kind, log_time, data, decoded):
        topic = self.topic(name, kind)
        topic["count"] += 1
        topic["decoded"] += decoded
        topic["digest"].update(log_time.to_bytes(8, "little"))
        topic["digest"].update(data)

    def report(self):
        topics = {name: topic | {"digest": topic["digest"].hexdigest()} for name, topic in sorted(self.topics.items())}
        return {"message_count": sum(topic["count"] for topic in topics.values()), "topics": topics}


def type_store(connections):
    """Types of the bag's own schemas, on top of the standard ones."""
    store = get_typestore(Stores.EMPTY)
    types = {}
    for connection in connections:
        if connection.msgdef.data:
            types.update(get_types_from_msg(connection.msgdef.data, connection.msgtype))
    store.register(types)
    return store


def read_with_rosbags(folder):
    tally = Tally()
    with Reader(folder) as reader:
        store = type_store(reader.connections)
        for connection in reader.connections:
            tally.topic(connection.topic, connection.msgtype)
        for connection, log_time, data in reader.messages():
            known = connection.msgtype in store.fielddefs
            if known:
                store.deserialize_cdr(data, connection.msgtype)
            tally.add(connection.topic, connection.msgtype, log_time, bytes(data), known)
        qos = {c.topic: len(c.ext.offered_qos_profiles) for c in reader.connections}
        metadata = {"start": reader.start_time, "duration": reader.duration, "message_count": reader.message_count}
    return tally.report() | {"metadata": metadata, "qos_profiles": qos}


def read_with_mcap(files, decode):
    """Through the summary and the indexes; with `decode`, also into fields by mcap-ros2-support."""
    tally = Tally()
    attachments, records, channels = [], {}, 0
    for path in files:
        with path.open("rb") as stream:
            reader = make_reader(stream, validate_crcs=True)
            summary = reader.get_summary()
            channels += len(summary.channels)
            assert reader.get_header().profile == "ros2", "the profile is not ros2"
            assert summary.statistics.chunk_count == len(summary.chunk_indexes), "chunks without an index"
            factory = DecoderFactory()
            for channel in summary.channels.values():
                tally.topic(channel.topic, summary.schemas[channel.schema_id].name)
            for schema, channel, message in reader.iter_messages():
                decoder = factory.decoder_for(channel.message_encoding, schema) if decode and schema.data else None
                if decoder:
                    decoder(message.data)
                tally.add(channel.topic, schema.name, message.log_time, message.data, decoder is not None)
            attachments += [{"name": a.name, "bytes": len(a.data)} for a in reader.iter_attachments()]
            records |= {record.name: record.metadata for record in reader.iter_metadata()}
    return tally.report() | {"channels": channels, "attachments": attachments, "records": records}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bag", type=Path, help="the bag's folder")
    bag = parser.parse_args().bag
    # Split files are numbered: NAME_0.mcap … NAME_10.mcap.
    files = sorted(bag.glob("*.mcap"), key=lambda path: (len(path.name), path.name))
    report = {
        "rosbags": read_with_rosbags(bag),
        "mcap": read_with_mcap(files, decode=False),
        "mcap_ros2": read_with_mcap(files, decode=True),
    }
    print(json.dumps(report, sort_keys=True))


if __name__ == "__main__":
    main()
