"""The part of a run that is on another host: starts one program there, passes on what it says, sends what it writes, and
leaves neither process nor file behind, whatever becomes of the connection. It is sent there, so it needs nothing of toryu but
what is sent with it (connection.py) and Python's standard library."""

import contextlib
import ctypes
import os
import pathlib
import pty
import select
import shutil
import signal
import subprocess
import tempfile
import threading
import time

from toryu.remote.channel import PIECE, Channel, ChannelClosed, Silence, keep_alive
from toryu.remote.mirror import Mirror, Receiver

MARK = b"\ntoryu agent\n"  # ends what a login says of itself
TICK = 0.05  # [s] between looks at checkpoints and the log
COPY_INTERVAL, COPY_SHARE = 5.0, 0.05  # results are copied so often [s], but take no more than this share of the time
VERSION_LIMIT = 20.0  # [s] in which a program tells its version
PR_SET_PDEATHSIG = 1


class Fault(Exception):
    """Why the program cannot run here."""

    def __init__(self, text, is_machine=False):
        super().__init__(text)
        self.is_machine = is_machine


class Agent:
    def __init__(self, channel):
        self.channel = channel
        self.work = None  # folder of the run here
        self.process = None
        self.log_read = 0  # [bytes]
        self.limit = 60.0  # [s] of silence after which the run is given up
        self.is_paused = False

    def work_through(self):
        """Until the program has ended, or nobody listens any more. Messages are taken by a thread that may always read, so
        that the end of the connection is noticed whatever else is going on."""
        keep_alive(self.channel)
        start = None
        while start is None:
            message, data = self.channel.receive(self.limit)
            if message["kind"] == "check":
                self.limit = message["limit"]
                self._check(message)
            elif message["kind"] == "file":
                self._take(message, data)
            else:
                start = message
        self._start(start)
        obeying = threading.Thread(target=self._obey, daemon=True)
        obeying.start()
        self._watch()
        obeying.join()  # until all is taken

    def clean_up(self):
        self.kill()
        if self.work is not None:
            shutil.rmtree(self.work, ignore_errors=True)

    def kill(self):
        if self.process is not None:
            with contextlib.suppress(ProcessLookupError, PermissionError):
                os.killpg(self.process.pid, signal.SIGKILL)

    def _check(self, wanted):
        """Tells the version of the program, and makes the folder of the run."""
        program = wanted["program"]
        if not shutil.which(program):
            raise Fault(f"has no program {program}")
        version = ""
        if wanted["asks_version"]:
            with contextlib.suppress(subprocess.TimeoutExpired, OSError):
                version = subprocess.run([program, "--version"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                         stdin=subprocess.DEVNULL, timeout=VERSION_LIMIT).stdout.decode(errors="replace")
        folder = wanted["folder"] or tempfile.gettempdir()
        try:
            self.work = pathlib.Path(tempfile.mkdtemp(prefix="toryu_", dir=folder))
            self.receiver = Receiver(self.work)
        except OSError as error:
            raise Fault(f"{folder}: {error.strerror}", is_machine=True) from error
        self.mirror = Mirror(self.work / wanted["out"], self.channel, wanted["is_lead"])
        self.channel.send("checked", version=version.strip(), work=str(self.work))

    def _take(self, message, data):
        path = self.receiver.take(message, data)
        if path and message["known"]:
            self.mirror.note(path)

    def _obey(self):
        """What the run asks for while the program runs."""
        try:
            while True:
                message, data = self.channel.receive(None if self.is_paused else self.limit)
                if message["kind"] == "signal":
                    self.is_paused = message["number"] == signal.SIGSTOP
                    with contextlib.suppress(ProcessLookupError):
                        os.killpg(self.process.pid, message["number"])
                elif message["kind"] == "file":
                    self._take(message, data)
        except OSError as error:  # of a file: the run goes on, but for its checkpoints
            with contextlib.suppress(ChannelClosed):
                self.channel.send("output", f"warning: {error}\n".encode())
        except (ChannelClosed, Silence):
            pass
        self.clean_up()
        os._exit(1)

    def _start(self, start):
        folder = self.work / start["folder"]
        folder.mkdir(parents=True, exist_ok=True)
        self.mirror.root.mkdir(parents=True, exist_ok=True)
        self.reader, writer = pty.openpty() if start["has_terminal"] else os.pipe()
        self.process = subprocess.Popen(start["command"], cwd=folder, env={**os.environ, **start["environment"]},
                                        stdin=subprocess.DEVNULL, stdout=writer, stderr=writer, start_new_session=True,
                                        preexec_fn=end_with_the_parent)
        os.close(writer)
        self.channel.send("started")

    def _watch(self):
        """Passes on what the program says and writes, to its end."""
        is_open = True
        next_copy = time.monotonic() + COPY_INTERVAL
        while self.process.poll() is None:
            if is_open:
                is_open = self._pass_on_output(TICK)
            else:
                time.sleep(TICK)
            self._pass_on_log()
            if self.mirror.has_new_parts() or time.monotonic() >= next_copy:
                start = time.monotonic()
                self.mirror.bring_up_to_date()
                end = time.monotonic()
                next_copy = end + max(COPY_INTERVAL, (end - start) / COPY_SHARE)
        self.channel.send("over")
        self._pass_on_output(0)
        self._pass_on_log()
        self.mirror.bring_up_to_date()
        self.channel.send("ended", status=self.process.returncode)

    def _pass_on_output(self, limit):
        """What the program says within `limit` [s]; returns whether more may come."""
        while select.select([self.reader], [], [], limit)[0]:
            try:
                piece = os.read(self.reader, PIECE)
            except OSError:  # a terminal whose program has closed it
                piece = b""
            if not piece:
                return False
            self.channel.send("output", piece)
            limit = 0
        return True

    def _pass_on_log(self):
        """The whole lines that came."""
        with contextlib.suppress(FileNotFoundError), open(self.mirror.root / "log.txt", "rb") as log:
            log.seek(self.log_read)
            lines = log.read()
            lines = lines[:lines.rfind(b"\n") + 1]
            if lines:
                self.log_read += len(lines)
                self.channel.send("log", lines)


def end_with_the_parent():
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


def main():
    with contextlib.suppress(OSError):
        os.chdir("/")
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):  # the run says when it is over, or its end is the end here
        signal.signal(number, signal.SIG_IGN)
    os.write(1, MARK)
    agent = Agent(Channel(0, 1))
    try:
        agent.work_through()
    except Fault as fault:
        tell_of(agent, str(fault), fault.is_machine)
    except OSError as error:
        tell_of(agent, ": ".join(str(part) for part in (error.filename, error.strerror) if part), True)
    except (ChannelClosed, Silence):
        pass
    finally:
        agent.clean_up()


def tell_of(agent, text, is_machine):
    with contextlib.suppress(ChannelClosed):
        agent.channel.send("fault", text=text, is_machine=is_machine)
