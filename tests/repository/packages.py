"""cmake/packages.txt, or one of the tables beside it, names a package for everything that CMake is told to find."""

import re

FIND = re.compile(r"^\s*find_package\(\s*([A-Za-z0-9_+]+)")
MODULE = re.compile(r"^\s*pkg_check_modules\(\s*\w+\s+(?:REQUIRED\s+|IMPORTED_TARGET\s+|QUIET\s+)*([^)\s]+)")
# Threads comes with the compiler. CUDA comes from its vendor, and the build does without it.
WITHOUT_PACKAGE = {"Threads", "CUDAToolkit"}
TABLE = "cmake/packages.txt"
# The tables beside it: packages that only the Python package, only some engines of the contest, or only MPI's program
# need.
TABLES = (TABLE, "cmake/packages_python.txt", "cmake/packages_contest.txt", "cmake/packages_mpi.txt")
COLUMNS = ("debian-12", "ubuntu-24.04", "for")


def violations(tree):
    rows = [(f"{table}:{number}", text.split()) for table in TABLES if table in tree.paths
            for number, text in tree.lines(table) if text.strip() and not text.startswith("#")]
    found = [f"{place}: a row has the columns {', '.join(COLUMNS)}" for place, row in rows if len(row) < len(COLUMNS)]
    provided = {row[2] for _, row in rows if len(row) >= len(COLUMNS)}
    for name in tree.paths:
        # Examples are projects of their own, built against an installed tree.
        if not name.endswith((".cmake", "CMakeLists.txt")) or "/examples/" in name:
            continue
        for number, line in tree.lines(name):
            for match in filter(None, (FIND.match(line), MODULE.match(line))):
                wanted = match.group(1)
                if wanted not in provided | WITHOUT_PACKAGE:
                    found.append(f"{name}:{number}: {wanted} is searched for, and {TABLE} has no package for it")
    return found
