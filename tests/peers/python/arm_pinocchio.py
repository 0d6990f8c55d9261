"""Pinocchio and Coal on the arm's benchmark: CPU microseconds per configuration, and what they found.

Reads a request as JSON from standard input: {"urdf", "package_dirs", "joints": [NAME], "configurations": [[q]], "pairs": [[LINK, LINK]],
"objects": [{"shape": "box" | "cylinder" | "ball", "size": [..], "at": [x, y, z], "yaw"}], "moving": [LINK], "seconds"}.
"""

import json
import sys
import time

import coal
import numpy as np
import pinocchio as pin


def timed(work, inputs, seconds):
    """CPU microseconds of one call over all inputs: the best of rounds of about a tenth of the budget."""
    for each in inputs:
        work(each)
    best, spent = float("inf"), 0.0
    while spent < seconds:
        rounds, start = 0, time.process_time()
        while time.process_time() - start < seconds / 10:
            for each in inputs:
                work(each)
            rounds += 1
        took = time.process_time() - start
        best, spent = min(best, took / (rounds * len(inputs))), spent + took
    return 1e6 * best


def shape(thing):
    size = thing["size"]
    if thing["shape"] == "box":
        return coal.Box(*size)
    if thing["shape"] == "cylinder":
        return coal.Cylinder(size[0], size[1])
    return coal.Sphere(size[0])


def placement(thing):
    return pin.SE3(pin.rpy.rpyToMatrix(0.0, 0.0, thing["yaw"]), np.array(thing["at"], dtype=float))


def solids_of_links(model, geometry):
    """Indices of the solids of each link, by its name."""
    of_link = {}
    for i, thing in enumerate(geometry.geometryObjects):
        of_link.setdefault(model.frames[thing.parentFrame].name, []).append(i)
    return of_link


def robot_geometry(model, request, hulls):
    """The robot's solids and the pairs of them that are tested."""
    kind = pin.GeometryType.COLLISION
    geometry = pin.buildGeomFromUrdf(model, request["urdf"], kind, package_dirs=request["package_dirs"])
    if hulls:
        for thing in geometry.geometryObjects:
            if isinstance(thing.geometry, coal.BVHModelBase):
                thing.geometry.buildConvexHull(True, "Qt")
                thing.geometry = thing.geometry.convex
    of_link = solids_of_links(model, geometry)
    for a, b in request["pairs"]:
        for i in of_link[a]:
            for j in of_link[b]:
                geometry.addCollisionPair(pin.CollisionPair(i, j))
    return geometry


def add_objects(geometry, objects, against):
    """Adds things that stand still, to be tested against the solids of the given indices."""
    for n, thing in enumerate(objects):
        new = geometry.addGeometryObject(pin.GeometryObject(f"object {n}", 0, placement(thing), shape(thing)))
        for i in against:
            geometry.addCollisionPair(pin.CollisionPair(i, new))


def geometry(model, request, hulls):
    geometry = robot_geometry(model, request, hulls)
    of_link = solids_of_links(model, geometry)
    add_objects(geometry, request["objects"], [i for link in request["moving"] for i in of_link[link]])
    return geometry


def main():
    request = json.load(sys.stdin)
    seconds = request["seconds"]
    model = pin.buildModelFromUrdf(request["urdf"])
    data = model.createData()
    configurations = []
    for values in request["configurations"]:
        q = pin.neutral(model)
        for name, value in zip(request["joints"], values):
            q[model.joints[model.getJointId(name)].idx_q] = value
        configurations.append(q)

    def links(q):
        pin.forwardKinematics(model, data, q)
        pin.updateFramePlacements(model, data)

    answer = {
        "versions": {"pinocchio": pin.__version__, "coal": coal.__version__},
        # What a call from Python costs by itself: this does next to nothing.
        "call_us": timed(lambda q: pin.nonLinearEffects is None or model.existFrame("-"), configurations, seconds / 4),
        "links_us": timed(links, configurations, seconds),
        "collision": {},
    }
    for name, hulls in [("hulls", True), ("meshes", False)]:
        shapes = geometry(model, request, hulls)
        placed = pin.GeometryData(shapes)
        tree = pin.BroadPhaseManager_DynamicAABBTreeCollisionManager(model, shapes, placed)

        def every_pair(q):
            return pin.computeCollisions(model, data, shapes, placed, q, False)

        def until_first(q):
            return pin.computeCollisions(model, data, shapes, placed, q, True)

        def with_tree(q):
            return pin.computeCollisions(model, data, tree, q, True)

        free = [not every_pair(q) for q in configurations]
        of_free = [q for q, is_free in zip(configurations, free) if is_free]
        answer["collision"][name] = {
            "pairs": len(shapes.collisionPairs),
            "free": free,
            "free_us": timed(until_first, of_free, seconds),
            "free_tree_us": timed(with_tree, of_free, seconds),
            "mixed_us": timed(until_first, configurations, seconds),
            "mixed_tree_us": timed(with_tree, configurations, seconds),
            "tree_agrees": sum(with_tree(q) != f for q, f in zip(configurations, free)),
        }
    json.dump(answer, sys.stdout)


if __name__ == "__main__":
    main()
