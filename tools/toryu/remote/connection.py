"""Reaches a host: by a launcher, which is called as LAUNCHER ADDRESS bash and joins the streams of that bash to its own."""

import contextlib
import json
import os
import pathlib
import shlex
import signal
import subprocess
import threading
import time

from toryu.processes import BAD_INPUT, MACHINE, PEER_LOST, ends_with_this_process
from toryu.remote import agent
from toryu.remote.channel import PULSE, Channel, ChannelClosed, Silence

HERE = pathlib.Path(__file__).resolve().parent
REACH_LIMIT = 30.0  # [s] in which a host answers
SILENCE = 10.0  # [s] beyond that which the programs bear, after which the connection counts as lost
CLOSING = 5.0  # [s] in which what leads to the host ends by itself

# One line for bash, which reads no further than its end. What follows on the same stream are the agent's modules.
LOADER = """import sys, json, types
for name, text in json.loads(sys.stdin.buffer.raw.readline()):
    module = types.ModuleType(name)
    sys.modules[name] = module
    exec(compile(text, name, "exec"), module.__dict__)
module.main()"""
TEST = ("/usr/bin/python3", "--version")  # what shows whether the agent could be started
MODULES = ("channel", "mirror", "agent")


class HostFailed(Exception):
    """What is wrong with a host, and the exit code that it takes."""

    def __init__(self, text, code):
        super().__init__(text)
        self.code = code


def agent_line():
    """What bash and the loader read."""
    modules = [("toryu", ""), ("toryu.remote", "")]
    modules += [(f"toryu.remote.{name}", (HERE / f"{name}.py").read_text(encoding="utf-8")) for name in MODULES]
    command = ["/usr/bin/python3", "-I", "-X", "utf8", "-c", LOADER]
    return f"exec {shlex.join(command)}\n".encode() + json.dumps(modules).encode() + b"\n"


class Connection:
    """The agent on a host. Raises HostFailed, on use too, if there is none."""

    def __init__(self, job):
        self.job = job
        self.limit = job.lost_after + SILENCE
        self.said = []  # on standard error, by the launcher and by what it started
        command = [*job.launcher, job.address, "bash"]
        try:
            self.leader = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                           bufsize=0, start_new_session=True, preexec_fn=ends_with_this_process())
        except OSError as error:
            raise HostFailed(f"error: --launcher {job.launcher[0]}: {error.strerror}", BAD_INPUT) from error
        self.listening = threading.Thread(target=self._listen, daemon=True)
        self.listening.start()
        self.channel = Channel(self.leader.stdout.fileno(), self.leader.stdin.fileno())
        with contextlib.suppress(BrokenPipeError):
            self.leader.stdin.write(agent_line())
        try:
            self.channel.skip_to(agent.MARK, REACH_LIMIT)
        except (ChannelClosed, Silence) as failure:
            raise self._unreached(isinstance(failure, Silence)) from failure

    def receive(self, limit):
        """The next message and its bytes; ({"kind": "nothing"}, b"") if none comes within `limit` [s]."""
        try:
            message, data = self.channel.receive(limit)
        except Silence:
            if time.monotonic() - self.channel.heard > self.limit:
                raise self.lost(f"no sign of life for {self.limit:g} s") from None
            return {"kind": "nothing"}, b""
        except ChannelClosed as closed:
            raise self.lost(str(closed) or "it was closed" + self._words()) from None
        if message["kind"] == "fault":
            kind, code = ("the machine: ", MACHINE) if message["is_machine"] else ("", BAD_INPUT)
            raise HostFailed(f"error: {kind}{self.job.address}: {message['text']}", code)
        return message, data

    def lost(self, why):
        return HostFailed(f"error: peer lost: the connection to {self.job.address} is gone: {why}", PEER_LOST)

    def close(self):
        """Ends the agent, and with it what it started there; it may take its time to remove what was written."""
        with contextlib.suppress(OSError):
            self.leader.stdin.close()
        with contextlib.suppress(HostFailed):
            while True:
                self.receive(PULSE)
        with contextlib.suppress(subprocess.TimeoutExpired):
            self.leader.wait(CLOSING)
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.leader.pid, signal.SIGKILL)
        self.leader.wait()
        self.leader.stdout.close()

    def _unreached(self, is_silent):
        """Why there is no agent, and what must work."""
        why = f"no answer within {REACH_LIMIT:g} s" if is_silent else "it ended" + self._words(self.channel.unread)
        self.close()
        test = shlex.join([*self.job.launcher, self.job.address, *TEST])
        return HostFailed(f"error: the machine: {self.job.address} cannot be reached: {why}; '{test}' must work, and ask "
                          "nothing", MACHINE)

    def _listen(self):
        with self.leader.stderr:
            for line in self.leader.stderr:
                self.said = [*self.said[-20:], line.decode(errors="replace").rstrip()]

    def _words(self, output=b""):
        """The last ones on standard error, or else of its `output`: a login that is not allowed says so there."""
        self.listening.join(1.0)
        said = self.said or [line for line in output.decode(errors="replace").splitlines() if line.strip()]
        return f": {said[-1]}" if said else ""
