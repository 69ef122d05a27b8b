"""Studies of surfaces that recede, of a made-up passage that opens by exp(rate t)."""

import csv
import math
import pathlib
import unittest

from toryu_testing.study_case import HEAD, Study

CASES = pathlib.Path(__file__).resolve().parents[3] / "cases"

CASE = """[case]
title = "passage"
end_time = 3.0
series_interval = 0.01
[[wall]]
name = "lower"
box = { min = [0.0, -0.0025], max = [0.010, -0.001] }
work_piece = true
[[wall]]
name = "upper"
box = { min = [0.0, 0.001], max = [0.010, 0.0025] }
work_piece = true
[fluid]
[[fluid.region]]
box = { min = [0.0, -0.001], max = [0.010, 0.001] }
[fluid.removal]
preston_coefficient = 1e-12
"""
RECESSION = """
[recession]
cycles = 200
cycle = 13.5
gap = 0.002
"""
SHORT = RECESSION.replace("200", "2")  # a single jump
TWO_WAY = 'way = "mirrored"\n'


class Recession(Study):
    def setUp(self):
        super().setUp()
        (self.case / "case.toml").write_text(CASE)

    def write(self, text, sets="fluid.opens = 6.75e-5"):
        super().write(text, HEAD + f"set = {{ {sets} }}\n")

    def shape(self):
        """(solution, wall) -> depths [m] in the order of the place."""
        with open(self.out / "recession.csv", newline="") as file:
            found = {}
            for row in csv.DictReader(file):
                found.setdefault((row["solution"], row["wall"]), []).append(float(row["depth[m]"]))
        return found

    def last(self):
        return [row for row in self.table() if row["machining_time[s]"]][-1]

    def test_two_ways_open_a_passage_evenly_and_it_goes_on_where_it_was_stopped(self):
        self.write(RECESSION + TWO_WAY)
        ended = self.done()
        exact = 1e-3 * (math.exp(6.75e-5 * 2700) - 1)
        self.assertEqual(len(self.starts()), 5, "solutions of the flow")
        row = self.last()
        self.assertEqual((row["solution"], row["cycles"]), ("2", "200"))
        self.assertAlmostEqual(float(row["depth_mean[m]"]) / exact, 1, delta=2e-3)
        self.assertAlmostEqual(float(row["taper"]), 0, delta=1e-6)
        self.assertAlmostEqual(float(row["removed_area[m2]"]) / (2e-2 * exact), 1, delta=2e-3)
        self.assertAlmostEqual(float(row["balance_error"]), 0, delta=1e-9)
        depths = self.shape()["2", "upper"]
        self.assertEqual(len(depths), 20)
        self.assertAlmostEqual(max(depths), min(depths), delta=1e-9)
        self.assertIn("200 cycles", ended.stdout)
        self.assertTrue((self.out / "charts/shape.png").is_file())
        started = self.starts()
        self.assertIn("5 of them done", self.done("--check").stdout)
        (self.out / "runs" / started[2] / "run.json").unlink()
        self.done()
        self.assertEqual(self.starts(), [*started, started[2]], "the others are kept")

    def test_one_way_opens_it_like_a_funnel(self):
        self.write(SHORT)
        self.done()
        row = self.last()
        self.assertAlmostEqual(float(row["taper"]), 2, delta=0.02)
        depths = self.shape()[row["solution"], "lower"]
        self.assertAlmostEqual(depths[0] / depths[19], 39, delta=0.5)

    def test_of_a_passage_with_its_image_the_first_half_counts(self):
        self.write(SHORT + 'way = "first_half"\n')
        self.done()
        depths = self.shape()["1", "lower"]
        self.assertEqual(depths, depths[::-1])
        self.assertGreater(depths[0], depths[9])

    def test_both_ways_run(self):
        self.write(SHORT + 'way = "both"\nreverse = { fluid.x = 2.0 }\n')
        self.done()
        self.assertIn("1 predicted, reversed", [row["solution"] for row in self.table()])

    def test_a_run_that_fails_ends_it_with_its_cause(self):
        self.write(RECESSION + TWO_WAY, "fluid.opens = 6.75e-5, fluid.sticks = 5e-5")
        ended = self.study()
        self.assertEqual(ended.returncode, 3)
        self.assertIn("the solution '1 predicted' failed: particle 7 left the domain", ended.stderr)
        self.assertTrue((self.out / "study.html").is_file())

    def test_a_flow_that_is_not_steady_runs_longer(self):
        self.write(SHORT + TWO_WAY, "fluid.opens = 6.75e-5, fluid.unsteady = 0.2")
        self.done()
        self.assertIn("0, 2 times as long", [row["solution"] for row in self.table()])

    def test_or_ends_the_study(self):
        self.write(SHORT + TWO_WAY + "steady_within = 1e-12\n", "fluid.opens = 6.75e-5, fluid.unsteady = 0.2")
        ended = self.study()
        self.assertEqual(ended.returncode, 3)
        self.assertIn("does not become steady", ended.stderr)

    def test_the_pressure_at_places_takes_the_place_of_what_was_found(self):
        # what is found is 1 MPa; 2 MPa at the first end and 1 at the other add k p v = 1e-12 * 1e6 * 1e-2 there
        self.write(RECESSION.replace("200", "1") + "pressure = [[0.0, 2e6], [0.01, 1e6]]\n", "fluid.opens = 1e-12")
        self.done()
        depths = self.shape()["1", "upper"]
        self.assertAlmostEqual(depths[0] / (1e-8 * 13.5 * 0.975), 1, delta=1e-4)
        self.assertAlmostEqual(depths[19] / (1e-8 * 13.5 * 0.025), 1, delta=1e-3)

    def test_a_calibration_tells_how_uncertain_the_shape_is(self):
        """A slip that opens the passage is uncertain by 10 %, k by 5 %, with a correlation of -0.5."""
        (self.case / "calibration.toml").write_text(
            "[fluid]\nopens = 6.75e-5\n[fluid.removal]\npreston_coefficient = 1e-12\n")
        (self.case / "calibration.csv").write_text(
            "parameter,unit,scale,proportional,keys,value,error,covariance with slip,covariance with k\n"
            "slip,,logarithm,,fluid.opens,6.75e-5,0.1,0.01,-0.0025\n"
            "k,1/Pa,logarithm,preston_depth,fluid.removal.preston_coefficient,1e-12,0.05,-0.0025,0.0025\n")
        self.write(RECESSION.replace("200", "100") + TWO_WAY + 'calibration = "calibration.toml"\ndensity = 8000.0\n', "fluid.y = 1")
        ended = self.done()
        row = next(row for row in self.table() if row["depth_mean_error[m]"])
        self.assertEqual((row["calibration"], row["cycles"]), ("fitted", "100"))

        def depth(opening):
            return 1e-3 * (math.exp(opening * 1350) - 1)

        by_slip = (depth(6.75e-5 * math.exp(0.1)) - depth(6.75e-5 * math.exp(-0.1))) / 2
        by_k = 0.05 * 1350 * 6.75e-5 * 1e-3 * math.exp(6.75e-5 * 1350)  # a longer time
        error = math.sqrt(by_slip**2 + by_k**2 - by_slip * by_k)
        self.assertAlmostEqual(float(row["depth_mean_error[m]"]) / error, 1, delta=5e-3)
        self.assertAlmostEqual(float(row["removed_area_error[m2]"]) / (2e-2 * error), 1, delta=5e-3)
        self.assertAlmostEqual(float(row["removed_mass[kg/m]"]) / (8000 * float(row["removed_area[m2]"])), 1, delta=1e-5)
        self.assertIn("one standard error by what the calibration leaves open", ended.stdout)
        with open(self.out / "recession.csv", newline="") as file:
            last = list(csv.DictReader(file))[-1]
        self.assertAlmostEqual(float(last["depth_error[m]"]) / error, 1, delta=0.01)
        self.assertFalse((self.out / "charts/shape_02.png").exists(), "its neighbours are no settings")
    def goals(self):
        with open(self.out / "goals.csv", newline="") as file:
            return {row["figure"]: float(row["cycles"] or "nan") for row in csv.DictReader(file)}

    def test_it_ends_at_a_goal_of_the_shape_and_counts_the_cycles(self):
        # w = 2 mm exp(6.75e-5 t): 2.2 mm after ln(1.1)/6.75e-5 s; Ra falls by exp(-depth/decay_depth)
        (self.case / "case.toml").write_text(CASE + "roughness = { initial = 2e-6, final = 5e-7, decay_depth = 1e-5 }\n")
        cycles = math.log(1.1) / 6.75e-5 / 13.5
        self.write(RECESSION + TWO_WAY + "until = { gap = 2.2e-3, depth_mean = 2e-4 }\n")
        ended = self.done()
        self.assertAlmostEqual(self.goals()["gap"] / cycles, 1, delta=2e-3)
        self.assertTrue(math.isnan(self.goals()["depth_mean"]))
        self.assertIn(f"The gap comes to 0.0022 m after {self.goals()['gap']:.4g} cycles.", ended.stdout)
        self.assertIn("The depth mean does not come to 0.0002 m: it is 0.0001 m in the end.", ended.stdout)
        row = self.last()
        self.assertAlmostEqual(float(row["gap[m]"]) / 2.2e-3, 1, delta=1e-6)
        self.assertAlmostEqual(float(row["roughness[m]"]) / (5e-7 + 1.5e-6 * math.exp(-10)), 1, delta=1e-4)
        self.assertTrue((self.out / "charts/roughness.png").is_file())
        self.write(RECESSION + TWO_WAY + f"until = {{ roughness = {5e-7 + 1.5e-6 * math.exp(-2)} }}\n")
        self.done()
        self.assertAlmostEqual(self.goals()["roughness"] / (math.log(1.02) / 6.75e-5 / 13.5), 1, delta=2e-3)

    def test_a_metric_of_the_flow_counts_them_too(self):
        # the made-up flow: speed = x, and it opens until x = 3 after the second jump
        program = (self.bin / "fluid_solver").read_text()
        (self.bin / "fluid_solver").write_text(program.replace("END = end or 3.0", """END = end or 3.0
opened = 2e-3 + 2 * worn[0][0][1] if worn[0] else 2e-3
values['fluid.x'] = (opened / 2e-3) ** 3"""))
        self.write(RECESSION + TWO_WAY + 'until = { speed = 1.5 }\n[[metric]]\nname = "speed"\n'
                   'series = "fluid.csv:speed[m/s]"\n', "fluid.opens = 6.75e-5, fluid.y = 0")
        self.done()
        self.assertAlmostEqual(self.goals()["speed"] / (math.log(1.5) / 3 / 6.75e-5 / 13.5), 1, delta=0.01)

    def test_a_piston_at_its_stop_ends_it(self):
        program = (self.bin / "fluid_solver").read_text()
        (self.bin / "fluid_solver").write_text(program.replace("END = end or 3.0", """END = end or 3.0
print("[warning] the wall 'piston' has come to the end of its travel, 0.01 m, at t = 2 s: its stop holds it")"""))
        self.write(SHORT + TWO_WAY)
        self.assertIn("in the solution '0' the wall 'piston' has come to the end of its travel, 0.01 m, at t = 2 s: its stop "
                      "holds it: nothing flows from then on", self.study().stderr)

    def test_it_runs_no_longer_than_the_case_can(self):
        program = (self.bin / "fluid_solver").read_text()
        (self.bin / "fluid_solver").write_text(program.replace('if "--check" in arguments:\n', """if (end or 0) > 7:
    print("case.toml: error: two pistons meet", file=sys.stderr)
    sys.exit(2)
if "--check" in arguments:\n"""))
        self.write(SHORT + TWO_WAY + "steady_within = 1e-12\n", "fluid.opens = 6.75e-5, fluid.unsteady = 0.2")
        self.assertIn("within 'shares' of 2 times the case's end time, and it cannot run longer: case.toml: error: two pistons "
                      "meet", self.study().stderr)

    def test_over_another_axis_a_line_each(self):
        self.write(SHORT + TWO_WAY + "[[axis]]\nname = 'speed'\nvalues = [1, 2]\nkeys = ['fluid.x']\n")
        self.done()
        self.assertEqual(len(self.starts()), 6)
        self.assertTrue((self.out / "charts/shape_02.png").is_file())


class Faults(Study):
    def test_all_are_told_with_their_line(self):
        (self.case / "case.toml").write_text(CASE)
        self.write('[recession]\ncycles = 0\ncycle = 1.0\njump = 2\nway = "to and fro"\npressure = [[1, 2], [0, 2]]\n'
                   'gapp = 1\n')
        ended = self.study("--check")
        self.assertEqual(ended.returncode, 2)
        for words in ("window.toml:5: error: 'cycles' must be above 0, found 0", "[recession] needs 'gap', a finite number",
                      "window.toml:7: error: 'jump' must be above 0 and at most 0.5, found 2",
                      "'way' must be one of 'one_way', 'first_half', 'mirrored', 'both', found 'to and fro'",
                      "the places ascending, found [[1, 2], [0, 2]]",
                      "unknown key 'gapp' in [recession]; did you mean 'gap'?"):
            self.assertIn(words, ended.stderr)

    def told(self, text=RECESSION, head=HEAD, case=CASE, *options):
        """What is said before any flow is computed."""
        (self.case / "case.toml").write_text(case)
        self.write(text, head)
        said = self.study(*options).stderr
        self.assertEqual(self.starts(), [])
        return said

    def test_worn_walls_are_refused_whoever_sets_them(self):
        words = "the case has walls that are 'worn'"
        self.assertIn(words, self.told(case=CASE.replace('name = "upper"', 'name = "upper"\nworn = [{}]')))
        self.assertIn(words, self.told(RECESSION, HEAD + 'set = { "wall.upper.worn" = [] }\n'))
        self.assertIn(words, self.told(RECESSION, HEAD, CASE, "--set", "wall.lower.worn=[]"))

    def test_work_pieces_are_boxes_that_say_where_they_are(self):
        words = "the work piece 'upper' is no box as it stands"
        upper = "box = { min = [0.0, 0.001], max = [0.010, 0.0025] }"
        self.assertIn(words, self.told(case=CASE.replace(upper, "circle = { centre = [0.005, 0.01], radius = 0.009 }")))
        self.assertIn(words, self.told(case=CASE.replace(upper, upper + "\ntranslate = [0.0, 0.001]")))

    def test_a_gap_that_is_no_passage_of_the_case(self):
        self.assertIn("window.toml:8: error: 'gap' is the narrowest passage at the start: it is 2 m here, and 0.002 m are "
                      "between 'lower' and 'upper'", self.told(RECESSION.replace("0.002", "2.0")))
        alone = CASE.replace("work_piece = true\n", "", 1).replace("[0.0, -0.0025]", "[0.02, -0.0025]").replace(
            "[0.010, -0.001]", "[0.03, -0.001]")
        self.assertIn("0.002 m are the width of the fluid", self.told(RECESSION.replace("0.002", "0.02"), case=alone))

    def test_rows_and_places_that_are_not_there(self):
        self.assertIn("window.toml:5: error: 'shares' holds fewer than three rows of surface.h5",
                      self.told(case=CASE.replace("series_interval = 0.01", "series_interval = 2.0")))
        self.assertIn("window.toml:9: error: 'pressure' has a row at 0.2 m, and no work piece lies there along x",
                      self.told(RECESSION + "pressure = [[0, 1e6], [0.2, 0]]\n"))
        self.assertIn("'pressure' needs a law of pressure times speed, and shear_depth is none", self.told(
            RECESSION + "pressure = [[0, 1e6], [0.01, 0]]\n", case=CASE.replace("preston", "shear")))

    def test_goals_that_cannot_be_reached(self):
        rough = CASE + "roughness = { initial = 2e-6, final = 5e-7, decay_depth = 1e-5 }\n"
        for goal, words in (("gap = 1e-3", "the gap grows: 'until' must name more than 'gap', 0.002 m, found 0.001"),
                            ("roughness = 1e-6", "'until' names a roughness, and the case has no [fluid.removal.roughness]")):
            self.assertIn(f"window.toml:9: error: {words}", self.told(RECESSION + f"until = {{ {goal} }}\n"))
        self.assertIn("the roughness falls from 2e-06 towards 5e-07 m: 'until' must name one in between, found 4e-07",
                      self.told(RECESSION + "until = { roughness = 4e-7 }\n", case=rough))
        said = self.told(RECESSION + "until = { gapp = 1, depth_mean = -1 }\n")
        self.assertIn("'until' names no figure 'gapp'; did you mean 'gap'?", said)
        self.assertIn("'depth_mean' of 'until' must be a number above 0, found -1", said)

    def test_a_case_from_which_nothing_comes_off_is_refused(self):
        (self.case / "case.toml").write_text(CASE)
        self.write(RECESSION, HEAD + "set = { fluid.removal = false }\n")
        self.assertIn("nothing comes off: the case needs [fluid.removal]", self.study("--check").stderr)
        (self.case / "case.toml").write_text(CASE[:CASE.index("[fluid.removal]")])
        self.write(RECESSION)
        self.assertIn("nothing comes off: the case needs [fluid.removal]", self.study("--check").stderr)
        self.write(RECESSION, HEAD + "set = { fluid.removal.preston_coefficient = 1e-12 }\n")
        self.assertNotIn("nothing comes off", self.study("--check").stderr)

    def test_a_pressure_below_0_is_refused(self):
        (self.case / "case.toml").write_text(CASE)
        self.write(RECESSION + "pressure = [[0, 1e6], [0.02, -5]]\n")
        self.assertIn("must be at least 0, found -5", self.study("--check").stderr)

    def test_a_target_does_not_go_with_a_calibration(self):
        (self.case / "case.toml").write_text(CASE)
        for name in ("calibration.toml", "calibration.csv"):
            (self.case / name).write_bytes((CASES / "abrasive_coupon" / name).read_bytes())
        self.write(RECESSION + 'until = { depth_mean = 1e-4 }\ncalibration = "calibration.toml"\n')
        self.assertIn("it does not go with 'until'", self.study("--check").stderr)

    def test_reverse_goes_with_both_ways(self):
        (self.case / "case.toml").write_text(CASE)
        self.write(RECESSION + 'way = "both"\n')
        self.assertIn("'reverse', what turns the flow in the case, goes with way = \"both\"", self.study("--check").stderr)


if __name__ == "__main__":
    unittest.main()
