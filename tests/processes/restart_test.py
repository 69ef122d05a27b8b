"""Checkpoints of three processes: what a run that was ended, killed or stopped leaves is gone on with, and every bit
is that of a run that was left alone.

    restart_test.py BUILD/bin [unittest options]
"""
import contextlib
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import time
import unittest

from toryu.processes import BAD_INPUT, DONE, INTERRUPTED, PEER_LOST
from toryu_testing import trio
from toryu_testing.process_case import LIMIT, SOLVERS, ProcessCase

END_TIME = "1"  # seconds of the run of the stand-ins: 10000 windows, in more than a second
SOME = "case.checkpoint_interval=0.02"
RESTART = ["--restart"]


def implicit(relaxation):
    return ["coupling.scheme=serial_implicit", f"coupling.implicit.relaxation={relaxation}"]


class RestartCase(ProcessCase):
    def undisturbed(self, settings=(), **others):
        """The results of a run that is left alone, without a checkpoint."""
        none = ["case.checkpoint_interval=0", "case.checkpoint_every=0"]
        run = self.run_of_three(settings=[*settings, *none], **({"end_time": END_TIME} | others)).start_all()
        self.assert_all_end(run, DONE)
        self.assertFalse((run.out / "checkpoint").exists())
        return run.results()

    def assert_goes_on(self, run, expected):
        """Restarts the run; what it has left at its end must be what is expected."""
        run.start_all(extra=RESTART)
        self.assert_all_end(run, DONE)
        found = run.results()
        self.assertEqual(sorted(found), sorted(expected))
        for name, content in expected.items():
            self.assertEqual(found[name], content, name)


class Interrupted(RestartCase):
    def check(self, settings, interrupted, beyond=20, **others):
        expected = self.undisturbed(settings, **others)
        run = self.run_of_three(settings=settings, **({"end_time": END_TIME} | others)).start_all()
        run.wait_until_running(beyond)
        run.signal(interrupted, signal.SIGINT)
        self.assert_all_end(run, INTERRUPTED, "--restart goes on from")
        self.assertLess(self.summary(run)["simulated_time"], float(run.end_time))
        self.assert_goes_on(run, expected)
        self.assertEqual(self.summary(run)["simulated_time"], float(run.end_time))

    def test_by_the_coupler(self):
        self.check([], "coupler")

    def test_by_a_participant_of_a_parallel_run(self):
        self.check(["coupling.scheme=parallel_explicit"], "fluid")

    def test_by_a_participant_of_an_implicit_run(self):
        self.check(implicit("aitken"), "solid")

    def test_by_a_second_signal_at_once(self):
        run = self.run_of_three(fluid="faulty_fluid", settings=[SOME])
        run.start("coupler").start("solid").start("fluid", environment={"FAULT": "slow checkpoint"})
        run.wait_until_running()
        run.signal("coupler", signal.SIGINT)
        time.sleep(0.2)  # the checkpoint is held open for longer
        run.signal("coupler", signal.SIGTERM)
        start = time.monotonic()
        self.assert_ending(run, "coupler", INTERRUPTED)
        self.assertLess(time.monotonic() - start, 2)
        for role in ("fluid", "solid"):
            self.assert_ending(run, role, INTERRUPTED)

    def test_by_the_file_stop(self):
        expected = self.undisturbed()
        run = self.run_of_three(end_time=END_TIME).start_all().wait_until_running()
        (run.out / "stop").touch()
        self.assert_all_end(run, INTERRUPTED, f"ended by the file 'stop' in {run.out}")
        self.assertFalse((run.out / "stop").exists())
        self.assert_goes_on(run, expected)


class Alone(RestartCase):
    """A medium that wears a wall, by the fluid solver alone."""
    CASE = pathlib.Path(__file__).resolve().parents[2] / "cases/abrasive_flow/rigid.toml"

    def start(self, run, *options):
        run.case = self.CASE
        run.start("fluid", extra=["--set", "case.frame_interval=0.005", *options])

    def test_what_is_refused_leaves_the_results(self):
        run = self.run_of_three(**SOLVERS, end_time="0.01")
        self.start(run)
        self.assert_ending(run, "fluid", DONE)
        left = {name: (run.out / name).read_bytes()
                for name in ("surface.h5", "fluid.csv", "used_case.toml", "fluid_summary.toml")}
        self.start(run, "--set", "fluid.sound_speed=2.5", *RESTART)
        self.assert_ending(run, "fluid", BAD_INPUT, "fluid.sound_speed: error: is 2.5, and was 2 in the checkpoint")
        for name, content in left.items():
            self.assertEqual((run.out / name).read_bytes(), content, name)
        self.start(run, *RESTART)
        self.assert_ending(run, "fluid", DONE, "nothing to compute: the run is at t = 0.01 s, and ends at 0.01 s")
        self.assertIn("surface.h5:preston_depth", run.results())

    def test_two_in_one_folder_are_refused(self):
        run = self.run_of_three(**SOLVERS)
        self.start(run)
        run.wait_for_log("largest time step", LIMIT)
        run.case = self.CASE
        run.start("fluid", name="second", extra=RESTART)
        self.assert_ending(run, "second", BAD_INPUT, f"{run.out}: error: another run writes its results here")
        run.signal("fluid", signal.SIGHUP)
        self.assert_ending(run, "fluid", INTERRUPTED)
        self.assertEqual(run.wait_for_checkpoint(), 1)


class Solvers(RestartCase):
    """The strip's case with the real solvers, from a checkpoint in the middle."""

    def check(self, settings, case=trio.CASE):
        settings = [*settings, "case.frame_interval=0.004"]
        expected = self.undisturbed(settings, **SOLVERS, case=case, end_time="0.02")
        self.assertIn("solid_000005.hdf:VTKHDF/Points", expected)
        run = self.run_of_three(**SOLVERS, case=case, end_time="0.02",
                                settings=[*settings, "case.checkpoint_interval=0.011"])
        run.start_all()
        self.assert_all_end(run, DONE)
        self.assertEqual(run.results(), expected, "checkpoints change nothing")
        shutil.rmtree(run.out / f"checkpoint/{run.wait_for_checkpoint():06}")  # that at the end
        self.assert_goes_on(run, expected)
        self.assertIn("goes on at t = 0.011", (run.out / "log.txt").read_text())

    def test_serial(self):
        self.check([])

    def test_in_space_that_repeats_itself(self):
        """The piece goes through the side of the domain from 7 to 17 ms."""
        places = ["fluid.hole.1.min=[0.203125,0.109375]", "fluid.hole.1.max=[0.234375,0.140625]",
                  "solid.region.1.box.min=[0.203125,0.109375]", "solid.region.1.box.max=[0.234375,0.140625]"]
        self.check(places, case=trio.CASE.parent / "flaps")

    def test_parallel(self):
        self.check(["coupling.scheme=parallel_explicit"])

    def test_implicit(self):
        for relaxation in ("fixed", "aitken", "quasi_newton"):
            with self.subTest(relaxation):
                self.check(implicit(relaxation))


class Killed(RestartCase):
    def assert_each_goes_on(self, killed, expected):
        """`killed` maps a role to the run in which its process was killed."""
        for role, run in killed.items():
            with self.subTest(role):
                for other in self.others(role):
                    self.assert_ending(run, other, PEER_LOST)
                self.assert_goes_on(run, expected)

    def test_at_random_moments(self):
        seed = random.randrange(1000)
        print(f"seed {seed}", end=" ")
        chance = random.Random(seed)
        expected = self.undisturbed()
        killed = {role: self.run_of_three(end_time=END_TIME, settings=[SOME]) for role in trio.ROLES}
        for role, run in killed.items():
            run.start_all().wait_for_checkpoint()
            time.sleep(chance.uniform(0, 0.2))
            run.kill(role)
        self.assert_each_goes_on(killed, expected)

    def test_during_a_checkpoint(self):
        slow = {"FAULT": "slow checkpoint"}
        os.environ |= slow  # of all that are started from here
        self.addCleanup(os.environ.pop, "FAULT")
        settings = ["case.checkpoint_interval=0.03"]
        expected = self.undisturbed(fluid="faulty_fluid", end_time="0.1")
        killed = {role: self.run_of_three(fluid="faulty_fluid", end_time="0.1", settings=settings)
                  for role in trio.ROLES}
        for role, run in killed.items():
            newest = run.start_all().wait_for_checkpoint()
            while not (run.out / f"checkpoint/{newest + 1:06}").exists():
                time.sleep(0.01)
            run.kill(role)
        self.assert_each_goes_on(killed, expected)


class Refused(RestartCase):
    def everything(self, run):
        """All files but what the processes say."""
        return {path: path.read_bytes() for path in run.out.rglob("*")
                if path.is_file() and path.suffix not in (".err", ".txt", ".lock")}

    def test_without_a_checkpoint(self):
        run = self.run_of_three(end_time="0.01").start("coupler", extra=RESTART)
        self.assert_ending(run, "coupler", BAD_INPUT, f"{run.out} holds no checkpoint")

    def test_of_another_case(self):
        run = self.run_of_three(end_time="0.01").start_all()
        self.assert_all_end(run, DONE)
        left = self.everything(run)
        run.settings.append("coupling.extrapolation_order=1")
        run.start_all(extra=RESTART)
        self.assert_all_end(run, BAD_INPUT, "coupling.extrapolation_order", "is 1, and was 0 in the checkpoint")
        self.assertEqual(self.everything(run), left, "nothing is touched")

    def test_of_a_damaged_checkpoint(self):
        run = self.run_of_three(end_time="0.01").start_all()
        self.assert_all_end(run, DONE)
        results, state = run.results(), run.out / "checkpoint/000001/coupler.state"
        whole = state.read_bytes()
        state.write_bytes(whole[:-1] + bytes([whole[-1] ^ 1]))
        run.start_all(extra=RESTART)
        self.assert_all_end(run, BAD_INPUT, "coupler.state", "is damaged: its checksum is another")
        self.assertEqual(run.results(), results)
        state.write_bytes(whole)
        self.assert_goes_on(run, results)

    def test_by_who_cannot(self):
        run = self.run_of_three(end_time="0.01").start_all()
        self.assert_all_end(run, DONE)
        run.programs["fluid"] = self.bin / "faulty_fluid"
        run.start_all(extra=RESTART)
        self.assert_all_end(run, BAD_INPUT, "faulty_fluid", "cannot go on from a checkpoint")

    def test_of_former_results(self):
        run = self.run_of_three(end_time="0.01").start_all()
        self.assert_all_end(run, DONE)
        before = run.results()
        run.start("coupler")
        self.assert_ending(run, "coupler", BAD_INPUT, f"{run.out}: error: holds the results of an earlier run: --overwrite")
        self.assertEqual(run.results(), before)
        run.start_all(extra=["--overwrite"])
        self.assert_all_end(run, DONE)
        self.assertEqual(run.results(), before)

    def test_of_a_run_that_is_at_its_end(self):
        run = self.run_of_three(end_time="0.01").start_all()
        self.assert_all_end(run, DONE)
        self.assert_goes_on(run, run.results())
        self.assert_ending(run, "coupler", DONE, "nothing to compute: the run is at t = 0.01 s")


@contextlib.contextmanager
def small_disk(folder, size):
    """A disk of its own for a folder; none for who may not mount one."""
    folder.mkdir()
    made = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", folder], capture_output=True)
    if made.returncode != 0:
        raise unittest.SkipTest("only root can mount a small disk")
    try:
        yield
    finally:
        subprocess.run(["umount", "-l", folder], check=True)


class NotWritten(RestartCase):
    def test_a_full_disk_costs_that_checkpoint_alone(self):
        expected = self.undisturbed(end_time="1")
        run = self.run_of_three(end_time="1", settings=["case.checkpoint_interval=0.05"])
        with small_disk(run.out / "checkpoint", "1M"):
            ballast = run.out / "checkpoint" / "ballast"
            run.start_all(extra=["--overwrite"])
            first = run.wait_for_checkpoint()
            with contextlib.suppress(OSError), open(ballast, "wb", buffering=0) as file:
                while True:
                    file.write(bytes(4096))
            run.wait_for_log(r"warning: no checkpoint at t = .*cannot write '.*\.state\.part': No space left", LIMIT)
            ballast.unlink()
            run.wait_for_checkpoint(beyond=first + 1)
            self.assert_all_end(run, DONE)
        self.assertEqual(run.results(), expected)

    def test_what_a_participant_says_of_it_is_told(self):
        run = self.run_of_three(fluid="faulty_fluid", end_time="0.03", settings=["case.checkpoint_interval=0.02"])
        run.start("coupler").start("solid").start("fluid", environment={"FAULT": "full checkpoint"})
        self.assert_ending(run, "coupler", DONE, "no checkpoint at t = 0.02 s: faulty_fluid: no space left")
        self.assertEqual(list((run.out / "checkpoint").iterdir()), [])

    def test_who_cannot_is_named_once_and_the_run_goes_on(self):
        run = self.run_of_three(fluid="faulty_fluid", end_time="0.03", settings=[SOME]).start_all()
        self.assert_all_end(run, DONE)
        text = (run.out / "coupler.err").read_text()
        self.assertEqual(text.count("faulty_fluid cannot write checkpoints: the run goes on without"), 1, text)
        self.assertFalse((run.out / "checkpoint").exists())


if __name__ == "__main__":
    ProcessCase.bin = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main(verbosity=2)
