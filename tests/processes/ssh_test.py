"""A run whose solvers are reached by a real ssh, through a server on loopback: the same bits as without, its end by Ctrl-C,
and the end of ssh itself.

    ssh_test.py BIN"""
import os
import pathlib
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from toryu.processes import DONE, INTERRUPTED, PEER_LOST
from toryu_testing.launched_hosts import LAUNCH
from toryu_testing.loopback_ssh import CannotStart, LoopbackSsh
from toryu_testing.trio import CASE, results_of

SKIPPED = 77
HOSTS = ["--host=fluid=127.0.0.1", "--host=solid=127.0.0.1"]


class OverSsh(unittest.TestCase):
    bin, ssh = None, None

    def setUp(self):
        self.base = pathlib.Path(tempfile.mkdtemp(prefix="toryu_over_ssh_"))
        self.addCleanup(shutil.rmtree, self.base, ignore_errors=True)
        self.there = self.base / "there"
        self.there.mkdir()

    def start(self, out, *options):
        command = [*LAUNCH, CASE, f"--bin={self.bin}", f"--out={self.base / out}", "--no-report", *options]
        if options[-2:] == tuple(HOSTS):
            command += [f"--launcher={shlex.join(self.ssh.command())}", f"--remote-folder={self.there}"]
        with open(self.base / "said", "w") as said:
            run = subprocess.Popen([str(word) for word in command], stdout=said, stderr=said, start_new_session=True)
        self.addCleanup(lambda: (run.kill(), run.wait()))
        return run

    def assert_end(self, run, code):
        self.assertEqual(run.wait(60), code, (self.base / "said").read_text())
        end = time.monotonic() + 5
        while (left := list(self.there.iterdir())) or self.programs():
            self.assertLess(time.monotonic(), end, f"{left} {self.programs()}")
            time.sleep(0.05)

    def programs(self):
        """Those that run below the folder of the hosts."""
        found = subprocess.run(["pgrep", "-f", str(self.there)], capture_output=True, text=True).stdout.split()
        return [int(number) for number in found]

    def wait_for(self, path):
        end = time.monotonic() + 30
        while not path.exists():
            self.assertLess(time.monotonic(), end, (self.base / "said").read_text())
            time.sleep(0.02)

    def test_has_the_same_bits(self):
        self.assert_end(self.start("one", "--end-time=0.004"), DONE)
        self.assert_end(self.start("hosts", "--end-time=0.004", *HOSTS), DONE)
        found, wanted = results_of(self.base / "hosts"), results_of(self.base / "one")
        self.assertEqual(found.keys(), wanted.keys())
        for name, content in wanted.items():
            self.assertEqual(found[name], content, name)

    def test_is_interrupted(self):
        run = self.start("hosts", "--end-time=1000", *HOSTS)
        self.wait_for(self.base / "hosts/coupler.csv.part")
        os.killpg(run.pid, signal.SIGINT)
        self.assert_end(run, INTERRUPTED)
        self.assertTrue((self.base / "hosts/checkpoint/000001/manifest.toml").exists())

    def test_ends_with_ssh(self):
        run = self.start("hosts", "--end-time=1000", *HOSTS)
        self.wait_for(self.base / "hosts/coupler.csv.part")
        clients = subprocess.run(["pgrep", "-f", f"^ssh -F {self.ssh.folder}"], capture_output=True, text=True).stdout.split()
        self.assertEqual(len(clients), 2)
        os.kill(int(clients[0]), signal.SIGKILL)
        self.assert_end(run, PEER_LOST)
        self.assertIn("the connection to 127.0.0.1 is gone", (self.base / "said").read_text())


if __name__ == "__main__":
    OverSsh.bin = pathlib.Path(sys.argv.pop(1)).resolve()
    try:
        with LoopbackSsh() as server:
            OverSsh.ssh = server
            unittest.main()
    except CannotStart as reason:
        print(f"skipped: {reason}", file=sys.stderr)
        sys.exit(SKIPPED)
