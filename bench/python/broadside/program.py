"""The program broadside, which the wheel holds: engines that may abort run in its processes, not in this one."""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from .errors import error_of


def path() -> str:
    """The program: $BROADSIDE_PROGRAM, or that of the wheel."""
    return os.environ.get("BROADSIDE_PROGRAM") or str(Path(__file__).parent / "bin" / "broadside")


@dataclass(frozen=True)
class Answer:
    """What a command printed, and its exit code: 0 good; 1 a law is broken or a regression; 3 inconclusive."""

    exit_code: int
    text: str
    command: tuple

    @property
    def ok(self) -> bool:
        return self.exit_code == 0

    def __str__(self) -> str:
        return self.text


def call(*arguments: object, passes: tuple[int, ...] = (0,)) -> Answer:
    """Runs the program. An exit code that is not in `passes` raises its exception, with the line that was printed."""
    command = (path(), *map(str, arguments))
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if done.returncode not in passes:
        raise error_of(_last_line(done), done.returncode)
    return Answer(done.returncode, done.stdout, command)


def _last_line(done):
    """The error's own line where there is one."""
    said = [line for line in done.stderr.splitlines() if line.startswith("broadside: ")]
    if said:
        return said[-1].removeprefix("broadside: ")
    rest = (done.stdout.strip() or done.stderr.strip()).splitlines()
    return rest[-1] if rest else f"broadside ended with {done.returncode}; it printed nothing"


def main() -> None:
    """The command `broadside` of this environment."""
    os.execv(path(), [path(), *sys.argv[1:]])
