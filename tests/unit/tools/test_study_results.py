"""What a study leaves: figures, charts, the page, the answer of abrasive removal."""

import math
import pathlib
import re
import unittest

from toryu_testing.study_case import TWO_AXES, Study


class Results(Study):
    METRICS = """
[[metric]]
name = "end"
series = "fluid.csv:speed[m/s]"
[[metric]]
name = "middle"
series = "fluid.csv:speed[m/s]"
take = "mean"
shares = [0.25, 0.75]
scale = 1000
unit = "mm/s"
[[metric]]
name = "speed"
summary = "fluid.figures.largest_speed"
[[metric]]
name = "absent"
series = "fluid.csv:pressure[Pa]"
[[metric]]
name = "busy"
run = "processor_time"
"""

    def test_metrics(self):
        self.write(TWO_AXES + self.METRICS)
        ended = self.done()
        fault = "fluid.csv has no column 'pressure[Pa]'"
        self.assertIn(f"no run gives 'absent': {fault}\n", ended.stdout)
        told = [line for line in ended.stderr.splitlines() if line.startswith("warning:")]
        self.assertEqual(len(told), 1)  # as soon as a run shows it, and once
        self.assertRegex(told[0], f"^warning: metric 'absent': in .*/runs/.* {re.escape(fault)}$")
        row = self.table()[2]  # x = 2, y = 4: speed = 2 + 4 t up to 3 s
        self.assertEqual([row[name] for name in ("end[m/s]", "middle[mm/s]", "speed", "absent[Pa]", "busy[s]")],
                         ["14", "8000", "6", "", "0.25"])
        self.assertEqual([row[name] for name in ("wall_time[s]", "processor_time[s]", "simulated_time[s]", "steps")],
                         ["0.5", "0.25", "3", "300"])

    def test_charts_are_pictures_and_part_of_the_page(self):
        self.write(TWO_AXES + self.METRICS + """
[[chart]]
title = "Speed at the end"
x = "x"
y = "end"
lines = "wait"
log = ["x"]
[[chart]]
x = "x"
y = "wait"
colour = "middle"
[[chart]]
x = "x"
y = "end"
panels = "wait"
[[chart]]
x = "end"
y = "middle"
lines = "wait"
""")
        self.done()
        page = (self.out / "study.html").read_text()
        self.assertEqual(page.count("<svg"), 4)
        for k in range(1, 5):
            self.assertEqual((self.out / f"charts/chart_{k:02}.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
            self.assertIn("<svg", (self.out / f"charts/chart_{k:02}.svg").read_text())
        for text in ("A made-up study &amp; more", "Speed at the end", "a made-up processor", "commit 0123456789ab",
                     "var(--c0)", "All runs done"):
            self.assertTrue(text in page, text)
        self.assertNotIn("http://", page.replace("http://www.w3.org", ""))

    def test_removal_answers_the_question(self):
        # 1, 2 and 4 um a cycle of 1 s (2 s times 0.5); the first takes twice that; corners lose twice as much.
        self.write("""
[removal]
pistons = ["piston"]
piston_area = 0.5
cycle = 2.0
answer = { wanted_depth = 20e-6, evenness_at_most = 2, pressure_at_most = 2000, first = "time" }
[[axis]]
name = "depth"
values = [1e-6, 2e-6, 4e-6]
keys = ["fluid.removes", "fluid.x"]
[[axis.derived]]
keys = ["fluid.x"]
scale = 1e6
""".replace('keys = ["fluid.removes", "fluid.x"]', 'keys = ["fluid.removes"]'))
        ended = self.done()
        rows = self.table()
        # Of 30 points on each piece 2 are corners with a diagonal face, sqrt(2) as large.
        share = (28 + 2 * 2 * 2 ** 0.5) / (28 + 2 * 2 ** 0.5)
        for row, depth in zip(rows, (1e-6, 2e-6, 4e-6)):
            self.assertAlmostEqual(float(row["removed_per_cycle[m]"]), depth * share, delta=1e-4 * depth)
            self.assertAlmostEqual(float(row["evenness"]), 2 / share, places=4)
            # 300 x per second until 1.5 s, over 0.5 m2/m
            self.assertAlmostEqual(float(row["piston_pressure[Pa]"]), 900 * depth * 1e6, delta=1e-2)
        self.assertEqual([row["cycles_needed"] for row in rows], ["18", "9", "4"])
        self.assertEqual([row["time_needed[s]"] for row in rows], ["18", "9", "4"])
        # After 4 cycles 5 * 4 um are off, twice that at the corners.
        decayed = (28 * math.exp(-2) + 2 * 2 ** 0.5 * math.exp(-4)) / (28 + 2 * 2 ** 0.5)
        self.assertAlmostEqual(float(rows[2]["roughness_then[m]"]), 5e-7 + 1.5e-6 * decayed, delta=1e-12)
        self.assertIn("20 µm come off fastest with depth 2e-06: 9 cycles in 9 s, the largest depth 1.83 times the mean, "
                      "1.8 kPa at the piston. 2 of 3 settings keep an evenness of at most 2 and at most 2 kPa at the "
                      "piston.", ended.stdout)
        path = self.case / "window.toml"
        path.write_text(path.read_text().replace("evenness_at_most = 2", "evenness_at_most = 1.5"))
        self.assertIn("None of the 3 settings removes 20 µm with an evenness of at most 1.5 and at most 2 kPa at the "
                      "piston. Nearest: depth ", self.done().stdout)
        page = (self.out / "study.html").read_text()
        self.assertIn("Removed depth along the work pieces", page)
        self.assertEqual(page.count(f'id="run-{pathlib.Path(rows[0]["run"]).name}"'), 3)  # two pieces and the window
        path.write_text(path.read_text().replace("wanted_depth = 20e-6", "wanted_depth = 20"))
        self.assertIn("No setting removes 20 m within 1,000,000 cycles.", self.done().stdout)


if __name__ == "__main__":
    unittest.main()
