"""The launcher's side of a watched run: a server that is started before the programs and ends with the run."""

import contextlib
import json
import os
import subprocess
import sys

from toryu import program
from toryu.processes import BAD_INPUT, start

LAST_PATIENCE = 15.0  # [s] for the server to hand out the last page


def port_of(options):
    """The port asked for, 0 for any."""
    if options.watch and not (options.watch.isascii() and options.watch.isdigit() and 0 < int(options.watch) < 65536):
        print(f"--watch {options.watch}: error: is no port: from 1 to 65535", file=sys.stderr)
        raise SystemExit(BAD_INPUT)
    return int(options.watch or 0)


@contextlib.contextmanager
def watched(options):
    """Serves the run's page if that is asked for. Yields what is told the end of the run: its code, why it ended, and
    whether its report is there."""
    if options.watch is None:
        yield lambda *_: None
        return
    reader, writer = os.pipe()
    command = program.python("watch", options.out, f"--case={options.case}", f"--bin={options.bin}",
                             f"--port={port_of(options)}", f"--told-by={reader}")
    server = start(command, subprocess.PIPE, descriptors=[reader])
    os.close(reader)

    def tell(code, words, reported):
        with contextlib.suppress(OSError):
            os.write(writer, json.dumps({"code": code, "words": words, "report": reported}).encode())

    try:
        address = server.stdout.readline().decode(errors="replace")
        if not address.startswith("watch "):
            print((address + server.stdout.read().decode(errors="replace")).strip(), file=sys.stderr)
            raise SystemExit(server.wait())
        print(address.strip(), flush=True)
        yield tell
    finally:
        os.close(writer)
        try:
            server.wait(LAST_PATIENCE)
        except subprocess.TimeoutExpired:
            server.kill()
            server.wait()
        server.stdout.close()
