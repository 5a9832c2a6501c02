"""An engine for Broadside in Python: give serve() an object with the methods that you have.

It speaks the protocol of core/plugin/PROGRAMS.md over standard input and output, until its input ends. The standard
library is enough.

    class World:
        id, build, what = "my-world", "mine 1.0, double", "one line"
        declared = {"motion": "rigid", "contacts": "totals"}
        def begin(self, scene): ...
        def step(self, dt): ...
        def read_states(self): return [...]
        def read_points(self): return [...]
    serve(World())

Rows are dicts with the names of broadside_engine_v2.h. A method that raises fails the call with the exception's text.
With step_seconds = True, step returns its seconds, and these are the times; otherwise the times include the pipe.
"""

import os
import struct
import sys

MAGIC, VERSION, FIRST_FACE = b"BROADSID", 1, 0xFFFFFFF0
KINDS = ("", "box", "sphere", "capsule", "cylinder", "convex", "mesh")


class Layout:
    """Names, types and lengths of a row: "position:3d" is three doubles, "a:I" one u32."""

    def __init__(self, text):
        self.text, self.fields = text, []
        for field in text.split():
            name, kind = field.split(":")
            self.fields.append((name, int(kind[:-1] or 0)))
        self.row = struct.Struct("<" + "".join(field.split(":")[1] for field in text.split()))

    def unpack(self, values):
        values, row = iter(values), {}
        for name, count in self.fields:
            row[name] = [next(values) for _ in range(count)] if count else next(values)
        return row

    def pack(self, row):
        flat = []
        for name, count in self.fields:
            if count:
                flat += [row[name][k] for k in range(count)]
            else:
                flat.append(row.get(name, 0))
        return self.row.pack(*flat)


_STATE = "position:3d orientation:4d velocity:3d angular_velocity:3d"
STATE = Layout(_STATE)
BOX = Layout("min:3f max:3f")
PAIR = Layout("i:I j:I")
POSE = Layout("position:3f orientation:4f")
SEPARATION = Layout("distance_m:d normal:3f witness_a:3f witness_b:3f is_touching:I")
POINT = Layout("a:I b:I point:3d normal:3d gap:d impulse:3d feature:I reserved:I")
CONTACT = Layout("a:I b:I depth_m:f normal:3f normal_impulse:f tangent:3f tangent_impulse:f " +
                 " ".join(f"{when}_{what}_{who}:3f" for when in ("pre", "post") for who in "ab"
                          for what in ("position", "velocity")))
DETECTION = Layout("position:3d orientation:4d velocity:3d min:3f max:3f")
SHAPE = Layout("kind:I axis:I half_extents:3d radius:d half_length:d")
BODY = Layout("mesh:I is_static:I " + _STATE +
              " mass:d center_of_mass:3d inertia:6d mu_static:d mu_kinetic:d restitution:d")
WRENCH = Layout("body:I axes:I force:3d torque:3d")


class Reader:
    def __init__(self, data):
        self.data, self.at = data, 0

    def many(self, kind, count):
        values = struct.unpack_from(f"<{count}{kind}", self.data, self.at)
        self.at += struct.calcsize(f"<{count}{kind}")
        return list(values)

    def one(self, kind):
        return self.many(kind, 1)[0]

    def text(self):
        size = self.one("I")
        self.at += size
        return self.data[self.at - size:self.at].decode()

    def rows(self, layout, count):
        start, self.at = self.at, self.at + count * layout.row.size
        return [layout.unpack(v) for v in layout.row.iter_unpack(self.data[start:self.at])] if count else []


def _text(value):
    data = value.encode()
    return struct.pack("<I", len(data)) + data


def _scene(r):
    scene = {"name": r.text(), "turns": r.one("I") == 1, "frames": r.one("I"), "seed": r.one("Q"), "dt": r.one("d")}
    for name in ("gravity", "domain_min", "domain_max"):
        scene[name] = r.many("d", 3)
    for name in ("face_mu_static", "face_mu_kinetic", "face_restitution", "delta", "v_threshold", "v_max", "theta"):
        scene[name] = r.one("d")
    meshes, bodies, wrenches = r.many("I", 3)
    scene["shapes"] = r.rows(SHAPE, meshes)
    for shape in scene["shapes"]:
        shape["kind"] = KINDS[shape["kind"]] if shape["kind"] < len(KINDS) else "unknown"
    scene["bodies"], scene["wrenches"] = r.rows(BODY, bodies), r.rows(WRENCH, wrenches)
    scene["meshes"] = []
    for _ in range(meshes):
        vertices, triangles = r.many("Q", 2)
        scene["meshes"].append({"vertices": r.many("f", 3 * vertices), "triangles": r.many("I", 3 * triangles)})
    return scene


def _hello(engine):
    parts = ("find_pairs", "measure", "step", "read_points", "read_contacts", "read_detection", "read_step_pairs")
    offers = sum(1 << k for k, name in enumerate(parts) if hasattr(engine, name))
    offers |= 1 << 7 if getattr(engine, "step_seconds", False) else 0
    data = MAGIC + struct.pack("<IIId", VERSION, offers, int(getattr(engine, "is_exact", True)),
                               getattr(engine, "margin_m", 0.0))
    data += _text(engine.id) + _text(engine.build) + _text(engine.what)
    settings, declared = getattr(engine, "settings", []), getattr(engine, "declared", {})
    data += struct.pack("<I", len(settings))
    for key, default, what in settings:
        data += _text(key) + struct.pack("<Q", default) + _text(what)
    data += struct.pack("<I", len(declared))
    for key, value in declared.items():
        data += _text(key) + _text(str(value))
    return data


def _listed(layout, rows, room):
    """Cut to the room that was asked for; the caller comes again with more."""
    return struct.pack("<Q", len(rows)) + b"".join(layout.pack(row) for row in rows[:room])


READS = {6: ("read_pairs", PAIR), 9: ("read_separations", SEPARATION), 12: ("read_states", STATE),
         13: ("read_points", POINT), 14: ("read_contacts", CONTACT), 15: ("read_detection", DETECTION),
         16: ("read_step_pairs", PAIR)}


def answer(engine, call, r):
    """The payload that answers this call."""
    if call in READS:
        method, layout = READS[call]
        return _listed(layout, getattr(engine, method)(), r.one("Q"))
    if call == 1:
        return _hello(engine)
    if call == 2:
        values = r.many("Q", r.one("I"))
        if hasattr(engine, "create"):
            engine.create(values)
    elif call == 3:
        count = r.one("I")
        boxes = r.rows(BOX, count)
        engine.load_boxes(boxes, [flag != 0 for flag in r.many("B", count)])
    elif call == 4:
        engine.update_boxes(r.rows(BOX, r.one("I")))
    elif call == 5:
        engine.find_pairs()
    elif call == 7:
        engine.load_scene(_scene(r))
    elif call == 8:
        pairs, bodies = r.one("Q"), r.one("I")
        engine.measure(r.rows(PAIR, pairs), r.rows(POSE, bodies))
    elif call == 10:
        engine.begin(_scene(r))
    elif call == 11:
        seconds = engine.step(r.one("d"))
        return struct.pack("<d", seconds) if getattr(engine, "step_seconds", False) else b""
    elif call == 17:
        if hasattr(engine, "end"):
            engine.end()
    else:
        raise ValueError(f"there is no call {call}")
    return b""


def serve(engine, answer_to=answer):
    """Answers until the input ends. answer_to: what makes the payload of an answer, where rows are packed otherwise."""
    given, sent = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # standard output carries only the protocol
    sys.stdout = sys.stderr
    while len(head := given.read(4)) == 4:
        message = given.read(struct.unpack("<I", head)[0])
        try:
            status, payload = 0, answer_to(engine, struct.unpack_from("<I", message)[0], Reader(message[4:]))
        except Exception as error:  # whatever an engine raises is its answer
            status, payload = 1, _text(f"{type(error).__name__}: {error}"[:1000])
        sent.write(struct.pack("<II", len(payload) + 4, status) + payload)
        sent.flush()
