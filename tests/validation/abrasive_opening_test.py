"""A passage that its medium opens at a constant pressure, over 200 cycles: cases/abrasive_opening.

    abrasive_opening_test.py CASES BUILD/bin [--long]
"""

import csv
import pathlib
import subprocess
import sys
import tempfile
import unittest

import lubrication
import numpy as np

PATHS = {}


class Study:
    """A study of the case, run."""

    def __init__(self, name, *options):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder)
            run = subprocess.run([sys.executable, "-m", "toryu.launch", "--bin", PATHS["bin"],
                                  PATHS["cases"] / "abrasive_opening" / name, "--out", out, *options],
                                 capture_output=True, text=True, timeout=900)
            assert run.returncode == 0, run.stderr
            with open(out / "table.csv", newline="", encoding="utf-8") as file:
                self.rows = list(csv.DictReader(file))
            self.time, self.place, self.depth = lubrication.last_shape(out / "recession.csv", "lower", 0.02)
            self.last = [row for row in self.rows if row["machining_time[s]"]][-1]


class TwoWay(unittest.TestCase):
    def test_it_opens_by_a_fifth_within_a_hundredth_of_that(self):
        """V8: w = w_0 exp(6.75e-5 t), +20 % after 2700 s, in at most 10 solutions of the flow."""
        study = Study("two_way.toml")
        slit = lubrication.Slit()
        self.assertLessEqual(len(study.rows), 10)
        self.assertEqual(study.time, 2700)
        opened = (slit.opened_two_way(2700) - slit.width) / 2
        self.assertLess(np.abs(study.depth / opened - 1).max(), 0.01)
        self.assertLess(abs(float(study.last["balance_error"])), 1e-9)
        first = float(study.rows[0]["flow[m2/s]"])
        self.assertAlmostEqual(float(study.last["flow[m2/s]"]) / first / 1.2**3, 1, delta=0.01)


class OneWay(unittest.TestCase):
    def check(self, study, shape, mean):
        """`shape`: largest difference over the mean depth, the ends apart, where the wall bends."""
        slit = lubrication.Slit()
        places, exact, rate = slit.opened_one_way(study.time)
        exact = np.interp(study.place, places, exact)
        self.assertAlmostEqual(study.depth.mean() / exact.mean(), 1, delta=mean)
        inner = (study.place > 5e-4) & (study.place < slit.length - 5e-4)
        self.assertLess(np.abs(study.depth / study.depth.mean() - exact / exact.mean())[inner].max(), shape)
        self.assertLessEqual(len(study.rows), 10)
        return float(study.last["flow[m2/s]"]) / rate

    def test_10_across_it_is_the_funnel_of_lubrication(self):
        self.check(Study("one_way.toml", "--set", "fluid.spacing=0.0002"), 0.01, 0.03)


class OneWayAtFullSize(OneWay):
    def test_10_across_it_is_the_funnel_of_lubrication(self):
        """At 20 across: V8 wants 3 %."""
        self.assertAlmostEqual(self.check(Study("one_way.toml"), 0.01, 0.005), 1, delta=0.01)


if __name__ == "__main__":
    PATHS["cases"], PATHS["bin"] = map(pathlib.Path, sys.argv[1:3])
    chosen = ["OneWay", "OneWayAtFullSize"] if "--long" in sys.argv else ["TwoWay"]
    unittest.main(argv=[sys.argv[0], *chosen])
