"""Scenes by name, from a file and from a builder: one scene has one digest, however it was written down."""

import os
from pathlib import Path

import numpy as np
import pytest

import broadside

from conftest import falling_scene

SCENES = Path(os.environ["BROADSIDE_SOURCE"]) / "datasets/scenes"


def test_builder_file_and_command_line_give_one_digest(tmp_path):
    built = falling_scene().build()
    falling_scene().save(tmp_path / "falling.toml")
    built.save(str(tmp_path / "again.toml"))
    told = broadside.program.call("scene", tmp_path / "falling.toml", "--json").text
    assert f'"digest": "{built.digest:#018x}"' in told
    assert broadside.scene(tmp_path / "falling.toml").digest == built.digest
    assert broadside.scene(tmp_path / "again.toml").digest == built.digest
    assert broadside.scene(falling_scene()).digest == built.digest


def test_a_builder_says_what_a_scene_file_of_this_tree_says():
    """datasets/scenes/errata_e2.toml, key by key, which is also the built-in errata:E2."""
    made = broadside.SceneBuilder(name="errata:E2", frames=120, seed=0)
    made.domain(min_m=[-4.0] * 3, max_m=[4.0] * 3)
    made.mesh("cube", shape="box", sides_m=[1.0] * 3, segments=[8] * 3)
    for x, y, z, v in ((0.9, 1, 1, 0.5), (2.0, 1, 1, -0.5), (-1.15, -1, -1, 0.5), (0, -1, -1, -0.5),
                       (2.52, -3, -3, 0.25), (3.48, -3, -3, -0.25)):
        made.body(position_m=[x, y, z], velocity_m_s=[v, 0, 0])
    file = next(path for path in SCENES.glob("*.toml") if 'name = "errata:E2"' in path.read_text(encoding="utf-8"))
    assert made.build().digest == broadside.scene(file).digest == broadside.scene("errata:E2").digest


def test_a_mesh_of_arrays_is_the_mesh_of_the_file():
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], np.float32)
    squares = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = np.array([t for a, b, c, d in squares for t in ((a, b, c), (a, c, d))])
    made = broadside.SceneBuilder()
    made.domain(min_m=[-9, -9, -9], max_m=[9, 9, 9]).mesh("mine", corners, triangles).body(position_m=[0, 0, 0])
    mesh = made.build().meshes[0]
    assert {tuple(v) for v in mesh["vertices"].tolist()} == {tuple(v) for v in corners.tolist()}
    volume = np.linalg.det(mesh["vertices"][mesh["triangles"]].astype(np.float64)).sum() / 6.0
    assert volume == pytest.approx(1.0, abs=12 * 2.0**-50), "a unit cube, turned outward"


def test_arrays_of_a_scene(tmp_path):
    scene = falling_scene().build()
    assert scene.body_count == 2 and scene.motion == "rigid" and scene.frames == 30
    assert scene.position.tolist() == [[0.0, 50.0, 0.0], [20.0, 0.0, 0.0]]
    assert scene.inverse_mass.tolist() == [0.5, 0.0]
    assert scene.gravity_m_s2 == [0.0, -8.0, 0.0] and scene.dt_s == 1 / 64
    assert scene.meshes[0]["vertices"].dtype == np.float32
    assert len(broadside.scene("two-body:apart", frames=7).mesh_of_body) == 2
    assert broadside.scene("two-body:apart", frames=7).frames == 7


def test_errors_name_the_line_of_the_text():
    made = falling_scene()
    made.body(mesh="brik", position_m=[0, 0, 0])
    line = made.toml().splitlines().index('mesh = "brik"') + 1
    with pytest.raises(broadside.BadInput) as caught:
        made.build()
    assert str(caught.value).startswith(f"scene.toml:{line}: ") and "did you mean 'brick'?" in str(caught.value)
    with pytest.raises(broadside.BadInput, match=r"did you mean 'rigid:stack:5'\?"):
        broadside.scene("rigid:stak:5")
    assert any(example == "freefall:bunny:50" for _, example, _ in broadside.scenes())


def test_texts_with_quotes_and_lines_survive():
    named = broadside.SceneBuilder(name='a "quoted" \\ name', description="two\nlines\t\x7f\u00e9")
    named.domain(min_m=[-9, -9, -9], max_m=[9, 9, 9])
    named.mesh("cube", shape="box", sides_m=[1, 1, 1]).body(position_m=[0, 0, 0])
    scene = named.build()
    assert (scene.name, scene.description) == ('a "quoted" \\ name', "two\nlines\t\x7f\u00e9")
