"""Coupled cases at their smallest resolution, whole runs of three processes.

    coupled_cases_test.py CASES BUILD/bin [CLASS...]
"""
import csv
import math
import pathlib
import subprocess
import sys
import tempfile
import tomllib
import unittest

import array_drag
import elastic_tank
import mounted_cylinder
import path_difference
import paddle
import turek_hron_fsi

PATHS = {}


def launch(what, out, *settings):
    return subprocess.run([sys.executable, "-m", "toryu.launch", "--bin", PATHS["bin"], PATHS["cases"] / what, "--out", out,
                           *settings], capture_output=True, text=True, timeout=600)


def run(case, **overrides):
    """Rows of solid.csv, figures of the coupler, and what was said."""
    with tempfile.TemporaryDirectory() as folder:
        overrides = {"case.frame_interval": 0} | overrides
        done = launch(case, folder, *(f"--set={key}={value}" for key, value in overrides.items()))
        if done.returncode != 0:
            return None, None, done.stderr
        with open(pathlib.Path(folder) / "solid.csv", encoding="utf-8") as file:
            rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
        figures = tomllib.loads((pathlib.Path(folder) / "coupler_summary.toml").read_text())["figures"]
        return rows, figures, (pathlib.Path(folder) / "log.txt").read_text()


class HydrostaticPlate(unittest.TestCase):
    def test_three_rows_bend_as_far_as_they_are_known_to(self):
        rows, figures, _ = run("hydrostatic_plate", **{"case.end_time": 0.085, "solid.spacing": 0.05 / 3})
        bent = [row["middle_displacement_y[m]"] for row in rows if row["time[s]"] > 0.03]
        self.assertLess(abs(sum(bent) / len(bent) / -7.063e-5 - 0.987), 0.01)  # 1.3 % short with 3 rows
        self.assertLess(figures["largest_impulse_error"], 1e-12)


    def test_a_rigid_flap_leans_as_far_as_its_spring_lets_it(self):
        rows, figures, _ = run("hydrostatic_plate/flap.toml", **{"fluid.spacing": 0.02, "solid.spacing": 0.02})
        late = [row["body_angle[rad]"] for row in rows if row["time[s]"] >= 0.6]
        self.assertLess(abs(sum(late) / len(late) / -0.011787 - 1), 0.01)
        self.assertLess(figures["largest_impulse_error"], 1e-12)


class RotatingPaddle(unittest.TestCase):
    def test_stiff_blades_take_the_moment_of_a_wall_that_turns(self):
        rows, figures, _ = run("rotating_paddle", **{"case.end_time": 0.5, "solid.youngs_modulus": 5e6})
        moment = paddle.moment_of_work(rows, 0.4, 0.5)
        with tempfile.TemporaryDirectory() as folder:
            done = launch("rotating_paddle/rigid.toml", folder, "--set=case.end_time=0.5", "--set=case.frame_interval=0")
            self.assertEqual(done.returncode, 0, done.stderr)
            of_wall = paddle.moment_of_wall(paddle.rows(pathlib.Path(folder) / "fluid.csv"), 0.4, 0.5)
        self.assertLess(abs(moment / of_wall - 1), 0.04)
        self.assertLess(figures["largest_impulse_error"], 1e-12)
        last = rows[-1]
        for axis in "xy":  # the blades are alike, but for what the coupling leaves
            self.assertLess(abs(last[f"right tip_displacement_{axis}[m]"] + last[f"left tip_displacement_{axis}[m]"]), 1e-7)
        held = last["kinetic_energy[J/m]"] + last["elastic_energy[J/m]"] + last["hourglass_energy[J/m]"]
        given = last["work_of_clamps[J/m]"] + last["interface_work[J/m]"]
        self.assertLess(abs(held - given), 0.01 * last["work_of_clamps[J/m]"])


class ElasticObstacle(unittest.TestCase):
    def test_bends_as_the_wave_strikes(self):
        rows, _, _ = run("dam_break_elastic_obstacle", **{"case.end_time": 0.2, "fluid.spacing": 0.00584, "solid.spacing": 0.003})
        self.assertLess(abs(rows[-1]["upper_left_corner_displacement_x[m]"] - 43.2e-3), 2e-3)


class SloshingBeam(unittest.TestCase):
    def test_the_floor_that_turns_takes_the_beam_along(self):
        rows, figures, _ = run("sloshing_beam", **{"case.end_time": 0.2, "fluid.spacing": 0.0041})
        turned = 0.0698 * (10 - 15 / 4 + 6 / 16) / 64 * math.sin(2 * math.pi * 0.61 * 0.2)
        # a little farther than the floor: the oil pushes it
        self.assertLess(abs(rows[-1]["tip_displacement_x[m]"] / (-0.0574 * turned) - 1.12), 0.1)
        self.assertNotEqual(rows[-1]["work_of_clamps[J/m]"], 0)
        self.assertLess(figures["largest_impulse_error"], 1e-12)


class SlantedGate(unittest.TestCase):
    def test_goes_the_way_of_the_gate(self):
        with tempfile.TemporaryDirectory() as folder:
            outs = [pathlib.Path(folder) / case for case in ("elastic_gate", "slanted_gate")]
            for out in outs:
                done = launch(out.name, out, "--set=fluid.spacing=0.0025", "--set=case.frame_interval=0", "--end-time=0.13")
                self.assertEqual(done.returncode, 0, done.stderr)
            found = path_difference.difference(*outs)
        self.assertLess(abs(found.peak), 0.01)
        self.assertLess(found.path, 0.01)


class TurekHron(unittest.TestCase):
    def test_a_stream_pulls_and_lifts_the_beam_behind_the_cylinder(self):
        with tempfile.TemporaryDirectory() as out:
            done = launch("turek_hron_fsi", out, "--set=case.frame_interval=0")
            self.assertEqual(done.returncode, 0, done.stderr)
            forces = turek_hron_fsi.of_run(pathlib.Path(out), since=6.0)
        self.assertLess(abs(forces.drag / 14.295 - 1), 0.04)  # +2.5 % at this spacing
        self.assertLess(abs(forces.lift / 0.7638 - 1), 0.15)
        self.assertLess(abs(forces.u_x / 2.27e-5 - 1), 0.12)
        self.assertLess(abs(forces.u_y / 8.21e-4 - 1), 0.2)  # +24 % where round walls were flat to the fluid beside them


class SwingingTurekHron(unittest.TestCase):
    def test_cases_are_without_errors(self):
        for name in ("fsi2", "fsi3"):
            with self.subTest(name), tempfile.TemporaryDirectory() as out:
                done = launch(f"turek_hron_fsi/{name}.toml", out, "--check")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn("no errors", done.stdout)


class FloatingBox(unittest.TestCase):
    def test_a_rigid_box_floats_as_deep_as_archimedes_says(self):
        rows, figures, _ = run("floating_box", **{"case.end_time": 2, "fluid.spacing": 0.0125, "solid.spacing": 0.0125})
        late = [row for row in rows if row["time[s]"] >= 1.5]
        risen = sum(row["body_displacement_y[m]"] for row in late) / len(late)
        self.assertLess(abs((0.05 - 1.5 * risen) / 0.06 - 1), 0.025)  # -1.5 %
        self.assertLess(max(abs(row["body_angle[rad]"]) for row in rows), 1e-3)
        self.assertLess(figures["largest_impulse_error"], 1e-12)


    def test_two_boxes_float_as_deep_as_each_is_heavy(self):
        rows, figures, _ = run("floating_box/two_boxes.toml", **{"case.end_time": 2, "fluid.spacing": 0.0125, "solid.spacing": 0.0125})
        late = [row for row in rows if row["time[s]"] >= 1.5]
        heavy, light = (sum(row[f"{name}_displacement_y[m]"] for row in late) / len(late) for name in ("heavy", "light"))
        level = (0.9 * 0.3 - 2 * 0.2 * 0.05 - 0.2 * (0.5 + heavy + light)) / (0.9 - 2 * 0.2)  # of as much water as there is
        self.assertLess(abs((level - 0.25 - heavy) / 0.06 - 1), 0.025)  # -1.7 %
        self.assertLess(abs((level - 0.25 - light) / 0.04 - 1), 0.025)  # -1.8 %
        self.assertLess(figures["largest_impulse_error"], 1e-12)


class ElasticTank(unittest.TestCase):
    COARSE = {"fluid.spacing": 0.0125, "solid.spacing": 0.0125}

    def test_plates_lean_out_and_a_rigid_box_floats_beside_them(self):
        rows, figures, _ = run("elastic_tank/floating_box.toml", **self.COARSE)
        found, expected = elastic_tank.found(rows), elastic_tank.expected(with_box=True)
        self.assertLess(abs(found.left / expected.left - 1), 0.05)  # +4.1 %
        self.assertLess(abs(found.right / expected.right - 1), 0.05)  # +4.4 %
        self.assertLess(abs(found.draught / expected.draught - 1), 0.02)  # -1.4 %
        self.assertLess(figures["largest_impulse_error"], 1e-12)
        work = figures["work_given"]
        self.assertLess(abs(figures["work_taken"] / work - 1), 0.02)
        self.assertLess(abs(rows[-1]["interface_work[J/m]"] / work - 1), 0.02)
        self.assertGreater(rows[-1]["dissipated_energy[J/m]"], 0)  # by the dampers of both

    def test_two_plates_alike_mirror_each_other(self):
        alike = {"solid.material.stiff.density": 1100, "solid.material.stiff.youngs_modulus": 4e7}
        rows, _, _ = run("elastic_tank", **self.COARSE | alike | {"case.end_time": 0.3})
        peak = max(abs(row["left tip_displacement_x[m]"]) for row in rows)
        self.assertGreater(peak, 4e-3)
        for row in rows:
            self.assertLess(abs(row["left tip_displacement_x[m]"] + row["right tip_displacement_x[m]"]), 1e-10 * peak)
            self.assertLess(abs(row["left tip_displacement_y[m]"] - row["right tip_displacement_y[m]"]), 1e-10 * peak)


class FloatingSquare(unittest.TestCase):
    def test_turns_until_a_corner_points_down(self):
        rows, _, _ = run("floating_box/square.toml", **{"fluid.spacing": 0.0125, "solid.spacing": 0.0125})
        late = [row["body_angle[rad]"] for row in rows if row["time[s]"] >= 7]
        self.assertLess(abs(math.degrees(sum(late) / len(late)) - 45), 1)  # 44.4


class CylinderInAStream(unittest.TestCase):
    def test_a_spring_near_the_eddies_frequency_makes_them_follow_the_cylinder(self):
        rows, figures, _ = run("cylinder_in_channel/mounted.toml", **{"case.end_time": 3})
        late = [(row["time[s]"], row["body_displacement_y[m]"]) for row in rows if row["time[s]"] > 1]
        up = [t for (t, y), (_, after) in zip(late, late[1:]) if y < 0 <= after]
        self.assertLess(abs((len(up) - 1) / (up[-1] - up[0]) / 2.97 - 1), 0.03)
        self.assertGreater(max(y for _, y in late), 0.02)  # pushed, it began with 0.01 m
        self.assertLess(figures["largest_impulse_error"], 1e-12)


class MountedCylinder(unittest.TestCase):
    def test_a_check_tells_its_mass_and_its_frequency_without_water(self):
        with tempfile.TemporaryDirectory() as out:
            said = launch("mounted_cylinder", out, "--check").stdout
        self.assertIn("[solid]: rigid body: mass 7.85", said)
        self.assertIn("natural frequency in x 3.11", said)

    def test_swings_with_its_exact_added_mass(self):
        with tempfile.TemporaryDirectory() as out:
            done = launch("mounted_cylinder", out, "--set=case.frame_interval=0", "--set=fluid.spacing=0.01", "--set=solid.spacing=0.01")
            self.assertEqual(done.returncode, 0, done.stderr)
            swing = mounted_cylinder.of_run(pathlib.Path(out))
        self.assertLess(abs(swing.frequency / 1.9010 - 1), 0.012)  # +0.8 % at this spacing
        self.assertLess(abs(swing.damping), 0.015)


class SubmergedBeam(unittest.TestCase):
    """At its shipped spacing: a coarser kernel sees through the beam."""

    def test_a_light_beam_rises_and_a_heavy_one_sinks(self):
        for case, tip in (("submerged_beam/rho500.toml", 0.71e-3), ("submerged_beam", -0.63e-3)):
            with self.subTest(case):
                rows, figures, said = run(case, **{"case.end_time": 0.16})
                self.assertLess(abs(rows[-1]["tip_displacement_y[m]"] - tip), 0.05e-3)
                self.assertLess(figures["largest_impulse_error"], 1e-12)
                self.assertNotIn("beyond the edge of stability", said)

    def test_the_parallel_scheme_is_warned_of(self):
        settings = {"case.end_time": 0.005, "coupling.scheme": "parallel_explicit"}
        _, _, said = run("submerged_beam/rho500.toml", **settings)
        self.assertIn("beyond the edge of stability", said)


class CylinderArray(unittest.TestCase):
    def test_has_the_drag_of_sangani_and_acrivos_wherever_it_stands(self):
        self.assertLess(abs(array_drag.exact(0.1) / 24.83 - 1), 1e-3)  # as they tabulate
        self.assertLess(abs(array_drag.exact(0.4) / 217.89 - 1), 1e-3)
        for centre in ("[0.01,0.01]", "[0,0]"):
            with self.subTest(centre), tempfile.TemporaryDirectory() as out:
                done = launch("cylinder_array", out, f"--set=solid.region.0.circle.centre={centre}",
                              f"--set=solid.clamp.0.circle.centre={centre}", "--set=case.frame_interval=0")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertLess(abs(array_drag.of_run(pathlib.Path(out)) / array_drag.exact(0.2) - 1), 0.01)
                with open(pathlib.Path(out) / "fluid.csv", encoding="utf-8") as file:
                    force = float(list(csv.DictReader(file))[-1]["force_from_interface_x[N/m]"])
                self.assertLess(abs(force / -0.32 - 1), 0.005)  # that on the medium


class PeriodicSpace(unittest.TestCase):
    """An elastic flap and a piece that the stream carries round. Moved by half of the period, the flap crosses a side of the
    domain and the piece does so at another time. What differs is the order in which sums are added up: by 1e-16 of the
    largest terms, which 860 windows make 4e-14 of."""

    CASES = pathlib.Path(__file__).resolve().parents[1] / "participants"
    HALF = {"fluid.hole.0.min": [-0.015625, 0], "fluid.hole.0.max": [0.015625, 0.078125],
            "solid.region.0.box.min": [-0.015625, -0.015625], "solid.region.0.box.max": [0.015625, 0.078125],
            "fluid.hole.1.min": [0.03125, 0.109375], "fluid.hole.1.max": [0.0625, 0.140625],
            "solid.region.1.box.min": [0.03125, 0.109375], "solid.region.1.box.max": [0.0625, 0.140625]}

    def test_has_no_place_where_it_begins(self):
        here, figures, _ = run(self.CASES / "flaps")
        there, _, _ = run(self.CASES / "flaps", **self.HALF)
        self.assertLess(figures["largest_impulse_error"], 1e-12)
        self.assertGreater(here[-1]["piece_displacement_x[m]"], 0.1)  # 0.0625 m are to the side of the domain
        self.assertEqual(len(here), len(there))
        for column in here[0]:
            largest = max(abs(row[column]) for row in here)
            apart = max(abs(a[column] - b[column]) for a, b in zip(here, there))
            self.assertLessEqual(apart, 1e-11 * largest, column)

    def test_shears_an_elastic_floor_without_ends(self):
        """The floor of Poiseuille flow bears tau = rho_f g H/2, and its face moves by (tau h + rho_s g h^2/2)/G. The fluid pulls
        at all rows that it has in reach, not at the face: 7.6 % less with 6 rows, 3.7 % with 12."""
        rows, figures, _ = run(self.CASES / "elastic_floor")
        h, shear_modulus, last = 0.046875, 4e4 / 2.6, rows[-1]
        moved = (1000 * 0.1875 / 2 * h + 1500 * h * h / 2) / shear_modulus
        self.assertLess(abs(last["inside_displacement_x[m]"] / moved - 0.924), 0.01)
        self.assertLess(abs(last["seam_displacement_x[m]"] / last["inside_displacement_x[m]"] - 1), 1e-9)
        self.assertLess(figures["largest_impulse_error"], 1e-12)
        held, before = (row["impulse_from_clamps_x[N.s/m]"] for row in (last, rows[-6]))
        force = (held - before) / (last["time[s]"] - rows[-6]["time[s]"])
        weight = (1000 * 0.1875 / 2 + 1500 * 0.0625) * 0.125  # of half the medium and the floor
        self.assertLess(abs(force / -weight - 1), 1e-3)


class ThinWall(unittest.TestCase):
    def force_error(self, spacing):
        rows, _, said = run("thin_wall", **{"fluid.spacing": spacing})
        half = [row for row in rows if row["time[s]"] >= 0.15]
        impulse = half[-1]["impulse_from_load_x[N.s/m]"] - half[0]["impulse_from_load_x[N.s/m]"]
        return impulse / (half[-1]["time[s]"] - half[0]["time[s]"]) / 23.544 - 1, said

    def test_two_rows_of_water_part_it_and_one_row_does_not_and_is_warned_of(self):
        error, said = self.force_error(0.005)
        self.assertLess(abs(error), 0.04)
        self.assertNotIn("thin_wall_map", said)
        error, said = self.force_error(0.01)
        self.assertLess(error, -0.2)
        self.assertIn("'interface' is 0.01 m thick in places", said)


class PushedColumn(unittest.TestCase):
    EXPLICIT = {"coupling.scheme": "serial_explicit", "solid.artificial_viscosity": "{alpha=0.1, beta=0.0}"}
    IMPLICIT = {"coupling.scheme": "serial_implicit", "solid.artificial_viscosity": "{alpha=0.1, beta=0.0}"}

    def way_error(self, density, case="pushed_column", **settings):
        rows, figures, said = run(case, **{"solid.density": density} | settings)
        lag = density * 0.02 / 2e4  # m_s/(rho_f c)
        return rows[-1]["layer_displacement_y[m]"] / (0.2 * (0.04 - lag * (1 - math.exp(-0.04 / lag)))) - 1, figures, said

    def test_a_heavy_layer_goes_as_far_as_theory_says(self):
        for settings in ({}, {"coupling.fluid_steps_per_window": 4}, self.EXPLICIT, self.EXPLICIT | {"coupling.extrapolation_order": 1},
                         {"coupling.scheme": "parallel_explicit"}, self.IMPLICIT):
            with self.subTest(settings):
                error, figures, said = self.way_error(2000, **settings)
                self.assertLess(abs(error), 0.02)
                self.assertLess(figures["largest_impulse_error"], 1e-12)
                self.assertNotIn("beyond the edge of stability", said)

    def test_a_run_that_ends_well_but_is_fed_by_the_exchange_is_told_of(self):
        parallel = {"coupling.scheme": "parallel_explicit"}
        rows, _, said = run("pushed_column", **{"solid.density": 200} | parallel)
        self.assertIsNone(rows)
        self.assertIn("'largest_false_work'", said)
        error, figures, said = self.way_error(200, **parallel | {"coupling.largest_false_work": 1e9})
        self.assertGreater(abs(error), 0.2)
        self.assertGreater(figures["work_taken"] - figures["work_given"], 1)
        self.assertIn("the exchange feeds the solid", said)
        error, _, said = self.way_error(1000, **parallel)
        self.assertLess(abs(error), 0.02)
        self.assertNotIn("the exchange feeds the solid", said)

    def test_a_rigid_layer_of_any_weight_goes_as_far_as_theory_says(self):
        for density in (1000, 1):  # 2 and 0.002 rows of water
            error, figures, said = self.way_error(density, "pushed_column/rigid.toml")
            self.assertLess(abs(error), 0.02)
            self.assertLess(figures["largest_impulse_error"], 1e-12)
            self.assertNotIn("beyond the edge of stability", said)  # serial_robin bears a rigid layer of any weight

    def test_a_light_layer_is_borne_by_the_robin_scheme_alone_without_iterations(self):
        for density in (50, 20):
            with self.subTest(density):
                error, figures, said = self.way_error(density)
                self.assertLess(abs(error), 0.02)
                self.assertLess(figures["largest_impulse_error"], 1e-12)
                made = figures["work_taken"] - figures["work_given"]
                self.assertLess(abs(made), 0.02 * abs(figures["work_given"]))
                self.assertNotIn("beyond the edge of stability", said)
        _, _, said = run("pushed_column", **{"solid.density": 30} | self.EXPLICIT)
        self.assertIn("beyond the edge of stability", said)
        self.assertIn("'largest_false_work'", said)
        iterations = {}
        for relaxation in ("aitken", "quasi_newton"):
            error, figures, said = self.way_error(10, **self.IMPLICIT | {"coupling.implicit.relaxation": relaxation})
            self.assertLess(abs(error), 0.02)
            self.assertLess(figures["largest_impulse_error"], 1e-12)
            self.assertEqual(figures["unconverged_windows"], 0)
            self.assertNotIn("beyond the edge of stability", said)
            iterations[relaxation] = figures["iterations"]
        self.assertLess(iterations["quasi_newton"], 0.7 * iterations["aitken"])


if __name__ == "__main__":
    PATHS["cases"], PATHS["bin"] = pathlib.Path(sys.argv.pop(1)).resolve(), pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main(verbosity=2)
