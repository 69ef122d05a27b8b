"""The processes of a run: started together, watched together, ended together. None is ever left behind."""

import contextlib
import ctypes
import os
import re
import select
import selectors
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field

GRACE = 1.0  # [s] in which the others end by themselves after one has failed: once joined they notice by the link at once
PATIENCE = 60.0  # [s] to end in order when asked to: the last checkpoint, frame and series are written
QUIET = 3.0  # [s] after a request to end in which nothing is said of those that have not ended yet
LAST_PATIENCE = 4.0  # [s] between the request and the kill for those that outlived their grace

# Exit codes, as in common/error/failure.hpp.
DONE, BUG, BAD_INPUT, PHYSICS_FAILED, PEER_LOST, MACHINE, INTERRUPTED = 0, 1, 2, 3, 4, 5, 130
MEANING = {
    DONE: "done",
    BUG: "a bug",
    BAD_INPUT: "bad input",
    PHYSICS_FAILED: "physics failed",
    PEER_LOST: "a peer was lost",
    MACHINE: "a fault of the machine",
    INTERRUPTED: "interrupted",
}
FAULTS = {signal.SIGSEGV, signal.SIGABRT, signal.SIGBUS, signal.SIGFPE, signal.SIGILL}  # a process's own doing

# What raises the limit of the machine that ended a process so. Ours end by themselves where a file may not grow.
LIMITS = {signal.SIGXCPU: "ulimit -t", signal.SIGXFSZ: "ulimit -f"}

# What a stand is sent in the place of a signal that would leave it no choice.
ASKS = {signal.SIGKILL: signal.SIGQUIT, signal.SIGSTOP: signal.SIGTSTP}

PR_SET_PDEATHSIG = 1
libc = ctypes.CDLL(None, use_errno=True)


def requests_to_end():
    """The signals that ask a run to end, but for those that are ignored: under nohup it outlives its terminal."""
    return [number for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
            if signal.getsignal(number) != signal.SIG_IGN]


def pauses():
    """The signal that stops a run until it is continued, unless it is ignored."""
    return [] if signal.getsignal(signal.SIGTSTP) == signal.SIG_IGN else [signal.SIGTSTP]


def own_pause():
    """Stops this process, as Ctrl-Z would; returns for how long [s] it was."""
    start = time.monotonic()
    signal.raise_signal(signal.SIGSTOP)  # to this thread: one to the process may find another, and this one goes on a while
    return time.monotonic() - start


def ends_with_this_process():
    """What a new process does first, so that it is asked to end if this one dies."""
    parent = os.getpid()

    def end_with_the_parent():
        for number in (signal.SIGINT, signal.SIGTERM):  # in a script's background they are ignored, and would stay so
            signal.signal(number, signal.SIG_DFL)
        libc.prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
        if os.getppid() != parent:
            os._exit(INTERRUPTED)

    return end_with_the_parent


def start(command, stream, environment=None, descriptors=(), errors=None):
    """Starts a process in a group of its own that is asked to end if this one dies. `stream` takes what it says, and
    `errors` what it says on standard error, if that is to be told apart; it has those `descriptors` of this process."""
    return subprocess.Popen(command, env=environment, stdin=subprocess.DEVNULL, stdout=stream,
                            stderr=errors or (subprocess.STDOUT if stream else None), process_group=0,
                            pass_fds=descriptors, preexec_fn=ends_with_this_process())


@dataclass
class Process:
    name: str
    command: list[str]
    popen: subprocess.Popen | None = None
    pidfd: int = -1
    ended: bool = False
    asked_to_end: bool = False  # by us, so how it ended says nothing
    overdue: bool = False  # it was ended, as the lead was done and it was not
    left_early: str = ""  # before what it ended as if all were done
    is_stand: bool = False  # for a program on another host: asked to pause and to end, not made to
    running: int = -1  # of a stand: readable when its program has ended, and it only brings here what that wrote
    unread: bytes = b""
    held_lines: list[str] = field(default_factory=list)  # its errors, shown if it is the cause

    @property
    def status(self):
        return self.popen.returncode

    def exit_code(self):
        """A process killed from outside is a lost peer, as is one that never took part; one that crashed is a bug, one at a
        limit of the machine its fault."""
        if self.left_early or self.overdue:
            return PEER_LOST
        if self.status >= 0:
            return self.status if self.status in MEANING else BUG
        return BUG if -self.status in FAULTS else MACHINE if -self.status in LIMITS else PEER_LOST

    def ask(self, number):
        """Sends a signal to its group."""
        if self.is_stand:
            number = ASKS.get(number, number)
        with contextlib.suppress(ProcessLookupError):  # it ended just now
            os.killpg(self.popen.pid, number)

    def is_over(self):
        """Whether the program has ended, here or where it is."""
        return self.ended or self.running >= 0 and bool(select.select([self.running], [], [], 0)[0])

    def reasons(self):
        """What it gives as reasons: its errors without its name and the kind of failure."""
        return list(map(without_kind, self.held_lines))

    def fate(self):
        if self.left_early:
            return f"ended with exit code {self.status} before {self.left_early}"
        if self.overdue:
            return f"was ended: it went on for {PATIENCE:.0f} s after the run was over"
        if self.status >= 0:
            return f"ended with exit code {self.status} ({MEANING.get(self.status, 'unknown')})"
        remedy = f"; raise '{LIMITS[-self.status]}'" if -self.status in LIMITS else ""
        return f"was killed by signal {-self.status} ({signal.strsignal(-self.status)}){remedy}"


def tell(line):
    """On standard error, over the progress line if there is one."""
    print(f"\r\x1b[K{line}" if sys.stderr.isatty() else line, file=sys.stderr, flush=True)


def weight(process):
    """Orders failures: what can only be a cause comes before what may be a consequence."""
    if process.asked_to_end:
        return 9
    if process.status < 0:
        return 4
    return weight_of(process.status)


def weight_of(exit_code):
    return {BAD_INPUT: 0, PHYSICS_FAILED: 1, MACHINE: 2, INTERRUPTED: 5, PEER_LOST: 6}.get(exit_code, 3)


def cause_of(failed, processes, lead):
    """The process whose failure brought the others', of those that failed, in this order. Where several end alike, one
    of them failed and told the others, who give its reason after its name. What the lead says goes to the terminal: it is
    the one if both others give the same reason."""
    least = min(map(weight, failed))
    alike = [process for process in failed if weight(process) == least]

    def is_passed_on(process):
        return any(line.endswith(f": {reason}") for reason in process.reasons()
                   for other in processes if other is not process for line in map(without_kind, other.held_lines))

    others = [process for process in alike if process.name != lead]
    if len(others) > 1 and len({tuple(process.reasons()) for process in others}) == 1:
        others = []
    return [*filter(is_passed_on, alike), *others, *(process for process in alike if process.name == lead), *alike][0]


def without_kind(line):
    """fluid_solver: error: physics failed: density -1 -> density -1"""
    return re.sub(r"^.*?\berror: (?:(?:physics failed|peer lost|the machine|unexpected): )?", "", line)


class Run:
    """Starts `commands` (name -> command line). `lead` keeps the terminal, for its progress line; the others' lines
    are passed on, errors only of the one that caused the end. Those of `stands` stand for programs on other hosts.
    `have_met` tells whether the run of several has begun."""

    def __init__(self, commands, lead, environment, stands=(), have_met=lambda: True):
        self.processes = [Process(name, command, is_stand=name in stands) for name, command in commands.items()]
        self.lead = lead
        self.environment = environment
        self.have_met = have_met
        self.selector = selectors.DefaultSelector()
        self.failed = []  # in the order in which they failed
        self.interruptions = 0
        self.deadline = None  # when those that remain are asked to end, then killed
        self.notice = None  # when it is said who has not ended since the interruption
        self.doubt = None  # when it is looked at whether the run of one that is done has begun at all

    def __call__(self):
        """Runs to the end; returns the exit code of the run and what to say of it ("" if all is well)."""
        wakeup = self._catch_signals()
        try:
            for process in self.processes:
                self._start(process)
            while not all(p.ended for p in self.processes):
                self._wait()
        finally:
            self._kill_all()
            self._restore_signals(wakeup)
        return self._verdict()

    def _start(self, process):
        stream = None if process.name == self.lead else subprocess.PIPE
        if process.is_stand:
            process.running, end = os.pipe()
            process.popen = start([*process.command, str(end)], stream, self.environment, [end])
            os.close(end)
        else:
            process.popen = start(process.command, stream, self.environment)
        process.pidfd = os.pidfd_open(process.popen.pid)
        self.selector.register(process.pidfd, selectors.EVENT_READ, lambda: self._ended(process))
        if stream:
            os.set_blocking(process.popen.stdout.fileno(), False)
            self.selector.register(process.popen.stdout.fileno(), selectors.EVENT_READ, lambda: self._pass_on(process))

    def _wait(self):
        limits = [limit for limit in (self.deadline, self.notice, self.doubt) if limit is not None]
        for key, _ in self.selector.select(max(0.0, min(limits) - time.monotonic()) if limits else None):
            if key.fileobj in self.selector.get_map():  # what came before may have ended it
                key.data()
        if self.notice is not None and time.monotonic() >= self.notice:
            self._tell_who_is_waited_for()
        if self.doubt is not None and time.monotonic() >= self.doubt:
            self._look_for_absent()
        if self.deadline is not None and time.monotonic() >= self.deadline:
            self._end_the_rest()

    def _ended(self, process):
        if process.popen.poll() is None:
            return
        process.ended = True
        self.selector.unregister(process.pidfd)
        os.close(process.pidfd)
        if process.is_stand:
            os.close(process.running)
        if process.popen.stdout and process.popen.stdout.fileno() in self.selector.get_map():
            self._pass_on(process)
        if process.status == 0 and self.doubt is None:
            self.doubt = time.monotonic() + GRACE
        if process.status == 0 and process.name == self.lead:
            self._expect_end(PATIENCE)
            self.notice = time.monotonic() + QUIET
        if process.status != 0:
            self.failed.append(process)
            self._expect_end(GRACE)

    def _expect_end(self, seconds):
        """Of those that remain, unless it is expected sooner, or they were asked to end."""
        end = time.monotonic() + seconds
        if self.deadline is None or end < self.deadline and not self.interruptions:
            self.deadline = end

    def _pass_on(self, process):
        stream = process.popen.stdout.fileno()
        try:
            while piece := os.read(stream, 1 << 16):
                process.unread += piece
        except BlockingIOError:
            if not process.ended:  # more may come; what there is ends with a line or will
                *lines, process.unread = process.unread.split(b"\n")
                return self._show(process, lines)
        self.selector.unregister(stream)
        self._show(process, process.unread.splitlines())

    def _show(self, process, lines):
        for line in (line.decode(errors="replace") for line in lines):
            if re.search(r"\berror:", line, re.IGNORECASE):
                process.held_lines.append(line)
            else:
                tell(line)

    def _tell_who_is_waited_for(self):
        self.notice = None
        rest = [p.name for p in self.processes if not (p.ended if self.interruptions else p.is_over())]
        if rest:
            what = ("to write a last checkpoint, for {} s at most; Ctrl-C again ends them at once" if self.interruptions else
                    "to end, for {} s at most: the run is over")
            tell(f"waiting for {', '.join(rest)} {what.format(round(PATIENCE))}")

    def _look_for_absent(self):
        """A program that is done before the programs have met leaves the others to wait in vain."""
        self.doubt = None
        if self.deadline is not None or self.have_met() or any(p.is_over() for p in self.processes if p.name == self.lead):
            return
        for process in (p for p in self.processes if p.ended):
            process.left_early = "it had joined the run: no participant of a coupled run"
            self.failed.append(process)
        self.deadline = time.monotonic()

    def _look_for_deserters(self):
        """Where all that failed lost a peer, the peer is one that ended as if all were done."""
        if any(weight(process) < weight_of(PEER_LOST) for process in self.failed):
            return
        if any(process.status == DONE for process in self.processes if process.name == self.lead):
            return  # the run was over
        for process in self.processes:
            if process.status == DONE and process.name != self.lead and not process.asked_to_end:
                process.left_early = "the run was over"
                self.failed.append(process)

    def _end_the_rest(self):
        rest = [p for p in self.processes if not p.is_over()]
        if not rest or any(p.asked_to_end for p in rest):
            self._signal(rest, signal.SIGKILL)
            self.deadline = None
        else:
            for process in rest:
                process.overdue = not self.failed and not self.interruptions
            self._signal(rest, signal.SIGTERM)
            self.deadline = time.monotonic() + LAST_PATIENCE

    def _signal(self, processes, number):
        for process in processes:
            process.asked_to_end = process.asked_to_end or not process.is_over()
            process.ask(number)

    def _kill_all(self):
        started = [p for p in self.processes if p.popen and not p.ended]
        for process in started:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.popen.pid, signal.SIGKILL)
        for process in started:
            process.popen.wait()

    def _catch_signals(self):
        reader, writer = os.pipe()
        for end in (reader, writer):
            os.set_blocking(end, False)
        old_wakeup = signal.set_wakeup_fd(writer)
        numbers = [*requests_to_end(), *pauses()]
        handlers = {n: signal.signal(n, lambda *_: None) for n in numbers}
        self.selector.register(reader, selectors.EVENT_READ, lambda: self._signalled(reader))
        return reader, writer, old_wakeup, handlers

    def _restore_signals(self, wakeup):
        reader, writer, old_wakeup, handlers = wakeup
        signal.set_wakeup_fd(old_wakeup)
        for number, handler in handlers.items():
            signal.signal(number, handler)
        self.selector.close()
        os.close(reader)
        os.close(writer)

    def _signalled(self, reader):
        numbers = set(os.read(reader, 64))
        if signal.SIGTSTP in numbers:
            self._pause()
        if numbers & set(requests_to_end()):
            self._interrupted(numbers)

    def _pause(self):
        """Ctrl-Z stops all, and all go on together."""
        rest = [p for p in self.processes if not p.ended]
        for process in rest:
            process.ask(signal.SIGSTOP)
        away = own_pause()
        for process in rest:
            process.ask(signal.SIGCONT)
        self.deadline, self.notice, self.doubt = (limit and limit + away for limit in (self.deadline, self.notice, self.doubt))

    def _interrupted(self, numbers):
        self.interruptions += 1
        rest = [p for p in self.processes if not p.ended]
        if self.interruptions == 1:
            self._signal(rest, signal.SIGINT)
            self.deadline = time.monotonic() + PATIENCE
            self.notice = time.monotonic() + QUIET
        elif signal.SIGINT in numbers and self.interruptions == 2:  # the user insists
            self._signal(rest, signal.SIGKILL)
        elif signal.SIGINT in numbers:  # what hosts wrote is given up
            self._kill_all()

    def _verdict(self):
        if self.interruptions and self.failed:
            return INTERRUPTED, "interrupted"
        if not self.failed:
            return DONE, ""
        self._look_for_deserters()
        cause = cause_of(self.failed, self.processes, self.lead)
        return cause.exit_code(), "\n".join(cause.held_lines + [f"{cause.name} {cause.fate()}"])

