"""Words that must not be in the tree: unfinished work, one machine's paths, package registries' hosts."""

import re

from source_tree import TEXT
from pathlib import Path

# Each pattern is written so that this file does not match itself.
FORBIDDEN = {
    "unfinished by its own words": re.compile(r"\b(TO" r"DO|FIX" r"ME|XX" r"X|not implement" r"ed|place" r"holder|st" r"ub)\b"),
    "a path of one machine": re.compile(r"(?<![\w.$})/])/(?:home|root|work|Users|tmp|mnt)/\w"),
    "a package registry's host": re.compile(
        r"\b(?:deb|security|snapshot)\.debian\.org|\b(?:archive|security)\.ubuntu\.com|registry\.npm" r"js\.org|\bpypi" r"\.org"),
}


def violations(tree):
    found = []
    for name in tree.paths:
        if Path(name).suffix not in TEXT or name == "LICENSE":
            continue
        for number, line in tree.lines(name):
            found += [f"{name}:{number}: {why}: {match.group(0)}"
                      for why, pattern in FORBIDDEN.items() for match in [pattern.search(line)] if match]
    return found
