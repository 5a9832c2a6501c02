"""Broadside in pytest: record in a test, judge by laws, compare with a baseline.

    from broadside.pytest_plugin import assert_lawful

    def test_pile(broadside_recorder):
        with broadside_recorder("rigid:stack:5", engine="mine") as trace:
            for state in my_simulator():
                trace.append(body=state)
        assert_lawful(trace)
        broadside_recorder.assert_baseline(trace, kind="verdicts")

Traces and reports go to broadside-artifacts/TEST/ (--broadside-artifacts). Baselines stand beside the test file, in
broadside_baselines/, and are written by --broadside-update alone: a test without a baseline fails.
"""

import json
import os
import re
from pathlib import Path

import pytest

WRITTEN = pytest.StashKey[list]()


def pytest_addoption(parser):
    group = parser.getgroup("broadside", "traces judged by Broadside")
    group.addoption("--broadside-update", action="store_true",
                    help="write the baselines of assert_baseline anew instead of comparing")
    group.addoption("--broadside-artifacts", metavar="DIR", default="broadside-artifacts",
                    help="folder for recorded traces and reports of failures (default: broadside-artifacts)")


def pytest_configure(config):
    config.stash[WRITTEN] = []


def pytest_terminal_summary(terminalreporter, config):
    for path in config.stash[WRITTEN]:
        terminalreporter.write_line(f"broadside: baseline written: {path}")


def _path(trace):
    """The trace's file. A writer is finished first."""
    if hasattr(trace, "finish"):
        trace.finish()
    return os.fspath(getattr(trace, "path", trace))


def assert_lawful(trace, laws=(), against=None):
    """Fails unless laws were judged on the trace and none is broken or in doubt; returns the Verdicts.

    trace: a Trace, a TraceWriter or a path. A failure has a line for each law: what was measured, the limit, where,
    and where the limit comes from. Report and verdicts are left beside the trace, as NAME.report.html and
    NAME.verdicts.json.
    """
    __tracebackhide__ = True
    import broadside

    path = _path(trace)
    verdicts = broadside.check(path, laws, against)
    if verdicts.ok:
        return verdicts
    stem = path.removesuffix(".h5")
    verdicts.save(stem + ".verdicts.json")
    verdicts.page(stem + ".report.html", f"{Path(stem).name}: laws broken", f"broadside check {path}")
    said = verdicts.lines.strip() or f"no law could be judged on {path}\n{verdicts.table()}"
    raise AssertionError(f"{said}\nreport: {stem}.report.html\nrepeat: broadside check {path}")


class Recorder:
    """Writers and runs whose traces are the test's artifacts."""

    def __init__(self, request):
        name = re.sub(r"[^\w.-]+", "-", request.node.name).strip("-")
        self.folder = Path(request.config.getoption("--broadside-artifacts")) / request.path.stem / name
        self._baselines = request.path.parent / "broadside_baselines"
        self._stem = f"{request.path.stem}.{name}"
        self._is_update = request.config.getoption("--broadside-update")
        self._written = request.config.stash[WRITTEN]

    def __call__(self, scene, engine="engine", declaration=None, **more):
        """A TraceWriter of FOLDER/ENGINE.h5."""
        import broadside

        self.folder.mkdir(parents=True, exist_ok=True)
        file = re.sub(r"[^\w.-]+", "-", engine).strip("-") + ".h5"
        return broadside.TraceWriter(self.folder / file, scene, engine, declaration, **more)

    def run(self, scene, engines, **more):
        """Traces of engines that Broadside runs, one each: broadside.run with its folder."""
        import broadside

        return broadside.run(scene, engines, out=self.folder, **more)

    def assert_baseline(self, trace, kind="digests"):
        """Fails where the trace is not as its baseline: kind "digests", bit by bit, or "verdicts", law by law."""
        __tracebackhide__ = True
        path = _path(trace)
        if kind not in KINDS:
            raise ValueError(f"there is no baseline of {kind!r}; one of: {', '.join(KINDS)}")
        found = KINDS[kind][0](path)
        file = self._baselines / f"{self._stem}.{Path(path).stem}.{kind}.json"
        if self._is_update:
            self._baselines.mkdir(exist_ok=True)
            file.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
            self._written.append(file)
            return
        if not file.is_file():
            raise AssertionError(f"there is no baseline {file}; pytest --broadside-update writes it")
        wrong = KINDS[kind][1](json.loads(file.read_text(encoding="utf-8")), found)
        if wrong:
            raise AssertionError(f"{wrong}\nbaseline: {file}\ntrace: {path}\n"
                                 "pytest --broadside-update keeps what is there now")


def _digests(path):
    import broadside

    trace = broadside.Trace(path)
    return {"scene": f"{trace.scene.digest:#018x}",
            "digests": {str(step): f"{int(digest):#018x}" for step, digest in zip(trace.steps, trace.digests)}}


def _other_digests(baseline, found):
    if baseline["scene"] != found["scene"]:
        return f"the scene differs: its digest is {found['scene']}, and the baseline's is {baseline['scene']}"
    steps = sorted({*baseline["digests"], *found["digests"]}, key=int)
    wrong = [step for step in steps if baseline["digests"].get(step) != found["digests"].get(step)]
    if not wrong:
        return ""
    now, then = (rows["digests"].get(wrong[0], "not recorded") for rows in (found, baseline))
    return (f"step {wrong[0]}: the digest is {now}, and the baseline's {then}; "
            f"{len(wrong)} of {len(steps)} frames differ")


def _verdicts(path):
    import broadside

    return {verdict.law: verdict.outcome for verdict in broadside.check(path)}


def _other_verdicts(baseline, found):
    laws = [law for law in {**baseline, **found} if baseline.get(law) != found.get(law)]
    return "\n".join(f"{law}: {found.get(law, 'not judged')}, and the baseline has {baseline.get(law, 'no such law')}"
                     for law in laws)


KINDS = {"digests": (_digests, _other_digests), "verdicts": (_verdicts, _other_verdicts)}


@pytest.fixture
def broadside_recorder(request):
    """A Recorder: broadside_recorder(scene, engine=...) is a TraceWriter of an artifact of this test."""
    return Recorder(request)
