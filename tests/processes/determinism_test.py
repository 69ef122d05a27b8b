"""Runs scenes again and again, with another number of threads in each process each time: every bit of what a run leaves
must be the same.

    determinism_test.py BUILD/bin CASES RUNS [SEED]
"""
import pathlib
import random
import sys

from kill_test import SCENES, Killed

THREADS = ("1", "2", "3", "4")
# Those of kill_test, but for the implicit schemes and the second of each pair that differs in its coupling alone.
CHOSEN = [SCENES[k] for k in (0, 2, 5, 6, 8, 9, 11, 13, 15)]


class Repeated(Killed):
    """One scene, left alone."""

    def results(self):
        with self.run("case.checkpoint_every=0") as run:
            for role in self.roles:
                run.start(role, extra=["--threads", self.chance.choice(THREADS)])
            self.must_end(run)
            return run.results()


def main(programs, cases, runs, seed=None):
    seed = int(seed) if seed else random.randrange(10**6)
    print(f"seed {seed}", flush=True)
    chance = random.Random(seed)
    for scene in CHOSEN:
        repeated = Repeated(pathlib.Path(programs), pathlib.Path(cases), scene, chance)
        expected = repeated.results()
        for _ in range(1, int(runs)):
            found = repeated.results()
            assert sorted(found) == sorted(expected), f"{scene[0]}: {sorted(found)}"
            for name, content in expected.items():
                assert found[name] == content, f"{scene[0]} {scene[3]}: {name} differs"
        print(f"{scene[0]} {' '.join(scene[3])}: {runs} runs bitwise the same, {len(expected)} records", flush=True)
    print(f"{len(CHOSEN)} scenes, {len(CHOSEN) * int(runs)} runs")


if __name__ == "__main__":
    main(*sys.argv[1:])
