"""Engines as objects. Pairs are compared with those that NumPy finds by the definition; motion with free fall."""

import numpy as np
import pytest

import broadside

from conftest import DT_S, GRAVITY_M_S2, falling_scene


def boxes_of(count, seed=1):
    draw = np.random.default_rng(seed)
    low = draw.random((count, 3), np.float32)
    return np.concatenate([low, low + np.float32(0.1) * draw.random((count, 3), np.float32)], axis=1)


def overlapping(boxes, is_static=None):
    """Closed boxes that overlap on all three axes, i < j."""
    low, high = boxes[:, :3], boxes[:, 3:]
    hit = ((low[:, None] <= high[None]) & (low[None] <= high[:, None])).all(axis=2)
    if is_static is not None:
        hit &= ~(is_static[:, None] & is_static[None])
    return np.argwhere(np.triu(hit, 1)).astype(np.uint32)


@pytest.mark.parametrize("engine", ["octree-cpu", "hash-cpu", "all-pairs"])
def test_pairs_are_those_of_the_definition(engine):
    broad = broadside.BroadPhase(engine, may_abort=engine == "all-pairs")
    for seed in (1, 2):
        boxes = boxes_of(400, seed)
        pairs = broad.find_pairs(boxes)
        assert pairs.dtype == np.uint32 and np.array_equal(pairs, overlapping(boxes))
        assert len(pairs) > 20 and broad.demanded == len(pairs)
    assert np.array_equal(broad.find_pairs(boxes_of(50)), overlapping(boxes_of(50))), "another number of boxes"


def test_touching_counts_and_two_static_boxes_are_no_pair():
    boxes = np.array([[0, 0, 0, 1, 1, 1], [1, 0, 0, 2, 1, 1], [1, 1, 1, 2, 2, 2]], np.float32)
    assert broadside.find_pairs(boxes).tolist() == [[0, 1], [0, 2], [1, 2]]
    assert broadside.find_pairs(boxes, is_static=[True, True, False]).tolist() == [[0, 2], [1, 2]]
    assert broadside.find_pairs(np.zeros((0, 6), np.float32)).shape == (0, 2)


def address(array):
    return array.__array_interface__["data"][0]


class Elsewhere:
    """An array of another library on the host: DLPack alone."""

    def __init__(self, array):
        self.array, self.asked = array, 0

    def __dlpack__(self, **more):
        self.asked += 1
        return self.array.__dlpack__(**more)

    def __dlpack_device__(self):
        return self.array.__dlpack_device__()


class OnDevice:
    """The interface by which CuPy, torch and JAX describe an array on a GPU."""

    __cuda_array_interface__ = {"shape": (1, 6), "typestr": "<f4", "data": (4096, False), "version": 3}


def test_boxes_of_another_library_are_read_where_they_lie():
    from broadside.arrays import host_array

    boxes = boxes_of(64)
    given = Elsewhere(boxes)
    assert address(host_array(given, "boxes")) == address(boxes)
    assert np.array_equal(broadside.find_pairs(given), overlapping(boxes)) and given.asked == 2
    assert host_array(boxes, "boxes") is boxes


def test_pairs_and_states_are_given_without_a_copy():
    pairs = broadside.find_pairs(boxes_of(64))
    assert address(np.from_dlpack(pairs)) == address(pairs)
    assert not pairs.flags.owndata, "the engine's own memory"
    world = broadside.Dynamics("plain-rigid", "rigid:stack:5")
    world.step(3)
    state = world.read()
    first, second = state["point/impulse"], state["point/impulse"]
    assert address(first) == address(second) and len(first) > 0
    world.step()
    assert np.array_equal(first, second) and world.read().step == 4, "a state stays when the engine goes on"


def test_what_is_on_a_device_is_not_fetched_in_silence():
    with pytest.raises(broadside.BadInput, match="octree-cpu: the boxes are on a GPU, and it reads the host's memory"):
        broadside.find_pairs(OnDevice())
    with pytest.raises(broadside.BadInput, match="is_static: it is on a GPU"):
        broadside.find_pairs(boxes_of(1), is_static=OnDevice())


def test_dynamics_step_by_step():
    world = broadside.Dynamics("plain-rigid", falling_scene().build())
    world.step(10)
    state = world.read()
    assert (world.steps_done, state.step) == (10, 10)
    assert state["body/velocity"][0, 1] == -10 * GRAVITY_M_S2 * DT_S
    # plain-rigid falls exactly: y = y0 - g t^2 / 2, and the product is exact for these powers of two.
    assert state["body/position"][0, 1] == 50.0 - GRAVITY_M_S2 * (10 * DT_S) ** 2 / 2
    assert world.declaration["motion"] == "rigid"


def test_states_are_those_of_a_recorded_run(tmp_path):
    trace = broadside.run("rigid:stack:5", "plain-rigid", out=tmp_path, frames=6)[0]
    world = broadside.Dynamics("plain-rigid", "rigid:stack:5")
    for frame in trace:
        world.step()
        state = world.read()
        assert state.digest == frame.digest
        assert np.array_equal(state["body/position"], frame["body/position"])


def test_errors():
    with pytest.raises(broadside.BadInput, match="may abort, and Python with it"):
        broadside.BroadPhase("fcl-tree")
    assert broadside.BroadPhase("fcl-tree", may_abort=True).find_pairs(boxes_of(50)).shape[1] == 2
    with pytest.raises(broadside.BadInput, match="it offers no broad phase"):
        broadside.BroadPhase("plain-rigid")
    with pytest.raises(broadside.BadInput, match="none is loaded into Python"):
        broadside.BroadPhase("./libmine.so")
    with pytest.raises(broadside.BadInput, match="unknown engine 'octree-cp'; did you mean 'octree-cpu'"):
        broadside.BroadPhase("octree-cp")
    with pytest.raises(broadside.BadInput, match="no step was made"):
        broadside.Dynamics("plain-rigid", "rigid:stack:5").read()
    broad = broadside.BroadPhase()
    with pytest.raises(broadside.BadInput, match="give float32, rounded outward"):
        broad.find_pairs(boxes_of(4).astype(np.float64))
    with pytest.raises(broadside.BadInput, match=r"boxes of shape \(4, 3\)"):
        broad.find_pairs(np.zeros((4, 3), np.float32))
    with pytest.raises(broadside.BadInput, match="has not one flag a box"):
        broad.find_pairs(boxes_of(4), is_static=[True])
    bad = boxes_of(4)
    bad[2, 0] = np.nan
    with pytest.raises(broadside.BadInput, match="2"):
        broad.find_pairs(bad)
    assert len(broad.find_pairs(boxes_of(400))) > 20, "an engine that refused boxes goes on"


def test_the_list_of_engines():
    rows = {row["id"]: row for row in broadside.engines()}
    assert not rows["octree-cpu"]["absent"] and "broad" in rows["octree-cpu"]["capabilities"]
    assert rows["octree-cpu"]["settings"]["levels"]
