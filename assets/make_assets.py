#!/usr/bin/env python3
"""Writes the glTF models of this folder: mobile.gltf and pendulum_room.glb. Plain Python, same bytes every time.

    python3 assets/make_assets.py [FOLDER]

mobile.gltf        a windmill with a crane: clip "turn" of 8 s with LINEAR, STEP and CUBICSPLINE tracks, a mirrored
                   counterweight, a signal arm that turns below a group of non-uniform scale, a crate on a hook
pendulum_room.glb  a pendulum whose clip "swing" of 2 s is a cubic spline
"""
import base64
import json
import math
import pathlib
import struct
import sys

FLOAT, UNSIGNED_SHORT = 5126, 5123


class Model:
    """A glTF document under construction; meshes are closed and share their corners."""

    def __init__(self):
        self.data = bytearray()
        self.document = {"asset": {"version": "2.0", "generator": "Pantin assets/make_assets.py"},
                         "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [], "meshes": [], "animations": [],
                         "accessors": [], "bufferViews": [], "buffers": [], "extensionsUsed": []}

    def accessor(self, rows, code, kind, bounds=False):
        width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[kind]
        component = {FLOAT: "f", UNSIGNED_SHORT: "H"}[code]
        packed = b"".join(struct.pack("<%d%s" % (width, component), *row) for row in rows)
        views, accessors = self.document["bufferViews"], self.document["accessors"]
        views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(packed)})
        self.data += packed + b"\0" * (-len(packed) % 4)
        item = {"bufferView": len(views) - 1, "componentType": code, "count": len(rows), "type": kind}
        if bounds:
            stored = [struct.unpack("<%df" % width, struct.pack("<%df" % width, *row)) for row in rows]
            item["min"] = [min(column) for column in zip(*stored)]
            item["max"] = [max(column) for column in zip(*stored)]
        accessors.append(item)
        return len(accessors) - 1

    def mesh(self, name, corners, faces):
        """faces: lists of corners, counter-clockwise from outside, convex."""
        corners_of = [(f[0], f[k], f[k + 1]) for f in faces for k in range(1, len(f) - 1)]
        attributes = {"POSITION": self.accessor(corners, FLOAT, "VEC3", bounds=True)}
        indices = self.accessor([(i,) for triangle in corners_of for i in triangle], UNSIGNED_SHORT, "SCALAR")
        self.document["meshes"].append({"name": name, "primitives": [{"attributes": attributes, "indices": indices}]})
        return len(self.document["meshes"]) - 1

    def node(self, name, parent=None, **members):
        nodes = self.document["nodes"]
        nodes.append({"name": name, **members})
        if parent is not None:
            nodes[parent].setdefault("children", []).append(len(nodes) - 1)
        return len(nodes) - 1

    def clip(self, name):
        self.document["animations"].append({"name": name, "channels": [], "samplers": []})

    def track(self, node, path, interpolation, times, values):
        """values: one a key, or (in-tangent, value, out-tangent) a key for CUBICSPLINE."""
        clip = self.document["animations"][-1]
        rows = [row for key in values for row in key] if interpolation == "CUBICSPLINE" else values
        clip["samplers"].append({"input": self.accessor([(t,) for t in times], FLOAT, "SCALAR", bounds=True),
                                 "interpolation": interpolation,
                                 "output": self.accessor(rows, FLOAT, "VEC4" if path == "rotation" else "VEC3")})
        clip["channels"].append({"sampler": len(clip["samplers"]) - 1, "target": {"node": node, "path": path}})

    def json(self, uri=None):
        buffer = {"byteLength": len(self.data)}
        if uri:
            buffer["uri"] = uri
        document = dict(self.document, buffers=[buffer])
        parts = []
        for key, value in document.items():
            if value == []:
                continue
            if isinstance(value, list) and isinstance(value[0], dict):
                lines = ",\n".join("    " + json.dumps(item) for item in value)
                parts.append('  "%s": [\n%s\n  ]' % (key, lines))
            else:
                parts.append('  "%s": %s' % (key, json.dumps(value)))
        return "{\n" + ",\n".join(parts) + "\n}\n"

    def write_gltf(self, file):
        data = base64.b64encode(bytes(self.data)).decode()
        file.write_text(self.json("data:application/octet-stream;base64," + data))

    def write_glb(self, file):
        text = self.json().encode()
        text += b" " * (-len(text) % 4)
        body = struct.pack("<I4s", len(text), b"JSON") + text
        body += struct.pack("<I4s", len(self.data), b"BIN\0") + bytes(self.data)
        file.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body)


def frustum(x, y, z, x_top=None, z_top=None):
    """A box of these edge lengths about the origin, its top face of other lengths if given."""
    x_top, z_top = x if x_top is None else x_top, z if z_top is None else z_top
    ring = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    corners = [(a * x / 2, -y / 2, b * z / 2) for a, b in ring] + [(a * x_top / 2, y / 2, b * z_top / 2) for a, b in ring]
    faces = [[0, 1, 2, 3], [7, 6, 5, 4]] + [[k + 4, (k + 1) % 4 + 4, (k + 1) % 4, k] for k in range(4)]
    return corners, faces


def cylinder(radius, length, sides=16):
    """Along y about the origin."""
    angles = [2 * math.pi * k / sides for k in range(sides)]
    corners = [(radius * math.sin(a), y, radius * math.cos(a)) for y in (-length / 2, length / 2) for a in angles]
    faces = [list(range(sides - 1, -1, -1)), list(range(sides, 2 * sides))]
    faces += [[k, (k + 1) % sides, (k + 1) % sides + sides, k + sides] for k in range(sides)]
    return corners, faces


def wedge(x, y, z):
    """A ramp that rises along +x; unlike its mirror image, so that a mirrored node can be told."""
    corners = [(-x / 2, -y / 2, -z / 2), (x / 2, -y / 2, -z / 2), (x / 2, -y / 2, z / 2), (-x / 2, -y / 2, z / 2),
               (x / 2, y / 2, -z / 2), (x / 2, y / 2, z / 2)]
    faces = [[0, 1, 2, 3], [1, 4, 5, 2], [0, 3, 5, 4], [0, 4, 1], [3, 2, 5]]
    return corners, faces


def moved(mesh, dx, dy, dz):
    corners, faces = mesh
    return [(x + dx, y + dy, z + dz) for x, y, z in corners], faces


def turn(axis, angle):
    """Unit quaternion x, y, z, w."""
    return [math.sin(angle / 2) if a == axis else 0.0 for a in "xyz"] + [math.cos(angle / 2)]


def turn_rate(axis, angle, rate):
    """Time derivative of turn(axis, angle) at this rate of the angle."""
    return [math.cos(angle / 2) * rate / 2 if a == axis else 0.0 for a in "xyz"] + [-math.sin(angle / 2) * rate / 2]


def mobile():
    m = Model()
    degree = math.pi / 180
    shaft = m.mesh("shaft", *moved(cylinder(0.35, 6), 0, 3, 0))
    cube = m.mesh("cube", *frustum(1, 1, 1))
    blade = m.mesh("blade", *moved(frustum(0.3, 2.2, 0.06, 0.12, 0.02), 0, 1.3, 0))
    beam = m.mesh("beam", *moved(frustum(5, 0.25, 0.25), 1.5, 0, 0))
    ramp = m.mesh("ramp", *wedge(0.8, 0.8, 0.6))
    rope = m.mesh("rope", *moved(cylinder(0.02, 1.6, 8), 0, -0.8, 0))
    claw = m.mesh("claw", *frustum(0.25, 0.3, 0.25, 0.1, 0.1))
    arm = m.mesh("arm", *moved(frustum(0.8, 0.12, 0.08), 0.4, 0, 0))

    tower = m.node("tower", mesh=shaft)
    m.node("plinth", tower, mesh=cube, translation=[0, -0.1, 0], scale=[3, 0.2, 3])
    head = m.node("head", tower, mesh=cube, translation=[0, 6.4, 0])
    rotor = m.node("rotor", head, translation=[0, 0, 0.7])
    for k, name in enumerate(["blade", "blade_2", "blade_3"]):
        m.node(name, rotor, mesh=blade, rotation=turn("z", 120 * degree * k))
    jib = m.node("jib", tower, mesh=beam, translation=[0, 4.2, 0])
    m.node("counterweight", jib, mesh=ramp, translation=[-1.2, -0.5, 0], scale=[-1, 1, 1])
    cable = m.node("cable", jib, mesh=rope, translation=[2, -0.125, 0])
    hook = m.node("hook", cable, mesh=claw, translation=[0, -1.75, 0])
    motion = {"mass": 40, "inertiaDiagonal": [6.6, 6.4, 6.8], "centerOfMass": [0, -0.05, 0]}
    m.node("crate", hook, mesh=cube, translation=[0, -0.55, 0], scale=[0.8, 0.8, 0.8],
           extensions={"KHR_physics_rigid_bodies": {"motion": motion}})
    m.document["extensionsUsed"] = ["KHR_physics_rigid_bodies"]
    post = m.node("post", tower, translation=[0, 2, 0.35], scale=[1, 1.5, 0.5])
    signal = m.node("signal", post, mesh=arm, rotation=turn("z", 15 * degree))
    flag = m.node("flag", signal, mesh=cube, translation=[0.8, 0, 0], rotation=turn("y", 30 * degree),
                  scale=[0.3, 0.2, 0.02])

    m.clip("turn")
    seconds = [0, 2, 4, 6, 8]
    m.track(rotor, "rotation", "LINEAR", list(range(9)), [turn("z", 90 * degree * k) for k in range(9)])
    sweep, omega = 30 * degree, 2 * math.pi / 8
    yaw = [(sweep * math.sin(omega * t), sweep * omega * math.cos(omega * t)) for t in seconds]
    m.track(head, "rotation", "CUBICSPLINE", seconds,
            [(turn_rate("y", a, r), turn("y", a), turn_rate("y", a, r)) for a, r in yaw])
    m.track(jib, "rotation", "LINEAR", [0, 4, 8], [turn("y", a * degree) for a in (0, 60, 0)])
    run = [(2 + math.sin(omega * t), omega * math.cos(omega * t)) for t in seconds]
    m.track(cable, "translation", "CUBICSPLINE", seconds,
            [((v, 0, 0), (x, -0.125, 0), (v, 0, 0)) for x, v in run])
    m.track(signal, "rotation", "STEP", [0, 2, 4, 6], [turn("z", a * degree) for a in (15, 45, 75, 45)])
    m.track(flag, "scale", "LINEAR", [0, 4, 8], [(0.3, 0.2, 0.02), (0.4, 0.2, 0.02), (0.3, 0.2, 0.02)])
    return m


def pendulum_room():
    m = Model()
    cube = m.mesh("cube", *frustum(1, 1, 1))
    rod = m.mesh("rod", *moved(cylinder(0.02, 1.2, 8), 0, -0.6, 0))
    bob = m.mesh("bob", *cylinder(0.15, 0.1, 16))
    room = m.node("room")
    m.node("floor", room, mesh=cube, translation=[0, -0.05, 0], scale=[4, 0.1, 4])
    m.node("beam", room, mesh=cube, translation=[0, 2.05, 0], scale=[2, 0.1, 0.1])
    m.node("block", room, mesh=cube, translation=[0.9, 0.2, 0], scale=[0.4, 0.4, 0.4])
    pivot = m.node("pivot", room, mesh=rod, translation=[0, 2, 0])
    m.node("bob", pivot, mesh=bob, translation=[0, -1.25, 0], rotation=turn("x", math.pi / 2))
    m.clip("swing")
    times = [0.25 * k for k in range(9)]
    swing = [(0.7 * math.cos(math.pi * t), -0.7 * math.pi * math.sin(math.pi * t)) for t in times]
    m.track(pivot, "rotation", "CUBICSPLINE", times,
            [(turn_rate("z", a, r), turn("z", a), turn_rate("z", a, r)) for a, r in swing])
    return m


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
    mobile().write_gltf(folder / "mobile.gltf")
    pendulum_room().write_glb(folder / "pendulum_room.glb")


if __name__ == "__main__":
    main()
