"""What pip calls for `pip install ./bench/python` (PEP 517): it has ./broadside make the wheel, and copies it."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PYTHON = "/usr/bin/python3"  # ./broadside makes the wheel for this one


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    version = subprocess.run([PYTHON, "-c", "import sys; print(*sys.version_info[:2], sep='.')"], capture_output=True,
                             text=True, check=True).stdout.strip()
    if version != f"{sys.version_info[0]}.{sys.version_info[1]}":
        sys.exit(f"the package is made for {PYTHON}, which is version {version}; use its pip: {PYTHON} -m pip")
    # pip's own variables would reach the environment that ./broadside makes.
    clean = {key: value for key, value in os.environ.items() if not key.startswith(("PIP_", "PYTHON"))}
    subprocess.run([ROOT / "broadside", "python", "-c", ""], env=clean, check=True)
    built = ROOT / "build" / os.environ.get("BROADSIDE_PRESET", "release") / "bench/python/wheels"
    wheel = next(built.glob("*.whl"))
    shutil.copy(wheel, wheel_directory)
    return wheel.name
