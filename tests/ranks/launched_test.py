"""Whole runs whose fluid is computed over MPI ranks leave what those of one process leave, bit for bit, and end as they do.

    launched_test.py BUILD/bin CASES [unittest options]
"""
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import h5py

from toryu.processes import BAD_INPUT, DONE, INTERRUPTED, PEER_LOST, PHYSICS_FAILED
from toryu.program import PACKAGE

LIMIT = 240  # seconds after which something that should have ended counts as hung
BIN, CASES = map(pathlib.Path, sys.argv[1:3])
DAM = ["dam_break", "--set", "fluid.spacing=0.0028575", "--set", "case.series_interval=0.002", "--set",
       "case.frame_interval=0.01", "--end-time", "0.04"]
GATE = ["elastic_gate", "--set", "fluid.spacing=0.0025", "--set", "solid.spacing=0.0025", "--end-time", "0.02"]


SHORT = ["--set", "case.series_interval=0.004", "--end-time", "0.012"]
COARSE_DAM = ["dam_break", "--set", "fluid.spacing=0.0028575", *SHORT]
# Of each term and kind of space a case that has it.
TERMS = {
    "wall repulsion": [*COARSE_DAM, "--set", "fluid.wall_repulsion={}"],
    "shifting": [*COARSE_DAM, "--set", "fluid.particle_shifting={}"],
    "tensile control": [*COARSE_DAM, "--set", "fluid.tensile_control={}"],
    "consistent gradients": [*COARSE_DAM, "--set", "fluid.consistent_gradients={}", "--set",
                             "fluid.particle_shifting={}"],
    "surface tension": [*COARSE_DAM, "--set", "fluid.surface_tension={coefficient=0.5}"],
    "a power law beside walls": ["poiseuille/power_law.toml", *SHORT],
    "periods of both axes": ["taylor_green", *SHORT],
    "gravity along a period": ["poiseuille", *SHORT[:-1], "0.1"],
    "fits through faces": ["poiseuille", *SHORT, "--set", "fluid.wall_model.extrapolation=fit"],
    "slip along walls": ["poiseuille", *SHORT, "--set", "fluid.wall_slip={coefficient=0.001}"],
    "held volume": ["lid_driven_cavity/re_400.toml", "--set", "fluid.spacing=0.05", "--set", "case.series_interval=0.05",
                    "--end-time", "0.5"],
    "pressed walls of an enclosed medium": [
        "abrasive_throat/pressed.toml", "--set", "fluid.spacing=0.0004", "--set", "wall.5.press.travel=[-1e-6, 0.0]", "--set",
        "case.series_interval=0.002", "--end-time", "0.02"],
    "viscoelasticity": ["viscoelastic_channel", "--set", "fluid.spacing=0.1", "--set", "case.series_interval=0.2",
                        "--end-time", "2"],
    "viscoelasticity that shifts": ["viscoelastic_channel", "--set", "fluid.spacing=0.1", "--set", "fluid.particle_shifting={}",
                                    "--set", "fluid.integrator=midpoint", "--set", "case.series_interval=0.2", "--end-time", "1"],
    "friction on work pieces and what it removes": ["abrasive_flow/rigid.toml", "--set", "case.series_interval=0.01",
                                                    "--end-time", "0.05"],
    "removal by slip in an enclosed medium": ["abrasive_slip", "--set", "fluid.spacing=0.0002", "--set",
                                              "case.series_interval=0.0005", "--end-time", "0.003"],
    "a moving wall": ["retreating_piston", *SHORT[:-1], "0.1"],
    "a disc that turns, and takes a moment": ["turning_disc", "--set", "case.series_interval=0.002", "--end-time", "0.02"],
    "a tank that turns": ["sloshing_tank", "--set", "case.series_interval=0.05", "--end-time", "0.3"],
    "gravity that changes": [*COARSE_DAM, "--set", "case.gravity_change.acceleration=[[0, 0, 0], [0.006, 3, 1], [1, 3, 1]]"],
}


def launch(out, case, *options, threads={"OMP_NUM_THREADS": "1"}):
    name, *more = case
    command = [sys.executable, "-I", "-X", "utf8", PACKAGE, "launch", CASES / name, "--out", out, "--bin", BIN, "--no-report",
               *more, *options]
    return subprocess.Popen(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                            process_group=0, env=os.environ | threads)


def end_of(run, limit=LIMIT):
    try:
        text = run.communicate(timeout=limit)[0]
    except subprocess.TimeoutExpired:
        os.killpg(run.pid, signal.SIGKILL)
        raise AssertionError(f"it hangs: {run.communicate()[0]}") from None
    return run.returncode, text


def datasets(path):
    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.update({name: item[()].tobytes()}) if isinstance(item, h5py.Dataset)
                        and item.dtype.kind in "fiu" else None)
    return found


def results(out):
    """The content of the solvers' series and of all frames; the coupler's has times of the clock."""
    return {path.name: path.read_bytes() for path in out.glob("*.csv") if path.name != "coupler.csv"} | {
        path.name: datasets(path) for path in [*(out / "frames").iterdir(), *out.glob("surface.h5")]}


def ranks_of(out):
    """Process -> its rank, of the fluid that writes into `out`."""
    found = {}
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (folder / "cmdline").read_bytes().decode().split("\0")
            if pathlib.Path(words[0]).name == "fluid_solver" and f"--out={out}" in words:
                variables = (folder / "environ").read_bytes().decode(errors="replace")
                if rank := re.search(r"OMPI_COMM_WORLD_RANK=(\d+)", variables):
                    found[int(folder.name)] = int(rank[1])
        except OSError:
            continue  # it ended
    return found


class OverRanks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="toryu_ranks_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def done(self, name, case, *options):
        code, text = end_of(launch(self.folder / name, case, *options))
        self.assertEqual(code, DONE, text)
        return results(self.folder / name)

    def expect_the_same(self, found, expected):
        self.assertEqual(sorted(found), sorted(expected))
        self.assertIn("fluid.csv", found)
        for name, content in expected.items():
            self.assertEqual(found[name], content, name)

    def begin(self, count, *options, **environment):
        """A run of some seconds over `count` ranks that has begun."""
        out = pathlib.Path(tempfile.mkdtemp(dir=self.folder)) / "run"
        run = launch(out, [*DAM[:-1], "4"], "--ranks", str(count), *options, **environment)
        self.addCleanup(run.communicate)
        self.addCleanup(run.kill)
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and run.poll() is None:
            if list(out.glob("fluid.csv*")) and len(ranks_of(out)) == count:
                return run, out
            time.sleep(0.05)
        self.fail(f"it has not begun: {end_of(run, 1)}")

    def expect_none_left(self, out):
        deadline = time.monotonic() + 10
        while ranks_of(out) and time.monotonic() < deadline:
            time.sleep(0.1)
        self.assertEqual(ranks_of(out), {})


class Alone(OverRanks):
    def test_leaves_what_one_process_leaves(self):
        expected = self.done("one", DAM)
        self.assertGreater(len(expected), 5)
        for count in "23":
            self.expect_the_same(self.done(count, DAM, "--ranks", count), expected)

    def test_goes_on_over_another_number_of_ranks(self):
        checkpoints = ["--set", "case.checkpoint_interval=0.02"]
        expected = self.done("whole", DAM, *checkpoints)
        half = [*DAM[:-1], "0.02"]
        for first, then in (("2", "3"), ("3", "1"), ("1", "2"), ("4", "2")):
            out = self.folder / f"from_{first}"
            for case, more in ((half, []), (DAM, ["--restart"])):
                code, text = end_of(launch(out, case, *checkpoints, "--ranks", then if more else first, *more))
                self.assertEqual(code, DONE, text)
            self.expect_the_same(results(out), expected)

    def test_fails_by_the_same_particle(self):
        told = []
        for count in "123":
            code, text = end_of(launch(self.folder / count, DAM, "--set", "fluid.limits.largest_speed=0.4", "--ranks", count))
            self.assertEqual(code, PHYSICS_FAILED, text)
            told.append(re.search(r"fluid particle \d+ at t = .*", text)[0])
        self.assertEqual(told[1:], told[:1] * 2)

    def test_refuses_what_rank_0_alone_finds(self):
        for count in "13":
            code, text = end_of(launch(self.folder / "run", DAM[:1], "--ranks", count, "--set", "fluid.spacing=0.5", "--check"), 60)
            self.assertEqual(code, BAD_INPUT, text)
            self.assertIn("holds no particle at this spacing", text)

    def test_takes_the_threads_that_were_asked_for_on_each_rank(self):
        _, out = self.begin(2, "--threads", "1", threads={"OMP_NUM_THREADS": str(os.cpu_count() + 2)})
        tasks = {rank: len(os.listdir(f"/proc/{process}/task")) for process, rank in ranks_of(out).items()}
        self.assertLessEqual(tasks[1], tasks[0])

    def test_refuses_what_does_not_go(self):
        code, text = end_of(launch(self.folder / "run", DAM, "--ranks", "2", "--set", "fluid.model=implicit", "--check"))
        self.assertEqual(code, BAD_INPUT, text)
        self.assertIn("the implicit model does not go over ranks: start the case in one process", text)

    def test_refuses_removal_where_the_medium_sticks(self):
        code, text = end_of(launch(self.folder / "run", ["parallel_slits"], "--ranks", "2", "--check"))
        self.assertEqual(code, BAD_INPUT, text)
        self.assertIn("[fluid.removal] of a medium that sticks to its walls does not go over ranks", text)

    def test_refuses_no_number_and_no_fluid(self):
        for case, count, words in ((DAM, "0", "must be a number of processes, 1 or more"), (DAM, "two", "must be a number"),
                                   (["shaken_beam"], "2", "the case has no fluid")):
            code, text = end_of(launch(self.folder / "run", case, "--ranks", count, "--check"))
            self.assertEqual(code, BAD_INPUT, text)
            self.assertIn(words, text)


class Terms(OverRanks):
    def test_leave_what_one_process_leaves(self):
        for number, (name, case) in enumerate(TERMS.items()):
            with self.subTest(name):
                expected = self.done(f"{number}_one", case)
                self.expect_the_same(self.done(f"{number}_over", case, "--ranks", "3"), expected)


class Ends(OverRanks):
    def test_a_killed_rank_ends_all_and_is_named(self):
        for victim in (1, 0):
            run, out = self.begin(3)
            process = next(process for process, rank in ranks_of(out).items() if rank == victim)
            os.kill(process, signal.SIGKILL)
            killed = time.monotonic()
            code, text = end_of(run, 30)
            self.assertEqual(code, PEER_LOST, text)
            self.assertLess(time.monotonic() - killed, 10)
            self.assertIn(f"rank {victim} of 3 was ended by signal 9 (Killed)", text)
            self.expect_none_left(out)

    def test_an_interruption_ends_all_in_order(self):
        run, out = self.begin(2, "--set", "case.checkpoint_interval=0.01")
        os.kill(run.pid, signal.SIGINT)
        code, text = end_of(run, 60)
        self.assertEqual(code, INTERRUPTED, text)
        self.assertTrue(list(out.glob("checkpoint/*/manifest.toml")), text)
        self.expect_none_left(out)


class Coupled(OverRanks):
    def test_leaves_what_one_process_leaves(self):
        for scheme in ("serial_robin", "serial_implicit"):
            case = [*GATE, "--set", f"coupling.scheme={scheme}"]
            if scheme == "serial_implicit":
                case[-3] = "0.004"
            expected = self.done(f"{scheme}_one", case)
            for count in "234":
                self.expect_the_same(self.done(f"{scheme}_{count}", case, "--ranks", count), expected)

    def test_rubs_on_the_solid_as_one_process_does(self):
        case = ["abrasive_flow", "--set", "case.series_interval=0.01", "--end-time", "0.03"]
        expected = self.done("one", case)
        self.assertIn("surface.h5", expected)
        for count in "24":
            self.expect_the_same(self.done(count, case, "--ranks", count), expected)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
