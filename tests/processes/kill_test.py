"""Kills shipped cases at random moments, also while a checkpoint is written, and goes on: every bit of what the run
leaves must be that of a run that was left alone. Scenes are chosen so that each scheme, formulation, integrator and
term with a memory is among them; threads change from one start to the next.

    kill_test.py BUILD/bin CASES COUNT [SEED]
"""
import pathlib
import random
import subprocess
import sys
import time

from toryu.processes import DONE
from toryu_testing import trio
from toryu_testing.process_case import LIMIT

SIDES = {"fluid": "fluid_solver", "solid": "solid_solver"}
ALL = ("coupler", "fluid", "solid")
FLUID, SOLID = ("fluid",), ("solid",)
GRACE = 4  # seconds in which the others end by themselves
IMPLICIT = "coupling.scheme=serial_implicit"

# case, who computes it, end time [s], settings
SCENES = [
    ("elastic_gate", ALL, 0.015, []),
    ("elastic_gate", ALL, 0.01, ["coupling.scheme=serial_explicit"]),
    ("elastic_gate", ALL, 0.01, ["coupling.scheme=parallel_explicit", "coupling.extrapolation_order=2"]),
    ("elastic_gate", ALL, 0.004, [IMPLICIT, "coupling.implicit.relaxation=aitken"]),
    ("elastic_gate", ALL, 0.004, [IMPLICIT, "coupling.implicit.relaxation=quasi_newton"]),
    ("abrasive_flow", ALL, 0.1, []),
    ("submerged_beam", ALL, 0.05, []),
    ("dam_break_elastic_obstacle", ALL, 0.01, []),
    ("abrasive_flow/rigid.toml", FLUID, 0.1, []),
    ("dam_break", FLUID, 0.02, ["fluid.integrator=symplectic"]),
    ("taylor_green", FLUID, 0.03, []),
    ("power_law_channel", FLUID, 1e-3, []),
    ("rotating_square_patch", FLUID, 0.05, []),
    ("colliding_rings", SOLID, 1e-4, []),
    ("colliding_rings", SOLID, 1e-4, ["solid.integrator=symplectic", "solid.gradients=renormalised"]),
    ("turek_hron_csm", SOLID, 0.02, []),
]


class Killed:
    """One scene, killed and gone on with until it is done."""

    def __init__(self, programs, cases, scene, chance):
        case, self.roles, self.end_time, settings = scene
        self.programs = {role: programs / SIDES.get(role, role) for role in self.roles}
        self.case, self.chance = cases / case, chance
        self.settings = [*settings, f"case.series_interval={self.end_time / 200}",
                         f"case.frame_interval={self.end_time / 5}"]

    def run(self, *more):
        return trio.Trio(self.programs, case=self.case, end_time=repr(self.end_time),
                         settings=[*self.settings, *more])

    def undisturbed(self):
        with self.run("case.checkpoint_every=0") as run:
            start = time.monotonic()
            run.start_all(extra=["--threads", "1"])
            self.must_end(run)
            return run.results(), time.monotonic() - start

    def must_end(self, run):
        for role in self.roles:
            code, text = run.ending_of(role, 4 * LIMIT)
            assert code == DONE, f"{role} of {self.case}: {text}"

    def kill(self, run):
        """Of a run that goes on: one process, or all at once as when the machine is lost."""
        if self.chance.random() < 0.3:
            for role in self.roles:
                run.processes[role].kill()
        else:
            run.processes[self.chance.choice(self.roles)].kill()
        for role in self.roles:
            try:
                run.wait(role, GRACE)
            except subprocess.TimeoutExpired:  # it waits for who died before they met, for longer than run.sh does
                run.kill(role)

    def check(self, expected, duration):
        """Returns how often the run was killed, and how many of its starts went on from a checkpoint."""
        kills = restarts = 0
        interval = self.end_time / self.chance.choice((5, 20, 60))
        with self.run(f"case.checkpoint_interval={interval}") as run:
            while True:
                whole = any(run.out.glob("checkpoint/*/manifest.toml"))
                extra = ["--restart"] if whole else ["--overwrite"]
                restarts += whole
                run.start_all(extra=[*extra, "--threads", self.chance.choice(("1", "2"))])
                time.sleep(self.chance.uniform(0, duration if kills == 0 else 1.5 * duration))
                if kills == 3 or any(process.poll() is not None for process in run.processes.values()):
                    break
                self.kill(run)
                kills += 1
            self.must_end(run)
            found = run.results()
        assert sorted(found) == sorted(expected), f"{self.case}: {sorted(found)}"
        for name, content in expected.items():
            assert found[name] == content, f"{self.case} {self.settings}: {name} differs"
        return kills, restarts


def main(programs, cases, count, seed=None):
    seed = int(seed) if seed else random.randrange(10**6)
    print(f"seed {seed}", flush=True)
    chance = random.Random(seed)
    kills = restarts = 0
    while kills < int(count):
        for scene in SCENES:
            killed = Killed(pathlib.Path(programs), pathlib.Path(cases), scene, chance)
            more = killed.check(*killed.undisturbed())
            kills, restarts = kills + more[0], restarts + more[1]
            print(f"{scene[0]} {' '.join(scene[3])}: killed {more[0]} times, bitwise the undisturbed run", flush=True)
            if kills >= int(count):
                break
    print(f"{kills} kills, {restarts} restarts from a checkpoint: {kills} of {kills} bitwise the undisturbed run")


if __name__ == "__main__":
    main(*sys.argv[1:])
