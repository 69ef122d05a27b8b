"""Studies with a stand-in for the program: what runs, what is kept, how it ends, what it leaves."""

import csv
import json
import math
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

HERE = pathlib.Path(__file__).resolve().parent
TOOLS = HERE.parents[2] / "tools"
HEAD = '[study]\ntitle = "A made-up study & more"\ncase = "case.toml"\n'
TWO_AXES = """
[[axis]]
name = "x"
unit = "m/s"
values = [1, 2, 4]
keys = ["fluid.x"]
[[axis.derived]]
keys = ["fluid.y"]
scale = 8
power = -1

[[axis]]
name = "wait"
values = [0.0, 0.001]
keys = ["fluid.seconds"]
"""


class Study(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.bin, self.case, self.out = (self.folder / name for name in ("bin", "flow", "out"))
        for path in (self.bin, self.case):
            path.mkdir()
        shutil.copy(HERE / "fake_study_solver.py", self.bin / "fluid_solver")
        (self.bin / "fluid_solver").chmod(0o755)
        (self.bin / "modules").mkdir()
        shutil.copy(HERE / "made_up_surface.py", self.bin / "modules")
        (self.case / "case.toml").write_text('[case]\ntitle = "test"\n[[wall]]\nname = "piston"\n[fluid]\n')

    def write(self, text, head=HEAD):
        (self.case / "window.toml").write_text(head + text)

    def command(self, *options):
        return [sys.executable, str(TOOLS / "launch.py"), str(self.case / "window.toml"), "--bin", str(self.bin), "--out",
                str(self.out), *options]

    def study(self, *options):
        return subprocess.run(self.command(*options), capture_output=True, text=True, timeout=120, cwd=self.folder)

    def done(self, *options):
        ended = self.study(*options)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        return ended

    def starts(self):
        path = self.bin / "starts.txt"
        return path.read_text().split() if path.exists() else []

    def table(self):
        with open(self.out / "table.csv", newline="") as file:
            return list(csv.DictReader(file))

    def wait_for(self, condition):
        end = time.monotonic() + 60
        while not condition():
            self.assertLess(time.monotonic(), end, "waited in vain")
            time.sleep(0.01)


class Runs(Study):
    def test_every_combination_runs_once_with_its_keys(self):
        self.write(TWO_AXES)
        self.done()
        self.assertEqual(len(self.starts()), 6)
        rows = self.table()
        self.assertEqual([(r["x[m/s]"], r["wait"]) for r in rows],
                         [("1", "0"), ("1", "0.001"), ("2", "0"), ("2", "0.001"), ("4", "0"), ("4", "0.001")])
        record = json.loads((self.out / rows[2]["run"] / "run.json").read_text())
        self.assertEqual(record["set"], {"case.frame_interval": "0", "fluid.x": "2", "fluid.y": "4.0",
                                         "fluid.seconds": "0.0"})

    def test_a_second_time_nothing_runs(self):
        self.write(TWO_AXES)
        self.done()
        ended = self.done()
        self.assertEqual(len(self.starts()), 6)
        self.assertIn("6 were done before", ended.stdout)

    def test_a_change_runs_what_it_touches(self):
        self.write(TWO_AXES)
        self.done()
        self.write(TWO_AXES.replace("[1, 2, 4]", "[1, 2, 5]"))
        self.done()
        self.assertEqual(len(self.starts()), 8)
        (self.case / "case.toml").write_text('# the same\n[case]\ntitle = "test"\n[[wall]]\nname = "piston"\n[fluid]\n')
        self.done()
        self.assertEqual(len(self.starts()), 8)
        (self.case / "case.toml").write_text('[case]\ntitle = "another"\n[[wall]]\nname = "piston"\n[fluid]\n')
        self.done()
        self.assertEqual(len(self.starts()), 14)
        with open(self.bin / "fluid_solver", "a") as program:
            program.write("# another program\n")
        self.done()
        self.assertEqual(len(self.starts()), 20)

    def test_choices_are_named_settings(self):
        self.write("""
[[axis]]
name = "model"
[[axis.choice]]
name = "as shipped"
[[axis.choice]]
name = "faster"
set = { fluid.x = 3, "fluid.y" = 0 }
[[metric]]
name = "end"
series = "fluid.csv:speed[m/s]"
[[chart]]
x = "model"
y = "end"
""")
        self.done("--set", "fluid.seconds=0.001")
        rows = self.table()
        self.assertEqual([r["model"] for r in rows], ["as shipped", "faster"])
        for name in ("as shipped", "faster"):  # beside its bar
            self.assertIn(f">{name}</text>", (self.out / "charts/chart_01.svg").read_text())
        record = json.loads((self.out / rows[1]["run"] / "run.json").read_text())
        self.assertEqual(record["set"], {"case.frame_interval": "0", "fluid.x": "3", "fluid.y": "0",
                                         "fluid.seconds": "0.001"})

    def test_no_more_run_at_a_time_than_allowed(self):
        self.write(TWO_AXES + '[[metric]]\nname = "end"\nseries = "fluid.csv:speed[m/s]"\n')
        started = time.monotonic()
        self.done("--set", "fluid.seconds=0.3", "--jobs", "1")
        self.assertGreater(time.monotonic() - started, 6 * 0.3)
        self.assertEqual({json.loads(p.read_text())["jobs"] for p in self.out.glob("runs/*/run.json")}, {1})

    def test_progress_counts_the_runs(self):
        self.write(TWO_AXES)
        words = self.done("--jobs", "2").stderr
        self.assertIn("6 runs; 2 at a time", words)
        self.assertRegex(words, r"6 of 6 runs done, 0 running, 0 s left")


class Stopped(Study):
    SLOW = '[[axis]]\nname = "x"\nvalues = [1, 2, 3, 4, 5, 6]\nkeys = ["fluid.x"]\n'

    def start(self, *options):
        return subprocess.Popen(self.command("--jobs", "2", "--set", "fluid.seconds=0.5", *options), text=True,
                                stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, cwd=self.folder)

    def records(self):
        return {p.parent.name for p in self.out.glob("runs/*/run.json")}

    def assert_that_it_goes_on(self, kept, started):
        """The same command repeats nothing that was done, and starts half-done runs afresh."""
        for path in self.out.glob("runs/*"):
            (path / "half.txt").touch()
        self.done("--jobs", "2", "--set", "fluid.seconds=0.5")
        again = self.starts()[started:]
        self.assertEqual(len(self.table()), 6)
        self.assertEqual(len(again), 6 - len(kept))
        self.assertEqual(kept & set(again), set())

    def stop(self, number):
        self.write(self.SLOW)
        process = self.start()
        self.wait_for(lambda: len(self.records()) >= 2 and len(self.starts()) > len(self.records()))
        process.send_signal(number)
        _, words = process.communicate(timeout=60)
        return process.returncode, words

    def test_interrupted_it_ends_its_runs_and_goes_on_later(self):
        code, words = self.stop(signal.SIGINT)
        kept, started = self.records(), len(self.starts())
        self.assertEqual(code, 130)
        self.assertIn(f"interrupted; {len(kept)} of 6 runs are done and kept: the same command goes on", words)
        self.assertGreater(started, len(kept))  # some were half done
        self.assert_that_it_goes_on(kept, started)

    def test_killed_it_leaves_no_process_and_goes_on_later(self):
        code, _ = self.stop(signal.SIGKILL)
        kept, started = self.records(), len(self.starts())
        self.assertEqual(code, -signal.SIGKILL)
        self.assert_that_it_goes_on(kept, started)
        self.assertEqual(self.processes_of_this_test(), [])

    def processes_of_this_test(self):
        found = []
        for path in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
            try:
                if str(self.folder).encode() in path.read_bytes():
                    found.append(path)
            except OSError:
                pass  # it ended just now
        return found

    def test_the_same_study_is_not_run_twice_at_once(self):
        self.write(self.SLOW)
        first = self.start()
        self.wait_for(self.starts)
        second = self.study()
        self.assertEqual((second.returncode, second.stderr), (
            2, f"{self.out}: error: this study is being run already; wait for it or give --out another folder\n"))
        first.send_signal(signal.SIGINT)
        first.communicate(timeout=60)

    def test_failed_physics_is_a_result(self):
        self.write('[[axis]]\nname = "fails"\nvalues = [0, 3]\nkeys = ["fluid.fails"]\n')
        ended = self.done()
        self.assertIn("2 runs, 1 of them ended by their physics", ended.stdout)
        good, bad = self.table()
        self.assertEqual((good["exit_code"], good["cause"]), ("0", ""))
        self.assertEqual((bad["exit_code"], bad["cause"]), ("3", "particle 7 left the domain"))
        self.assertIn("particle 7 left the domain", (self.out / "study.html").read_text())
        self.done()
        self.assertEqual(len(self.starts()), 2)

    def test_any_other_failure_stops_the_study(self):
        for code in (1, 4):
            with self.subTest(code):
                self.write(f'[[axis]]\nname = "fails"\nvalues = [{code}, 0]\nkeys = ["fluid.fails"]\n')
                ended = self.study("--jobs", "1")
                self.assertEqual(ended.returncode, code)
                self.assertIn("fluid_solver: error: particle 7 left the domain", ended.stderr)
                self.assertIn(f"the run with fails {code} ended with exit code {code}: the study stops", ended.stderr)
                self.assertFalse((self.out / "table.csv").exists())
                self.assertEqual(self.records(), set())
                shutil.rmtree(self.out)


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
        self.assertIn("no run gives 'absent'\n", self.done().stdout)
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


class BadInput(Study):
    def faults(self, text, head=HEAD):
        self.write(text, head)
        ended = self.study()
        self.assertEqual(ended.returncode, 2, ended.stderr)
        self.assertEqual(self.starts(), [])
        return ended.stderr.replace(str(self.case) + "/", "").splitlines()

    def test_all_faults_of_the_file_at_once_with_their_lines(self):
        self.assertEqual(self.faults("""keep_frame = true
[[axis]]
name = "x"
values = [1, 2]
key = ["fluid.x"]
[[metric]]
name = "end"
series = "fluid.csv:speed[m/s]"
take = "larges"
[[chart]]
x = "x"
y = "and"
log = ["z"]
"""), [
            "window.toml:4: error: unknown key 'keep_frame' in [study]; did you mean 'keep_frames'?",
            "window.toml:5: error: [[axis]] 1 needs 'keys', the keys of the case that take its values",
            "window.toml:8: error: unknown key 'key' in [[axis]] 1; did you mean 'keys'?",
            "window.toml:12: error: 'take' must be one of 'last', 'largest', 'smallest', 'peak', 'mean', 'rms', found "
            "'larges'; did you mean 'largest'?",
            "window.toml:15: error: 'y' must be one of 'end', 'wall_time', 'processor_time', 'simulated_time', 'steps', "
            "found 'and'; did you mean 'end'?",
            "window.toml:16: error: 'log' must hold some of 'x', 'y', found 'z'"])

    def test_what_neither_case_nor_study_has(self):
        self.assertEqual(self.faults(TWO_AXES + """[[metric]]
name = "evenness"
reference = "measured"
[[metric]]
name = ""
series = "fluid.csv:speed[m/s]"
shares = [-1, 2]
[removal]
pistons = ["pistn"]
piston_area = 0.5
cycle = 2.0
answer = { wanted_depth = 1e-6, pressure_at_most = -1 }
"""), [
            "window.toml: error: [removal] has a figure 'evenness' of its own: the axis or metric needs another name",
            "window.toml: error: the name of an axis or metric must not be empty",
            "window.toml:21: error: 'reference' must be one of none that there are, found 'measured'",
            "window.toml:25: error: 'shares' must be from 0 to 1, found [-1, 2]",
            "window.toml:27: error: 'pistons' must hold some of 'piston', found 'pistn'; did you mean 'piston'?",
            "window.toml:30: error: 'pressure_at_most' must be above 0, found -1"])

    def test_a_case_that_is_not_there(self):
        faults = self.faults(TWO_AXES, HEAD.replace("case.toml", "absent.toml"))
        self.assertEqual(faults, ["window.toml:3: error: 'case' must be a case file beside the study, found "
                                  "'absent.toml', which is no file"])

    def test_no_toml(self):
        self.assertEqual(self.faults("[[axis]\n"), ["window.toml:4:7: error: Expected ']]' at the end of an array declaration"])

    def test_a_key_that_the_case_does_not_know(self):
        self.assertEqual(self.faults(TWO_AXES.replace('["fluid.x"]', '["fluid.xx"]'))[0],
                         "window.toml:5: error: [[axis]] 'x': --set fluid.xx=1: error: unknown key 'xx' in [fluid]")
        self.assertEqual(self.faults(TWO_AXES, HEAD + "set = { fluid.z = 1 }\n"),
                         ["window.toml:4: error: [study] set: --set fluid.z=1: error: unknown key 'z' in [fluid]"])

    def test_a_chart_that_leaves_an_axis_open(self):
        faults = self.faults(TWO_AXES + '[[chart]]\nx = "x"\ny = "wall_time"\n')
        self.assertEqual(faults, ["window.toml:19: error: the chart leaves the axis 'wait' open: draw it as 'lines' or "
                                  "'panels', or choose one value, at = { wait = ... }"])

    def test_a_key_that_two_axes_set(self):
        faults = self.faults(TWO_AXES.replace('["fluid.seconds"]', '["fluid.x"]'))
        self.assertEqual(faults, ["window.toml: error: 'fluid.x' is set by the axes 'x' and 'wait': a run can have one "
                                  "value only"])

    def test_options(self):
        self.write(TWO_AXES)
        self.assertEqual(self.study("--jobs", "0").stderr, "--jobs 0: error: must be an integer of at least 1\n")
        ended = self.study("--check")
        self.assertEqual((ended.returncode, ended.stdout, self.starts()),
                         (0, f"{self.case}/window.toml: no errors; 6 runs, 0 of them done\n", []))


if __name__ == "__main__":
    unittest.main()
