"""@broadside.engine: a Python class as an engine for run, check and time.

    @broadside.engine(declared={"motion": "translate"})
    class Ballistic:
        def begin(self, scene): self.x, self.v, self.g = scene.position.copy(), scene.velocity.copy(), scene.gravity
        def step(self, dt): self.v += dt * self.g; self.x += dt * self.v
        def read_states(self): return {"position": self.x, "velocity": self.v}

    broadside.run("flight:box", Ballistic)

Write what you have: find_pairs(boxes, is_static) of a broad phase; begin(scene), step(dt), read_states() of dynamics,
and with it read_points(), read_detection(), read_step_pairs(). Each read_... gives a dict of arrays named as in
core/plugin/PROGRAMS.md, or pairs [rows, 2]. The class must be in a file: it is served as a program engine, whose
process loads that file by its path, under another name than __main__.
"""

import importlib.util
import inspect
import shlex
import struct
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np

from . import program_client as client
from .errors import BadInput

DEFAULTS = {"orientation": (1.0, 0.0, 0.0, 0.0)}  # of arrays that an engine leaves out; others are zero


def engine(cls=None, *, id=None, build=None, what=None, declared=None):
    """Marks a class as an engine. id: its name in reports; declared: what it says of itself (core/trace/FOREIGN.md)."""
    if cls is None:
        return lambda given: engine(given, id=id, build=build, what=what, declared=declared)
    words = "".join("-" + c.lower() if c.isupper() else c for c in cls.__name__).strip("-").replace("_", "-")
    own = f"{cls.__module__}.{cls.__qualname__}, Python {sys.version.split()[0]}"
    cls.broadside_facts = {"id": id or words, "build": build or own,
                           "what": what or (inspect.getdoc(cls) or f"the class {cls.__name__}").splitlines()[0],
                           "declared": dict(declared or {})}
    return cls


def command_of(cls):
    """What is written after --engine for this class."""
    if not hasattr(cls, "broadside_facts"):
        raise BadInput(f"{cls!r} is no engine; put @broadside.engine before the class")
    try:
        file = inspect.getsourcefile(cls)
    except TypeError:
        file = None
    if file is None or not Path(file).is_file():
        raise BadInput(f"{cls.__name__}: its class is in no file; write it to one (in a notebook: %%writefile mine.py) "
                       "and import it")
    return shlex.join([sys.executable, "-m", "broadside.program_engine", f"{Path(file).resolve()}:{cls.__qualname__}"])


def _dtype(layout):
    """NumPy's form of a row of the protocol."""
    kinds = {"I": "<u4", "d": "<f8", "f": "<f4"}
    fields = []
    for text in layout.text.split():
        name, kind = text.split(":")
        fields.append((name, kinds[kind[-1]], (int(kind[:-1]),)) if len(kind) > 1 else (name, kinds[kind]))
    return np.dtype(fields)


def _packed(layout, given):
    """Rows of the protocol from a dict of arrays, or from pairs [rows, 2]."""
    dtype = _dtype(layout)
    if not isinstance(given, dict):
        pairs = np.asarray(given, dtype="<u4").reshape(-1, 2)
        given = {"i": pairs[:, 0], "j": pairs[:, 1]}
    unknown = set(given) - set(dtype.names)
    if unknown:
        raise ValueError(f"there is no {', '.join(sorted(unknown))}; one of: {', '.join(dtype.names)}")
    rows = np.zeros(max((len(values) for values in given.values()), default=0), dtype)
    for name in dtype.names:
        if name in given:
            rows[name] = given[name]
        elif name in DEFAULTS:
            rows[name] = DEFAULTS[name]
    return rows


def _scene(given):
    """The client's scene with arrays [n, ...] of its bodies beside its own keys."""
    bodies = given["bodies"]
    made = SimpleNamespace(**{key: value for key, value in given.items() if key != "bodies"})
    for name in ("gravity", "domain_min", "domain_max"):
        setattr(made, name, np.array(given[name]))
    for name in _dtype(client.BODY).names:
        setattr(made, name, np.array([body[name] for body in bodies]))
    made.body_count = len(bodies)
    return made


class Served:
    """The user's engine behind the interface that the client expects."""

    def __init__(self, cls):
        self.own = cls()
        facts = cls.broadside_facts
        self.id, self.build, self.what, self.declared = (facts[key] for key in ("id", "build", "what", "declared"))
        self.is_exact, self.margin_m = getattr(self.own, "is_exact", True), getattr(self.own, "margin_m", 0.0)
        self.step_seconds = True  # times the class alone: packing and the pipe are counted separately
        for name in ("find_pairs", "step", "read_points", "read_detection", "read_step_pairs"):
            if hasattr(self.own, name):
                setattr(self, name, getattr(self, f"_{name}", None) or getattr(self.own, name))

    def begin(self, scene):
        self.own.begin(_scene(scene))

    def read_states(self):
        return self.own.read_states()

    def end(self):
        if hasattr(self.own, "end"):
            self.own.end()

    def _step(self, dt):
        start = time.perf_counter()
        self.own.step(dt)
        return time.perf_counter() - start

    def _find_pairs(self):
        self.pairs = self.own.find_pairs(self.boxes, self.is_static)

    def read_pairs(self):
        return self.pairs


def answer(served, call, reader):
    """As the client's, with arrays in place of lists of rows."""
    if call in client.READS:
        method, layout = client.READS[call]
        rows, room = _packed(layout, getattr(served, method)()), reader.one("Q")
        return struct.pack("<Q", len(rows)) + rows[:room].tobytes()
    if call in (3, 4):
        count = reader.one("I")
        served.boxes = np.frombuffer(reader.data, "<f4", 6 * count, reader.at).reshape(count, 6)
        if call == 3:
            served.is_static = np.frombuffer(reader.data, np.uint8, count, reader.at + 24 * count).astype(bool)
        return b""
    return client.answer(served, call, reader)


def main(place):
    """Serves the class at FILE:NAME over standard input and output."""
    file, _, name = place.rpartition(":")
    spec = importlib.util.spec_from_file_location(Path(file).stem + "_engine", file)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    sys.path.insert(0, str(Path(file).parent))
    sys.stdout = sys.stderr  # what the file prints while it is loaded is no part of the protocol
    spec.loader.exec_module(module)
    found = module
    for part in name.split("."):
        found = getattr(found, part)
    client.serve(Served(found), answer)


if __name__ == "__main__":
    main(sys.argv[1])
