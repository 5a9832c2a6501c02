"""One body that flies, turns and bounces off the faces of the domain, in Python:

    broadside run spinning_box.toml --engine 'python3 bouncing_body.py'

A ball or a box is one or eight small balls that touch a face. The angular momentum is the state, so the gyroscopic term
is in it. What each step does is told in bouncing_body.c. The standard library is enough.
"""

import math
import struct
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "clients"))
from broadside_engine import FIRST_FACE, serve  # noqa: E402

SWEEPS = 60
AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def add(a, b, s=1.0):
    return [x + s * y for x, y in zip(a, b)]


def scaled(s, a):
    return [s * x for x in a]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def size(a):
    return math.sqrt(dot(a, a))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def turned(q, v):
    t = scaled(2.0, cross(q[1:], v))
    return add(add(v, t, q[0]), cross(q[1:], t))


def turned_back(q, v):
    return turned([q[0], -q[1], -q[2], -q[3]], v)


def outward(x, side):
    """The next float32 outward: recorded boxes contain the shape."""
    near = struct.unpack("<f", struct.pack("<f", x))[0]
    return near if side * (near - x) > 0 else near + side * max(abs(near) * 2.0**-23, 2.0**-126)


class Point:
    def __init__(self, face, at, normal, gap):
        self.face, self.at, self.normal, self.gap = face, at, normal, gap
        self.push, self.drag, self.total = 0.0, [0.0] * 3, [0.0] * 3


class World:
    id, build = "example-bouncing-python", f"example 1.0, double, Python {sys.version.split()[0]}"
    what = "an example in Python: one body that turns and bounces"
    declared = {"motion": "rigid", "detection_at": "start", "contacts": "totals", "friction": "cone",
                "integrator": "semi-implicit Euler, Runge-Kutta 4 for the orientation", "iterations": SWEEPS,
                "contact_model": "rigid", "correction": "none", "precision": "f64"}

    def begin(self, scene):
        self.scene, self.points, body = scene, [], scene["bodies"][0]
        if len(scene["bodies"]) != 1 or body["is_static"] or not scene["turns"]:
            raise ValueError("this example simulates one body that moves and turns")
        if scene["wrenches"]:
            raise ValueError("unsupported: wrenches")
        shape = scene["shapes"][body["mesh"]]
        if shape["kind"] not in ("box", "sphere"):
            raise ValueError("unsupported: " + shape["kind"])
        h, self.radius, self.center = shape["half_extents"], shape["radius"], body["center_of_mass"]
        corners = [[0.0] * 3]
        if shape["kind"] == "box":
            corners = [[sx * h[0], sy * h[1], sz * h[2]] for sx in (-1, 1) for sy in (-1, 1) for sz in (-1, 1)]
        self.corners = [add(c, self.center, -1.0) for c in corners]
        self.reach = max(size(c) for c in self.corners) + self.radius
        xx, yy, zz, xy, xz, yz = body["inertia"]
        rows = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
        s = 1.0 / dot(rows[0], cross(rows[1], rows[2]))
        self.inverse = [scaled(s, cross(rows[(k + 1) % 3], rows[(k + 2) % 3])) for k in range(3)]
        self.mass, self.q, self.v = body["mass"], body["orientation"], body["velocity"]
        self.x = add(body["position"], turned(self.q, self.center))
        w = turned_back(self.q, body["angular_velocity"])
        self.momentum = turned(self.q, [dot(row, w) for row in rows])
        self.restitution = max(body["restitution"], scene["face_restitution"])
        self.mu_static = math.sqrt(body["mu_static"] * scene["face_mu_static"])
        self.mu_kinetic = math.sqrt(body["mu_kinetic"] * scene["face_mu_kinetic"])

    def spin(self, q, momentum):
        l = turned_back(q, momentum)
        return turned(q, [dot(row, l) for row in self.inverse])

    def origin(self):
        return add(self.x, turned(self.q, self.center), -1.0)

    def speed_at(self, at):
        return add(self.v, cross(self.spin(self.q, self.momentum), add(at, self.x, -1.0)))

    def mobility(self, at, d):
        arm = cross(add(at, self.x, -1.0), d)
        return 1.0 / self.mass + dot(arm, self.spin(self.q, arm))

    def push(self, at, impulse):
        self.v = add(self.v, impulse, 1.0 / self.mass)
        self.momentum = add(self.momentum, cross(add(at, self.x, -1.0), impulse))

    def see(self):
        places = [add(self.x, turned(self.q, c)) for c in self.corners]
        low = [outward(min(p[k] for p in places) - self.radius, -1) for k in range(3)]
        high = [outward(max(p[k] for p in places) + self.radius, 1) for k in range(3)]
        self.seen = {"position": self.origin(), "orientation": self.q, "velocity": self.v, "min": low, "max": high}

    def find_points(self, h):
        self.points = []
        turning = size(self.spin(self.q, self.momentum)) * self.reach
        near = h * (size(self.v) + turning + h * size(self.scene["gravity"]))
        for face in range(6):
            axis, side = face // 2, 1.0 if face % 2 == 0 else -1.0
            normal, wall = scaled(side, AXES[axis]), self.scene["domain_min" if side > 0 else "domain_max"][axis]
            for corner in self.corners:
                at = add(add(self.x, turned(self.q, corner)), normal, -self.radius)
                gap = side * (at[axis] - wall)
                if gap <= near:
                    self.points.append(Point(face, at, normal, gap))

    def solve(self, p):
        n, before = p.normal, p.push
        p.push = max(0.0, before + (p.least_speed - dot(self.speed_at(p.at), n)) / self.mobility(p.at, n))
        self.push(p.at, scaled(p.push - before, n))
        v = self.speed_at(p.at)
        slip = add(v, n, -dot(v, n))
        # The sum over both directions is at least the mobility of any direction between, so no step goes too far.
        across = sum(self.mobility(p.at, a) for a in AXES if dot(a, n) == 0.0)
        drag = add(p.drag, slip, -1.0 / across)
        if size(drag) > self.mu_static * p.push:
            drag = scaled(self.mu_kinetic * p.push / size(drag), drag)
        self.push(p.at, add(drag, p.drag, -1.0))
        p.drag = drag

    def solve_all(self, points):
        for _ in range(SWEEPS):
            for p in points:
                self.solve(p)
        for p in points:
            p.total = add(add(p.total, p.normal, p.push), p.drag)
            p.push, p.drag = 0.0, [0.0] * 3

    def rate(self, q):
        """dq/dt = (0, w) q / 2."""
        w = self.spin(scaled(1.0 / size(q), q), self.momentum)
        return scaled(0.5, [-dot(w, q[1:])] + add(scaled(q[0], w), cross(w, q[1:])))

    def step(self, h):
        gravity = self.scene["gravity"]
        self.see()
        self.find_points(h)
        for p in self.points:
            p.approach = -dot(self.speed_at(p.at), p.normal)
            p.least_speed = self.restitution * p.approach
        self.solve_all([p for p in self.points if p.approach > self.scene["v_threshold"] and
                        p.gap < h * (p.approach - h * dot(gravity, p.normal))])
        before, self.v = self.v, add(self.v, gravity, h)
        free = self.v
        for p in self.points:
            p.least_speed = -max(0.0, p.gap) / h
        self.solve_all(self.points)
        self.x = add(self.x, scaled(h / 2, add(before, self.v)) if self.v == free else scaled(h, self.v))
        q = self.q  # the classical Runge-Kutta method
        k1 = self.rate(q)
        k2 = self.rate(add(q, k1, h / 2))
        k3 = self.rate(add(q, k2, h / 2))
        k4 = self.rate(add(q, k3, h))
        q = [x + h / 6 * (a + 2 * b + 2 * c + d) for x, a, b, c, d in zip(q, k1, k2, k3, k4)]
        self.q = scaled(1.0 / size(q), q)

    def read_states(self):
        return [{"position": self.origin(), "orientation": self.q, "velocity": self.v,
                 "angular_velocity": self.spin(self.q, self.momentum)}]

    def read_points(self):
        return [{"a": 0, "b": FIRST_FACE + p.face, "point": p.at, "normal": p.normal, "gap": p.gap, "impulse": p.total}
                for p in self.points if size(p.total) > 0.0 or p.gap <= 0.0]

    def read_detection(self):
        return [self.seen]


if __name__ == "__main__":
    serve(World())
