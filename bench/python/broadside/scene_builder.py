"""Scenes: by name, from a file, or built here with the words of scene files (datasets/README.md)."""

from __future__ import annotations

import os
import struct
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from . import native
from .errors import Error

Scene = native.Scene


def scene(what: str | os.PathLike[str] | SceneBuilder, *, frames: int | None = None, seed: int | None = None,
          allow_stand_in: bool = False) -> Scene:
    """The Scene of a name ("freefall:bunny:50"), the path of a .toml, .gltf or .glb file, or a SceneBuilder.

    frames and seed replace the scene's own. allow_stand_in: a procedural body of the same size where a mesh is not on
    this machine. Unknown names are BadInput with the nearest known one.
    """
    if isinstance(what, SceneBuilder):
        return what.build(frames=frames, seed=seed)
    return native.make_scene(os.fspath(what), frames, seed, allow_stand_in)


def scenes() -> list[tuple[str, str, str]]:
    """(pattern, example, what it is) of every built-in family."""
    return [tuple(row) for row in native.scene_names()]


def _toml(value):
    """A value as TOML writes it. Numbers keep every digit."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, str):
        escaped = "".join(f"\\u{ord(c):04x}" if ord(c) < 32 or c in '"\\' or ord(c) == 127 else c for c in value)
        return f'"{escaped}"'
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {_toml(item)}" for key, item in value.items()) + " }"
    return "[" + ", ".join(_toml(item) for item in np.asarray(value).tolist()) + "]"


class SceneBuilder:
    """Builds a scene. Every keyword is a key of scene files, so the same scene in TOML has the same digest.

        box = broadside.SceneBuilder(name="brick", frames=240, dt_s=1 / 240, motion="rigid",
                                     gravity_m_s2=[0, -9.81, 0])
        box.domain(min_m=[-4, 0, -4], max_m=[4, 8, 4])
        box.mesh("brick", shape="box", sides_m=[0.2, 0.4, 0.6])
        box.body(mesh="brick", position_m=[0, 1, 0], mass_kg=2.0)
        scene = box.build()
    """

    def __init__(self, **scalars: Any):
        self._scalars, self._tables, self._lists, self._triangles = scalars, {}, [], {}

    def domain(self, **keys: Any) -> SceneBuilder:
        """min_m, max_m: the box whose faces are static half-spaces, in m."""
        return self._table("domain", keys)

    def parameters(self, **keys: Any) -> SceneBuilder:
        """delta_m, v_threshold_m_s and the others of the method."""
        return self._table("parameters", keys)

    def material(self, **keys: Any) -> SceneBuilder:
        """mu_static, mu_kinetic, restitution of bodies that do not say their own."""
        return self._table("material", keys)

    def face_material(self, **keys: Any) -> SceneBuilder:
        """The same of the domain's faces."""
        return self._table("face_material", keys)

    def generator(self, **keys: Any) -> SceneBuilder:
        """kind, count, mesh and the options of a family."""
        return self._table("generator", keys)

    def mesh(self, name: str, vertices: Any = None, triangles: Any = None, **keys: Any) -> SceneBuilder:
        """A mesh by shape, file or catalogue; or of arrays: vertices [n, 3] in m, triangles [m, 3] of their indices."""
        if vertices is not None:
            self._triangles[name] = (np.ascontiguousarray(vertices, "<f4"), np.ascontiguousarray(triangles, "<i4"))
            keys["file"] = f"{len(self._triangles)}.ply"
        return self._row("mesh", {"name": name, **keys})

    def body(self, **keys: Any) -> SceneBuilder:
        """mesh, position_m, velocity_m_s, orientation_wxyz, angular_velocity_rad_s, mass_kg or static, material."""
        return self._row("body", keys)

    def spring(self, **keys: Any) -> SceneBuilder:
        """body, anchor_m, stiffness_n_m, damping_n_s_m."""
        return self._row("spring", keys)

    def wrench(self, **keys: Any) -> SceneBuilder:
        """body, force_n, torque_n_m, axes."""
        return self._row("wrench", keys)

    def toml(self) -> str:
        """The scene file's text."""
        lines = [f"{key} = {_toml(value)}" for key, value in self._scalars.items()]
        for name, keys in self._tables.items():
            lines += [f"[{name}]", *(f"{key} = {_toml(value)}" for key, value in keys.items())]
        for name, keys in self._lists:
            lines += [f"[[{name}]]", *(f"{key} = {_toml(value)}" for key, value in keys.items())]
        return "\n".join(lines) + "\n"

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the scene file, and meshes of arrays beside it."""
        path = Path(path)
        for k, mesh in enumerate(self._triangles.values(), start=1):
            (path.parent / f"{k}.ply").write_bytes(_ply(*mesh))
        path.write_text(self.toml(), encoding="utf-8")

    def build(self, *, frames: int | None = None, seed: int | None = None) -> Scene:
        """The Scene. Errors name the line of toml()."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "scene.toml")
            self.save(path)
            try:
                return native.make_scene(path, frames, seed, False)
            except Error as error:
                raise type(error)(str(error).replace(folder + os.sep, "")) from None

    def _table(self, name, keys):
        self._tables[name] = {**self._tables.get(name, {}), **keys}
        return self

    def _row(self, name, keys):
        self._lists.append((name, keys))
        return self


def _ply(vertices, triangles):
    """Binary PLY: a header, three float32 a vertex, a count and three int32 a triangle."""
    header = ("ply\nformat binary_little_endian 1.0\n"
              f"element vertex {len(vertices)}\nproperty float x\nproperty float y\nproperty float z\n"
              f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
    faces = b"".join(struct.pack("<B3i", 3, *row) for row in triangles.tolist())
    return header.encode() + vertices.tobytes() + faces
