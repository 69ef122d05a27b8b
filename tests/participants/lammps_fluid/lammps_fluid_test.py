"""lammps_fluid against fluid_solver: alone, beside a solid, over several ranks, and when a rank dies.

    PYTHONPATH=tools:tests lammps_fluid_test.py BUILD/bin [CLASS]
"""
import csv
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from toryu.processes import BAD_INPUT, DONE, INTERRUPTED, PEER_LOST, PHYSICS_FAILED
from toryu_testing import trio

LIMIT = 30  # [s] after which something that should have ended counts as hung
ROOT = pathlib.Path(__file__).resolve().parents[3]
CASES = ROOT / "cases"
BIN = pathlib.Path(sys.argv.pop(1)).resolve() if __name__ == "__main__" else None


def run(program, case, out, settings=(), ranks=1, limit=600):
    command = [BIN / program, case, "--out", out]
    for setting in settings:
        command += ["--set", setting]
    return subprocess.run(command, capture_output=True, text=True, timeout=limit,
                          env=os.environ | {"RANKS": str(ranks), "OMP_NUM_THREADS": "1"})


def column(path, name):
    with open(path, encoding="utf-8") as file:
        return [float(row[name]) for row in csv.DictReader(file)]


def processes_with(text):
    """Process numbers of all whose command has `text` in it."""
    found = []
    for folder in pathlib.Path("/proc").iterdir():
        if folder.name.isdigit() and int(folder.name) != os.getpid():
            try:
                command = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
            except OSError:
                continue
            if text in command:
                found.append((int(folder.name), command))
    return found


class WithFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="toryu_")
        self.addCleanup(folder.cleanup)
        self.out = pathlib.Path(folder.name)

    def both(self, case, *settings):
        """The series of either program for the same case."""
        for program in ("lammps_fluid", "fluid_solver"):
            done = run(program, CASES / case, self.out / program, settings)
            self.assertEqual(done.returncode, DONE, done.stderr)
        return self.out / "lammps_fluid/fluid.csv", self.out / "fluid_solver/fluid.csv"


class Alone(WithFolder):
    def test_front_of_a_dam_break_is_that_of_fluid_solver(self):
        ours, theirs = self.both("dam_break", "fluid.spacing=0.0028575", "case.end_time=0.2")
        for found, expected in zip(column(ours, "front_x[m]"), column(theirs, "front_x[m]"), strict=True):
            self.assertAlmostEqual(found, expected, delta=0.005 * expected)

    def test_water_at_rest_presses_as_in_fluid_solver(self):
        ours, theirs = self.both("hydrostatic_tank", "case.end_time=2")
        found, expected = (column(path, "pressure_at_half_depth[Pa]")[-1] for path in (ours, theirs))
        self.assertAlmostEqual(found, expected, delta=0.001 * expected)
        self.assertAlmostEqual(found, 1000 * 9.81 * 0.5, delta=0.01 * found)
        self.assertLess(column(ours, "largest_speed[m/s]")[-1], 0.02)

    def test_each_way_to_compute_is_that_of_fluid_solver_but_for_rounding(self):
        # half of the tank is full: water collapses; its walls are whole numbers of spacings
        common = ("fluid.region.water.box.max=[0.5, 1.0]", "case.end_time=0.1")
        for settings in (("fluid.integrator=symplectic", "fluid.kernel=wendland_c2", "fluid.smoothing_ratio=1.5"),
                         ("fluid.density_diffusion.gradient=none", "fluid.wall_model.slip=free_slip"),
                         ("fluid.artificial_viscosity=false", "fluid.laminar_viscosity.dynamic_viscosity=10.0",
                          "fluid.wall_model.suction=false"),
                         ("fluid.artificial_viscosity.beta=1.0", "fluid.stiffness_exponent=1")):
            with self.subTest(settings), tempfile.TemporaryDirectory(prefix="toryu_") as folder:
                self.out = pathlib.Path(folder)
                ours, theirs = self.both("hydrostatic_tank", *common, *settings)
                for name in ("kinetic_energy[J/m]", "potential_energy[J/m]", "pressure_at_half_depth[Pa]"):
                    found, expected = column(ours, name)[-1], column(theirs, name)[-1]
                    self.assertAlmostEqual(found, expected, delta=1e-9 * abs(expected), msg=name)

    def test_bits_do_not_depend_on_the_number_of_ranks(self):
        found = set()
        for ranks in (1, 2, 3):
            done = run("lammps_fluid_mpirun", CASES / "dam_break", self.out / str(ranks),
                       ("fluid.spacing=0.0028575", "case.end_time=0.1"), ranks)
            self.assertEqual(done.returncode, DONE, done.stderr)
            found.add((self.out / str(ranks) / "fluid.csv").read_bytes())
        self.assertEqual(len(found), 1)

    def test_what_it_does_not_know_is_refused_by_name(self):
        for setting, word in (("fluid.particle_shifting={}", "particle_shifting"), ("case.periodic=x", "periodic"),
                              ("fluid.wall_model.extrapolation=fit", "extrapolation"), ("fluid.model=implicit", "model"),
                              ("fluid.limits.largest_energy_gain=2.0", "largest_energy_gain"),
                              ("wall.floor.work_piece=true", "work_piece")):
            with self.subTest(setting):
                done = run("lammps_fluid", CASES / "dam_break", self.out, [setting])
                self.assertEqual(done.returncode, BAD_INPUT, done.stderr)
                self.assertIn(word, done.stderr)
                self.assertIn("error", done.stderr)
                self.assertFalse((self.out / "fluid.csv").exists())

    def test_a_shape_that_it_does_not_know_is_refused_with_its_place(self):
        (self.out / "case.toml").write_text((CASES / "dam_break/case.toml").read_text().replace(
            "box = { min = [-0.01, 0.0], max = [0.0, 0.20] }", "circle = { centre = [0.0, 0.0], radius = 0.01 }"))
        done = run("lammps_fluid", self.out, self.out / "results", ["reference=[]"])
        self.assertEqual(done.returncode, BAD_INPUT)
        self.assertRegex(done.stderr, r"case\.toml:18:\d+: error: lammps_fluid does not know 'circle'")

    def test_physics_that_fails_is_said(self):
        for ranks in (1, 2):
            done = run("lammps_fluid_mpirun", CASES / "dam_break", self.out, ["fluid.limits.largest_speed=0.2"], ranks)
            self.assertEqual(done.returncode, PHYSICS_FAILED, done.stderr)
            self.assertRegex(done.stderr, r"fluid particle \d+ at t = \S+ s: speed = 0\.2\S* m/s, limit 0\.2 m/s")


class Coupled(unittest.TestCase):
    def run_of_three(self, ranks, **settings):
        os.environ["RANKS"] = str(ranks)
        return trio.Trio({"coupler": BIN / "coupler", "fluid": BIN / "lammps_fluid_mpirun", "solid": BIN / "fake_solid"},
                         **settings)

    def assert_ending(self, trio_run, name, code, word=""):
        found, text = trio_run.ending_of(name, LIMIT)
        self.assertEqual(found, code, f"{name}: {text}")
        self.assertIn(word, text)

    def assert_nothing_left(self, out):
        end = time.monotonic() + 5
        while (left := processes_with(str(out))) and time.monotonic() < end:
            time.sleep(0.1)
        self.assertEqual(left, [])

    def test_bits_do_not_depend_on_the_number_of_ranks(self):
        results = []
        for ranks in (1, 2, 3):
            with self.run_of_three(ranks, end_time="0.03") as three:
                three.start_all()
                for name in trio.ROLES:
                    self.assert_ending(three, name, DONE)
                results.append(three.results())
        self.assertIn("interface.h5:force", results[0])
        self.assertEqual(results[1], results[0])
        self.assertEqual(results[2], results[0])

    def test_a_rank_that_dies_ends_the_run(self):
        for rank in ("0", "1"):
            with self.subTest(rank), self.run_of_three(2) as three:
                three.start_all().wait_until_running()
                pids = [pid for pid, command in processes_with(str(three.out)) if command.startswith(str(BIN / "lammps_fluid "))]
                of_rank = {environment(pid)["OMPI_COMM_WORLD_RANK"]: pid for pid in pids}
                self.assertEqual(sorted(of_rank), ["0", "1"])
                start = time.monotonic()
                os.kill(of_rank[rank], signal.SIGKILL)
                self.assert_ending(three, "fluid", PEER_LOST, "a rank was ended by signal 9")
                self.assert_ending(three, "coupler", PEER_LOST, "lammps_fluid")
                self.assert_ending(three, "solid", PEER_LOST, "lammps_fluid")
                self.assertLess(time.monotonic() - start, 8)
                self.assert_nothing_left(three.out)

    def test_an_interruption_leaves_nothing_behind(self):
        with self.run_of_three(2) as three:
            three.start_all().wait_until_running()
            three.signal("fluid", signal.SIGINT)
            for name in trio.ROLES:
                self.assert_ending(three, name, INTERRUPTED)
            self.assert_nothing_left(three.out)


class Gate(WithFolder):
    def test_the_tip_bends_as_far_as_with_fluid_solver(self):
        peaks = {}
        for name, more in (("fluid_solver", []), ("lammps_fluid", ["--fluid", BIN / "lammps_fluid"])):
            out = self.out / name
            done = subprocess.run(["/usr/bin/python3", "-I", "-X", "utf8", ROOT / "tools/toryu", "launch", CASES / "elastic_gate",
                                   "--bin", BIN, "--out", out, "--end-time", "0.12", "--no-report", *more],
                                  capture_output=True, text=True, env=os.environ | {"OMP_NUM_THREADS": "1"})
            self.assertEqual(done.returncode, DONE, done.stdout + done.stderr)
            peaks[name] = max(column(out / "solid.csv", "tip_displacement_x[m]"))
            self.assertLess(max(column(out / "coupler.csv", "impulse_error[1]")), 1e-12)
        self.assertAlmostEqual(peaks["lammps_fluid"], peaks["fluid_solver"], delta=0.003 * peaks["fluid_solver"])


def environment(pid):
    return dict(item.split("=", 1) for item in pathlib.Path(f"/proc/{pid}/environ").read_text().split("\0") if "=" in item)


if __name__ == "__main__":
    unittest.main(verbosity=2)
