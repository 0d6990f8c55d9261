"""What Pinocchio and Coal say of a robot: where its links are and which of them touch.

Reads a list of requests as JSON from standard input:
  {"urdf": FILE, "package_dirs": [DIR], "joints": [NAME], "positions": [[q of every joint named]], "collide": bool}
and prints a list of answers as JSON: "links": {name: [[x, y, z, qx, qy, qz, qw] per configuration]} and, when asked for, for every pair of
geometries of links that can move against each other that is not far apart, by configuration:
"pairs": [[configuration, link, link, mesh touches, hull touches, distance of hulls]].
"""

import json
import sys

import coal
import numpy as np
import pinocchio as pin


def configuration(model, joints, values):
    q = pin.neutral(model)
    for name, value in zip(joints, values):
        if not model.existJointName(name):
            continue
        joint = model.joints[model.getJointId(name)]
        if joint.nq == 2:
            q[joint.idx_q : joint.idx_q + 2] = [np.cos(value), np.sin(value)]
        else:
            q[joint.idx_q] = value
    return q


def hull_of(geometry):
    """The convex hull of a mesh, other shapes as they are."""
    if isinstance(geometry, coal.BVHModelBase):
        geometry.buildConvexHull(True, "Qt")
        return geometry.convex
    return geometry


def links(model, data, positions, joints):
    frames = [i for i, frame in enumerate(model.frames) if frame.type == pin.FrameType.BODY]
    found = {model.frames[i].name: [] for i in frames}
    for values in positions:
        pin.framesForwardKinematics(model, data, configuration(model, joints, values))
        for i in frames:
            found[model.frames[i].name].append([float(v) for v in pin.SE3ToXYZQUAT(data.oMf[i])])
    return found


def pairs(model, data, geometry, positions, joints):
    objects = geometry.geometryObjects
    meshes = [thing.geometry for thing in objects]
    hulls = [hull_of(thing.geometry) for thing in objects]
    for hull in hulls:
        hull.computeLocalAABB()
    names = [model.frames[thing.parentFrame].name for thing in objects]
    movable = [
        (a, b)
        for a in range(len(objects))
        for b in range(a + 1, len(objects))
        if objects[a].parentJoint != objects[b].parentJoint
    ]
    placed = pin.GeometryData(geometry)
    contact, distance = coal.CollisionRequest(), coal.DistanceRequest()
    found = []
    for i, values in enumerate(positions):
        pin.updateGeometryPlacements(model, data, geometry, placed, configuration(model, joints, values))
        at = [coal.Transform3s(m.rotation, m.translation) for m in placed.oMg]
        for a, b in movable:
            # Bounding spheres first; they say the same for most pairs.
            far = np.linalg.norm(
                at[a].transform(hulls[a].aabb_center) - at[b].transform(hulls[b].aabb_center)
            ) - (hulls[a].aabb_radius + hulls[b].aabb_radius)
            if far > 0.0:
                continue
            mesh = coal.collide(meshes[a], at[a], meshes[b], at[b], contact, coal.CollisionResult()) > 0
            hull = coal.collide(hulls[a], at[a], hulls[b], at[b], contact, coal.CollisionResult()) > 0
            gap = coal.distance(hulls[a], at[a], hulls[b], at[b], distance, coal.DistanceResult())
            found.append([i, names[a], names[b], bool(mesh), bool(hull), float(gap)])
    return found


def answer(request):
    model = pin.buildModelFromUrdf(request["urdf"])
    data = model.createData()
    joints, positions = request["joints"], request["positions"]
    found = {"links": links(model, data, positions, joints)}
    if request["collide"]:
        kind = pin.GeometryType.COLLISION
        geometry = pin.buildGeomFromUrdf(model, request["urdf"], kind, package_dirs=request["package_dirs"])
        found["pairs"] = pairs(model, data, geometry, positions, joints)
    return found


def main():
    json.dump([answer(request) for request in json.load(sys.stdin)], sys.stdout)


if __name__ == "__main__":
    main()
