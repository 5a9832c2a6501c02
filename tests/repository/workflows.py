"""The workflows in .github/workflows/: YAML that the forge can read, with commands that are there.

A stand-in for the forge's own check, which needs its servers: each file has a name, a trigger and jobs; each job a machine, a limit
of time and steps; each step is an action with a version or a command; and each command of a run: line is a program of this tree,
of cmake/packages.txt's machine, or of the hosted machine.
"""

import re
import shlex
import shutil

from formatting import Absent

FOLDER = ".github/workflows/"
ACTION = re.compile(r"^[\w.-]+/[\w./-]+@v\d+$")
STEP_KEYS = {"name", "uses", "run", "with", "if", "env", "id"}
EXPRESSION = re.compile(r"\$\{\{(.*?)\}\}")
KNOWN = re.compile(r"^\s*(github\.(ref|ref_name|run_id|sha)|hashFiles\('([^']+)'\))\s*$")


def violations(tree):
    try:
        import yaml
    except ImportError as reason:
        raise Absent("python3-yaml is not installed") from reason
    found = []
    for name in tree.paths:
        if name.startswith(FOLDER):
            text = (tree.root / name).read_text(encoding="utf-8")
            try:
                found += [f"{name}: {fault}" for fault in _faults(tree, yaml.safe_load(text), text)]
            except yaml.YAMLError as error:
                found.append(f"{name}: it is no YAML: {' '.join(str(error).split())}")
    return found


def _faults(tree, workflow, text):
    if not isinstance(workflow, dict):
        yield "it is no table"
        return
    # YAML 1.1 reads the key `on` as a truth value.
    if not workflow.get("name") or not (workflow.get("on") or workflow.get(True)):
        yield "it has no name, or nothing that starts it"
    for expression in EXPRESSION.findall(text):
        known = KNOWN.match(expression)
        if not known:
            yield f"the expression '{expression.strip()}' is not one that this check knows"
        elif known.group(3) and known.group(3) not in tree.paths:
            yield f"{known.group(3)} is not there"
    for job, table in (workflow.get("jobs") or {"": {}}).items():
        for key in ("runs-on", "timeout-minutes", "steps"):
            if not table.get(key):
                yield f"job {job}: it has no {key}"
        for step in table.get("steps") or []:
            yield from (f"job {job}: {fault}" for fault in _step_faults(tree, step))


def _step_faults(tree, step):
    unknown = set(step) - STEP_KEYS
    if unknown:
        yield f"a step has the key {sorted(unknown)[0]}"
    if ("uses" in step) == ("run" in step):
        yield "a step is either an action (uses) or a command (run)"
    if "uses" in step and not ACTION.match(step["uses"]):
        yield f"{step['uses']} names no version"
    for line in str(step.get("run", "")).splitlines():
        words = shlex.split(line)
        for program in [words[0], *words[1:2]] if words and words[0] == "sudo" else words[:1]:
            if "/" in program and program not in tree.paths:
                yield f"{program} is not there"
            elif "/" in program and not (tree.root / program).stat().st_mode & 0o100:
                yield f"{program} may not be executed"
            elif "/" not in program and program != "sudo" and shutil.which(program) is None:
                yield f"{program} is no program of this machine"
