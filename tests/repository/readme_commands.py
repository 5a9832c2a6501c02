"""The commands of README.md, run as a reader would run them:  readme_commands.py PROGRAM README

Blocks marked with <!-- tested --> are run line by line in one empty folder, where ./broadside is the program that was
built. A line exits 0, or what its comment says: "# exits 1".
"""

import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

BLOCK = re.compile(r"^<!-- tested -->\n```sh\n(.*?)^```$", re.MULTILINE | re.DOTALL)
EXITS = re.compile(r"#\s*exits (\d+)\s*$")


def commands(text):
    """(command, expected exit code) of every line of every marked block."""
    lines = [line for block in BLOCK.findall(text) for line in block.splitlines() if line.strip()]
    return [(line, int(match.group(1)) if match else 0) for line in lines for match in [EXITS.search(line)]]


def failures(found, program):
    """Runs the commands in order; stops at the first that exits otherwise and says how."""
    with tempfile.TemporaryDirectory(prefix="readme-") as scratch:
        Path(scratch, "broadside").symlink_to(program)
        for line, expected in found:
            started = time.monotonic()
            answer = subprocess.run(["bash", "-c", line], cwd=scratch, stdin=subprocess.DEVNULL, text=True,
                                    stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
            print(f"{time.monotonic() - started:7.1f} s  exit {answer.returncode}  {line}", flush=True)
            if answer.returncode != expected:
                return [f"expected exit {expected}, saw {answer.returncode}: {line}\n{answer.stdout}"]
    return []


def main(program, readme):
    found = commands(Path(readme).read_text(encoding="utf-8"))
    if not found:
        print(f"{readme} has no block marked <!-- tested -->")
        return 1
    wrong = failures(found, Path(program).resolve())
    print("\n".join(wrong) if wrong else f"{len(found)} commands, each as the page says")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
