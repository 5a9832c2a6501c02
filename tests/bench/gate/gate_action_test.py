"""The gate action as a forge runs it:  gate_action_test.py PROGRAM WORK

A user's repository with an engine in C has a bare remote beside it. The commands of each step of action.yml run in it, as for a push to
main, then for pull requests: a sound one, one with a broken engine, and one that mends it. A forge's own actions (caches, artifacts) have
no counterpart here; gh and sudo are scripts. The page of the action is walked through as well: its workflow names what is there.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[3]
ACTION = ROOT / ".github/actions/gate/action.yml"
CAMPAIGN = """name = "gate"
# The engine of this repository.
scenes = [
  "randommove:cube:{n}",
]
engines = ["./libsweep.so"]
frames = 20
against = "all-pairs"
stand_in = true
[vary]
n = [40]
"""
EXPRESSION = re.compile(r"\$\{\{\s*(.*?)\s*\}\}")


def sh(command, folder, check=True, **more):
    answer = subprocess.run(["bash", "-euo", "pipefail", "-c", command], cwd=folder, env={**os.environ, **more}, text=True,
                            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    if check and answer.returncode != 0:
        raise AssertionError(f"exit {answer.returncode}: {command}\n{answer.stdout}")
    return answer


class Forge:
    """One run of the action's steps in a clone of the remote."""

    def __init__(self, scratch, program):
        self.scratch, self.program = scratch, program
        tools = scratch / "tools"
        tools.mkdir()
        (tools / "gh").write_text('#!/bin/sh\n# A first --edit-last finds no comment, as on a new pull request.\n'
                                  f'case "$*" in *--edit-last*) [ -f {scratch}/comment.md ] || exit 1;; esac\n'
                                  f'echo "$@" >>{scratch}/gh.log\ncp "$5" {scratch}/comment.md\n')
        (tools / "gh").chmod(0o755)
        self.path = f"{tools}:{os.environ['PATH']}"

    def value(self, expression, facts):
        """What the forge would put in place of an expression of this action."""
        known = {
            "github.base_ref || github.ref_name": facts["base_ref"] or facts["ref_name"],
            "github.event_name == 'push' && github.ref_name == inputs.base && '--keep' || ''":
                "--keep" if facts["event_name"] == "push" and facts["ref_name"] == facts["base"] else "",
            "inputs.campaign": "campaign.toml", "inputs.base": facts["base"], "inputs.title": "", "inputs.token": "secret",
            "github.event.pull_request.number": "7",
        }
        return known[expression]

    def run(self, clone, event_name, ref_name, base_ref=""):
        facts = {"event_name": event_name, "ref_name": ref_name, "base_ref": base_ref}
        action = yaml.safe_load(ACTION.read_text(encoding="utf-8"))
        facts["base"] = EXPRESSION.sub(lambda m: self.value(m.group(1), {**facts, "base": ""}),
                                       action["inputs"]["base"]["default"])
        conclusion, text = 0, ""
        for step in action["runs"]["steps"]:
            if "run" not in step or step["name"] == "Set up Broadside":  # the program is built already
                continue
            condition = step.get("if", "")
            if "pull_request" in condition and event_name != "pull_request":
                continue
            if conclusion != 0 and "always()" not in condition:
                continue
            environment = {name: EXPRESSION.sub(lambda m: self.value(m.group(1), facts), str(value))
                           for name, value in step.get("env", {}).items()}
            answer = sh(step["run"], clone, check=False, PATH=self.path, BROADSIDE_PROGRAM=self.program,
                        GITHUB_ACTION_PATH=str(ACTION.parent), GITHUB_STEP_SUMMARY=str(self.scratch / "summary"), **environment)
            print(f"--- {event_name} {ref_name}: {step['name']}: exit {answer.returncode}\n{answer.stdout}")
            text += answer.stdout
            if not step.get("continue-on-error"):
                conclusion = conclusion or answer.returncode
            else:
                assert answer.returncode == 0, step["name"]
        return conclusion, text


def user_repository(scratch):
    """A clone with the engine on main, and its bare remote."""
    sh("git init -q --bare -b main remote.git && git init -q -b main user && cd user && git remote add origin ../remote.git", scratch)
    user = scratch / "user"
    sh("git config user.name t && git config user.email t@t && git config commit.gpgsign false", user)
    shutil.copy(ROOT / "core/plugin/examples/sweep.c", user)
    (user / "campaign.toml").write_text(CAMPAIGN, encoding="utf-8")
    (user / ".gitignore").write_text("out/\n*.so\n", encoding="utf-8")
    (user / "Makefile").write_text(f"libsweep.so: sweep.c\n\tcc -shared -fPIC -I{ROOT}/core/plugin -o $@ $<\n", encoding="utf-8")
    return user


def commit(user, branch, edit, subject):
    """Builds the engine after an edit, as a workflow does before the gate."""
    if edit:
        source = (user / "sweep.c").read_text(encoding="utf-8")
        assert edit[0] in source, edit[0]
        (user / "sweep.c").write_text(source.replace(*edit), encoding="utf-8")
    sh(f"make -sB && git checkout -q -B {branch} && git add -A && git commit -q --allow-empty -m '{subject}' && "
       f"git push -q -f origin {branch}", user)


def the_page_shows_what_is_there():
    text = (ACTION.parent / "README.md").read_text(encoding="utf-8")
    action = yaml.safe_load(ACTION.read_text(encoding="utf-8"))
    block = re.search(r"```yaml\n(.*?)```", text, re.DOTALL).group(1)
    workflow = yaml.safe_load(block)
    steps = workflow["jobs"]["gate"]["steps"]
    gate = [step for step in steps if "actions/gate@" in step.get("uses", "")]
    assert len(gate) == 1 and set(gate[0]["with"]) <= set(action["inputs"]), gate
    campaign = re.search(r"```toml\n(.*?)```", text, re.DOTALL).group(1)
    count = [sum(not line.startswith("#") for line in part.splitlines()) for part in (campaign, block)]
    assert f"{count[0]} lines of campaign and {count[1]} of workflow" in text, count
    for name in action["inputs"]:
        assert f"`{name}`" in text, f"the page does not explain the input {name}"


def main(program, work):
    the_page_shows_what_is_there()
    Path(work).mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="gate-", dir=work) as folder:
        scratch = Path(folder)
        user = user_repository(scratch)
        forge = Forge(scratch, program)

        commit(user, "main", None, "An engine")
        code, text = forge.run(user, "push", "main")
        assert code == 0 and "so the verdicts themselves decide" in text, text
        kept = sh("git ls-tree -r --name-only broadside-history", scratch / "remote.git").stdout.split()
        assert kept == [f"main/campaign/{name}" for name in ("cells.json", "history.sqlite", "samples.json", "verdicts.json")], kept

        commit(user, "note", ("A broad phase in C", "The broad phase in C"), "A note")
        code, text = forge.run(user, "pull_request", "7/merge", "main")
        assert code == 0 and "Nothing got worse" in text and "::" not in text, text
        assert sh("git rev-list --count broadside-history", scratch / "remote.git").stdout.strip() == "1"

        # The sweep ends too early: pairs are missed.
        commit(user, "broken", ("min[0] > s->boxes[p].max[0]", "min[0] + 0.3f > s->boxes[p].max[0]"), "Faster")
        code, text = forge.run(user, "pull_request", "7/merge", "main")
        assert code == 1, text
        line = [line for line in text.splitlines() if line.startswith("::error")]
        assert line and line[0].startswith("::error file=campaign.toml,line=4,title=candidate-set%3A example-sweep on "), text
        results = json.loads((user / "out/gate/results.sarif").read_text(encoding="utf-8"))["runs"][0]["results"]
        assert [r["ruleId"] for r in results].count("candidate-set") >= 1 and results[0]["level"] == "error", results
        assert results[0]["locations"][0]["physicalLocation"]["region"]["startLine"] == 4
        comment = (scratch / "comment.md").read_text(encoding="utf-8")
        assert "candidate-set" in comment and "<details>" in comment and len(comment.encode()) < 65536, comment
        assert (scratch / "summary").read_text(encoding="utf-8").count("### campaign against main") == 3
        log = (scratch / "gh.log").read_text(encoding="utf-8").splitlines()
        assert len(log) == 2 and log[1].startswith("pr comment 7") and log[1].endswith("--edit-last"), log
        for name in ("report.html", "junit.xml", "comparison.json"):
            assert (user / "out/gate" / name).stat().st_size > 0, name

        # A broken main is kept as it is: what fails there too is no news for a change, and what mends it is good news.
        commit(user, "main", None, "Faster")
        assert forge.run(user, "push", "main")[0] == 1
        commit(user, "note", ("The broad phase in C", "Our broad phase in C"), "A note")
        code, text = forge.run(user, "pull_request", "7/merge", "main")
        assert code == 0 and "::error" not in text, text
        history = sh(f"'{program}' history out/gate/history.sqlite", user).stdout
        assert "3 runs" in history, history
        which_commit_was_it(user, program)
        bad_input(user, program)
    print("pushes and pull requests, each as the action says")


def which_commit_was_it(user, program):
    """The page's last question: an engine in C, four commits, of which the third ends the sweep too early."""
    command = (f"'{program}' run randommove:cube:40 --engine {{build}}/libsweep.so --engine all-pairs --frames 20 --out {{out}} && "
               f"'{program}' check {{out}}/example-sweep.h5 --against {{out}}/all-pairs.h5 --json {{out}}/verdicts.json")
    subjects = sh("git log --format=%s -4", user).stdout.split("\n")
    assert subjects[:4] == ["A note", "Faster", "Faster", "A note"], subjects
    answer = sh(f"'{program}' bisect HEAD~4 HEAD --build 'make -s' --on verdict --json --command \"{command}\"", user, check=False)
    assert answer.returncode == 1, answer.stdout
    found = json.loads(answer.stdout[answer.stdout.index("{"):])["answers"][0]
    assert found["first_changed"]["identity"] == sh("git rev-parse HEAD~2", user).stdout.strip(), found
    assert found["differences"][0]["subject"] == "candidate-set against all-pairs", found


def bad_input(user, program):
    gate = f"BROADSIDE_PROGRAM='{program}' '{ACTION.parent}/gate'"
    for words, said in (("absent.toml --base main", "there is no campaign file"), ("campaign.toml", "no base branch"),
                        ("campaign.toml --base 'a b'", "no name of a branch"),
                        ("campaign.toml --base main --remote nowhere", "cannot be read")):
        answer = sh(f"{gate} {words} 2>&1", user, check=False)
        assert answer.returncode == 2 and said in answer.stdout, (words, answer.returncode, answer.stdout)


if __name__ == "__main__":
    main(str(Path(sys.argv[1]).resolve()), sys.argv[2])
