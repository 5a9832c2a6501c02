"""Failures of a gate as annotations of a forge, and as SARIF:  annotate.py FOLDER CAMPAIGN

A failure's file is the one that asked for it: the scene's own file where it has one, otherwise the line of the campaign file that names
the scene. Where the gate compared with a base, only what the change made worse is annotated; otherwise each failed verdict.
Annotations go to stdout in the words of the forge's workflow commands, and results to FOLDER/results.sarif.
"""

import json
import re
import sys
from pathlib import Path

# Kinds of change that fail a gate, of 'compare --json', are those with an exit code above 0.
LEVELS = {1: "error", 3: "warning"}


def rows_of(file):
    return json.loads(file.read_text(encoding="utf-8"))["rows"] if file.exists() else []


def label_of(stamp):
    short = stamp.get("settings_short", "")
    return stamp["engine"] + (f"[{short}]" if short else "")


def failures(folder):
    """(rule, scene, label, level, message, digests) of each failure, gravest first."""
    explained = {}
    for row in rows_of(folder / "head/verdicts.json"):
        for verdict in row["verdicts"]:
            name = verdict["validator"] + (f" against {verdict['baseline']}" if verdict["baseline"] else "")
            if verdict["outcome"] in ("fail", "inconclusive"):
                explained[row["stamp"]["scene_name"], label_of(row["stamp"]), name] = verdict
    comparison = folder / "comparison.json"
    if not comparison.exists():
        for (scene, label, name), verdict in explained.items():
            yield verdict["validator"], scene, label, 1 if verdict["outcome"] == "fail" else 3, f"{name}{text_of(verdict)}"
        return
    table = json.loads(comparison.read_text(encoding="utf-8"))
    for change in table["changes"]:
        if change["exit"] in LEVELS:
            verdict = explained.get((change["scene"], change["label"], change["subject"]))
            more = text_of(verdict) if verdict else ""
            yield (change["subject"].split(" against ")[0], change["scene"], change["label"], change["exit"],
                   f"{change['subject']}: {change['was']}, now {change['is']}{more}")
    for time in table["times"]:
        if time["speed"].lower() == "slower":
            yield "time", time["scene"], time["label"], 1, f"{time['ratio']:.3f} times as long as on the base"


def text_of(verdict):
    """Continues a line: where it was worst, and what the law found."""
    step = verdict["worst"]["step"]
    return f"{f' at step {step}' if step >= 0 else ''}: {verdict['explanation']}"


def place_of(scene, campaign, lines):
    """(file, line) that asked for this scene."""
    if Path(scene).suffix == ".toml" and Path(scene).exists():
        return scene, 1
    for wanted in (scene, scene.rsplit(":", 1)[0] + ":"):  # as it is, then with a varied number
        for number, line in enumerate(lines, start=1):
            if wanted in line and not line.lstrip().startswith("#"):
                return campaign, number
    return campaign, 1


def escaped(text, extra=""):
    """Text of a workflow command; properties also escape : and ,"""
    return re.sub(f"[%\r\n{extra}]", lambda m: f"%{ord(m.group(0)):02X}", text)


def sarif(found):
    rules = sorted({rule for rule, *_ in found})
    return {
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": {"driver": {"name": "Broadside", "rules": [{"id": rule} for rule in rules]}},
            "results": [{
                "ruleId": rule, "ruleIndex": rules.index(rule), "level": LEVELS[level],
                "message": {"text": f"{scene}, {label}: {message}"},
                "partialFingerprints": {"cell/v1": f"{scene}|{label}|{rule}"},
                "locations": [{"physicalLocation": {"artifactLocation": {"uri": file}, "region": {"startLine": line}}}],
            } for rule, scene, label, level, message, (file, line) in found],
        }],
    }


def main(folder, campaign):
    lines = Path(campaign).read_text(encoding="utf-8").splitlines()
    found = [(rule, scene, label, level, message, place_of(scene, campaign, lines))
             for rule, scene, label, level, message in failures(Path(folder))]
    for rule, scene, label, level, message, (file, line) in found:
        title = escaped(f"{rule}: {label} on {scene}", ":,")
        print(f"::{LEVELS[level]} file={escaped(file, ':,')},line={line},title={title}::{escaped(message)}")
    Path(folder, "results.sarif").write_text(json.dumps(sarif(found), indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
