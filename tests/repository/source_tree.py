"""The files of the repository, as the checks in this folder see them."""

import subprocess
from pathlib import Path

CODE = {".hpp", ".cpp", ".cuh", ".cu"}
TEXT = CODE | {".py", ".sh", ".md", ".cmake", ".txt", ".json", ".toml", ".js", ".ts", ".html", ".css", ".svg", ".csv", ""}


class SourceTree:
    """Tracked and new files of a checkout; every file of a folder that is no checkout (an unpacked archive)."""

    def __init__(self, root):
        self.root = Path(root)
        self.paths = sorted(self._listed())

    def _listed(self):
        answer = subprocess.run(
            ["git", "-C", str(self.root), "ls-files", "-co", "--exclude-standard", "-z"],
            capture_output=True, check=False)
        top = subprocess.run(
            ["git", "-C", str(self.root), "rev-parse", "--show-toplevel"], capture_output=True, text=True, check=False)
        if answer.returncode == 0 and Path(top.stdout.strip()).resolve() == self.root.resolve():
            names = [name for name in answer.stdout.decode().split("\0") if name]
            return [name for name in names if (self.root / name).is_file()]
        skipped = ("build", "out", ".cache", "node_modules")
        found = (path.relative_to(self.root) for path in self.root.rglob("*") if path.is_file())
        return [str(path) for path in found if not path.parts[0].startswith(skipped) and not {".git", "node_modules"} & set(path.parts)]

    def with_suffix(self, suffixes):
        return [name for name in self.paths if Path(name).suffix in suffixes]

    def lines(self, name):
        """(number, text) of each line; a file that is not text has none."""
        try:
            return list(enumerate((self.root / name).read_text(encoding="utf-8").splitlines(), start=1))
        except UnicodeDecodeError:
            return []
