"""CONTRIBUTING.md in a scratch copy of the tree:  contributing_test.py ROOT

Adds the page's engine, validator and scene by exactly its steps, builds, runs the page's commands, and the shared tests
of engines over the new one.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import contributing
import readme_commands
from source_tree import SourceTree


def copy_of(root, scratch):
    for name in SourceTree(root).paths:
        (scratch / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(Path(root) / name, scratch / name, follow_symlinks=False)


def run(arguments, folder):
    answer = subprocess.run(arguments, cwd=folder, env={**os.environ, "CCACHE_BASEDIR": str(folder)}, text=True,
                            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    if answer.returncode != 0:
        sys.exit(f"{' '.join(arguments)}: exit {answer.returncode}\n{answer.stdout[-8000:]}")
    return answer.stdout


def main(root):
    with tempfile.TemporaryDirectory(prefix="contributing-") as folder:
        scratch = Path(folder)
        copy_of(root, scratch)
        page = (scratch / contributing.PAGE).read_text(encoding="utf-8")
        steps = contributing.steps(page)
        assert [step.is_file for step in steps].count(True) == 3, "an engine, a validator and a scene"
        for step in steps:
            place = scratch / step.name
            place.write_text(contributing.changed(step, "" if step.is_file else place.read_text(encoding="utf-8")), encoding="utf-8")
        run(["cmake", "--preset", "cpu", "-DBROADSIDE_REPORT_HTML=OFF"], scratch)
        run(["cmake", "--build", "build/cpu", "--target", "broadside", "tests_reference", "tests_datasets"], scratch)
        wrong = readme_commands.failures(readme_commands.commands(page), scratch / "build/cpu/bench/broadside")
        if wrong:
            sys.exit("\n".join(wrong))
        for target, tests in (("tests_reference", "*sorted_x*"), ("tests_datasets", "*Family*/row")):
            said = run([str(scratch / "build/cpu/tests" / target), f"--gtest_filter={tests}"], scratch)
            assert "[  PASSED  ]" in said and "[  PASSED  ] 0 tests" not in said, said
    print("engine, validator and scene: added by the page's steps, built, run and tested")


if __name__ == "__main__":
    main(str(Path(sys.argv[1]).resolve()))
