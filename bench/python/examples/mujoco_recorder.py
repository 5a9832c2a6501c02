"""Records MuJoCo through its C library, by ctypes: mujoco_recorder.py OUT.h5. Needs libmujoco-dev and a C compiler.

MuJoCo 2.2 misjudges how deep boxes are in boxes, and contact-truth says so; the other laws hold.
"""
import ctypes
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import bricks
import broadside

BODY = '<body pos="{} {} {}"><freejoint/><geom type="box" size="{} {} {}" mass="{}"/></body>'
MODEL = ('<mujoco><option timestep="{}" gravity="0 0 {}"/><default><geom friction="{} 0 0"/></default>'
         '<worldbody><geom type="plane" size="9 9 1"/>{}</worldbody></mujoco>')
POINTER = ctypes.POINTER(ctypes.c_double)

with tempfile.TemporaryDirectory() as folder:
    library, model_file = f"{folder}/points.so", Path(folder, "model.xml")
    source = Path(__file__).with_name("mujoco_points.c")
    subprocess.run(["cc", "-shared", "-fPIC", "-o", library, source, "-lmujoco"], check=True)
    lib = ctypes.CDLL(library)
    for name in ("mj_loadXML", "mj_makeData", "places", "speeds"):
        getattr(lib, name).restype = ctypes.c_void_p
    bodies = "".join(BODY.format(*place, *bricks.HALF_M, bricks.MASS_KG) for place in bricks.PLACES_M)
    model_file.write_text(MODEL.format(bricks.DT_S, bricks.GRAVITY_M_S2, bricks.FRICTION, bodies), encoding="ascii")
    model = ctypes.c_void_p(lib.mj_loadXML(str(model_file).encode(), None, None, 0))
    data = ctypes.c_void_p(lib.mj_makeData(model))
q = np.ctypeslib.as_array(ctypes.cast(lib.places(data), POINTER), (bricks.COUNT, 7))  # MuJoCo's own memory
v = np.ctypeslib.as_array(ctypes.cast(lib.speeds(data), POINTER), (bricks.COUNT, 6))
rows = np.zeros((100 * bricks.COUNT, 12))

says = {"motion": "rigid", "contacts": "totals", "detection_at": "start", "friction": "regularized",
        "contact_model": "compliant", "contact_time_s": 0.02, "integrator": "semi-implicit Euler"}
with broadside.TraceWriter(sys.argv[1], bricks.scene(), "mujoco", says) as trace:
    for _ in range(bricks.FRAMES):
        lib.mj_step(model, data)
        turn = 2 * np.cross(q[:, 4:], v[:, 3:])  # MuJoCo's angular velocity is in the body's axes
        p = rows[:lib.points(model, data, rows.ctypes.data_as(POINTER))]
        on_floor = p[:, 0] == 0  # body 0 is the world, and the second body is A; else A is the first
        sign = np.where(on_floor, 1.0, -1.0)[:, None]
        trace.append(body={"position": q[:, :3], "orientation": q[:, 3:], "velocity": v[:, :3],
                           "angular_velocity": v[:, 3:] + q[:, 3:4] * turn + np.cross(q[:, 4:], turn)},
                     point={"a": np.where(on_floor, p[:, 1], p[:, 0]).astype(np.uint32) - 1,
                            "b": np.where(on_floor, bricks.FLOOR, p[:, 1] - 1).astype(np.uint32),
                            "point": p[:, 2:5], "normal": sign * p[:, 5:8], "gap": p[:, 8],
                            "impulse": sign * bricks.DT_S * p[:, 9:]})
print(broadside.check(sys.argv[1]))
