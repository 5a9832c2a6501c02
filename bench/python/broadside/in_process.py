"""Engines as objects of this process: broad phases, and dynamics step by step."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from . import native
from .arrays import fitted, host_array
from .device import CUDA, DeviceBoxes, DeviceFrame, DeviceRows, is_on_gpu
from .errors import BadInput
from .scene_builder import Scene, scene as make_scene


def _settings(settings):
    return {key: str(value) for key, value in (settings or {}).items()}


class BroadPhase:
    """Boxes in, overlapping pairs out.

    engine: an id of engines() that offers "broad". Engines on other people's libraries may abort, and would end Python:
    they are refused unless may_abort=True.
    """

    def __init__(self, engine: str = "octree-cpu", settings: Mapping[str, Any] | None = None, *,
                 may_abort: bool = False):
        self._held = native.BroadPhase(engine, _settings(settings), may_abort)
        self.id, self.build = self._held.id, self._held.build
        self.is_exact, self.margin_m = self._held.is_exact, self._held.margin_m
        self.demanded = self.raw = 0  # of the last call: pairs that there were, pairs before the filter

    def find_pairs(self, boxes: Any, is_static: Any = None) -> np.ndarray | DeviceRows:
        """Pairs [rows, 2] of uint32, sorted, i < j: closed boxes that overlap, touching included; no two static ones.

        boxes: [n, 6] float32, min x y z, max x y z, in m; of NumPy or of any library that speaks DLPack on the host.
        Packed float32 is read where it lies. is_static: [n], true for boxes that never move. A later call with as
        many boxes counts as a move of the same bodies; engines that keep their tree are fast at that.

        Boxes on a GPU (CuPy's, torch's, JAX's) are taken where they lie by octree-gpu, and the pairs stay there, in no
        order: DeviceRows. device.py says what is waited for.
        """
        if is_on_gpu(boxes):
            return self._find_on_device(DeviceBoxes(boxes), is_static)
        given = host_array(boxes, "boxes")
        if given.dtype != np.float32:
            raise BadInput(f"boxes: they are {given.dtype}, and rounding could lose a pair; "
                           "give float32, rounded outward")
        flags = None if is_static is None else fitted(is_static, np.uint8, "is_static")
        pairs, self.demanded, self.raw = self._held.find_pairs(np.ascontiguousarray(given), flags)
        return pairs

    def _find_on_device(self, boxes: DeviceBoxes, is_static: Any) -> DeviceRows:
        flags = None if is_static is None else fitted(is_static, np.uint8, "is_static")
        address, rows, device = self._held.find_pairs_on_device(boxes.address, boxes.count, boxes.stream, flags)
        self.demanded = self.raw = rows
        return DeviceRows(address, (rows, 2), "uint32", (CUDA, device), self._held)


def find_pairs(boxes: Any, is_static: Any = None, engine: str = "octree-cpu") -> np.ndarray | DeviceRows:
    """The pairs of boxes that overlap, once; BroadPhase keeps the engine for many calls."""
    return BroadPhase(engine).find_pairs(boxes, is_static)


class State:
    """What an engine said after a step: state["body/position"] is a read-only view [n, 3] of the engine's answer."""

    def __init__(self, held):
        self._held = held
        self.step, self.time_s, self.digest = held.step, held.time_s, held.digest

    def __getitem__(self, path: str) -> np.ndarray:
        return self._held.rows(path)


class Dynamics:
    """A simulation step by step.

        world = broadside.Dynamics("plain-rigid", "rigid:stack:5")
        world.step(60)
        heights_m = world.read()["body/position"][:, 1]
    """

    def __init__(self, engine: str, scene: Scene | str, settings: Mapping[str, Any] | None = None, *,
                 may_abort: bool = False):
        self.scene = scene if isinstance(scene, Scene) else make_scene(scene)
        self._held = native.Dynamics(engine, self.scene, _settings(settings), may_abort)
        self.id, self.build, self.declaration = self._held.id, self._held.build, self._held.declaration

    @property
    def steps_done(self) -> int:
        return self._held.steps_done

    def step(self, count: int = 1) -> None:
        """Advances by `count` steps of the scene's dt_s."""
        self._held.step(count)

    def read_on_device(self) -> DeviceFrame:
        """States, pairs and points of a GPU engine where they lie, until its next step; complete for every stream.

        By the names of a trace's columns: body/position and body/velocity [n, 3] float32 and pairs/pairs [rows, 2]
        always; where bodies turn also body/orientation [n, 4], body/angular_velocity, confirmed/pairs and point/*
        (point/gap, point/a, point/b and point/feature are [rows, 1]). Bodies are in the scene's order, pairs and points
        in none. Where bodies turn the first call after a step writes the columns, and others give the same.
        """
        columns, device = self._held.frame_on_device()
        return DeviceFrame(columns, device, self._held)

    def read(self) -> State:
        """The State after the last step; its arrays stay as they are when the engine goes on."""
        return State(self._held.read())


def engines() -> list[dict[str, Any]]:
    """Every engine: id, capabilities, what it is, its settings, and why it is absent here ("" = it is not)."""
    return native.engine_rows()
