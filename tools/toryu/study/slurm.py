"""Slurm as the queue of a study: an array of jobs a submission."""

import re
import shlex
import subprocess

from toryu import program
from toryu.processes import MACHINE
from toryu.study.runner import Ended

PROGRAMS = ("sbatch", "squeue", "scancel")
SIGNAL_BEFORE_LIMIT = 60  # [s] before the limit of time, in which a run writes its last checkpoint
PATIENCE = 60  # [s] for an answer
UNKNOWN = "Invalid job id"  # squeue says so once none of the jobs is known


class Slurm:
    largest = 1000  # jobs of an array: Slurm's own default (MaxArraySize)
    outlives_study = True

    def __init__(self, name, jobs, threads, options):
        """At most `jobs` at a time, None: as many as there is room for; `options` of sbatch as the user gives them."""
        self.name, self.jobs, self.threads, self.options = name, jobs, threads, options

    def submit(self, table, count, former):
        """The names of the jobs that run the lines of `table`. Only an array knows how many of its jobs may run at a time, so
        one that is limited waits for the array of the jobs `former`."""
        script = table.with_suffix(".sh")
        words = shlex.join(program.python("study.one_run", table))
        program.write_whole(script, f'#!/bin/sh\nexec {words} "$SLURM_ARRAY_TASK_ID"\n')
        most = f"%{self.jobs}" if self.jobs else ""
        turn = [f"--dependency=afterany:{former[0].partition('_')[0]}"] if former and self.jobs else []
        output = f"{str(table.parent).replace('%', '%%')}/{self.output(table, '%a').name}"
        # A lost run is given to the queue again from its checkpoint: Slurm must not start it a second time from its beginning.
        done = ask(["sbatch", "--parsable", f"--job-name={self.name}", f"--array=0-{count - 1}{most}", "--ntasks=1",
                    f"--cpus-per-task={self.threads}", f"--signal=B:TERM@{SIGNAL_BEFORE_LIMIT}", "--no-requeue",
                    f"--output={output}", *turn, *self.options, str(script)])
        answer = re.search(r"^(\d+)(;.*)?$", done.stdout, re.MULTILINE)  # sites print words of their own before it
        if done.returncode != 0 or not answer:
            raise Ended(MACHINE, f"sbatch refused the runs: {(done.stderr + done.stdout).strip()}")
        array = answer[1]
        return [f"{array}_{index}" for index in range(count)]

    def output(self, table, index):
        return table.with_name(f"{table.stem}_{index}.txt")

    def alive(self, jobs):
        """Those that wait or run; all of them while Slurm does not answer."""
        arrays = sorted({job.partition("_")[0] for job in jobs})
        done = ask(["squeue", "--noheader", "--array", "--format=%i", f"--jobs={','.join(arrays)}"])
        if done.returncode != 0:
            return set() if UNKNOWN in done.stderr else set(jobs)
        return set(jobs) & set(done.stdout.split())

    def drop(self, jobs):
        """Takes back those that wait."""
        ask(["scancel", "--state=PENDING", *jobs])

    def kill(self, jobs):
        ask(["scancel", *jobs])


def ask(command):
    try:
        return subprocess.run(command, capture_output=True, encoding="utf-8", errors="replace", stdin=subprocess.DEVNULL,
                              timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        return subprocess.CompletedProcess(command, 1, "", f"{command[0]} has not answered for {PATIENCE} s")
