"""Maps of a study: where runs fail, found by bisection."""

import math
import unittest
from types import SimpleNamespace

from toryu.study import bisection
from toryu_testing.study_case import HEAD, Study

MAP = """
[[axis]]
name = "stiffness"
unit = "N/m"
values = [1, 16]
keys = ["fluid.k"]

[[metric]]
name = "energy"
series = "fluid.csv:energy[J]"
take = "largest"

[map]
x = "stiffness"
log = ["x"]
explanation = '''
An explicit oscillator is stable while the step times its frequency is below 2 & no more.

Near it the energy grows.'''
[map.y]
name = "step"
unit = "s"
keys = ["fluid.step"]
stable = 0.1
unstable = 10
resolution = 0.4
grid = [4.0]
[[map.wrong]]
metric = "energy"
at_most = 5
[[map.theory]]
label = "step limit"
y = "c / sqrt(x)"
constants = { c = 2 }
"""


class Bisection(unittest.TestCase):
    Y = SimpleNamespace(stable=1.0, unstable=100.0, resolution=0.1, log=True, first_values=lambda: [1.0, 100.0])

    def edge(self, y, stable):
        tried = {}
        while values := bisection.next_values(y, tried):
            tried |= {value: stable(value) for value in values}
        return tried, bisection.bracket(y, tried)

    def test_the_bracket_closes_around_the_edge(self):
        for limit in (1.5, 20, 99):
            tried, (stable, unstable) = self.edge(self.Y, lambda v: v < limit)
            self.assertTrue(stable < limit <= unstable and unstable - stable <= 0.1 * unstable, (stable, unstable))
            self.assertLessEqual(len(tried), bisection.longest(self.Y))

    def test_from_above_and_linear(self):
        y = SimpleNamespace(stable=0.5, unstable=-0.5, resolution=0.05, log=False, first_values=lambda: [0.5, -0.5])
        _, (stable, unstable) = self.edge(y, lambda v: v > -0.2)
        self.assertTrue(unstable <= -0.2 < stable and stable - unstable <= 0.05)

    def test_no_edge_in_the_range(self):
        for answer in (True, False):
            tried, bracket = self.edge(self.Y, lambda _: answer)
            self.assertEqual((len(tried), bracket), (2, None))

    def test_a_stable_island_is_told(self):
        tried = {1.0: True, 10.0: False, 20.0: True, 100.0: False}
        self.assertEqual(bisection.bracket(self.Y, tried), (1.0, 10.0))
        self.assertEqual(bisection.contradictions(self.Y, tried), [20.0])


class Map(Study):
    def test_edge_verdicts_and_theory(self):
        self.write(MAP)
        ended = self.done("--set", "fluid.islands=10")
        edges = self.table("edges.csv")
        for row, k in zip(edges, (1, 16)):
            stable, unstable = float(row["step_stable[s]"]), float(row["step_unstable[s]"])
            limit = 1 / math.sqrt(k)  # from there on the energy grows
            self.assertTrue(stable <= limit <= unstable and unstable - stable <= 0.4 * unstable, row)
            self.assertAlmostEqual(float(row["theory step limit"]), 2 / math.sqrt(k))
            self.assertAlmostEqual(float(row["measured over theory step limit"]), 0.5, delta=0.15)
            self.assertEqual(row["contradictions"], "10")
        rows = self.table()
        kinds = {row["verdict"]: row for row in rows}
        self.assertEqual(set(kinds), {"stable", "wrong", "unstable"})
        self.assertEqual(kinds["wrong"]["cause"], "energy is 31, more than 5")
        unstable = kinds["unstable"]
        self.assertEqual((unstable["cause"], unstable["detected_at[s]"]), ("particle 7 left the domain", "0.5"))
        for text in ("an edge at 2 of 2 values of stiffness", "Measured over theory (step limit): 0.",
                     "2 columns are not monotone"):
            self.assertIn(text, ended.stdout)
        page = (self.out / "study.html").read_text()
        self.assertIn("<p>An explicit oscillator is stable while the step times its frequency is below 2 &amp; no more."
                      "</p>", page)
        self.assertTrue((self.out / "charts/map.png").is_file())
        listed = self.done("--set", "fluid.islands=10", "--list").stdout  # nothing is left to do
        self.assertEqual((len(listed.splitlines()), listed.count("to do")), (len(self.starts()) + 1, 0))

    def test_a_run_that_hangs_is_ended_and_told(self):
        self.write(MAP.replace('keys = ["fluid.step"]', 'keys = ["fluid.hangs"]')
                   .replace("stable = 0.1\n", "stable = 0\n", 1).replace("grid = [4.0]", "").replace("[1, 16]", "[1]").replace('log = ["x"]', "time_limit = 4")
                   .replace("unstable = 10\nresolution = 0.4", "unstable = 1\nresolution = 0.9"))
        ended = self.study()
        self.assertEqual(ended.returncode, 1, ended.stderr)
        self.assertIn("HUNG: stiffness 1 N/m, step 0.5 s. That is a bug.", ended.stdout)
        self.assertEqual([row["verdict"] for row in self.table()], ["stable", "hung", "hung"])
        self.assertIn("hung: a bug", (self.out / "study.html").read_text())

    def test_choices_have_an_edge_each_and_small_is_small(self):
        self.write(MAP.replace('log = ["x"]', 'edges = "model"').replace("grid = [4.0]", "") + """
[[axis]]
name = "model"
[[axis.choice]]
name = "plain"
[[axis.choice]]
name = "always fails"
set = { fluid.fails = 3 }
[small]
values = { stiffness = [16] }
resolution = 0.6
""")
        ended = self.done("--small")
        plain, other = self.table("edges.csv")
        self.assertEqual((plain["stiffness"], plain["model"], plain["step_edge[s]"] != ""), ("16", "plain", True))
        self.assertEqual((other["model"], other["step_edge[s]"], other["verdict"]), ("always fails", "", "unstable"))
        self.assertIn("always fails: an edge at 0 of 1 value of", ended.stdout)
        self.assertTrue((self.out / "charts/edges.svg").is_file())

    def test_a_map_over_two_lists(self):
        self.write(MAP[:MAP.index("[map]")] + """
[[axis]]
name = "step"
values = [0.3, 1]
keys = ["fluid.step"]
[map]
x = "stiffness"
y = "step"
figure = "energy"
explanation = "Made up."
""")
        self.done()
        self.assertEqual([row["verdict"] for row in self.table()], ["stable", "stable", "stable", "unstable"])
        self.assertTrue((self.out / "charts/map.svg").is_file())

    def test_faults(self):
        self.write(MAP.replace("resolution = 0.4", "resolution = 2").replace('"c / sqrt(x)"', '"__import__(x)"')
                   .replace('metric = "energy"', 'metric = "enrgy"').replace('x = "stiffness"', 'x = "stifness"')
                   .replace("grid = [4.0]", "grid = [40]"))
        ended = self.study()
        self.assertEqual(ended.returncode, 2)
        found = ended.stderr.replace(str(self.case) + "/", "").splitlines()
        start = HEAD.count("\n")
        self.assertEqual([line.split(": error: ")[1] for line in found], [
            "the map leaves the axis 'stiffness' open: give it as 'x', or 'edges'",
            "'x' must be one of 'stiffness', found 'stifness'; did you mean 'stiffness'?",
            "'resolution' must be between 0 and 1, found 2", "'grid' must lie between 'stable' and 'unstable', found 40",
            "'metric' must be one of 'energy', found 'enrgy'; did you mean 'energy'?",
            "'y': '__import__(x)' has the unknown function '__import__'; there are 'sqrt', 'exp', 'log', 'log10', 'sin', "
            "'cos', 'tan', 'atan', 'sinh', 'cosh', 'tanh', 'abs', 'min', 'max'"])
        self.assertTrue(found[0].startswith(f"window.toml:{start + 13}: "), found[0])


if __name__ == "__main__":
    unittest.main()
