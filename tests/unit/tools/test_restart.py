"""Going on with a run: from which checkpoint, with which options, and what is said at the end of one that can go on."""

import shlex
import signal
import subprocess
import unittest

from launch_case import NAMES, Launch

from toryu.results_folder import newest_checkpoint


class Restart(Launch):
    def leave_checkpoints(self, whole=("000001",), half=()):
        for number in (*whole, *half):
            (self.out / "checkpoint" / number).mkdir(parents=True)
        for number in whole:
            (self.out / "checkpoint" / number / "manifest.toml").touch()

    def test_it_goes_on_in_the_folder_and_moves_nothing(self):
        self.leave_checkpoints()
        (self.out / "fluid.csv").write_text("time[s]")
        done = self.launch("--restart", "--end-time", "2")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in NAMES:
            self.assertEqual((self.out / f"{name}.arguments").read_text().splitlines(),
                             [str(self.case), f"--out={self.out}", "--end-time=2", "--restart"])
        self.assertEqual((self.out / "fluid.csv").read_text(), "time[s]")
        self.assertTrue((self.out / "checkpoint/000001/manifest.toml").exists())
        self.assertFalse((self.folder / "out.1").exists())

    def test_a_folder_can_be_given(self):
        self.out = self.folder / "elsewhere"
        self.leave_checkpoints()
        command = self.command()
        del command[command.index("--out"):]
        done = subprocess.run([*command, "--restart", "elsewhere"], capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.out / "coupler.arguments").read_text().splitlines()[1:], ["--out=elsewhere", "--restart"])
        self.assertEqual(self.launch("--restart", str(self.out)).returncode, 0)  # the same as --out
        refused = self.launch("--restart", str(self.folder))
        self.assertEqual((refused.returncode, refused.stderr), (
            2, f"--out {self.out}: error: the run of --restart {self.folder} goes on where it is; give one of them\n"))

    def test_it_may_stand_before_the_case(self):
        self.leave_checkpoints()
        command = self.command()
        command.remove(str(self.case))
        at = command.index("--out")
        done = subprocess.run([*command[:at], "--restart", str(self.case), *command[at:]], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("--restart", (self.out / "coupler.arguments").read_text().splitlines())
        nothing = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(nothing.returncode, 2)
        self.assertIn("the following arguments are required: CASE", nothing.stderr)

    def test_it_is_no_use_with_overwrite(self):
        self.leave_checkpoints()
        done = self.launch("--restart", "--overwrite")
        self.assertEqual((done.returncode, done.stderr), (
            2, "--overwrite: error: would remove what --restart goes on from; give one of them\n"))
        self.assertIsNotNone(newest_checkpoint(self.out))

    def test_one_that_is_refused_leaves_the_report(self):
        self.leave_checkpoints()
        self.plan(fluid="end 2")
        done = self.launch("--restart")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertFalse((self.out / "report.html").exists())

    def test_the_newest_whole_checkpoint_counts(self):
        self.leave_checkpoints(whole=("000002", "000010"), half=("000011",))
        self.leave_checkpoints(whole=("part",))
        self.assertEqual(newest_checkpoint(self.out).name, "000010")

    def test_without_a_whole_checkpoint_it_says_what_is_there(self):
        def refusal():
            done = self.launch("--restart")
            self.assertEqual((done.returncode, self.pids()), (2, []))
            return done.stderr

        start = f"--restart: error: {self.out} holds no whole checkpoint; it holds "
        self.assertEqual(refusal(), start + "no results\n")
        (self.out / "fluid.csv").touch()
        self.assertEqual(refusal(), start + "results of a run without checkpoints\n")
        self.leave_checkpoints(whole=(), half=("000001",))
        self.assertEqual(refusal(), start + "results of a run whose first checkpoint was not finished\n")
        self.out = self.folder / "absent"
        self.assertIn("absent holds no whole checkpoint; it holds no results\n", refusal())
        self.assertFalse(self.out.exists())


class HowToGoOn(Launch):
    def last_line(self, *options):
        return self.launch(*options).stdout.splitlines()[-1]

    def command_to_go_on(self, *options):
        return "go on with: " + shlex.join(["./run.sh", *self.command(*options)[3:]])

    def test_a_run_that_failed_says_how(self):
        for code in (4, 1):
            self.plan(fluid=f"checkpoint 000001; say fluid_solver: error: so; end {code}")
            self.assertEqual(self.last_line("--overwrite", "--set=a.b=two words"),
                             self.command_to_go_on("--set=a.b=two words", "--restart"))

    def test_a_run_that_was_killed_says_how(self):
        self.plan(solid="checkpoint 000001; kill 9")
        self.assertEqual(self.last_line(), self.command_to_go_on("--restart"))

    def test_a_run_that_went_on_before_says_the_same_again(self):
        self.plan(fluid="checkpoint 000001; end 4")
        self.launch()
        self.assertEqual(self.last_line("--restart"), self.command_to_go_on("--restart"))

    def test_a_run_that_is_done_or_has_no_checkpoint_says_nothing_of_it(self):
        for plan in ("checkpoint 000001", "checkpoint 000001; end 2", "end 4"):
            self.plan(fluid=plan)
            self.assertNotIn("go on with", self.launch().stdout, plan)

    def test_a_failure_of_physics_would_only_be_repeated(self):
        self.plan(fluid="checkpoint 000001; end 3")
        self.assertNotIn("go on with", self.launch().stdout)


class WithoutATerminal(Launch):
    def test_under_nohup_a_run_outlives_it(self):
        self.plan(*["ready; wait 2"] * 3)
        process = subprocess.Popen(["nohup", *self.command()], stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.wait_for(self.started)
        process.send_signal(signal.SIGHUP)
        words = process.communicate(timeout=30)[1]
        self.assertEqual(process.returncode, 0, words)


class LastCheckpoint(Launch):
    def start(self):
        process = subprocess.Popen(self.command(), stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.wait_for(self.started)
        return process

    def test_an_interrupted_run_has_the_time_to_write_it(self):
        self.plan("checkpoint_when_asked 5; ready; wait 60", *["end_when_asked 130; ready; wait 60"] * 2)
        process = self.start()
        process.send_signal(signal.SIGTERM)
        said, words = process.communicate(timeout=30)
        self.assertEqual(process.returncode, 130)
        self.assertIn("waiting for coupler to write a last checkpoint, for 60 s at most; Ctrl-C again ends them at "
                      "once\n", words)
        self.assertIn("go on with: ./run.sh", said)
        self.assertEqual(newest_checkpoint(self.out).name, "000007")

    def test_who_ends_at_once_is_not_waited_for_aloud(self):
        self.plan(*["checkpoint_when_asked 0; ready; wait 60"] * 3)
        process = self.start()
        process.send_signal(signal.SIGINT)
        self.assertNotIn("waiting", process.communicate(timeout=30)[1])


if __name__ == "__main__":
    unittest.main()
