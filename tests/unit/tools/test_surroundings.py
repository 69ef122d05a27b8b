"""The launcher in surroundings that are against it: closed, full and broken streams, signals, terminals, settings of
Python, file systems without locks."""

import contextlib
import io
import os
import pathlib
import pty
import shutil
import signal
import subprocess
import sys
import termios
import time
import unittest
from unittest import mock

from launch_case import Launch

from toryu import processes, program

NO_LOCKS = os.environ.get("NO_LOCKS")  # a library in whose sight no file system has locks


class Surroundings(Launch):
    def command(self, *options):
        """As run.sh starts it."""
        return program.python("launch", self.case, "--bin", self.bin, "--out", self.out, *options)

    def shell(self, redirections, *options):
        """The exit code of a launch, and what is said on streams that are not redirected."""
        done = subprocess.run(["bash", "-c", f'"$@" {redirections}', "bash", *self.command(*options)],
                              capture_output=True, text=True, timeout=60, cwd=self.folder)
        return done.returncode, done.stdout + done.stderr


class Streams(Surroundings):
    RESULTS = ["coupler.arguments", "coupler.pid", "fluid_solver.arguments", "fluid_solver.pid", "launch.lock",
               "report.html", "solid_solver.arguments", "solid_solver.pid"]

    def test_who_reads_does_not_matter_to_a_run(self):
        self.plan(*["say a; say b; say c"] * 3)
        for streams in ("2>&-", "0<&- >&- 2>&-", "2>/dev/full", ">/dev/full", "| true; exit ${PIPESTATUS[0]}",
                        "2>&1 | head -1; exit ${PIPESTATUS[0]}"):
            with self.subTest(streams):
                self.assertEqual(self.shell(streams, "--overwrite")[0], 0)
                self.assertEqual(sorted(path.name for path in self.out.iterdir()), self.RESULTS)

    def test_a_description_may_be_read_in_part(self):
        self.plan(coupler="describes a key|" * 20000)
        code, said = self.shell("| head -1; exit ${PIPESTATUS[0]}", "--describe")
        self.assertEqual((code, said), (0, "a key\n"))
        code, said = self.shell(">/dev/full", "--describe")
        self.assertEqual(code, 5)
        self.assertIn("error: the machine: standard output: No space left on device; make room", said)

    def test_words_of_a_program_that_are_no_text_do_no_harm(self):
        self.plan(fluid="check_fails 2 c.toml:1:1: error: caf\udce9")
        self.assertEqual(self.shell("", "--check"), (2, "c.toml:1:1: error: caf\\xe9\n"))


class Settings(Surroundings):
    def test_those_of_python_and_the_locale_change_nothing(self):
        modules = self.folder / "modules"
        for name in ("numpy", "h5py", "toryu", "html"):
            (modules / name).mkdir(parents=True)
            (modules / name / "__init__.py").write_text("raise SystemExit(77)\n")
        hostile = {"PYTHONPATH": str(modules), "PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0", "LC_ALL": "C",
                   "PYTHONSTARTUP": "/absent", "PYTHONHOME": "/absent", "PYTHONWARNINGS": "error", "MPLBACKEND": "absent"}
        self.case = self.case.rename(self.folder / "größe 砥")
        self.plan(fluid="say größe 砥")
        done = subprocess.run(self.command(), capture_output=True, env=os.environ | hostile, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("größe 砥", done.stderr.decode())
        self.assertIn("größe 砥", (self.out / "report.html").read_text(encoding="utf-8"))

    def test_a_folder_whose_name_is_no_text_has_a_report(self):
        self.case = self.case.rename(self.folder / "caf\udce9")
        done = subprocess.run(self.command(), capture_output=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("caf", (self.out / "report.html").read_text(encoding="utf-8"))

    @unittest.skipUnless(NO_LOCKS, "needs the library")
    def test_a_file_system_without_locks_bears_runs(self):
        done = subprocess.run(self.command(), capture_output=True, text=True, env=os.environ | {"LD_PRELOAD": NO_LOCKS})
        self.assertEqual(done.returncode, 0, done.stderr)


class Signals(Surroundings):
    def start(self, *options, **settings):
        process = subprocess.Popen(self.command(*options), stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                   **settings)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def states(self):
        """One letter a program, see proc(5)."""
        return "".join(sorted(pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] for pid in self.pids()))

    def test_ctrl_z_stops_all_and_all_go_on(self):
        self.plan(*["end_when_asked 0; ready; wait 60"] * 3)
        process = self.start()
        self.wait_for(self.started)
        process.send_signal(signal.SIGTSTP)
        self.assertTrue(os.WIFSTOPPED(os.waitpid(process.pid, os.WUNTRACED)[1]))
        self.wait_for(lambda: self.states() == "TTT")
        process.send_signal(signal.SIGCONT)
        self.wait_for(lambda: "T" not in self.states())
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=30)
        self.assertEqual(process.returncode, 0)
        self.assert_nothing_left()

    def test_ctrl_c_in_a_check_ends_it_in_one_line(self):
        self.plan(fluid="check_takes 60")
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            process = self.start("--check")
            self.wait_for((self.folder / "checking").exists)
            process.send_signal(number)
            _, words = process.communicate(timeout=30)
            self.assertEqual((process.returncode, words), (130, "interrupted\n"))
            (self.folder / "checking").unlink()

    def test_what_is_ignored_stays_so_and_the_programs_can_be_asked_all_the_same(self):
        self.plan(*["end_when_asked 130; ready; wait 60"] * 3)
        process = self.start(preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN))  # as a script's background
        self.wait_for(self.started)
        process.send_signal(signal.SIGINT)
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=30)
        self.assertEqual(process.returncode, 130)

    def test_a_terminal_that_stops_the_background_stops_no_program(self):
        self.plan(coupler="say hello; wait 0.1; say hello")
        child, terminal = pty.fork()
        if child == 0:
            attributes = termios.tcgetattr(0)
            attributes[3] |= termios.TOSTOP
            termios.tcsetattr(0, termios.TCSANOW, attributes)
            os.execv("/usr/bin/timeout", ["timeout", "--foreground", "20", *self.command("--no-report")])
        said = b""
        try:
            while piece := os.read(terminal, 1000):
                said += piece
        except OSError:  # all of its side is closed
            pass
        self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), 0, said)
        self.assertEqual(said.count(b"hello"), 2, said)
        os.close(terminal)


class Faults(Surroundings):
    def test_a_program_that_ends_at_once_is_named(self):
        for _ in range(10):
            done = self.launch("--fluid", "/bin/false", "--no-report", "--overwrite")
            self.assertEqual(done.returncode, 1)
            self.assertIn("fluid_solver ended with exit code 1", done.stderr)
            self.assertNotIn("Traceback", done.stderr)

    def test_a_program_that_is_done_before_the_run_begins_is_named(self):
        self.plan(coupler="wait 60", solid="wait 60")
        start = time.monotonic()
        done = self.launch("--fluid", "/bin/true", "--no-report", "--overwrite")
        self.assertEqual(done.returncode, 4)
        self.assertIn("fluid_solver ended with exit code 0 before it had joined the run", done.stderr)
        self.assertLess(time.monotonic() - start, 30)
        self.assert_nothing_left()

    def test_a_program_that_is_done_after_the_run_began_may_be_the_first(self):
        self.plan(coupler="write used_case.toml met; wait 2")
        self.assertEqual(self.launch("--no-report").returncode, 0)

    def test_a_program_that_goes_on_when_the_run_is_over_is_ended(self):
        ended = (4, "fluid_solver was ended: it went on for 0 s after the run was over")
        for fluid, end in (("", ended), ("trap 'exit 0' TERM; ", (0, "")), ("trap '' TERM; ", ended)):
            commands = {"coupler": ["true"], "solid_solver": ["true"],
                        "fluid_solver": ["bash", "-c", f"{fluid}while :; do sleep 0.01; done"]}
            with mock.patch.multiple(processes, PATIENCE=0.5, QUIET=0.1, LAST_PATIENCE=0.5), \
                    contextlib.redirect_stderr(io.StringIO()) as told:
                start = time.monotonic()
                code, said = processes.Run(commands, "coupler", os.environ)()
            self.assertLess(time.monotonic() - start, 10)
            self.assertIn("waiting for fluid_solver to end, for 0 s at most: the run is over\n", told.getvalue())
            self.assertEqual((code, said), end)

    def test_a_program_that_is_done_before_the_run_is_over_is_the_cause(self):
        lost = "say {}: error: peer lost: solid_solver was killed or stopped; end 4"
        self.plan(coupler="write used_case.toml met; wait 1; " + lost.format("coupler"),
                  fluid="wait 1; " + lost.format("fluid_solver"))
        done = self.launch("--solid", "/bin/true", "--no-report", "--overwrite")
        self.assertEqual(done.returncode, 4)
        self.assertIn("solid_solver ended with exit code 0 before the run was over", done.stderr)
        self.assertNotIn("fluid_solver ended", done.stderr)

    def test_a_program_that_is_none_is_refused(self):
        text = self.folder / "notes"
        text.write_text("no program\n")
        text.chmod(0o755)
        done = self.launch("--fluid", str(text), "--no-report")
        self.assertEqual(done.returncode, 2)
        self.assertIn(f"{text}: error: cannot be started: Exec format error; ", done.stderr)
        self.assert_nothing_left()

    def test_the_cause_is_who_failed_not_who_was_told(self):
        own, told = "error: physics failed: density -1", "error: physics failed: fluid_solver: density -1"
        self.plan(coupler=f"say coupler: {told}; wait 0.1; end 3", solid=f"say solid_solver: {told}; end 3",
                  fluid=f"wait 0.3; say fluid_solver: {own}; end 3")
        done = self.launch()
        self.assertEqual(done.returncode, 3)
        self.assertIn(f"fluid_solver: {own}\nfluid_solver ended with exit code 3", done.stderr)
        self.assertNotIn("solid_solver", done.stderr)

    def test_the_cause_is_the_coupler_where_it_names_nobody(self):
        words = "error: physics failed: 5 windows have not converged"
        self.plan(coupler="wait 0.3; end 3", solid=f"say solid_solver: {words}; end 3", fluid=f"say fluid_solver: {words}; end 3")
        self.assertIn("coupler ended with exit code 3", self.launch().stderr)

    def test_of_two_causes_one_is_named(self):
        words = "error: the machine: cannot write '{}'"
        self.plan(coupler="end 5", solid=f"say solid_solver: {words.format('solid.csv')}; end 5",
                  fluid=f"say fluid_solver: {words.format('fluid.csv')}; end 5")
        self.assertRegex(self.launch().stderr, "(fluid|solid)_solver ended with exit code 5")

    def test_a_fault_of_the_machine_has_its_code(self):
        self.plan(fluid="say fluid_solver: error: the machine: no room; end 5", coupler="end 5",
                  solid="say solid_solver: error: the machine: fluid_solver: no room; end 5")
        done = self.launch()
        self.assertEqual(done.returncode, 5)
        self.assertIn("fluid_solver ended with exit code 5 (a fault of the machine)", done.stderr)
        self.plan(solid="check_fails 5 solid_solver: error: the machine: no threads")
        self.assertEqual(self.launch().returncode, 5)

    def test_a_report_that_finds_no_room_is_one(self):
        self.plan(coupler="link_to /dev/full report.html.part")
        done = self.launch()
        self.assertEqual(done.returncode, 5)
        self.assertRegex(done.stderr, "^error: the machine: .*report.html.part: No space left on device; make room.*\n$")

    def test_a_package_that_cannot_be_loaded(self):
        package = self.folder / "toryu"
        shutil.copytree(program.PACKAGE, package)
        (package / "part.py").write_text("import absent_package\n")
        done = subprocess.run([sys.executable, "-I", "-X", "utf8", package, "part"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertRegex(done.stderr, "^error: the machine: .*No module named 'absent_package'; .*\n$")

    def test_a_path_that_cannot_be_one_is_refused(self):
        longest = "a" * 300
        for options in ((), ("--restart", longest), ("--restart",), ("--out", longest)):
            case = [longest] if options in ((), ("--restart",)) else [self.case]
            done = subprocess.run(program.python("launch", *case, "--bin", self.bin, *options), capture_output=True,
                                  text=True, cwd=self.folder)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertNotIn("Traceback", done.stderr)


if __name__ == "__main__":
    unittest.main()
