"""The nightly run as its workflow file has it:  nightly_test.py PROGRAM

The workflow's lines that make and show the report are run for three nights with a built program and small scenes; the third night has
a wrong engine, and the night must say so.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def commands():
    """The workflow's commands, line by line, without the set-up of a hosted machine and the check of sources."""
    text = (ROOT / ".github/workflows/nightly.yml").read_text(encoding="utf-8")
    return [line for line in re.findall(r"^ +run: (.+)$", text, re.MULTILINE) if "out/nightly" in line]


def night(tree, program, **more):
    """Exit codes of the workflow's commands in one night."""
    environment = {**os.environ, "BROADSIDE_PROGRAM": program, "GITHUB_STEP_SUMMARY": str(tree / "summary"),
                   "NIGHTLY_SCENES": "errata:E3", "NIGHTLY_ENGINES": "octree-cpu all-pairs", "NIGHTLY_FRAMES": "20",
                   "NIGHTLY_PROCESSES": "0", **more}
    codes = []
    for line in commands():
        answer = subprocess.run(["bash", "-c", line], cwd=tree, env=environment, stdin=subprocess.DEVNULL, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        print(f"exit {answer.returncode}  {line}\n{answer.stdout}")
        codes.append(answer.returncode)
    return codes


def main(program):
    with tempfile.TemporaryDirectory(prefix="nightly-") as scratch:
        tree = Path(scratch)
        (tree / ".ci").mkdir()
        shutil.copy(ROOT / ".ci/nightly", tree / ".ci/nightly")
        assert len(commands()) == 2, commands()
        assert night(tree, program) == [0, 0], "a sound engine's first night"
        assert night(tree, program) == [0, 0], "the same program again"
        results = tree / "out/nightly"
        for name in ("report.md", "junit.xml", "benchmark.json", "history.sqlite", "last/cells.json"):
            assert (results / name).stat().st_size > 0, name
        assert (tree / "summary").read_text(encoding="utf-8").count("## Broadside: Nightly") == 2
        # A wrong build under the same name, as a bad change would make.
        wrong = tree / "wrong"
        wrong.write_text('#!/bin/bash\ntonight=out/nightly/tonight\n'
                         '[[ $1 != plan ]] || sed -i \'/^engines/s/"octree-cpu"/"octree-cpu[variant=printed-E3]"/\' "$tonight/nightly.toml"\n'
                         f'"{program}" "$@"\ncode=$?\n'
                         # compare matches cells by label: here the wrong engine has the sound one's label.
                         'for f in "$tonight"/{cells,verdicts,samples}.json; do\n'
                         '  [[ ! -f $f ]] || sed -i \'s/"settings_short":"variant=printed-E3"/"settings_short":""/g\' "$f"\ndone\n'
                         'exit $code\n', encoding="utf-8")
        wrong.chmod(0o755)
        assert night(tree, str(wrong)) == [1, 0], "a verdict that got worse is exit code 1, and the report is written"
        shown = subprocess.run([program, "history", str(results / "history.sqlite")], text=True, capture_output=True, check=True)
        assert "verdicts failed: 3 runs" in shown.stdout, shown.stdout
    print("three nights, each as the workflow says")


if __name__ == "__main__":
    main(str(Path(sys.argv[1]).resolve()))
