"""Pairs of boxes over one, two, three and five processes of MPI are those of one search: the same number and digest.

usage: parts_over_processes_test.py MPIEXEC BROADSIDE_MPI_PAIRS BROADSIDE
"""
import json
import os
import subprocess
import sys
import unittest

MPIEXEC, SPREAD, BROADSIDE = sys.argv[1:4]
# Allows more processes than cores, and any user; the names are Open MPI's, and other implementations ignore them.
WISHES = {"OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1",
          "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def spread(processes, *arguments):
    return subprocess.run([MPIEXEC, "-n", str(processes), SPREAD, *arguments], capture_output=True, text=True,
                          check=False, timeout=120, env={**os.environ, **WISHES})


def alone(boxes):
    done = subprocess.run([BROADSIDE, "pairs", boxes, "--engine", "octree-cpu", "--frames", "1", "--json"],
                          capture_output=True, text=True, check=True, timeout=120)
    return json.loads(done.stdout)[0]


class PartsOverProcesses(unittest.TestCase):
    def expect_as_alone(self, boxes, counts):
        expected = alone(boxes)
        for processes in counts:
            done = spread(processes, boxes)
            self.assertEqual(done.returncode, 0, done.stderr)
            found = json.loads(done.stdout)
            self.assertEqual(found["processes"], processes)
            self.assertEqual(found["pairs"], expected["pairs"], f"{boxes}, {processes} processes")
            self.assertEqual(found["digest"], expected["digest"], f"{boxes}, {processes} processes")
            self.assertEqual(found["bytes_between"] > 0, processes > 1)
            self.assertGreaterEqual(found["dealt"], found["boxes"])

    def test_digests_are_those_of_one_search(self):
        self.expect_as_alone("boxes:uniform:20000", (1, 2, 3, 5))
        self.expect_as_alone("boxes:heaps:20000", (3,))
        self.expect_as_alone("boxes:mixed:20000", (3,))

    def test_long_boxes_reach_into_every_part(self):
        self.expect_as_alone("boxes:needles:3000", (3,))

    def test_fewer_boxes_than_processes(self):
        self.expect_as_alone("boxes:uniform:2", (3,))

    def test_an_error_of_all_is_one_exit_code(self):
        done = spread(2, "boxes:nothing:5")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("nothing", done.stderr)
        done = spread(2)
        self.assertEqual(done.returncode, 2)
        self.assertIn("usage", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
