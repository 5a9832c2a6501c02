"""Traces: what an engine did, frame by frame. Columns have the names, shapes and units of core/trace/SCHEMA.md."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import Any

import numpy as np

from . import native, tables


class Column:
    """One array of a trace, which is read when it is asked for.

    column[k] is that of frame k, a view of the frame; column[a:b] and np.asarray(column) are those of many frames as
    they lie in the file: [frames, bodies, width] of states, [rows, width] of pairs, points and contacts, whose frame k
    has the rows offsets[k] to offsets[k + 1] - 1.
    """

    def __init__(self, trace, facts):
        self._trace = trace
        self.path: str = facts["path"]
        self.layout: str = facts["layout"]  # frames, bodies, rows, offsets or windows
        self.dtype: np.dtype = facts["dtype"]
        self.width: int = facts["width"]
        self.unit: str = facts["unit"]  # "1" = a pure number
        self._groups = facts["groups"]

    def __repr__(self) -> str:
        return f"<column {self.path}: {self.layout}, {self.dtype} x {self.width}, unit {self.unit}>"

    def __len__(self) -> int:
        return len(self._trace)

    def __array__(self, dtype=None) -> np.ndarray:
        whole = self._trace._file.whole(self.path)
        return whole if dtype is None else whole.astype(dtype)

    def __getitem__(self, key: Any) -> np.ndarray:
        by_frame = self.layout in ("bodies", "rows", "frames")
        if by_frame and isinstance(key, (int, np.integer)):
            return self._trace[int(key)][self.path]
        if by_frame and isinstance(key, slice) and key != slice(None):
            frames = [self._trace[k][self.path] for k in range(*key.indices(len(self)))]
            if self.layout == "rows":
                return np.concatenate(frames) if frames else np.asarray(self)[:0]
            return np.stack(frames) if frames else np.asarray(self)[:0]
        return np.asarray(self)[key]


class Frame:
    """One recorded step. frame["body/position"] is a read-only view [bodies, 3], frame["point/gap"] one [rows]."""

    def __init__(self, trace, index):
        self._trace, self.index, self._parts = trace, index, {}
        self._bare = trace._file.read(index, 0)
        self.step, self.time_s, self.digest = self._bare.step, self._bare.time_s, self._bare.digest

    def __repr__(self):
        return f"<frame {self.index}: step {self.step}, {self.time_s:g} s>"

    def __getitem__(self, path: str) -> np.ndarray:
        groups = self._trace.column(path)._groups
        if groups not in self._parts:
            self._parts[groups] = self._trace._file.read(self.index, groups) if groups else self._bare
        return self._parts[groups].rows(path)


class Trace:
    """A trace file, also one that is still written (.h5.part). Opening reads none of its frames.

    len(trace) frames; trace[k] is a Frame, trace["body/position"] a Column; trace.frame(step) is that of a step.
    """

    def __init__(self, path: str | os.PathLike[str]):
        self.path = os.fspath(path)
        self._file = native.Trace(self.path)
        header = self._file.header
        self.engine, self.label, self.settings = header["engine"], header["label"], header["settings"]
        self.engine_build, self.machine = header["engine_build"], header["machine"]
        self.declaration, self.notes = header["declaration"], header["notes"]
        self.every, self.driver = header["every"], header["driver"]
        self.scene = self._file.scene
        self.steps = self._file.steps  # [frames], rising
        self._columns = {facts["path"]: Column(self, facts) for facts in self._file.columns()}

    def __repr__(self):
        return (f"<trace {self.path}: {self.label} on {self.scene.name}, "
                f"{len(self)} frames of {self.scene.body_count} bodies>")

    def __len__(self) -> int:
        return len(self._file)

    def __iter__(self) -> Iterator[Frame]:
        return (self[k] for k in range(len(self)))

    def __getitem__(self, key: int | str) -> Any:
        if isinstance(key, str):
            return self.column(key)
        index = int(key)
        if not -len(self) <= index < len(self):
            raise IndexError(f"there is no frame {key}; it has {len(self)} frames")
        return Frame(self, index % len(self))

    @property
    def columns(self) -> dict[str, Column]:
        """Every column that the trace has, by path."""
        return dict(self._columns)

    def column(self, path: str) -> Column:
        """The column of this path; an unknown one is BadInput with the nearest."""
        if path not in self._columns:
            self._file.whole(path)  # says what is wrong with the path
        return self._columns[path]

    def frame(self, step: int) -> Frame:
        """The frame of this step."""
        index = int(np.searchsorted(self.steps, step))
        if index == len(self) or self.steps[index] != step:
            raise IndexError(f"step {step} was not recorded; there are {len(self)} frames")
        return self[index]

    @property
    def times_s(self) -> np.ndarray:
        """[frames] step * dt."""
        return np.asarray(self["time"])

    @property
    def digests(self) -> np.ndarray:
        """[frames] of 64 bits: equal digests are bit-identical frames."""
        return np.asarray(self["digest"])

    def to_pandas(self, group: str = "body") -> Any:
        """A DataFrame of one group: a row a step and body, or a step and row. Needs pandas."""
        return tables.data_frame(self, group)

    def to_xarray(self) -> Any:
        """A Dataset of all columns with units; dimensions step, body, and a dimension of rows a group. Needs xarray."""
        return tables.dataset(self)
