"""clang-tidy 14 finds nothing in the sources that changed, by .clang-tidy:  clang_tidy.py ROOT BUILD [--all | SOURCE...]

Changed: since the commit of BROADSIDE_TIDY_SINCE; without it since the branch left origin/main or main; on main itself,
in the last commit. What is not committed counts. Of a header that changed, the source of its name is looked at; other
sources that include it are left to --all, which .ci/nightly takes. Exit codes: 0 nothing found, 1 something found, 77
clang-tidy or the list of compile commands is absent.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from source_tree import SourceTree

VERSION = "14"
FOLDERS = ("core/", "reference/", "validation/", "datasets/", "reports/", "bench/")
# Not compiled by the presets that have no CUDA, or built against an installed tree.
LEFT_OUT = re.compile(r"/examples/|^bench/benchmarks/")
INCLUDED = re.compile(r'^#include "(.+)"$', re.MULTILINE)
FINDING = re.compile(r"^(/\S+?):(\d+):\d+: (?:warning|error): (.+)$", re.MULTILINE)


def git(root, *arguments):
    answer = subprocess.run(["git", "-C", str(root), *arguments], capture_output=True, text=True, check=False)
    return answer.stdout.strip() if answer.returncode == 0 else ""


def start_of_changes(root):
    given = os.environ.get("BROADSIDE_TIDY_SINCE")
    if given:
        return given
    for main in ("origin/main", "main"):
        base = git(root, "merge-base", main, "HEAD")
        if base and base != git(root, "rev-parse", "HEAD"):
            return base
    return "HEAD~1"


def sources_of(names, paths):
    """The sources to look at when these files changed."""
    candidates = {re.sub(r"\.hpp$", ".cpp", name) for name in names if name.endswith((".cpp", ".hpp"))}
    return sorted(name for name in candidates & set(paths) if name.startswith(FOLDERS) and not LEFT_OUT.search(name))


def commands_of_files(build):
    """The compile commands, with one for each file that a unit of several includes."""
    commands = []
    for command in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        unit = Path(command["directory"]) / command["file"]
        files = [command["file"]]
        if unit.parent.name == "Unity" and unit.exists():
            files = INCLUDED.findall(unit.read_text(encoding="utf-8"))
        commands += [{**command, "file": file, "command": command["command"].replace(command["file"], file)} for file in files]
    return commands


def findings(program, root, build, name):
    answer = subprocess.run([program, "-p", str(build), "--quiet", name], cwd=root, capture_output=True, text=True, check=False)
    found = {f"{Path(path).relative_to(root)}:{line}: {what}" for path, line, what in FINDING.findall(answer.stdout)
             if Path(path).is_relative_to(root)}
    if answer.returncode != 0 and not found:
        found = {f"{name}: clang-tidy ended with {answer.returncode}: {(answer.stdout + answer.stderr).strip()[-400:]}"}
    return found


def main(root, build, *what):
    program = shutil.which(f"clang-tidy-{VERSION}")
    if not program or not (build / "compile_commands.json").exists():
        print(f"skipped: no clang-tidy-{VERSION}" if not program else f"skipped: no {build}/compile_commands.json")
        return 77
    paths = SourceTree(root).paths
    if what == ("--all",):
        names = sources_of(paths, paths)
    elif what:
        names = list(what)
    else:
        since = start_of_changes(root)
        changed = git(root, "diff", "--name-only", "--diff-filter=d", since).splitlines()
        names = sources_of(changed + git(root, "ls-files", "-o", "--exclude-standard").splitlines(), paths)
        print(f"{len(names)} sources changed since {since}")
    found = set()
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as workers:
        (Path(folder) / "compile_commands.json").write_text(json.dumps(commands_of_files(build)), encoding="utf-8")
        for more in workers.map(lambda name: findings(program, root, folder, name), names):
            for line in sorted(more - found):
                print(line, flush=True)
            found |= more
    print(f"clang-tidy: {len(names)} sources, {len(found)} finding(s)")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), *sys.argv[3:]))
