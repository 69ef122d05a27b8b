"""Hosts that are reached by ssh as the queue of a study: GNU parallel gives them the runs."""

import os
import signal
import subprocess

from toryu import program
from toryu.processes import PATIENCE, start

PROGRAMS = ("parallel",)


class Hosts:
    largest = 100_000  # runs of a submission
    outlives_study = False

    def __init__(self, hosts, jobs, threads):
        """`hosts`: a file with one a line, or a list with commas, as GNU parallel reads them ("4/name": 4 runs at most);
        `jobs` at a time on each, None: as many as fit its cores."""
        self.hosts = [f"--sshloginfile={os.path.abspath(hosts)}"] if os.path.isfile(hosts) else [f"--sshlogin={hosts}"]
        self.jobs = jobs
        self.at_a_time = str(jobs) if jobs else f"{max(1, 100 // threads)}%"
        self.processes = {}  # number of the submission -> process

    def submit(self, table, count, _):
        command = ["parallel", "--will-cite", *self.hosts, f"--jobs={self.at_a_time}", f"--workdir={os.getcwd()}",
                   "--quote", *program.python("study.one_run", table), "{}", ":::", *map(str, range(count))]
        with open(self.output(table, 0), "wb") as output:
            process = start(command, output)
        self.processes[str(process.pid)] = process
        return [f"{process.pid}_{index}" for index in range(count)]

    def output(self, table, _):
        """One file for all of a submission."""
        return table.with_suffix(".txt")

    def alive(self, jobs):
        """Those of submissions that have not ended; how each of their runs stands, its folder tells."""
        return {job for job in jobs if (process := self.processes.get(job.partition("_")[0])) and process.poll() is None}

    def drop(self, jobs):
        self._send(jobs, signal.SIGTERM)  # once: no further run is started

    def kill(self, jobs):
        self._send(jobs, signal.SIGTERM)
        for process in self.processes.values():
            try:
                process.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()

    def _send(self, jobs, number):
        for name in {job.partition("_")[0] for job in self.alive(jobs)}:
            self.processes[name].send_signal(number)
