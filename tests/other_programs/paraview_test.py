"""ParaView plays a trace: every time step of the XDMF text over the trace's virtual datasets, and of views of their own."""

import json
import shutil
import sys
import tempfile
from pathlib import Path

from recorded_run import record, run, skip

FRAMES, BODIES, DT = 12, 9, 1 / 60
READER = Path(__file__).with_name("play_in_pvpython.py")

program = sys.argv[1]
pvpython = shutil.which("pvpython") or skip("pvpython is not installed (Debian: python3-paraview)")
with tempfile.TemporaryDirectory() as folder:
    trace = record(program, folder, f"freefall:sphere:{BODIES}", FRAMES)
    run(program, "view", trace)
    run(program, "view", trace, "--what", "level1", "--every", 4)
    run(program, "view", trace, "--what", "meshes", "--window", "3:5")
    seen = {name: json.loads(run(pvpython, READER, Path(folder) / name).splitlines()[-1])
            for name in ("octree-cpu.xdmf", "octree-cpu.level1.xdmf", "octree-cpu.meshes.xdmf")}

faults = []


def expect(what, is_so):
    if not is_so:
        faults.append(what)


boxes = seen["octree-cpu.xdmf"]
expect("a time step per frame", len(boxes) == FRAMES)
expect("times are step * dt", all(abs(s["time"] - (k + 1) * DT) < 1e-6 for k, s in enumerate(boxes)))
expect("a cell per body, with eight points", all((s["cells"], s["points"]) == (BODIES, 8 * BODIES) for s in boxes))
expect("each cell knows its body", all(s["body"] == [0, BODIES - 1] for s in boxes))
falls = [s["bounds"][2] for s in boxes]  # lowest y; gravity is along -y
expect("the bodies fall, faster and faster", all(a > b for a, b in zip(falls, falls[1:])) and
       all(a - b < b - c for a, b, c in zip(falls, falls[1:], falls[2:])))
expect("velocity is downward", all(s["velocity_y"][1] < 0 for s in boxes))
level1 = seen["octree-cpu.level1.xdmf"]
expect("level 1: every 4th frame, at most 8 boxes a body", len(level1) == 3 and all(BODIES < s["cells"] <= 8 * BODIES for s in level1))
expect("level 1 covers what the boxes cover", all(abs(p - q) < 1e-5 for p, q in zip(level1[0]["bounds"], boxes[0]["bounds"])))
meshes = seen["octree-cpu.meshes.xdmf"]
expect("meshes: the window's frames", [round(s["time"] / DT) for s in meshes] == [3, 4, 5])
expect("meshes fill their boxes", all(abs(p - q) < 1e-5 for p, q in zip(meshes[0]["bounds"], boxes[2]["bounds"])))
sys.exit("\n".join(faults) or 0)
