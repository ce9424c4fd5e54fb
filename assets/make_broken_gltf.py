#!/usr/bin/env python3
"""Writes broken/gltf_*.gltf and .glb: one file for each error of the glTF loader. Plain Python, same bytes every time.

    python3 assets/make_broken_gltf.py [FOLDER]
"""
import base64
import copy
import json
import pathlib
import struct
import sys

FLOATS = struct.pack("<12f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1)
ROTATIONS = struct.pack("<8f", 0, 0, 0, 1, 0, 0, 1, 0)
INDICES = struct.pack("<4H", 0, 1, 2, 0)
TIMES = struct.pack("<4f", 0, 1, 1, -1)


def data_uri(data):
    return "data:application/octet-stream;base64," + base64.b64encode(data).decode()


def view(offset, length, **members):
    return {"buffer": 0, "byteOffset": offset, "byteLength": length, **members}


def accessor(number, count, kind, code=5126, **members):
    return {"bufferView": number, "componentType": code, "count": count, "type": kind, **members}


#: A sound model: a triangle on one node, and a turn of another.
SOUND = {
    "asset": {"version": "2.0"},
    "scene": 0,
    "scenes": [{"nodes": [0, 1]}],
    "nodes": [{"name": "plate", "mesh": 0}, {"name": "wheel", "children": [2]}, {"name": "spoke"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "animations": [{"channels": [{"sampler": 0, "target": {"node": 1, "path": "rotation"}}],
                    "samplers": [{"input": 2, "output": 3}]}],
    "accessors": [accessor(0, 4, "VEC3"), accessor(1, 3, "SCALAR", 5123), accessor(2, 2, "SCALAR"),
                  accessor(3, 2, "VEC4")],
    "bufferViews": [view(0, 48), view(48, 8), view(56, 16), view(72, 32)],
    "buffers": [{"byteLength": 104, "uri": data_uri(FLOATS + INDICES + TIMES + ROTATIONS)}],
}

LEAVE_OUT = object()


def changed(*changes):
    """SOUND with members set: pairs of a path and a value."""
    document = copy.deepcopy(SOUND)
    for path, value in changes:
        *way, last = path
        at = document
        for key in way:
            at = at[key]
        if value is LEAVE_OUT:
            del at[last]
        else:
            at[last] = value
    return document


def glb(*chunks, version=2, magic=b"glTF", length=None):
    body = b"".join(struct.pack("<I4s", len(data), kind) + data for kind, data in chunks)
    return struct.pack("<4sII", magic, version, 12 + len(body) if length is None else length) + body


def glb_with(document):
    text = json.dumps(document).encode()
    return text + b" " * (-len(text) % 4)


NODE, MESH, CHANNEL, SAMPLER = ("nodes", 0), ("meshes", 0, "primitives", 0), ("animations", 0, "channels", 0), \
    ("animations", 0, "samplers", 0)
URI = ("buffers", 0, "uri")


def sparse(**members):
    whole = {"count": 1, "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 0}}
    return (("accessors", 0, "sparse"), {**whole, **members})


def documents():
    """Name and changes of SOUND."""
    zeros = {"componentType": 5123, "count": 1 << 20, "type": "SCALAR"}
    strips = [{"attributes": {"POSITION": 0}, "indices": 4, "mode": 5}] * 129
    return {
        # document
        "asset_missing": [(("asset",), LEAVE_OUT)],
        "version_missing": [(("asset", "version"), LEAVE_OUT)],
        "version_no_version": [(("asset", "version"), "two")],
        "version_1": [(("asset", "version"), "1.0")],
        "min_version": [(("asset", "minVersion"), "2.1")],
        "extensions_required": [(("extensionsRequired",), ["KHR_materials_unlit", "KHR_draco_mesh_compression",
                                                          "ACME_gears"])],
        "collection_kind": [(("nodes",), {"plate": {}})],
        "item_kind": [(NODE, 7)],
        # fields
        "number_kind": [(NODE + ("translation",), [0, "1", 0])],
        "number_count": [(NODE + ("translation",), [0, 1])],
        "index_negative": [(NODE + ("mesh",), -1)],
        "index_fraction": [(NODE + ("mesh",), 0.5)],
        "index_beyond": [(NODE + ("mesh",), 1)],
        "name_kind": [(NODE + ("name",), 5)],
        # hierarchy
        "two_parents": [(NODE + ("children",), [2])],
        "cycle": [(("nodes", 2, "children"), [1]), (("scenes", 0, "nodes"), [0])],
        "scene_of_child": [(("scenes", 0, "nodes"), [0, 2])],
        "scene_twice": [(("scenes", 0, "nodes"), [0, 1, 0])],
        "no_nodes": [(("scenes", 0, "nodes"), [])],
        # transforms
        "matrix_and_scale": [(NODE + ("matrix",), [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]),
                             (NODE + ("scale",), [1, 1, 1])],
        "matrix_projective": [(NODE + ("matrix",), [1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])],
        "quaternion_zero": [(NODE + ("rotation",), [0, 0, 0, 0])],
        # buffers
        "view_beyond": [(("bufferViews", 0, "byteLength"), 1000)],
        "buffer_empty": [(("buffers", 0, "byteLength"), 0)],
        "buffer_without_uri": [(URI, LEAVE_OUT)],
        "buffer_short": [(("buffers", 0, "byteLength"), 105)],
        "base64_length": [(URI, "data:;base64,AAAAA")],
        "base64_character": [(URI, "data:;base64,AA-A")],
        "base64_bits": [(URI, "data:;base64,AB==")],
        "data_without_comma": [(URI, "data:application/octet-stream;base64")],
        "percent": [(URI, "part%2.bin")],
        "scheme": [(URI, "https://example.org/part.bin")],
        "absolute": [(URI, "/etc/hostname")],
        "traversal": [(URI, "../mobile.gltf")],
        "traversal_encoded": [(URI, "%2e%2e%2Fmobile.gltf")],
        "no_name": [(URI, "")],
        "file_missing": [(URI, "no_such.bin")],
        # accessors
        "component_type": [(("accessors", 0, "componentType"), 5124)],
        "component_missing": [(("accessors", 0, "componentType"), LEAVE_OUT)],
        "type": [(("accessors", 0, "type"), "VEC2")],
        "count_zero": [(("accessors", 0, "count"), 0)],
        "count_lying": [(("accessors", 0, "count"), 1 << 52)],
        "normalised_float": [(("accessors", 0, "normalized"), True)],
        "index_signed": [(("accessors", 1, "componentType"), 5122)],
        "rotation_integer": [(("accessors", 3, "componentType"), 5122)],
        "stride": [(("bufferViews", 0, "byteStride"), 3)],
        "stride_short": [(("bufferViews", 0, "byteStride"), 8)],
        "zeros_without_end": [(("accessors", 0, "bufferView"), LEAVE_OUT), (("accessors", 0, "count"), 1 << 40)],
        "not_finite": [(URI, data_uri(struct.pack("<4f", 0, 0, 0, float("nan")) + bytes(88)))],
        "sparse_count": [sparse(count=5)],
        "sparse_index_type": [sparse(indices={"bufferView": 1, "componentType": 5126})],
        "sparse_order": [sparse(count=4)],
        "too_many_numbers": [(("accessors",), SOUND["accessors"] + [zeros]), (("meshes", 0, "primitives"), strips)],
        # meshes
        "mode": [(MESH + ("mode",), 7)],
        "vertex_beyond": [(("accessors", 0, "count"), 2)],
        # animations
        "interpolation": [(SAMPLER + ("interpolation",), "BEZIER")],
        "animated_twice": [(("animations", 0, "channels"), SOUND["animations"][0]["channels"] * 2)],
        "animated_matrix": [(("nodes", 1, "matrix"), [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])],
        "sampler_beyond": [(CHANNEL + ("sampler",), 1)],
        "value_count": [(("accessors", 3, "count"), 1)],
        "value_count_cubic": [(SAMPLER + ("interpolation",), "CUBICSPLINE")],
        "time_negative": [(("accessors", 2, "byteOffset"), 12), (("accessors", 2, "count"), 1)],
        "time_order": [(("accessors", 2, "count"), 3)],
        "rotation_zero": [(("accessors", 3, "bufferView"), LEAVE_OUT)],
    }


def raw():
    """Name and bytes of what is no document."""
    sound = json.dumps(SOUND)
    text = glb_with(SOUND)
    return {
        "random.gltf": bytes((37 * k * k + 11 * k + 200) % 256 for k in range(64)),
        "syntax.gltf": b'{\n  "asset": {"version": "2.0"},\n  "nodes": [{"name": "a",}]\n}\n',
        "truncated.gltf": sound[:len(sound) // 2].encode(),
        "zero_byte.gltf": sound.encode() + b"\n\0more",
        "overflow.gltf": sound.replace('"scene": 0', '"scene": 1e999').encode(),
        "not_object.gltf": b"[1, 2]",
        "key_twice.gltf": sound.replace('"name": "plate"', '"name": "plate", "name": "disc"').encode(),
        "magic.glb": bytes(range(64)),
        "header_short.glb": glb((b"JSON", text))[:15],
        "glb_version.glb": glb((b"JSON", text), version=1),
        "length.glb": glb((b"JSON", text), length=100000),
        "chunk_header.glb": glb((b"JSON", b'{"asset":{"version":"2.0"} }'))[:8] + struct.pack("<I", 52) +
        glb((b"JSON", b'{"asset":{"version":"2.0"} }'))[12:] + b"abcd",
        "chunk_length.glb": glb((b"JSON", text))[:12] + struct.pack("<I", 1 << 30) + glb((b"JSON", text))[16:],
        "first_chunk.glb": glb((b"BIN\0", bytes(4)), (b"JSON", text)),
        "json_chunk.glb": glb((b"JSON", b'{"asset":\n {"version" "2.0"}} ')),
        "binary_short.glb": glb((b"JSON", glb_with(changed((URI, LEAVE_OUT)))), (b"BIN\0", bytes(100))),
    }


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent / "broken"
    for name, changes in documents().items():
        (folder / ("gltf_%s.gltf" % name)).write_text(json.dumps(changed(*changes)) + "\n")
    for name, data in raw().items():
        (folder / ("gltf_" + name)).write_bytes(data)


if __name__ == "__main__":
    main()
