"""Two slits in parallel that their medium opens over 100 cycles: cases/parallel_slits.

    parallel_slits_test.py CASES BUILD/bin [--long]
"""

import csv
import pathlib
import subprocess
import sys
import tempfile
import unittest

import shares

PATHS = {}


class Study:
    """The study, run."""

    def __init__(self, *options):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder)
            run = subprocess.run([sys.executable, "-m", "toryu.launch", "--bin", PATHS["bin"],
                                  PATHS["cases"] / "parallel_slits/study.toml", "--out", out, *options],
                                 capture_output=True, text=True, timeout=900)
            assert run.returncode == 0, run.stderr
            with open(out / "table.csv", newline="", encoding="utf-8") as file:
                rows = [row for row in csv.DictReader(file) if row["machining_time[s]"]]
            with open(out / "goals.csv", newline="", encoding="utf-8") as file:
                self.cycles = float(next(csv.DictReader(file))["cycles"])
            self.share = {float(row["machining_time[s]"]): float(row["share_of_wide"]) for row in rows}
            self.depths = shares.depths(out)


class ParallelSlits(unittest.TestCase):
    def check(self, study, share, depth, cycles):
        """Relative tolerances."""
        slits = shares.Slits()
        for time, found in study.share.items():
            wide, narrow = slits.flows(slits.opened(time))
            self.assertAlmostEqual(found / (wide / (wide + narrow)), 1, delta=share)
        last = max(study.share)
        for found, width, first in zip(study.depths[last], slits.opened(last), slits.widths):
            self.assertAlmostEqual(found / ((width - first) / 2), 1, delta=depth)
        self.assertGreater(study.share[last], study.share[0.0] + 0.02, "the wide one opens faster")
        self.assertAlmostEqual(study.cycles * 27 / slits.time_of(7.5e-5), 1, delta=cycles)

    def test_they_share_the_flow_and_the_wear(self):
        self.check(Study("--small"), 0.02, 0.1, 0.06)


class ParallelSlitsAtFullSize(ParallelSlits):
    def test_they_share_the_flow_and_the_wear(self):
        self.check(Study(), 0.005, 0.05, 0.03)


if __name__ == "__main__":
    PATHS["cases"], PATHS["bin"] = map(pathlib.Path, sys.argv[1:3])
    unittest.main(argv=[sys.argv[0], "ParallelSlitsAtFullSize" if "--long" in sys.argv else "ParallelSlits"])
