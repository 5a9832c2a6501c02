"""TraceWriter: what it writes is judged, and what a reader would refuse is refused at the call that caused it."""

import numpy as np
import pytest

import broadside

from conftest import DT_S, FRAMES, GRAVITY_M_S2, falling_scene, states, write

BODY = {"position": np.zeros((2, 3)), "orientation": np.tile([1.0, 0, 0, 0], (2, 1)), "velocity": np.zeros((2, 3)),
        "angular_velocity": np.zeros((2, 3))}
POINT = {"a": [0], "b": [1], "point": [[0.0, 0, 0]], "normal": [[0.0, 1, 0]], "gap": [0.0], "impulse": [[0.0, 0, 0]]}


@pytest.fixture
def writer(tmp_path):
    return broadside.TraceWriter(tmp_path / "mine.h5", falling_scene().build(), "mine", {"motion": "rigid"})


def refused(writer, says, **groups):
    with pytest.raises(broadside.BadInput) as caught:
        writer.append(**groups)
    assert says in str(caught.value)
    return str(caught.value)


def test_a_written_trace_obeys_the_laws(falling):
    verdicts = broadside.check(falling)
    assert verdicts.ok, verdicts.lines
    for law in ("ballistic", "state-sanity", "frame-digest", "recording"):
        assert verdicts[law].outcome == "pass", law


def test_a_wrong_engine_is_caught_in_its_first_step(too_heavy):
    verdicts = broadside.check(too_heavy)
    assert verdicts.exit_code == 1
    ballistic = verdicts["ballistic"]
    assert (ballistic.outcome, ballistic.step, ballistic.bodies, ballistic.violations) == ("fail", 1, (0,), FRAMES)
    assert ballistic.measured == 0.25 * GRAVITY_M_S2 * DT_S  # what a quarter of g too much adds in a step
    assert verdicts.lines.startswith("heavy: ballistic FAIL: measured 31.2 mm/s, limit ")


def test_the_scene_of_the_trace_is_the_one_that_was_given(falling):
    assert falling.scene.digest == falling_scene().build().digest
    assert falling.engine == "falls"
    assert falling.declaration == {"motion": "rigid", "integrator": "semi-implicit Euler"}


def test_states_keep_the_type_of_the_first_position(tmp_path, falling):
    assert falling["body/position"].dtype == np.float64
    scene = falling_scene().build()
    with broadside.TraceWriter(tmp_path / "single.h5", scene, "single") as trace:
        for state in states(scene):
            trace.append(body={name: values.astype(np.float32) for name, values in state.items()})
    assert broadside.Trace(tmp_path / "single.h5")["body/position"].dtype == np.float32


def test_bodies_that_only_translate_need_no_orientation(tmp_path):
    scene = broadside.scene("two-body:apart")
    with broadside.TraceWriter(tmp_path / "still.h5", scene, "still") as trace:
        trace.append(body={"position": scene.position, "velocity": scene.velocity})
    read = broadside.Trace(tmp_path / "still.h5")
    assert np.array_equal(read[0]["body/orientation"], scene.orientation)


def test_pairs_alone(tmp_path):
    scene = broadside.scene("two-body:apart")
    with broadside.TraceWriter(tmp_path / "pairs.h5", scene, "pairs") as trace:
        trace.append(pairs=np.array([[0, 1]]), pairs_demanded=3)
    read = broadside.Trace(tmp_path / "pairs.h5")
    assert read[0]["pairs/pairs"].tolist() == [[0, 1]]
    assert np.asarray(read["pairs/demanded"]).tolist() == [3]
    assert broadside.check(read)["capacity"].outcome == "fail", "three pairs were found, and one is there"


@pytest.mark.parametrize("fault, says", [
    ({"point": {**POINT, "a": [7]}}, "/trace/point: step 1 names a body that the scene does not have"),
    ({"point": {**POINT, "b": [0xFFFFFFF6]}}, "/trace/point: step 1 names a body that the scene does not have"),
    ({"pairs": [[0, 2]]}, "/trace/pairs/pairs: step 1 names a body that the scene does not have"),
])
def test_the_line_is_that_of_the_reader(writer, tmp_path, fault, says):
    """The same frame, put into a file behind the writer's back, is refused by the reader with the same line."""
    h5py = pytest.importorskip("h5py")
    ours = refused(writer, says, body=BODY, **fault)
    good = tmp_path / "good.h5"
    with broadside.TraceWriter(good, falling_scene().build(), "mine") as trace:
        trace.append(body=BODY, point=POINT, pairs=[[0, 1]])
    with h5py.File(good, "r+") as file:
        for group, arrays in fault.items():
            for name, values in (arrays if isinstance(arrays, dict) else {"pairs": arrays}).items():
                file[f"trace/{group}/{name}"][:] = values
    with pytest.raises(broadside.BadInput) as theirs:
        broadside.check(good)
    assert str(theirs.value).replace("good.h5", "mine.h5") == ours


def test_steps_rise(writer):
    writer.append(3, body=BODY)
    with pytest.raises(broadside.BadInput, match="step 3 follows step 3; append frames in rising order"):
        writer.append(3, body=BODY)


def test_shapes_types_and_groups(writer):
    refused(writer, "has body/position of shape (3, 3); give [2, 3]", body={**BODY, "position": np.zeros((3, 3))})
    refused(writer, "has no body/velocity", body={key: BODY[key] for key in BODY if key != "velocity"})
    writer.append(body=BODY, point=POINT)
    refused(writer, "has no point/a", body=BODY)
    refused(writer, "has pairs/pairs, which the first frame did not have", body=BODY, point=POINT, pairs=[[0, 1]])
    refused(writer, "has 2 rows of point/b and a different number in an array before it", body=BODY,
            point={**POINT, "b": [1, 1]})
    refused(writer, "point/a: it holds -1 to -1; give numbers from 0 to 4294967295", body=BODY,
            point={**POINT, "a": [-1]})
    refused(writer, "point/a: it is of type float64; give whole numbers", body=BODY, point={**POINT, "a": [0.5]})
    refused(writer, "body is no table of arrays", body=np.zeros((2, 3)), point=POINT)
    assert writer.append(body=BODY, point=POINT) == 2, "a refused frame leaves the trace as it was"


def test_unknown_group(writer):
    refused(writer, "there is no group 'points'; one of: body", body=BODY, points=POINT)


def test_what_the_constructor_refuses(tmp_path):
    scene = falling_scene().build()
    with pytest.raises(broadside.BadInput, match="cone"):
        broadside.TraceWriter(tmp_path / "a.h5", scene, "mine", {"friction": "con"})
    with pytest.raises(broadside.BadInput, match="'friction'"):
        broadside.TraceWriter(tmp_path / "a.h5", scene, "mine", {"frictoin": "cone"})
    with pytest.raises(broadside.BadInput, match="there is no folder"):
        broadside.TraceWriter(tmp_path / "no/a.h5", scene, "mine")
    with pytest.raises(broadside.BadInput, match="the engine has no name"):
        broadside.TraceWriter(tmp_path / "a.h5", scene, "")
    with pytest.raises(broadside.BadInput, match="no frame was appended"):
        with broadside.TraceWriter(tmp_path / "a.h5", scene, "mine"):
            pass


def test_an_exception_leaves_a_part_that_can_be_read(tmp_path):
    scene = falling_scene().build()
    with pytest.raises(RuntimeError), broadside.TraceWriter(tmp_path / "cut.h5", scene, "mine") as trace:
        for k, state in enumerate(states(scene)):
            if k == 5:
                raise RuntimeError("the simulator died")
            trace.append(body=state)
    assert not (tmp_path / "cut.h5").exists()
    del trace
    assert len(broadside.Trace(tmp_path / "cut.h5.part")) == 5


def test_digests_are_those_of_the_schema(tmp_path, falling):
    """A second run with the same bits has the same digests, and determinism holds between the two."""
    again = write(tmp_path / "again.h5")
    assert np.array_equal(again.digests, falling.digests)
    assert len(set(falling.digests.tolist())) == FRAMES
    verdict = broadside.check(falling, laws=["determinism"], against=again)[0]
    assert verdict.outcome == "pass" and verdict.checked > 0
