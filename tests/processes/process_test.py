"""How three processes end together: death, hang, interruption, refusal, faults of one of them.

    process_test.py BUILD/bin [unittest options]
"""
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import tomllib
import unittest

import h5py

from toryu import program
from toryu.processes import BAD_INPUT, DONE, INTERRUPTED, MACHINE, PEER_LOST, PHYSICS_FAILED
from toryu_testing import trio
from toryu_testing.process_case import LIMIT, NAMES, ProcessCase

class GoodEnd(ProcessCase):
    def test_impulse_given_is_impulse_taken(self):
        run = self.run_of_three(end_time="0.05").start_all()
        self.assert_all_end(run, DONE)
        figures = self.summary(run)["figures"]
        self.assertLess(figures["largest_impulse_error"], 1e-12)
        self.assertTrue(0 < figures["round_trip_share"] < 1, figures)
        self.assertGreater(figures["largest_impulse_error"], 0)  # sums in another order round differently

    def test_solid_feels_only_the_loads_of_the_case(self):
        run = self.run_of_three(end_time="0.02", settings=["coupling.loads=['friction']"]).start_all()
        self.assert_all_end(run, DONE)
        with h5py.File(run.out / "interface.h5") as file:
            self.assertGreater(abs(file["pressure"][-1]).max(), 0)
            self.assertEqual(abs(file["force"][:]).max(), 0)  # the fake fluid has no friction
        self.assertLess(self.summary(run)["figures"]["largest_impulse_error"], 1e-12)

    def test_two_runs_at_once_do_not_mix(self):
        first = self.run_of_three(end_time="0.05").start_all()
        second = self.run_of_three(end_time="0.03").start_all()
        for run, end_time in ((first, 0.05), (second, 0.03)):
            self.assert_all_end(run, DONE)
            self.assertAlmostEqual(self.summary(run)["simulated_time"], end_time)

    def test_the_same_run_twice_exchanges_the_same(self):
        records = []
        for _ in range(2):
            run = self.run_of_three(end_time="0.02").start_all()
            self.assert_all_end(run, DONE)
            with h5py.File(run.out / "interface.h5") as file:
                records.append({name: file[name][:].tobytes() for name in file})
        self.assertEqual(*records)


class Neighbours(ProcessCase):
    """Runs beside each other."""

    def container(self, out, kept, end_time):
        """Starts a run by the launcher in file and process namespaces of its own, with its own disk at the path `out`; its
        summary is kept."""
        contained = ["unshare", "--mount", "--pid", "--fork", "--kill-child", "--mount-proc", "--map-root-user"]
        script = ('out=$1 kept=$2; shift 2; mount -t tmpfs none "$out" && "$@"; code=$?; '
                  'cp "$out/coupler_summary.toml" "$kept"; exit $code')
        launch = program.python("launch", trio.CASE, f"--bin={self.bin}", f"--out={out}", f"--end-time={end_time}",
                                "--no-report", "--set=case.frame_interval=0")
        return self.enterContext(subprocess.Popen([*contained, "sh", "-c", script, "sh", out, kept, *launch],
                                                  stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True))

    def test_two_containers_of_one_network_may_give_their_results_one_path(self):
        if subprocess.run(["unshare", "--mount", "--pid", "--fork", "--mount-proc", "--map-root-user", "true"],
                          capture_output=True).returncode != 0:
            self.skipTest("no namespaces can be had here")
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (folder / "out").mkdir()
        end_times = (0.1, 0.08)
        runs = [self.container(folder / "out", folder / f"{end_time}.toml", end_time) for end_time in end_times]
        for run, end_time in zip(runs, end_times):
            words = run.communicate(timeout=2 * LIMIT)[1]
            self.assertEqual(run.returncode, DONE, words)
            summary = tomllib.loads((folder / f"{end_time}.toml").read_text())
            self.assertAlmostEqual(summary["simulated_time"], end_time)

    def test_eight_may_meet_in_one_domain(self):
        domain = 42  # follows from the first number of the secret
        runs = [self.run_of_three(end_time="0.005") for _ in range(8)]
        for number, run in enumerate(runs):
            (run.out / "run.secret").write_text(f"{domain + 100 * number:016x}{number:016x}\n")
        for run in runs:
            run.start_all()
        for run in runs:
            self.assert_all_end(run, DONE)
            self.assertAlmostEqual(self.summary(run)["simulated_time"], 0.005)


class Schemes(ProcessCase):
    """The coupling schemes with the real solvers."""
    EXPLICIT, IMPLICIT = "coupling.scheme=serial_explicit", "coupling.scheme=serial_implicit"

    def exchanged(self, *settings, end_time="0.01"):
        """What crossed the interface of the strip's case, and the coupler's figures."""
        programs = {"coupler": "coupler", "fluid": "fluid_solver", "solid": "solid_solver"}
        run = self.enterContext(trio.Trio({role: self.bin / name for role, name in programs.items()},
                                          end_time=end_time, settings=settings)).start_all()
        self.assert_all_end(run, DONE)
        figures = self.summary(run)["figures"]
        self.assertLess(figures["largest_impulse_error"], 1e-12)
        with h5py.File(run.out / "interface.h5") as file:
            return {name: file[name][:] for name in file}, figures

    def test_a_window_repeated_with_the_same_motion_is_bitwise_the_same(self):
        # A step too small to be seen repeats the first guess, which is what the explicit scheme goes by.
        once, _ = self.exchanged(self.EXPLICIT, "coupling.extrapolation_order=1")
        again, figures = self.exchanged(
            self.IMPLICIT, "coupling.implicit={relaxation='fixed', relaxation_factor=1e-300, "
            "largest_iteration_count=3, unconverged_windows_to_stop=1000000, tolerance=1e-12}")
        self.assertEqual(figures["iterations"] % 3, 0)
        self.assertGreater(figures["unconverged_windows"], 10)
        for name, values in once.items():
            self.assertEqual(values.tobytes(), again[name].tobytes(), name)

    def test_all_schemes_move_the_strip_alike(self):
        once, _ = self.exchanged()
        scale = abs(once["position"] - once["reference_position"]).max()
        for settings in (["coupling.scheme=parallel_explicit"], [self.EXPLICIT, "coupling.extrapolation_order=2"], [self.IMPLICIT],
                         [self.IMPLICIT, "coupling.implicit.relaxation=quasi_newton"]):
            with self.subTest(settings):
                other, figures = self.exchanged(*settings)
                self.assertEqual(figures.get("unconverged_windows", 0), 0)
                self.assertLess(abs(other["position"] - once["position"]).max(), 0.05 * scale)

    def test_no_convergence_ends_the_run(self):
        run = self.run_of_three(settings=[
            self.IMPLICIT, "coupling.implicit={relaxation='fixed', relaxation_factor=0.01, largest_iteration_count=3}"
        ]).start_all()
        self.assert_all_end(run, PHYSICS_FAILED, "5 windows in a row have not converged")

    def test_who_cannot_repeat_is_refused(self):
        run = self.run_of_three(fluid="faulty_fluid", settings=[self.IMPLICIT]).start_all()
        self.assert_all_end(run, BAD_INPUT, "faulty_fluid", "cannot repeat a window")


class Death(ProcessCase):
    def test_in_mid_run(self):
        for role in trio.ROLES:
            with self.subTest(role):
                run = self.run_of_three().start_all().wait_until_running()
                run.kill(role)
                start = time.monotonic()
                for other in self.others(role):
                    self.assert_ending(run, other, PEER_LOST, NAMES[role], "killed or stopped")
                print(f"{role} killed: the others ended after {time.monotonic() - start:.2f} s", end=" ")

    def test_after_joining(self):
        for role in ("fluid", "solid"):
            with self.subTest(role):
                run = self.run_of_three().start("coupler").start(role)
                run.wait_for_log(f"{NAMES[role]} .* joined", LIMIT)
                run.kill(role)
                self.assert_ending(run, "coupler", PEER_LOST, NAMES[role])

    def test_before_joining(self):
        environment = {"FAULT": "before joining"}
        run = self.run_of_three(fluid="faulty_fluid", settings=["coupling.time_limit=2"])
        run.start("coupler").start("solid").start("fluid", environment=environment)
        self.assertEqual(run.wait("fluid", LIMIT), 0)
        for name in ("coupler", "solid"):
            self.assert_ending(run, name, PEER_LOST, "fluid participant did not join within 2 s")

    def test_leaves_no_half_written_file_under_its_final_name(self):
        run = self.run_of_three().start_all().wait_until_running()
        run.kill("coupler")
        for name in ("coupler.csv", "interface.h5", "coupler_summary.toml"):
            self.assertFalse((run.out / name).exists(), name)
        self.assertTrue((run.out / "interface.h5.rows.part").exists())

    def test_a_new_run_can_start_at_once(self):
        run = self.run_of_three(end_time="1e6").start_all().wait_until_running()
        run.kill("coupler")
        leftover = {role: run.processes[role] for role in ("fluid", "solid")}
        (run.out / "coupler.csv.part").unlink()
        run.start_all().wait_until_running()
        run.signal("coupler", signal.SIGINT)
        self.assert_all_end(run, INTERRUPTED)
        for process in leftover.values():
            self.assertEqual(process.wait(LIMIT), PEER_LOST)


class Hang(ProcessCase):
    def test_stopped_process(self):
        for role in trio.ROLES:
            with self.subTest(role):
                run = self.run_of_three().start_all().wait_until_running()
                run.signal(role, signal.SIGSTOP)
                for other in self.others(role):
                    self.assert_ending(run, other, PEER_LOST, NAMES[role])
                run.signal(role, signal.SIGCONT)
                self.assert_ending(run, role, PEER_LOST)

    def test_short_stop_of_all_is_survived(self):
        run = self.run_of_three().start_all().wait_until_running()
        for number in (signal.SIGSTOP, signal.SIGCONT):
            for role in trio.ROLES:
                run.signal(role, number)
            if number == signal.SIGSTOP:
                time.sleep(4)  # longer than the leases and their grace
        run.wait_until_running(beyond=run.windows())
        run.signal("coupler", signal.SIGINT)
        self.assert_all_end(run, INTERRUPTED)

    def test_endless_loop(self):
        run = self.run_of_three(fluid="faulty_fluid", settings=["coupling.time_limit=2"])
        run.start("coupler").start("solid").start("fluid", environment={"FAULT": "hang"})
        for name in ("coupler", "solid"):
            self.assert_ending(run, name, PEER_LOST, "faulty_fluid did not answer in window 51 within 2 s")

    def test_nobody_else_comes(self):
        run = self.run_of_three(settings=["coupling.time_limit=1"]).start("coupler")
        self.assert_ending(run, "coupler", PEER_LOST, "fluid participant did not join within 1 s")


class Interruption(ProcessCase):
    def test_of_each(self):
        for role in trio.ROLES:
            with self.subTest(role):
                run = self.run_of_three().start_all().wait_until_running()
                run.signal(role, signal.SIGINT)
                self.assert_all_end(run, INTERRUPTED)
                self.assertTrue((run.out / "interface.h5").exists())
                self.assertEqual(self.summary(run)["exit_code"], INTERRUPTED)

    def test_of_all_as_by_a_terminal(self):
        run = self.run_of_three().start_all().wait_until_running()
        for role in trio.ROLES:
            run.signal(role, signal.SIGINT)
        self.assert_all_end(run, INTERRUPTED)

    def test_at_the_start(self):
        run = self.run_of_three().start("coupler").start("fluid")
        run.wait_for_log("fake_fluid .* joined", LIMIT)
        run.signal("coupler", signal.SIGINT)
        for name in ("coupler", "fluid"):
            self.assert_ending(run, name, INTERRUPTED)


class Machine(ProcessCase):
    """Faults of the machine."""

    def test_no_loopback_address(self):
        alone = ["unshare", "--net", "--map-root-user"]  # in a network of its own, which nobody has set up
        if subprocess.run([*alone, "true"], capture_output=True).returncode != 0:
            self.skipTest("no network of its own can be had here")
        for name in ("coupler", "fake_fluid"):
            done = subprocess.run([*alone, self.bin / name, trio.CASE, "--out", self.folder()], capture_output=True, text=True)
            self.assertEqual(done.returncode, MACHINE, done.stderr)
            self.assertRegex(done.stderr, f"^{name}: error: the machine: .*127.0.0.1, which does not work here: .*; 'ip address "
                                          "add .*\n$")

    def folder(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        return folder.name

    def test_more_threads_than_there_can_be(self):
        for options, environment in ((["--threads", "1000000"], {}), ([], {"OMP_NUM_THREADS": "1000000"})):
            done = subprocess.run([self.bin / "fluid_solver", trio.CASE, "--set", "solid=false", "--set", "coupling=false",
                                   "--end-time", "1e-4", "--out", self.folder(), *options], capture_output=True, text=True,
                                  env=os.environ | environment)
            self.assertEqual(done.returncode, DONE, done.stderr)

    def test_no_threads(self):
        done = subprocess.run([self.bin / "fluid_solver", trio.CASE, "--set", "solid=false", "--set", "coupling=false",
                               "--threads", "2", "--out", self.folder()], capture_output=True, text=True,
                              env=os.environ | {"OMP_STACKSIZE": "100000G"})
        self.assertEqual(done.returncode, MACHINE, done.stderr)
        self.assertIn("fluid_solver: error: the machine: OpenMP gets no threads", done.stderr)

    def test_a_folder_that_is_removed(self):
        run = self.run_of_three(end_time="1").start_all().wait_until_running()
        for path in run.out.iterdir():
            if path.suffix != ".err":  # what its programs say
                shutil.rmtree(path) if path.is_dir() else path.unlink()
        self.assert_ending(run, "coupler", MACHINE, "cannot complete", "coupler.csv", "removed or moved in mid-run")


class Refusal(ProcessCase):
    def test_second_run_in_the_same_folder(self):
        run = self.run_of_three().start_all().wait_until_running()
        run.start("coupler", name="second")
        self.assert_ending(run, "second", BAD_INPUT, str(run.out), "another run")
        run.wait_until_running(beyond=run.windows())  # the first goes on

    def test_of_a_fault(self):
        window = "faulty_fluid: window 51: "
        expected = {
            "physics": (PHYSICS_FAILED, "fluid particle 7 at t = 0.005 s: speed = 99 m/s, limit 10 m/s"),
            "value": (PHYSICS_FAILED, window + "force of interface particle 39 is nan"),
            "limit": (PHYSICS_FAILED, window + "time step limit is -1 s"),
            "count": (PEER_LOST, window + "39 values of pressure came, 40 were awaited"),
            "bug": (PEER_LOST, "faulty_fluid: index out of range"),
            "vanish": (PEER_LOST, "faulty_fluid was killed or stopped"),
        }
        for fault, (code, text) in expected.items():
            with self.subTest(fault):
                run = self.run_of_three(fluid="faulty_fluid").start("coupler").start("solid")
                run.start("fluid", environment={"FAULT": fault})
                for name in ("coupler", "solid"):
                    self.assert_ending(run, name, code, text)
                run.wait("fluid", LIMIT)

    def test_of_a_fluid_of_an_older_protocol(self):
        run = self.run_of_three(fluid="outdated_peer").start("fluid").start("coupler").start("solid")
        for name in ("coupler", "solid"):
            self.assert_ending(run, name, BAD_INPUT, "toryu/hello_from_fluid", "another protocol")

    def test_of_a_coupler_of_an_older_protocol(self):
        run = self.run_of_three(coupler="outdated_peer").start("coupler", environment={"PART": "coupler"})
        run.start("fluid").start("solid")
        for name in ("fluid", "solid"):
            self.assert_ending(run, name, BAD_INPUT, "toryu/session", "another protocol")

    def test_false_impulse_is_reported(self):
        run = self.run_of_three(fluid="faulty_fluid", end_time="0.01").start("coupler").start("solid")
        run.start("fluid", environment={"FAULT": "impulse"})
        self.assert_ending(run, "coupler", DONE, "window 51", "impulse given and taken differ")
        # All particles push alike, so the false part is 0.001 of F_x beside sqrt(2) F_x of the scale.
        self.assertAlmostEqual(self.summary(run)["figures"]["largest_impulse_error"], 1e-3 / 2**0.5, places=9)


if __name__ == "__main__":
    ProcessCase.bin = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main(verbosity=2)
