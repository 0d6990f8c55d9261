"""OMPL's RRT-Connect with Pinocchio's and Coal's collision checks on transfers of an arm: motions, times, and a verdict on ours.

Reads a request as JSON from standard input: the robot as arm_pinocchio.py takes it, {"planned": [JOINT], "lower", "upper", "rest": [q of "joints"],
"tool": FRAME, "held_against": [LINK], "margin": metres, "step": radians between checked states, "fine": the same for verdicts, "seconds", "seed",
"configurations": [{"range": radians or null for OMPL's own, "simplifications"}], "transfers": [{"objects", "held", "start", "goal"}], "ours": [[[q] or null]] (of each of our runs, for each transfer)}.
"""

import json
import math
import os
import sys
import time
from importlib.metadata import version

try:
    import numpy as np
    import ompl.base as ob
    import ompl.geometric as og
    import ompl.util as ou
    import pinocchio as pin
    from arm_pinocchio import add_objects, placement, robot_geometry, shape, solids_of_links
except ImportError as error:
    sys.exit(f"{error}: run tests/peers/setup again, or set APPRENTICE_PEERS_PYTHON")

# States of a search that are given back, for the other side to judge them too.
N_SAMPLED = 20


class Checker:
    """Whether an arm touches nothing; the answer comes from C++, from one call."""

    def __init__(self, model, geometry, n_own, margin, rest, planned):
        self.model, self.data, self.geometry = model, model.createData(), geometry
        self.placed = pin.GeometryData(geometry)
        # The robot's own links, built close together, count when they touch: so it is on our side.
        for request in list(self.placed.collisionRequests)[n_own:]:
            request.security_margin = margin
        self.tree = pin.BroadPhaseManager_DynamicAABBTreeCollisionManager(model, geometry, self.placed)
        self.q, self.planned = rest.copy(), planned

    def is_free(self, values):
        self.q[self.planned] = values
        return not pin.computeCollisions(self.model, self.data, self.tree, self.q, True)


def with_things(model, robot, request, transfer):
    """The robot's solids among the things of a transfer, one of them in its hand."""
    geometry = robot.copy()
    of_link = solids_of_links(model, geometry)
    tool = model.frames[model.getFrameId(request["tool"])]
    held = transfer["held"]
    in_hand = pin.GeometryObject("held", tool.parentJoint, tool.placement * placement(held), shape(held))
    held = geometry.addGeometryObject(in_hand)
    for link in request["held_against"]:
        for i in of_link[link]:
            geometry.addCollisionPair(pin.CollisionPair(i, held))
    add_objects(geometry, transfer["objects"], [i for link in request["moving"] for i in of_link[link]] + [held])
    return geometry


def new_setup(request, is_free):
    """A problem without ends, its states checked by a function of OMPL's state."""
    n = len(request["lower"])
    space = ob.RealVectorStateSpace(n)
    bounds = ob.RealVectorBounds(n)
    for i, (low, high) in enumerate(zip(request["lower"], request["upper"])):
        bounds.setLow(i, low)
        bounds.setHigh(i, high)
    space.setBounds(bounds)
    setup = og.SimpleSetup(space)
    setup.setStateValidityChecker(is_free)
    setup.getSpaceInformation().setStateValidityCheckingResolution(request["step"] / space.getMaximumExtent())
    return setup


def attempt(request, transfer, checker, configuration):
    """One search and its simplification."""
    n = len(request["lower"])
    visited = []

    def is_free(state):
        values = state[0:n]
        visited.append(values)
        return checker.is_free(values)

    setup = new_setup(request, is_free)
    space = setup.getStateSpace()
    ends = [space.allocState(), space.allocState()]
    for state, values in zip(ends, (transfer["start"], transfer["goal"])):
        for i, value in enumerate(values):
            state[i] = value
    setup.setStartAndGoalStates(*ends)
    planner = og.RRTConnect(setup.getSpaceInformation())
    if configuration["range"] is not None:
        planner.setRange(configuration["range"])
    setup.setPlanner(planner)
    start = time.process_time()
    setup.solve(request["seconds"])
    middle = time.process_time()
    solved, n_search = setup.haveExactSolutionPath(), len(visited)
    corners = []
    for _ in range(configuration["simplifications"] if solved else 0):
        setup.simplifySolution()
    end = time.process_time()
    if solved:
        path = setup.getSolutionPath()
        corners = [path.getState(i)[0:n] for i in range(path.getStateCount())]
    # The same calls once more, all at once: a clock at each of them would slow the search itself down.
    replayed = list(visited)
    visited.clear()
    replay = time.process_time()
    for values in replayed:
        is_free(values)
    callback = time.process_time() - replay
    return {
        "solved": solved,
        "search_s": middle - start,
        "simplify_s": end - middle,
        "callback_s": callback,
        "checks": len(replayed),
        "search_checks": n_search,
        "corners": corners,
    }, replayed


def judged(corners, fine, checker, bare):
    """How many of the states along a path touch something, and how many come nearer than the margin."""
    states = [np.array(corners[0])]
    for a, b in zip(corners, corners[1:]):
        a, b = np.array(a), np.array(b)
        n = max(1, math.ceil(np.linalg.norm(b - a) / fine))
        states.extend(a + (b - a) * (k / n) for k in range(1, n + 1))
    touching = sum(not bare.is_free(q) for q in states)
    near = sum(not checker.is_free(q) for q in states)
    return {"touching": touching, "near": near}


def alone(checker, states):
    """CPU microseconds of Pinocchio's call by itself."""
    configurations = []
    for values in states:
        checker.is_free(values)
        configurations.append(checker.q.copy())
    start = time.process_time()
    for _ in range(5):
        for q in configurations:
            pin.computeCollisions(checker.model, checker.data, checker.tree, q, True)
    return 1e6 * (time.process_time() - start) / (5 * len(configurations))


def dispatch(request):
    """CPU microseconds of asking Python about a state when the answer costs nothing."""
    n, asked = len(request["lower"]), 0

    def anything(state):
        nonlocal asked
        asked += 1
        return bool(state[0:n])

    setup = new_setup(request, anything)
    space, information = setup.getStateSpace(), setup.getSpaceInformation()
    information.setup()
    ends = [space.allocState(), space.allocState()]
    for state, values in zip(ends, (request["lower"], request["upper"])):
        for i, value in enumerate(values):
            state[i] = value
    start = time.process_time()
    for _ in range(100):
        information.checkMotion(*ends)
    return 1e6 * (time.process_time() - start) / asked


def main():
    request = json.load(sys.stdin)
    ou.setLogLevel(ou.LOG_ERROR)
    ou.RNG.setSeed(request["seed"])
    model = pin.buildModelFromUrdf(request["urdf"])
    robot = robot_geometry(model, request, True)
    index = {name: model.joints[model.getJointId(name)].idx_q for name in request["joints"]}
    rest = pin.neutral(model)
    for name, value in zip(request["joints"], request["rest"]):
        rest[index[name]] = value
    planned = [index[name] for name in request["planned"]]
    answer = {
        "versions": {name: version(name) for name in ("ompl", "pin", "coal")},
        "ends_free": [],
        "dispatch_us": dispatch(request),
        "runs": [[] for _ in request["configurations"]],
        "ours": [[] for _ in request["ours"]],
        "sampled": [],
        "check_us": [],
    }
    for n, transfer in enumerate(request["transfers"]):
        geometry = with_things(model, robot, request, transfer)
        checker, bare = (
            Checker(model, geometry, len(robot.collisionPairs), margin, rest, planned)
            for margin in (request["margin"], 0.0)
        )
        answer["ends_free"].append([checker.is_free(transfer[end]) for end in ("start", "goal")])
        for run, configuration in zip(answer["runs"], request["configurations"]):
            done, visited = attempt(request, transfer, checker, configuration)
            done["judged"] = judged(done["corners"], request["fine"], checker, bare) if done["solved"] else None
            run.append(done)
        sampled = visited[:: max(1, len(visited) // N_SAMPLED)][:N_SAMPLED]
        answer["check_us"].append(alone(checker, sampled))
        answer["sampled"].extend({"transfer": n, "q": q, "free": checker.is_free(q)} for q in sampled)
        for verdicts, paths in zip(answer["ours"], request["ours"]):
            verdicts.append(judged(paths[n], request["fine"], checker, bare) if paths[n] else None)
        print(f"\rOMPL: {n + 1} of {len(request['transfers'])}", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    json.dump(answer, sys.stdout)
    sys.stdout.flush()
    # OMPL's binding tells about objects that it lost track of, when Python ends in the ordinary way.
    os._exit(0)


if __name__ == "__main__":
    main()
