"""Runs test files of the Python package in a virtual environment that has its wheel.

    run_in_environment.py WHEELS ENVIRONMENT FILE...

The environment is made of the one wheel in the folder WHEELS, and anew when the wheel has changed. Exits 77, with the
reason, where pytest or NumPy are not installed.
"""

import fcntl
import hashlib
import importlib.util
import os
import subprocess
import sys
from pathlib import Path

SKIPPED = 77


def make(wheel, environment):
    """A new environment without the caller's variables: what works in it needs nothing of this tree."""
    bare = {"PATH": "/usr/bin:/bin", "HOME": str(environment.parent), "LC_ALL": "C.UTF-8"}
    pip = [environment / "bin/pip", "--disable-pip-version-check"]
    for command in ([sys.executable, "-m", "venv", "--clear", "--system-site-packages", environment],
                    [*pip, "install", "--no-index", "--no-deps", wheel]):
        subprocess.run(command, env=bare, check=True, stdout=subprocess.DEVNULL)


def main():
    wheels, environment, files = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3:]
    for module, package in (("numpy", "python3-numpy"), ("pytest", "python3-pytest"), ("ensurepip", "python3-venv")):
        if importlib.util.find_spec(module) is None:
            print(f"skipped: {module} is not installed for {sys.executable}; ./broadside python installs {package}")
            return SKIPPED
    found = list(wheels.glob("*.whl"))
    if len(found) != 1:
        sys.exit(f"{wheels} has {len(found)} wheels; build the target python_wheel first")
    environment.parent.mkdir(parents=True, exist_ok=True)
    made = environment.with_suffix(".made")
    with open(environment.with_suffix(".lock"), "w", encoding="ascii") as lock:  # tests may run side by side
        fcntl.flock(lock, fcntl.LOCK_EX)
        digest = hashlib.sha256(found[0].read_bytes()).hexdigest()
        if not made.is_file() or made.read_text(encoding="ascii") != digest:
            made.unlink(missing_ok=True)
            make(found[0], environment)
            made.write_text(digest, encoding="ascii")
    clean = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "BROADSIDE_PROGRAM")}
    return subprocess.run([environment / "bin/python", "-B", "-m", "pytest", "-q", "-p", "no:cacheprovider", *files],
                          env=clean, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
