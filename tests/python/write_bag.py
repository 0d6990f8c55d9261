"""Writes a bag with the PyPI package `rosbags` and prints, as one line of JSON, what is in it.

Two topics of standard types, one of them latched, and one of a type that only this bag knows. The JSON lists every message:
topic, log time in ns, and its CDR bytes in hexadecimal.
"""

import argparse
import json
from pathlib import Path

from rosbags.interfaces import Qos, QosDurability, QosHistory, QosLiveliness, QosReliability, QosTime
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

START_NS = 1_700_000_000_000_000_000
SHELF = "std_msgs/Header header\nstring[] items\nfloat64 height\n"


def qos(durability, depth):
    forever = QosTime(9223372036, 854775807)
    return Qos(
        QosHistory.KEEP_LAST,
        depth,
        QosReliability.RELIABLE,
        durability,
        forever,
        forever,
        QosLiveliness.AUTOMATIC,
        forever,
        False,
    )


def messages(store, count):
    """(topic, time after the start in ns, type, message)"""
    string = store.types["std_msgs/msg/String"]
    vector = store.types["geometry_msgs/msg/Vector3"]
    shelf = store.types["shop_msgs/msg/Shelf"]
    header = store.types["std_msgs/msg/Header"]
    stamp = store.types["builtin_interfaces/msg/Time"]
    yield "/robot_name", 0, string(data="rosa")
    for i in range(count):
        after = (i + 1) * 20_000_000
        yield "/velocity", after, vector(x=float(i), y=-float(i), z=0.5)
        if i % 5 == 0:
            at = header(stamp=stamp(sec=i, nanosec=7), frame_id="shop")
            yield "/shop/shelf", after + 1, shelf(header=at, items=["vase", f"plate {i}"], height=1.25)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bag", type=Path, help="the bag's folder, which must not exist")
    parser.add_argument("--messages", type=int, default=50, help="messages on /velocity, 20 ms apart")
    parser.add_argument("--version", type=int, default=8, choices=[8, 9], help="version of metadata.yaml")
    parser.add_argument("--zstd", action="store_true", help="compress the chunks with zstd")
    arguments = parser.parse_args()

    store = get_typestore(Stores.ROS2_HUMBLE)
    store.register(get_types_from_msg(SHELF, "shop_msgs/msg/Shelf"))
    offered = {
        "/robot_name": [qos(QosDurability.TRANSIENT_LOCAL, 1)],
        "/velocity": [qos(QosDurability.VOLATILE, 10)],
        "/shop/shelf": [],
    }
    written = []
    writer = Writer(arguments.bag, version=arguments.version, storage_plugin=StoragePlugin.MCAP)
    if arguments.zstd:
        writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
    with writer:
        connections = {}
        for topic, after, message in messages(store, arguments.messages):
            kind = message.__msgtype__
            if topic not in connections:
                connections[topic] = writer.add_connection(
                    topic, kind, typestore=store, offered_qos_profiles=offered[topic]
                )
            data = bytes(store.serialize_cdr(message, kind))
            writer.write(connections[topic], START_NS + after, data)
            written.append({"topic": topic, "type": kind, "log_time": START_NS + after, "cdr": data.hex()})
    print(json.dumps({"bag": str(arguments.bag), "messages": written}))


if __name__ == "__main__":
    main()
