"""Arrays on a GPU: boxes that are taken where they lie, pairs and states that stay where they were found.

Streams. Boxes are read after the work that was in their stream before the call. This is the stream that
__cuda_array_interface__ names; the legacy default stream where it is of version 2, which names none; no stream where it
names None, and then the boxes must be complete. By DLPack their owner is asked for boxes that are complete on the
legacy default stream. Pairs and states are complete when the call returns, and any stream may read them. They are the
engine's memory: its next call writes there again, so work that reads them must have ended by then.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from . import native
from .errors import BadInput

HOST, CUDA, CUDA_HOST = 1, 2, 3  # DLPack's kinds of memory
LEGACY_STREAM = 1


def is_on_gpu(value: Any) -> bool:
    """Whether this is an array whose numbers the CPU cannot read."""
    if hasattr(value, "__cuda_array_interface__"):
        return True
    return hasattr(value, "__dlpack_device__") and value.__dlpack_device__()[0] not in (HOST, CUDA_HOST)


class DeviceBoxes:
    """Boxes [n, 6] float32 on a GPU: address, count, and the stream that they come after. Keeps them alive."""

    def __init__(self, value: Any):
        if hasattr(value, "__cuda_array_interface__"):
            facts = value.__cuda_array_interface__
            shape, kind, strides = tuple(facts["shape"]), facts["typestr"], facts.get("strides")
            self.address = facts["data"][0]
            self.stream = facts.get("stream") if facts["version"] >= 3 else LEGACY_STREAM
            self._owner = value
            if strides is not None and tuple(strides) != (24, 4) and shape[:1] != (0,):
                raise BadInput(f"boxes: their strides are {tuple(strides)} bytes; "
                               "pack them, such as cupy.ascontiguousarray(x)")
        else:
            self._owner = native.TakenArray(value.__dlpack__(stream=LEGACY_STREAM), "boxes")
            if self._owner.memory != CUDA:
                raise BadInput(f"boxes: they are on a device of DLPack's kind {self._owner.memory}; give CUDA's memory")
            shape, kind = tuple(self._owner.shape), self._owner.type
            self.address, self.stream = self._owner.address, LEGACY_STREAM
        if kind != "<f4":
            raise BadInput(f"boxes: they are {kind}, and rounding could lose a pair; give float32, rounded outward")
        if len(shape) != 2 or shape[1] != 6:
            raise BadInput(f"boxes of shape {shape}; give [n, 6]: min x y z, max x y z")
        self.count = shape[0]


class DeviceRows:
    """Rows [n, width] in an engine's memory, of uint32 or float32: cupy.asarray(rows), torch.from_dlpack(rows).

    Nothing is copied. Valid until the engine's next call; keeps the engine alive.
    """

    __slots__ = ("shape", "dtype", "_address", "_place", "_owner", "_row_bytes")

    def __init__(self, address: int, shape: tuple[int, int], dtype: str, place: tuple[int, int], owner: Any,
                 row_bytes: int | None = None):
        self.shape, self.dtype, self._address, self._place, self._owner = shape, dtype, address, place, owner
        self._row_bytes = row_bytes or 4 * shape[1]

    @property
    def __cuda_array_interface__(self) -> dict[str, Any]:
        if self._place[0] != CUDA:
            raise AttributeError("rows in the host's memory have no __cuda_array_interface__")
        return {"shape": self.shape, "typestr": "<u4" if self.dtype == "uint32" else "<f4",
                "data": (self._address, True), "strides": (self._row_bytes, 4), "version": 3, "stream": None}

    @property
    def padded(self) -> DeviceRows:
        """The rows with what lies between them, [n, bytes of a row / 4]: JAX takes packed rows alone.

        States of bodies that translate have a fourth number, jax.dlpack.from_dlpack(rows.padded)[:, :3]; other rows are
        packed already.
        """
        return DeviceRows(self._address, (self.shape[0], self._row_bytes // 4), self.dtype, self._place, self._owner)

    def __len__(self) -> int:
        return self.shape[0]

    def __repr__(self) -> str:
        return f"<rows {self.shape} of {self.dtype} at {self._address:#x}, DLPack device {self._place}>"

    def __dlpack_device__(self) -> tuple[int, int]:
        return self._place

    def __dlpack__(self, *, stream: Any = None, **newer: Any) -> Any:
        """A capsule; the rows are complete on every stream, so none is waited for."""
        is_float = self.dtype == "float32"
        return native.given_rows(self._address, *self.shape, self._row_bytes, is_float, *self._place, self)


class DeviceFrame(Mapping[str, DeviceRows]):
    """Columns of a frame on a GPU by name; rows are made when they are asked for, so that few cost little."""

    __slots__ = ("_columns", "_place", "_owner")

    def __init__(self, columns: dict[str, tuple], device: int, owner: Any):
        self._columns, self._place, self._owner = columns, (CUDA, device), owner

    def __getitem__(self, path: str) -> DeviceRows:
        address, rows, width, row_bytes, is_float = self._columns[path]
        kind = "float32" if is_float else "uint32"
        return DeviceRows(address, (rows, width), kind, self._place, self._owner, row_bytes)

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __repr__(self) -> str:
        return f"<frame on DLPack device {self._place}: {', '.join(self._columns)}>"
