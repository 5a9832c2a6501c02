"""The wheel by itself: what it holds, and that it works where this tree is absent."""

import base64
import hashlib
import os
import subprocess
import sys
import zipfile
from importlib import metadata
from pathlib import Path

import pytest

import broadside

BARE = {"PATH": "/usr/bin:/bin", "LC_ALL": "C.UTF-8"}


@pytest.fixture(scope="module")
def wheel():
    return next(Path(os.environ["BROADSIDE_PYTHON_WHEELS"]).glob("*.whl"))


def test_the_record_is_true(wheel):
    with zipfile.ZipFile(wheel) as file:
        assert file.testzip() is None
        names = set(file.namelist())
        record = next(name for name in names if name.endswith("/RECORD"))
        rows = [line.rsplit(",", 2) for line in file.read(record).decode().splitlines()]
        assert {name for name, _, _ in rows} == names
        for name, digest, size in rows:
            if name != record:
                data = file.read(name)
                ours = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
                assert (digest, int(size)) == (f"sha256={ours}", len(data)), name
    assert {"broadside/py.typed", "broadside/native.pyi", "broadside/bin/broadside"} <= names


def test_it_is_imported_from_the_environment_alone():
    assert Path(broadside.__file__).is_relative_to(sys.prefix)
    assert Path(broadside.program.path()).is_relative_to(sys.prefix)
    assert metadata.version("broadside") in broadside.native.build_line()


def test_the_journey_in_an_empty_folder(tmp_path):
    """As a newcomer: no variable but PATH, an empty home, the current folder empty."""
    script = ("import broadside\n"
              "trace, = broadside.run('rigid:stack:5', ['plain-rigid'], frames=20)\n"
              "print(broadside.check(trace).ok, trace['body/position'][:].shape)\n")
    done = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, env={**BARE, "HOME": str(tmp_path)},
                          capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (0, "True (20, 5, 3)\n"), done.stderr


def test_the_program_is_there_too(tmp_path):
    program = Path(sys.prefix) / "bin/broadside"
    command = [program, "run", "two-body:apart", "--engine", "octree-cpu", "--frames", "3", "--out", "mine"]
    done = subprocess.run(command, cwd=tmp_path, env=BARE, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert len(broadside.Trace(tmp_path / "mine/octree-cpu.h5")) == 3
    assert subprocess.run([program, "nonsense"], env=BARE, capture_output=True, check=False).returncode == 2


def test_pip_is_told_which_python_the_package_is_for(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(Path(os.environ["BROADSIDE_SOURCE"]) / "bench/python")
    import pip_backend

    other = tmp_path / "python"
    other.write_text("#!/bin/sh\necho 2.7\n", encoding="ascii")
    other.chmod(0o755)
    monkeypatch.setattr(pip_backend, "PYTHON", str(other))
    with pytest.raises(SystemExit, match="which is version 2.7; use its pip"):
        pip_backend.build_wheel(tmp_path)


def test_it_needs_no_pandas_until_a_table_is_asked_for(tmp_path):
    script = ("import sys\nfor name in ('pandas', 'xarray'): sys.modules[name] = None\nimport broadside\n"
              "trace, = broadside.run('two-body:apart', 'octree-cpu', frames=2)\n"
              "try: trace.to_pandas()\nexcept broadside.BadInput as error: print(error)\n")
    done = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, env=BARE, capture_output=True, text=True,
                          check=False)
    says = "pandas is not installed; install it, or take the arrays: trace['body/position'][:]\n"
    assert done.stdout == says, done.stderr
