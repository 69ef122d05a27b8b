"""Stands for a program that is on another host: starts it there, hands it the case, says what it says, writes here what it
writes there, passes signals on, and ends as it ends.

    python3 -I -X utf8 tools/toryu remote JOB [DESCRIPTOR]

JOB is a remote.job.Job as JSON. Without DESCRIPTOR, which is closed when the program has ended, the host is only looked at.
"""

import contextlib
import os
import pathlib
import queue
import re
import resource
import signal
import sys
import threading

from toryu import program
from toryu.processes import BAD_INPUT, DONE, MACHINE, own_pause, requests_to_end
from toryu.remote.channel import PULSE, ChannelClosed
from toryu.remote.connection import Connection, HostFailed
from toryu.remote.job import Job, argument, place, restart_files
from toryu.remote.mirror import CHECKPOINTS, Receiver, remove, send_file
from toryu.results_folder import newest_checkpoint

TICK = 0.1  # [s] between looks at what the host of the lead is to have
KILL = signal.SIGQUIT  # asks for the end of the program, not of the collecting


def is_same(version, other):
    """Whether two programs tell one version and one commit."""
    told = [re.search(r"of toryu (\S+) \(commit ([^,)]+)", text) for text in (version, other)]
    return all(told) and told[0].groups() == told[1].groups()


class Stand:
    """Stands for the program of `job`."""

    def __init__(self, job):
        self.job = job
        self.out = pathlib.Path(job.out)
        self.participant = job.name.removesuffix("_solver")
        self.receiver = Receiver(self.out)
        self.work = ""  # the folder of the run there
        self.connection = Connection(job)
        self.channel = self.connection.channel
        self.asked = queue.SimpleQueue()  # signals to pass on
        self.there = set()  # parts of checkpoints that the host has, as names in the results

    def look(self):
        """Whether the program can run there. Raises HostFailed."""
        self._send("check", program=self.job.program, folder=self.job.folder, limit=self.connection.limit,
                   asks_version=bool(self.job.version), out=place(self.job.out), is_lead=self.job.is_lead)
        message, _ = self._awaited("checked")
        if self.job.version and not is_same(message["version"], self.job.version):
            found = message["version"].splitlines()[-1] if message["version"] else "tells no version"
            raise HostFailed(f"error: {self.job.address}: {self.job.program} is another version ({found}) than here "
                             f"({self.job.version}): build the same commit there, or give its folder by --remote-bin",
                             BAD_INPUT)
        self.work = message["work"]

    def run(self, ended):
        """Runs the program; closes the descriptor `ended` when it has ended. Returns its status."""
        self.look()
        self._hand_over()
        command = [self.job.program, argument(self.job.case, self.work), f"--out={argument(self.job.out, self.work)}",
                   *self.job.arguments]
        self._send("start", command=command, folder=place("."), environment=of_threads() | {"PYTHONPATH": self.job.packages},
                   has_terminal=self.job.is_lead and sys.stderr.isatty())
        self._awaited("started")
        threading.Thread(target=self._pass_on_signals, daemon=True).start()
        while True:
            message, data = self.connection.receive(TICK)
            match message["kind"]:
                case "output":
                    sys.stderr.buffer.write(data)
                    sys.stderr.buffer.flush()
                case "log":
                    append(self.out / "log.txt", data)
                case "file":
                    self.there.add(message["name"])
                    self.receiver.take(message, data)
                case "gone":
                    remove(self.out, message["name"])
                case "over":
                    os.close(ended)
                case "ended":
                    return message["status"]
            if self.job.is_lead and self.job.is_coupled:
                self._bring_to_lead()

    def ask(self, number):
        self.asked.put(number)

    def _hand_over(self):
        for path in self.job.files:
            self._send_file(path)
        if self.job.is_coupled:
            self._send_file(self.out / "run.secret")
        if self.job.restarts:
            needed = restart_files(self.out, newest_checkpoint(self.out), self.participant, self.job.is_lead)
            for path, is_needed in needed.items():
                self._send_file(path if is_needed else os.devnull, place(path), known=True)
                self.there.add(path.relative_to(self.out).as_posix())

    def _send_file(self, path, name=None, known=False):
        try:
            send_file(self.channel, path, name or place(path), known=known)
        except ChannelClosed:
            self._tell_why_closed()

    def _bring_to_lead(self):
        """The parts of checkpoints that others wrote, and the wish to stop."""
        wanted = [path for path in self.out.glob(f"{CHECKPOINTS}/*/*.state")
                  if path.relative_to(self.out).as_posix() not in self.there]
        for path in wanted:
            with contextlib.suppress(FileNotFoundError):
                self._send_file(path, known=True)
                self.there.add(path.relative_to(self.out).as_posix())
        with contextlib.suppress(FileNotFoundError):
            (self.out / "stop").unlink()
            self._send_file(os.devnull, place(self.out / "stop"))

    def _pass_on_signals(self):
        """And signs of life. Ctrl-Z stops the program, then this process."""
        with contextlib.suppress(ChannelClosed):
            while True:
                try:
                    number = self.asked.get(timeout=PULSE)
                except queue.Empty:
                    self.channel.send("alive")
                    continue
                if number == signal.SIGTSTP:
                    self.channel.send("signal", number=int(signal.SIGSTOP))
                    own_pause()
                    number = signal.SIGCONT
                self.channel.send("signal", number=int(signal.SIGKILL if number == KILL else number))

    def _send(self, kind, **content):
        try:
            self.channel.send(kind, **content)
        except ChannelClosed:
            self._tell_why_closed()

    def _tell_why_closed(self):
        """Its last words say why the host takes no more. Raises HostFailed."""
        while True:
            self.connection.receive(TICK)

    def _awaited(self, kind):
        while True:
            message, data = self.connection.receive(TICK)
            if message["kind"] == kind:
                return message, data


def of_threads():
    """What the environment says of threads, which holds for all programs of the run."""
    return {name: value for name, value in os.environ.items() if name.startswith(("OMP_", "GOMP_"))}


def append(path, lines):
    """In one go, since others append too."""
    file = os.open(path, os.O_WRONLY | os.O_APPEND | os.O_CREAT | os.O_CLOEXEC, 0o644)
    try:
        os.write(file, lines)
    finally:
        os.close(file)


def end_as(status):
    """By the signal that ended the program, if it was one."""
    if status < 0:
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        with contextlib.suppress(OSError):  # SIGKILL
            signal.signal(-status, signal.SIG_DFL)
        os.kill(os.getpid(), -status)
    return status


def main(arguments):
    job = Job.of_text(arguments[0])
    stand = None
    try:
        stand = Stand(job)
        if len(arguments) == 1:
            stand.look()
            return DONE
        for number in (*requests_to_end(), signal.SIGTSTP, KILL):
            signal.signal(number, lambda number, _: stand.ask(number))
        status = stand.run(int(arguments[1]))
    except HostFailed as failure:
        print(f"{job.name}: {failure}", file=sys.stderr)
        return failure.code
    finally:
        if stand is not None:
            stand.receiver.give_up()
            stand.connection.close()
    if status == MACHINE:
        print(f"{job.name}: error: it was on {job.address}, where it wrote below {stand.work} until all was brought here; "
              "--remote-folder gives another folder there", file=sys.stderr)
    return end_as(status)


if __name__ == "__main__":
    program.run(main)
