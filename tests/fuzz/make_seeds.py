"""Writes the inputs that fuzzing starts from:  make_seeds.py FOLDER

Small files of every kind that the readers take, generated here: FOLDER/scene, boxes, trace, mesh, program and manifest. A
mesh begins with one more byte, which names its format, and a program's answer with two (tests/fuzz/readers.hpp). Needs
numpy and h5py (Debian: python3-h5py).
"""

import json
import struct
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

TETRAHEDRON = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
GROUPS = {  # of /trace: dataset -> (elements a row, type); "body" has rows of two bodies
    "body": {"position": (3, "f4"), "orientation": (4, "f4"), "velocity": (3, "f4"), "angular_velocity": (3, "f4")},
    "detection": {"position": (3, "f4"), "velocity": (3, "f4"), "boxes": (6, "f4")},
    "pairs": {"pairs": (2, "u4"), "demanded": (0, "u8"), "raw": (0, "u8"), "offsets": (-1, "u8")},
    "confirmed": {"pairs": (2, "u4"), "squared_distance": (1, "f4"), "vertex_a": (1, "u4"), "vertex_b": (1, "u4"),
                  "offsets": (-1, "u8"), "proximity_offsets": (-1, "u8")},
    "contact": {"a": (1, "u4"), "b": (1, "u4"), "color": (1, "u4"), "depth": (1, "f4"), "normal": (3, "f4"),
                "normal_impulse": (1, "f4"), "tangent": (3, "f4"), "tangent_impulse": (1, "f4"), "offsets": (-1, "u8"),
                **{f"{when}_{what}_{who}": (3, "f4") for when in ("pre", "post") for what in ("position", "velocity")
                   for who in ("a", "b")}},
    "narrow": {"pairs": (2, "u4"), "distance": (1, "f8"), "touching": (1, "u1"), "normal": (3, "f4"),
               "witness_a": (3, "f4"), "witness_b": (3, "f4"), "offsets": (-1, "u8")},
    "point": {"a": (1, "u4"), "b": (1, "u4"), "point": (3, "f4"), "normal": (3, "f4"), "gap": (1, "f4"),
              "impulse": (3, "f4"), "feature": (1, "u4"), "offsets": (-1, "u8")},
}


def scenes():
    head = 'name = "n"\nframes = 2\ndt_s = 0.01\ngravity_m_s2 = [0.0, -9.81, 0]\n'
    domain = "[domain]\nmin_m = [-1, -1, -1]\nmax_m = [1, 1.5, 1]\n"
    body = "[[body]]\nposition_m = [0, 0.5, 0]\nvelocity_m_s = [1, 0, 0]\n"
    yield "box", head + domain + '[[mesh]]\nname = "b"\nshape = "box"\nsides_m = [1, 2, 1]\nsegments = [2, 1, 1]\n' + body
    yield "sphere", domain + '[[mesh]]\nshape = "sphere"\nradius_m = 0.25\nfrequency = 2\nscale = 2.0\n' + body + "static = true\n"
    yield "lumpy", domain + '[[mesh]]\nshape = "lumpy"\ntriangles = 80\nseed = 3\nlongest_side_m = 1\n' + body + "mass_kg = 2.5\n"
    yield "parameters", (head + 'seed = "12"\n' + domain + "[parameters]\ndelta_m = 0.001\nbeta = 1\nalpha = 0.5\n"
                         "v_max_m_s = 50\ntheta_m = 0\n[material]\nmu_static = 0.6\n[face_material]\nrestitution = 1\n")
    yield "turned", domain + '[[mesh]]\nshape = "box"\n' + body + "orientation_wxyz = [0, 1, 0, 0]\n[body.material]\nmu_kinetic = 0.1\n"
    for kind, keys in {"stacked-grid": "gap = 0.1\ndrop_m = 1\njitter = 0.4\nwidth_of_grid = 2",
                       "filled-cube": "fill = 0.2\ntop_speed_m_s = 5"}.items():
        yield kind, f'[[mesh]]\nshape = "box"\nsegments = [1, 1, 1]\n[generator]\nkind = "{kind}"\ncount = 5\nmass_kg = 1\n{keys}\n'
    yield "file", domain + '[[mesh]]\nfile = "none.ply"\n' + body
    yield "name-of-many-parts", "[" + ".".join("a" * 50000) + "]\nx = 1\n"
    yield "catalogue", domain + '[[mesh]]\ncatalogue = "bunny"\n' + body


def boxes():
    row = struct.pack("<6f", 0, 0, 0, 1, 1, 1)
    yield "none", struct.pack("<I", 0)
    yield "two", struct.pack("<I", 2) + 2 * row
    yield "short", struct.pack("<I", 3) + row
    yield "infinite", struct.pack("<I", 1) + struct.pack("<6f", 0, 0, 0, 1, float("inf"), 1)
    yield "reversed", struct.pack("<I", 1) + struct.pack("<6f", 1, 0, 0, 0, 1, 1)


def meshes():
    def ply(form):
        return (f"ply\nformat {form} 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                "element face 4\nproperty list uchar int vertex_indices\nend_header\n").encode()

    lines = "".join(f"{x} {y} {z}\n" for x, y, z in TETRAHEDRON).encode()
    points = b"".join(struct.pack("<3f", *v) for v in TETRAHEDRON)
    yield "ply-text", b"0" + ply("ascii") + lines + b"".join(b"3 %d %d %d\n" % f for f in FACES)
    yield "ply-binary", b"0" + ply("binary_little_endian") + points + b"".join(struct.pack("<B3i", 3, *f) for f in FACES)
    yield "obj", b"1o t\n" + b"".join(b"v %d %d %d\n" % v for v in TETRAHEDRON) + b"vn 0 0 1\nvt 0 1\n" + b"".join(
        b"f %d/1/1 %d/1/1 %d/1/1\n" % tuple(i + 1 for i in f) for f in FACES)
    facets = b"".join(b"facet normal 0 0 0\nouter loop\n" + b"".join(b"vertex %d %d %d\n" % TETRAHEDRON[i] for i in f) +
                      b"endloop\nendfacet\n" for f in FACES)
    yield "stl-text", b"2solid t\n" + facets + b"endsolid t\n"
    yield "stl-binary", b"2" + bytes(80) + struct.pack("<I", 4) + b"".join(
        struct.pack("<3f", 0, 0, 0) + b"".join(struct.pack("<3f", *TETRAHEDRON[i]) for i in f) + b"\0\0" for f in FACES)
    yield "off", b"3OFF\n4 4 0\n" + lines + b"".join(b"3 %d %d %d\n" % f for f in FACES)
    binary = points + b"".join(struct.pack("<3H", *f) for f in FACES)
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "scale": [2, 2, 2]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": len(binary)}],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]},
                      {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}]}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(binary), b"BIN\0") + binary
    yield "glb", b"5glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks
    import base64
    document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(binary).decode()
    yield "gltf", b"4" + json.dumps(document).encode()
    levels = 40  # a copy of the mesh for each way down, if a node may have two parents
    document["nodes"] = [{"children": [k + 1, k + 1]} for k in range(levels)] + [{"mesh": 0}]
    yield "gltf-shared-children", b"4" + json.dumps(document).encode()
    document["nodes"] = [{"children": [k + 1]} for k in range(levels)] + [{"children": [0], "mesh": 0}]
    yield "gltf-node-within-itself", b"4" + json.dumps(document).encode()
    yield "glb-lies-about-length", b"5glTF" + struct.pack("<III4s", 2, 0xFFFFFFF0, 0xFFFFFFF0, b"JSON")


def fill_trace(file, groups, version=1, wide=False, declared=(), **storage):
    file.attrs["format"], file.attrs["format_version"] = np.bytes_("broadside-trace"), np.uint32(version)
    for key, value in declared:
        file.require_group("declaration").attrs[key] = np.bytes_(value)
    scene = file.create_group("scene")
    scene.attrs["name"] = np.bytes_("s")
    scene.attrs["domain"] = np.array([-9, -9, -9, 9, 9, 9], "f4")
    scene.attrs["gravity_m_s2"], scene.attrs["dt_s"] = np.zeros(3, "f4"), np.float32(0.01)
    scene.attrs["frames"], scene.attrs["seed"] = np.uint32(2), np.uint64(1)
    for name, value in {"delta_m": 0.001, "beta": 1, "alpha": 1, "v_threshold_m_s": 0.3, "impulse_min_n_s": 0.01,
                        "v_max_m_s": 50, "epsilon_m": 1e-6, "theta_m": 0, "hash_cell_m": 0.25}.items():
        scene.require_group("parameters").attrs[name] = np.float32(value)
    for name in ("mu_static", "mu_kinetic", "restitution"):
        scene.require_group("face_material").attrs[name] = np.float32(0.5)
        scene["body/" + name] = np.full(2, 0.5, "f4")
    scene["body/mesh"], scene["body/inverse_mass"] = np.zeros(2, "u4"), np.ones(2, "f4")
    scene["body/orientation"] = np.tile(np.array([1, 0, 0, 0], "f4"), (2, 1))
    for name in ("position", "velocity", "angular_velocity"):
        scene["body/" + name] = np.zeros((2, 3), "f4")
    scene["mesh/name"], scene["mesh/source"] = np.array([b"t"]), np.array([b"p"])
    scene["mesh/is_stand_in"] = np.zeros(1, "u1")
    scene["mesh/vertices"], scene["mesh/vertex_offsets"] = np.array(TETRAHEDRON, "f4"), np.array([0, 4], "u8")
    scene["mesh/triangles"], scene["mesh/triangle_offsets"] = np.array(FACES, "u4"), np.array([0, 4], "u8")
    file.create_group("provenance").attrs["engine"] = np.bytes_("e")
    file["trace/step"], file["trace/time"] = np.array([1, 2], "u8"), np.array([0.01, 0.02])
    file["trace/digest"] = np.zeros(2, "u8")
    for group in groups:
        for name, (width, kind) in GROUPS[group].items():
            kind = "f8" if wide and group == "body" else kind
            shape = (2, 2, width) if group in ("body", "detection") else {0: (2,), 1: (2,), -1: (3,)}.get(width, (2, width))
            values = np.zeros(shape, kind)
            if width == -1:
                values = np.array([0, 1, 2], kind)
            elif name == "pairs":
                values[:, 1] = 1
            elif name == "b":
                values[:] = 1
            file.create_dataset(f"trace/{group}/{name}", data=values, **storage)
    if version == 2:
        file["scene"].attrs["motion"] = np.bytes_("rigid")
        file["scene/body/inertia"] = np.tile(np.array([1, 1, 1, 0, 0, 0], "f8"), (2, 1))
        file["scene/body/center_of_mass"] = np.zeros((2, 3), "f8")
        if "detection" in groups:
            file["trace/detection/orientation"] = np.tile(np.array([1, 0, 0, 0], "f4"), (2, 2, 1))


DECLARED = [("motion", "rigid"), ("detection_at", "start"), ("contacts", "totals"), ("order", "1"), ("precision", "f64"),
            ("contact_margin_m", "0.01")]


def traces():
    cases = {"old-states": ("earliest", ["body", "detection"], {}), "new-pairs": ("latest", ["pairs", "confirmed"], {}),
             "old-zipped": ("earliest", ["pairs"], {"compression": "gzip", "shuffle": True, "chunks": True}),
             "new-zipped": ("latest", ["body"], {"compression": "gzip", "shuffle": True, "chunks": True}),
             "new-contacts": ("latest", ["contact"], {}), "old-narrow": ("earliest", ["narrow"], {"fletcher32": True}),
             "old-rigid": ("earliest", ["body", "detection", "point"], {"version": 2, "wide": True, "declared": DECLARED}),
             "new-rigid": ("latest", ["body", "point"], {"version": 2, "wide": True, "declared": DECLARED}),
             "old-declared": ("earliest", ["body"], {"version": 2, "declared": [("motion", "rigid")]}),
             "new-points": ("latest", ["point"], {"version": 2, "declared": [("friction", "con")]})}
    with tempfile.TemporaryDirectory() as folder:
        for name, (version, groups, storage) in cases.items():
            path = Path(folder, name)
            with h5py.File(path, "w", libver=version) as file:
                fill_trace(file, groups, **storage)
            yield name, path.read_bytes()


def answers():
    def text(value):
        return struct.pack("<I", len(value)) + value.encode()

    def answer(call, room, payload, status=0):
        return bytes([call, room]) + struct.pack("<II", len(payload) + 4, status) + payload

    start = b"BROADSID" + struct.pack("<IIId", 1, 4 + 8 + 32, 1, 0.0) + text("my-world") + text("1.0") + text("one line")
    settings = struct.pack("<I", 1) + text("cell_mm") + struct.pack("<Q", 250) + text("edge")
    declared = struct.pack("<I", 2) + text("motion") + text("rigid") + text("contacts") + text("totals")
    yield "hello", answer(0, 0, start + settings + declared)
    yield "hello-of-nothing", answer(0, 0, start + struct.pack("<II", 0, 0))
    yield "hello-of-many", answer(0, 0, start + struct.pack("<I", 0xFFFFFFFF))
    yield "hello-of-version-9", answer(0, 0, start.replace(b"SID\x01", b"SID\x09") + settings + declared)
    yield "states", answer(1, 2, struct.pack("<Q26d", 2, *range(26)))
    yield "points", answer(2, 1, struct.pack("<QII10dII", 5, 0, 1, *range(10), 7, 0))
    yield "contacts", answer(3, 1, struct.pack("<QII33f", 1, 0, 1, *range(33)))
    yield "detections", answer(4, 1, struct.pack("<Q10d6f", 1, *range(10), *range(6)))
    yield "pairs", answer(5, 9, struct.pack("<Q4I", 2, 0, 1, 0, 2))
    yield "a-count-that-lies", answer(5, 9, struct.pack("<Q4I", 1 << 60, 0, 1, 0, 2))
    yield "failure", answer(1, 2, text("the moon is full"), 1)
    yield "printed", b"\0\0Hello, I am an engine.\n"


def manifests():
    def cell(name, **changed):
        return {"against": "", "engine": "octree-cpu", "frames": 5, "id": name, "needs_gpu": False, "processes": 1,
                "repetitions": 1, "scene": "freefall:cube:5", "stand_in": False, "time_limit_s": 60.0, "turns": name,
                **changed}

    def manifest(*cells, **more):
        return json.dumps({"build": "Broadside", "cells": cells, "format": "broadside-campaign", "name": "n",
                           "version": 2, **more})

    one, other = "304dade30fa2b4bf", "76448a428746de64"
    paper = {"beside_hash": "octree-cpu", "counts": [50], "device": "", "experiments": ["table5"], "frames": 5,
             "hash": "hash-cpu", "keeps_traces": False, "limit_s": 60.0, "machine": "", "models": ["bunny"],
             "octree": "octree-cpu", "runs": 1, "stand_in": False}
    yield "two-cells", manifest(cell(one), cell(other, turns=one, against="all-pairs"))
    yield "of-the-paper", manifest(cell(one, scene="randommove:bunny:50"), paper=paper)
    yield "nothing", manifest()
    yield "frames-below-zero", manifest(cell(one, frames=-5))
    yield "frames-1e30", manifest(cell(one, frames=1e30))
    yield "one-id-twice", manifest(cell(one), cell(one))
    yield "an-id-that-climbs", manifest(cell("../../etc/passwd"))
    yield "no-time", manifest(cell(one, time_limit_s=0.0))
    yield "nested", "[" * 5000


def main(folder):
    readers = {"scene": scenes, "boxes": boxes, "trace": traces, "mesh": meshes, "program": answers,
               "manifest": manifests}
    for reader, seeds in readers.items():
        Path(folder, reader).mkdir(parents=True, exist_ok=True)
        for name, content in seeds():
            Path(folder, reader, name).write_bytes(content if isinstance(content, bytes) else content.encode())


if __name__ == "__main__":
    main(sys.argv[1])
