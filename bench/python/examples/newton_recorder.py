"""Records Newton (the engine on Warp): newton_recorder.py OUT.h5. Needs the packages newton and warp-lang, and a GPU.

Not run here: written from Newton's documented interface of version 1 (ModelBuilder, SolverXPBD, State.body_q, body_qd).
"""
import sys

import newton
import numpy as np
import warp as wp

import bricks
import broadside

builder = newton.ModelBuilder(up_axis=newton.Axis.Z, gravity=bricks.GRAVITY_M_S2)
surface = newton.ModelBuilder.ShapeConfig(density=bricks.DENSITY_KG_M3, mu=bricks.FRICTION, restitution=0.0)
builder.add_ground_plane(cfg=surface)
for place in bricks.PLACES_M:
    body = builder.add_body(xform=wp.transform(wp.vec3(*place), wp.quat_identity()))
    builder.add_shape_box(body, hx=bricks.HALF_M[0], hy=bricks.HALF_M[1], hz=bricks.HALF_M[2], cfg=surface)
model = builder.finalize()
solver = newton.solvers.SolverXPBD(model)
now, after, control = model.state(), model.state(), model.control()

says = {"motion": "rigid", "contacts": "none", "detection_at": "start", "integrator": "XPBD", "correction": "position",
        "precision": "f32"}
build = f"Newton {newton.__version__}"
with broadside.TraceWriter(sys.argv[1], bricks.scene(), "newton-xpbd", says, build=build) as trace:
    for _ in range(bricks.FRAMES):
        now.clear_forces()
        solver.step(now, after, control, model.collide(now), bricks.DT_S)
        now, after = after, now
        q, v = now.body_q.numpy(), now.body_qd.numpy()  # .numpy() waits for the device, then copies
        # body_q is x y z and a quaternion x y z w; body_qd is the velocity of the center of mass, then the angular one.
        trace.append(body={"position": q[:, :3], "orientation": np.roll(q[:, 3:], 1, axis=1), "velocity": v[:, :3],
                           "angular_velocity": v[:, 3:]})
print(broadside.check(sys.argv[1]))
