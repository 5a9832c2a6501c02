"""Writes the results files of gpu/results. Every script here that measures writes one, and `gpu/measured` makes a page
from all of them.

A file says when it was made, on which GPU and by which command; what its rows have is up to the script. The command is
stored without folders, which differ from machine to machine.

As a program, for scripts that are not Python:  gpu/result_file.py OUT.json ROW_FILE... -- COMMAND...
"""
import csv
import datetime
import json
import os
import subprocess
import sys

GPU_FACTS = "name,driver_version,memory.total,clocks.max.sm,clocks.max.memory,power.limit"


def gpu_facts():
    """What nvidia-smi says of the first GPU; empty where there is none."""
    try:
        line = subprocess.run(["nvidia-smi", f"--query-gpu={GPU_FACTS}", "--format=csv,noheader"], check=True,
                              capture_output=True, text=True).stdout.splitlines()[0]
    except (OSError, subprocess.CalledProcessError, IndexError):
        return {}
    return dict(zip(GPU_FACTS.split(","), (part.strip() for part in line.split(","))))


def gpu_of(path):
    """The facts of the first GPU, from a file with what `nvidia-smi --query-gpu=... --format=csv` printed."""
    with open(path, encoding="utf-8") as file:
        header, first = list(csv.reader(file))[:2]
    return {name.strip().split(" [")[0]: value.strip() for name, value in zip(header, first)}


def without_folder(argument):
    return os.path.basename(argument.rstrip("/")) if argument.startswith("/") else argument


def head(arguments):
    """The entries that every file has. `arguments`: those of the script, its own name first."""
    words = ["gpu/" + os.path.basename(arguments[0]), *(without_folder(word) for word in arguments[1:])]
    return {"when": datetime.date.today().isoformat(), "gpu": gpu_facts(), "command": " ".join(words)}


def write(path, result):
    """Writes the file so that it appears complete or not at all."""
    with open(path + ".part", "w", encoding="utf-8") as file:
        json.dump(result, file, indent=1)
        file.write("\n")
    os.replace(path + ".part", path)


def main(out, *arguments):
    files, command = arguments[:arguments.index("--")], arguments[arguments.index("--") + 1:]
    rows = []
    for name in files:
        with open(name, encoding="utf-8") as file:
            rows.append(json.load(file))
    write(out, {**head(command), "rows": rows})


if __name__ == "__main__":
    main(*sys.argv[1:])
