"""CHANGELOG.md begins with the release that CMake builds, and its table has the versions of the formats that the code writes."""

import re

PAGE = "CHANGELOG.md"
RELEASE = re.compile(r"^## (\d+\.\d+\.\d+) \(\d{4}-\d{2}-\d{2}\)$", re.MULTILINE)
# Where a version is written down, and the words that its rows in the table begin with.
VERSIONS = {
    "| trace ": ("core/trace/trace_header.hpp", re.compile(r"kTraceFormatVersion = (\d+)")),
    "| engine plug-ins ": ("core/plugin/broadside_engine.h", re.compile(r"#define BROADSIDE_ENGINE_ABI (\d+)")),
    "| engines of version 2 ": ("core/plugin/broadside_engine_v2.h", re.compile(r"#define BROADSIDE_ENGINE_ABI_2 (\d+)")),
    "| protocol of program engines ": ("core/plugin/program_protocol.hpp", re.compile(r"kProtocolVersion = (\d+)")),
    "| campaign's ": ("bench/campaign/manifest.cpp", re.compile(r"kVersion = (\d+)")),
}


def violations(tree):
    text = {name: (tree.root / name).read_text(encoding="utf-8")
            for name in [PAGE, "CMakeLists.txt", *(file for file, _ in VERSIONS.values())] if name in tree.paths}
    if PAGE not in text:
        return []
    found = []
    built = re.search(r"project\(\w+ VERSION ([\d.]+)", text.get("CMakeLists.txt", ""))
    released = RELEASE.search(text[PAGE])
    if not built or not released or built.group(1) != released.group(1):
        found.append(f"{PAGE}: its first release is {released and released.group(1)}, and CMakeLists.txt builds {built and built.group(1)}")
    for row, (file, pattern) in VERSIONS.items():
        written = pattern.search(text.get(file, ""))
        told = [line.split("|")[2].strip() for line in text[PAGE].splitlines() if line.startswith(row)]
        if not written or not told or told[-1] != written.group(1):
            found.append(f"{PAGE}: '{row.strip('| ')}' is at {told[-1:]}, and {file} says {written and written.group(1)}")
    return found
