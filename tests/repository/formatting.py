"""Every source is as clang-format 14 leaves it. Other versions format differently and are not used."""

import re
import shutil
import subprocess

from source_tree import CODE

VERSION = "14"


class Absent(Exception):
    """Raised when the tool of a check is not on this machine."""


def clang_format():
    for name in (f"clang-format-{VERSION}", "clang-format"):
        path = shutil.which(name)
        if path:
            answer = subprocess.run([path, "--version"], capture_output=True, text=True, check=True).stdout
            if re.search(rf"version {VERSION}\.", answer):
                return path
    raise Absent(f"clang-format {VERSION} is not installed")


def violations(tree):
    names = tree.with_suffix(CODE)
    if not names:
        return []
    answer = subprocess.run(
        [clang_format(), "--dry-run", "--Werror", "--ferror-limit=1", "--style=file", *names],
        cwd=tree.root, capture_output=True, text=True, check=False)
    faults = re.findall(r"^(.+?:\d+):\d+: error:", answer.stderr, re.MULTILINE)
    if answer.returncode != 0 and not faults:
        return [f"clang-format: {answer.stderr.strip()}"]
    return [f"{fault}: run {clang_format()} -i on it" for fault in faults]
