"""Which folder may include which: the table of ARCHITECTURE.md, and vendor headers in .cpp files only."""

import re

ALLOWED = {
    "core": {"core"},
    "gpu": {"gpu", "core"},
    "reference": {"reference", "core"},
    "validation": {"validation", "core"},
    "datasets": {"datasets", "core"},
    "reports": {"reports", "core"},
    "bench": {"bench", "core", "gpu", "reference", "validation", "datasets", "reports"},
    "tests": {"tests", "bench", "core", "gpu", "reference", "validation", "datasets", "reports"},
}
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')
LINKED = re.compile(r"\bbroadside_([a-z]+)\b")
STANDARD = re.compile(r"^[a-z0-9_]+$")  # <vector>: no folder, no suffix
POSIX = {"fcntl.h", "signal.h", "sys/file.h", "sys/resource.h", "sys/stat.h", "sys/types.h", "sys/wait.h", "unistd.h"}
# Owners of a vendor's handles, included by the sources around them and by no other folder.
WRAPPERS = {"core/trace/hdf5_handle.hpp": {"hdf5.h"}}
CUDA = re.compile(r"^(cuda|cub|thrust|device_launch)\w*[./]")  # gpu/ is the folder of this vendor
GENERATED = {"broadside_version.hpp"}  # written at build time from the version and the commit
OTHERS = "/examples/"  # what is built against an installed tree includes what is installed
TESTED = re.compile(r"^gtest/")  # a header of tests/ may use the test framework


def violations(tree):
    found = []
    for name in tree.with_suffix({".hpp", ".cpp", ".cuh", ".cu"}):
        if OTHERS in name:
            continue
        folder = name.split("/")[0]
        for number, line in tree.lines(name):
            include = INCLUDE.match(line)
            if include and folder in ALLOWED:
                found += [f"{name}:{number}: {text}" for text in _include_faults(folder, name, *include.groups())]
        found += _own_header_not_first(tree, name)
    for name in tree.paths:
        folder, _, rest = name.partition("/")
        if rest.endswith("CMakeLists.txt") and folder in ALLOWED:
            found += _link_faults(tree, folder, name)
    return found


def _include_faults(folder, name, mark, target):
    if mark == '"' and target not in GENERATED:
        first = target.split("/")[0]
        if first not in ALLOWED:
            yield f'"{target}" does not start with a folder of the root'
        elif first not in ALLOWED[folder]:
            yield f'{folder}/ may not include "{target}"'
        elif folder == "bench" and target.startswith("reports/web/"):
            yield f'bench/ may not include the page\'s own part "{target}"'
    elif mark == "<" and name.endswith(".hpp") and not STANDARD.match(target) and target not in POSIX:
        vendors_own = {"tests": TESTED, "gpu": CUDA}.get(folder)
        if target not in WRAPPERS.get(name, ()) and not (vendors_own and vendors_own.match(target)):
            yield f"<{target}> is a vendor header; it belongs in a .cpp file"


def _own_header_not_first(tree, name):
    """A source that includes its own header first is the proof that this header compiles alone."""
    own = re.sub(r"\.cpp$", ".hpp", name)
    if own == name or own not in tree.paths:
        return
    for number, line in tree.lines(name):
        include = INCLUDE.match(line)
        if include:
            if include.group(2) != own:
                yield f"{name}:{number}: the first include of this source is not its own header"
            return
    yield f"{name}: does not include its own header"


def _link_faults(tree, folder, name):
    for number, line in tree.lines(name):
        for linked in LINKED.findall(line.split("#")[0]):
            if linked in ALLOWED and linked not in ALLOWED[folder]:
                yield f"{name}:{number}: {folder}/ may not link broadside_{linked}"
