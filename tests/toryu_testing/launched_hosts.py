"""Runs that the launcher spreads over the hosts of three_hosts. What stands for ssh enters a host: its network, a folder of
its own in the place of /tmp, and an environment as bare as that of a login. Case and results lie in /tmp, so no host sees
those of another."""
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from toryu_testing.three_hosts import ADDRESSES
from toryu_testing.trio import CASE, ROLES

LAUNCH = [sys.executable, "-I", "-X", "utf8", str(pathlib.Path(__file__).resolve().parents[2] / "tools/toryu"), "launch"]
STAND_IN = """#!/bin/sh
case $1 in
{roles}
*) echo "connect to host $1 port 22: No route to host" >&2; exit 255 ;;
esac
shift
echo "Welcome to $role"
exec nsenter --net=/run/netns/$role unshare --mount sh -c \\
  'mount --bind "$0" /tmp && exec env -i PATH=/usr/bin:/bin HOME=/tmp "$@"' {base}/disk/$role "$@"
"""


def processes():
    return {int(entry.name) for entry in pathlib.Path("/proc").iterdir() if entry.name.isdigit()}


class Launched:
    """A folder with a case, the disks of the hosts, and runs of that case."""

    def __init__(self, programs):
        self.programs = programs  # folder
        self.base = pathlib.Path(tempfile.mkdtemp(prefix="toryu_hosts_"))
        self.case = shutil.copytree(CASE, self.base / "strip")
        self.out = self.base / "out"
        self.launcher = self.base / "stand_in"
        self.launcher.write_text(STAND_IN.format(base=self.base, roles="\n".join(
            f"{address}) role={role} ;;" for role, address in ADDRESSES.items())))
        self.launcher.chmod(0o755)
        for role in ROLES:
            self.disk(role).mkdir(parents=True)
        self.before = processes()
        self.run = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.run and self.run.poll() is None:
            self.run.kill()
            self.run.wait()
        shutil.rmtree(self.base, ignore_errors=True)

    def disk(self, role):
        return self.base / "disk" / role

    def start(self, roles, *options, out=None):
        """Runs the case with the programs of `roles` on their hosts, the others on the coupler's."""
        hosts = [f"--host={role}={ADDRESSES[role]}" for role in roles]
        where = ["nsenter", "--net=/run/netns/coupler"] if hosts else []
        command = [*where, *LAUNCH, self.case, f"--bin={self.programs}", f"--out={out or self.out}", "--no-report", *hosts,
                   *([f"--launcher={self.launcher}"] if hosts else []), *options]
        with open(self.base / "said", "w") as said:
            self.run = subprocess.Popen([str(word) for word in command], cwd=self.base, stdout=said, stderr=said,
                                        start_new_session=True)
        return self

    def end(self, limit=60):
        """The exit code and what the run said."""
        return self.run.wait(limit), (self.base / "said").read_text()

    def interrupt(self):
        """As Ctrl-C would."""
        os.killpg(self.run.pid, signal.SIGINT)

    def wait_for(self, what, limit=30):
        """Returns the first path in the results that fits the pattern `what`."""
        end = time.monotonic() + limit
        while not (found := sorted(self.out.glob(what))):
            if self.run.poll() is not None or time.monotonic() > end:
                raise AssertionError(f"no {what}: {(self.base / 'said').read_text()}")
            time.sleep(0.02)
        return found[0]

    def wait_for_word(self, pattern, limit=30):
        """What the run said that fits the group of the pattern."""
        end = time.monotonic() + limit
        while not (found := re.search(pattern, (self.base / "said").read_text())):
            if self.run.poll() is not None or time.monotonic() > end:
                raise AssertionError(f"no {pattern}: {(self.base / 'said').read_text()}")
            time.sleep(0.02)
        return found[1]

    def left_behind(self, limit=5):
        """Processes that are there still after `limit` [s], and files on the hosts."""
        end = time.monotonic() + limit
        while (left := self._left()) and time.monotonic() < end:
            time.sleep(0.05)
        return left

    def _left(self):
        running = []
        for pid in processes() - self.before:
            try:
                words = pathlib.Path(f"/proc/{pid}/cmdline").read_bytes().replace(b"\0", b" ")[:200]
            except OSError:
                continue
            if words:  # else it has ended, and nobody has looked at it yet
                running.append(words.decode(errors="replace"))
        # os.walk bears folders that go away meanwhile
        return running + [os.path.join(folder, name) for role in ROLES for folder, folders, files in os.walk(self.disk(role))
                          for name in folders + files]

    def processes_on(self, role):
        """Of the host of `role`: program -> process, "agent" too."""
        network = os.stat(f"/run/netns/{role}").st_ino
        found = {}
        for pid in processes() - self.before:
            try:
                if os.stat(f"/proc/{pid}/ns/net").st_ino == network:
                    words = pathlib.Path(f"/proc/{pid}/cmdline").read_bytes().split(b"\0")
                    found["agent" if b"-c" in words else pathlib.Path(os.fsdecode(words[0])).name] = pid
            except OSError:
                pass
        return found
