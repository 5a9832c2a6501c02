"""A type has one definition: two of one name in one namespace, in different files, share the names of their functions,
of which the linker keeps one copy, whichever type it was made for. No compiler sees that. Types of one file alone belong in an
unnamed namespace."""

import re

FOLDERS = ("core/", "gpu/", "reference/", "validation/", "datasets/", "reports/", "bench/")
# The host's stand-ins for the kernels' surroundings have the same names as those on the device: no program links both.
STANDS_IN = "gpu/on_host/"
NAMESPACE = re.compile(r"^\s*(?:inline\s+)?namespace\s*([\w:]*)\s*$")
TYPE = re.compile(r"^\s*(?:template\s*<.*>\s*)?(?:struct|class|union|enum(?:\s+class|\s+struct)?)\s+(?:(?:\[\[\w+\]\]|alignas\([^)]*\))\s*)?"
                  r"(\w+)\s*(?:final\s*)?(?::(?!:)[^;{]*)?$")
# Comments, literals and what the preprocessor reads, none of which opens or closes a scope.
NOISE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|^[ \t]*#[^\n]*', re.S | re.M)


def types(text):
    """The types that a file defines at namespace level: each name with its namespaces, and its line."""
    text = NOISE.sub(lambda m: " " + "\n" * m.group().count("\n"), text)
    scopes = []  # the name of each namespace around; None for any other brace
    start = 0
    for at in (m.start() for m in re.finditer(r"[{};]", text)):
        said = " ".join(text[start:at].split())
        if text[at] == "}":
            if scopes:
                scopes.pop()
        elif text[at] == "{":
            space = NAMESPACE.match(said)
            found = TYPE.match(said)
            if found and all(scopes):
                yield "::".join([*scopes, found.group(1)]), text.count("\n", 0, at) + 1
            scopes.append(space.group(1) if space else None)
        start = at + 1


def violations(tree):
    first = {}
    out = []
    for name in tree.with_suffix({".hpp", ".cpp", ".cuh", ".cu"}):
        if not name.startswith(FOLDERS) or name.startswith(STANDS_IN):
            continue
        for type_name, number in types("\n".join(line for _, line in tree.lines(name))):
            where = first.setdefault(type_name, name)
            if where != name:
                out.append(f"{name}:{number}: {type_name} is defined in {where} too: rename one, or put it in an unnamed namespace")
    return out
