"""@broadside.engine: a Python class is recorded, judged, timed and raced as every other engine is."""

import subprocess
import sys

import pytest

import broadside

from flying_engines import AllPairs, Ballistic, Failing, Heavy


def falling():
    from conftest import falling_scene

    return falling_scene()


def test_it_is_run_and_judged(tmp_path):
    sound, heavy = broadside.run(falling(), [Ballistic, Heavy], out=tmp_path)
    assert (sound.engine, heavy.engine) == ("ballistic", "heavy")
    verdicts = broadside.check(sound)
    assert verdicts.ok and verdicts["ballistic"].outcome == "pass", verdicts.lines
    assert broadside.check(heavy)["ballistic"].outcome == "fail"


def test_it_is_timed(tmp_path):
    broadside.run(falling(), Ballistic, out=tmp_path)
    samples = broadside.time(tmp_path / "scene.toml", Ballistic, out=tmp_path / "samples.json", repetitions=1)
    assert len(samples) == 1 and all(sample["stamp"]["engine"] == "ballistic" for sample in samples)
    answer = broadside.report(tmp_path, html=tmp_path / "page.html")
    assert answer.exit_code in (0, 3) and (tmp_path / "page.html").stat().st_size > 1000


def test_a_broad_phase_finds_the_pairs_of_others():
    from broadside.program_engine import command_of

    answer = broadside.program.call("pairs", "boxes:uniform:300", "--engine", command_of(AllPairs),
                                    "--engine", "octree-cpu", "--digest")
    digests = [line.split()[0] for line in answer.text.splitlines()]
    assert len(digests) == 2 and digests[0] == digests[1]


def test_an_exception_is_a_cell_with_its_text(tmp_path):
    with pytest.raises(broadside.Missing, match="ArithmeticError: it blew up"):
        broadside.run(falling(), Failing, out=tmp_path)


def test_what_is_no_engine():
    class Plain:
        pass

    with pytest.raises(broadside.BadInput, match="put @broadside.engine before the class"):
        broadside.run("two-body:apart", Plain)
    made = broadside.engine(type("Made", (), {"__module__": "nowhere"}))
    with pytest.raises(broadside.BadInput, match="its class is in no file"):
        broadside.run("two-body:apart", made)


def test_an_engine_loads_neither_the_module_nor_the_laws():
    """Its process has ten seconds to say hello, also on a machine with other work."""
    script = ("import sys; import broadside.program_engine, broadside; broadside.engine; "
              "print(sorted(name for name in sys.modules if name.startswith('broadside')))")
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == str(["broadside", "broadside.errors", "broadside.program_client",
                                       "broadside.program_engine"])
