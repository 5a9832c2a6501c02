"""Records Genesis: genesis_recorder.py OUT.h5. Needs the package genesis-world and what it needs.

Not run here: written from its documented interface (Scene, morphs.Box and Plane, RigidEntity.get_pos, get_quat,
get_vel, get_ang). Genesis adapts MuJoCo's contact model, so its contacts are declared as compliant.
"""
import sys

import genesis as gs
import numpy as np

import bricks
import broadside

gs.init(backend=gs.gpu, precision="32")
world = gs.Scene(sim_options=gs.options.SimOptions(dt=bricks.DT_S, gravity=(0.0, 0.0, bricks.GRAVITY_M_S2)),
                 rigid_options=gs.options.RigidOptions(dt=bricks.DT_S, integrator=gs.integrator.Euler),
                 show_viewer=False)
surface = gs.materials.Rigid(rho=bricks.DENSITY_KG_M3, friction=bricks.FRICTION)
world.add_entity(gs.morphs.Plane(), material=gs.materials.Rigid(friction=bricks.FRICTION))
entities = [world.add_entity(gs.morphs.Box(pos=place, size=[2 * h for h in bricks.HALF_M]), material=surface)
            for place in bricks.PLACES_M]
world.build()


def rows(name):
    """[bodies, width] of one property; .cpu() waits for the device, then copies."""
    return np.array([getattr(entity, name)().cpu().numpy() for entity in entities])


says = {"motion": "rigid", "contacts": "none", "detection_at": "start", "integrator": "semi-implicit Euler",
        "friction": "regularized", "contact_model": "compliant", "contact_time_s": 0.02, "precision": "f32"}
with broadside.TraceWriter(sys.argv[1], bricks.scene(), "genesis", says, build=f"Genesis {gs.__version__}") as trace:
    for _ in range(bricks.FRAMES):
        world.step()
        trace.append(body={"position": rows("get_pos"), "orientation": rows("get_quat"), "velocity": rows("get_vel"),
                           "angular_velocity": rows("get_ang")})
print(broadside.check(sys.argv[1]))
