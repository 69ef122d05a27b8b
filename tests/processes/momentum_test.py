"""Fluid plus solid against walls, piston, clamps and gravity: the momentum of a coupled run closes to rounding.

    momentum_test.py BUILD/bin [unittest options]
"""
import csv
import pathlib
import sys
import unittest

from toryu.processes import DONE
from toryu_testing import trio

LIMIT = 60  # seconds after which something that should have ended counts as hung
PROGRAMS = {}
SOLID_MASS = 1100 * 0.01 * 0.064  # kg/m, of the case
PISTON = "{velocity = [[0.0, 0.0, 0.0], [0.01, 0.3, 0.0], [0.03, 0.0, 0.0]]}"
SETTINGS = [f"wall.left.motion={PISTON}", "fluid.friction={coefficient=0.4}", "fluid.wall_model.slip=free_slip",
            "solid.artificial_viscosity={alpha=0.5}"]


def last_rows(out):
    """The last row of the fluid's and of the solid's series, what has changed in momentum since the first, and the last row
    of the coupler's series."""
    found = []
    for name in ("fluid.csv", "solid.csv"):
        with open(out / name, encoding="utf-8") as file:
            rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
        change = [rows[-1][f"momentum_{axis}[N.s/m]"] - rows[0][f"momentum_{axis}[N.s/m]"] for axis in "xy"]
        found += [rows[-1], change]
    with open(out / "coupler.csv", encoding="utf-8") as file:
        found.append({key: float(value) for key, value in list(csv.DictReader(file))[-1].items()})
    return found


def impulse(row, name, axis):
    return row[f"{name}_{axis}[N.s/m]"]


class MomentumTest(unittest.TestCase):
    def run_strip(self, *more):
        programs = {"coupler": PROGRAMS["bin"] / "coupler", "fluid": PROGRAMS["bin"] / "fluid_solver",
                    "solid": PROGRAMS["bin"] / "solid_solver"}
        settings = [*SETTINGS, *more]
        with trio.Trio(programs, end_time="0.05", settings=settings) as run:
            run.start_all()
            for role in trio.ROLES:
                code, text = run.ending_of(role, LIMIT)
                self.assertEqual(code, DONE, text)
            return last_rows(run.out)

    def check(self, applied, *more):
        """`applied(whole, friction)`: what the solid applied of the impulse between it and the fluid. Returns the rest."""
        fluid, fluid_change, solid, solid_change, coupler = self.run_strip(*more)
        self.assertEqual(coupler["time[s]"], solid["time[s]"])
        rest = []
        for axis, gravity, changes in zip("xy", (0.0, -9.81), zip(fluid_change, solid_change)):
            from_solid = impulse(fluid, "impulse_from_interface", axis)
            friction = impulse(fluid, "friction_impulse_from_interface", axis)
            self.assertNotEqual(friction, 0)
            outside = [impulse(fluid, "impulse_from_left", axis), impulse(fluid, "impulse_from_walls", axis),
                       impulse(fluid, "impulse_of_gravity", axis), impulse(solid, "impulse_from_clamps", axis),
                       SOLID_MASS * gravity * solid["time[s]"]]
            rest.append(from_solid - applied(from_solid, friction))
            size = sum(map(abs, outside)) + abs(from_solid)
            in_flight = coupler.get(f"impulse_in_flight_{axis}[N.s/m]", 0.0)  # the solid has it, the fluid gives it next
            off = sum(outside) + rest[-1] + in_flight - sum(changes)
            print(f"{axis}: off by {abs(off) / size:.1e} of the impulses", end=" ")
            self.assertLess(abs(off), 1e-10 * size)
        return rest

    def test_closes_if_the_solid_feels_all(self):
        self.check(lambda whole, friction: whole)

    def test_closes_with_a_constant_load(self):
        self.check(lambda whole, friction: whole, "coupling.scheme=serial_explicit")

    def test_closes_if_windows_are_repeated(self):
        self.check(lambda whole, friction: whole, "coupling.scheme=serial_implicit")

    def test_closes_but_for_pressure_if_the_solid_feels_friction_alone(self):
        not_applied = self.check(lambda whole, friction: friction, "coupling.loads=['friction']")
        self.assertLess(not_applied[0], -1e-3)  # the solid holds the water back, though it feels nothing of it


if __name__ == "__main__":
    PROGRAMS["bin"] = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main(verbosity=2)
