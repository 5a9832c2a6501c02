"""Records Rapier under Node: rapier_recorder.py OUT.h5 [FOLDER]. FOLDER has the package in its node_modules.

Without it, the one that `broadside fetch-engine rapier` installed is taken. Another program prints its states line by
line, and this one records them: any simulator that prints numbers can be recorded in this way. Impulses of friction
cannot be read from Rapier, so no points are recorded.
"""
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np

import bricks
import broadside

cache = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache"))
folder = sys.argv[2] if len(sys.argv) > 2 else cache / "broadside/engines/rapier/reference/programs/rapier"
given = {"dt": bricks.DT_S, "frames": bricks.FRAMES, "gravity": bricks.GRAVITY_M_S2, "mass": bricks.MASS_KG,
         "friction": bricks.FRICTION, "half": bricks.HALF_M, "places": bricks.PLACES_M}
says = {"motion": "rigid", "contacts": "none", "detection_at": "start", "integrator": "semi-implicit Euler in substeps",
        "substeps": 4, "iterations": 4, "correction": "velocity", "precision": "f32"}

node = subprocess.Popen(["node", Path(__file__).with_name("rapier_states.mjs"), folder], stdin=subprocess.PIPE,
                        stdout=subprocess.PIPE, text=True)
node.stdin.write(json.dumps(given))
node.stdin.close()
with broadside.TraceWriter(sys.argv[1], bricks.scene(), "rapier", says) as trace:
    for line in node.stdout:
        trace.append(body={name: np.array(rows, np.float32) for name, rows in json.loads(line).items()})
if node.wait() != 0:
    sys.exit(f"Rapier's program ended with {node.returncode}; install it with: broadside fetch-engine rapier")
print(broadside.check(sys.argv[1]))
