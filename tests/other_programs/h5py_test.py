"""The example of h5py and pandas runs, and counts the contacts that the program itself counted."""

import json
import sys
import tempfile
from pathlib import Path

from recorded_run import interpreter_with, record, run

program, source = sys.argv[1], Path(sys.argv[2])
python = interpreter_with("h5py", "pandas")
with tempfile.TemporaryDirectory() as folder:
    trace = record(program, folder, "two-body:resting", 5)
    said = json.loads((Path(folder) / "cells.json").read_text())["rows"][0]["notes"]["pairs: contacts, mean"]
    printed = run(python, source / "core/trace/reading_a_trace.py", trace)

print(printed)
head, names, *rows = printed.splitlines()
if head != "octree-cpu on two-body:resting" or names.split() != ["step", "contacts", "deepest_m"]:
    sys.exit("the example printed another head")
steps = [int(row.split()[0]) for row in rows]
contacts = [int(row.split()[1]) for row in rows]
if steps != [1, 2, 3, 4, 5] or f"{sum(contacts) / 5:.4g}" != said:
    sys.exit(f"steps {steps} with contacts {contacts}, and the program said a mean of {said}")
