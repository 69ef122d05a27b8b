"""Abrasive flow machining: the scene's counts, whether the medium stays whole, momentum, and that a rigid work piece
loses as much as an elastic one.

    abrasive_flow_test.py CASES BUILD/bin [--long]
"""
import functools
import math
import pathlib
import subprocess
import sys
import tempfile
import tomllib
import unittest

import enclosed_medium
import h5py
import numpy as np

from toryu import results

PATHS = {}


class Run:
    """A run of a case of cases/abrasive_flow; its results are kept until the tests are over."""

    def __init__(self, case, *options):
        self.folder = tempfile.TemporaryDirectory()
        self.out = pathlib.Path(self.folder.name)
        run = subprocess.run(
            [sys.executable, "-m", "toryu.launch", "--bin", PATHS["bin"],
             PATHS["cases"] / "abrasive_flow" / case, "--out", self.out, *options],
            capture_output=True, text=True, timeout=1500)
        assert run.returncode == 0, run.stderr
        self.fluid, self.solid = results.read_series(self.out, "fluid"), results.read_series(self.out, "solid")

    def summary(self, participant):
        return tomllib.loads((self.out / f"{participant}_summary.toml").read_text(encoding="utf-8"))

    def last(self, participant, column):
        return getattr(self, participant)[column][-1]


@functools.cache
def cycle():
    """The first cycle past rigid work pieces."""
    return Run("rigid.toml", "--end-time=2.35")


@functools.cache
def coupled():
    return Run("case.toml", "--end-time=0.1")


def check_medium(test, run):
    found = enclosed_medium.conditions(run.out, 2.35)
    test.assertLess(found.volume, 0.002)
    test.assertLess(found.void, 1.2)
    test.assertLess(found.depth, 0)
    test.assertLess(found.flow, 0.01)
    test.assertLess(found.asymmetry, 0.2)


class AbrasiveFlowTest(unittest.TestCase):
    def test_counts_are_those_of_the_thesis(self):
        fluid, solid = coupled().summary("fluid")["particles"], coupled().summary("solid")["particles"]
        self.assertEqual(fluid["fluid"], 1525)
        self.assertEqual(solid["solid"], 192)
        self.assertEqual(sum(fluid[name] for name in ("walls", "lower_piston", "upper_piston")), 1236)

    def test_impulse_is_passed_on_to_rounding(self):
        self.assertLess(coupled().summary("coupler")["figures"]["largest_impulse_error"], 1e-12)

    def test_momentum_of_fluid_and_solid_closes(self):
        run = coupled()

        def vector(participant, name):
            return np.array([run.last(participant, f"{name}_{axis}[N.s/m]") for axis in "xy"])

        given = [vector("fluid", f"impulse_from_{body}")
                 for body in ("lower_piston", "upper_piston", "walls", "interface")]
        friction, clamps = vector("fluid", "friction_impulse_from_interface"), vector("solid", "impulse_from_clamps")
        change = vector("fluid", "momentum") + vector("solid", "momentum")
        # friction is all that the solid feels: what else the interface gave the fluid comes from outside both
        outside = sum(given) - friction + clamps
        self.assertLess(np.linalg.norm(change - outside), 1e-10 * sum(map(np.linalg.norm, [*given, clamps])))

    def test_friction_is_the_only_load(self):
        run = coupled()
        taken, given = (run.last("solid", "impulse_from_load_y[N.s/m]"),
                        run.last("fluid", "friction_impulse_from_interface_y[N.s/m]"))
        self.assertNotEqual(given, 0)
        self.assertAlmostEqual(taken / -given, 1, delta=1e-10)

    def test_medium_stays_whole_over_a_cycle(self):
        check_medium(self, cycle())

    def test_both_work_pieces_lose_alike(self):
        with h5py.File(cycle().out / "surface.h5") as file:
            depth, owner = file["preston_depth"][-1], file["work_piece"][:]
        left, right = (depth[owner == k].mean() for k in (0, 1))
        self.assertGreater(left, 0)
        self.assertLess(abs(left / right - 1), 0.05)

    def test_rigid_work_pieces_lose_what_elastic_ones_do(self):
        rigid = Run("rigid.toml", "--end-time=0.1").last("fluid", "removed_depth_mean[m]")
        elastic = coupled().last("fluid", "removed_depth_mean[m]")
        self.assertGreater(rigid, 0)
        self.assertLess(abs(elastic / rigid - 1), 0.02)


class LongTest(unittest.TestCase):
    def test_medium_stays_whole_over_two_cycles_past_elastic_work_pieces(self):
        run = Run("case.toml")
        check_medium(self, run)
        self.assertEqual(run.last("solid", "detached_particles[1]"), 0)
        self.assertTrue(math.isfinite(run.last("solid", "largest_stretch[1]")))
        self.assertLess(run.last("solid", "largest_stretch[1]"), 1.001)


if __name__ == "__main__":
    chosen = "AbrasiveFlowTest"
    if sys.argv[-1] == "--long":
        chosen = "LongTest"
        sys.argv.pop()
    PATHS["bin"] = pathlib.Path(sys.argv.pop()).resolve()
    PATHS["cases"] = pathlib.Path(sys.argv.pop()).resolve()
    unittest.main(argv=[sys.argv[0], chosen])
