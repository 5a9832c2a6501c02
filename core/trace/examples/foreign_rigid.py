"""A trace of bodies that turn, by an engine that is not Broadside's:  foreign_rigid.py OUT.h5 [--fault FAULT]

A brick spins, falls and bounces; `World` (core/plugin/examples/bouncing_body.py) simulates it in float64. This file is
what you write for an engine of yours: `write` has all that format 2 needs for every law of mechanics
(core/trace/FOREIGN.md). Needs numpy and h5py (Debian: python3-h5py).
"""

import argparse
import sys
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "plugin/examples"))
from bouncing_body import World  # noqa: E402

F32, F64, U8, U32, U64 = np.float32, np.float64, np.uint8, np.uint32, np.uint64
DT, FRAMES, MASS, HALF = F32(1 / 240), 160, 2.0, np.array([0.1, 0.2, 0.3], F32)
FAULTS = ("none", "gravity", "half-spin", "stale-box", "no-body", "nan-impulse", "far-points", "unknown-word",
          "unknown-key", "negative-inertia", "flat-inertia", "mixed-precision", "wide-boxes")


def brick():
    """Vertices [8, 3] and triangles [12, 3] of a box around the origin, turned outward."""
    vertices = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], F32) * HALF
    squares = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return vertices, np.array([t for a, b, c, d in squares for t in ((a, b, c), (a, c, d))], U32)


def scene():
    """What World.begin reads: one body, and the box that it is in. Numbers are those that the trace will hold."""
    squares = HALF.astype(F64) ** 2
    xx, yy, zz = (MASS / 3 * (squares[(k + 1) % 3] + squares[(k + 2) % 3]) for k in range(3))
    body = {"mesh": 0, "is_static": 0, "position": [0.0, 1.0, 0.0], "orientation": [1.0, 0.0, 0.0, 0.0],
            "velocity": [0.5, 1.0, -0.25], "angular_velocity": [0.25, 5.0, 0.125], "mass": MASS,
            "center_of_mass": [0.0] * 3, "inertia": [xx, yy, zz, 0.0, 0.0, 0.0], "mu_static": 0.5, "mu_kinetic": 0.5,
            "restitution": 0.5}
    return {"turns": True, "dt": float(DT), "gravity": [0.0, float(F32(-9.81)), 0.0], "domain_min": [-4.0, 0.0, -4.0],
            "domain_max": [4.0, 8.0, 4.0], "face_mu_static": 0.5, "face_mu_kinetic": 0.5, "face_restitution": 0.5,
            "delta": 0.001, "v_threshold": float(F32(0.3)), "bodies": [body], "wrenches": [],
            "shapes": [{"kind": "box", "half_extents": HALF.tolist(), "radius": 0.0}]}


def simulate(given, fault):
    """Yields (states, detection, points) of each step."""
    world = World()
    if fault == "gravity":
        given = {**given, "gravity": [1.1 * g for g in given["gravity"]]}
    world.begin(given)
    for _ in range(FRAMES):
        world.step(given["dt"])
        yield world.read_states()[0], world.read_detection()[0], world.read_points()


def spoil(frames, fault):
    """What a wrong engine would have recorded."""
    hit = next(points for _, _, points in frames[2:] if points)
    for before, (state, seen, _) in reversed(list(zip(frames, frames[1:]))):
        if fault == "half-spin":
            state["angular_velocity"] = [2 * w for w in state["angular_velocity"]]
        if fault == "stale-box":
            seen["min"], seen["max"] = before[1]["min"], before[1]["max"]
    if fault == "no-body":
        hit[0]["a"] = 7
    if fault == "nan-impulse":
        hit[0]["impulse"] = [0.0, float("nan"), 0.0]
    if fault == "far-points":
        hit[0]["point"] = [x + 5.0 for x in hit[0]["point"]]


def write(path, given, mesh, frames, fault):
    """The trace. Every dataset and attribute here is one of SCHEMA.md; those left out are optional."""
    (vertices, triangles), body = mesh, given["bodies"][0]
    with h5py.File(path, "w") as file:
        file.attrs["format"] = np.bytes_("broadside-trace")  # fixed-length text, not h5py's own str
        file.attrs["format_version"] = U32(2)
        for key, value in {"motion": "rigid", "detection_at": "start", "contacts": "totals", "iterations": "60",
                           "friction": "con" if fault == "unknown-word" else "cone", "precision": "f64",
                           **({"frictoin": "cone"} if fault == "unknown-key" else {})}.items():
            file.require_group("declaration").attrs[key] = np.bytes_(value)

        scene = file.create_group("scene")
        scene.attrs["name"], scene.attrs["motion"] = np.bytes_("foreign:brick"), np.bytes_("rigid")
        scene.attrs["domain"] = np.array(given["domain_min"] + given["domain_max"], F32)
        scene.attrs["gravity_m_s2"] = np.array(given["gravity"], F32)
        scene.attrs["dt_s"], scene.attrs["frames"], scene.attrs["seed"] = DT, U32(FRAMES), U64(0)
        for name, value in {"delta_m": 0.001, "v_threshold_m_s": 0.3, "beta": 1, "alpha": 1, "impulse_min_n_s": 0,
                            "v_max_m_s": 50, "epsilon_m": 1e-6, "theta_m": 0, "hash_cell_m": 0.25}.items():
            scene.require_group("parameters").attrs[name] = F32(value)  # from beta on: only for engines of METHOD
        for name in ("mu_static", "mu_kinetic", "restitution"):
            scene.require_group("face_material").attrs[name] = F32(given["face_" + name])
            scene["body/" + name] = np.array([body[name]], F32)
        for name in ("position", "orientation", "velocity", "angular_velocity"):
            scene["body/" + name] = np.array([body[name]], F32)
        scene["body/mesh"], scene["body/inverse_mass"] = np.zeros(1, U32), np.array([1 / MASS], F32)
        inertia = {"negative-inertia": [-1.0, 1, 1, 0, 0, 0], "flat-inertia": [0.1, 0.1, 0.3, 0, 0, 0]}
        scene["body/inertia"] = np.array([inertia.get(fault, body["inertia"])], F64)
        scene["body/center_of_mass"] = np.array([body["center_of_mass"]], F64)
        scene["mesh/name"], scene["mesh/source"] = np.array([b"brick"]), np.array([b"procedural"])
        scene["mesh/is_stand_in"] = np.zeros(1, U8)
        scene["mesh/vertices"], scene["mesh/vertex_offsets"] = vertices, np.array([0, len(vertices)], U64)
        scene["mesh/triangles"], scene["mesh/triangle_offsets"] = triangles, np.array([0, len(triangles)], U64)

        file.create_group("provenance").attrs["engine"] = np.bytes_("foreign-brick")
        file.create_group("provenance/notes").attrs["digest"] = np.bytes_("none")

        trace = file.create_group("trace")
        steps = np.arange(1, FRAMES + 1, dtype=U64)
        trace["step"], trace["time"], trace["digest"] = steps, steps * F64(DT), np.zeros(FRAMES, U64)
        for name in ("position", "orientation", "velocity", "angular_velocity"):
            kind = F32 if fault == "mixed-precision" and name == "velocity" else F64
            trace["body/" + name] = np.array([[state[name]] for state, _, _ in frames], kind)
        for name in ("position", "orientation", "velocity"):
            trace["detection/" + name] = np.array([[seen[name]] for _, seen, _ in frames], F32)
        boxes = np.array([[seen["min"] + seen["max"]] for _, seen, _ in frames])
        trace["detection/boxes"] = boxes.astype(F64 if fault == "wide-boxes" else F32)
        points = [p for _, _, some in frames for p in some]
        for name in ("a", "b"):
            trace["point/" + name] = np.array([p[name] for p in points], U32)
        for name in ("point", "normal", "gap", "impulse"):
            trace["point/" + name] = np.array([p[name] for p in points], F32)
        trace["point/offsets"] = np.cumsum([0] + [len(some) for _, _, some in frames]).astype(U64)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("out")
    options.add_argument("--fault", choices=FAULTS, default="none")
    given = options.parse_args()
    frames = list(simulate(scene(), given.fault))
    spoil(frames, given.fault)
    write(given.out, scene(), brick(), frames, given.fault)


if __name__ == "__main__":
    main()
