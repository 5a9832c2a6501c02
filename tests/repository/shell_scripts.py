"""shellcheck finds nothing in the shell scripts."""

import shutil
import subprocess

from formatting import Absent


def violations(tree):
    scripts = [name for name in tree.paths if any("bash" in text and text.startswith("#!") for _, text in tree.lines(name)[:1])]
    if not scripts:
        return []
    tool = shutil.which("shellcheck")
    if not tool:
        raise Absent("shellcheck is not installed")
    answer = subprocess.run([tool, "-x", "-f", "gcc", *scripts], cwd=tree.root, capture_output=True, text=True, check=False)
    return answer.stdout.splitlines()
