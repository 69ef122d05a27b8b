"""Participants in Python beside the real coupler and the stand-in of the other side: how mistakes in them end, what is kept for
windows that repeat, and that waits leave Python to other threads.

    PYTHONPATH=tools:tests:BUILD/bin python_test.py BUILD/bin
"""

import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from toryu.processes import BAD_INPUT, BUG, DONE, INTERRUPTED, PEER_LOST, PHYSICS_FAILED
from toryu_testing import trio

LIMIT = 30  # [s] after which something that should have ended counts as hung
BIN = pathlib.Path(sys.argv.pop(1)) if __name__ == "__main__" else None

FLUID = """#!/usr/bin/python3
import os
import time
import numpy as np
from toryu import participant
from toryu.participant import Fluid, Health, Load

class Push(Fluid):
    reach, time_step_limit, density, sound_speed, spacing = 0.005, 1e-4, 1000, 10, 0.0025
    state = ("windows",)
    windows = 0

    def begin(self, interface):
        self.interface = interface

    def advance(self, window, motion):
        self.windows += 1
        pressure = np.full(len(self.interface.mass), 100.0)
        force = -pressure[:, None] * self.interface.area_vector
        {advance}
        return Load(pressure, force)

    {more}

Push.main()
"""
SOLID = """#!/usr/bin/python3
import numpy as np
from toryu.participant import Interface, Motion, Solid

class Still(Solid):
    state = ()

    def begin(self, reach):
        self.x = np.stack([np.full(30, 0.1005), 0.001 * (np.arange(30) + 0.5)], axis=1)
        area_vector = np.tile([-0.001, 0.0], (30, 1))
        volume, mass, spacing = np.full(30, 1e-6), np.full(30, 1e-3), 0.001
        {begin}
        return Interface(self.x, volume, area_vector, mass, spacing)

    def advance(self, window, load):
        position, velocity = self.x, np.zeros((30, 2))
        {advance}
        return Motion(position, velocity)

Still.main()
"""


class Python(unittest.TestCase):
    def run_of(self, fluid=None, solid=None, **settings):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        programs = {"coupler": BIN / "coupler", "fluid": BIN / "fake_fluid", "solid": BIN / "fake_solid"}
        for role, text in (("fluid", fluid), ("solid", solid)):
            if text:
                programs[role] = pathlib.Path(folder.name) / f"my_{role}.py"
                programs[role].write_text(text)
                programs[role].chmod(0o755)
        return trio.Trio(programs, **settings)

    def fluid(self, advance="pass", more="pass", **settings):
        return self.run_of(fluid=FLUID.format(advance=advance, more=more), **settings)

    def solid(self, begin="pass", advance="pass", **settings):
        return self.run_of(solid=SOLID.format(begin=begin, advance=advance), **settings)

    def assert_end(self, run, name, code, *words):
        found, text = run.ending_of(name, LIMIT)
        self.assertEqual(found, code, f"{name}: {text}")
        for word in words:
            self.assertIn(word, text)
        self.assertNotIn("Traceback", text)

    def assert_ends(self, run, role, code, others, *words):
        """The participant ends with the code and the words, and the others learn why."""
        with run:
            run.start_all()
            self.assert_end(run, role, code, *words)
            for name in set(trio.ROLES) - {role}:
                self.assert_end(run, name, others, words[-1])

    def test_a_run_to_the_end(self):
        for run in (self.fluid(end_time="0.005"), self.solid(end_time="0.005")):
            with run:
                run.start_all()
                for name in trio.ROLES:
                    self.assert_end(run, name, DONE)

    def test_a_mistake_ends_the_run_with_its_place(self):
        line = FLUID.split("\n").index("        {advance}") + 1
        self.assert_ends(self.fluid("1 / (self.windows - 3)"), "fluid", BUG, PEER_LOST,
                         f"my_fluid.py:{line}: in advance: ZeroDivisionError: division by zero")

    def test_a_mistake_within_numpy_is_told_at_the_line_that_called_it(self):
        line = FLUID.split("\n").index("        {advance}") + 1
        self.assert_ends(self.fluid("np.linalg.inv(np.zeros((2, 2)))"), "fluid", BUG, PEER_LOST,
                         f"my_fluid.py:{line}: in advance: numpy.linalg.LinAlgError: Singular matrix")

    def test_a_mistake_at_the_start(self):
        self.assert_ends(self.solid(begin="self.absent"), "solid", BUG, PEER_LOST,
                         "in begin: AttributeError: 'Still' object has no attribute 'absent'")

    def test_what_leaves_python_is_a_mistake_too(self):
        self.assert_ends(self.fluid("raise SystemExit(0)"), "fluid", BUG, PEER_LOST, "in advance: SystemExit: 0")

    def test_what_is_not_finite_is_refused_with_its_name(self):
        self.assert_ends(self.fluid("if self.windows == 3: force[7, 1] = np.nan"), "fluid", PHYSICS_FAILED, PHYSICS_FAILED,
                         "Push: force of interface particle 7 is nan")
        self.assert_ends(self.solid(advance="velocity[2, 0] = np.inf"), "solid", PHYSICS_FAILED, PHYSICS_FAILED,
                         "Still: velocity of interface particle 2 is inf")
        self.assert_ends(self.fluid(more="def health(self): return Health(kinetic_energy=np.nan)"), "fluid",
                         PHYSICS_FAILED, PHYSICS_FAILED, "Push: kinetic_energy is nan")

    def test_another_shape_is_refused_with_name_and_shape(self):
        self.assert_ends(self.fluid("force = force[:3]"), "fluid", BUG, PEER_LOST, "Push: force has the shape (3, 2), not (40, 2)")
        self.assert_ends(self.solid(begin="mass = mass[None]"), "solid", BUG, PEER_LOST,
                         "Still: mass has the shape (1, 30), not (30,)")
        self.assert_ends(self.solid(advance="position = position[:, 0]"), "solid", BUG, PEER_LOST,
                         "Still: position has the shape (30,), not (30, 2)")

    def test_a_mistake_in_a_row_of_the_series_is_told_once(self):
        with self.fluid(more="def observe(self): return {'a[m]': 1 / (self.windows - 10)}") as run:
            run.start_all()
            self.assert_end(run, "fluid", BUG, "in observe: ZeroDivisionError")
            said = (run.out / "fluid.err").read_text()
            self.assertEqual(said.count("ZeroDivisionError"), 1, said)
            self.assertTrue((run.out / "fluid_summary.toml").exists())

    def test_another_kind_is_refused(self):
        self.assert_ends(self.fluid("return pressure"), "fluid", BUG, PEER_LOST, "Push.advance answered ndarray, not Load")
        self.assert_ends(self.solid(advance="return"), "solid", BUG, PEER_LOST, "Still.advance answered nothing, not Motion")
        self.assert_ends(self.fluid("force = force + 1j"), "fluid", BUG, PEER_LOST,
                         "Push: force is of the type complex128, not of real numbers")
        self.assert_ends(self.fluid(more="def observe(self): return {'push': 1}"), "fluid", BUG, PEER_LOST,
                         "Push.observe names a column 'push', not as 'name[unit]'")

    def test_rows_of_several_lengths_are_refused(self):
        self.assert_ends(self.fluid("force = [[1, 2], [3]]"), "fluid", BUG, PEER_LOST, "Push: force is no array")

    def test_particles_have_numbers_of_their_own(self):
        for numbers, why in (("np.zeros(30)", "holds a number twice"), ("np.arange(30) - 1", "holds -1"),
                             ("np.arange(30) / 2", "holds 0.5")):
            text = SOLID.replace("return Interface(self.x, volume, area_vector, mass, spacing",
                                 f"return Interface(self.x, volume, area_vector, mass, spacing, id={numbers}")
            self.assert_ends(self.run_of(solid=text.format(begin="pass", advance="pass")), "solid", BUG, PEER_LOST,
                             f"Still: id {why}")

    def test_particles_have_volume_and_mass(self):
        for mistake, why in (("mass[3] = 0", "mass of interface particle 3 is 0, not above 0"),
                             ("volume[5] = -1e-6", "volume of interface particle 5 is -1e-06, not above 0"),
                             ("spacing = 0.0", "spacing is 0, not above 0")):
            self.assert_ends(self.solid(begin=mistake), "solid", BUG, PEER_LOST, f"Still: {why}")

    def test_what_is_not_there_is_named(self):
        self.assert_ends(self.fluid(more="advance = None"), "fluid", BUG, PEER_LOST, "'NoneType' object is not callable")
        self.assert_ends(self.run_of(solid=SOLID.replace("def advance(", "def advanced(").format(begin="pass", advance="pass")),
                         "solid", BUG, PEER_LOST, "Still has no method 'advance'")
        self.assert_ends(self.fluid(more="def health(self, more): pass"), "fluid", BUG, PEER_LOST,
                         "Push.health() missing 1 required positional argument: 'more'")

    def test_a_state_that_cannot_be_kept_ends_the_run_at_its_start(self):
        for state, why in (("('absent',)", "absent, which 'state' names, is not there when 'begin' has ended"),
                           ("('interface',)", "interface, which 'state' names, is of the type object, not of numbers"),
                           ("('rows',)\n    rows = [1, 2]", "rows, which 'state' names, is a list, not a number or an array")):
            self.assert_ends(self.fluid(more=f"state = {state}"), "fluid", BUG, PEER_LOST, f"Push: {why}")
        with self.fluid(more="state = ('windows')") as run:
            run.start_all()
            self.assert_end(run, "fluid", BUG, "Push: 'state' is the text 'windows', not a tuple of names: ('windows',)")

    def test_columns_of_the_series_are_those_of_a_table(self):
        for column in ("a,b[m]", "time[s]", "a\\n[m]", '\\"a[m]', "a[m,s]"):
            self.assert_ends(self.fluid(more=f'def observe(self): return {{"{column}": 1}}'), "fluid", BUG, PEER_LOST,
                             "Push.observe names a column")
        self.assert_ends(self.fluid(more="def observe(self): return {f'a{self.windows}[m]': 1}"), "fluid", BUG, PEER_LOST,
                         "and before a0: they must stay the same")

    def test_it_can_tell_of_physics_and_of_input_itself(self):
        self.assert_ends(self.fluid("raise participant.PhysicsFailure('it boils')"), "fluid", PHYSICS_FAILED, PHYSICS_FAILED,
                         "it boils")
        self.assert_ends(self.solid(begin="from toryu.participant import BadInput; raise BadInput('[solid] needs a region')"),
                         "solid", BAD_INPUT, BAD_INPUT, "[solid] needs a region")

    def test_the_state_is_that_of_the_start_in_windows_that_repeat(self):
        check = "if self.windows != window.number: raise ValueError(f'{self.windows} in {window}')"
        implicit = ["coupling.scheme=serial_implicit", "coupling.implicit.tolerance=1e-9"]
        with self.fluid(check, end_time="0.003", settings=implicit) as run:
            run.start_all()
            for name in trio.ROLES:
                self.assert_end(run, name, DONE)
            with open(run.out / "coupler.csv", encoding="utf-8") as file:
                rows = [line.split(",") for line in file.read().split()]
            self.assertGreater(max(float(row[rows[0].index("iterations[1]")]) for row in rows[1:]), 1)

    def test_without_a_state_it_is_not_taken_into_a_run_that_repeats(self):
        with self.fluid(more="state = None", settings=["coupling.scheme=serial_implicit"]) as run:
            run.start_all()
            self.assert_end(run, "coupler", BAD_INPUT, "my_fluid")

    def test_another_program_does_not_go_on_from_its_checkpoint(self):
        with self.fluid(end_time="0.002") as run:
            run.start_all()
            for name in trio.ROLES:
                self.assert_end(run, name, DONE)
            self.assertIn("my_fluid of toryu 0.1.0 (commit " + (BIN / "commit.txt").read_text().strip(),
                          subprocess.run([run.programs["fluid"], "--version"], capture_output=True, text=True).stdout)
            run.programs["fluid"] = run.programs["fluid"].rename(run.programs["fluid"].with_name("other_fluid.py"))
            run.end_time = "0.003"
            run.start_all(extra=["--restart"])
            self.assert_end(run, "fluid", BAD_INPUT, "my_fluid")

    def test_another_text_does_not_go_on_from_its_checkpoint(self):
        with self.fluid(end_time="0.002") as run:
            run.start_all()
            for name in trio.ROLES:
                self.assert_end(run, name, DONE)
            run.end_time = "0.003"
            run.start_all(extra=["--restart"])  # the same text does
            for name in trio.ROLES:
                self.assert_end(run, name, DONE)
            text = run.programs["fluid"].read_text()
            run.programs["fluid"].write_text(text.replace("100.0", "101.0"))
            run.end_time = "0.004"
            run.start_all(extra=["--restart"])
            self.assert_end(run, "fluid", BAD_INPUT, "cannot go on: its build is", "with the sources")

    def test_its_series_is_written_as_often_as_the_case_says(self):
        with self.fluid(more="def observe(self): return {'windows[1]': self.windows}", end_time="0.005") as run:
            run.start_all()
            for name in trio.ROLES:
                self.assert_end(run, name, DONE)
            rows = (run.out / "fluid.csv").read_text().split()
            self.assertEqual(rows[0], "time[s],windows[1]")
            self.assertEqual([float(row.split(",")[1]) for row in rows[1:-1]], [0, 10, 20, 30, 40])

    def test_a_long_window_is_waited_for_while_it_counts_steps(self):
        slow = "if self.windows == 3:\n            for _ in range(60): time.sleep(0.1); self.count_step()"
        with self.fluid(slow, end_time="0.001", settings=["coupling.time_limit=4"]) as run:
            run.start_all()
            for name in trio.ROLES:
                self.assert_end(run, name, DONE)

    def test_steps_are_counted_by_the_thread_that_takes_the_windows(self):
        thread = ("def begin(self, interface):\n        import threading\n        self.interface = interface\n"
                  "        def tick():\n            while True: time.sleep(0.001); self.count_step()\n"
                  "        threading.Thread(target=tick, name='pulse', daemon=True).start()")
        self.assert_ends(self.fluid(more=thread), "fluid", BUG, PEER_LOST,
                         "Push.count_step is called by the thread 'pulse', not by that which calls 'advance'")

    def test_a_long_window_ends_when_the_coupler_dies(self):
        endless = ("if self.windows == 3:\n            os.write(2, b'now')\n"
                   "            while True:\n                try: time.sleep(0.01); self.count_step()\n"
                   "                except Exception: pass")
        with self.fluid(endless) as run:
            run.start_all()
            self.wait_for(lambda: "now" in (run.out / "fluid.err").read_text())
            run.kill("coupler")
            self.assert_end(run, "fluid", PEER_LOST, "coupler")

    def test_a_wait_leaves_python_to_other_threads_and_ends_when_interrupted(self):
        thread = ("def __init__(self, case):\n        import threading\n        super().__init__(case)\n"
                  "        def tick():\n            while True: os.write(2, b'.'); time.sleep(0.01)\n"
                  "        threading.Thread(target=tick, daemon=True).start()")
        with self.fluid(more=thread) as run:
            run.start("fluid")  # waits for a coupler
            self.wait_for(lambda: (run.out / "fluid.err").read_text().count(".") > 50)
            run.signal("fluid", signal.SIGINT)
            self.assert_end(run, "fluid", INTERRUPTED)

    def test_a_thread_that_goes_on_after_the_run_is_not_waited_for_for_ever(self):
        thread = ("import threading; from toryu import own_code; own_code.PATIENCE, own_code.QUIET = 1, 0.5\n"
                  "    threading.Thread(target=time.sleep, args=[1000], name='logger').start()")
        with self.fluid(more=thread, end_time="0.001") as run:
            run.start_all()
            self.assert_end(run, "fluid", DONE, "the run is over, and 1 thread of this program, 'logger', is waited for, for "
                            "1 s at most; one with daemon=True ends with the run",
                            "a thread of this program goes on after 1 s: it is ended")

    def wait_for(self, condition):
        end = time.monotonic() + LIMIT
        while not condition():
            self.assertLess(time.monotonic(), end, "it does not come")
            time.sleep(0.05)


if __name__ == "__main__":
    unittest.main(verbosity=2)
