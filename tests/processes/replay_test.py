"""A side that runs alone against the record of the other one does bit for bit what it did beside it.

    replay_test.py BUILD/bin CASES [unittest options]
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

from toryu.processes import BAD_INPUT, DONE

END_TIME = "0.002"
RECORD = "coupling.record='every_window'"


class Replay(unittest.TestCase):
    case = "elastic_gate"  # in the folder of cases
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="toryu_replay_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def launch(self, *arguments):
        package = pathlib.Path(__file__).resolve().parents[2] / "tools/toryu"
        return subprocess.run([sys.executable, "-I", "-X", "utf8", package, "launch", f"--bin={BIN}",
                               CASES / self.case, "--no-report", *map(str, arguments)], capture_output=True, text=True,
                              cwd=self.folder, timeout=120)

    def record(self, *settings, end_time=END_TIME):
        done = self.launch("--out=recorded", f"--end-time={end_time}", f"--set={RECORD}", *settings)
        self.assertEqual(done.returncode, DONE, done.stderr)

    def replay(self, side, *settings):
        out = f"replayed_{side}"
        return self.launch("--replay=recorded", f"--only={side}", f"--out={out}", f"--end-time={END_TIME}", *settings)

    def assert_same(self, side, *settings):
        done = self.replay(side, *settings)
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertIn("every answer is that of the record, bit for bit", done.stdout)
        self.assertEqual((self.folder / f"replayed_{side}/{side}.csv").read_bytes(),
                         (self.folder / f"recorded/{side}.csv").read_bytes())
        rows = np.genfromtxt(self.folder / f"replayed_{side}/replay.csv", delimiter=",", skip_header=1)
        self.assertGreater(len(rows), 10)
        self.assertFalse(rows[:, 1:].any())

    def test_of_either_side_is_bitwise(self):
        self.record()
        self.assert_same("solid")
        self.assert_same("fluid")

    def test_of_a_piece_that_crosses_the_side_of_the_domain_is_bitwise(self):
        self.case = pathlib.Path(__file__).resolve().parents[1] / "participants/flaps"
        places = ["--set=fluid.hole.1.min=[0.21875,0.109375]", "--set=fluid.hole.1.max=[0.25,0.140625]",
                  "--set=solid.region.1.box.min=[0.21875,0.109375]", "--set=solid.region.1.box.max=[0.25,0.140625]"]
        self.record(*places)
        self.assert_same("solid", *places)
        self.assert_same("fluid", *places)

    def test_of_sides_that_compute_at_once_is_bitwise(self):
        scheme = "--set=coupling.scheme=parallel_explicit"
        self.record(scheme)
        self.assert_same("solid", scheme)
        self.assert_same("fluid", scheme)

    def test_of_iterations_is_bitwise_to_the_solid_and_within_their_tolerance_to_the_fluid(self):
        scheme = "--set=coupling.scheme=serial_implicit"
        self.record(scheme)
        self.assert_same("solid", scheme)
        done = self.replay("fluid", scheme)
        self.assertEqual(done.returncode, DONE, done.stderr)
        with h5py.File(self.folder / "recorded/exchange.h5") as a, h5py.File(self.folder / "replayed_fluid/exchange.h5") as b:
            self.assertLess(np.abs(a["force"][:] - b["force"][:]).max(), 1e-3 * np.abs(a["force"][:]).max())

    def test_of_another_solid_is_not_the_same(self):
        self.record()
        done = self.replay("solid", "--set=solid.youngs_modulus=6e6")
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertIn("position: at most", done.stdout)
        self.assertIn("from window 1 on", done.stdout)

    def test_of_another_fluid_follows_the_motion_at_its_own_times(self):
        self.record()
        done = self.replay("fluid", "--set=coupling.fluid_steps_per_window=2")
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertIn("pressure: at most", done.stdout)
        with h5py.File(self.folder / "recorded/exchange.h5") as a, h5py.File(self.folder / "replayed_fluid/exchange.h5") as b:
            ends = [file["window_start"][:] + file["window_length"][:] for file in (a, b)]
            self.assertLess(len(ends[1]), len(ends[0]))
            tip = [file["position"][:, 0, 0] for file in (a, b)]
            moved = np.ptp(tip[0])
            self.assertLess(np.abs(np.interp(ends[1], ends[0], tip[0]) - tip[1]).max(), 0.02 * moved)

    def test_goes_on_from_a_checkpoint_as_the_record_does(self):
        checkpoints = "--set=case.checkpoint_interval=0.0005"
        self.record(checkpoints, end_time=0.001)
        done = self.replay("solid", checkpoints, "--end-time=0.001")
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.record(checkpoints, "--restart")
        done = self.replay("solid", checkpoints, "--restart")
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertIn("bit for bit", done.stdout)
        with h5py.File(self.folder / "recorded/exchange.h5") as a, h5py.File(self.folder / "replayed_solid/exchange.h5") as b:
            np.testing.assert_array_equal(a["position"][:], b["position"][:])

    def test_says_what_is_wrong(self):
        self.record(end_time=0.001)
        for arguments, words in [
                (["--replay=recorded"], "say which side runs: --only solid or --only fluid"),
                (["--only=solid"], "--only: error: is the side of a --replay RESULTS that runs"),
                (["--replay=nowhere", "--only=solid"], "--replay nowhere: error: holds no exchange.h5"),
                (["--replay=recorded", "--only=solid", "--fluid=/bin/true"], "with --only solid the fluid is the record's"),
                (["--replay=recorded", "--only=solid", "--out=recorded"], "--out recorded: error: is the record itself"),
                (["--replay=recorded", "--only=fluid", "--end-time=0.5"], "the record ends at t = 0.001 s, before"),
                (["--replay=recorded", "--only=fluid", "--end-time=0.0005", "--set=fluid.spacing=0.0025"],
                 "record with the coarser fluid"),
                (["--replay=recorded", "--only=solid", "--end-time=0.0005", "--set=solid.spacing=0.0025"],
                 "to the particles for which it was recorded")]:
            with self.subTest(arguments):
                done = self.launch(*arguments)
                self.assertEqual(done.returncode, BAD_INPUT, done.stderr)
                self.assertIn(words, done.stderr)
                self.assertNotIn("Traceback", done.stderr)


if __name__ == "__main__":
    BIN, CASES = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
