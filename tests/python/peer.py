"""A peer that is not ours: teaches over Eclipse Cyclone DDS, and comes late a second time.

Publishes a demonstration on the first question's table, waits for its receipt, posterior and bounds; then a second
participant joins and must get the newest posterior and bounds although nothing is said again. Prints one JSON object.
"""

import array
import hashlib
import json
import math
import sys
import time

from cyclonedds.core import Policy, Qos
from cyclonedds.domain import DomainParticipant
from cyclonedds.pub import DataWriter, Publisher
from cyclonedds.sub import DataReader, Subscriber
from cyclonedds.topic import Topic
from cyclonedds.util import duration

from messages import (
    EvidenceReceipt,
    Header,
    PerformanceBounds,
    PlacementDemonstration,
    PlacementQuery,
    Point,
    Posterior,
    Time,
)

PATIENCE_S = 40.0
RELIABLE = Policy.Reliability.Reliable(max_blocking_time=duration(seconds=1))
EVENT = Qos(
    RELIABLE,
    Policy.Durability.Volatile,
    Policy.History.KeepLast(100),
    # ROS 2 and RustDDS speak XCDR version 1.
    Policy.DataRepresentation(use_cdrv0_representation=True),
)
STATE = Qos(RELIABLE, Policy.Durability.TransientLocal, Policy.History.KeepLast(1))


class Peer:
    """One participant with readers on the lesson's topics."""

    def __init__(self, domain):
        self.participant = DomainParticipant(domain)
        self.subscriber = Subscriber(self.participant)
        self.publisher = Publisher(self.participant)

    def topic(self, name, of):
        return Topic(self.participant, f"rt/apprentice/{name}", of)

    def reader(self, name, of, qos):
        return DataReader(self.subscriber, self.topic(name, of), qos=qos)

    def writer(self, name, of, qos):
        return DataWriter(self.publisher, self.topic(name, of), qos=qos)


def wait(what, reader, wanted, again=lambda: None):
    """The first sample for which `wanted` is true; `again` is called twice a second meanwhile."""
    end = time.monotonic() + PATIENCE_S
    due = 0.0
    while time.monotonic() < end:
        for sample in reader.take(N=100):
            # A sample without data tells of a writer that went.
            if hasattr(sample, "header") and wanted(sample):
                return sample
        if time.monotonic() >= due:
            again()
            due = time.monotonic() + 0.5
        time.sleep(0.01)
    sys.exit(f"waited {PATIENCE_S} s in vain for {what}")


def radius(thing):
    """Of the circle around the footprint."""
    return thing.size_m.x / 2 if thing.shape == 0 else math.hypot(thing.size_m.x, thing.size_m.y) / 2


def free_spot(scene):
    """The spot nearest to the middle, on a grid, where the target touches nothing."""
    own = radius(scene.target)
    middle = (scene.width_m / 2, scene.depth_m / 2)
    spots = [(scene.width_m * i / 40, scene.depth_m * j / 40) for i in range(4, 37) for j in range(4, 37)]
    for x, y in sorted(spots, key=lambda spot: math.dist(spot, middle)):
        things = [(thing, (thing.pose.position.x, thing.pose.position.y)) for thing in scene.objects]
        if all(math.dist((x, y), at) > own + radius(thing) + 0.02 for thing, at in things):
            return Point(x, y, 0.0)
    sys.exit("the table is full")


def plain(posterior, bounds):
    """What the test compares with the bag."""
    return {
        "posterior_revision": posterior.revision,
        "evidence_hash": posterior.evidence_hash,
        "draws_sha256": hashlib.sha256(array.array("f", posterior.draws).tobytes()).hexdigest(),
        "bounds_revision": bounds.revision,
        "bounds_outcome": bounds.outcome,
        "bound_m": None if math.isnan(bounds.bound_m) else bounds.bound_m,
        "n_bounds": len(bounds.bounds),
        "reason": bounds.reason,
    }


def main():
    domain = int(sys.argv[1])
    peer = Peer(domain)
    readers = {
        "query": peer.reader("query", PlacementQuery, STATE),
        "receipt": peer.reader("receipt", EvidenceReceipt, EVENT),
        "posterior": peer.reader("posterior", Posterior, STATE),
        "bounds": peer.reader("bounds", PerformanceBounds, STATE),
    }
    writer = peer.writer("demonstration", PlacementDemonstration, EVENT)
    query = wait("a question", readers["query"], lambda query: query.id)
    shown = PlacementDemonstration(
        header=Header(Time(1_000_000_000, 0), query.scene.header.frame_id),
        id="peer-1",
        query_id=query.id,
        source="cyclonedds",
        scene=query.scene,
        placement=free_spot(query.scene),
    )
    receipt = wait("the receipt", readers["receipt"], lambda r: r.id == shown.id, lambda: writer.write(shown))
    posterior = wait("the posterior", readers["posterior"], lambda p: p.revision == receipt.revision)
    bounds = wait("the bounds", readers["bounds"], lambda b: b.revision == receipt.revision)

    late = Peer(domain)
    late_posterior = late.reader("posterior", Posterior, STATE)
    late_bounds = late.reader("bounds", PerformanceBounds, STATE)
    told = plain(
        wait("the posterior, as a late joiner", late_posterior, lambda p: p.revision == receipt.revision),
        wait("the bounds, as a late joiner", late_bounds, lambda b: b.revision == receipt.revision),
    )
    answer = {"receipt_outcome": receipt.outcome, "receipt_reason": receipt.reason, "revision": receipt.revision}
    print(json.dumps({**answer, "first": plain(posterior, bounds), "late": told}))


if __name__ == "__main__":
    main()
