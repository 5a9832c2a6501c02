"""Each change of tests/mutate/changes.txt still applies: its file is there and has the old text exactly once."""

import importlib.util
from pathlib import Path

LIST = "tests/mutate/changes.txt"


def violations(tree):
    if not (tree.root / LIST).is_file():
        return []
    path = Path(__file__).resolve().parents[1] / "mutate" / "mutate.py"
    spec = importlib.util.spec_from_file_location("mutate", path)
    mutate = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(mutate)
    try:
        changes = mutate.read_changes(tree.root / LIST)
    except ValueError as reason:
        return [f"{LIST}: {reason}"]
    found = []
    for change in changes:
        try:
            change.made_in(tree.root)
        except (ValueError, FileNotFoundError) as reason:
            found.append(f"{LIST}: {reason}")
    return found
