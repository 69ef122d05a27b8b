"""Calibrations of a made-up coupon: the medium goes at the speed x, and k x comes off it in each second."""

import csv
import json
import math
import tomllib
import unittest

import numpy as np

from toryu.study import calibration_output
from toryu.study.calibration_depths import Coupon, NoDepth
from toryu.study.least_squares import Fit
from toryu_testing.study_case import HEAD, Study

CASE = """[case]
title = "coupon"
end_time = 1e9
[[wall]]
name = "left_piece"
box = { min = [0.0, -0.012], max = [0.004, 0.012] }
work_piece = true
[[wall]]
name = "piston"
[fluid]
[fluid.removal]
preston_coefficient = 1e-12
"""
PARAMETERS = """
[[calibration.parameter]]
name = "slip"
unit = "m/s"
keys = ["fluid.x"]
start = 2.9
bounds = [0.01, 100.0]
log = true
[[calibration.parameter]]
name = "preston"
unit = "1/Pa"
keys = ["fluid.removal.preston_coefficient"]
start = 1e-6
bounds = [1e-9, 1e-3]
log = true
"""
DROP = """
[[metric]]
name = "speed"
series = "fluid.csv:speed[m/s]"
[[metric]]
name = "drop"
unit = "Pa"
formula = "1000 / speed"
"""
MEASURED = """
[[calibration.measured]]
metric = "drop"
value = 333.333333
scatter = 3.33333333
"""
DEPTH = """
[[calibration.depth]]
file = "depths.csv"
work_piece = "left_piece"
face = "right"
seconds = 100
"""
DEPTHS = "place[m],depth[m],scatter[m]\n-0.002,6e-4,1.2e-5\n0.003,6e-4,1.2e-5\n"  # x = 3, k = 2e-6
STEADY = HEAD + 'set = { fluid.y = 0 }\n'


class Calibration(Study):
    def setUp(self):
        super().setUp()
        (self.case / "case.toml").write_text(CASE)
        (self.case / "depths.csv").write_text(DEPTHS)

    def write(self, text=DROP + PARAMETERS + MEASURED + DEPTH, head=STEADY):
        super().write(text, head)

    def ended(self, code):
        ended = self.study()
        self.assertEqual(ended.returncode, code, ended.stderr)
        return ended

    def covariances(self):
        with open(self.out / "calibration.csv", newline="") as file:
            return list(csv.DictReader(file))


class Words(unittest.TestCase):
    def verdict(self, *residuals):
        jacobian = np.array([[1.0], *[[0.0]] * (len(residuals) - 1)])
        return calibration_output.verdict(Fit(np.zeros(1), np.array(residuals), jacobian, np.ones(1), True))

    def test_whether_the_model_describes_the_data(self):
        self.assertIn("nothing is left to judge the model by", self.verdict(0.0))
        self.assertIn("Chi squared is 2.5 over 2 degrees of freedom, exceeded by chance with a probability of 0.29: the model "
                      "describes the data", self.verdict(0.5, 1.5, 0.0))
        self.assertIn("does not describe the data within their scatter", self.verdict(0.0, 3.0))
        self.assertIn("lie closer to the model than their scatter", self.verdict(0.1, 0.1, 0.2, 0.1, 0.1, 0.1))


class HowLong(unittest.TestCase):
    time = np.array([0.0, 1.0, 2.0, 3.0])

    def worked(self, depth, **given):
        keys = dict.fromkeys(("cycles", "cycle", "seconds")) | {"shares": (0.5, 1.0)} | given
        return Coupon("", "", "upper", None, **keys).worked(self.time, np.array(depth)[:, None])

    def test_in_cycles_the_first_is_counted_as_it_is(self):
        self.assertEqual(self.worked([0, 2, 3, 4], cycles=50, cycle=1.0), [51])
        with self.assertRaisesRegex(NoDepth, "fewer than two cycles of 2 s"):
            self.worked([0, 2, 3, 4], cycles=50, cycle=2.0)

    def test_in_seconds_at_the_rate_within_the_shares(self):
        self.assertEqual(self.worked([0, 5, 6, 8], seconds=10, shares=(1 / 3, 1.0)), [15])
        with self.assertRaisesRegex(NoDepth, "fewer than two rows"):
            self.worked([0, 5, 6, 8], seconds=10, shares=(0.9, 1.0))


class Fits(Calibration):
    def test_finds_what_the_measurements_were_made_by_with_exact_errors(self):
        self.write()
        ended = self.done()
        told = tomllib.loads((self.out / "calibration.toml").read_text())["fluid"]
        slip, preston = self.covariances()
        # drop = 1000/x to 1 %, k x to 2 % twice
        self.assertAlmostEqual(told["x"] / 3, 1, delta=0.05 * 0.01)
        self.assertAlmostEqual(told["removal"]["preston_coefficient"] / 2e-6, 1, delta=0.05 * 0.0173)
        self.assertAlmostEqual(float(slip["error"]), 0.01, delta=2e-5)
        self.assertAlmostEqual(float(preston["error"]), math.sqrt(0.02**2 / 2 + 0.01**2), delta=4e-5)
        self.assertAlmostEqual(float(slip["covariance with preston"]), -0.01**2, delta=4e-7)
        self.assertEqual((slip["proportional"], preston["proportional"]), ("", "preston_depth"))
        self.assertIn("over 1 degree of freedom", ended.stdout)
        for name in ("measured_1", "measured_2", "depth_1"):
            self.assertTrue((self.out / f"charts/{name}.png").is_file(), name)
        self.assertIn("What the measurements tell", (self.out / "study.html").read_text())
        ran = [json.loads(path.read_text())["set"]["fluid.removal.preston_coefficient"] for path in self.out.glob("runs/*/run.json")]
        self.assertEqual(sum(float(k) != 1e-6 for k in ran), 1, "only the last run has another coefficient of removal")
        self.goes_on_where_it_was_stopped()
        (self.case / "depths.csv").write_text(DEPTHS.replace("6e-4", "7e-4", 1))  # these ask for no other slip
        self.assertIn("the model does not describe the data within their scatter", self.done().stdout)

    def goes_on_where_it_was_stopped(self):
        started, fitted = self.starts(), (self.out / "calibration.toml").read_text()
        (self.out / "runs" / started[2] / "run.json").unlink()
        (self.out / "calibration.toml").unlink()
        self.done()
        self.assertEqual(self.starts(), [*started, started[2]], "the others are kept")
        self.assertEqual((self.out / "calibration.toml").read_text(), fitted)
        self.assertIn(f"{len(started)} of them done", self.done("--check").stdout)

    def test_what_was_measured_under_several_conditions(self):
        # speed = x + y t after 3 s
        parameter = PARAMETERS.split("[[calibration.parameter]]")[1].replace("log = true", "")
        self.write(DROP + "[[axis]]\nname = 'gain'\nvalues = [0, 2]\nkeys = ['fluid.y']\n[[calibration.parameter]]" + parameter
                   + "".join(f"[[calibration.measured]]\nmetric = 'speed'\nvalue = {value}\nscatter = 0.1\n"
                             f"at = {{ gain = {gain} }}\n" for gain, value in ((0, 3.1), (2, 8.9))), HEAD)
        self.done()
        self.assertAlmostEqual(tomllib.loads((self.out / "calibration.toml").read_text())["fluid"]["x"], 3, delta=0.004)
        (row,) = self.covariances()
        self.assertAlmostEqual(float(row["error"]), 0.1 / math.sqrt(2), delta=1e-6)
        self.assertIn("Chi squared is 2 over 1 degree", self.done().stdout)

    def test_a_coefficient_that_a_metric_hangs_on_is_run_like_any_other(self):
        self.write(DROP + '[[metric]]\nname = "removed"\nseries = "fluid.csv:removed_depth_mean[m]"\n' + PARAMETERS + MEASURED
                   + MEASURED.replace("drop", "removed") + DEPTH)
        self.assertIn("gives no 'removed'", self.ended(2).stderr)  # the made-up solver has no such series


class Ends(Calibration):
    def test_parameters_that_the_data_do_not_tell_apart_are_named(self):
        self.write()
        self.done()
        self.write(DROP + PARAMETERS + DEPTH)
        words = self.ended(2).stderr
        self.assertIn("'slip' and 'preston' cannot be told apart", words)
        self.assertIn("Measure in addition a pressure drop or a speed in passages of two widths.", words)
        self.assertFalse((self.out / "calibration.toml").exists(), "what was fitted to other data is not left")

    def test_a_parameter_that_nothing_depends_on_is_named(self):
        self.write(DROP + PARAMETERS.replace("fluid.removal.preston_coefficient", "fluid.cost") + MEASURED * 2)
        self.assertIn("'preston' cannot be found: what was measured hardly depends on it.", self.ended(2).stderr)

    def test_a_run_that_fails_ends_it_with_its_cause(self):
        self.write(DROP + PARAMETERS.replace("fluid.x", "fluid.step") + MEASURED + DEPTH)
        words = self.ended(3).stderr
        self.assertIn("window.toml: error: the run with slip 2.9, preston 1e-06 failed: particle 7 left the domain", words)

    def test_a_depth_that_is_not_proportional_is_found_out(self):
        program = (self.bin / "fluid_solver").read_text()
        (self.bin / "fluid_solver").write_text(program.replace(
            'values["fluid.removal.preston_coefficient"] * ', 'values["fluid.removal.preston_coefficient"]**1.5 * '))
        self.write()
        self.assertIn("is not proportional to the coefficient of removal", self.ended(1).stderr)

    def test_what_the_case_does_not_have_is_told_before_it_runs(self):
        for case, depth, words in (
                (CASE.replace("work_piece = true\n", ""), DEPTH, "36: error: the wall 'left_piece' is no work piece"),
                (CASE, DEPTH + "law = 'shear'\n", "39: error: the case tells no shear depth: [fluid.removal] has no such law"),
                (CASE.replace("end_time = 1e9", "end_time = 3.0"), DEPTH.replace("seconds = 100", "cycles = 9\ncycle = 2.0"),
                 "39: error: the case ends at 3 s and holds fewer than two cycles of 2 s")):
            (self.case / "case.toml").write_text(case)
            self.write(DROP + PARAMETERS + MEASURED + depth)
            self.assertIn(words, self.ended(2).stderr)
            self.assertEqual(self.starts(), [])

    def test_a_place_beyond_the_face(self):
        (self.case / "depths.csv").write_text(DEPTHS.replace("0.003", "0.3"))
        self.write()
        self.assertIn("depths.csv: the place 0.3 m lies beyond the right face of 'left_piece', -0.012 to 0.012 m",
                      self.ended(2).stderr)


class Faults(Calibration):
    def faults(self, text, head=STEADY):
        self.write(text, head)
        ended = self.ended(2)
        self.assertEqual(self.starts(), [])
        return ended.stderr.replace(str(self.case) + "/", "").splitlines()

    def test_all_at_once_with_their_lines(self):
        found = self.faults(DROP + PARAMETERS.replace("[0.01, 100.0]", "[-1, 100.0]").replace("start = 1e-6", "start = 1")
                            + MEASURED.replace('"drop"', '"dorp"').replace("3.33333333\n", "0\n", 1).replace(
                                "scatter = 3.33333333", "scatter = 0")
                            + DEPTH.replace('"right"', '"front"').replace("seconds", "cycles"))
        self.assertEqual(found, [
            "window.toml:19: error: 'bounds' must be above 0 where 'log' is true, found [-1, 100.0]",
            "window.toml:25: error: 'start' must lie within the bounds [1e-09, 0.001], found 1",
            "window.toml:30: error: 'metric' must be one of 'speed', 'drop', found 'dorp'; did you mean 'drop'?",
            "window.toml:32: error: 'scatter' is the standard deviation of the measured value, above 0, found 0",
            "window.toml:34: error: [[depth]] 1 needs how long the coupon was worked: 'cycles' with the 'cycle' [s] of the run, "
            "or 'seconds'",
            "window.toml:37: error: 'face' must be one of 'left', 'right', 'lower', 'upper', found 'front'"])

    def test_what_is_missing(self):
        self.assertIn("window.toml:14: error: [calibration] needs [[calibration.measured]] or [[calibration.depth]]: something "
                      "that was measured", self.faults(DROP + PARAMETERS))
        self.assertIn("2 parameters cannot be found from 1 measured value", self.faults(DROP + PARAMETERS + MEASURED)[0])
        self.assertIn("'fluid.x' is fitted, and 'set' of [study] gives it: it can have one value only",
                      self.faults(DROP + PARAMETERS + MEASURED + DEPTH, HEAD + "set = { fluid.x = 0 }\n")[0])
        self.assertIn("[[measured]] 1 must say at which 'gain' it was measured, at = { gain = ... }",
                      self.faults(DROP + "[[axis]]\nname = 'gain'\nvalues = [0, 2]\nkeys = ['fluid.y']\n" + PARAMETERS
                                  + MEASURED + MEASURED, HEAD)[0])

    def test_a_table_of_depths(self):
        for text, words in (
                            ("place,depth\n1,2\n", "depths.csv:1: the columns must be place[m],depth[m],scatter[m], found "
                             "'place,depth'"),
                            (DEPTHS.replace("6e-4", "deep", 1), "depths.csv:2: a row must be a place, a depth and its scatter above "
                             "0, found '-0.002,deep,1.2e-5'"),
                            ("", "depths.csv: the columns must be place[m],depth[m],scatter[m], found nothing"),
                            ("place[m],depth[m],scatter[m]\n", "depths.csv: holds no measured depth")):
            (self.case / "depths.csv").write_text(text)
            self.assertIn(words, self.faults(DROP + PARAMETERS + MEASURED * 2 + DEPTH)[0])
        self.assertIn("'file' must be a CSV file beside the study, found 'absent.csv': No such file or directory",
                      self.faults(DROP + PARAMETERS + MEASURED * 2 + DEPTH.replace("depths.csv", "absent.csv"))[0])


class Taken(Calibration):
    """By a study of removal."""
    REMOVAL = """
[removal]
calibration = "calibration.toml"
pistons = ["piston"]
piston_area = 0.5
cycle = 2.0
answer = { wanted_depth = 1e-4 }
"""

    def setUp(self):
        super().setUp()
        (self.case / "calibration.toml").write_text("[fluid]\nx = 3.0\n[fluid.removal]\npreston_coefficient = 2e-6\n")
        (self.case / "calibration.csv").write_text(
            "parameter,unit,scale,proportional,keys,value,error,covariance with slip,covariance with preston\n"
            "slip,m/s,logarithm,,fluid.x,3.0,0.01,1e-4,-1e-4\n"
            "preston,1/Pa,logarithm,preston_depth,fluid.removal.preston_coefficient,2e-06,0.0173205081,-1e-4,3e-4\n")

    def test_foresees_with_an_interval(self):
        self.write(self.REMOVAL)
        ended = self.done()
        row, *near = self.table()
        self.assertEqual([row["calibration"], *(r["calibration"] for r in near)],
                         ["fitted", "slip + 1 standard error", "slip - 1 standard error"])
        # Of 30 points on each piece 2 are corners that lose twice as much, with a face sqrt(2) as large; of k x the
        # variances are those of k and of x and twice their covariance: 0.0003 + 0.0001 - 0.0002.
        share = (28 + 2 * 2 * 2 ** 0.5) / (28 + 2 * 2 ** 0.5)
        self.assertAlmostEqual(float(row["removed_per_cycle[m]"]) / (6e-6 * share), 1, delta=2e-3)
        self.assertAlmostEqual(float(row["removed_per_cycle_error[m]"]) / float(row["removed_per_cycle[m]"]), 0.02 / 2 ** 0.5,
                               delta=5e-5)
        # 900 x of force over 0.5 m2/m
        self.assertAlmostEqual(float(row["piston_pressure_error[Pa]"]) / float(row["piston_pressure[Pa]"]), 0.01, delta=5e-5)
        self.assertEqual([r["cycles_needed"] for r in near], ["", ""])
        self.assertIn("by the calibration the depth is then uncertain by 1.", ended.stdout)

    def test_charts_take_the_fitted_values(self):
        self.write(self.REMOVAL + '[[axis]]\nname = "gain"\nvalues = [0, 1]\nkeys = ["fluid.y"]\n'
                   '[[chart]]\nx = "gain"\ny = "removed_per_cycle"\n', HEAD)
        ended = self.done()
        self.assertEqual(len(self.table()), 6)
        self.assertIn("100 µm come off most evenly with gain 0: ", ended.stdout)

    def test_a_calibration_that_is_not_whole(self):
        self.write(self.REMOVAL)
        text = (self.case / "calibration.toml").read_text()
        (self.case / "calibration.toml").write_text(text.replace("x = ", "x = 1"))
        self.assertIn("window.toml:7: error: 'calibration.toml' and the calibration.csv beside it are not of one calibration: "
                      "'fluid.x' is 1", self.ended(2).stderr.replace(str(self.case) + "/", ""))
        (self.case / "calibration.csv").unlink()
        self.assertIn("'calibration' needs the calibration.csv that the calibration wrote beside 'calibration.toml': No such file",
                      self.ended(2).stderr)
        (self.case / "calibration.toml").unlink()
        self.assertIn("'calibration' must be the calibration.toml of a calibration, found 'calibration.toml'",
                      self.ended(2).stderr)


if __name__ == "__main__":
    unittest.main()
