"""The launcher with stand-ins for the three programs: what it starts, how it ends, what it says."""

import os
import pathlib
import signal
import subprocess
import time
import tomllib
import unittest

from launch_case import NAMES, Launch

from toryu import processes


class WhatIsStarted(Launch):
    def test_a_coupled_case_starts_three_with_the_options(self):
        done = self.launch("--set", "fluid.density=1", "--end-time", "0.5", "--threads", "2")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in NAMES:
            self.assertEqual((self.out / f"{name}.arguments").read_text().splitlines(),
                             [str(self.case), f"--out={self.out}", "--set=fluid.density=1", "--end-time=0.5",
                              "--threads=2"])

    def test_a_case_of_one_side_starts_one(self):
        self.write_case("[solid]\n")
        self.assertEqual(self.launch().returncode, 0)
        self.assertEqual([p.name for p in self.out.glob("*.pid")], ["solid_solver.pid"])

    def test_a_side_that_is_taken_away_does_not_start(self):
        self.assertEqual(self.launch("--set", "solid=false").returncode, 0)
        self.assertEqual([p.name for p in self.out.glob("*.pid")], ["fluid_solver.pid"])

    def test_the_case_is_printed_by_the_coupler(self):
        done = self.launch("--print-case", "--set", "solid=false")
        self.assertEqual((done.returncode, self.pids()), (0, []), done.stderr)
        self.assertEqual(tomllib.loads(done.stdout), {"case": {"title": "test"}, "fluid": {}, "solid": False})

    def test_another_program_takes_a_side(self):
        self.fake(self.folder / "my_fluid")
        (self.folder / "my_fluid.plan").write_text("check_fails 1 it has no --check")
        self.assertEqual(self.launch("--fluid", str(self.folder / "my_fluid")).returncode, 0)
        self.assertEqual({p.stem for p in self.out.glob("*.pid")}, {"coupler", "my_fluid", "solid_solver"})

    def test_threads_sleep_in_a_coupled_run_unless_the_user_says_otherwise(self):
        self.plan(fluid="environment OMP_WAIT_POLICY")
        self.launch()
        self.assertEqual((self.out / "fluid_solver_OMP_WAIT_POLICY").read_text(), "passive")
        subprocess.run(self.command(), capture_output=True, env=os.environ | {"OMP_WAIT_POLICY": "active"})
        self.assertEqual((self.out / "fluid_solver_OMP_WAIT_POLICY").read_text(), "active")

    def test_a_second_run_in_the_same_folder_is_refused(self):
        self.plan(*["wait 30"] * 3)
        first = subprocess.Popen(self.command(), stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        try:
            self.wait_for(lambda: (self.out / "coupler.pid").exists())
            second = self.launch()
            self.assertEqual(second.returncode, 2)
            self.assertEqual(second.stderr,
                             f"{self.out}: error: another run writes its results here; wait for it or give --out "
                             "another folder\n")
        finally:
            first.terminate()
            first.wait(30)


class BadInput(Launch):
    def test_an_option_with_an_empty_value(self):
        for name in ("out", "fluid", "secure", "bin"):
            done = self.launch(f"--{name}", "")
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"error: argument --{name}: has no value", done.stderr)
        self.assertEqual(self.pids(), [])

    def test_the_errors_of_all_programs_are_merged_and_sorted(self):
        self.plan(coupler="check_fails 2 c.toml:20:1: error: c|c.toml:3:1: error: a",
                  fluid="check_fails 2 c.toml:3:1: error: a|c.toml:9:4: error: b|--sett: error: unknown option",
                  solid="check_fails 2 c.toml:9:2: error: b2")
        done = self.launch()
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.splitlines(),
                         ["--sett: error: unknown option", "c.toml:3:1: error: a", "c.toml:9:2: error: b2",
                          "c.toml:9:4: error: b", "c.toml:20:1: error: c"])
        self.assertEqual(self.pids(), [])

    def test_a_case_that_is_no_toml_is_left_to_the_coupler_to_tell(self):
        self.write_case("[fluid\n")
        self.plan(coupler="print_fails 2 c.toml:3:7: error: no bracket", fluid="check_fails 2 not asked")
        done = self.launch()
        self.assertEqual((done.returncode, done.stderr), (2, "c.toml:3:7: error: no bracket\n"))

    def test_a_case_of_no_side(self):
        self.write_case("")
        done = self.launch()
        self.assertEqual((done.returncode, done.stderr), (
            2, f"{self.case}/case.toml: error: no section [fluid] and no section [solid]: nothing to compute\n"))

    def test_a_program_that_is_not_there(self):
        done = self.launch("--solid", "/absent/solid")
        self.assertEqual((done.returncode, done.stderr),
                         (2, "/absent/solid: error: no such program, needed as solid_solver\n"))
        (self.bin / "coupler").unlink()
        done = self.launch()
        self.assertEqual((done.returncode, done.stderr),
                         (2, f"{self.bin}/coupler: error: cannot be started: No such file or directory\n"))

    def test_check_alone_runs_nothing(self):
        done = self.launch("--check")
        self.assertEqual((done.returncode, done.stdout), (0, f"{self.case}/case.toml: no errors\n"))
        self.assertEqual(self.pids(), [])

    def test_check_alone_shows_warnings(self):
        self.plan(solid="check_fails 0 solid_solver: warning: beyond an edge")
        self.assertEqual(self.launch("--check").stderr, "solid_solver: warning: beyond an edge\n")
        self.assertNotIn("beyond an edge", self.launch().stderr)  # the run itself would say it

    def test_a_check_that_crashes_is_a_bug(self):
        self.plan(solid="check_fails 1 terrible")
        done = self.launch()
        self.assertEqual((done.returncode, done.stderr),
                         (1, "terrible\nsolid_solver --check ended with exit code 1\n"))


class Failures(Launch):
    def test_the_cause_rules_the_exit_code_and_the_words(self):
        self.plan(coupler="wait 0.2; end 4", fluid="wait 0.1; say fluid_solver: error: particle 7; end 3",
                  solid="say solid_solver: error: the coupler left; end 4")
        done = self.launch()
        self.assertEqual(done.returncode, 3)
        self.assertIn("fluid_solver: error: particle 7\nfluid_solver ended with exit code 3 (physics failed)",
                      done.stderr)
        self.assertNotIn("the coupler left", done.stderr)
        self.assert_nothing_left()

    def test_a_killed_process_is_named_and_the_run_ends_with_4(self):
        self.plan(coupler="wait 0.5; end 4", fluid="wait 0.5; end 4", solid="kill 9")
        done = self.launch()
        self.assertEqual(done.returncode, 4)
        self.assertIn("solid_solver was killed by signal 9 (Killed)", done.stderr)

    def test_a_limit_of_the_machine_is_its_fault(self):
        for number, words in ((24, "CPU time limit exceeded); raise 'ulimit -t'"), (25, "File size limit exceeded); raise 'ulimit -f'")):
            run = processes.Run({"fluid_solver": ["bash", "-c", f"kill -{number} $$"]}, "fluid_solver", os.environ)
            self.assertEqual(run(), (5, f"fluid_solver was killed by signal {number} ({words}"))

    def test_a_crash_is_a_bug(self):
        self.plan(coupler="wait 0.2; end 4", fluid="kill 11", solid="end 4")
        done = self.launch()
        self.assertEqual(done.returncode, 1)
        self.assertIn("fluid_solver was killed by signal 11 (Segmentation fault)", done.stderr)

    def test_who_does_not_notice_a_failure_is_ended(self):
        self.plan(coupler="wait 60", fluid="ignore_requests; wait 60", solid="wait 0.2; end 3")
        start = time.monotonic()
        done = self.launch()
        self.assertEqual(done.returncode, 3)
        self.assertLess(time.monotonic() - start, 30)
        self.assert_nothing_left()

    def test_a_line_that_speaks_of_an_error_is_none(self):
        self.plan(solid="say relative error 1e-3")
        self.assertIn("relative error 1e-3", self.launch().stderr)

    def test_lines_of_the_others_are_passed_on(self):
        self.plan(coupler="wait 0.3", solid="say solid_solver: warning: coarse")
        done = self.launch()
        self.assertEqual(done.returncode, 0)
        self.assertIn("solid_solver: warning: coarse\n", done.stderr)


class Interruption(Launch):
    def start(self):
        process = subprocess.Popen(self.command(), stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
        self.wait_for(self.started)
        return process

    def test_it_is_passed_on_and_ends_with_130(self):
        plan = "end_when_asked 130; ready; wait 60"
        for number in (signal.SIGINT, signal.SIGTERM):
            self.plan(plan, plan, plan)
            for path in self.out.glob("*.ready"):
                path.unlink()
            process = self.start()
            process.send_signal(number)
            _, words = process.communicate(timeout=30)
            self.assertEqual(process.returncode, 130)
            self.assertIn("interrupted", words)
            self.assert_nothing_left()

    def test_a_second_one_ends_even_the_deaf(self):
        plan = "ignore_requests; ready; wait 60"
        self.plan(plan, plan, plan)
        process = self.start()
        process.send_signal(signal.SIGINT)
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=8)  # less than the launcher's patience
        self.assertEqual(process.returncode, 130)
        self.assert_nothing_left()

    def test_nothing_outlives_a_killed_launcher(self):
        self.plan(*["ready; wait 60"] * 3)
        process = self.start()
        process.kill()
        process.communicate()
        self.wait_for(lambda: not any(pathlib.Path(f"/proc/{pid}").exists() for pid in self.pids()))


if __name__ == "__main__":
    unittest.main()
