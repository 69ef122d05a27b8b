"""Kills one process of a run at a random moment: the run must end with exit code 4 and name it, at once, or where it is
the launcher, end by itself; it leaves no process, and every file of its results can be read. Then runs are left alone,
while as many other processes compute as LOAD says: nobody may be taken for dead.

    death_test.py BUILD/bin CASES COUNT [LOAD [SEED]]
"""
import collections
import contextlib
import os
import pathlib
import random
import signal
import statistics
import subprocess
import sys
import tempfile
import time

import h5py

from toryu import program
from toryu.processes import DONE, PEER_LOST

ROLES = ("coupler", "fluid_solver", "solid_solver")
LAUNCHER = "launcher"
LIMIT = 300  # [s] of a run
AT_ONCE = 2.0  # [s] from a kill to the end of the run; later ends are counted, for a busy machine needs longer
END_TIME = 0.02  # [s] of the gate, some seconds of wall time
UNDISTURBED = 3  # runs beside the load


class Run:
    """A run of the gate by the launcher, in a folder of its own."""

    def __init__(self, programs, cases, folder):
        self.out = pathlib.Path(folder) / "out"
        self.launcher = subprocess.Popen(
            program.python("launch", cases / "elastic_gate", f"--bin={programs}", f"--out={self.out}", "--no-report",
                           f"--end-time={END_TIME}", "--set=case.frame_interval=1e-3", "--set=case.series_interval=1e-4"),
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def pids(self):
        """Name -> process, of those that go on and write into the folder."""
        found = {}
        for path in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
            with contextlib.suppress(OSError):
                words = path.read_bytes().decode(errors="replace").split("\0")
                if f"--out={self.out}" in words and "--check" not in words and pathlib.Path(words[0]).name in ROLES:
                    found[pathlib.Path(words[0]).name] = int(path.parent.name)
        return found

    def kill(self, role):
        """Returns how long [s] the run went on, None if it had ended."""
        pids = self.pids()
        while len(pids) < len(ROLES) and self.launcher.poll() is None:  # it has not begun
            time.sleep(0.01)
            pids = self.pids()
        if self.launcher.poll() is not None:
            return None
        with contextlib.suppress(ProcessLookupError):
            os.kill((pids | {LAUNCHER: self.launcher.pid})[role], signal.SIGKILL)
        start = time.monotonic()
        while self.launcher.poll() is None or self.pids():
            assert time.monotonic() < start + LIMIT, f"{role} killed, and left: {self.pids()}"
            time.sleep(0.01)
        return time.monotonic() - start

    def end(self):
        """Exit code and words."""
        words = self.launcher.communicate(timeout=LIMIT)[1]
        return self.launcher.returncode, words

    def look_at_what_is_left(self):
        """Returns the number of files of HDF5 that were read."""
        assert not self.pids(), f"processes are left: {self.pids()}"
        files = [path for pattern in ("*.h5", "frames/*.hdf") for path in self.out.glob(pattern)]
        for path in files:
            with h5py.File(path) as file:
                file.visititems(lambda _, node: node[()] if isinstance(node, h5py.Dataset) else None)
        return len(files)


@contextlib.contextmanager
def load(count):
    """So many processes that compute without end."""
    busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(count)]
    try:
        yield
    finally:
        for process in busy:
            process.kill()
            process.wait()


def killed(start, role, moment):
    """(time to the end [s], files) of a run, None if it ended before the moment came."""
    with tempfile.TemporaryDirectory() as folder:
        run = start(folder)
        time.sleep(moment)
        took = run.kill(role)
        code, words = run.end()
        if took is None or code == DONE:
            return None
        if role == LAUNCHER:
            assert code == -signal.SIGKILL, f"{code}: {words}"
        else:
            named = f"{role} was killed by signal 9" in words
            assert code == PEER_LOST and named, f"{role} killed after {moment:.2f} s: {code}: {words}"
        return took, run.look_at_what_is_left()


def undisturbed(start):
    """How long [s] a run takes that is left alone."""
    with tempfile.TemporaryDirectory() as folder:
        began = time.monotonic()
        run = start(folder)
        code, words = run.end()
        assert code == DONE, f"a false alarm: {code}: {words}"
        run.look_at_what_is_left()
        return time.monotonic() - began


def main(programs, cases, count, others=0, seed=None):
    seed = int(seed) if seed else random.randrange(10**6)
    print(f"seed {seed}, load {os.getloadavg()[0]:.1f}", flush=True)
    chance = random.Random(seed)

    def start(folder):
        return Run(pathlib.Path(programs).resolve(), pathlib.Path(cases), folder)

    duration, took, files, late = undisturbed(start), collections.defaultdict(list), 0, 0
    while sum(map(len, took.values())) < int(count):
        role = chance.choice((*ROLES, LAUNCHER))
        if found := killed(start, role, chance.uniform(0, duration)):
            took[role].append(found[0])
            files += found[1]
            print(f"{role}: {found[0]:.2f} s, {found[1]} files", flush=True)
    for role, times in took.items():
        late += sum(time > AT_ONCE for time in times)
        print(f"{role} killed {len(times)} times: the run ended after {statistics.median(times):.2f} s, at most "
              f"{max(times):.2f} s; it was named each time")
    print(f"{files} files of HDF5 read, no process left; {late} ends later than {AT_ONCE} s, load {os.getloadavg()[0]:.1f}")
    with load(int(others)):
        for _ in range(UNDISTURBED if int(others) else 0):
            print(f"beside {others} processes that compute, a run took {undisturbed(start):.1f} s: no false alarm", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
