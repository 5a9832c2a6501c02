"""The launcher ./broadside, with small scripts in place of the machine's programs: apt-get, dpkg-query, cmake, ctest."""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# Each stands in for a program of that name and notes its call in $PLAYED/calls.
MACHINE = {
    # Everything is installed but what the file `missing` names.
    "dpkg-query": 'for p in "${@:4}"; do grep -qx -- "$p" "$PLAYED/missing" || echo "installed $p"; done; exit 1',
    "apt-get": '[[ -e $PLAYED/offline ]] && { echo "E: Could not resolve the server"; exit 100; }; '
               '[[ " $* " == *" install "* ]] && : >"$PLAYED/missing"; exit 0',
    "dpkg": "exit 0",
    "cmake": '[[ " $* " == *" --preset "* && -e $PLAYED/unconfigurable ]] && { echo "CMake Error: no compiler"; exit 1; }; '
             'if [[ " $* " == *" --preset "* ]]; then mkdir -p build/release/bench; touch build/release/build.ninja; '
             "printf '#!/bin/sh\\necho ran \"$@\"\\n[ \"$1\" != fetch ] || [ ! -e $PLAYED/offline ]\\n' >build/release/bench/broadside; chmod +x build/release/bench/broadside; "
             'else [[ ! -e $PLAYED/uncompilable ]] || { echo "a.cpp:1: error: expected"; exit 1; }; fi',
    "ctest": 'echo "0% tests passed, 1 tests failed out of 1"; exit 8',
    "nvcc": "printf 'sm_%s\\n' 75 86 90",
    # The compute capabilities of the file `gpus`; without it there is no GPU.
    "nvidia-smi": '[[ -e $PLAYED/gpus ]] || { echo "NVIDIA-SMI has failed"; exit 9; }; cat "$PLAYED/gpus"',
}


class Launcher(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        scratch = Path(self.folder.name)
        self.tree, self.programs, self.played = scratch / "tree", scratch / "programs", scratch / "played"
        for folder in (self.tree / "cmake", self.programs, self.played):
            folder.mkdir(parents=True)
        for name in ("broadside", "CMakePresets.json", "cmake/packages.txt", "cmake/packages_python.txt",
                     "cmake/packages_contest.txt"):
            shutil.copy(ROOT / name, self.tree / name)
        for name, body in MACHINE.items():
            script = self.programs / name
            script.write_text(f'#!/bin/bash\necho "{name} $*" >>"$PLAYED/calls"\n{body}\n', encoding="utf-8")
            script.chmod(0o755)
        # This sudo only runs the command that follows it, so that these tests do the same for every user.
        sudo = self.programs / "sudo"
        sudo.write_text('#!/bin/bash\n[[ $1 == -n ]] && shift\nexec "$@"\n', encoding="utf-8")
        sudo.chmod(0o755)
        (self.played / "missing").touch()
        (self.played / "calls").touch()

    def tearDown(self):
        self.folder.cleanup()

    def call(self, *arguments, **more):
        environment = {"PATH": f"{self.programs}:{os.environ['PATH']}", "PLAYED": str(self.played), **more}
        (self.played / "calls").write_text("", encoding="utf-8")
        answer = subprocess.run([self.tree / "broadside", *arguments], env=environment, stdin=subprocess.DEVNULL,
                                capture_output=True, text=True, check=False)
        self.calls = (self.played / "calls").read_text(encoding="utf-8").splitlines()
        return answer

    def called(self, start):
        return [call for call in self.calls if call.startswith(start)]

    def test_second_call_neither_installs_nor_configures(self):
        (self.played / "missing").write_text("libfcl-dev\n", encoding="utf-8")
        first = self.call("list", "engines")
        self.assertEqual((0, "ran list engines\n"), (first.returncode, first.stdout), first.stderr)
        self.assertIn("installing 1 packages", first.stderr)
        self.assertTrue(self.called("apt-get") and self.called("cmake --fresh"), self.calls)
        second = self.call("list", "engines")
        self.assertEqual((0, "ran list engines\n", ""), (second.returncode, second.stdout, second.stderr))
        self.assertEqual([], self.called("apt-get") + self.called("cmake --fresh"))

    def test_python_alone_installs_what_only_it_needs_and_builds_its_wheel(self):
        (self.played / "missing").write_text("pybind11-dev\n", encoding="utf-8")
        self.assertEqual(0, self.call("list", "engines").returncode)
        self.assertEqual([], self.called("apt-get"), "other calls do without")
        answer = self.call("python")
        self.assertIn("installing 1 packages of", answer.stderr)
        self.assertIn("pybind11-dev", answer.stderr)
        self.assertIn("--target python_wheel", " ".join(self.called("cmake --build")))
        self.assertEqual(4, answer.returncode, "the cmake of this test makes no wheel")
        self.assertIn("the build made no wheel", answer.stderr)

    def test_contest_installs_its_own_engines_where_somebody_agrees(self):
        (self.played / "missing").write_text("libdart-dev\nlibsimbody-dev\n", encoding="utf-8")
        answer = self.call("contest")
        self.assertEqual((0, "ran contest\n"), (answer.returncode, answer.stdout), answer.stderr)
        self.assertIn("absent from the contest: libdart-dev libsimbody-dev; --yes installs them", answer.stderr)
        self.assertEqual([], self.called("apt-get"), "nobody was there to agree")
        self.assertEqual([], self.call("demo").stderr.splitlines(), "other calls do without")
        for arguments in (("contest", "--help"), ("contest", "--engines", "plain-rigid"), ("contest", "--only-report")):
            self.assertEqual("", self.call(*arguments).stderr, arguments)
        self.assertIn("libdart-dev", self.call("contest", "--engines", "dart-world").stderr)
        answer = self.call("contest", "--yes")
        self.assertEqual((0, "ran contest --yes\n"), (answer.returncode, answer.stdout), answer.stderr)
        self.assertIn("installing 2 packages", answer.stderr)
        self.assertTrue(self.called("cmake --fresh"), "CMake looks for what came")
        self.assertEqual("", self.call("contest").stderr)

    def test_only_the_tests_and_build_itself_build_more_than_the_program(self):
        for arguments, target in ((("demo",), "broadside"), (("list", "engines"), "broadside"), (("test",), "all"), (("build",), "all")):
            self.call(*arguments)
            built = [call.split(" --target ")[1].split()[0] for call in self.called("cmake --build")]
            self.assertEqual([target], built, arguments)

    def test_demo_has_a_place_for_its_results_unless_told_another(self):
        self.assertEqual(f"ran demo --out {self.tree}/out/demo --frames 3\n", self.call("demo", "--frames", "3").stdout)
        self.assertEqual("ran demo --out=x\n", self.call("demo", "--out=x").stdout)

    def test_demo_without_the_bunny_says_so_and_goes_on(self):
        self.call("build")
        (self.played / "offline").touch()
        answer = self.call("demo")
        self.assertEqual((0, f"ran demo --out {self.tree}/out/demo\n"), (answer.returncode, answer.stdout))
        self.assertIn("a stand-in takes its place: ran fetch bunny", answer.stderr)
        self.assertEqual("", self.call("demo", BROADSIDE_MESH_DIR="meshes").stderr, "given meshes are not fetched")

    def test_package_makes_packages_of_the_program_that_was_built(self):
        script = self.tree / "cmake/package"
        script.write_text('#!/bin/bash\n[[ -x $1/bench/broadside ]] && echo "packs $1 into $2"\n', encoding="utf-8")
        script.chmod(0o755)
        build = f"{self.tree}/build/release"
        self.assertEqual(f"packs {build} into {self.tree}/out/packages\n", self.call("package").stdout)
        self.assertEqual(f"packs {build} into there\n", self.call("package", "there").stdout)
        self.assertIn(f"cmake --build {build} --target python_wheel", self.called("cmake --build")[0], "not the tests")

    def test_package_installs_what_its_wheel_needs(self):
        (self.played / "missing").write_text("pybind11-dev\n", encoding="utf-8")
        answer = self.call("package")
        self.assertIn("installing 1 packages of", answer.stderr)
        self.assertIn("pybind11-dev", answer.stderr)

    def test_what_another_package_provides_is_not_installed(self):
        query = self.programs / "dpkg-query"
        query.write_text('#!/bin/bash\nfor p in "${@:4}"; do case $p in npm) ;; '
                         'nodejs) echo "installed nodejs nodejs-dev, npm";; *) echo "installed $p";; esac; done; exit 1\n',
                         encoding="utf-8")
        answer = self.call("list", "engines")
        self.assertEqual((0, "ran list engines\n"), (answer.returncode, answer.stdout), answer.stderr)
        self.assertEqual([], self.called("apt-get"))

    def test_no_network_is_one_line_and_code_2(self):
        (self.played / "missing").write_text("libfcl-dev\n", encoding="utf-8")
        (self.played / "offline").touch()
        answer = self.call("demo")
        self.assertEqual(2, answer.returncode)
        last = answer.stderr.splitlines()[-1]
        self.assertIn("E: Could not resolve the server", last)
        self.assertIn("log: ", last)
        self.assertEqual([], self.called("cmake"), "nothing is configured without its packages")
        (self.played / "offline").unlink()
        self.assertEqual(0, self.call("demo").returncode, "the next call goes on")

    def test_failed_configuration_is_tried_again(self):
        (self.played / "unconfigurable").touch()
        answer = self.call("demo")
        self.assertEqual(4, answer.returncode)
        self.assertRegex(answer.stderr.splitlines()[-1], "configuring failed: .*no compiler.*log: ")
        (self.played / "unconfigurable").unlink()
        self.assertEqual(0, self.call("demo").returncode)
        self.assertTrue(self.called("cmake --fresh"))

    def test_failed_build_shows_the_error_and_runs_nothing(self):
        self.call("build")
        (self.played / "uncompilable").touch()
        answer = self.call("demo")
        self.assertEqual((4, ""), (answer.returncode, answer.stdout))
        self.assertIn("a.cpp:1: error: expected", answer.stderr)
        self.assertRegex(answer.stderr.splitlines()[-1], "the build failed; log: ")

    def test_tests_end_with_the_runners_own_line_and_code(self):
        answer = self.call("test", "-R", "core")
        self.assertEqual(8, answer.returncode)
        self.assertEqual("0% tests passed, 1 tests failed out of 1\n", answer.stdout)
        run = self.called("ctest")[0]
        self.assertIn("-LE ^(slow|gpu)$", run)
        self.assertTrue(run.endswith("-R core"), run)
        self.call("test", "--all")
        self.assertIn("-LE ^(gpu)$", self.called("ctest")[0])

    def test_other_settings_configure_again(self):
        self.call("build")
        self.call("build", BROADSIDE_CUDA_ARCHITECTURES="90")
        self.assertTrue(self.called("cmake --fresh")[0].endswith("-DCMAKE_CUDA_ARCHITECTURES=90"), self.calls)

    def test_compiles_for_the_gpus_of_this_machine_and_packages_for_all(self):
        self.call("build")
        self.assertTrue(self.called("cmake --fresh")[0].endswith("-DCMAKE_CUDA_ARCHITECTURES=75-virtual"), self.calls)
        (self.played / "gpus").write_text("9.0\n8.6\n9.0\n", encoding="utf-8")
        self.call("build")
        self.assertTrue(self.called("cmake --fresh")[0].endswith("-DCMAKE_CUDA_ARCHITECTURES=86-real;90-real"), self.calls)
        self.call("build")
        self.assertEqual([], self.called("cmake --fresh"))
        self.call("package")
        self.assertNotIn("CUDA_ARCHITECTURES", self.called("cmake --fresh")[0])
        self.call("build")
        (self.played / "gpus").write_text("9.0\n13.0\n", encoding="utf-8")
        self.call("build")
        self.assertNotIn("CUDA_ARCHITECTURES", self.called("cmake --fresh")[0], "nvcc knows no 13.0")

    def test_no_subcommand_shows_the_usage(self):
        self.assertEqual(2, self.call().returncode)
        helped = self.call("--help")
        self.assertEqual(0, helped.returncode)
        self.assertLess(helped.stdout.index("./broadside demo"), helped.stdout.index("./broadside run"), "what to do first")
        self.assertIn("out/demo/report.html", helped.stdout)
        self.assertEqual([], self.calls)

    @unittest.skipUnless(os.geteuid() == 0 and shutil.which("setpriv"), "only root can become a user without rights")
    def test_neither_root_nor_sudo_says_what_to_install(self):
        (self.played / "missing").write_text("libfcl-dev\n", encoding="utf-8")
        (self.programs / "sudo").unlink()
        for path in (Path(self.folder.name), *Path(self.folder.name).rglob("*")):
            os.chown(path, 65534, 65534)
        answer = subprocess.run(
            [shutil.which("setpriv"), "--reuid=65534", "--clear-groups", str(self.tree / "broadside"), "demo"],
            env={"PATH": self._path_without_sudo(), "PLAYED": str(self.played)},
            stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        self.assertEqual(2, answer.returncode, answer.stderr)
        self.assertEqual(1, len(answer.stderr.splitlines()), answer.stderr)
        self.assertIn("apt-get install libfcl-dev", answer.stderr)

    def _path_without_sudo(self):
        for folder in ("/usr/bin", "/bin"):
            for name in ("bash", "env", "awk", "comm", "sort", "dirname", "readlink", "mkdir", "flock", "nproc", "grep", "cat"):
                link = self.programs / name
                if not link.exists() and Path(folder, name).exists():
                    link.symlink_to(Path(folder, name))
        return str(self.programs)


if __name__ == "__main__":
    unittest.main()
