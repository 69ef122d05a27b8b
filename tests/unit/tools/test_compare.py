"""Two runs laid over each other: figures worked by hand, what is told, what cannot be compared."""

import csv
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from toryu.compare import runs

CASE = """[fluid]
spacing = {spacing}
[[fluid.observer]]
name = "gauge"
[[wall]]
name = "floor"
[wall.box]
max = [1.0, 0.0]
"""


class Compared(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        # at the times of both: 0 and 0.5 against 0 and 1, 1 and 2 against 1.5 and 2
        self.first = self.run_of("coarse", 0.1, "time[s],gauge_level[m],energy[J/m],same[1],old[1]\n"
                                 "0,0,1,5,1\n1,1,-4,5,1\n2,2,2,5,1\n")
        self.second = self.run_of("fine", 0.05, "time[s],gauge_level[m],energy[J/m],same[1],new[1]\n"
                                  "0,0,1,5,1\n1,1.5,-4,5,1\n2,2,-2,5,1\n")

    def run_of(self, name, spacing, series):
        out = self.folder / name
        out.mkdir()
        (out / "fluid.csv").write_text(series)
        (out / "used_case.toml").write_text(CASE.format(spacing=spacing))
        return out

    def command(self, *arguments):
        return subprocess.run([sys.executable, "-m", "toryu.launch", "--compare", *map(str, arguments)], text=True,
                              capture_output=True, timeout=60, cwd=self.folder)

    def test_figures_are_those_by_hand(self):
        found = runs.compare(self.first, self.second)
        gauge, energy = found.columns  # of observers first, though the energy is farther apart
        self.assertEqual((gauge.name, gauge.peaks, gauge.change), ("gauge_level[m]", [2, 2], 0))
        self.assertEqual((gauge.apart_at, energy.apart_at), (1, 2))
        self.assertAlmostEqual(gauge.distance, math.sqrt(0.5**2 / 3) / 2)
        self.assertEqual((energy.name, energy.peaks), ("energy[J/m]", [-4, -4]))
        self.assertAlmostEqual(energy.distance, math.sqrt(4**2 / 3) / 4)
        self.assertEqual(found.alike, 1)
        self.assertEqual(found.alone, ["fluid.csv:new[1]", "fluid.csv:old[1]"])
        self.assertEqual(found.settings, [("fluid.spacing", "0.1", "0.05")])

    def test_only_times_that_both_reached_count(self):
        (self.second / "fluid.csv").write_text("time[s],gauge_level[m]\n0.5,0.5\n1.5,3\n")
        (gauge,) = runs.compare(self.first, self.second).columns
        self.assertEqual(gauge.times, [[1], [0.5, 1.5]])
        self.assertAlmostEqual(gauge.distance, 0.75)  # 1.75 in between against 1
        self.assertAlmostEqual(gauge.change, 2)

    def test_without_a_number_at_the_times_of_both_nothing_is_the_same(self):
        (self.second / "fluid.csv").write_text("time[s],gauge_level[m],energy[J/m]\n0,nan,nan\n1,inf,nan\n")
        found = runs.compare(self.first, self.second)
        self.assertEqual((found.columns, found.alike), ([], 0))
        self.assertEqual(found.apart, ["fluid.csv:energy[J/m]", "fluid.csv:gauge_level[m]"])
        said = self.command(self.first, self.second).stdout
        self.assertIn("without a number at the times that both reached: fluid.csv:energy[J/m], fluid.csv:gauge_level[m]\n"
                      "in one run alone: fluid.csv:old[1], fluid.csv:same[1]\nno column that can be compared differs; 0 the same in both\n", said)

    def test_a_line_sampled_at_other_times_is_no_distance(self):
        (self.first / "fluid.csv").write_text("time[s],g[1],h[1]\n0.5,0.5,nan\n1.5,1.5,1\n2.5,2.5,1\n")
        (self.second / "fluid.csv").write_text("time[s],g[1],h[1]\n0,0,1\n1,1,1\n2,2,1\n3,3,-1e308\n")
        for pair in ((self.first, self.second), (self.second, self.first)):
            g = next(column for column in runs.compare(*pair).columns if column.name == "g[1]")
            self.assertAlmostEqual(g.distance, 0)

    def test_large_numbers_and_what_is_no_number(self):
        (self.first / "fluid.csv").write_text("time[s],g[1],h[1]\n0,1,nan\n1,2,1\n")
        (self.second / "fluid.csv").write_text("time[s],g[1],h[1]\n0,1e200,nan\n1,-1e300,1\n")
        found = runs.compare(self.first, self.second)
        self.assertEqual((len(found.columns), found.alike), (1, 1))
        self.assertAlmostEqual(found.columns[0].distance / (1e300 / math.sqrt(2) / 2), 1)

    def test_what_another_wrote_stays(self):
        out = self.folder / "study"
        (out / "charts").mkdir(parents=True)
        (out / "charts/chart_07.svg").write_text("of a study")
        for folder in (out, self.first):
            ended = self.command(self.first, self.second, "--out", folder)
            self.assertEqual((ended.returncode, ended.stderr), (2, f"{folder}: error: holds something else than a comparison; "
                                                                   "give --out another folder\n"))
        self.assertEqual((out / "charts/chart_07.svg").read_text(), "of a study")
        for _ in range(2):  # its own it writes anew
            self.assertEqual(self.command(self.first, self.second).returncode, 0)

    def test_one_that_was_ended_is_made_anew(self):
        out = self.folder / "ended"
        for left in ([], ["table.csv.part"], ["table.csv", "charts/chart_01.svg", "compare.html.part"]):
            shutil.rmtree(out, ignore_errors=True)
            (out / "charts").mkdir(parents=True)
            for name in left:
                (out / name).touch()
            self.assertEqual(self.command(self.first, self.second, "--out", out).returncode, 0, left)

    def test_settings_go_by_the_names_of_sections(self):
        used = self.second / "used_case.toml"
        used.write_text(used.read_text().replace("max = [1.0, 0.0]", "max = [2.0, 0.0]").replace("0.05", "0.1"))
        self.assertEqual(runs.compare(self.first, self.second).settings, [("wall.floor.box.max", "[1.0, 0.0]", "[2.0, 0.0]")])

    def settings(self, *cases):
        for out, text in zip((self.first, self.second), cases):
            (out / "used_case.toml").write_text(text)
        return runs.compare(self.first, self.second).settings

    def test_of_sections_of_one_name_each_is_told(self):
        walls = '[[wall]]\nname = "side"\nlow = {}\n[[wall]]\nname = "floor"\n[[wall]]\nname = "side"\nlow = {}\n'
        self.assertEqual(self.settings(walls.format(1, 2), walls.format(3, 2)), [("wall.side (1).low", "1", "3")])
        self.assertEqual(self.settings(walls.format(1, 2), walls.format(1, 5)), [("wall.side (2).low", "2", "5")])
        self.assertEqual(self.settings("[[load]]\nx = 1\n[[load]]\nx = 2\n", "[[load]]\nx = 1\n[[load]]\nx = 3\n"),
                         [("load.2.x", "2", "3")])

    def test_empty_tables_are_told(self):
        self.assertEqual(self.settings("[solid]\na = 1\nhourglass = {}\n", "[solid]\na = 1\n"),
                         [("solid.hourglass", "present, empty", "-")])
        self.assertEqual(self.settings("[a]\n[solid]\n", "[a]\n"), [("solid", "present, empty", "-")])
        self.assertEqual(self.settings("a = 1\n[[wall]]\n", "a = 1\n"), [("wall.1", "present, empty", "-")])
        self.assertEqual(self.settings("[solid]\nhourglass = {}\n", "[solid]\nhourglass = { share = 1 }\n"),
                         [("solid.hourglass.share", "-", "1")])

    def test_a_damaged_case_leaves_the_series(self):
        (self.second / "used_case.toml").write_bytes(b"\xff[")
        found = runs.compare(self.first, self.second)
        self.assertEqual((len(found.columns), found.settings), (2, []))
        self.assertRegex(found.faults[0], f"^{self.second}: used_case.toml cannot be read: ")
        for text in ("fluid = 3\n", "[fluid]\nobserver = 3\n", "[[fluid.observer]]\nname = 3\n[[fluid.observer]]\n"):
            (self.second / "used_case.toml").write_text(text)
            self.assertEqual(len(runs.compare(self.first, self.second).columns), 2, text)

    def test_tells_and_leaves_table_charts_and_page(self):
        ended = self.command(self.first, self.second)
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
        self.assertIn("fluid.spacing: 0.1 | 0.05\n", ended.stdout)
        self.assertRegex(ended.stdout, r"fluid.csv:gauge_level\[m\] +2 +2 +0.00 % +14.43 %\n")
        out = self.folder / "out/coarse_against_fine"
        with open(out / "table.csv", newline="") as file:
            rows = list(csv.reader(file))
        self.assertEqual(rows[1][:3], ["fluid.csv:gauge_level[m]", "2", "2"])
        page = (out / "compare.html").read_text()
        self.assertEqual(page.count("<svg"), 2)
        self.assertIn("fluid.csv:new[1]", page)
        self.assertTrue((out / "charts/chart_02.png").is_file())

    def test_a_damaged_series_beside_a_sound_one_is_told(self):
        (self.second / "solid.csv").write_text("")
        ended = self.command(self.first, self.second)
        said = f"{self.second}: solid.csv is empty"
        self.assertEqual((ended.returncode, ended.stderr), (0, f"warning: {said}: left out\n"))
        self.assertIn(said, (self.folder / "out/coarse_against_fine/compare.html").read_text())
        (self.second / "fluid.csv").write_text("time[s],x[m]\n")
        ended = self.command(self.first, self.second)
        self.assertEqual((ended.returncode, ended.stderr), (2, f"{self.second}: error: holds no series that is whole: "
                                                               "fluid.csv holds no row; solid.csv is empty\n"))

    def test_names_cannot_steer_the_terminal(self):
        bad = self.first.rename(self.folder / "a\x1b[31m\nb")
        (bad / "fluid.csv").write_text((bad / "fluid.csv").read_text().replace("gauge", "g\x1b[2Ja").replace("old", "o\x9bd"))
        (self.second / "fluid.csv").write_text((self.second / "fluid.csv").read_text().replace("gauge", "g\x1b[2Ja"))
        (bad / "used_case.toml").write_text('[fluid]\n"k\\u001b" = "v\\u0007\\n"\n')
        (bad / "solid.csv").write_text("")
        ended = self.command(bad, self.second)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        for shown in ("fluid.k\\x1b: v\\x07\\n | -", "fluid.csv:g\\x1b[2Ja_level[m]", "o\\x9bd[1]",
                      "out/a\\x1b[31m\\nb_against_fine/table.csv"):
            self.assertIn(shown, ended.stdout)
        self.assertIn("a\\x1b[31m\\nb: solid.csv is empty", ended.stderr)
        self.assertIn("b\\x1b: error: is no folder", self.command(bad, "b\x1b").stderr)
        for text in (ended.stdout, ended.stderr):
            self.assertTrue(text.replace("\n", "").isprintable(), text)

    def test_a_folder_that_cannot_be_made_is_named_as_it_was_given(self):
        (self.folder / "file").write_text("a")
        for out in ("file/x", "file"):
            ended = self.command(self.first, self.second, "--out", out)
            self.assertEqual((ended.returncode, ended.stderr),
                             (2, f"{out}: error: no comparison can be written there: file is no folder\n"))

    def test_an_empty_name_is_no_folder(self):
        for arguments in ((self.first, self.second, "--out", ""), ("", self.second)):
            ended = self.command(*arguments)
            self.assertEqual(ended.returncode, 2)
            self.assertRegex(ended.stderr, r"argument (--out|OUT_A): has an empty name; '.' is the current folder\n$")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["coarse", "fine"])

    def test_two_runs_that_are_the_same_are_said_to_be(self):
        (self.second / "fluid.csv").write_bytes((self.first / "fluid.csv").read_bytes())
        self.assertIn("no column that can be compared differs; 4 the same in both\n", self.command(self.first, self.second).stdout)

    def test_what_cannot_be_compared(self):
        empty = self.folder / "empty"
        empty.mkdir()
        for arguments, fault in (((self.first, self.folder / "absent"), "is no folder of results"),
                                 ((empty, self.second), "holds no series"),
                                 ((self.first, self.folder / "coarse/../coarse"), "is the same run as")):
            with self.subTest(fault):
                ended = self.command(*arguments)
                self.assertEqual(ended.returncode, 2)
                self.assertRegex(ended.stderr, f"^{arguments[1] if 'same' in fault else ''}.*: error: {fault}")
                self.assertEqual(ended.stderr.count("\n"), 1)
        self.assertEqual(self.command(self.first).returncode, 2)


if __name__ == "__main__":
    unittest.main()
