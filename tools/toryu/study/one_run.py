"""One run of a study, started by a queue on whatever machine: what it prints and how it ended are left in its folder.

    python3 -I -X utf8 tools/toryu study.one_run TABLE INDEX
"""

import contextlib
import json
import os
import pathlib
import signal
import socket
import subprocess
import sys
import time

from toryu import program
from toryu.processes import DONE, INTERRUPTED, PATIENCE, requests_to_end, start
from toryu.study import runner

ENDED = "ended.json"


def write_ended(folder, exit_code, elapsed):
    program.write_whole(folder / ENDED, json.dumps({"exit_code": exit_code, "elapsed": elapsed, "host": socket.gethostname()}))


def read_ended(folder):
    """Exit code and time [s] of a run that a queue started, or None if it has not ended."""
    try:
        content = json.loads((folder / ENDED).read_text(encoding="utf-8"))
        return int(content["exit_code"]), float(content["elapsed"])
    except (OSError, ValueError, KeyError, TypeError):
        return None


def ask_to_end(process):
    with contextlib.suppress(ProcessLookupError):
        os.kill(process.pid, signal.SIGINT)


def main(arguments):
    table, index = arguments
    run = json.loads(pathlib.Path(table).read_text(encoding="utf-8"))["runs"][int(index)]
    folder, limit = pathlib.Path(run["folder"]), run["time_limit"]
    began = time.monotonic()
    with open(folder / runner.OUTPUT, "wb") as output:
        process = start(run["command"], output)
    for number in requests_to_end():
        signal.signal(number, lambda *_: ask_to_end(process))
    code = None
    try:
        process.wait(limit)
    except subprocess.TimeoutExpired:
        code = runner.HUNG
        ask_to_end(process)
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(PATIENCE)
        with contextlib.suppress(ProcessLookupError):
            os.kill(process.pid, signal.SIGKILL)
        process.wait()
    write_ended(folder, process.returncode if code is None else code, time.monotonic() - began)
    return INTERRUPTED if process.returncode == INTERRUPTED else DONE


if __name__ == "__main__":
    program.run(main)
