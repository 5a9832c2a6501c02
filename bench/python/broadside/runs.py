"""run, time, report, compare and contest: the program's commands, with values in place of arguments."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from . import program
from .errors import BadInput, Missing
from .program import Answer  # noqa: F401  (what compare, report and contest return)
from .program_engine import command_of
from .scene_builder import Scene, SceneBuilder
from .trace import Trace


def _engine_arguments(engines):
    many = engines if isinstance(engines, (list, tuple)) else [engines]
    if not many:
        raise BadInput("no engine is named; give one, such as octree-cpu (broadside.engines() names them)")
    return [part for one in many for part in ("--engine", one if isinstance(one, str) else command_of(one))]


def _scene_argument(scene, folder):
    """The command's argument for a scene: a name as it is; a Scene or a builder as a file in the run's folder."""
    if isinstance(scene, (Scene, SceneBuilder)):
        path = Path(folder) / "scene.toml"
        scene.save(str(path))
        return str(path)
    return os.fspath(scene)


def _options(frames, settings):
    arguments = [] if frames is None else ["--frames", frames]
    for key, value in (settings or {}).items():
        arguments += ["--set", f"{key}={value}"]
    return arguments


def run(scene: Any, engines: Any, *, out: str | os.PathLike[str] = "out", frames: int | None = None,
        settings: Mapping[str, Any] | None = None, more: Sequence[Any] = ()) -> list[Trace]:
    """Records a Trace of each engine, in processes of their own, into the folder `out`.

    scene: a name, a path, a Scene or a SceneBuilder. engines: ids, commands, paths of libraries, or classes with
    @broadside.engine. more: further arguments of `broadside run`. An engine that failed is Missing, with its reason.
    """
    os.makedirs(out, exist_ok=True)
    answer = program.call("run", _scene_argument(scene, out), *_engine_arguments(engines), "--out", out,
                          *_options(frames, settings), *more, passes=(0, 3))
    cells = json.loads((Path(out) / "cells.json").read_text(encoding="utf-8"))["rows"]
    lost = [cell for cell in cells if not cell.get("trace_file")]
    if answer.exit_code != 0 or lost:
        said = [f"{cell['stamp']['engine']}: {cell['state']}: {cell['reason']}" for cell in lost]
        raise Missing("; ".join(said) or answer.text.strip())
    return [Trace(Path(out) / cell["trace_file"]) for cell in cells]


def time(scene: Any, engines: Any, *, out: str | os.PathLike[str] | None = None, frames: int | None = None,
         settings: Mapping[str, Any] | None = None, repetitions: int = 5,
         more: Sequence[Any] = ()) -> list[dict[str, Any]]:
    """Times each engine with recording off; a list of samples, as samples.json has them.

    Traces and verdicts in the same folder are their proof.
    """
    with tempfile.TemporaryDirectory() as scratch:
        file = Path(out) if out is not None else Path(scratch) / "samples.json"
        file.parent.mkdir(parents=True, exist_ok=True)
        program.call("time", _scene_argument(scene, file.parent), *_engine_arguments(engines), "--out", file,
                     "--repetitions", repetitions, *_options(frames, settings), *more)
        return json.loads(file.read_text(encoding="utf-8"))["rows"]


def report(folders: Any, *, html: Any = None, markdown: Any = None, junit: Any = None,
           title: str | None = None) -> Answer:
    """Makes the page, the comment or the JUnit file of these folders of runs."""
    many = folders if isinstance(folders, (list, tuple)) else [folders]
    named = {"--html": html, "--markdown": markdown, "--junit": junit, "--title": title}
    arguments = [part for key, value in named.items() if value is not None for part in (key, value)]
    return program.call("report", *many, *arguments, passes=(0, 1, 3))


def compare(base: Any, head: Any, *, delta: float | None = None) -> Answer:
    """Compares the folders of two runs; exit_code 1 is a regression, 3 a missing result or an inconclusive time."""
    return program.call("compare", base, head, *([] if delta is None else ["--delta", delta]), passes=(0, 1, 3))


def contest(*, engines: Sequence[Any] = (), scenes: Sequence[str] = (), out: str | os.PathLike[str] = "out/contest",
            repetitions: int = 1, more: Sequence[Any] = ()) -> Answer:
    """Every engine of rigid bodies on scenes with a known answer; `out` gets the cells and the page."""
    arguments = [part for one in engines for part in ("--engine", one if isinstance(one, str) else command_of(one))]
    arguments += [part for one in scenes for part in ("--scene", one)]
    return program.call("contest", *arguments, "--out", out, "--repetitions", repetitions, *more, passes=(0, 1, 3))
