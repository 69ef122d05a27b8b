"""Reading results back, and the figures taken from them."""

import math
import os
import pathlib
import tempfile
import unittest

from toryu import PROGRAMS, results, summary_text
from toryu.case import resolve
from toryu_testing import made_up_run



class Figures(unittest.TestCase):
    def test_the_distance_is_taken_at_the_reference_within_the_run(self):
        # Differences 0.1 and 0.3 at t = 1 and 2; t = 0 and t = 3 (beyond the run) do not count.
        reference = [(0.0, 5.0), (1.0, 1.1), (2.0, -1.7), (3.0, 9.0)]
        share = results.rms_share(reference, [0.0, 2.0], [0.0, -2.0 + 0.0])
        self.assertAlmostEqual(share, math.sqrt(((-1.0 - 1.1) ** 2 + (-2.0 + 1.7) ** 2) / 2) / 9.0, places=14)

    def test_without_a_common_time_there_is_no_distance(self):
        self.assertTrue(math.isnan(results.rms_share([(1.0, 2.0)], [0.0, 0.5], [0.0, 0.0])))
        self.assertTrue(math.isnan(results.rms_share([(1.0, 2.0)], [], [])))

    def test_the_peak_is_the_largest_magnitude(self):
        self.assertEqual(results.peak([0.0, 0.1, 0.2, 0.3], [0.0, 1.0, -3.0, math.nan]), (0.2, -3.0))

    def test_interpolation(self):
        for time, value in ((-1, 2), (0, 2), (0.25, 3), (0.5, 4), (1.5, 6), (9, 8)):
            self.assertEqual(results.interpolate(time, [0.0, 0.5, 2.5], [2.0, 4.0, 8.0]), value)


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.case, self.out = pathlib.Path(folder.name) / "gate", pathlib.Path(folder.name) / "out"
        made_up_run.make_case(self.case)
        self.out.mkdir()
        self.references = resolve(self.case, PROGRAMS / "coupler").references

    def test_comments_and_half_rows_are_left_out(self):
        path = self.out / "a.csv"
        path.write_text("# source: x\nt_s, x_m\n0,1\n# aside\n1,\n2,3\n4")
        columns = results.read_columns(path)
        self.assertEqual(columns["t_s"], [0, 1, 2])
        self.assertEqual([columns["x_m"][0], columns["x_m"][2]], [1, 3])
        self.assertTrue(math.isnan(columns["x_m"][1]))

    def test_a_series_without_its_final_name_is_found(self):
        (self.out / "solid.csv.part").write_text("time[s],a[m]\n0,1\n")
        self.assertEqual(results.read_series(self.out, "solid"), {"time[s]": [0], "a[m]": [1]})
        self.assertEqual(results.read_series(self.out, "fluid"), {})

    def test_what_a_run_that_went_on_and_was_killed_left_counts(self):
        for name, age in (("solid.csv", 60), ("solid.csv.part", 10)):
            (self.out / name).write_text(f"time[s]\n{age}\n")
            os.utime(self.out / name, (1e9 - age, 1e9 - age))
        self.assertEqual(results.read_series(self.out, "solid"), {"time[s]": [10]})
        os.utime(self.out / "solid.csv", (1e9, 1e9))
        self.assertEqual(results.read_series(self.out, "solid"), {"time[s]": [60]})

    def test_the_summary_of_a_run(self):
        made_up_run.make_results(self.out, frames=2)
        text = summary_text.of_run(self.references, self.out)
        self.assertIn("peak tip displacement x", text)
        self.assertIn("40 mm at 0.15 s", text)
        # The reference is 1.1 times the plate's path: the rms of 0.1/1.1 path, as a share of its largest sample.
        path = [made_up_run.tip(0.04 * k)[0] for k in range(1, 11)]
        measured_peak = max(made_up_run.tip(0.04 * k)[0] for k in range(13))
        share = math.sqrt(sum((0.1 * x) ** 2 for x in path) / 10) / (1.1 * measured_peak)
        self.assertIn(f"{100 * share:.1f} % of the peak of 'Somebody 2007'", text)
        self.assertIn("61.5 s, 23 % of it waiting", text)
        self.assertNotIn("WARNING", text)

    def test_the_summary_warns_of_a_solid_that_has_torn(self):
        made_up_run.make_results(self.out, frames=2)
        summary = self.out / "solid_summary.toml"
        summary.write_text(summary.read_text().replace(
            "[figures]\n", '[figures]\n"torn_bonds" = 16.0\n"clumped_bonds" = 0.0\n'))
        text = summary_text.of_run(self.references, self.out)
        self.assertRegex(text, r"WARNING +the solid has torn: up to 16 pairs of adjacent particles; see log.txt")
        self.assertNotIn("clumped", text)

    def test_a_run_that_left_nothing_has_an_empty_summary(self):
        self.assertEqual(summary_text.of_run(self.references, self.out), "")


if __name__ == "__main__":
    unittest.main()
