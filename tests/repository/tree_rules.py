"""What lies where, how files are named, and how long they are."""

import re
from pathlib import Path

TOP = {
    "CMakeLists.txt", "CMakePresets.json", "README.md", "ARCHITECTURE.md", "CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md", "LICENSE",
    "broadside", "core", "gpu", "reference", "validation", "bench", "datasets", "reports", "tests", "cmake", ".ci", ".github",
    ".clang-format", ".clang-tidy", ".gitignore", ".gitattributes", ".editorconfig", ".clangd",
}
FOLDERS = ("core", "gpu", "reference", "validation", "bench", "datasets", "reports", "tests")
LONGEST = 400  # lines of code in one file: above that it answers more than one question
BIGGEST = 512 * 1024  # bytes: a larger file is data, and data is fetched or generated
SNAKE = re.compile(r"^[a-z0-9]+(_[a-z0-9]+)*$|^__init__$")  # the second: what makes a folder a package of Python
VAGUE = re.compile(r"^(utils?|helpers?|common|misc|manager)")
MESHES = {".ply", ".obj", ".stl", ".off", ".glb", ".gltf"}
CODE = {".hpp", ".cpp", ".cuh", ".cu"}


def violations(tree):
    found = [f"{name}: not a top-level entry of the design" for name in sorted({p.split("/")[0] for p in tree.paths} - TOP)]
    found += [f"{folder}/README.md: missing (purpose, allowed dependencies, decisions with dates)"
              for folder in FOLDERS if f"{folder}/README.md" not in tree.paths]
    for name in tree.paths:
        path = Path(name)
        if path.suffix in MESHES:
            found.append(f"{name}: a mesh; meshes are fetched or generated")
        elif (tree.root / name).stat().st_size > BIGGEST:
            found.append(f"{name}: larger than {BIGGEST} bytes")
        if path.suffix in CODE | {".py"}:
            if not SNAKE.match(path.stem):
                found.append(f"{name}: file names are snake_case")
            if VAGUE.match(path.stem):
                found.append(f"{name}: a name that says nothing")
        if path.suffix in CODE:
            found += _code_faults(tree, name, path)
    return found + list(_misplaced_tests(tree))


def _misplaced_tests(tree):
    """Tests mirror the source: the test of F/noun.cpp is tests/F/noun_test.cpp. Those of gpu/ lie by what they need to run."""
    folders = {}
    for name in tree.paths:
        path = Path(name)
        if path.suffix in CODE and path.parts[0] not in ("tests", "gpu"):
            folders.setdefault((path.parts[0], path.stem), set()).add(str(path.parent))
    for name in tree.paths:
        path = Path(name)
        if path.parts[0] != "tests" or len(path.parts) < 3 or not name.endswith("_test.cpp"):
            continue
        mirrored = "/".join(path.parts[1:-1])
        homes = folders.get((path.parts[1], path.stem.removesuffix("_test")), {mirrored})
        if mirrored not in homes:
            yield f"{name}: tests mirror the source, and the source of that name is in {' or '.join(sorted(homes))}/"


def _code_faults(tree, name, path):
    lines = tree.lines(name)
    if len(lines) > LONGEST:
        yield f"{name}: {len(lines)} lines, more than {LONGEST}"
    if path.suffix in {".hpp", ".cuh"} and not any(text.strip() == "#pragma once" for _, text in lines):
        yield f"{name}: no #pragma once"
    if path.parts[0] == "tests" and path.suffix == ".cpp" and not path.stem.endswith("_test"):
        yield f"{name}: a source in tests/ is named <noun>_test.cpp, or nothing builds it"
