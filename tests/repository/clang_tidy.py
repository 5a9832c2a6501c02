"""clang-tidy 14 finds nothing in the sources that changed, by .clang-tidy:  clang_tidy.py ROOT BUILD [--all [WORD] | SOURCE...]

Changed: since the commit of BROADSIDE_TIDY_SINCE; without it since the branch left origin/main or main; on main itself,
in the last commit. What is not committed counts. Of a header that changed, the source of its name is looked at; other
sources that include it are left to --all, which .ci/nightly takes: it goes unit by unit as the build compiles them, ten
to forty sources at once, since most of the time goes into headers that all of them include. With WORD it takes units
that have a source with that word in its path. Exit codes: 0 nothing found, 1 something found, 77 clang-tidy or the list
of compile commands is absent.
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
FOLDERS = ("core/", "gpu/", "reference/", "validation/", "datasets/", "reports/", "bench/")
# Sources that presets without CUDA do not compile, or that are built against an installed tree.
LEFT_OUT = re.compile(r"/examples/|^bench/benchmarks/")
INCLUDED = re.compile(r'^#include "(.+)"$', re.MULTILINE)
# For a unit, everything that it includes is checked, except kernels (.cuh), where 64 bits of an index cost registers.
# That a unit includes sources is intended.
# includes sources is right.
OF_A_UNIT = (r"--header-filter=/(core|gpu|reference|validation|bench|datasets|reports)/.*\.(hpp|cpp)$",
             "--checks=-bugprone-suspicious-include")
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


def files_of(command):
    """The sources that a compile command compiles: those that its unit includes, or one."""
    unit = Path(command["directory"]) / command["file"]
    if unit.parent.name == "Unity" and unit.exists():
        return INCLUDED.findall(unit.read_text(encoding="utf-8"))
    return [command["file"]]


def commands_of_files(commands):
    """One command for each file that a unit of several includes."""
    return [{**command, "file": file, "command": command["command"].replace(command["file"], file)}
            for command in commands for file in files_of(command)]


def units_with(commands, root, word):
    """The files to look at: what the build compiles of our folders, and has a source with this word in its path."""
    units = set()
    for command in commands:
        names = [str(Path(file).relative_to(root)) for file in files_of(command) if Path(file).is_relative_to(root)]
        if any(name.startswith(FOLDERS) and name.endswith(".cpp") and not LEFT_OUT.search(name) and word in name for name in names):
            units.add(command["file"])
    return sorted(units)


def findings(program, root, build, name):
    arguments = OF_A_UNIT if Path(name).parent.name == "Unity" else ()
    answer = subprocess.run([program, "-p", str(build), "--quiet", *arguments, name], cwd=root, capture_output=True, text=True,
                            check=False)
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
    commands = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    takes_units = what[:1] == ("--all",)
    if takes_units:
        names = units_with(commands, root, *(what[1:] or ("",)))
    else:
        commands = commands_of_files(commands)
    if not what:
        since = start_of_changes(root)
        changed = git(root, "diff", "--name-only", "--diff-filter=d", since).splitlines()
        names = sources_of(changed + git(root, "ls-files", "-o", "--exclude-standard").splitlines(), SourceTree(root).paths)
        compiled = {command["file"] for command in commands}
        names = [name for name in names if str(root / name) in compiled]
        print(f"{len(names)} sources changed since {since}")
    elif not takes_units:
        names = list(what)
    found = set()
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as workers:
        (Path(folder) / "compile_commands.json").write_text(json.dumps(commands), encoding="utf-8")
        for more in workers.map(lambda name: findings(program, root, folder, name), names):
            for line in sorted(more - found):
                print(line, flush=True)
            found |= more
    print(f"clang-tidy: {len(names)} {'units' if takes_units else 'sources'}, {len(found)} finding(s)")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), *sys.argv[3:]))
