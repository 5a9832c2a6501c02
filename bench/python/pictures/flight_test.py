"""A simulator that loses half of gravity, under test: `draw` shows how it fails."""

import numpy as np

from broadside.pytest_plugin import assert_lawful


def simulate(scene):
    x, v = scene.position.copy(), scene.velocity.copy()
    for _ in range(20):
        v += 0.5 * scene.dt_s * np.array(scene.gravity_m_s2)
        x += scene.dt_s * v
        yield {"position": x, "velocity": v, "orientation": scene.orientation, "angular_velocity": 0 * v}


def test_flight(broadside_recorder):
    with broadside_recorder("rigid:flight:box", engine="mine") as trace:
        for state in simulate(trace.scene):
            trace.append(body=state)
    assert_lawful(trace, laws=["ballistic"])
