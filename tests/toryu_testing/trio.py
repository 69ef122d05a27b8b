"""Starts the three processes of a coupled run, waits for them with limits, and leaves none behind."""
import csv
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import time

import h5py

CASE = pathlib.Path(__file__).resolve().parent.parent / "participants" / "strip"
ROLES = ("coupler", "fluid", "solid")
COUPLED_ENVIRONMENT = {"OMP_WAIT_POLICY": "passive"}  # as in a run: who waits leaves the core to the others
WALL_TIMES = {"round_trip[s]", "fluid_compute[s]", "solid_compute[s]"}  # columns of coupler.csv
FOREVER = "1e6"  # seconds of simulated time: the test ends such a run


def results_of(out):
    """All that a run has left of its interface, series and frames, but for wall times: name -> content."""
    found = {}
    for path in out.glob("*.csv"):
        with open(path, encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        found[path.name] = [[value for key, value in row.items() if key not in WALL_TIMES] for row in rows]
    for path in [*out.glob("*.h5"), *out.glob("frames/*.hdf")]:
        with h5py.File(path) as file:
            datasets = []
            file.visititems(lambda name, node: datasets.append(name) if isinstance(node, h5py.Dataset) else None)
            for name in datasets:
                found[f"{path.name}:{name}"] = (file[name].shape, file[name][()].tobytes())
    return found


class Trio:
    """A coupled run in a results folder of its own. `programs` maps a role to an executable."""

    def __init__(self, programs, case=CASE, end_time=FOREVER, settings=()):
        self.programs, self.case, self.end_time, self.settings = programs, case, end_time, list(settings)
        self.out = pathlib.Path(tempfile.mkdtemp(prefix="toryu_"))
        self.processes = {}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in self.processes.values():
            if process.poll() is None:
                process.kill()
                process.wait()
        shutil.rmtree(self.out, ignore_errors=True)

    def command(self, role):
        return [self.programs[role], self.case, "--out", self.out, "--end-time", self.end_time]

    def start(self, role, name=None, extra=(), environment={}):
        """Starts the program of a role; `name` tells two of one role apart."""
        command = self.command(role)
        for setting in self.settings:
            command += ["--set", setting]
        errors = open(self.out / f"{name or role}.err", "w")
        with errors:
            self.processes[name or role] = subprocess.Popen(
                [str(word) for word in command + list(extra)], stdout=errors, stderr=errors,
                env=os.environ | COUPLED_ENVIRONMENT | environment)
        return self

    def start_all(self, extra=()):
        for role in self.programs:
            self.start(role, extra=extra)
        return self

    def signal(self, name, number):
        self.processes[name].send_signal(number)

    def kill(self, name):
        self.signal(name, signal.SIGKILL)
        self.processes[name].wait()

    def wait(self, name, limit):
        """The exit code; raises subprocess.TimeoutExpired if the process does not end within the limit."""
        return self.processes[name].wait(limit)

    def ending_of(self, name, limit):
        """Exit code and what the process said on standard error."""
        code = self.wait(name, limit)
        return code, (self.out / f"{name}.err").read_text()

    def wait_for_log(self, pattern, limit):
        """Returns when a line of the common log matches the regular expression."""
        end = time.monotonic() + limit
        log = self.out / "log.txt"
        while not (log.exists() and re.search(pattern, log.read_text())):
            if time.monotonic() > end:
                raise AssertionError(f"'{pattern}' does not come in the log")
            time.sleep(0.05)

    def windows(self):
        """The last window in coupler.csv so far, 0 if there is none yet."""
        for path in (self.out / "coupler.csv", self.out / "coupler.csv.part"):
            if path.exists():
                lines = [line for line in path.read_text().splitlines() if line]
                if len(lines) > 1 and lines[-1].count(",") == lines[0].count(","):
                    column = lines[0].split(",").index("window[1]")
                    return float(lines[-1].split(",")[column])
        return 0

    def wait_for_checkpoint(self, beyond=0, limit=30):
        """Returns the number of the newest whole checkpoint, once there is one newer than the given one."""
        end = time.monotonic() + limit
        while True:
            whole = sorted(self.out.glob("checkpoint/*/manifest.toml"))
            if whole and int(whole[-1].parent.name) > beyond:
                return int(whole[-1].parent.name)
            if time.monotonic() > end:
                raise AssertionError("no checkpoint is written")
            time.sleep(0.01)

    def results(self):
        return results_of(self.out)

    def wait_until_running(self, beyond=0, limit=30):
        """Returns when windows beyond the given one have passed."""
        end = time.monotonic() + limit
        while self.windows() <= beyond:
            for role in ROLES:
                if role in self.processes and self.processes[role].poll() is not None:
                    raise AssertionError("%s ended with %d: %s" % (role, *self.ending_of(role, 0)))
            if time.monotonic() > end:
                raise AssertionError("no window passes")
            time.sleep(0.05)
        return self
