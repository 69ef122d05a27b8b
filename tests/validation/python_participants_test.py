"""The example participants in Python against exact solutions and against solid_solver:

    PYTHONPATH=tools:tests:examples:BUILD/bin python_participants_test.py BUILD/bin
"""

import math
import pathlib
import sys
import tempfile
import unittest

import numpy as np

import beam
import toryu
from toryu.participant import Load

BIN = pathlib.Path(sys.argv.pop(1)) if __name__ == "__main__" else None
ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
LENGTH, HEIGHT, DENSITY = 0.079, 0.005, 1100.0  # the elastic gate [m], [m], [kg/m3]
BENDING = 12e6 / (1 - 0.4 ** 2) * HEIGHT ** 3 / 12  # E'I [N m]
GATE = {"region": [{"box": {"min": [0.1, 0.0], "max": [0.105, LENGTH]}}], "density": DENSITY, "youngs_modulus": 12e6,
        "poissons_ratio": 0.4, "spacing": 0.00125, "clamp": [{"box": {"min": [0.1, LENGTH], "max": [0.105, 0.0865]}}]}

# A piston on a spring that closes a tank of water, 0.03 m deep; the added mass of the water is ten times its own.
DEPTH, MASS, STIFFNESS = 0.03, 0.05, 6e4  # [m], [kg/m], [N/m2]
PISTON = f"""#!/usr/bin/python3
import numpy as np
from toryu.participant import Interface, Motion, Solid

class Piston(Solid):
    state = ("q", "v")
    q = v = 0.0

    def begin(self, reach):
        self.x = np.stack([np.full(30, 0.1005), 0.001 * (np.arange(30) + 0.5)], axis=1)
        return Interface(self.x, np.full(30, 1e-6), np.tile([-0.001, 0.0], (30, 1)), np.full(30, {MASS} / 30), 0.001)

    def advance(self, window, load):
        dt, z = window.dt, -load.impedance[:, 0]
        force = load.force[:, 0].sum() + (z * (load.velocity[:, 0] - self.v)).sum() - {STIFFNESS} * (self.q + dt / 2 * self.v)
        change = dt * force / ({MASS} + dt / 2 * z.sum() + dt ** 2 / 4 * {STIFFNESS})
        moved = dt * (self.v + change / 2)
        self.q, self.v = self.q + moved, self.v + change
        along = np.array([1.0, 0.0])
        impulse = z * (load.velocity[:, 0] * dt - moved)
        return Motion(self.x + self.q * along, np.tile(self.v * along, (30, 1)), impulse[:, None] * along,
                      impulse.sum() * moved / dt)

    def observe(self):
        return {{"q[m]": self.q}}

Piston.main()
"""


def beam_of(links, **changes):
    beam.LINKS = links
    made = beam.Beam({"case": {"gravity": [0.0, 0.0]}, "solid": GATE | changes})
    made.begin(1.0)
    return made


def load_at_the_tip(made, force):
    """Shared by the last row of particles, half a spacing from the end [N/m]."""
    last = np.isclose(made.x.imag, made.x.imag.min())
    return Load(None, np.outer(last / last.sum(), [force, 0.0]))


def step(made, dt, load):
    """Of a beam under a constant force, without an impedance."""
    none = np.zeros(len(made.x))
    made.step(dt, beam.numbers(load.force), none, none, none)


def crossings(times, values):
    """When a series rises through its mean, by linear interpolation."""
    y = values - values.mean()
    k = np.flatnonzero((y[:-1] < 0) & (y[1:] >= 0))
    return times[k] - y[k] * (times[k + 1] - times[k]) / (y[k + 1] - y[k])


class Cantilever(unittest.TestCase):
    def test_the_tip_under_a_small_load_is_of_second_order(self):
        place = LENGTH - 0.5 * LENGTH / 63  # of the load
        force = 1e-3
        exact = force * place ** 2 * (3 * LENGTH - place) / (6 * BENDING)
        errors = []
        for links in (5, 10, 20, 40):
            made = beam_of(links)
            made.phi = np.linalg.solve(made.K, np.real(
                np.conj(1j) * (made.C.conj().T @ (beam.numbers(load_at_the_tip(made, force).force) / made.t_0))))
            errors.append(abs(made.observe()["tip_displacement_x[m]"] / exact - 1))
        self.assertLess(errors[2], 0.0015)
        for coarse, fine in zip(errors, errors[1:]):
            self.assertAlmostEqual(math.log2(coarse / fine), 2, delta=0.2)

    def test_its_period(self):
        """The first period of a slender cantilever with its rotary inertia: 0.08 % longer than without."""
        made = beam_of(20)
        exact = 2 * math.pi * (LENGTH / 1.8751041) ** 2 * math.sqrt(DENSITY * HEIGHT / BENDING)
        squares, modes = np.linalg.eig(np.linalg.solve(made.inertia(), made.K))
        made.phi = 1e-4 * modes[:, squares.argmin()]
        dt, none = exact / 100, load_at_the_tip(made, 0.0)
        tip = []
        for _ in range(450):
            step(made, dt, none)
            tip.append(made.observe()["tip_displacement_x[m]"])
        rises = crossings(dt * np.arange(400), np.array(tip[:400]))
        self.assertAlmostEqual(np.diff(rises).mean() / exact, 1.0018, delta=0.0005)

    def test_it_keeps_its_length_and_its_energy(self):
        made = beam_of(20)
        push = load_at_the_tip(made, 15.0)
        for _ in range(200):
            step(made, 1e-4, push)
        energy = lambda: made.health().kinetic_energy + made.health().potential_energy
        start = energy()
        self.assertGreater(made.observe()["tip_displacement_y[m]"], 0.001)
        none = load_at_the_tip(made, 0.0)
        for _ in range(400):
            step(made, 1e-4, none)
        self.assertAlmostEqual(energy() / start, 1, delta=0.01)


class Runs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_case(self, case, set, *options):
        return toryu.run(ROOT / case, set, self.folder / "out", [f"--bin={BIN}", "--no-report", *options])

    def test_a_piston_with_ten_times_its_mass_of_water(self):
        piston = self.folder / "piston.py"
        piston.write_text(PISTON)
        piston.chmod(0o755)
        run = self.run_case("tests/participants/strip", {"case.end_time": 0.2, "case.series_interval": 0.0, "fluid.density": 1000.0,
                                                         "fluid.region.water.box.max": [0.1, DEPTH]},
                            f"--fluid={EXAMPLES / 'hydrostatic_fluid.py'}", f"--solid={piston}")
        q = run.series("solid")
        depth = DEPTH - 0.001 * (np.arange(30) + 0.5)
        added = 0.001 * 7 / 8 * 1000 * np.sqrt(DEPTH * depth).sum()
        exact = 2 * math.pi * math.sqrt((MASS + added) / STIFFNESS)
        self.assertAlmostEqual(np.diff(crossings(q["time"], q["q"])).mean() / exact, 1, delta=0.001)
        rest = 1000 * 9.81 * 0.001 * depth.sum() / STIFFNESS
        self.assertAlmostEqual(q["q"].max() / (2 * rest), 1, delta=0.001)  # released at 0, it swings to twice its rest
        self.assertLess(run.summaries()["coupler"]["figures"]["largest_impulse_error"], 1e-12)

    def test_a_stiff_gate_bends_under_the_formula_as_a_beam(self):
        """The tip swings about its rest under rho g (H - L + s) at s from the clamp."""
        run = self.run_case("cases/elastic_gate", {"case.end_time": 0.08, "case.series_interval": 1e-4,
                                                   "solid.youngs_modulus": 1.2e9},
                            f"--fluid={EXAMPLES / 'hydrostatic_fluid.py'}")
        series = run.series("solid")
        time, tip = series["time"], series["tip_displacement_x"]
        rest = 9810 * ((0.14 - LENGTH) * LENGTH ** 4 / 8 + 11 * LENGTH ** 5 / 120) / (100 * BENDING)
        begin, *_, end = np.searchsorted(time, crossings(time, tip))
        self.assertAlmostEqual(tip[begin:end].mean() / rest, 1, delta=0.015)

    def test_the_gate_with_the_beam_opens_as_with_the_solid_solver(self):
        coarse = {"fluid.spacing": 0.0025, "case.end_time": 0.11}
        own = self.run_case("cases/elastic_gate", coarse).series("solid")
        other = self.run_case("cases/elastic_gate", coarse, f"--solid={EXAMPLES / 'beam.py'}").series("solid")
        self.assertAlmostEqual(other["tip_displacement_x"].max() / own["tip_displacement_x"].max(), 1, delta=0.01)
        self.assertAlmostEqual(other["tip_displacement_y"].max() / own["tip_displacement_y"].max(), 1, delta=0.02)


if __name__ == "__main__":
    unittest.main(verbosity=2)
