"""A peer that is not ours teaches about a world: actions, preferences, a critique, a learner's history, and policies to judge.

Says everything over Eclipse Cyclone DDS, each piece until its receipt comes, takes one back, and waits for the bounds on its
policies at the last revision. Prints one JSON object.
"""

import json
import math
import sys
import time

from cyclonedds.core import Policy, Qos
from cyclonedds.util import duration
from messages import (
    ActionDemonstration,
    CritiqueSegment,
    EvidenceReceipt,
    FeatureTrajectory,
    LearnerHistory,
    PolicyBounds,
    PolicySet,
    PolicyToJudge,
    Posterior,
    Retraction,
    SegmentCritique,
    TabularWorld,
    TrajectoryPreference,
)
from peer import EVENT, RELIABLE, STATE, Peer, wait

# As STATE, to write with.
KEPT = Qos(
    RELIABLE,
    Policy.Durability.TransientLocal,
    Policy.History.KeepLast(1),
    Policy.DataRepresentation(use_cdrv0_representation=True),
)

N = 5
LEFT, RIGHT = 0, 1
TABULAR, ROLLOUTS = 1, 2


def row():
    """States in a row, a feature for each; left and right lead to the neighbour."""
    moves = [(s, a, min(max(s + 2 * a - 1, 0), N - 1)) for s in range(N) for a in (LEFT, RIGHT)]
    return TabularWorld(
        id="row",
        gamma=0.9,
        n_states=N,
        n_actions=2,
        feature_names=[f"at {s}" for s in range(N)],
        action_names=["left", "right"],
        initial=[1.0 if s == N // 2 else 0.0 for s in range(N)],
        from_state=[s for s, _, _ in moves],
        action=[a for _, a, _ in moves],
        to_state=[to for _, _, to in moves],
        probability=[1.0] * len(moves),
        features=[1.0 if i // N == i % N else 0.0 for i in range(N * N)],
        shape=[1, N],
    )


def at(state):
    """A trajectory that visits one state."""
    return FeatureTrajectory(id=f"at {state}", features=[1.0 if s == state else 0.0 for s in range(N)])


def policies():
    """Both ways, and what somebody collected on the way to the right."""
    walk = [FeatureTrajectory(id=f"run {i}", features=[0.0, 0.1 * i, 1.0, 0.9, 7.0]) for i in range(3)]
    return PolicySet(
        id="three ways",
        number=1,
        world_id="row",
        policies=[
            PolicyToJudge(id="left", form=TABULAR, actions=[LEFT] * N),
            PolicyToJudge(id="right", form=TABULAR, action_probabilities=[0.0, 1.0] * N),
            PolicyToJudge(id="runs", form=ROLLOUTS, rollouts=walk),
        ],
    )


def main():
    peer = Peer(int(sys.argv[1]))
    receipts = peer.reader("receipt", EvidenceReceipt, EVENT)
    posteriors = peer.reader("posterior", Posterior, STATE)
    bounds = peer.reader("policy_bounds", PolicyBounds, STATE)
    # A writer takes what it keeps for late joiners with it.
    world_writer = peer.writer("world", TabularWorld, KEPT)
    world_writer.write(row())
    policies_writer = peer.writer("policies", PolicySet, KEPT)
    policies_writer.write(policies())
    wait("the prior", posteriors, lambda p: p.revision == 0)
    source = "cyclonedds"
    acts = {"source": source, "world_id": "row"}
    critique = SegmentCritique(id="c", states=[2, 1], actions=[LEFT, LEFT], segments=[CritiqueSegment(0, 2, 1)], **acts)
    said = [
        ("action_demonstration", ActionDemonstration(id="a", states=[2, 3], actions=[RIGHT, RIGHT], **acts)),
        ("preference", TrajectoryPreference(id="p", source=source, trajectories=[at(0), at(2), at(4)])),
        ("preference", TrajectoryPreference(id="wrong", source=source, trajectories=[at(3), at(1)])),
        ("critique", critique),
        ("learner_history", LearnerHistory(id="h", source=source, demonstrations=[at(0), at(3)])),
        ("retraction", Retraction(id="undo", evidence_id="wrong", source=source)),
    ]
    told = []
    writers = {}
    for topic, message in said:
        key = (topic, type(message))
        writers[key] = writers.get(key) or peer.writer(topic, type(message), EVENT)
        again = lambda writer=writers[key], message=message: writer.write(message)
        receipt = wait(f"the receipt of {message.id}", receipts, lambda r, m=message: r.id == m.id, again)
        told.append({"id": receipt.id, "outcome": receipt.outcome, "revision": receipt.revision})
    last = told[-1]["revision"]
    posterior = wait("the last posterior", posteriors, lambda p: p.revision == last)
    judged = wait("the last bounds on policies", bounds, lambda b: b.revision == last)
    plain = lambda x: x if math.isfinite(x) else None
    answer = {
        "receipts": told,
        "revision": last,
        "evidence_hash": posterior.evidence_hash,
        "world_hash": posterior.world.hash,
        "n": {of.kind: of.n for of in posterior.rationalities},
        "reason": judged.reason,
        "policies": [
            {"id": p.id, "rank": p.rank, "return": plain(p.return_bound.bound), "loss": plain(p.loss_bound.bound)}
            for p in judged.policies
        ],
    }
    # The recorder finds topics in its own time: the two nodes and it make three readers of the world, and two of the policies.
    end = time.monotonic() + 30.0
    while time.monotonic() < end:
        heard = [len(writer.get_matched_subscriptions()) for writer in (world_writer, policies_writer)]
        if heard[0] >= 3 and heard[1] >= 2:
            break
        time.sleep(0.02)
    # Who is matched here may not have matched us yet; so what is known is said again, as state is.
    for _ in range(5):
        time.sleep(0.2)
        world_writer.write(row())
        policies_writer.write(policies())
    for writer in (world_writer, policies_writer):
        writer.wait_for_acks(duration(seconds=10))
    print(json.dumps(answer))


if __name__ == "__main__":
    main()
