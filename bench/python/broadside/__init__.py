"""Broadside in Python: read and write traces, judge them, and call engines.

    import broadside

    for trace in broadside.run("rigid:stack:5", ["plain-rigid"], out="out/mine", frames=60):
        print(broadside.check(trace))

Units are SI, the frame is the world's, quaternions are w x y z. Arrays of a trace are read-only NumPy arrays. What goes
wrong is an exception with the line that the command line prints: BadInput, LawBroken, Missing or Internal.
"""

from .device import DeviceRows
from .engines import BroadPhase, Dynamics, engines, find_pairs
from .errors import BadInput, Error, Internal, LawBroken, Missing
from .program_engine import engine
from .runs import Answer, compare, contest, report, run, time
from .scenes import Scene, SceneBuilder, scene, scenes
from .trace import Column, Frame, Trace
from .verdicts import Verdict, Verdicts, check, laws
from .writer import TraceWriter

__all__ = [
    "Answer", "BadInput", "BroadPhase", "Column", "DeviceRows", "Dynamics", "Error", "Frame", "Internal",
    "LawBroken", "Missing", "Scene", "SceneBuilder", "Trace", "TraceWriter", "Verdict", "Verdicts", "check",
    "compare", "contest", "engine", "engines", "find_pairs", "laws", "report", "run", "scene", "scenes", "time",
]
