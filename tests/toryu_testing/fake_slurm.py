#!/usr/bin/python3
"""Stands for sbatch, squeue and scancel, by whose names it is started: jobs are processes of this machine, all at once. What
it was asked is in `asked.txt` beside it. A file `lose` there loses the next job that would start; `refuse` refuses."""

import os
import pathlib
import signal
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
JOBS = HERE / "jobs"
name, arguments = pathlib.Path(sys.argv[0]).name, sys.argv[1:]
with open(HERE / "asked.txt", "a") as asked:
    asked.write(" ".join([name, *arguments]) + "\n")


def option(key, default=""):
    return next((a.partition("=")[2] for a in arguments if a.startswith(key + "=")), default)


def alive(job):
    path = JOBS / job
    return path.exists() and pathlib.Path(f"/proc/{path.read_text()}/stat").exists() and \
        pathlib.Path(f"/proc/{path.read_text()}/stat").read_text().rpartition(")")[2].split()[0] != "Z"


if name == "sbatch":
    if (HERE / "refuse").exists():
        sys.exit("sbatch: error: invalid partition specified: nowhere")
    JOBS.mkdir(exist_ok=True)
    array = len({path.name.partition("_")[0] for path in JOBS.iterdir()}) + 1
    first, _, last = option("--array").partition("%")[0].partition("-")
    for index in range(int(first), int(last) + 1):
        job = f"{array}_{index}"
        (JOBS / job).write_text("0")
        if (HERE / "lose").exists():
            (HERE / "lose").unlink()
            continue
        with open(option("--output").replace("%a", str(index)).replace("%%", "%"), "w") as output:
            started = subprocess.Popen(["/bin/sh", arguments[-1]], env=os.environ | {"SLURM_ARRAY_TASK_ID": str(index)},
                                       stdout=output, stderr=output, stdin=subprocess.DEVNULL, start_new_session=True)
        (JOBS / job).write_text(str(started.pid))
    print("Welcome to the cluster; you have 12 hours left", f"{array};main", sep="\n")
elif name == "squeue":
    wanted = option("--jobs").split(",")
    print(*(path.name for path in JOBS.iterdir() if path.name.partition("_")[0] in wanted and alive(path.name)), sep="\n")
elif name == "scancel" and "--state=PENDING" not in arguments:
    for job in arguments:
        if alive(job):
            os.kill(int((JOBS / job).read_text()), signal.SIGTERM)
