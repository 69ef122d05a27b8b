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
        self.signal(signal.SIGKILL)
        if self.work is not None:
            shutil.rmtree(self.work, ignore_errors=True)

    def signal(self, number):
        """To the program and what it started, unless it has ended: its number may be another's then."""
        if self.process is not None and self.process.returncode is None:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self.process.pid, number)

    def _check(self, wanted):
        """Tells the version of the program, and makes the folder of the run."""
        program = wanted["program"]
        if not shutil.which(program):
            hint = ("build toryu there, or give the folder of its programs by --remote-bin" if wanted["asks_version"] else
                    "copy it there: --fluid and --solid are paths of their hosts")
            raise Fault(f"has no program {program}: {hint}")
        version = ""
        if wanted["asks_version"]:
            version = version_of(program)
        folder = wanted["folder"] or tempfile.gettempdir()
        try:
            self.work = pathlib.Path(tempfile.mkdtemp(prefix="toryu_", dir=folder))
            self.receiver = Receiver(self.work)
        except OSError as error:
            raise Fault(f"{folder}: {error.strerror}", is_machine=True) from error
        self.mirror = Mirror(self.work / wanted["out"], self.channel, wanted["is_lead"])
        self.channel.send("checked", version=version, work=str(self.work))

    def _take(self, message, data):
        path = self.receiver.take(message, data)
        if path and message["known"]:
            self.mirror.note(path)

    def _take_in_run(self, message, data):
        """A part of a checkpoint: the run goes on without."""
        try:
            self._take(message, data)
        except OSError as error:
            self.channel.send("output", f"warning: {words_of(error)}\n".encode())

    def _obey(self):
        """What the run asks for while the program runs."""
        try:
            while True:
                message, data = self.channel.receive(None if self.is_paused else self.limit)
                if message["kind"] == "signal":
                    self.is_paused = message["number"] == signal.SIGSTOP
                    self.signal(message["number"])
                elif message["kind"] == "file":
                    self._take_in_run(message, data)
        except (ChannelClosed, Silence):
            pass
        finally:
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
            if self.mirror.has_news() or time.monotonic() >= next_copy:
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


def words_of(error):
    return ": ".join(str(part) for part in (error.filename, error.strerror) if part)


def version_of(program):
    """What it tells. Raises Fault that says why it tells nothing: one of another processor is killed, for one."""
    try:
        done = subprocess.run([program, "--version"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              stdin=subprocess.DEVNULL, timeout=VERSION_LIMIT)
    except subprocess.TimeoutExpired:
        how = f"'--version' takes more than {VERSION_LIMIT:g} s"
    except OSError as error:
        how = error.strerror
    else:
        said = done.stdout.decode(errors="replace").strip()
        if done.returncode == 0:
            return said
        how = said or (f"signal {-done.returncode} ({signal.strsignal(-done.returncode)})" if done.returncode < 0 else
                       f"'--version' ends with {done.returncode}")
    raise Fault(f"{program} does not run there: {how}; build it there, or on a machine of that kind")


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
        tell_of(agent, words_of(error), True)
    except (ChannelClosed, Silence):
        pass
    finally:
        agent.clean_up()


def tell_of(agent, text, is_machine):
    with contextlib.suppress(ChannelClosed):
        agent.channel.send("fault", text=text, is_machine=is_machine)
