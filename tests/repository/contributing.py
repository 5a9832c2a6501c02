"""The steps of CONTRIBUTING.md, as values: whole files, lines for files that exist, and commands.

A block after <!-- file: NAME --> is a new file. One after <!-- line of: NAME --> goes to the end of a file, and one after
<!-- line of: NAME, after: LINE --> behind that line.
"""

import re
from typing import NamedTuple

PAGE = "CONTRIBUTING.md"
STEP = re.compile(r"^<!-- (file|line of): ([^\s,]+)(?:, after: ([^\n]+?))? -->\n```\w*\n(.*?)^```$", re.MULTILINE | re.DOTALL)


class Step(NamedTuple):
    is_file: bool
    name: str
    after: str
    text: str


def steps(page):
    return [Step(kind == "file", name, after, text) for kind, name, after, text in STEP.findall(page)]


def changed(step, text):
    """The file's text after this step. Raises ValueError where the page names a line that is not there once."""
    if step.is_file:
        return step.text
    if not step.after:
        return text + step.text
    lines = text.splitlines(keepends=True)
    places = [k for k, line in enumerate(lines) if line.strip() == step.after.strip()]
    if len(places) != 1:
        raise ValueError(f"has {'no' if not places else 'more than one'} line '{step.after}'")
    at = places[0]
    return "".join(lines[:at + 1]) + step.text + "".join(lines[at + 1:])


def violations(tree):
    found = []
    page = tree.root / PAGE
    for step in steps(page.read_text(encoding="utf-8")) if page.exists() else []:
        there = (tree.root / step.name).exists()
        if step.is_file == there:
            found.append(f"{PAGE}: {step.name} " + ("is there already" if there else "is not there"))
        elif there:
            try:
                changed(step, (tree.root / step.name).read_text(encoding="utf-8"))
            except ValueError as error:
                found.append(f"{PAGE}: {step.name} {error}")
    return found
