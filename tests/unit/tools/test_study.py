"""Studies with a stand-in for the program: what runs, what is kept, how it ends."""

import json
import pathlib
import re
import shutil
import signal
import subprocess
import time
import unittest

from toryu_testing.study_case import TWO_AXES, Study

TWO_RUNS = '[[axis]]\nname = "x"\nvalues = [1, 2]\nkeys = ["fluid.x"]\n'


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

    def test_a_run_whose_files_are_damaged_runs_again(self):
        self.write(TWO_RUNS)
        self.done()
        for damage in ({"fluid.csv": ""}, {"fluid_summary.toml": ""}, {"run.json": "[]"}, {"run.json": "{"},
                       {"fluid.csv": "time[s],speed[m/s]\n0,1\n"}):
            folder, *_ = sorted((self.out / "runs").iterdir())
            for name, text in damage.items():
                (folder / name).write_text(text)
            (folder / "notes.txt").write_text("mine")
            before = len(self.starts())
            self.done()
            self.assertEqual(len(self.starts()), before + 1, damage)
            self.assertEqual((folder / "notes.txt").read_text(), "mine")

    def test_a_name_may_hold_what_others_take_for_mathematics(self):
        self.write("""[[axis]]
name = "price"
[[axis.choice]]
name = "cost $1^ per hour, $2"
[[axis.choice]]
name = "$x_$"
[[axis.choice]]
name = "_hidden"
[[metric]]
name = "end"
series = "fluid.csv:speed[m/s]"
[[chart]]
x = "price"
y = "end"
""")
        self.done()
        page = (self.out / "study.html").read_text()
        for name in ("cost $1^ per hour, $2", "$x_$", "_hidden"):
            self.assertRegex(page, "<text[^>]*>" + re.escape(name) + "</text>")

    def test_a_logarithmic_colour_has_plain_numbers(self):
        self.write(TWO_AXES + '[[metric]]\nname = "end"\nseries = "fluid.csv:speed[m/s]"\ntake = "largest"\n'
                   '[[chart]]\nx = "x"\ny = "wait"\ncolour = "end"\nlog = ["colour"]\n')
        self.done()
        self.assertNotIn("mathdefault", (self.out / "charts/chart_01.svg").read_text())

    def test_a_change_runs_what_it_touches(self):
        self.write(TWO_RUNS)
        self.done()
        self.write(TWO_RUNS.replace("[1, 2]", "[1, 5]"))
        self.done()
        self.assertEqual(len(self.starts()), 3)
        (self.case / "case.toml").write_text('# the same\n[case]\ntitle = "test"\n[[wall]]\nname = "piston"\n[fluid]\n')
        self.done()
        self.assertEqual(len(self.starts()), 3)
        (self.case / "case.toml").write_text('[case]\ntitle = "another"\n[[wall]]\nname = "piston"\n[fluid]\n')
        self.done()
        self.assertEqual(len(self.starts()), 5)
        with open(self.bin / "fluid_solver", "a") as program:
            program.write("# another program\n")
        self.done()
        self.assertEqual(len(self.starts()), 7)

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


class HalfDone(Study):
    """A run that a killed study has left."""

    def kill_the_study(self, *options):
        """While its first run waits; returns the key of that run."""
        process = subprocess.Popen(self.command("--jobs", "1", *options), stderr=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, cwd=self.folder)
        self.wait_for(self.starts)
        half = self.out / "runs" / self.starts()[0]
        self.wait_for((half / "half.txt").exists)
        time.sleep(0.2)  # for the checkpoint
        process.kill()
        process.communicate()
        (half / "detached.csv").touch()
        return half.name

    def go_on(self, *settings, axes=TWO_RUNS):
        self.write(axes)
        options = ["--set", "fluid.seconds=3", *(f"--set={setting}" for setting in settings)]
        half = self.kill_the_study(*options)
        self.done("--jobs", "1", *options)
        return half

    def assert_afresh(self, half):
        self.assertEqual(self.starts().count(half), 2)
        self.assertFalse((self.out / "runs" / half / "detached.csv").exists())

    def test_it_goes_on_from_its_checkpoint(self):
        half = self.go_on("fluid.checkpoints=1")
        self.assertEqual(self.starts("restarts"), [half])
        self.assertTrue((self.out / "runs" / half / "detached.csv").exists())
        self.assertEqual(len(self.table()), 2)
        self.assertEqual(list(self.out.glob("runs/*.1")), [])

    def test_it_starts_afresh_without_a_whole_one(self):
        half = self.go_on("fluid.checkpoints=2")
        self.assertEqual(self.starts("restarts"), [])
        self.assert_afresh(half)

    def test_it_starts_afresh_if_its_time_counts(self):
        half = self.go_on("fluid.checkpoints=1", axes=TWO_RUNS + "[timing]\nrepeat = 1\n")
        self.assertEqual(self.starts("restarts"), [])
        self.assert_afresh(half)

    def test_it_starts_afresh_if_the_checkpoint_is_refused(self):
        half = self.go_on("fluid.checkpoints=1", "fluid.refuses=1")
        self.assertEqual(self.starts("restarts"), [half])
        self.assertEqual(self.starts().count(half), 3)
        self.assertFalse((self.out / "runs" / half / "detached.csv").exists())
        self.assertEqual({row["exit_code"] for row in self.table()}, {"0"})


def state_of(folder):
    """One letter, see proc(5), of the process in that folder of /proc; Z if it has gone."""
    try:
        return (folder / "stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return "Z"


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

    def test_ctrl_z_stops_all_its_processes_and_all_go_on(self):
        self.write(self.SLOW)
        process = self.start()
        self.wait_for(lambda: len(self.starts()) > 1)
        process.send_signal(signal.SIGTSTP)
        self.wait_for(lambda: {state_of(path.parent) for path in self.processes_of_this_test()} <= {"T", "Z"})
        kept = self.records()
        time.sleep(1)  # twice what a run takes
        self.assertEqual(self.records(), kept)
        self.assertGreater(len(self.processes_of_this_test()), 1)  # its runs are still there
        process.send_signal(signal.SIGCONT)
        self.assertEqual(process.wait(60), 0, process.stderr.read())
        process.stderr.close()

    def test_who_reads_does_not_matter_to_it(self):
        for streams in ("2>&-", "0<&- >&- 2>&-", "2>/dev/full", ">/dev/full", "2>&1 | head -1; exit ${PIPESTATUS[0]}"):
            with self.subTest(streams):
                self.write(TWO_RUNS)
                ended = subprocess.run(["bash", "-c", f'"$@" {streams}', "bash", *self.command()], capture_output=True)
                self.assertEqual(ended.returncode, 0, ended.stderr)
                self.assertEqual(len(self.table()), 2)
                shutil.rmtree(self.out)

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
        first = self.start("--set", "fluid.seconds=60")  # however long the second takes to start
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


if __name__ == "__main__":
    unittest.main()
