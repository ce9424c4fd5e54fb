#!/usr/bin/env python3
"""Writes the binary and animated files of meshes/: plinth.stl, wedge.ply, swing.fbx. Plain Python, same bytes every time.

    python3 assets/make_meshes.py [FOLDER]

plinth.stl  a box of 0.4 x 0.3 x 0.2 m, binary
wedge.ply   half of it, cut along a diagonal, binary with the greatest byte first
swing.fbx   binary FBX 7.4 in centimetres, Y up: an arm below a post; clip "swing": the arm turns about z to 90 degrees in
            1 s and back in 2 s, the post rises by 50 cm in 3 s; curves with linear keys
"""
import pathlib
import struct
import sys

X, Y, Z = 0.4, 0.3, 0.2
CORNERS = [(x, y, z) for z in (0, Z) for y in (0, Y) for x in (0, X)]
BOX = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6),
       (1, 3, 5), (3, 7, 5)]
WEDGE_CORNERS = [CORNERS[i] for i in (0, 1, 2, 4, 5, 6)]
WEDGE = [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)]
SECOND = 46186158000  # of FBX time


def write_stl(file):
    data = b"A plinth, made for Pantin".ljust(80) + struct.pack("<I", len(BOX))
    for triangle in BOX:
        data += struct.pack("<12f", 0, 0, 0, *(x for i in triangle for x in CORNERS[i])) + b"\0\0"
    file.write_bytes(data)


def write_ply(file):
    head = ["ply", "format binary_big_endian 1.0", "comment a wedge, made for Pantin",
            "element vertex %d" % len(WEDGE_CORNERS), "property float x", "property float y", "property double z",
            "element face %d" % len(WEDGE), "property list uchar ushort vertex_indices", "end_header", ""]
    data = "\n".join(head).encode()
    for x, y, z in WEDGE_CORNERS:
        data += struct.pack(">ffd", x, y, z)
    for face in WEDGE:
        data += struct.pack(">B%dH" % len(face), len(face), *face)
    file.write_bytes(data)


def prop(value):
    """A property of an FBX record: the type follows from that of the value."""
    if isinstance(value, bytes):
        return b"S" + struct.pack("<I", len(value)) + value
    if isinstance(value, str):
        return prop(value.encode())
    if isinstance(value, float):
        return b"D" + struct.pack("<d", value)
    if isinstance(value, tuple):  # (kind, numbers)
        kind, numbers = value
        packed = struct.pack("<%d%s" % (len(numbers), {"d": "d", "f": "f", "i": "i", "l": "q"}[kind]), *numbers)
        return kind.encode() + struct.pack("<III", len(numbers), 0, len(packed)) + packed
    return b"I" + struct.pack("<i", value) if -2**31 <= value < 2**31 else b"L" + struct.pack("<q", value)


def long(value):
    """An identifier, always of 64 bits."""
    return ("LONG", value)


def record(at, name, properties=(), children=()):
    """The bytes of a record that begins at byte `at`: FBX stores absolute ends."""
    packed = b"".join(b"L" + struct.pack("<q", p[1]) if isinstance(p, tuple) and p[0] == "LONG" else prop(p)
                      for p in properties)
    start = at + 13 + len(name) + len(packed)
    body = b""
    for child in children:
        body += record(start + len(body), *child)
    if children:
        body += b"\0" * 13
    return struct.pack("<III", start + len(body), len(properties), len(packed)) + bytes([len(name)]) + name.encode() + \
        packed + body


def named(name, kind):
    return name.encode() + b"\0\1" + kind.encode()


def p70(*rows):
    return ("Properties70", (), [("P", row) for row in rows])


def vector(name, kind, x, y, z):
    return (name, kind, "", "A", float(x), float(y), float(z))


def curve(identity, times, values):
    return ("AnimationCurve", (long(identity), named("", "AnimCurve"), ""),
            [("Default", (0.0,)), ("KeyVer", (4008,)), ("KeyTime", (("l", [t * SECOND for t in times]),)),
             ("KeyValueFloat", (("f", values),)), ("KeyAttrFlags", (("i", [4]),)),
             ("KeyAttrDataFloat", (("f", [0.0, 0.0, 0.0, 0.0]),)), ("KeyAttrRefCount", (("i", [len(times)]),))])


def curve_node(identity, letter, x, y, z):
    return ("AnimationCurveNode", (long(identity), named(letter, "AnimCurveNode"), ""),
            [p70(*[("d|" + axis, "Number", "", "A", float(v)) for axis, v in zip("XYZ", (x, y, z))])])


def write_fbx(file):
    objects = [
        ("Geometry", (long(11), named("arm", "Geometry"), "Mesh"),
         [("Vertices", (("d", [0.0, 0.0, 0.0, 80.0, 0.0, 0.0, 0.0, 20.0, 0.0, 0.0, 0.0, 30.0]),)),
          ("PolygonVertexIndex", (("i", [0, 2, -2, 0, 1, -4, 0, 3, -3, 1, 2, -4]),)), ("GeometryVersion", (124,))]),
        ("Model", (long(21), named("post", "Model"), "Null"),
         [("Version", (232,)), p70(vector("Lcl Translation", "Lcl Translation", 0, 100, 0))]),
        ("Model", (long(22), named("arm", "Model"), "Mesh"),
         [("Version", (232,)), p70(vector("Lcl Translation", "Lcl Translation", 0, 40, 0))]),
        ("AnimationStack", (long(31), named("swing", "AnimStack"), ""),
         [p70(("LocalStop", "KTime", "Time", "", 3 * SECOND))]),
        ("AnimationLayer", (long(32), named("layer", "AnimLayer"), ""),
         [p70(("Weight", "Number", "", "A", 100.0))]),
        curve_node(33, "R", 0, 0, 0), curve_node(34, "T", 0, 100, 0),
        curve(41, [0, 1, 3], [0.0, 90.0, 0.0]), curve(42, [0, 3], [100.0, 150.0])]
    links = [("OO", 21, 0), ("OO", 22, 21), ("OO", 11, 22), ("OO", 32, 31), ("OO", 33, 32), ("OO", 34, 32),
             ("OP", 33, 22, "Lcl Rotation"), ("OP", 34, 21, "Lcl Translation"), ("OP", 41, 33, "d|Z"),
             ("OP", 42, 34, "d|Y")]
    settings = [("UpAxis", 1), ("UpAxisSign", 1), ("FrontAxis", 2), ("FrontAxisSign", 1), ("CoordAxis", 0),
                ("CoordAxisSign", 1)]
    top = [("FBXHeaderExtension", (), [("FBXHeaderVersion", (1003,)), ("FBXVersion", (7400,))]),
           ("GlobalSettings", (), [("Version", (1000,)),
                                   p70(*[(n, "int", "Integer", "", v) for n, v in settings],
                                       ("UnitScaleFactor", "double", "Number", "", 1.0),
                                       ("TimeMode", "enum", "", "", 6))]),
           ("Definitions", (), [("Version", (100,)), ("Count", (len(objects),))]),
           ("Objects", (), objects),
           ("Connections", (), [("C", (link[0], long(link[1]), long(link[2])) + link[3:]) for link in links])]
    data = b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<I", 7400)
    for item in top:
        data += record(len(data), *item)
    file.write_bytes(data + b"\0" * 13)


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent / "meshes")
    write_stl(folder / "plinth.stl")
    write_ply(folder / "wedge.ply")
    write_fbx(folder / "swing.fbx")


if __name__ == "__main__":
    main()
