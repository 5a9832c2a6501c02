"""The lines that README.md says a newcomer writes are those of its own blocks and of the recorders."""

import os
import re
from pathlib import Path

ROOM = Path(os.environ["BROADSIDE_SOURCE"]) / "bench/python"


def test_the_table_of_costs_counts_the_pages_own_blocks():
    text = (ROOM / "README.md").read_text(encoding="utf-8")
    found = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    blocks = [[line for line in block.splitlines() if line.strip()] for block in found]
    trace, engine, test = (len(lines) for lines in blocks[:3])
    assert f"| a trace of yours, judged | {trace} lines" in text, trace
    assert f"| a class as an engine, run and judged | {engine} lines" in text, engine
    assert f"| a test in pytest with a baseline | {test} lines" in text, test
    files = (ROOM / "examples").glob("*_recorder.py")
    recorders = [len(file.read_text(encoding="utf-8").splitlines()) for file in files]
    assert f"| a recorder of a simulator | {min(recorders)} to {max(recorders)} lines" in text, recorders


def test_the_gates_lines_are_those_of_its_page():
    page = (ROOM.parents[1] / ".github/actions/gate/README.md").read_text(encoding="utf-8")
    campaign, workflow = re.search(r"(\d+) lines of campaign and (\d+) of workflow", page).groups()
    assert f"{campaign} lines of campaign, {workflow} of workflow" in (ROOM / "README.md").read_text(encoding="utf-8")
