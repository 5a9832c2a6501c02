"""Runs one check of this folder over the repository:  run_check.py NAME ROOT

Exit codes: 0 nothing found, 1 something found, 77 the check's tool is absent (CTest counts that as skipped).
"""

import importlib
import sys

from formatting import Absent
from source_tree import SourceTree


def main(name, root):
    try:
        found = importlib.import_module(name).violations(SourceTree(root))
    except Absent as reason:
        print(f"skipped: {reason}")
        return 77
    for line in found:
        print(line)
    print(f"{name}: {len(found)} violation(s)")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
