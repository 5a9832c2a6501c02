"""Records MuJoCo Warp: mujoco_warp_recorder.py OUT.h5. Needs the packages mujoco, mujoco-warp and warp-lang, and a GPU.

Not run here: written from its documented interface (put_model, make_data, step; Data.qpos and qvel with a row a world).
"""
import sys

import mujoco
import mujoco_warp as mjw
import numpy as np

import bricks
import broadside

BODY = '<body pos="{} {} {}"><freejoint/><geom type="box" size="{} {} {}" mass="{}"/></body>'
MODEL = ('<mujoco><option timestep="{}" gravity="0 0 {}"/><default><geom friction="{} 0 0"/></default>'
         '<worldbody><geom type="plane" size="9 9 1"/>{}</worldbody></mujoco>')
bodies = "".join(BODY.format(*place, *bricks.HALF_M, bricks.MASS_KG) for place in bricks.PLACES_M)
host = mujoco.MjModel.from_xml_string(MODEL.format(bricks.DT_S, bricks.GRAVITY_M_S2, bricks.FRICTION, bodies))
model = mjw.put_model(host)
data = mjw.make_data(host, nworld=1, nconmax=100 * bricks.COUNT, njmax=400 * bricks.COUNT)

says = {"motion": "rigid", "contacts": "none", "detection_at": "start", "integrator": "semi-implicit Euler",
        "friction": "regularized", "contact_model": "compliant", "contact_time_s": 0.02, "precision": "f32"}
with broadside.TraceWriter(sys.argv[1], bricks.scene(), "mujoco-warp", says) as trace:
    for _ in range(bricks.FRAMES):
        mjw.step(model, data)
        q = data.qpos.numpy()[0].reshape(-1, 7)  # .numpy() waits for the device, then copies
        v = data.qvel.numpy()[0].reshape(-1, 6)
        turn = 2 * np.cross(q[:, 4:], v[:, 3:])  # its angular velocity is in the body's axes
        trace.append(body={"position": q[:, :3], "orientation": q[:, 3:], "velocity": v[:, :3],
                           "angular_velocity": v[:, 3:] + q[:, 3:4] * turn + np.cross(q[:, 4:], turn)})
print(broadside.check(sys.argv[1]))
