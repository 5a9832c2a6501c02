"""Runs the program as a user would, and skips a test with its reason."""

import shutil
import subprocess
import sys
from pathlib import Path

SKIPPED = 77


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(str(c) for c in command)} exited {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def record(program, folder, scene, frames):
    run(program, "run", scene, "--frames", frames, "--engine", "octree-cpu", "--out", folder)
    return Path(folder) / "octree-cpu.h5"


def interpreter_with(*modules):
    """The first Python that has all of these modules: this one, or the system's."""
    for python in (sys.executable, "/usr/bin/python3"):
        if shutil.which(python) and subprocess.run([python, "-c", f"import {', '.join(modules)}"], capture_output=True).returncode == 0:
            return python
    skip(f"no Python here has {' and '.join(modules)} (Debian: {' '.join('python3-' + m for m in modules)})")
