"""Traces as NumPy, pandas and xarray see them. Expected numbers: those of free fall, or what h5py reads."""

import numpy as np
import pytest

import broadside

from conftest import DT_S, FRAMES, GRAVITY_M_S2, write


@pytest.fixture(scope="module")
def stack(tmp_path_factory):
    """Five cubes on each other: points of contact, in rows of unequal number a frame."""
    out = tmp_path_factory.mktemp("stack")
    return broadside.run("rigid:stack:5", "plain-rigid", out=out, frames=8)[0]


def test_columns_have_the_numbers_of_free_fall(falling):
    x = np.asarray(falling["body/position"])
    assert (x.shape, x.dtype) == ((FRAMES, 2, 3), np.float64)
    steps = np.arange(1, FRAMES + 1)
    # Semi-implicit Euler: y = y0 - g h^2 k (k + 1) / 2, without rounding for these powers of two.
    assert np.array_equal(x[:, 0, 1], 50.0 - GRAVITY_M_S2 * DT_S**2 * steps * (steps + 1) / 2)
    assert np.array_equal(falling.steps, steps)
    assert np.array_equal(falling.times_s, steps * DT_S)


def test_every_column_is_what_another_reader_finds(stack):
    h5py = pytest.importorskip("h5py")
    # One process may open a file twice where both openings agree on how the file is locked; Broadside's readers never
    # lock it.
    with h5py.File(stack.path, locking=False) as file:
        for path, column in stack.columns.items():
            theirs = file["trace/" + path][:]
            ours = np.asarray(column)
            assert ours.dtype == theirs.dtype and np.array_equal(ours, theirs), path
            assert column.unit == file["trace/" + path].attrs["unit"].decode(), path
        assert np.array_equal(stack.scene.position, file["scene/body/position"][:])
        assert stack.scene.digest == file["scene"].attrs["digest"]


def test_a_frame_is_the_rows_between_its_offsets(stack):
    offsets, impulse = np.asarray(stack["point/offsets"]).astype(int), np.asarray(stack["point/impulse"])
    for k, frame in enumerate(stack):
        assert np.array_equal(frame["point/impulse"], impulse[offsets[k]:offsets[k + 1]])
        assert np.array_equal(stack["body/position"][k], frame["body/position"])
    assert len({b - a for a, b in zip(offsets, offsets[1:])}) > 1, "frames of unequal numbers of rows"
    assert np.array_equal(stack["point/a"][2:4], np.asarray(stack["point/a"])[offsets[2]:offsets[4]])
    assert np.array_equal(stack["body/velocity"][1:3], np.asarray(stack["body/velocity"])[1:3])


def test_rows_of_a_frame_are_views_and_not_copies(stack):
    frame = stack[3]
    first, second = frame["point/normal"], frame["point/normal"]
    assert first.__array_interface__["data"] == second.__array_interface__["data"]
    gap = frame["point/gap"]
    assert gap.strides == first.strides[:1], "both lie in the same rows"
    # There is nothing between them: gap follows the normal directly in a row of core/contact_point.hpp.
    assert gap.__array_interface__["data"][0] - first.__array_interface__["data"][0] == first.shape[1] * 4
    assert np.from_dlpack(np.asarray(stack["body/position"])).shape == (8, 5, 3)


def test_views_outlive_frame_and_trace(tmp_path):
    view = write(tmp_path / "gone.h5")[-1]["body/position"]
    assert view[0, 1] == 50.0 - GRAVITY_M_S2 * DT_S**2 * FRAMES * (FRAMES + 1) / 2


def test_a_trace_cannot_be_written_into(stack):
    with pytest.raises(ValueError):
        stack[0]["body/position"][0] = 0.0
    with pytest.raises(ValueError):
        stack.scene.position[0] = 0.0


def test_frames_by_step(falling):
    assert falling.frame(7).step == 7
    assert falling[-1].step == FRAMES
    with pytest.raises(IndexError, match="step 99 was not recorded"):
        falling.frame(99)
    with pytest.raises(IndexError, match="it has 30 frames"):
        falling[30]


def test_table_of_bodies(falling):
    pytest.importorskip("pandas")
    table = falling.to_pandas("body")
    assert table.index.names == ["step", "body"]
    assert len(table) == 2 * FRAMES
    assert table.loc[(1, 0), "velocity_y"] == -GRAVITY_M_S2 * DT_S
    assert table.attrs["units"]["velocity_y"] == "m/s"


def test_table_of_points(stack):
    pytest.importorskip("pandas")
    table = stack.to_pandas("point")
    counts = table.groupby(level="step").size()
    assert list(counts) == list(np.diff(np.asarray(stack["point/offsets"]).astype(int)))
    with pytest.raises(broadside.BadInput, match="it has no group 'points'; one of: body, detection, point"):
        stack.to_pandas("points")


def test_dataset(falling, stack):
    pytest.importorskip("xarray")
    data = falling.to_xarray()
    assert data.body_position.dims == ("step", "body", "element_3")
    assert float(data.body_velocity.sel(step=2).isel(body=0, element_3=1)) == -2 * GRAVITY_M_S2 * DT_S
    assert data.body_velocity.attrs["unit"] == "m/s"
    rows = stack.to_xarray()
    assert rows.point_gap.dims == ("point_row",)
    assert int((rows.point_row_step == 1).sum()) == len(stack[0]["point/a"])


def test_errors_are_those_of_the_command_line(stack, tmp_path):
    with pytest.raises(broadside.BadInput, match=r"nix\.h5: there is no such file; check the path"):
        broadside.Trace("nix.h5")
    says = r"plain-rigid\.h5: there is no column 'body/positon'; did you mean 'body/position'\?"
    with pytest.raises(broadside.BadInput, match=says):
        stack["body/positon"]
    with pytest.raises(broadside.BadInput, match="it has no contact/depth"):
        stack["contact/depth"]
    (tmp_path / "text.h5").write_text("not HDF5", encoding="ascii")
    with pytest.raises(broadside.BadInput) as caught:
        broadside.Trace(tmp_path / "text.h5")
    answer = broadside.program.call("check", tmp_path / "text.h5", passes=(2,))
    assert answer.exit_code == caught.value.exit_code == 2
    with pytest.raises(broadside.BadInput) as again:
        broadside.program.call("check", tmp_path / "text.h5")
    assert str(again.value) == str(caught.value)
