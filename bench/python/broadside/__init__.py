"""Broadside in Python: read and write traces, judge them, and call engines.

    import broadside

    for trace in broadside.run("rigid:stack:5", ["plain-rigid"], out="out/mine", frames=60):
        print(broadside.check(trace))

Units are SI, the frame is the world's, quaternions are w x y z. Arrays of a trace are read-only NumPy arrays. What goes
wrong is an exception with the line that the command line prints: BadInput, LawBroken, Missing or Internal.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .device import DeviceFrame, DeviceRows
    from .errors import BadInput, Error, Internal, LawBroken, Missing
    from .in_process import BroadPhase, Dynamics, engines, find_pairs
    from .program_engine import engine
    from .runs import Answer, compare, contest, report, run, time
    from .scene_builder import Scene, SceneBuilder, scene, scenes
    from .trace import Column, Frame, Trace
    from .verdicts import Verdict, Verdicts, check, laws
    from .writer import TraceWriter

# Where each name is. A module is loaded when a name of it is first asked for: the process of a Python engine asks for
# `engine` alone, and has ten seconds to say hello, so it does not load what judges and simulates.
_PLACES = {
    "device": ["DeviceFrame", "DeviceRows"],
    "errors": ["BadInput", "Error", "Internal", "LawBroken", "Missing"],
    "in_process": ["BroadPhase", "Dynamics", "engines", "find_pairs"],
    "program_engine": ["engine"],
    "runs": ["Answer", "compare", "contest", "report", "run", "time"],
    "scene_builder": ["Scene", "SceneBuilder", "scene", "scenes"],
    "trace": ["Column", "Frame", "Trace"],
    "verdicts": ["Verdict", "Verdicts", "check", "laws"],
    "writer": ["TraceWriter"],
}
_MODULE_OF = {name: module for module, names in _PLACES.items() for name in names}
__all__ = sorted(_MODULE_OF)


def __getattr__(name: str) -> Any:
    if name in _MODULE_OF:
        value = getattr(importlib.import_module(f".{_MODULE_OF[name]}", __name__), name)
    elif name in ("native", "program"):
        value = importlib.import_module(f".{name}", __name__)
    else:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return [*globals(), *__all__]
