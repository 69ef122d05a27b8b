"""Fair timing and speed against accuracy; formulas and figures of a series that swings."""

import json
import math
import unittest
from types import SimpleNamespace

from toryu.study import oscillation, speed_accuracy
from toryu.study.formula import BadFormula, Formula
from toryu_testing.study_case import Study

SPEED = """
[timing]
repeat = 2
[[axis]]
name = "spacing"
unit = "m"
values = [0.4, 0.2, 0.1]
keys = []
[[axis.derived]]
keys = ["fluid.error"]
scale = 0.5
[[axis.derived]]
keys = ["fluid.cost"]
scale = 0.1
power = -2
[[axis]]
name = "scheme"
[[axis.choice]]
name = "plain"
[[axis.choice]]
name = "slow"
set = { fluid.x = 3 }
[[metric]]
name = "period_error"
series = "fluid.csv:swing[m]"
take = "period"
level = 0.0
against = 1.0
[[metric]]
name = "moved"
series = "fluid.csv:swing[m]"
take = "distance"
against = { spacing = "last" }
[[metric]]
name = "step"
series = "fluid.csv:speed[m/s]"
against = { spacing = "next", scheme = "slow" }
relative = false
[[metric]]
name = "both"
formula = "sqrt(period_error**2 + 0*spacing)"
[[chart]]
kind = "speed_accuracy"
title = "Speed against accuracy of a swing"
error = "period_error"
time = "relative_time"
lines = "scheme"
along = "spacing"
wanted = [0.12, 0.01]
[[chart.mark]]
label = "others"
value = 0.1
source = "Made up (2001)"
"""


class SpeedAgainstAccuracy(Study):
    def test_front_exponent_and_answer(self):
        self.write(SPEED.replace("keys = []\n", 'keys = ["fluid.y"]\n'))
        ended = self.done()
        self.assertEqual(len(self.starts()), 12)
        self.assertEqual(len(set(self.starts())), 12)
        rows = self.table()
        self.assertEqual(len(rows), 6)
        for row, spacing in zip(rows[::2], (0.4, 0.2, 0.1)):
            self.assertAlmostEqual(float(row["period_error"]), spacing / 2, delta=1e-3)
            self.assertAlmostEqual(float(row["both"]), spacing / 2, delta=1e-3)
            self.assertAlmostEqual(float(row["relative_time"]), 0.1 / spacing ** 2 / 0.5, places=5)
        self.assertEqual([row["moved"] == "" for row in rows], [False] * 4 + [True] * 2)
        self.assertGreater(float(rows[0]["moved"]), float(rows[2]["moved"]))
        # the speed at the end is x + 3 y: 1 + 3 * 0.4 against 3 + 3 * 0.2
        self.assertAlmostEqual(float(rows[0]["step[m/s]"]), 2.2 - 3.6)
        self.assertIn("For an error of 0.12 take plain, spacing 0.2 m: 0.1 in 5 times the reference loop.", ended.stdout)
        self.assertIn("No setting has an error of 0.01; the smallest, 0.05, has plain, spacing 0.1 m.", ended.stdout)
        self.assertIn("Other programs were running: the loop took 1.20 times as long", ended.stdout)
        page = (self.out / "study.html").read_text()
        for text in ("Made up (2001)", "k = 0.5", "Pareto front"):
            self.assertIn(text, page)
        record = json.loads((self.out / rows[0]["run"] / "run.json").read_text())
        self.assertEqual((record["jobs"], record["loops"]), (1, [{"processor_time": 0.5, "wall_time": 0.6}] * 2))
        self.assertIn("one run at a time", self.study("--jobs", "2").stderr)

    def test_left_out_and_not_repeated(self):
        text = SPEED.replace("keys = []\n", 'keys = ["fluid.y"]\n').replace("repeat = 2", "repeat = 2\nrepeat_below = 4.0")
        self.write(text[:text.index("[[metric]]")].replace("set = { fluid.x = 3 }", "set = { fluid.seconds = 4.0 }") +
                   '[[leave_out]]\nspacing = [0.4, 0.1]\nscheme = "slow"\n')
        self.done()
        self.assertEqual([(row["spacing[m]"], row["scheme"]) for row in self.table()],
                         [("0.4", "plain"), ("0.2", "plain"), ("0.2", "slow"), ("0.1", "plain")])
        self.assertEqual(len(self.starts()), 4 + 3)
        self.assertEqual(len(self.done("--list").stdout.splitlines()), 7)

    def test_faults(self):
        self.write(SPEED.replace("keys = []\n", 'keys = ["fluid.y"]\n').replace('along = "spacing"', 'along = "spacng"')
                   .replace("repeat = 2", "repeat = 0").replace('formula = "sqrt(', 'formula = "sqr(')
                   .replace("against = 1.0", "against = 0").replace('"next", scheme', '"nxt", scheme'))
        found = [line.split(": error: ")[1] for line in self.study().stderr.splitlines()]
        self.assertEqual(found, [
            "'repeat' must be from 1 to 100, found 0", "'against' 0 has no relative difference; give relative = false",
            "'against' must name a value of the axis 'spacing', one of [0.4, 0.2, 0.1], or 'next' or 'last', found nxt",
            "'formula': 'sqr(period_error**2 + 0*spacing)' has the unknown function 'sqr'; did you mean 'sqrt'?; there "
            "are 'sqrt', 'exp', 'log', 'log10', 'sin', 'cos', 'tan', 'atan', 'sinh', 'cosh', 'tanh', 'abs', 'min', 'max'",
            "'along' must be one of 'spacing', 'scheme', found 'spacng'; did you mean 'spacing'?"])


    def test_without_the_reference_loop_nothing_runs(self):
        self.write(SPEED.replace("keys = []\n", 'keys = ["fluid.y"]\n'))
        (self.bin / "reference_loop").unlink()
        ended = self.study()
        self.assertEqual((ended.returncode, ended.stderr, self.starts()), (
            2, f"{self.bin}/reference_loop: error: no such program, needed by [timing]\n", []))


class Fit(unittest.TestCase):
    def points(self, *pairs):
        return [speed_accuracy.Point(t, e, {}) for t, e in pairs]

    def test_the_front_holds_what_nothing_beats(self):
        points = self.points((1, 0.5), (2, 0.6), (3, 0.2), (4, 0.2), (5, 0.1), (0.5, 0.9))
        self.assertEqual([(p.time, p.error) for p in speed_accuracy.front(points)],
                         [(0.5, 0.9), (1, 0.5), (3, 0.2), (5, 0.1)])

    def test_times_that_differ_by_less_than_the_repetitions_do_decide_nothing(self):
        def point(time, error, spread):
            return speed_accuracy.Point(time, error, {"time_spread": spread})
        both = [point(1.0, 0.2, 0.1), point(1.05, 0.1, 0.0)]
        self.assertEqual([p.error for p in speed_accuracy.front(both)], [0.1])
        self.assertEqual([p.error for p in speed_accuracy.front([point(1.0, 0.2, 0.01), both[1]])], [0.2, 0.1])

    def test_of_settings_that_take_the_same_time_the_most_accurate_is_taken(self):
        def point(time, error, spread):
            return speed_accuracy.Point(time, error, {"time_spread": spread})
        some = [point(1.0, 0.2, 0.1), point(1.05, 0.1, 0.0), point(1.2, 0.01, 0.0)]
        self.assertEqual(speed_accuracy.cheapest_of(some).error, 0.1)
        self.assertEqual(speed_accuracy.cheapest_of([point(1.0, 0.2, 0.01), *some[1:]]).error, 0.2)
        self.assertIsNone(speed_accuracy.cheapest_of([]))

    def test_what_is_to_be_said_of_an_exponent(self):
        def remark(k, points, factor):
            return speed_accuracy.remark(speed_accuracy.Line("", [None] * points, k, factor))
        self.assertEqual(remark(-2.6, 3, 1.1), "the error does not fall with time")
        self.assertEqual(remark(1.0, 2, 1.0), "two points: any power law fits")
        self.assertEqual(remark(1.0, 3, 2.0), "no power law: the points lie far from it")
        self.assertEqual((remark(1.0, 3, 1.1), remark(math.nan, 1, math.nan)), ("", ""))

    def test_an_error_beside_one_of_the_other_sign(self):
        points = [speed_accuracy.Point(t, abs(e), {"error": e}) for t, e in ((1, -0.3), (2, -0.01), (3, 0.02), (4, 0.01))]
        line = speed_accuracy.Line("", points, 1.0, 1.0)
        self.assertEqual([speed_accuracy.changes_sign(line, p, "error") for p in points], [False, True, True, False])

    def test_an_error_that_passes_through_zero_is_no_recommendation(self):
        rows = [{"spacing": s, "error": 0.1} for s in (0.4, 0.2, 0.1)]
        chart = SimpleNamespace(lines=[], along="spacing", time="processor_time", error="error")
        study = SimpleNamespace(axes=[SimpleNamespace(name="spacing", unit="m")], units=lambda: {"processor_time": "s"})

        def answer(*errors):
            points = [speed_accuracy.Point(t, e, row) for t, e, row in zip((1, 2, 3), errors, rows)]
            return speed_accuracy.sentence(chart, study, [speed_accuracy.Line("", points, 1, 1)], 0.1)

        self.assertEqual(answer(0.2, 0.09, 0.05), "For an error of 0.1 take spacing 0.2 m: 0.09 in 2 s.")
        self.assertEqual(answer(0.01, 0.2, 0.05), "For an error of 0.1 take spacing 0.1 m: 0.05 in 3 s. (Cheaper only in "
                                                  "passing through zero: spacing 0.4 m: 0.01 in 1 s.)")
        self.assertIn("it passes through zero", answer(0.2, 0.01, 0.2))

    def test_the_exponent(self):
        k, factor = speed_accuracy.power_law(self.points((1, 1), (8, 0.25), (64, 0.0625)))
        self.assertAlmostEqual(k, 2 / 3)
        self.assertAlmostEqual(factor, 1)
        self.assertTrue(math.isnan(speed_accuracy.power_law(self.points((1, 1)))[0]))


class Formulas(unittest.TestCase):
    def test_values(self):
        self.assertEqual(Formula("-2*x**2 + max(a, 3)/4", ["x", "a"])(x=3, a=8), -16)
        self.assertAlmostEqual(Formula("sqrt(pi*x)", ["x"])(x=math.pi), math.pi)

    def test_undefined_is_nan(self):
        for text in ("1/x", "sqrt(x - 1)", "(x - 1)**0.5", "exp(1e6)", "9.0**9**9"):
            self.assertTrue(math.isnan(Formula(text, ["x"])(x=0)), text)

    def test_nothing_else_is_taken(self):
        for text in ("x.real", "x[0]", "(lambda: 1)()", "'a'", "x if x else 1", "y", "open(x)", "x +", "True", "sqrt(x=1)",
                     "x // 2"):
            with self.assertRaises(BadFormula, msg=text):
                Formula(text, ["x"])


class Oscillation(unittest.TestCase):
    TIMES = [0.01 * k for k in range(501)]

    def series(self, loss=0.0, noise=0.0, shift=0.0):
        """Period 0.8 s; the amplitude falls by the share `loss` in each."""
        return [shift + (1 - loss) ** (t / 0.8) * math.sin(2 * math.pi * t / 0.8) + noise * math.sin(300 * t)
                for t in self.TIMES]

    def test_period_of_a_shifted_and_noisy_swing(self):
        self.assertAlmostEqual(oscillation.period(self.TIMES, self.series()), 0.8, places=4)
        self.assertAlmostEqual(oscillation.period(self.TIMES, self.series(noise=0.1, shift=7)), 0.8, delta=0.02)

    def test_half_a_swing_has_no_period(self):
        self.assertTrue(math.isnan(oscillation.period(self.TIMES[:60], self.series()[:60])))

    def test_amplitude_and_its_loss(self):
        self.assertAlmostEqual(oscillation.amplitude(self.series(shift=3)), 1, places=3)
        self.assertAlmostEqual(oscillation.middle(self.series(shift=3)), 3, places=3)
        self.assertAlmostEqual(oscillation.amplitude_loss(self.TIMES, self.series(loss=0.03), 0.0), 0.03, places=4)
        self.assertAlmostEqual(oscillation.amplitude_loss(self.TIMES, self.series(), 0.0), 0, places=4)


if __name__ == "__main__":
    unittest.main()
