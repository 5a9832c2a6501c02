"""Which folder may include which: the table of ARCHITECTURE.md, the rooms of bench, and vendor headers in .cpp files only."""

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
# Rooms of bench/, and which others each may include, besides itself and the files of bench/ itself. A room includes only rooms above
# it, so there is no cycle.
ROOMS = {
    "cell": set(),
    "document": set(),
    "process": {"cell"},
    "record": {"cell", "process"},
    "mutants": {"cell", "process"},
    "timing": {"cell", "process", "record"},
    "agree": {"cell", "process"},
    "candidates": {"cell", "process"},
    "converge": set(),
    "forensics": {"cell", "process", "record"},
    "shrink": {"cell", "process", "record"},
    "bisect": {"process", "record", "timing", "forensics"},
    "campaign": {"cell", "process"},
    "paper": {"cell", "document", "process", "record", "timing", "campaign"},
    "contest": {"cell", "document", "process", "record", "campaign"},
    "fetched": {"process"},
    "benchmarks": {"record"},
    "mpi": {"cell", "process"},
    "python": {"cell", "process", "record"},
    "cli": {"cell", "process", "record", "mutants", "timing", "agree", "candidates", "converge", "forensics", "shrink", "bisect", "campaign",
            "document", "paper", "contest", "fetched"},
}
# Files of bench/ itself that wire rooms. Every other one includes no room.
WIRING = {
    "bench/main.cpp": {"cli"},
    "bench/plugin_engines.cpp": {"process"},
    "bench/engines.cpp": {"fetched"},
    "bench/job_kinds.hpp": {"campaign"},
    "bench/job_kinds.cpp": {"paper"},
}
# Headers and folders that one folder alone may include: what a page consists of, and what its script is made of.
PRIVATE = {"reports/page/": "reports", "reports/html_sections.hpp": "reports", "reports/page_json.hpp": "reports"}
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')
LINKED = re.compile(r"\bbroadside_([a-z]+)\b")
STANDARD = re.compile(r"^[a-z0-9_]+$")  # <vector>: no folder, no suffix
POSIX = {"fcntl.h", "signal.h", "sys/file.h", "sys/resource.h", "sys/stat.h", "sys/types.h", "sys/wait.h", "unistd.h"}
# Owners of a vendor's handles, included by the sources around them and by no other folder; conversions of a vendor's vectors, for its
# adapters alone; and headers whose functions take the JSON library's type, of which they see the forward declaration alone.
JSON_NAME = {"nlohmann/json_fwd.hpp"}
WRAPPERS = {"core/trace/hdf5_handle.hpp": {"hdf5.h"}, "reference/bullet_vectors.hpp": {"LinearMath/btTransform.h"},
            "core/exact/integer_cubic.hpp": {"gmpxx.h"}, "core/exact/integer_motion.hpp": {"gmpxx.h"},
            "bench/python/native/arrays.hpp": {"pybind11/numpy.h"}, "bench/python/native/dlpack.hpp": {"pybind11/pybind11.h"},
            "core/mesh/gltf_nodes.hpp": JSON_NAME, "bench/cell/json_number.hpp": JSON_NAME}
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
    found += _absent_places(tree)
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
        else:
            yield from _private_faults(folder, target)
            yield from _room_faults(name, target)
    elif mark == "<" and name.endswith(".hpp") and not STANDARD.match(target) and target not in POSIX:
        vendors_own = {"tests": TESTED, "gpu": CUDA}.get(folder)
        if target not in WRAPPERS.get(name, ()) and not (vendors_own and vendors_own.match(target)):
            yield f"<{target}> is a vendor header; it belongs in a .cpp file"


def _private_faults(folder, target):
    for place, owner in PRIVATE.items():
        if target.startswith(place) and folder not in (owner, "tests"):
            yield f'{folder}/ may not include "{target}", which belongs to {owner}/ alone'


def room_of(path):
    """The room of a path under bench/, "" for the files of bench/ itself, None elsewhere."""
    parts = path.split("/")
    if parts[0] != "bench":
        return None
    return parts[1] if len(parts) > 2 else ""


def _room_faults(name, target):
    room, wanted = room_of(name), room_of(target)
    if room is None or not wanted or room == wanted:
        return
    if room and room not in ROOMS:
        yield f"bench/{room}/ has no row in ROOMS of include_boundaries.py: say what it may include"
    elif wanted not in (ROOMS[room] if room else WIRING.get(name, set())):
        yield f'{f"bench/{room}/" if room else name} may not include "{target}"'


def _absent_places(tree):
    """Rules about folders or files that do not exist: such a rule protects nothing."""
    places = {**{f"bench/{room}/": "ROOMS" for room in ROOMS}, **dict.fromkeys(WIRING, "WIRING"),
              **dict.fromkeys(PRIVATE, "PRIVATE"), **{f"{folder}/": "ALLOWED" for folder in ALLOWED},
              **dict.fromkeys(WRAPPERS, "WRAPPERS")}
    for place, table in places.items():
        if not any(name == place or place.endswith("/") and name.startswith(place) for name in tree.paths):
            yield f"{place}: {table} of include_boundaries.py names it, and it is not there"


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
