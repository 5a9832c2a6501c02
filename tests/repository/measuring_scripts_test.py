"""The scripts that measure: with fake programs, and on the results that the repository keeps."""
import json
import os
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
RACE = os.path.join(ROOT, "bench", "benchmarks", "measure")
REFERENCES = os.path.join(ROOT, "reference", "results", "measure")
GPU = os.path.join(ROOT, "gpu")

# Google Benchmark as far as the script looks at it: names that the filter takes, with these times in ms.
PRETENDED_RACE = """
import json, re, sys
options = dict(a.split("=", 1) for a in sys.argv[1:])
times = {"octree-cpu": 10.0, "embree-collide": 25.0, "fcl-tree": 60.0, "cgal-boxes": 19.0, "bullet-dbvt-tree": 90.0,
         "bullet-dbvt": 80.0, "bullet-dbvt-deferred": 45.0, "all-pairs": 1.0}
rows = []
for suite, families in (("scratch", ("uniform", "heaps", "mixed")), ("moving", ("uniform", "heaps"))):
    for family in families:
        for count in (10000, 1000000, 10000000):
            for engine, ms in times.items():
                name = f"{suite}/{family}/{count}/{engine}"
                if not re.search(options["--benchmark_filter"], name + "/manual_time"):
                    continue
                slow = 3 if family == "mixed" and engine == "octree-cpu" else 1
                for k in range(int(options["--benchmark_repetitions"])):
                    rows.append({"name": name + "/manual_time/repeats:3", "run_type": "iteration", "repetition_index": k,
                                 "real_time": slow * ms})
json.dump({"context": {"host_name": "secret", "executable": "secret"}, "benchmarks": rows},
          open(options["--benchmark_out"], "w"))
"""

# `broadside pairs` with one engine that finds other pairs, and one that did not end.
PRETENDED_PEERS = """
import json, sys
engine = lambda name, digest, ms: {"engine": name, "digest": digest, "update_s": ms / 3e3, "find_s": ms / 3e3, "filter_s": ms / 3e3}
print(json.dumps([engine("octree-cpu", "0x1", 6.0), engine("embree-collide", "0x7", 1.0), engine("cgal-boxes", "0x1", 30.0),
                  {"engine": "bullet-dbvt-tree", "absent": "it took longer than 20 s"}]))
sys.exit(1)
"""

PRETENDED_BROADSIDE = """
import json, os, sys
arguments = sys.argv[1:]
option = lambda name: arguments[arguments.index(name) + 1]
if arguments[0] == "pairs":
    rows = [{"engine": "octree-cpu", "frames": 2, "boxes": 9, "pairs": 40, "raw_pairs": 40, "digest": "0x1", "update_s": 0.002,
             "find_s": 0.004, "filter_s": 0.0, "read_back_s": 0.0},
            {"engine": "bullet-dbvt", "frames": 2, "boxes": 9, "pairs": 40, "raw_pairs": 50, "digest": "0x1", "update_s": 0.02,
             "find_s": 0.04, "filter_s": 0.002, "read_back_s": 0.0},
            {"engine": "fcl-sap", "absent": "signal 6 (Aborted)", "verdict": "abort", "repeat": "broadside of-this-run"}]
    print(json.dumps(rows))
    sys.exit(0)
os.makedirs(option("--out"), exist_ok=True)
stamp = {"machine": "a machine", "broadside_build": "a build"}
json.dump({"rows": [{"stamp": stamp}]}, open(os.path.join(option("--out"), "cells.json"), "w"))
bin_ = lambda **verdicts: {"pairs": sum(verdicts.values()), "verdicts": verdicts, "median_s": 2.5e-6 if verdicts else None}
engine = {"engine": "an-engine", "build": "1.0", "absent": "", "by_separation": {"deep": bin_(agree=7, abort=2), "far": bin_()},
          "by_degeneracy": {"general": bin_(agree=7), "needle": bin_(abort=2)}, "words": {"Assertion": 2},
          "repeat": ["broadside agree --case of-this-run/case.json"]}
print(json.dumps({"pairs": option("--pairs") if "--pairs" in arguments else "boxes", "engines": [engine]}))
"""

# `broadside time`: every frame takes as long as the program's name says, in microseconds.
PRETENDED_TIMES = """
import json, os, sys
arguments = sys.argv[1:]
option = lambda name: arguments[arguments.index(name) + 1]
if arguments[1].startswith("freefall"):
    sys.exit("no device")
rows = []
for k, word in enumerate(arguments):
    if arguments[k - 1] != "--engine":
        continue
    settings = word[len("octree-gpu["):-1]
    if "vertex_stage" not in settings:
        settings += ",vertex_stage=on"
    frame = float(os.path.basename(os.path.dirname(sys.argv[0]))) * 1e-6
    rows.append({"stamp": {"settings": settings, "machine": "a machine", "broadside_build": "a build"}, "final_digest": 7,
                 "stages": [{"stage": "frame", "seconds": [frame] * int(option("--frames"))}]})
json.dump({"rows": rows}, open(option("--out"), "w"))
"""


def program(folder, text):
    path = os.path.join(folder, "program")
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"#!{sys.executable}\n{text}")
    os.chmod(path, os.stat(path).st_mode | stat.S_IXUSR)
    return path


def run(*command):
    return subprocess.run([sys.executable, "-B", *command], check=True, capture_output=True, text=True).stdout


class CpuRace(unittest.TestCase):
    def test_targets_are_met_and_missed(self):
        with tempfile.TemporaryDirectory() as folder:
            out = os.path.join(folder, "race.json")
            said = run(RACE, program(folder, PRETENDED_RACE), out, "--cpu-race", "--counts", "10000", "1000000")
            with open(os.path.join(folder, "race.md"), encoding="utf-8") as file:
                self.assertEqual(file.read(), said)
            with open(out, encoding="utf-8") as file:
                kept = json.load(file)
        self.assertNotIn("secret", json.dumps(kept))
        names = {row["name"] for row in kept["benchmarks"]}
        self.assertFalse([n for n in names if "10000000" in n or "all-pairs" in n or n.startswith("moving/heaps")])
        # 10 ms is more than half of cgal's 19; moving, more than a fifth of the deferred 45; 30 ms of mixed is far beyond.
        self.assertIn("| scratch uniform 10,000 | 10 | 9.5 | 1/2 of cgal-boxes | MISSED: 1.05 times too slow |", said)
        self.assertIn("| scratch uniform 1,000,000 | 10 | 260 | set | met: 26.00 times as fast as asked |", said)
        self.assertIn("| scratch mixed 10,000 | 30 | 9.5 | 1/2 of cgal-boxes | MISSED: 3.16 times too slow |", said)
        self.assertIn("| moving uniform 1,000,000 | 10 | 9 | 1/5 of bullet-dbvt-deferred | MISSED: 1.11 times too slow |", said)

    def test_what_was_not_timed_says_so(self):
        with tempfile.TemporaryDirectory() as folder:
            said = run(RACE, program(folder, PRETENDED_RACE), os.path.join(folder, "race.json"), "--filter",
                       "scratch/heaps/10000/(octree-cpu|embree-collide)")
        self.assertIn("| scratch heaps 10,000 | 10 | 12.5 | 1/2 of embree-collide | met: 1.25 times as fast as asked |", said)
        self.assertIn("| scratch mixed 10,000 | not measured | | | |", said)


class References(unittest.TestCase):
    def test_everything_is_kept_without_paths_and_tabled(self):
        with tempfile.TemporaryDirectory() as folder:
            run(REFERENCES, program(folder, PRETENDED_BROADSIDE), "--to", folder)
            with open(os.path.join(folder, "README.md"), encoding="utf-8") as file:
                page = file.read()
            files = [name for name in os.listdir(folder) if name.endswith(".json")]
            self.assertEqual(len(files), 8, files)
            for name in files:
                with open(os.path.join(folder, name), encoding="utf-8") as file:
                    text = file.read()
                self.assertNotIn("of-this-run", text, name)
                self.assertIn("a machine", text, name)
        self.assertIn("| `an-engine` | 7 agree, 2 abort |", page)
        self.assertIn("| `bullet-dbvt` | 50 | 40 | +25.0 % | 10 | 20 | 1 |", page)
        self.assertIn("abort: signal 6 (Aborted)", page)
        self.assertIn("| asian_dragon | `an-engine` | 0.0025 (9) |", page)
        self.assertIn("2 x Assertion", page)

    def test_the_page_that_is_kept_is_that_of_the_files(self):
        here = os.path.dirname(REFERENCES)
        files = [name for name in os.listdir(here) if name.endswith(".json")]
        if not files:
            self.skipTest("nothing is kept yet")
        with tempfile.TemporaryDirectory() as folder:
            for name in files:
                shutil.copy(os.path.join(here, name), folder)
            run(REFERENCES, "--tables", "--to", folder)
            with open(os.path.join(folder, "README.md"), encoding="utf-8") as made, \
                    open(os.path.join(here, "README.md"), encoding="utf-8") as kept:
                self.assertEqual(made.read(), kept.read())


class ContestMatrix(unittest.TestCase):
    KEEP = os.path.join(ROOT, "bench", "contest", "results", "keep")

    def test_the_page_that_is_kept_is_that_of_the_files(self):
        kept = os.path.dirname(self.KEEP)
        with tempfile.TemporaryDirectory() as folder:
            shutil.copy(os.path.join(kept, "matrix.json"), folder)
            subprocess.run([sys.executable, self.KEEP, "--tables", "--to", folder], check=True)
            with open(os.path.join(folder, "README.md"), encoding="utf-8") as made, \
                    open(os.path.join(kept, "README.md"), encoding="utf-8") as page:
                self.assertEqual(made.read(), page.read())

    def test_what_is_broken_and_what_has_no_trace_are_named(self):
        stamp = {"scene_name": "a", "engine": "mine", "settings_short": "k=1", "machine": "a machine",
                 "broadside_build": "a build", "engine_build": "Mine 1"}
        verdicts = [{"validator": v, "outcome": o, "kind": "mechanics"}
                    for v, o in (("rest", "fail"), ("momentum", "pass"), ("passage", "not applicable"))]
        rows = {"cells.json": [{"stamp": stamp, "state": "recorded", "trace_file": "/of/this/run/a.h5"},
                               {"stamp": {**stamp, "scene_name": "b"}, "state": "crashed", "trace_file": ""},
                               {"stamp": {**stamp, "scene_name": "a@1/960"}, "state": "crashed", "trace_file": ""}],
                "verdicts.json": [{"trace_file": "/of/this/run/a.h5", "verdicts": verdicts}]}
        with tempfile.TemporaryDirectory() as folder:
            for name, content in rows.items():
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    json.dump({"rows": content}, file)
            tables = {"stands.csv": "scene,mine[k=1]\na,0.016666668\nc,at none\n",
                      "passages.csv": 'scene,"moves a step, m",mine[k=1]\nfast: b,0.41666667,through\n',
                      "passage_fast__b.svg": "<svg/>"}
            for name, text in tables.items():
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
            kept = os.path.join(folder, "kept")
            os.mkdir(kept)
            subprocess.run([sys.executable, self.KEEP, folder, "--to", kept], check=True)
            self.assertEqual(["README.md", "matrix.json", "passage_fast__b.svg"], sorted(os.listdir(kept)))
            with open(os.path.join(kept, "README.md"), encoding="utf-8") as file:
                page = file.read()
            self.assertIn("| a | 1/60 |", page)
            self.assertIn("| c | at none |", page)
            self.assertIn("![fast: b](passage_fast__b.svg)", page)
            self.assertIn("| fast: b | 0.417 | through |", page)
            self.assertNotIn("a@1/960", page, "other steps are in the table of steps")
            folder = kept
            with open(os.path.join(folder, "matrix.json"), encoding="utf-8") as file:
                self.assertNotIn("/of/this/run", file.read())
        self.assertIn("| a | rest |", page)
        self.assertIn("| b | crashed |", page)
        self.assertIn("| `mine[k=1]` | Mine 1 | 2 | 0 | 1 | 1 |", page)


class KnownAnswers(unittest.TestCase):
    def test_the_table_that_is_kept_is_that_of_the_file(self):
        with tempfile.TemporaryDirectory() as folder:
            results = os.path.join(folder, "reference", "results")
            os.makedirs(results)
            for name in ("known_answers", "known_answers.json"):
                shutil.copy(os.path.join(ROOT, "reference", "results", name), results)
            page = os.path.join(folder, "reference", "README.md")
            shutil.copy(os.path.join(ROOT, "reference", "README.md"), page)
            subprocess.run([sys.executable, os.path.join(results, "known_answers"), "--table"], check=True)
            with open(page, encoding="utf-8") as made, \
                    open(os.path.join(ROOT, "reference", "README.md"), encoding="utf-8") as kept:
                self.assertEqual(made.read(), kept.read())


class GpuPage(unittest.TestCase):
    def page_of(self, files):
        with tempfile.TemporaryDirectory() as folder:
            for name, result in files.items():
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    json.dump(result, file)
            out = os.path.join(folder, "page.md")
            run(os.path.join(GPU, "measured"), "--results", folder, "--out", out)
            with open(out, encoding="utf-8") as file:
                return file.read()

    def test_the_page_that_is_kept_is_that_of_the_files(self):
        with tempfile.TemporaryDirectory() as folder:
            out = os.path.join(folder, "page.md")
            run(os.path.join(GPU, "measured"), "--out", out)
            with open(out, encoding="utf-8") as made, open(os.path.join(GPU, "MEASURED.md"), encoding="utf-8") as kept:
                self.assertEqual(made.read(), kept.read(), "run gpu/measured and commit gpu/MEASURED.md")

    def test_sets_on_several_gpus_are_compared_with_one(self):
        machine = ("name, driver_version, clocks.max.sm [MHz]\nA GPU, 1.2, 1980 MHz\nA GPU, 1.2, 1980 MHz\n"
                   "\tGPU0\tGPU1\nGPU0\t X \tNV18\nGPU1\tNV18\t X\n")
        row = {"boxes": "heaps", "pairs": 8, "digest": "0x1", "borders_ms": 0.1, "exchange_ms": 0.0, "search_ms": 0.9,
               "bytes_between": 3200000, "bytes_needed": 2800000}
        rows = [{**row, "what": "one", "n": 50, "parts": 1, "ms": 0.75},
                {**row, "what": "one", "n": 100, "parts": 1, "ms": 1.5},
                {**row, "what": "all", "n": 100, "parts": 2, "ms": 1.0}]
        with tempfile.TemporaryDirectory() as folder:
            for name, text in (("rows", "\n".join(map(json.dumps, rows)) + "\na remark"), ("machine", machine)):
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
            out = os.path.join(folder, "of_spread.json")
            command = [sys.executable, os.path.join(GPU, "spread"), "--rows", os.path.join(folder, "rows"), "--machine",
                       os.path.join(folder, "machine"), out]
            self.assertEqual(subprocess.run(command, check=False).returncode, 0)
            with open(out, encoding="utf-8") as file:
                result = json.load(file)
            # A later run of other sets keeps these beside its own, and says of which run they are.
            later = {**rows[0], "n": 70, "ms": 9.0}
            with open(os.path.join(folder, "later"), "w", encoding="utf-8") as file:
                file.write(json.dumps(later) + "\n" + json.dumps({**rows[0], "ms": 0.5}))
            again = [*command, "--beside", out]
            again[3] = os.path.join(folder, "later")
            self.assertEqual(subprocess.run(again, check=False).returncode, 0)
            with open(out, encoding="utf-8") as file:
                self.assertEqual([(r["n"], r["ms"], "run" in r) for r in json.load(file)["rows"]],
                                 [(70, 9.0, False), (50, 0.5, False), (100, 1.5, True), (100, 1.0, True)])
            rows[2]["digest"] = "0x2"
            with open(os.path.join(folder, "rows"), "w", encoding="utf-8") as file:
                file.write("\n".join(map(json.dumps, rows)))
            self.assertEqual(subprocess.run(command, check=False).returncode, 1, "digests differ")
        self.assertEqual((len(result["gpus"]), result["gpus"][1]["clocks.max.sm"], result["links"]),
                         (2, "1980 MHz", ["NV18"]))
        page = self.page_of({"card_spread.json": result})
        self.assertIn("| heaps | 100 | 8 | 1.5 | 1 | 75 % | 75 % | 0.1 | 0 | 0.9 | 3.20 (2.80) | yes |", page)
        result["rows"][2]["digest"] = "0x2"
        self.assertIn("| 3.20 (2.80) | NO |", self.page_of({"card_spread.json": result}))
        result["rows"][2]["run"] = "by another build"
        page = self.page_of({"card_spread.json": result})
        self.assertIn("| NO | earlier 1 |", page)
        self.assertIn("Earlier 1: by another build.", page)

    def test_a_figure_stands_beside_its_gpu_its_date_and_its_command(self):
        row = {"scene": "freefall:bunny:50", "label": "tree", "fps_median": 64390.0, "fps_least": 64000.0,
               "fps_most": 65000.0, "fps_last_quarter": 64215.0, "frames": 3000, "repetitions": 5,
               "median_stage_us": {"vertices": 6.08, "frame": 15.4}}
        page = self.page_of({"t4.json": {"when": "2001-02-03", "gpu": {"name": "NVIDIA T4", "driver_version": "1.2"},
                                         "command": "gpu/measure broadside t4.json", "rows": [row]}})
        for said in ("NVIDIA T4, driver 1.2", "2001-02-03", "`gpu/measure broadside t4.json`", "| 6.08 |", "| 64 215 |"):
            self.assertIn(said, page)

    def test_peers_stand_beside_the_gpu_and_what_found_other_pairs_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            pairs, out = os.path.join(folder, "pairs.json"), os.path.join(folder, "peers.json")
            row = {"n": 30000, "pairs": 40, "ms": 0.5}
            with open(pairs, "w", encoding="utf-8") as file:
                json.dump({"gpu": {"name": "a card"}, "rows": [{**row, "boxes": "exponents", "digest": "0x1"},
                                                               {**row, "boxes": "sheet, frame 50", "digest": "0x2"}]}, file)
            script = [sys.executable, "-B", os.path.join(GPU, "peers"), program(folder, PRETENDED_PEERS), pairs, out]
            self.assertEqual(subprocess.run(script, check=False, stderr=subprocess.DEVNULL).returncode, 0)
            with open(out, encoding="utf-8") as file:
                result = json.load(file)
            page = self.page_of({"h100_peers.json": result})
            # 24 bytes of 30,000 boxes and 8 of 40 pairs at 3 TB/s; the peer of 30 ms is 60 times 0.5 and 5 times 6.
            self.assertIn("| exponents | 30 000 | 40 | 0.00024 | 0.5 | 6 | other pairs | 30 | - | - | 60, 5 | yes |", page)
            self.assertNotIn("frame 50", page)
            with open(pairs, "w", encoding="utf-8") as file:
                json.dump({"rows": [{**row, "boxes": "exponents", "digest": "0x3"}]}, file)
            self.assertEqual(subprocess.run(script, check=False, stderr=subprocess.DEVNULL).returncode, 1)

    def test_two_builds_take_turns_and_their_rows_stand_side_by_side(self):
        with tempfile.TemporaryDirectory() as folder:
            programs = []
            for frame_us in ("10", "20"):
                os.mkdir(os.path.join(folder, frame_us))
                programs.append(program(os.path.join(folder, frame_us), PRETENDED_TIMES))
            out = os.path.join(folder, "card_before-after.json")
            script = [sys.executable, "-B", os.path.join(GPU, "before_after"), *programs, out, "--frames", "10", "--rounds", "2"]
            subprocess.run([*script, "--only", "move:bunny:300"], check=True, capture_output=True)
            with open(out, encoding="utf-8") as file:
                kept = json.load(file)
            done = subprocess.run([*script, "--only", "freefall:bunny:50"], check=False, capture_output=True, text=True)
        self.assertEqual(len(kept["rows"]), 7)
        self.assertEqual({row["change_percent"] for row in kept["rows"]}, {-50.0})
        self.assertEqual((done.returncode, "not measured: before: no device" in done.stderr), (3, True), done.stderr)
        page = self.page_of({"card_before-after.json": kept})
        self.assertIn("| randommove:bunny:300 | tree | 100 000 | 50 000 | -50.0 % | 0.0 % | 2 | yes |", page)
        self.assertIn("Of 7 rows 7 are slower by more than their spread and 0 faster", page)
        kept["rows"][0]["is_same_digest"] = False
        self.assertIn("| NO |", self.page_of({"card_before-after.json": kept}))

    def test_what_failed_or_was_not_measured_is_named(self):
        page = self.page_of({
            "t4.json": {"rows": [{"scene": "freefall:bunny:50", "not_measured": "out of memory"}]},
            "t4_agreement.json": {"rows": [
                {"scene": "a", "label": "flat", "engines": "octree", "outcome": "pass", "frames_compared": 600},
                {"scene": "b", "label": "flat", "engines": "octree", "outcome": "fail", "why": "frame 7 differs"}]},
            "t4_sanitizer.json": {"rows": [{"tool": "racecheck", "name": "pile", "exit": 9, "summary": "3 hazards"}]}})
        self.assertIn("- freefall:bunny:50: not measured: out of memory", page)
        self.assertIn("1 of 2 cells are equal", page)
        self.assertIn("- b flat: fail frame 7 differs", page)
        self.assertIn("- racecheck, pile: exit 9: 3 hazards", page)
        self.assertIn("Date: not recorded", page)

    def test_cells_for_which_no_time_is_left_are_not_measured(self):
        with tempfile.TemporaryDirectory() as folder:
            out = os.path.join(folder, "out.json")
            idle = program(folder, "import time\ntime.sleep(60)\n")
            done = subprocess.run([os.path.join(GPU, "agreement"), idle, out, "--matrix", "--budget", "1", "--jobs", "2"],
                                  capture_output=True, text=True, check=False, timeout=50)
            with open(out, encoding="utf-8") as file:
                rows = json.load(file)["rows"]
        self.assertEqual(done.returncode, 1)
        self.assertIn("0 of 120 cells agree", done.stdout)
        self.assertEqual({row["outcome"] for row in rows}, {"not measured"})
        self.assertEqual(sum(row["why"] == "no time was left" for row in rows), 118)
        self.assertEqual({row["scene"].split(":")[1] for row in rows[:70]},
                         {"cube", "brick", "domino", "sphere", "capsule", "cylinder", "stone"})

    def test_a_results_file_names_its_command_without_folders(self):
        with tempfile.TemporaryDirectory() as folder:
            row, out = os.path.join(folder, "a.row"), os.path.join(folder, "out.json")
            with open(row, "w", encoding="utf-8") as file:
                json.dump({"tool": "memcheck"}, file)
            run(os.path.join(GPU, "result_file.py"), out, row, "--", "/somewhere/gpu/sanitize", "/elsewhere/broadside")
            with open(out, encoding="utf-8") as file:
                kept = json.load(file)
        self.assertEqual(kept["command"], "gpu/sanitize broadside")
        self.assertEqual(kept["rows"], [{"tool": "memcheck"}])
        self.assertRegex(kept["when"], r"^\d{4}-\d\d-\d\d$")

    def test_findings_are_repeated_and_a_mended_one_is_told(self):
        pretended = """
import json, os, sys
arguments = sys.argv[1:]
option = lambda name: arguments[arguments.index(name) + 1]
if arguments[0] == "run":
    if option("--engine") == "cannon":
        sys.exit("cannon: not installed")
    open(os.path.join(option("--out"), "a.h5"), "w").close()
else:
    laws = ["momentum", "contact-truth", "friction-cone", "penetration", "energy-growth", "closed-form"]
    verdict = lambda law: {"validator": law, "outcome": OUTCOME, "measured": 2, "limit": 1, "unit": "m"}
    json.dump({"rows": [{"verdicts": [verdict(law) for law in laws]}]}, open(option("--json"), "w"))
"""
        repeat = os.path.join(ROOT, "reference", "findings", "repeat")
        said = {}
        with tempfile.TemporaryDirectory() as folder:
            for outcome in ("fail", "pass"):
                fake = program(folder, pretended.replace("OUTCOME", repr(outcome)))
                said[outcome] = subprocess.run([repeat, fake], capture_output=True, text=True, check=False, timeout=50)
        self.assertEqual(said["fail"].returncode, 0, said["fail"].stderr)
        self.assertIn("three_balls.toml, bullet-world, energy-growth: fail: 2 m, limit 1", said["fail"].stdout)
        self.assertIn("cannon_friction.toml, cannon, friction-cone: no trace: cannon: not installed", said["fail"].stdout)
        self.assertEqual(said["pass"].returncode, 1)
        self.assertIn("12 no longer break their law", said["pass"].stderr)


if __name__ == "__main__":
    unittest.main()
