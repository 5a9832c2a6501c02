"""One campaign of 40 cells on Slurm, GNU parallel and Snakemake, with failures on the way.

usage: cluster_test.py PROGRAM WRONG_ENGINE SMALL_CLUSTER; exits 77 where one of the three is not installed.

On Slurm: one running cell is killed, the cells of one node are cancelled, and one engine always crashes. The campaign
is resumed until it is complete, and its digests must be those of a single process.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

ENGINES = ["octree-cpu", "octree-cpu[levels=A]", "hash-cpu", "all-pairs", "fcl-tree"]
COUNTS = [3, 5, 7, 9, 12, 15, 20]
FRAMES = 200


def run(*command, check=True, env=None):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, env=env, check=False)
    if check and done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))} ended with {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done


def rows(folder):
    with open(folder / "cells.json", encoding="utf-8") as file:
        return json.load(file)["rows"]


def digests(folder):
    return {(row["stamp"]["scene_name"], row["stamp"]["engine"], row["stamp"]["settings"]): row["digests"]
            for row in rows(folder) if row["state"] == "recorded"}


def alone(program, folder):
    """The same cells by `run`, scene by scene, in one process each."""
    expected = {}
    for n in COUNTS:
        out = folder / f"alone-{n}"
        engines = [word for engine in ENGINES for word in ("--engine", engine)]
        run(program, "run", f"freefall:cube:{n}", "--frames", FRAMES, *engines, "--out", out)
        expected.update(digests(out))
    return expected


def whole_campaign(program, wrong, folder):
    """A campaign file with all 40 cells."""
    folder.mkdir(parents=True)
    scenes = [f"freefall:cube:{n}" for n in COUNTS]
    text = f'name = "cluster"\nscenes = {json.dumps(scenes)}\nengines = {json.dumps(ENGINES)}\nframes = {FRAMES}\n'
    (folder / "c.toml").write_text(text, encoding="utf-8")
    run(program, "plan", folder / "c.toml", "--out", folder / "sound")
    crash = (f'name = "cluster"\nscenes = {json.dumps(scenes[:5])}\nengines = ["{wrong}[fault=1]"]\n'
             f"frames = {FRAMES}\n")
    (folder / "crash.toml").write_text(crash, encoding="utf-8")
    run(program, "plan", folder / "crash.toml", "--out", folder / "crash")
    return folder / "sound", folder / "crash"


def missing(program, folder):
    out = run(program, "merge", folder, check=False).stdout
    return int(out.split(" missing")[0].split()[-1]), out


def wait_for_queue(env, limit_s=240):
    end = time.monotonic() + limit_s
    while time.monotonic() < end:
        if not run("squeue", "--noheader", "--array", env=env).stdout.strip():
            return
        time.sleep(0.5)
    sys.exit("the queue did not empty:\n" + run("squeue", "--array", env=env).stdout)


def running_cells(env):
    out = run("squeue", "--noheader", "--array", "--states=R", "--format=%A %N", env=env).stdout
    return [line.split() for line in out.splitlines() if len(line.split()) == 2]


def on_slurm(program, wrong, small_cluster, folder, expected):
    cluster = folder / "cluster"
    run(small_cluster, "start", cluster)
    env = {**os.environ, "SLURM_CONF": str(cluster / "slurm.conf")}
    try:
        sound, crash = whole_campaign(program, wrong, folder / "slurm")
        run("bash", sound / "slurm.sh", env=env)
        run("bash", crash / "slurm.sh", env=env)
        end = time.monotonic() + 60
        while not running_cells(env) and time.monotonic() < end:
            time.sleep(0.1)
        cells = running_cells(env)
        if not cells:
            sys.exit("no cell ever ran")
        run("scancel", "--signal=KILL", cells[0][0], env=env, check=False)  # one cell is killed
        run("scancel", "--nodelist=node2", "--state=RUNNING", env=env, check=False)  # and those that run on one node
        run("scancel", "--state=PENDING", "--name=cluster-checked", env=env, check=False)  # and those in the queue
        wait_for_queue(env)
        before, text = missing(program, sound)
        if before == 0:
            sys.exit("nothing was missing after cells were killed and cancelled:\n" + text)
        for folder_of in (sound, crash):
            run("bash", folder_of / "slurm.sh", env=env)
        wait_for_queue(env)
    finally:
        run(small_cluster, "stop", cluster, check=False)
    left, text = missing(program, sound)
    if left:
        sys.exit(f"{left} cells are missing after the resumed run:\n{text}")
    compare("slurm", digests(sound), expected)
    crashed = run(program, "merge", crash, check=False)
    if crashed.returncode != 3 or "5 crashed" not in crashed.stdout:
        sys.exit("the cells that always crash are not listed:\n" + crashed.stdout)
    print(f"slurm: {before} of 35 cells were missing after the kill, none after resuming; 5 crashing cells listed")


def by_parallel(program, wrong, folder, expected):
    sound, crash = whole_campaign(program, wrong, folder / "parallel")
    for campaign in (sound, crash):
        run("bash", campaign / "parallel.sh")
    left, text = missing(program, sound)
    if left:
        sys.exit(text)
    compare("parallel", digests(sound), expected)
    print("parallel: complete")


def by_snakemake(program, wrong, folder, expected):
    sound, _ = whole_campaign(program, wrong, folder / "snakemake")
    # One cell is there already and must not be done again.
    first = json.loads((sound / "manifest.json").read_text(encoding="utf-8"))["cells"][0]["id"]
    run(program, "run", sound, "--cell", first)
    before = (sound / "cells" / first / "cells.json").stat().st_mtime_ns
    run("snakemake", "--snakefile", sound / "Snakefile", "--cores", "all", "--directory", folder / "snakemake")
    left, text = missing(program, sound)
    if left:
        sys.exit(text)
    if (sound / "cells" / first / "cells.json").stat().st_mtime_ns != before:
        sys.exit("snakemake did a finished cell again")
    compare("snakemake", digests(sound), expected)
    print("snakemake: complete")


def compare(name, got, expected):
    if got != expected:
        wrong = [key for key in expected if got.get(key) != expected[key]]
        sys.exit(f"{name}: digests differ from a single process for {wrong[:3]} and {len(wrong)} in all")


def main():
    program, wrong, small_cluster = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
    absent = [tool for tool in ("slurmctld", "slurmd", "munged", "parallel", "snakemake") if shutil.which(tool) is None]
    if absent or os.geteuid() != 0:
        print("skipped: not installed: " + ", ".join(absent) if absent else "skipped: small_cluster needs root")
        return 77
    folder = pathlib.Path(tempfile.mkdtemp(prefix="broadside-cluster-"))
    folder.chmod(0o755)
    try:
        expected = alone(program, folder)
        on_slurm(program, wrong, small_cluster, folder, expected)
        by_parallel(program, wrong, folder, expected)
        by_snakemake(program, wrong, folder, expected)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
