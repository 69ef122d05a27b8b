"""The fluid of a run over MPI ranks: which run may have them, and the process that stands for all of them.

    python3 -I -X utf8 tools/toryu ranks N PROGRAM ARGUMENTS ...

It starts mpirun, ends as the rank does that leads, and says in a line which rank was lost if one was."""

import os
import re
import select
import signal
import subprocess
import sys

from toryu import PROGRAMS, program
from toryu.processes import BUG, FAULTS, INTERRUPTED, MEANING, PEER_LOST, requests_to_end, start

BIN = PROGRAMS.parents[1] / "ranks/bin"  # of the build with MPI
# More ranks than cores may be asked for. A rank that waits gives its core to those that compute.
OPTIONS = ["--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1"]
AS_ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}  # in a container there is nobody else
# What mpirun says of a rank that died.
LOST = re.compile(r"mpirun noticed that process rank (\d+) with PID \d+ on node \S+ exited on signal (\d+) \(([^)]*)\)")
RULE = re.compile(r"-{20,}")  # before and behind what mpirun says of itself


def fault_of(options, names):
    """What is wrong with --ranks in this run of the programs `names`; "" if nothing is."""
    if options.ranks is None:
        return ""
    where = f"--ranks {options.ranks}: error:"
    if not re.fullmatch(r"[1-9]\d{0,4}", options.ranks):
        return f"{where} must be a number of processes, 1 or more"
    if "fluid_solver" not in names:
        return f"{where} the case has no fluid, which alone goes over ranks"
    if options.fluid:
        return f"{where} {options.fluid} in the place of fluid_solver does not go over ranks"
    if any(text.startswith("fluid=") for text in options.host):
        return f"{where} the ranks are processes of this machine: leave --host fluid=ADDRESS out"
    if options.only == "solid":
        return f"{where} with --only solid no fluid is computed"
    if not (BIN / "fluid_solver").exists():
        return f"{where} {BIN / 'fluid_solver'} is not built: 'tools/build.sh ranks fluid_solver' builds it"
    return ""


def over_ranks(options, commands):
    """The commands of a run, with that of the fluid over its ranks."""
    if options.ranks is None:
        return commands
    _, *arguments = commands["fluid_solver"]
    if not options.threads:
        arguments.append(f"--threads={max(1, len(os.sched_getaffinity(0)) // int(options.ranks))}")
    return commands | {"fluid_solver": program.python("ranks", options.ranks, BIN / "fluid_solver", *arguments)}


class Listener:
    """Passes on what the ranks say, and keeps what mpirun says of itself."""

    def __init__(self):
        self.unread, self.in_box, self.box, self.asked_to_end = b"", False, [], False

    def hear(self, piece):
        *lines, self.unread = (self.unread + piece).split(b"\n")
        for line in (line.decode(errors="replace") for line in lines):
            if RULE.fullmatch(line.strip()):
                self.in_box = not self.in_box
            elif self.in_box:
                self.box.append(line.strip())
            else:
                print(line, file=sys.stderr)

    def death(self, count):
        """Of a rank, if one died: the exit code, and a line. As of a process by itself, a crash is a bug."""
        lost = LOST.search(" ".join(self.box))
        if not lost:
            return None
        if self.asked_to_end and int(lost[2]) == signal.SIGUSR1:  # before it could take that for a request
            return INTERRUPTED, "fluid_solver: interrupted before the run began"
        code, kind = (BUG, "unexpected") if int(lost[2]) in FAULTS else (PEER_LOST, "peer lost")
        return code, (f"fluid_solver: error: {kind}: rank {lost[1]} of {count} was ended by signal {lost[2]} ({lost[3]}); "
                      "mpirun has ended the others")


def follow(ranks, listener):
    """Waits for mpirun to end. What asks this process to end, the rank that leads hears."""
    reader, writer = os.pipe()
    os.set_blocking(writer, False)
    signal.set_wakeup_fd(writer)
    for number in requests_to_end():
        signal.signal(number, lambda *_: None)
    stream = ranks.stderr.fileno()
    while True:
        ready, _, _ = select.select([stream, reader], [], [])
        if reader in ready:
            os.read(reader, 64)
            listener.asked_to_end = True
            ranks.send_signal(signal.SIGUSR1)
        if stream in ready:
            if not (piece := os.read(stream, 1 << 16)):
                return ranks.wait()
            listener.hear(piece)


def main(arguments):
    count, path, *rest = arguments
    os.environ.update(AS_ROOT)
    ranks = start(["mpirun", *OPTIONS, "-n", count, path, *rest], None, errors=subprocess.PIPE)
    listener = Listener()
    code = follow(ranks, listener)
    if death := listener.death(count):
        print(death[1], file=sys.stderr)
        return death[0]
    if code not in MEANING:
        print(*listener.box, sep="\n", file=sys.stderr)
    return code if code in MEANING else BUG


if __name__ == "__main__":
    program.run(main)
