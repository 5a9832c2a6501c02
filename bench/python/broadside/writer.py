"""TraceWriter: the trace of an engine of your own, which check then judges as it judges every other."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

import numpy as np

from . import native
from .arrays import fitted
from .errors import BadInput, Error
from .scene_builder import Scene, scene as make_scene

STATES = ("position", "orientation", "velocity", "angular_velocity")


class TraceWriter:
    """Writes a trace; use it in a with statement, which gives the file its final name when it ends well.

        with broadside.TraceWriter("mine.h5", scene, "my-engine", {"contacts": "totals"}) as trace:
            for _ in range(scene.frames):
                engine.step()
                trace.append(body={"position": x, "orientation": q, "velocity": v, "angular_velocity": w})

    scene: a Scene or its name. declaration: what the engine says of itself (core/trace/FOREIGN.md); laws are chosen by
    it. Groups and arrays are named as in core/trace/SCHEMA.md; the first frame says which groups the trace has. States
    are stored in float64 where the first position is float64, and in float32 otherwise. What a reader would refuse is
    BadInput at the call that caused it.
    """

    def __init__(self, path: str | os.PathLike[str], scene: Scene | str, engine: str,
                 declaration: Mapping[str, Any] | None = None, *, build: str = "", settings: str = "", every: int = 1,
                 broad_is_exact: bool = True, broad_margin_m: float = 0.0, notes: Mapping[str, Any] | None = None):
        self.path = os.fspath(path)
        folder = os.path.dirname(os.path.abspath(self.path))
        if not os.path.isdir(folder):
            raise BadInput(f"{self.path}: there is no folder {folder}; make it first")
        if not engine or not isinstance(engine, str):
            raise BadInput(f"{self.path}: the engine has no name; give engine=\"mine\"")
        self.scene = scene if isinstance(scene, Scene) else make_scene(scene)
        self._declaration = {key: str(value) for key, value in (declaration or {}).items()}
        native.check_declaration(self._declaration)
        self._notes = {key: str(value) for key, value in (notes or {}).items()}
        self._given = {"engine": engine, "engine_build": build, "settings": settings, "machine": native.machine_line(),
                       "every": every, "broad_is_exact": broad_is_exact, "broad_margin_m": float(broad_margin_m)}
        self._every, self._step = every, 0
        self._file, self._kinds, self._is_finished = None, {}, False

    def __enter__(self) -> TraceWriter:
        return self

    def __exit__(self, kind, error, traceback) -> None:
        if kind is None:
            self.finish()
        elif self._file is not None:
            self._file.flush()  # what was appended stays readable as PATH.part

    def append(self, step: int | None = None, *, pairs_demanded: int | None = None, pairs_raw: int | None = None,
               **groups: Any) -> int:
        """Appends a frame and returns its step: `every` more than the last one unless it is given; 1 = after the first.

        body:      position [n, 3] m, orientation [n, 4] w x y z, velocity [n, 3] m/s, angular_velocity [n, 3] rad/s.
                   Of bodies that only translate, orientation and angular_velocity may be left out.
        detection: position, velocity, boxes [n, 6] m (min x y z, max x y z); orientation where bodies turn
        pairs:     [rows, 2], i < j; pairs_demanded where there were more
        point:     a, b [rows] (faces of the domain 0xFFFFFFF0 + k), point [rows, 3] m, normal [rows, 3] from B to A,
                   gap [rows] m, impulse [rows, 3] N s on A
        Any other group of the schema likewise.
        """
        step = self._step + self._every if step is None else int(step)
        arrays = self._arrays_of(groups)
        is_first = self._file is None
        if is_first:
            self._begin(arrays)
        try:
            self._file.append(step, self._fitted(step, arrays), pairs_demanded, pairs_raw)
        except Error:
            if is_first:  # a refused frame does not say which groups the trace has
                self._file = None
                os.unlink(self.path + ".part")
            raise
        self._step = step
        return step

    def finish(self) -> None:
        """Closes the file and gives it its final name."""
        if self._is_finished:
            return
        if self._file is None:
            raise BadInput(f"{self.path}: no frame was appended; append at least one")
        self._file.finish()
        self._is_finished = True

    def _fitted(self, step, arrays):
        """Each array in the type of its column; those of no column as they are, for the file to refuse."""
        where = f"{self.path}: step {step}: "
        return {path: fitted(value, self._kinds[path], where + path) if path in self._kinds else np.asarray(value)
                for path, value in arrays.items()}

    def _arrays_of(self, groups):
        """Every array by its path in the file."""
        arrays = {}
        for group, given in groups.items():
            if group == "pairs" and not isinstance(given, dict):
                given = {"pairs": given}
            if not isinstance(given, dict):
                raise BadInput(f"{self.path}: {group} is no table of arrays; give {group}={{\"name\": array}}")
            arrays.update({f"{group}/{name}": value for name, value in given.items()})
        if "body" in groups and self.scene.motion == "translate":
            arrays.setdefault("body/orientation", self.scene.orientation)
            arrays.setdefault("body/angular_velocity", np.zeros((self.scene.body_count, 3), np.float32))
        return arrays

    def _begin(self, arrays):
        """Opens the file with the groups of the first frame."""
        known = native.groups_by_name()
        groups = 0
        for path in arrays:
            group = path if path in known else path.rpartition("/")[0]
            if group not in known:
                raise BadInput(f"{self.path}: there is no group '{group}'; one of: "
                               f"{', '.join(sorted(name for name in known if ' ' not in name and '/' not in name))}")
            groups |= known[group]
        if np.asarray(arrays.get("body/position", 0)).dtype == np.float64 and "body/position" in arrays:
            groups |= known["body in float64"]
        self._kinds = {facts["path"]: facts["dtype"] for facts in native.columns_of(groups)}
        self._file = native.Writer(self.path, self.scene, groups, self._declaration, self._notes, self._given)
