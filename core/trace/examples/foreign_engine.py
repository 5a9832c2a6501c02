"""A simulator that is not Broadside's, and the trace that it writes:  foreign_engine.py OUT.h5 [--fault FAULT]

Cubes fall into a box and bounce off its floor and walls; a pair of them passes through each other. It shares
only the layout of core/trace/SCHEMA.md with Broadside, and shows how little of it a trace needs (core/trace/FOREIGN.md).
Needs numpy and h5py (Debian: python3-h5py).
"""

import argparse

import h5py
import numpy as np

F32, U8, U32, U64 = np.float32, np.uint8, np.uint32, np.uint64
BODIES, FRAMES, DT = 24, 120, F32(1 / 60)
GRAVITY = np.array([0, -9.81, 0], F32)
DOMAIN = np.array([-4, 0, -4, 4, 8, 4], F32)
FAULTS = ("none", "lost-pair", "extra-pair", "stale-boxes", "nan", "drift")


def cube():
    """Vertices [8, 3] and triangles [12, 3] of a cube of 1 m around the origin."""
    vertices = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)], F32)
    squares = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return vertices, np.array([t for a, b, c, d in squares for t in ((a, b, c), (a, c, d))], U32)


def overlapping(boxes):
    """Every pair i < j of closed boxes [n, 6] that overlap, touching included, in order."""
    low, high = boxes[:, None, :3], boxes[None, :, 3:]
    meet = np.all(low <= high, axis=2)
    return np.argwhere(np.triu(meet & meet.T, 1)).astype(U32)


def simulate(start, vertices):
    """Yields, step by step, what was found at detection and what the step ended with."""
    x, v = start["position"].copy(), start["velocity"].copy()
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    for _ in range(FRAMES):
        v = v + DT * GRAVITY  # semi-implicit Euler, in float32: the new velocity moves the body
        x = x + DT * v
        frame = {"position": x.copy(), "velocity": v.copy(), "boxes": np.hstack([x + low, x + high])}
        frame["pairs"] = overlapping(frame["boxes"])
        for axis in range(3):  # its own response: a cube that passed a wall is put back and its velocity reversed
            for wall, side, sign in ((DOMAIN[axis], low[axis], F32(1)), (DOMAIN[axis + 3], high[axis], F32(-1))):
                out = sign * (x[:, axis] + side - wall) < 0
                x[out, axis] = wall - side
                v[out, axis] = sign * np.abs(v[out, axis]) * F32(0.5)
        frame["end_position"], frame["end_velocity"] = x.copy(), v.copy()
        yield frame


def spoil(frames, fault):
    """What a wrong engine would have recorded."""
    crowded = next(k for k, f in enumerate(frames) if len(f["pairs"]) > 1)
    if fault == "lost-pair":
        frames[crowded]["pairs"] = frames[crowded]["pairs"][1:]
    elif fault == "extra-pair":
        boxes = frames[crowded]["boxes"]
        apart = next((i, j) for i in range(BODIES) for j in range(i + 1, BODIES)
                     if not np.all((boxes[i, :3] <= boxes[j, 3:]) & (boxes[j, :3] <= boxes[i, 3:])))
        pairs = np.vstack([frames[crowded]["pairs"], np.array([apart], U32)])
        frames[crowded]["pairs"] = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]
    elif fault == "stale-boxes":
        frames[60]["boxes"] = frames[59]["boxes"]
    elif fault == "nan":
        frames[30]["end_velocity"][3, 1] = np.nan
    elif fault == "drift":
        frames[10]["position"][5, 0] += F32(0.001)


def write(path, start, mesh, frames):
    """The trace: every dataset and attribute here is one of SCHEMA.md, and those left out are optional."""
    vertices, triangles = mesh
    with h5py.File(path, "w") as file:
        file.attrs["format"] = np.bytes_("broadside-trace")  # fixed-length text, not h5py's own str
        file.attrs["format_version"] = U32(1)

        scene = file.create_group("scene")
        scene.attrs["name"] = np.bytes_("foreign:cubes")
        scene.attrs["domain"], scene.attrs["gravity_m_s2"] = DOMAIN, GRAVITY
        scene.attrs["dt_s"], scene.attrs["frames"], scene.attrs["seed"] = DT, U32(FRAMES), U64(0)
        parameters = scene.create_group("parameters")
        for name, value in {"delta_m": 0.001, "beta": 1, "alpha": 1, "v_threshold_m_s": 0.3, "impulse_min_n_s": 0.01,
                            "v_max_m_s": 50, "epsilon_m": 1e-6, "theta_m": 0, "hash_cell_m": 0.25}.items():
            parameters.attrs[name] = F32(value)
        faces = scene.create_group("face_material")
        for name, value in {"mu_static": 0, "mu_kinetic": 0, "restitution": 0.5}.items():
            faces.attrs[name] = F32(value)
        for name, values in start.items():
            scene["body/" + name] = values
        scene["mesh/name"], scene["mesh/source"] = np.array([b"cube"]), np.array([b"procedural"])
        scene["mesh/is_stand_in"] = np.zeros(1, U8)
        scene["mesh/vertices"], scene["mesh/vertex_offsets"] = vertices, np.array([0, len(vertices)], U64)
        scene["mesh/triangles"], scene["mesh/triangle_offsets"] = triangles, np.array([0, len(triangles)], U64)

        file.create_group("provenance").attrs["engine"] = np.bytes_("foreign-cubes")
        file.create_group("provenance/notes").attrs["digest"] = np.bytes_("none")

        trace = file.create_group("trace")
        steps = np.arange(1, FRAMES + 1, dtype=U64)
        trace["step"], trace["time"] = steps, steps * np.float64(DT)
        trace["digest"] = np.zeros(FRAMES, U64)  # zeros: no digests, as the provenance says
        still = np.zeros((FRAMES, BODIES, 3), F32)
        trace["body/position"] = np.stack([f["end_position"] for f in frames])
        trace["body/velocity"] = np.stack([f["end_velocity"] for f in frames])
        trace["body/orientation"] = np.tile(np.array([1, 0, 0, 0], F32), (FRAMES, BODIES, 1))
        trace["body/angular_velocity"] = still
        for name in ("position", "velocity", "boxes"):
            trace["detection/" + name] = np.stack([f[name] for f in frames])
        counts = np.array([len(f["pairs"]) for f in frames], U64)
        trace["pairs/pairs"] = np.vstack([f["pairs"] for f in frames])
        trace["pairs/offsets"] = np.concatenate([[U64(0)], np.cumsum(counts)]).astype(U64)
        trace["pairs/demanded"], trace["pairs/raw"] = counts, counts


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("out")
    options.add_argument("--fault", choices=FAULTS, default="none")
    given = options.parse_args()
    mesh = cube()
    places = np.random.default_rng(1)
    start = {
        "mesh": np.zeros(BODIES, U32),
        "position": places.uniform((-3, 1, -3), (3, 7, 3), (BODIES, 3)).astype(F32),
        "orientation": np.tile(np.array([1, 0, 0, 0], F32), (BODIES, 1)),
        "velocity": places.uniform(-2, 2, (BODIES, 3)).astype(F32),
        "angular_velocity": np.zeros((BODIES, 3), F32),
        "inverse_mass": np.ones(BODIES, F32),
        "mu_static": np.zeros(BODIES, F32),
        "mu_kinetic": np.zeros(BODIES, F32),
        "restitution": np.full(BODIES, 0.5, F32),
    }
    frames = list(simulate(start, mesh[0]))
    spoil(frames, given.fault)
    write(given.out, start, mesh, frames)


if __name__ == "__main__":
    main()
