"""Programs that run many times without being started as often: see fork_server.cpp."""

import os
import pathlib
import socket
import struct
import subprocess
import tempfile


class ForkServer:
    """A program that waits ahead of its `main`."""

    def __init__(self, program, library, before=None):
        self.program = program
        folder = tempfile.TemporaryDirectory()
        self.folder = folder  # lives as long as the server
        self.out, self.err = (pathlib.Path(folder.name) / name for name in ("out", "err"))
        self.socket, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        sanitizer = ":".join(filter(None, (os.environ.get("ASAN_OPTIONS"), "verify_asan_link_order=0")))
        surroundings = os.environ | {"LD_PRELOAD": str(library), "FORK_SERVER": str(theirs.fileno()), "ASAN_OPTIONS": sanitizer}
        with theirs:
            self.process = subprocess.Popen([program], env=surroundings, pass_fds=[theirs.fileno()], preexec_fn=before)

    def run(self, *arguments, cwd=".", timeout=None):
        """One run of the program, as subprocess.run tells of it."""
        texts = [os.path.abspath(cwd), self.out, self.err, self.program, *arguments]
        self.socket.send(b"".join(os.fsencode(text) + b"\0" for text in texts))
        process, = struct.unpack("i", self.socket.recv(4))
        self.socket.settimeout(timeout)
        try:
            status, = struct.unpack("i", self.socket.recv(4))
        except TimeoutError:
            os.kill(process, 9)
            self.socket.settimeout(None)
            self.socket.recv(4)
            raise subprocess.TimeoutExpired(texts, timeout) from None
        finally:
            self.socket.settimeout(None)
        return subprocess.CompletedProcess(texts[3:], os.waitstatus_to_exitcode(status), self.out.read_bytes(), self.err.read_bytes())

    def close(self):
        self.socket.close()
        self.process.wait()
        self.folder.cleanup()
