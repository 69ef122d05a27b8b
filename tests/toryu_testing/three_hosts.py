"""Three hosts on one machine: network namespaces, each with one end of a cable into a bridge, and each process in a space
of process numbers of its own, so that none can be looked up from another host. All of it is in namespaces of the test's own,
needs no root, touches nothing outside, and is gone with the test."""
import pathlib
import shutil
import subprocess
import sys
import time

from toryu_testing.trio import ROLES, Trio

INSIDE = "--inside"
SKIPPED = 77  # exit code by which CTest knows that a test cannot run here
CONTAINED = ["unshare", "--map-root-user", "--net", "--mount", "--pid", "--fork", "--kill-child", "--mount-proc"]
# Network and mount namespaces within, too: some containers allow the first and forbid these.
PROBE = "mount -t tmpfs none /run && ip netns add probe && ip link add bridge type bridge"
ADDRESSES = {role: f"10.77.0.{number}" for number, role in enumerate(ROLES, 1)}
SECRET_SIZE = 33  # [bytes] of run.secret; before, its maker still writes it


def why_not():
    """Why there can be no such hosts here, "" if there can."""
    try:
        done = subprocess.run([*CONTAINED, "sh", "-c", PROBE], capture_output=True, text=True)
    except OSError as error:
        return str(error)
    return "" if done.returncode == 0 else done.stderr.strip() or f"exit code {done.returncode}"


def enter():
    """Returns in namespaces of its own, as this program started again; the one outside ends as that does."""
    if INSIDE in sys.argv:
        sys.argv.remove(INSIDE)
        return
    if reason := why_not():
        print(f"skipped: no hosts can be made of namespaces here: {reason}", file=sys.stderr)
        sys.exit(SKIPPED)
    sys.exit(subprocess.run([*CONTAINED, sys.executable, *sys.argv, INSIDE]).returncode)


def shell(*command):
    subprocess.run(command, check=True)


def lay_cables():
    shell("mount", "-t", "tmpfs", "none", "/run")
    shell("ip", "link", "set", "lo", "up")  # for runs on one host
    shell("ip", "link", "add", "bridge", "type", "bridge")
    shell("ip", "link", "set", "bridge", "up")
    for role, address in ADDRESSES.items():
        shell("ip", "netns", "add", role)
        shell("ip", "link", "add", f"to_{role}", "type", "veth", "peer", "name", "eth0", "netns", role)
        shell("ip", "link", "set", f"to_{role}", "master", "bridge", "up")
        shell("ip", "-n", role, "address", "add", f"{address}/24", "dev", "eth0")
        shell("ip", "-n", role, "link", "set", "eth0", "up")
        shell("ip", "-n", role, "link", "set", "lo", "up")


def set_cable(role, state):
    """Cuts ("down") or mends ("up") the cable of the host that has this role."""
    shell("ip", "link", "set", f"to_{role}", state)


class RunOverHosts(Trio):
    """A coupled run each of whose programs is on a host of its own, with a results folder of its own."""

    peers = ",".join(ADDRESSES.values())

    def __enter__(self):
        self.base = self.out
        self.out = self.folder("coupler")
        for role in ROLES:
            self.folder(role).mkdir()
        return self

    def __exit__(self, *unused):
        super().__exit__(*unused)
        shutil.rmtree(self.base, ignore_errors=True)

    def folder(self, role):
        return self.base / role

    def command(self, role):
        return ["nsenter", f"--net=/run/netns/{role}", "unshare", "--pid", "--fork", "--kill-child", "--mount-proc",
                self.programs[role], self.case, "--out", self.folder(role), "--end-time", self.end_time,
                "--peers", self.peers]

    def start_all(self, extra=()):
        """The coupler first, whose secret is brought to the others."""
        self.start("coupler", extra=extra)
        secret = self.folder("coupler") / "run.secret"
        end = time.monotonic() + 30
        while not secret.exists() or secret.stat().st_size < SECRET_SIZE:
            if time.monotonic() > end:
                raise AssertionError("the coupler makes no secret")
            time.sleep(0.01)
        for role in ("fluid", "solid"):
            shutil.copy2(secret, self.folder(role))
            self.start(role, extra=extra)
        return self

    def kill(self, role):
        """The program itself, not what leads into its namespaces."""
        leader = self.processes[role].pid
        program = pathlib.Path(f"/proc/{leader}/task/{leader}/children").read_text().split()[0]
        shell("kill", "-9", program)
        self.processes[role].wait()
