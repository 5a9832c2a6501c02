"""Makes the wheel of the package broadside.

    make_wheel.py --version V --package DIR --module SO --program FILE --client PY --out DIR

The module and the program are taken as they were built, for this machine and this Python; nothing is compiled or
fetched here. The same files give the same bytes.
"""

import argparse
import base64
import hashlib
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path

# The date of every file in a wheel: the first that a zip file can hold, so that it says nothing.
EPOCH = (1980, 1, 1, 0, 0, 0)

METADATA = """Metadata-Version: 2.1
Name: broadside
Version: {version}
Summary: runs collision engines side by side, proves what each got right, times only what it proved
License: Apache-2.0
Author: The Broadside authors
Requires-Python: >={python}
Requires-Dist: numpy
Provides-Extra: tables
Requires-Dist: pandas; extra == "tables"
Requires-Dist: xarray; extra == "tables"
Classifier: Framework :: Pytest
"""
WHEEL = "Wheel-Version: 1.0\nGenerator: broadside\nRoot-Is-Purelib: false\nTag: {tag}\n"
ENTRY_POINTS = """[console_scripts]
broadside = broadside.program:main

[pytest11]
broadside = broadside.pytest_plugin
"""


def tag():
    """CPython of this version alone, on this kind of machine: the module is built for it."""
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def stripped(path, scratch):
    """The file without symbols for debuggers, where `strip` is there; its build id stays."""
    target = scratch / path.name
    try:
        subprocess.run(["strip", "--strip-unneeded", "-o", target, path], check=True)
    except FileNotFoundError:
        return path.read_bytes()
    data = target.read_bytes()
    target.unlink()
    return data


def contents(given):
    """Name in the wheel -> (bytes, mode)."""
    files = {}
    for path in sorted(given.package.iterdir()):
        if path.suffix in (".py", ".pyi") or path.name == "py.typed":
            files[f"broadside/{path.name}"] = (path.read_bytes(), 0o644)
    files["broadside/program_client.py"] = (given.client.read_bytes(), 0o644)
    files[f"broadside/{given.module.name}"] = (stripped(given.module, given.out), 0o755)
    files["broadside/bin/broadside"] = (stripped(given.program, given.out), 0o755)
    info = f"broadside-{given.version}.dist-info"
    python = f"{sys.version_info.major}.{sys.version_info.minor}"
    files[f"{info}/METADATA"] = (METADATA.format(version=given.version, python=python).encode(), 0o644)
    files[f"{info}/WHEEL"] = (WHEEL.format(tag=tag()).encode(), 0o644)
    files[f"{info}/entry_points.txt"] = (ENTRY_POINTS.encode(), 0o644)
    record = "".join(f"{name},sha256={digest(data)},{len(data)}\n" for name, (data, _) in files.items())
    files[f"{info}/RECORD"] = ((record + f"{info}/RECORD,,\n").encode(), 0o644)
    return files


def digest(data):
    return base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()


def write(path, files):
    part = path.with_suffix(".part")
    with zipfile.ZipFile(part, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as wheel:
        for name, (data, mode) in files.items():
            entry = zipfile.ZipInfo(name, EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o100000 | mode) << 16
            wheel.writestr(entry, data)
    part.replace(path)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--version", required=True)
    for name in ("package", "module", "program", "client", "out"):
        options.add_argument(f"--{name}", type=Path, required=True)
    given = options.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    for old in given.out.glob("*.whl"):
        old.unlink()
    path = given.out / f"broadside-{given.version}-{tag()}.whl"
    write(path, contents(given))
    print(path)


if __name__ == "__main__":
    main()
