"""The workflows and actions in .github/: YAML that the forge can read, with commands that are there.

A stand-in for the forge's own check, which needs its servers: each file has a name, a trigger and jobs; each job a machine, a limit
of time and steps; each step is an action with a version or a command; and each command of a run: line is a program of this tree,
of cmake/packages.txt's machine, or of the hosted machine. An action's steps have scripts, which bash reads without running them; they reach
this tree through $GITHUB_ACTION_PATH, and its inputs through the environment alone, so that no input is ever a part of a script.
"""

import re
import shlex
import shutil
import subprocess

from formatting import Absent

FOLDER = ".github/workflows/"
ACTIONS = re.compile(r"^\.github/actions/[a-z_]+/action\.yml$")
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
        if name.startswith(FOLDER) or ACTIONS.match(name):
            text = (tree.root / name).read_text(encoding="utf-8")
            try:
                table = yaml.safe_load(text)
                faults = _faults(tree, table, text) if name.startswith(FOLDER) else _action_faults(tree, table, name)
                found += [f"{name}: {fault}" for fault in faults]
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


ACTION_STEP_KEYS = STEP_KEYS | {"shell", "continue-on-error"}
IN_TREE = re.compile(r'"\$GITHUB_ACTION_PATH/([^"]+)"')


def _action_faults(tree, action, name):
    if not isinstance(action, dict) or not action.get("name") or not action.get("description"):
        yield "it has no name, or no description"
        return
    if action.get("runs", {}).get("using") != "composite" or not action["runs"].get("steps"):
        yield "it is no composite action with steps"
        return
    for key, given in (action.get("inputs") or {}).items():
        if not given.get("description") or ("default" in given) == bool(given.get("required")):
            yield f"the input {key} has no description, or not exactly one of default and required"
    for step in action["runs"]["steps"]:
        yield from _action_step_faults(tree, action, step, (tree.root / name).parent)


def _action_step_faults(tree, action, step, folder):
    unknown = set(step) - ACTION_STEP_KEYS
    if unknown:
        yield f"a step has the key {sorted(unknown)[0]}"
    if ("uses" in step) == ("run" in step) or ("run" in step) != ("shell" in step):
        yield "a step is either an action (uses) or a script (run, with its shell)"
    if "uses" in step and not ACTION.match(step["uses"]):
        yield f"{step['uses']} names no version"
    for used in re.findall(r"inputs\.([\w-]+)", str(step)):
        if used not in (action.get("inputs") or {}):
            yield f"there is no input {used}"
    script = str(step.get("run", ""))
    if EXPRESSION.search(script):
        yield "an expression is a part of a script; hand it over in env"
    read = subprocess.run(["bash", "-n"], input=script, capture_output=True, text=True, check=False)
    if read.returncode != 0:
        yield f"bash cannot read a script: {read.stderr.strip()}"
    for path in IN_TREE.findall(script):
        place = (folder / path).resolve()
        if not place.is_file() or not place.stat().st_mode & 0o100:
            yield f"{path} is no program of this tree"


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
