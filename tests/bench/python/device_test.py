"""Arrays by address: DLPack's capsules on the host, and boxes and pairs on a GPU where there is one.

Without CuPy, torch or JAX the test gets GPU memory from CUDA's driver itself, so a machine with a GPU is enough.
"""

import ctypes
import gc
import importlib.util
import sys
import time

import numpy as np
import pytest

import broadside
from broadside import native
from broadside.device import CUDA, HOST, LEGACY_STREAM, DeviceBoxes, DeviceFrame, DeviceRows

from engines_test import boxes_of, overlapping


def address(array):
    return array.__array_interface__["data"][0]


# --- on the host: the same code, with memory that NumPy can read ------------------------------------------------------

def test_a_capsule_is_read_where_it_lies():
    boxes = boxes_of(5)
    taken = native.TakenArray(boxes.__dlpack__(), "boxes")
    assert (taken.address, taken.shape, taken.type, taken.memory) == (address(boxes), [5, 6], "<f4", HOST)


def test_a_capsule_keeps_its_array_alive_and_lets_it_go():
    boxes = boxes_of(5)
    before = sys.getrefcount(boxes)
    taken = native.TakenArray(boxes.__dlpack__(), "boxes")
    assert sys.getrefcount(boxes) == before + 1
    del taken
    assert sys.getrefcount(boxes) == before


def test_a_capsule_is_taken_once():
    capsule = boxes_of(5).__dlpack__()
    native.TakenArray(capsule, "boxes")
    with pytest.raises(broadside.BadInput, match="boxes: it is no capsule of DLPack, or was taken before"):
        native.TakenArray(capsule, "boxes")


def test_a_capsule_with_gaps_is_refused():
    with pytest.raises(broadside.BadInput, match="boxes: its rows have gaps"):
        native.TakenArray(boxes_of(5)[::2].__dlpack__(), "boxes")
    assert native.TakenArray(boxes_of(5)[:1].__dlpack__(), "boxes").shape == [1, 6]


def test_rows_are_given_without_a_copy_and_keep_their_owner():
    pairs = np.array([[0, 1], [2, 3]], np.uint32)
    before = sys.getrefcount(pairs)
    rows = DeviceRows(address(pairs), pairs.shape, "uint32", (HOST, 0), pairs)
    seen = np.from_dlpack(rows)
    assert (address(seen), seen.tolist(), seen.dtype) == (address(pairs), pairs.tolist(), np.uint32)
    del rows
    gc.collect()
    assert sys.getrefcount(pairs) == before + 1, "the array that was made of it still needs it"
    del seen
    gc.collect()
    assert sys.getrefcount(pairs) == before


def test_rows_with_other_numbers_between_them():
    """The layout of states on the GPU: three floats, and a fourth that means something else."""
    packed = np.arange(12, dtype=np.float32).reshape(3, 4)
    seen = np.from_dlpack(DeviceRows(address(packed), (3, 3), "float32", (HOST, 0), packed, 16))
    assert address(seen) == address(packed) and np.array_equal(seen, packed[:, :3])


def test_rows_are_packed_with_what_lies_between_them():
    table = np.arange(12, dtype=np.float32).reshape(3, 4)
    rows = DeviceRows(address(table), (3, 3), "float32", (HOST, 0), table, 16)
    seen = np.from_dlpack(rows.padded)
    assert address(seen) == address(table) and np.array_equal(seen, table)
    assert DeviceRows(address(table), (3, 4), "float32", (HOST, 0), table).padded.shape == (3, 4)


def test_a_frame_makes_rows_when_they_are_asked_for():
    table = np.arange(12, dtype=np.float32).reshape(3, 4)
    at = address(table)
    frame = DeviceFrame({"body/orientation": (at, 3, 4, 16, True), "point/a": (at, 3, 1, 16, False)}, 0, table)
    assert list(frame) == ["body/orientation", "point/a"] and len(frame) == 2 and "point/b" not in frame
    rows = frame["point/a"]
    assert (rows.shape, rows.dtype, rows.__dlpack_device__()) == ((3, 1), "uint32", (CUDA, 0))
    facts = frame["body/orientation"].__cuda_array_interface__
    assert (facts["data"], facts["strides"], facts["typestr"]) == ((at, True), (16, 4), "<f4")
    assert not hasattr(DeviceRows(at, (3, 4), "float32", (HOST, 0), table), "__cuda_array_interface__")


def test_states_of_the_host_are_not_on_a_device():
    says = r"plain-rigid: its states are in the host's memory; read\(\) gives them"
    with pytest.raises(broadside.BadInput, match=says):
        broadside.Dynamics("plain-rigid", "rigid:stack:5").read_on_device()


def test_a_capsule_that_nobody_takes_is_let_go():
    pairs = np.zeros((1, 2), np.uint32)
    before = sys.getrefcount(pairs)
    for _ in range(3):
        native.given_rows(address(pairs), 1, 2, 8, False, HOST, 0, pairs)
    gc.collect()
    assert sys.getrefcount(pairs) == before


class Interface:
    """The interface by which a library describes an array on a GPU."""

    def __init__(self, **facts):
        usual = {"shape": (7, 6), "typestr": "<f4", "data": (4096, False), "version": 3}
        self.__cuda_array_interface__ = {**usual, **facts}


def test_what_boxes_on_a_gpu_say_of_themselves():
    assert DeviceBoxes(Interface()).stream is None
    assert DeviceBoxes(Interface(stream=2)).stream == 2
    assert DeviceBoxes(Interface(version=2)).stream == LEGACY_STREAM, "version 2 names no stream"
    assert (DeviceBoxes(Interface(strides=(24, 4))).count, DeviceBoxes(Interface()).address) == (7, 4096)
    for facts, says in (({"typestr": "<f8"}, "they are <f8"), ({"shape": (7, 3)}, r"boxes of shape \(7, 3\)"),
                        ({"shape": (42,)}, r"boxes of shape \(42,\)"), ({"strides": (48, 4)}, "pack them")):
        with pytest.raises(broadside.BadInput, match=says):
            DeviceBoxes(Interface(**facts))


def test_a_call_by_dlpack_is_short():
    """Printed, not judged: no test measures time against a limit."""
    pairs = np.zeros((1000, 2), np.uint32)
    rows, count = DeviceRows(address(pairs), pairs.shape, "uint32", (HOST, 0), pairs), 2000
    start = time.perf_counter()
    for _ in range(count):
        np.from_dlpack(rows)
    print(f"from_dlpack: {1e6 * (time.perf_counter() - start) / count:.2f} us a call")


# --- on a GPU ---------------------------------------------------------------------------------------------------------

HAS_GPU = not next(row for row in broadside.engines() if row["id"] == "octree-gpu")["absent"]
on_gpu = pytest.mark.skipif(not HAS_GPU, reason="no device, or the package was built without CUDA")


class DriverMemory:
    """Bytes of the GPU, by CUDA's driver, in the context that CUDA's runtime uses too."""

    def __init__(self, array):
        self.cuda = ctypes.CDLL("libcuda.so.1")
        context, self.address = ctypes.c_void_p(), ctypes.c_uint64()
        self.call("cuInit", 0)
        self.call("cuDevicePrimaryCtxRetain", ctypes.byref(context), 0)
        self.call("cuCtxSetCurrent", context)
        self.call("cuMemAlloc_v2", ctypes.byref(self.address), ctypes.c_size_t(max(array.nbytes, 1)))
        self.write(array)
        self.__cuda_array_interface__ = {"shape": array.shape, "typestr": array.dtype.str, "version": 2,
                                         "data": (self.address.value, False)}

    def call(self, name, *arguments):
        assert getattr(self.cuda, name)(*arguments) == 0, name

    def write(self, array):
        self.call("cuMemcpyHtoD_v2", self.address, ctypes.c_void_p(address(array)), ctypes.c_size_t(array.nbytes))

    def read(self, where, shape, dtype=np.uint32):
        rows = np.empty(shape, dtype)
        to, size = ctypes.c_void_p(address(rows)), ctypes.c_size_t(rows.nbytes)
        self.call("cuMemcpyDtoH_v2", to, ctypes.c_uint64(where), size)
        return rows


def in_order(pairs):
    return pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]


@on_gpu
@pytest.mark.parametrize("count", [100, 3000, 60000])
def test_boxes_and_pairs_stay_on_the_gpu(count):
    scale = np.float32(1.0 if count < 10000 else 0.2)
    broad, host = broadside.BroadPhase("octree-gpu"), broadside.BroadPhase("octree-cpu")
    memory = None
    for seed in (1, 2, 3):
        boxes = boxes_of(count, seed)
        boxes[:, 3:] = boxes[:, :3] + scale * (boxes[:, 3:] - boxes[:, :3])
        memory = memory or DriverMemory(boxes)
        memory.write(boxes)
        rows = broad.find_pairs(memory)
        there = memory.read(rows.__cuda_array_interface__["data"][0], rows.shape)
        assert np.array_equal(in_order(there), host.find_pairs(boxes)) and len(there) > 0
    assert np.array_equal(broad.find_pairs(boxes), host.find_pairs(boxes)), "boxes of the host, by the same engine"


@on_gpu
@pytest.mark.parametrize("scene", ["freefall:sphere:50", "freefall:cube:50[rigid=1]"])
def test_frames_stay_on_the_gpu(scene):
    world = broadside.Dynamics("octree-gpu", scene)
    memory = DriverMemory(np.zeros(1, np.uint32))

    def rows_of(column, dtype):
        facts = column.__cuda_array_interface__
        packed = memory.read(facts["data"][0], (facts["shape"][0], facts["strides"][0] // 4), dtype)
        return packed[:, :facts["shape"][1]]

    for _ in range(3):
        world.step(20)
        there, state = world.read_on_device(), world.read()
        for path in there:
            if path.startswith("body/"):
                assert np.array_equal(rows_of(there[path], np.float32), state[path]), path
        assert np.array_equal(in_order(rows_of(there["pairs/pairs"], np.uint32)), state["pairs/pairs"])
        assert ("point/gap" in there) == ("rigid" in scene)
        if "point/gap" in there:
            assert np.array_equal(np.sort(rows_of(there["point/gap"], np.float32)[:, 0]), np.sort(state["point/gap"]))
    assert "point/gap" not in there or len(there["point/gap"]) > 0


@on_gpu
def test_bad_boxes_on_the_gpu_are_refused_by_number():
    boxes = boxes_of(100)
    boxes[61, 1] = np.nan
    with pytest.raises(broadside.BadInput, match="box 61: a box has min > max, or is NaN or infinite"):
        broadside.BroadPhase("octree-gpu").find_pairs(DriverMemory(boxes))


class Library:
    """How one library puts an array on the GPU, takes rows of it, and gives its address."""

    def __init__(self, name):
        if importlib.util.find_spec(name) is None:
            pytest.skip(f"{name} is not installed")
        module = importlib.import_module(name)
        if name == "cupy":
            self.put, self.take, self.to_host = module.asarray, module.asarray, module.asnumpy
            self.place = lambda array: array.data.ptr
            self.ways = {"cupy.asarray(rows)": module.asarray, "cupy.from_dlpack(rows)": module.from_dlpack}
        elif name == "torch":
            self.put, self.take = (lambda array: module.from_numpy(array).cuda()), module.from_dlpack
            self.place, self.to_host = (lambda array: array.data_ptr()), (lambda array: array.cpu().numpy())
            self.ways = {"torch.from_dlpack(rows)": module.from_dlpack,
                         "torch.from_dlpack(rows.__dlpack__())": lambda rows: module.from_dlpack(rows.__dlpack__())}
        else:
            self.put, self.place = module.device_put, (lambda array: array.unsafe_buffer_pointer())
            self.take, self.to_host = importlib.import_module("jax.dlpack").from_dlpack, np.asarray
            self.ways = {"jax.dlpack.from_dlpack(rows)": self.take}


def microseconds(call, count=500, batches=5):
    """A call's time, the least of some batches: other work on the machine only adds to it."""
    least = float("inf")
    for _ in range(batches):
        start = time.perf_counter()
        for _ in range(count):
            call()
        least = min(least, time.perf_counter() - start)
    return 1e6 * least / count


@on_gpu
@pytest.mark.parametrize("library", ["cupy", "torch", "jax"])
def test_other_libraries_see_the_same_addresses(library):
    with_it = Library(library)
    boxes, broad = boxes_of(3000), broadside.BroadPhase("octree-gpu")
    given = with_it.put(boxes)
    assert DeviceBoxes(given).address == with_it.place(given)
    rows = broad.find_pairs(given)
    for way, take in with_it.ways.items():
        seen = take(rows)
        assert with_it.place(seen) == rows.__cuda_array_interface__["data"][0], way
        assert np.array_equal(in_order(with_it.to_host(seen)), overlapping(boxes)), way
        print(f"{way}: {microseconds(lambda take=take: take(rows)):.2f} us a call")
    print(f"{library}: this package's part, device and capsule: "
          f"{microseconds(lambda: (rows.__dlpack_device__(), rows.__dlpack__(stream=LEGACY_STREAM))):.2f} us a call; "
          f"boxes taken: {microseconds(lambda: DeviceBoxes(given)):.2f} us; DLPack kind {CUDA}")


@on_gpu
@pytest.mark.parametrize("scene", ["freefall:sphere:50", "freefall:cube:50[rigid=1]"])
@pytest.mark.parametrize("library", ["cupy", "torch", "jax"])
def test_other_libraries_see_the_frames_addresses(library, scene):
    with_it = Library(library)
    world = broadside.Dynamics("octree-gpu", scene)
    world.step(60)
    there, state = world.read_on_device(), world.read()
    for path, rows in there.items():
        seen = with_it.take(rows.padded if library == "jax" else rows)
        assert with_it.place(seen) == rows.__cuda_array_interface__["data"][0], path
        if path.startswith("body/"):
            assert np.array_equal(with_it.to_host(seen)[:, :rows.shape[1]], state[path]), path
        elif path in ("pairs/pairs", "confirmed/pairs"):
            assert np.array_equal(in_order(with_it.to_host(seen)), state[path]), path
        elif path == "point/gap":
            assert np.array_equal(np.sort(with_it.to_host(seen)[:, 0]), np.sort(state[path])), path
    assert ("point/gap" in there) == ("rigid" in scene)
    first = []
    for _ in range(50):
        world.step()
        start = time.perf_counter()
        world.read_on_device()
        first.append(1e6 * (time.perf_counter() - start))
    print(f"{scene}: read_on_device, {len(there)} columns: {min(first):.2f} us after a step "
          f"(median {np.median(first):.2f}), {microseconds(world.read_on_device):.2f} us again; "
          f"a column made and taken: {microseconds(lambda: with_it.take(there['pairs/pairs'])):.2f} us")
