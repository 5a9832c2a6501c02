"""Each check finds its kind of violation: one is planted in a small tree, and it alone is reported."""

import json
import shutil
import tempfile
import unittest
from pathlib import Path

import clang_tidy
import contributing
import formatting
import include_boundaries
import mutations
import one_definition
import packages
import readme_commands
import releases
import shell_scripts
import tree_rules
import wording
import workflows
from source_tree import SourceTree

CLEAN = {f"{folder}/README.md": "What it is for.\n" for folder in tree_rules.FOLDERS}
CLEAN["core/body.hpp"] = "#pragma once\n\n#include <vector>\n"
CLEAN["cmake/packages.txt"] = "# debian-12 ubuntu-24.04 for\nlibx-dev libx-dev X\n"
for place in [*(f"bench/{room}/" for room in include_boundaries.ROOMS), *include_boundaries.WIRING, *include_boundaries.PRIVATE,
              *include_boundaries.WRAPPERS]:
    CLEAN[f"{place}README.md" if place.endswith("/") else place] = "#include \"bench/job_kinds.hpp\"\n" if ".cpp" in place else "#pragma once\n"
CLEAN["CMakeLists.txt"] = "find_package(X REQUIRED)\n"


class PlantedViolation(unittest.TestCase):
    def found(self, check, planted):
        with tempfile.TemporaryDirectory() as scratch:
            for name, text in {**CLEAN, **planted}.items():
                path = Path(scratch) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            return check.violations(SourceTree(scratch))

    def one(self, check, planted, said):
        self.assertEqual([], self.found(check, {}), "the tree without the violation is clean")
        found = self.found(check, planted)
        self.assertEqual(1, len(found), found)
        self.assertIn(said, found[0])

    def test_include_from_a_folder_that_the_table_forbids(self):
        self.one(include_boundaries, {"core/a.cpp": '#include "gpu/kernel.hpp"\n'}, "core/ may not include")
        self.one(include_boundaries, {"reference/a.cpp": '#include "validation/judge.hpp"\n'}, "reference/ may not")
        self.one(include_boundaries, {"validation/a.hpp": ' # include "reports/page.hpp"\n'}, "validation/ may not")

    def test_two_types_of_one_name(self):
        body = "// struct C {\nnamespace broadside::core {\nstruct Body final : Base<int> {\n  struct Part {};\n};\n}\n"
        self.one(one_definition, {"core/a.hpp": body, "core/b.cpp": body.replace("Part", "Other")}, "core/b.cpp:3: broadside::core::Body")
        self.one(one_definition, {"core/a.hpp": "namespace a {\nenum class E : int { kOne };\n}\n",
                                  "bench/a.hpp": "namespace a {\nclass E {};\n}\n"}, "a::E is defined in bench/a.hpp too")

    def test_types_whose_names_differ_or_are_seen_by_one_file(self):
        hidden = "namespace a {\nnamespace {\nstruct Body {};\n}\nchar c = '{';\n#define OPEN {\nvoid f() {\n  struct Local {};\n}\n}\n"
        for planted in ({"core/a.cpp": hidden, "core/b.cpp": hidden},
                        {"core/a.hpp": "namespace a {\nstruct B {};\n}\n", "core/b.hpp": "namespace b {\nstruct B {};\n}\nstruct a::B;\n"},
                        {"core/a.hpp": "struct A {\n  struct P;\n};\n", "core/a.cpp": "struct A::P {};\n", "core/b.cpp": "struct B {\n  struct P {};\n};\n"},
                        {"gpu/a.cuh": "struct A {};\n", "gpu/on_host/a.hpp": "struct A {};\n"}):
            self.assertEqual([], self.found(one_definition, planted))

    def test_include_that_does_not_start_at_the_root(self):
        self.one(include_boundaries, {"core/a.cpp": '#include "body.hpp"\n'}, "does not start with a folder")
        self.one(include_boundaries, {"core/a.cpp": '#include "../core/body.hpp"\n'}, "does not start with a folder")

    def test_include_from_a_room_of_bench_that_the_table_forbids(self):
        self.one(include_boundaries, {"bench/campaign/a.cpp": '#include "bench/paper/a.hpp"\n'}, "bench/campaign/ may not include")
        self.one(include_boundaries, {"bench/record/a.cpp": '#include "bench/cli/commands.hpp"\n'}, "bench/record/ may not")
        self.one(include_boundaries, {"bench/a.cpp": '#include "bench/cli/commands.hpp"\n'}, "bench/a.cpp may not include")
        self.one(include_boundaries, {"bench/cellar/a.cpp": '#include "bench/cell/a.hpp"\n'}, "bench/cellar/ has no row")
        self.assertEqual([], self.found(include_boundaries, {"bench/paper/a.cpp": '#include "bench/campaign/job.hpp"\n',
                                                             "tests/bench/a_test.cpp": '#include "bench/cli/a.hpp"\n'}))

    def test_rooms_of_bench_have_no_cycle(self):
        above = set()
        for room, wanted in include_boundaries.ROOMS.items():
            self.assertLessEqual(wanted, above, f"{room}: a room includes rooms above it in the table")
            above.add(room)

    def test_include_of_what_belongs_to_one_folder(self):
        self.one(include_boundaries, {"bench/paper/a.cpp": '#include "reports/html_sections.hpp"\n'}, "reports/ alone")

    def test_rule_about_a_place_that_is_not_there(self):
        for place in ("bench/shrink/", "reports/page/", "bench/main.cpp", "core/trace/hdf5_handle.hpp"):
            with tempfile.TemporaryDirectory() as scratch:
                for name, text in CLEAN.items():
                    if not name.startswith(place):
                        path = Path(scratch) / name
                        path.parent.mkdir(parents=True, exist_ok=True)
                        path.write_text(text, encoding="utf-8")
                found = include_boundaries.violations(SourceTree(scratch))
            self.assertEqual(1, len(found), found)
            self.assertIn(f"{place}: ", found[0])

    def test_vendor_header_outside_a_source(self):
        self.one(include_boundaries, {"reference/a.hpp": "#include <fcl/fcl.h>\n"}, "vendor header")
        self.one(include_boundaries, {"core/a.hpp": "#include <cuda_runtime_api.h>\n"}, "vendor header")
        self.one(include_boundaries, {"core/trace/a.hpp": "#include <hdf5.h>\n"}, "vendor header")
        self.assertEqual([], self.found(include_boundaries, {"reference/a.cpp": "#include <fcl/fcl.h>\n"}))
        self.assertEqual([], self.found(include_boundaries, {"gpu/a.hpp": "#include <cuda_runtime_api.h>\n"}))

    def test_source_that_does_not_prove_its_header(self):
        self.one(include_boundaries, {"core/body.cpp": '#include <vector>\n#include "core/body.hpp"\n'}, "not its own header")
        self.one(include_boundaries, {"core/body.cpp": "int a;\n"}, "does not include its own header")

    def test_link_that_the_table_forbids(self):
        self.one(include_boundaries, {"validation/CMakeLists.txt": "target_link_libraries(broadside_validation broadside_gpu)\n"},
                 "may not link broadside_gpu")

    def test_long_file(self):
        self.one(tree_rules, {"core/a.cpp": "\n" * 401}, "401 lines")
        self.assertEqual([], self.found(tree_rules, {"core/a.cpp": "\n" * 400}))

    def test_names_and_places(self):
        self.one(tree_rules, {"core/helpers.cpp": ""}, "says nothing")
        self.one(tree_rules, {"core/BodyState.cpp": ""}, "snake_case")
        self.one(tree_rules, {"bench/python/_trace.py": ""}, "snake_case")
        self.assertEqual([], self.found(tree_rules, {"bench/python/broadside/__init__.py": ""}))
        self.one(tree_rules, {"extra/a.txt": ""}, "top-level")
        self.one(tree_rules, {"datasets/bunny.ply": ""}, "a mesh")
        self.one(tree_rules, {"core/a.hpp": "int a;\n"}, "#pragma once")
        self.one(tree_rules, {"tests/core/a.cpp": ""}, "nothing builds it")
        self.one(tree_rules, {"core/mesh/a.cpp": "", "tests/core/a_test.cpp": ""}, "tests mirror the source")
        self.assertEqual([], self.found(tree_rules, {"core/mesh/a.cpp": "", "tests/core/mesh/a_test.cpp": "", "tests/core/b_test.cpp": ""}))
        self.one(tree_rules, {"core/a.txt": "x" * (tree_rules.BIGGEST + 1)}, "larger than")

    def test_folder_without_readme(self):
        with tempfile.TemporaryDirectory() as scratch:
            self.assertEqual(len(tree_rules.FOLDERS), len(tree_rules.violations(SourceTree(scratch))))

    def test_words(self):
        self.one(wording, {"core/a.cpp": "// TO" "DO: later\n"}, "unfinished")
        self.one(wording, {"core/a.md": "See /ho" "me/somebody/x\n"}, "a path of one machine")
        self.one(wording, {"broadside": "curl http://deb.debian" ".org/\n"}, "registry")
        self.assertEqual([], self.found(wording, {"core/a.cpp": "// out/demo/report.html, ../shared/wo" "rk/x\n"}))

    def test_package_that_is_not_in_the_table(self):
        self.one(packages, {"core/CMakeLists.txt": "find_package(Y)\n"}, "Y is searched for")
        self.one(packages, {"cmake/y.cmake": "  pkg_check_modules(y REQUIRED IMPORTED_TARGET liby)\n"}, "liby is searched for")
        self.one(packages, {"cmake/packages.txt": CLEAN["cmake/packages.txt"] + "libz-dev\n"}, "a row has the columns")
        python = "liby-dev liby-dev Y\n"
        self.one(packages, {"cmake/packages_python.txt": python + "libz-dev\n"}, "packages_python.txt:2: a row has the columns")
        self.assertEqual([], self.found(packages, {"cmake/packages_python.txt": python, "core/CMakeLists.txt": "find_package(Y)\n"}))

    def test_readme_command_that_exits_otherwise(self):
        page = ("```sh\n./broadside untested\n```\n\n<!-- tested -->\n```sh\n./broadside first >seen\n"
                "./broadside 3  # exits 3\n```\n")
        found = readme_commands.commands(page)
        self.assertEqual([("./broadside first >seen", 0), ("./broadside 3  # exits 3", 3)], found)
        with tempfile.TemporaryDirectory() as scratch:
            program = Path(scratch) / "program"
            program.write_text('#!/bin/sh\n[ -e seen ] || exit 1\n[ "$1" = first ] || exit "$1"\n', encoding="utf-8")
            program.chmod(0o755)
            self.assertEqual([], readme_commands.failures(found, program))
            wrong = readme_commands.failures([("./broadside first >seen", 0), ("./broadside 3", 0)], program)
            self.assertEqual(1, len(wrong))
            self.assertIn("expected exit 0, saw 3", wrong[0])

    def test_step_of_contributing_that_cannot_be_taken(self):
        def page(step):
            return {contributing.PAGE: f"<!-- {step} -->\n```cpp\nline\n```\n"}

        self.one(contributing, page("file: core/body.hpp"), "is there already")
        self.one(contributing, page("line of: core/other.inc"), "is not there")
        self.one(contributing, page("line of: core/body.hpp, after: int b;"), "has no line")
        self.assertEqual([], self.found(contributing, page("line of: core/body.hpp, after: #pragma once")))
        twice = {**page("line of: core/twice.md, after: |---|"), "core/twice.md": "|---|\none\n|---|\ntwo\n"}
        self.one(contributing, twice, "has more than one line")
        step = contributing.steps(page("line of: a, after: two")[contributing.PAGE])[0]
        self.assertEqual("one\n  two\nline\nthree\n", contributing.changed(step, "one\n  two\nthree\n"))

    def test_release_or_version_that_the_changelog_lacks(self):
        told = {"CMakeLists.txt": "project(p VERSION 2.0.0)\nfind_package(X REQUIRED)\n",
                "core/trace/trace_header.hpp": "#pragma once\nconstexpr std::uint32_t kTraceFormatVersion = 3;\n",
                "core/plugin/broadside_engine.h": "#define BROADSIDE_ENGINE_ABI 1\n",
                "core/plugin/broadside_engine_v2.h": "#define BROADSIDE_ENGINE_ABI_2 2\n",
                "core/plugin/program_protocol.hpp": "#pragma once\nconstexpr std::uint32_t kProtocolVersion = 1;\n",
                "bench/campaign/manifest.cpp": "constexpr int kVersion = 2;\n",
                releases.PAGE: "| trace | 1 |\n| trace | 3 |\n| engine plug-ins | 1 |\n| engines of version 2 | 2 |\n"
                               "| protocol of program engines | 1 |\n| campaign's | 2 |\n\n## 2.0.0 (2026-01-01)\n"}
        self.assertEqual([], self.found(releases, told))
        self.one(releases, {**told, "CMakeLists.txt": "project(p VERSION 2.1.0)\n"}, "2.1.0")
        self.one(releases, {**told, "core/trace/trace_header.hpp": "kTraceFormatVersion = 4"}, "says 4")

    def test_sources_that_clang_tidy_looks_at(self):
        paths = ["core/a.hpp", "core/a.cpp", "core/b.hpp", "bench/benchmarks/c.cpp", "tests/core/a_test.cpp", "core/plugin/examples/d.cpp"]
        self.assertEqual(["core/a.cpp"], clang_tidy.sources_of(paths, paths))
        self.assertEqual(["core/a.cpp"], clang_tidy.sources_of(["core/a.hpp", "core/gone.cpp"], paths))

    def test_what_clang_tidy_finds(self):
        program = shutil.which(f"clang-tidy-{clang_tidy.VERSION}")
        if not program:
            self.skipTest("no clang-tidy here")
        with tempfile.TemporaryDirectory() as scratch:
            root = Path(scratch).resolve()
            (root / "core").mkdir()
            (root / "core/a.cpp").write_text("int* two() {\n  int BadName = 2;\n  return new int(BadName);\n}\n", encoding="utf-8")
            shutil.copy(Path(__file__).resolve().parents[2] / ".clang-tidy", root / ".clang-tidy")
            (root / "compile_commands.json").write_text(json.dumps([{"directory": str(root), "file": "core/a.cpp",
                                                                     "command": "c++ -Wno-restrict -c core/a.cpp"}]), encoding="utf-8")
            found = clang_tidy.findings(program, root, root, "core/a.cpp")
        self.assertEqual(1, len(found), found)
        self.assertIn("core/a.cpp:2: invalid case style for variable 'BadName'", found.pop())

    def test_files_of_a_unit_have_commands_of_their_own(self):
        with tempfile.TemporaryDirectory() as scratch:
            build = Path(scratch).resolve()
            (build / "Unity").mkdir()
            unit = str(build / "Unity/unit_0.cxx")
            Path(unit).write_text('#include "/a.cpp"\n\n#include "/b.cpp"\n', encoding="utf-8")
            given = [{"directory": str(build), "file": file, "command": f"c++ -O1 -c {file}"} for file in (unit, "/c.cpp")]
            commands = clang_tidy.commands_of_files(given)
        self.assertEqual([("/a.cpp", "c++ -O1 -c /a.cpp"), ("/b.cpp", "c++ -O1 -c /b.cpp"), ("/c.cpp", "c++ -O1 -c /c.cpp")],
                         [(command["file"], command["command"]) for command in commands])

    def test_units_that_clang_tidy_looks_at(self):
        with tempfile.TemporaryDirectory() as scratch:
            root = Path(scratch).resolve()
            commands = []
            for unit, source in (("build/core/Unity/unity_0.cxx", "core/a.cpp"), ("build/tests/Unity/unity_0.cxx", "tests/a_test.cpp")):
                (root / unit).parent.mkdir(parents=True)
                (root / unit).write_text(f'#include "{root}/{source}"\n', encoding="utf-8")
                commands.append({"directory": str(root), "file": str(root / unit), "command": ""})
            commands.append({"directory": str(root), "file": str(root / "bench/main.cpp"), "command": ""})
            unit = str(root / "build/core/Unity/unity_0.cxx")
            self.assertEqual([str(root / "bench/main.cpp"), unit], clang_tidy.units_with(commands, root, ""))
            self.assertEqual([unit], clang_tidy.units_with(commands, root, "core/"))

    def test_what_clang_tidy_finds_in_a_unit(self):
        program = shutil.which(f"clang-tidy-{clang_tidy.VERSION}")
        if not program:
            self.skipTest("no clang-tidy here")
        with tempfile.TemporaryDirectory() as scratch:
            root = Path(scratch).resolve()
            (root / "core").mkdir()
            (root / "build/Unity").mkdir(parents=True)
            (root / "core/a.cpp").write_text("int two() {\n  int BadName = 2;\n  return BadName;\n}\n", encoding="utf-8")
            unit = root / "build/Unity/unity_0.cxx"
            unit.write_text(f'#include "{root}/core/a.cpp"\n', encoding="utf-8")
            shutil.copy(Path(__file__).resolve().parents[2] / ".clang-tidy", root / ".clang-tidy")
            (root / "compile_commands.json").write_text(json.dumps([{"directory": str(root), "file": str(unit),
                                                                     "command": f"c++ -c {unit}"}]), encoding="utf-8")
            found = clang_tidy.findings(program, root, root, str(unit))
        self.assertEqual(["core/a.cpp:2: invalid case style for variable 'BadName' [readability-identifier-naming]"], sorted(found))

    def test_workflow_that_the_forge_cannot_run(self):
        def workflow(step, head="on: push"):
            text = f"name: a\n{head}\njobs:\n  b:\n    runs-on: c\n    timeout-minutes: 5\n    steps:\n      - {step}\n"
            return {f"{workflows.FOLDER}a.yml": text}

        try:
            self.assertEqual([], self.found(workflows, workflow("run: cat x")))
        except formatting.Absent as reason:
            self.skipTest(str(reason))
        self.assertEqual([], self.found(workflows, workflow("uses: actions/checkout@v4")))
        self.one(workflows, workflow("run: .ci/nothing here"), ".ci/nothing is not there")
        self.one(workflows, workflow("run: sudo no-such-program"), "no program of this machine")
        self.one(workflows, workflow("uses: actions/checkout"), "no version")
        self.one(workflows, workflow("name: idle"), "either an action")
        self.one(workflows, workflow("{run: cat x, wiht: 3}"), "the key wiht")
        self.one(workflows, workflow("run: 'cat ${{ secrets.word }}'"), "is not one that this check knows")
        self.one(workflows, workflow("run: cat x", head="env: {}"), "nothing that starts it")
        self.one(workflows, {f"{workflows.FOLDER}a.yml": "name: [\n"}, "no YAML")

    def test_action_that_the_forge_cannot_run(self):
        def action(step, head="inputs: {a: {description: d, required: true}}"):
            text = f"name: n\ndescription: d\n{head}\nruns:\n  using: composite\n  steps:\n    - {step}\n"
            return {".github/actions/g/action.yml": text}

        try:
            self.assertEqual([], self.found(workflows, action("{run: 'cat \"$A\"', shell: bash, env: {A: '${{ inputs.a }}'}}")))
        except formatting.Absent as reason:
            self.skipTest(str(reason))
        self.one(workflows, action("run: cat x"), "with its shell")
        self.one(workflows, action("uses: actions/cache"), "no version")
        self.one(workflows, action("{run: 'cat ${{ inputs.a }}', shell: bash}"), "part of a script")
        self.one(workflows, action("{run: cat x, shell: bash, env: {B: '${{ inputs.b }}'}}"), "no input b")
        self.one(workflows, action("{run: 'if true', shell: bash}"), "bash cannot read")
        self.one(workflows, action("{run: '\"$GITHUB_ACTION_PATH/../../../nothing\" x', shell: bash}"), "no program of this tree")
        self.one(workflows, action("{run: cat x, shell: bash}", head="inputs: {a: {description: d}}"), "default and required")

    def test_change_that_no_longer_applies(self):
        change = "file: core/body.hpp\nold: {}\nnew: x\ntarget: t\ntests: ^core\n"
        self.assertEqual([], self.found(mutations, {"tests/mutate/changes.txt": change.format("#pragma once")}))
        self.one(mutations, {"tests/mutate/changes.txt": change.format("#pragma twice")}, "is 0 times in core/body.hpp")
        self.one(mutations, {"tests/mutate/changes.txt": change.format("e")}, "times in core/body.hpp")
        self.one(mutations, {"tests/mutate/changes.txt": "file: core/body.hpp\n"}, "no old")

    def test_unformatted_source(self):
        try:
            formatting.clang_format()
        except formatting.Absent as reason:
            self.skipTest(str(reason))
        self.one(formatting, {"core/a.cpp": "int   a ;\n"}, "core/a.cpp:1")

    def test_faulty_shell_script(self):
        try:
            self.one(shell_scripts, {"broadside": "#!/usr/bin/env bash\nrm $1\n"}, "SC2086")
        except formatting.Absent as reason:
            self.skipTest(str(reason))


if __name__ == "__main__":
    unittest.main()
