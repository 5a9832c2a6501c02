"""How often the gate is wrong on this machine:  gate_trial.py PROGRAM [COMPARISONS]

Compares the program with itself, in turns, COMPARISONS times (20), and as often with a copy made a tenth slower by
slower.c. At most 5 % of equal builds may give an alarm. No slowdown may pass, and at least 95 % must be called slower; the rest is
inconclusive, which is no pass. A busy machine makes it longer, up to sixty processes of each build a comparison. Exits 77
where there is no C compiler.
"""

import json
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

HERE = Path(__file__).resolve().parent
WORK = ["freefall:sphere:100", "--engine", "octree-cpu[threads=1]", "--frames", "150", "--json"]


def verdicts(program, head, folder, count):
    """The outcomes of the time in that many comparisons."""
    said = Counter()
    for _ in range(count):
        answer = subprocess.run([program, "compare", "--interleave", program, str(head), *WORK, "--out", str(folder / "out")],
                                stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        assert answer.returncode in (0, 1, 3), answer.stderr
        times = json.loads(answer.stdout)["times"]
        assert len(times) == 1, times
        said[times[0]["speed"].lower()] += 1
        print(f"{times[0]['speed']}: {times[0]['ratio']:.4f} [{times[0]['low']:.4f}, {times[0]['high']:.4f}] of {times[0]['head_processes']}",
              flush=True)
    return said


def main(program, count):
    compiler = shutil.which("cc")
    if compiler is None:
        print("skipped: no C compiler")
        return 77
    with tempfile.TemporaryDirectory(prefix="gate-") as scratch:
        folder = Path(scratch)
        library = folder / "slower.so"
        subprocess.run([compiler, "-O2", "-shared", "-fPIC", "-o", library, HERE / "slower.c"], check=True)
        slower = folder / "slower"
        slower.write_text(f'#!/bin/sh\nLD_PRELOAD="{library}" exec "{program}" "$@"\n', encoding="utf-8")
        slower.chmod(0o755)
        equal = verdicts(program, program, folder, count)
        print(f"equal builds: {dict(equal)}", flush=True)
        tenth = verdicts(program, slower, folder, count)
        print(f"a tenth slower: {dict(tenth)}", flush=True)
    assert equal["slower"] + equal["faster"] <= 0.05 * count, equal
    assert tenth["slower"] >= 0.95 * count, tenth
    assert tenth["same"] == 0 and tenth["faster"] == 0, tenth
    return 0


if __name__ == "__main__":
    sys.exit(main(str(Path(sys.argv[1]).resolve()), int(sys.argv[2]) if len(sys.argv) > 2 else 20))
