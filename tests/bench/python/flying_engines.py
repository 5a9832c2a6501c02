"""Engines for program_engine_test.py, in a file that loads nothing else: each runs in a process of its own."""

import numpy as np

import broadside


@broadside.engine(declared={"motion": "rigid", "integrator": "semi-implicit Euler", "contacts": "none"})
class Ballistic:
    """Bodies that fly and never meet."""

    gravity_scale = 1.0

    def begin(self, scene):
        names = ("position", "orientation", "velocity", "angular_velocity")
        self.state = {name: getattr(scene, name).copy() for name in names}
        self.pull = self.gravity_scale * scene.gravity[None, :] * ~scene.is_static.astype(bool)[:, None]

    def step(self, dt):
        self.state["velocity"] += dt * self.pull
        self.state["position"] += dt * self.state["velocity"]

    def read_states(self):
        return self.state


@broadside.engine(id="heavy", declared={"motion": "rigid"})
class Heavy(Ballistic):
    """The same with a quarter more gravity."""

    gravity_scale = 1.25


@broadside.engine
class AllPairs:
    """Every pair by the definition."""

    def find_pairs(self, boxes, is_static):
        low, high = boxes[:, :3], boxes[:, 3:]
        hit = ((low[:, None] <= high[None]) & (low[None] <= high[:, None])).all(axis=2)
        hit &= ~(is_static[:, None] & is_static[None])
        return np.argwhere(np.triu(hit, 1))


@broadside.engine
class Failing(Ballistic):
    """Fails in its third step."""

    def step(self, dt):
        self.steps = getattr(self, "steps", 0) + 1
        if self.steps == 3:
            raise ArithmeticError("it blew up")
