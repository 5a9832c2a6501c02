"""Records Isaac Sim: PATH/python.sh isaac_recorder.py OUT.h5, with this package installed into Isaac Sim's Python.

Not run here: written from the documented interface of versions 4.5 and 5 (World, DynamicCuboid, RigidPrim). Later
versions have the same calls under isaacsim.core.experimental.
"""
import sys

from isaacsim import SimulationApp

app = SimulationApp({"headless": True})  # before everything else of Isaac Sim

import numpy as np  # noqa: E402
from isaacsim.core.api import World  # noqa: E402
from isaacsim.core.api.materials import PhysicsMaterial  # noqa: E402
from isaacsim.core.api.objects import DynamicCuboid  # noqa: E402
from isaacsim.core.prims import RigidPrim  # noqa: E402

import bricks  # noqa: E402
import broadside  # noqa: E402

world = World(physics_dt=bricks.DT_S, rendering_dt=bricks.DT_S, stage_units_in_meters=1.0)
world.get_physics_context().set_gravity(bricks.GRAVITY_M_S2)
surface = PhysicsMaterial("/World/surface", static_friction=bricks.FRICTION, dynamic_friction=bricks.FRICTION,
                          restitution=0.0)
world.scene.add_ground_plane(static_friction=bricks.FRICTION, dynamic_friction=bricks.FRICTION, restitution=0.0)
for k, place in enumerate(bricks.PLACES_M):
    world.scene.add(DynamicCuboid(f"/World/brick_{k}", name=f"brick_{k}", position=np.array(place), mass=bricks.MASS_KG,
                                  scale=2 * np.array(bricks.HALF_M), size=1.0, physics_material=surface))
view = world.scene.add(RigidPrim("/World/brick_.*", name="bricks"))
world.reset()

says = {"motion": "rigid", "contacts": "none", "detection_at": "start", "integrator": "PhysX", "correction": "velocity",
        "precision": "f32"}
with broadside.TraceWriter(sys.argv[1], bricks.scene(), "isaac-sim", says) as trace:
    for _ in range(bricks.FRAMES):
        world.step(render=False)
        position, orientation = view.get_world_poses()  # w x y z; arrays of the host, with the backend numpy
        trace.append(body={"position": position, "orientation": orientation, "velocity": view.get_linear_velocities(),
                           "angular_velocity": view.get_angular_velocities()})
print(broadside.check(sys.argv[1]))
app.close()
