"""Checks that an executable is a good participant of a coupled run:

    PYTHONPATH=tools:tests conformance.py --bin BUILD/bin ROLE EXECUTABLE [--case CASE]

ROLE is fluid or solid. The real coupler and the stand-in for the other side play with it; the coupler itself
refuses a wrong window, a wrong count and a value that is not finite.
"""
import argparse
import csv
import pathlib
import shutil
import signal
import subprocess
import sys
import unittest

import h5py

from toryu.processes import BAD_INPUT, DONE, INTERRUPTED, PEER_LOST
from toryu_testing import trio

LIMIT = 30  # seconds after which something that should have ended counts as hung
arguments = None


def run_of_three(**settings):
    bin_folder = pathlib.Path(arguments.bin)
    programs = {"coupler": bin_folder / "coupler", "fluid": bin_folder / "fake_fluid",
                "solid": bin_folder / "fake_solid"}
    programs[arguments.role] = arguments.executable
    return trio.Trio(programs, case=arguments.case, **settings)


class Conformance(unittest.TestCase):
    def setUp(self):
        self.role = arguments.role
        self.other = {"fluid": "solid", "solid": "fluid"}[self.role]

    def assert_ending(self, run, name, code, *words):
        found, text = run.ending_of(name, LIMIT)
        self.assertEqual(found, code, f"{name}: {text}")
        for word in words:
            self.assertIn(word, text)

    def test_runs_to_the_end(self):
        with run_of_three(end_time="0.02") as run:
            run.start_all()
            for name in trio.ROLES:
                self.assert_ending(run, name, DONE)
            with open(run.out / "coupler.csv") as file:
                rows = list(csv.DictReader(file))
            self.assertAlmostEqual(float(rows[-1]["time[s]"]), 0.02)
            windows = [float(row["window[1]"]) for row in rows]
            self.assertEqual(windows, sorted(set(windows)))
            self.assertLess(max(float(row["impulse_error[1]"]) for row in rows), 1e-12)
            with h5py.File(run.out / "interface.h5") as file:
                self.assertEqual(file["position"].shape, file["force"].shape)
                self.assertGreater(abs(file["force"][-1]).max(), 0)

    def test_waits_for_the_others_to_start(self):
        with run_of_three(end_time="0.002") as run:
            run.start(self.role)
            run.start(self.other).start("coupler")
            for name in trio.ROLES:
                self.assert_ending(run, name, DONE)

    def test_goes_on_from_a_checkpoint(self):
        said = subprocess.run([arguments.executable, "--can-checkpoint"], capture_output=True, text=True)
        if said.stdout != "yes\n":
            self.skipTest("it cannot write checkpoints")
        with run_of_three(end_time="0.02", settings=["case.checkpoint_interval=0.01"]) as run:
            run.start_all()
            for name in trio.ROLES:
                self.assert_ending(run, name, DONE)
            expected = run.results()
            shutil.rmtree(run.out / f"checkpoint/{run.wait_for_checkpoint():06}")  # that at the end
            run.start_all(extra=["--restart"])  # from that in the middle
            for name in trio.ROLES:
                self.assert_ending(run, name, DONE)
            found = run.results()
            self.assertEqual(sorted(found), sorted(expected))
            for name, content in expected.items():
                self.assertEqual(found[name], content, name)

    def test_ends_when_the_run_is_interrupted(self):
        with run_of_three() as run:
            run.start_all().wait_until_running()
            run.signal("coupler", signal.SIGINT)
            for name in trio.ROLES:
                self.assert_ending(run, name, INTERRUPTED)

    def test_its_interruption_ends_the_run(self):
        with run_of_three() as run:
            run.start_all().wait_until_running()
            run.signal(self.role, signal.SIGINT)
            for name in trio.ROLES:
                self.assert_ending(run, name, INTERRUPTED)

    def test_ends_when_the_coupler_dies(self):
        with run_of_three() as run:
            run.start_all().wait_until_running()
            run.kill("coupler")
            self.assert_ending(run, self.role, PEER_LOST, "coupler")
            self.assert_ending(run, self.other, PEER_LOST, "coupler")

    def test_ends_when_the_other_side_dies(self):
        with run_of_three() as run:
            run.start_all().wait_until_running()
            run.kill(self.other)
            self.assert_ending(run, self.role, PEER_LOST, f"fake_{self.other}")
            self.assert_ending(run, "coupler", PEER_LOST, f"fake_{self.other}")

    def test_is_refused_with_another_case(self):
        with run_of_three() as run:
            run.start("coupler")
            run.start(self.role, extra=["--set", "case.gravity=[0.0, -1.6]"])
            run.start(self.other)
            for name in trio.ROLES:
                self.assert_ending(run, name, BAD_INPUT, "hash of the case")

    def test_is_refused_if_its_part_is_taken(self):
        with run_of_three() as run:
            run.start_all().wait_until_running()
            run.start(self.role, name="second")
            self.assert_ending(run, "second", BAD_INPUT, "this part")
            run.wait_until_running(beyond=run.windows())  # the run goes on
            run.signal("coupler", signal.SIGINT)
            for name in trio.ROLES:
                self.assert_ending(run, name, INTERRUPTED)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", required=True, help="folder of coupler, fake_fluid and fake_solid")
    parser.add_argument("--case", default=trio.CASE, help="a coupled case that the executable can compute")
    parser.add_argument("role", choices=["fluid", "solid"])
    parser.add_argument("executable")
    arguments, rest = parser.parse_known_args()
    unittest.main(argv=[sys.argv[0], *rest], verbosity=2)
