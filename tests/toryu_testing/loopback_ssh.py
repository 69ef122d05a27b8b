"""An ssh server of this machine alone, with a port and keys of its own, for as long as a test wants it."""

import getpass
import os
import pathlib
import shutil
import socket
import subprocess
import tempfile
import time

SERVER = "/usr/sbin/sshd"
START = 10  # [s] within which it listens
CONFIGURATION = """Port {port}
ListenAddress 127.0.0.1
HostKey {folder}/host_key
AuthorizedKeysFile {folder}/user_key.pub
PidFile none
StrictModes no
UsePAM no
PermitRootLogin yes
"""
CLIENT = """IdentityFile {folder}/user_key
IdentitiesOnly yes
Port {port}
UserKnownHostsFile {folder}/known_hosts
StrictHostKeyChecking accept-new
BatchMode yes
"""


class CannotStart(Exception):
    """Why there is no server here."""


class LoopbackSsh:
    def __enter__(self):
        if not os.path.exists(SERVER) or not shutil.which("ssh"):
            raise CannotStart("openssh-server or openssh-client is missing ('tools/install.sh cluster')")
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="toryu_ssh_"))
        for key in ("host_key", "user_key"):
            subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", self.folder / key], check=True)
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        for name, text in (("server", CONFIGURATION), ("client", CLIENT)):
            (self.folder / name).write_text(text.format(folder=self.folder, port=self.port))
        if os.geteuid() == 0:
            pathlib.Path("/run/sshd").mkdir(exist_ok=True)  # which the package's service would make
        with open(self.folder / "log", "w") as log:
            self.server = subprocess.Popen([SERVER, "-D", "-e", "-f", self.folder / "server"], stdout=log, stderr=log)
        try:
            self._wait()
        except CannotStart:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def command(self):
        """What reaches the host."""
        return ["ssh", "-F", str(self.folder / "client")]

    def _wait(self):
        end = time.monotonic() + START
        while True:
            done = subprocess.run([*self.command(), "127.0.0.1", "true"], stdin=subprocess.DEVNULL, capture_output=True,
                                  text=True)
            if done.returncode == 0:
                return
            if time.monotonic() > end or self.server.poll() is not None:
                raise CannotStart(f"{getpass.getuser()} cannot log in: {done.stderr}{(self.folder / 'log').read_text()}")
            time.sleep(0.1)
