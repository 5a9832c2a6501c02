"""Changes one line of the source at a time and asks whether a test notices:  mutate.py [--only WORDS] [--folder DIR]

Each change of changes.txt is made in a scratch git worktree of this commit, what its tests need is built, and they are
run: "killed" when one of them fails, "SURVIVED" when all pass. Python's standard library, git, cmake and ctest.

Exit codes: 0 every change without a reason of its own was killed, 1 one survived, 2 a change or the build is wrong.
"""

import argparse
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FIELDS = ("file", "old", "new", "target", "tests", "lives")
SECONDS_OF_TESTS = 900


class Change:
    """file: path; old, new: text of one line or a part of it; target: what to build; tests: a regex of ctest's names;
    lives: why no test can notice, where none can."""

    def __init__(self, fields, line):
        self.line = line
        for name in FIELDS:
            setattr(self, name, fields.get(name, ""))

    def made_in(self, root):
        """The file's text with the change. Raises ValueError unless the old text is there exactly once."""
        text = (root / self.file).read_text(encoding="utf-8")
        count = text.count(self.old)
        if count != 1:
            raise ValueError(f"changes.txt:{self.line}: '{self.old}' is {count} times in {self.file}")
        return text.replace(self.old, self.new)


def read_changes(path):
    """Blocks of `name: value` lines, parted by blank lines; # begins a comment line."""
    changes, fields, first = [], {}, 0
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines() + [""], start=1):
        if line.startswith("#"):
            continue
        if not line.strip():
            if fields:
                missing = [name for name in FIELDS[:-1] if name not in fields and name != "new"]
                if missing:
                    raise ValueError(f"changes.txt:{first}: no {missing[0]}")
                changes.append(Change(fields, first))
            fields = {}
            continue
        name, colon, value = line.partition(":")
        if not colon or name not in FIELDS or name in fields:
            raise ValueError(f"changes.txt:{number}: '{line}' is no field")
        first = first if fields else number
        fields[name] = value.strip()
    return changes


def run(command, folder, **more):
    return subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
                          **more)


class Scratch:
    """A worktree of HEAD and its build, kept between runs where a folder is given."""

    def __init__(self, folder, jobs):
        self.root, self.jobs = folder, jobs
        if not (folder / "CMakeLists.txt").is_file():
            self._must(["git", "-C", str(ROOT), "worktree", "add", "--detach", str(folder), "HEAD"], ROOT)
        self._must(["git", "checkout", "-q", "--force", "--detach", run(["git", "rev-parse", "HEAD"], ROOT).stdout.strip()],
                   folder)
        if not (folder / "build/cpu/CMakeCache.txt").is_file():
            self._must(["cmake", "--preset", "cpu"], folder)

    @staticmethod
    def _must(command, folder):
        answer = run(command, folder)
        if answer.returncode != 0:
            raise ValueError(f"{' '.join(command)}: {answer.stdout.strip().splitlines()[-1]}")

    def build(self, target):
        return run(["cmake", "--build", "build/cpu", "-j", str(self.jobs), "--target", *target.split()], self.root)

    def passes(self, tests):
        """Whether all of these tests pass, and the name of the first that fails. ValueError: there are none."""
        try:
            answer = run(["ctest", "--test-dir", "build/cpu", "-R", tests, "-LE", "^gpu$", "--stop-on-failure"], self.root,
                         timeout=SECONDS_OF_TESTS)
        except subprocess.TimeoutExpired:
            return False, "no end within the time"
        if "No tests were found" in answer.stdout:
            raise ValueError(f"no test is named {tests}")
        marks = ("***Failed", "***Timeout", "***Exception")
        failed = [line.strip() for line in answer.stdout.splitlines() if any(mark in line for mark in marks)]
        return answer.returncode == 0, failed[0] if failed else ""

    def judge(self, change):
        """The outcome (word, what was seen) of one change. The file is restored afterwards."""
        path = self.root / change.file
        before = path.read_text(encoding="utf-8")
        path.write_text(change.made_in(self.root), encoding="utf-8")
        try:
            built = self.build(change.target)
            if built.returncode != 0:
                return "does not build", next((x for x in built.stdout.splitlines() if "error" in x), "")
            lives, which = self.passes(change.tests)
            return ("SURVIVED" if lives else "killed"), which
        finally:
            path.write_text(before, encoding="utf-8")


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--only", default="", help="changes whose file or texts contain this")
    options.add_argument("--folder", type=Path, help="a scratch worktree to keep; a later run builds less")
    options.add_argument("--jobs", type=int, default=2)
    options.add_argument("--list", type=Path, default=Path(__file__).with_name("changes.txt"))
    given = options.parse_args()
    try:
        changes = [c for c in read_changes(given.list) if given.only in f"{c.file} {c.old} {c.new} {c.target}"]
        for change in changes:
            change.made_in(ROOT)
        folder = given.folder or Path(tempfile.mkdtemp(prefix="broadside-mutate-")) / "tree"
        scratch = Scratch(folder, given.jobs)
        words = judge_all(scratch, changes)
    except ValueError as reason:
        print(f"mutate: {reason}", file=sys.stderr)
        return 2
    finally:
        if given.folder is None and "folder" in locals():
            run(["git", "-C", str(ROOT), "worktree", "remove", "--force", str(folder)], ROOT)
    killed = words.count("killed")
    print(f"{killed} of {len(words)} killed, {words.count('SURVIVED')} survived, {words.count('lives')} that no test can see")
    return 2 if "does not build" in words else 1 if "SURVIVED" in words else 0


def judge_all(scratch, changes):
    words = []
    for target in sorted({c.target for c in changes}):
        built = scratch.build(target)
        if built.returncode != 0:
            raise ValueError(f"{target} does not build before any change")
    for change in changes:
        start = time.monotonic()
        word, seen = scratch.judge(change)
        if word == "SURVIVED" and change.lives:
            word, seen = "lives", change.lives
        words.append(word)
        print(f"{word:14} {time.monotonic() - start:5.0f} s  {change.file}: {change.new or '(nothing)'}  {seen}", flush=True)
    return words


if __name__ == "__main__":
    sys.exit(main())
