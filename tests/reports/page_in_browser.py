"""Runs browser/page_test.mjs with the installed Chromium:  page_in_browser.py PROGRAM WORK

Exits 77 (skipped) with the reason where Chromium, node or the packages of browser/package-lock.json cannot be installed.
"""

import hashlib
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent / "browser"
BROWSERS = ("chromium", "chromium-browser", "google-chrome")


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(77)


def install(work):
    """The test's own packages, once per lock file."""
    for name in ("package.json", "package-lock.json", "page_test.mjs"):
        shutil.copy(HERE / name, work / name)
    lock = hashlib.sha256((HERE / "package-lock.json").read_bytes()).hexdigest()
    stamp = work / "node_modules" / ".installed"
    if stamp.is_file() and stamp.read_text(encoding="utf-8") == lock:
        return
    answer = subprocess.run(["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--prefer-offline", "--fetch-retries=1",
                             "--loglevel=error"], cwd=work, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if answer.returncode != 0:
        skip(f"npm ci: {(answer.stderr.strip().splitlines() or ['failed'])[0]}")
    stamp.write_text(lock, encoding="utf-8")


def main(program, work):
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    if browser is None:
        skip("no Chromium is installed (Debian: chromium)")
    if shutil.which("node") is None or shutil.which("npm") is None:
        skip("node or npm is not installed")
    work = Path(work).resolve()
    work.mkdir(parents=True, exist_ok=True)
    install(work)
    return subprocess.run(["node", "page_test.mjs", str(Path(program).resolve()), browser, str(work / "pages"),
                           str(HERE.parents[2] / "datasets/scenes/errata_E3.toml")], cwd=work,
                          stdin=subprocess.DEVNULL, check=False).returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
