"""What several test files need: a trace of two falling cubes, written by the package itself."""

import numpy as np
import pytest

import broadside

DT_S, FRAMES, GRAVITY_M_S2 = 1 / 64, 30, 8.0  # powers of two: h, g h and their sums have no rounding in float64


def falling_scene():
    """Two bricks far from every face, one of them static."""
    made = broadside.SceneBuilder(name="falling", frames=FRAMES, dt_s=DT_S, motion="rigid",
                                  gravity_m_s2=[0.0, -GRAVITY_M_S2, 0.0])
    made.domain(min_m=[-100.0, -100.0, -100.0], max_m=[100.0, 100.0, 100.0])
    made.mesh("brick", shape="box", sides_m=[0.5, 1.0, 2.0])
    made.body(mesh="brick", position_m=[0.0, 50.0, 0.0], velocity_m_s=[1.0, 0.0, 0.0], mass_kg=2.0)
    made.body(mesh="brick", position_m=[20.0, 0.0, 0.0], static=True)
    return made


def states(scene, gravity_m_s2=GRAVITY_M_S2):
    """The states after each step of the exact semi-implicit Euler method, in float64."""
    x, v = scene.position.astype(np.float64), scene.velocity.astype(np.float64)
    for _ in range(FRAMES):
        v[0, 1] -= gravity_m_s2 * DT_S
        x[0] += v[0] * DT_S
        yield {"position": x, "orientation": scene.orientation.astype(np.float64), "velocity": v,
               "angular_velocity": np.zeros((2, 3))}


def write(path, gravity_m_s2=GRAVITY_M_S2, name="falls"):
    """The trace, in the ten lines that the README shows."""
    scene = falling_scene().build()
    with broadside.TraceWriter(path, scene, name, {"motion": "rigid", "integrator": "semi-implicit Euler"}) as trace:
        for state in states(scene, gravity_m_s2):
            trace.append(body=state)
    return broadside.Trace(path)


@pytest.fixture
def falling(tmp_path):
    return write(tmp_path / "falls.h5")


@pytest.fixture
def too_heavy(tmp_path):
    """The same, with a quarter more gravity than the scene has."""
    return write(tmp_path / "heavy.h5", 1.25 * GRAVITY_M_S2, "heavy")
