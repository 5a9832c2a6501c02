"""The pytest plug-in, in runs of pytest of its own."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

TESTS = '''
import sys
sys.path.insert(0, {folder!r})
from conftest import falling_scene, states
from broadside.pytest_plugin import assert_lawful

GRAVITY = {gravity}

def record(recorder):
    scene = falling_scene().build()
    with recorder(scene, engine="mine", declaration={{"motion": "rigid"}}) as trace:
        for state in states(scene, GRAVITY):
            trace.append(body=state)
    return trace

def test_lawful(broadside_recorder):
    assert assert_lawful(record(broadside_recorder))["ballistic"].outcome == "pass"

def test_digests(broadside_recorder):
    broadside_recorder.assert_baseline(record(broadside_recorder))

def test_verdicts(broadside_recorder):
    broadside_recorder.assert_baseline(record(broadside_recorder), kind="verdicts")
'''


class Project:
    def __init__(self, folder):
        self.folder = folder

    def run(self, *arguments, gravity=8.0):
        """Outcome by test name, and what was printed."""
        text = TESTS.format(folder=str(Path(__file__).parent), gravity=gravity)
        (self.folder / "test_pile.py").write_text(text, encoding="utf-8")
        command = [sys.executable, "-B", "-m", "pytest", "-p", "no:cacheprovider", "-rA", *arguments]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=False)
        words = ("PASSED", "FAILED", "ERROR")
        said = [line.split()[:2] for line in done.stdout.splitlines() if line.startswith(words)]
        return {name.rpartition("::")[2]: word for word, name in said}, done.stdout


@pytest.fixture
def project(tmp_path):
    return Project(tmp_path)


def test_a_law_that_holds_and_one_that_does_not(project):
    outcomes, _ = project.run("-k", "lawful")
    assert outcomes == {"test_lawful": "PASSED"}
    outcomes, said = project.run("-k", "lawful", gravity=10.0)
    assert outcomes == {"test_lawful": "FAILED"}
    assert "mine: ballistic FAIL: measured 31.2 mm/s, limit" in said
    assert "dv = -0.1562 m/s, g h + F h / m = -0.125 m/s" in said, "the law's worked line"
    artifacts = project.folder / "broadside-artifacts/test_pile/test_lawful"
    page = artifacts / "mine.report.html"
    assert page.is_file() and "ballistic" in page.read_text(encoding="utf-8")
    assert f"report: {page.relative_to(project.folder)}" in said
    rows = json.loads((artifacts / "mine.verdicts.json").read_text(encoding="utf-8"))["rows"]
    assert any(v["outcome"] == "fail" for v in rows[0]["verdicts"])


def test_baselines_are_written_only_when_asked(project):
    outcomes, said = project.run("-k", "digests or verdicts")
    assert set(outcomes.values()) == {"FAILED"} and "pytest --broadside-update writes it" in said
    assert not (project.folder / "broadside_baselines").exists()
    outcomes, said = project.run("-k", "digests or verdicts", "--broadside-update")
    assert set(outcomes.values()) == {"PASSED"} and said.count("broadside: baseline written: ") == 2
    outcomes, _ = project.run("-k", "digests or verdicts")
    assert set(outcomes.values()) == {"PASSED"}


def test_a_change_is_named(project):
    project.run("-k", "digests or verdicts", "--broadside-update")
    # The last bit of gravity changes every frame and no verdict but the one of exact free fall.
    outcomes, said = project.run("-k", "digests or verdicts", gravity=8.0 * (1 + 2.0**-20))
    assert outcomes["test_digests"] == "FAILED" and "of 30 frames differ" in said and "step 1: the digest is 0x" in said
    assert outcomes["test_verdicts"] == "FAILED" and "ballistic: fail, and the baseline has pass" in said
    assert "--broadside-update keeps what is there now" in said


def test_artifacts_go_where_they_are_sent(project):
    outcomes, _ = project.run("-k", "lawful", "--broadside-artifacts", "kept", gravity=10.0)
    assert outcomes == {"test_lawful": "FAILED"}
    assert (project.folder / "kept/test_pile/test_lawful/mine.report.html").is_file()
