"""Programs of a user in the place of a solver: found, and asked before a run begins, so that a mistake in one costs no
results."""

import contextlib
import os
import re
import shutil
import signal
import subprocess
import sys

from toryu.processes import BAD_INPUT, DONE, start
from toryu.program import SHORTAGES

ANSWER_LIMIT = 5.0  # [s] in which a program says whether it can write checkpoints
FRAME = re.compile(r'^ +File "(.+)", line (\d+)', re.MULTILINE)  # of a traceback of Python
# Without a frame: by toryu.participant, and of a file that is no text in UTF-8 or may not be read.
OF_PYTHON = re.compile(r"^(?:error: |SyntaxError: |\S+: can't open file ).*$", re.MULTILINE)
NOT_THE_USERS = ("<frozen ", os.path.dirname(os.path.abspath(__file__)), f"{sys.base_prefix}/lib/")


class BadGuest(Exception):
    """What is wrong with a program, in a line."""


def located(program):
    """A file in the current folder needs no ./ before it, as a case needs none."""
    return os.path.join(os.curdir, program) if os.sep not in program and os.path.isfile(program) else program


def fault_of(program, name):
    """Why `program`, needed as `name`, cannot be started; "" if nothing is known against it."""
    if shutil.which(program):
        return ""
    if os.path.isfile(program):
        return f"{program}: error: may not be executed, needed as {name}; 'chmod +x' allows it"
    return f"{program}: error: no such program, needed as {name}"


def can_checkpoint(program):
    """Whether a program says so; None if it does not answer in time. One that does not know the question may do anything
    but end in a traceback. Raises BadGuest if it cannot be started, or is one in Python that has a mistake."""
    try:
        asked = start([program, "--can-checkpoint"], subprocess.PIPE)
    except OSError as error:
        if error.errno in SHORTAGES:
            raise
        raise BadGuest(f"{program}: error: cannot be started: {error.strerror}{first_line(program)}") from None
    try:
        answer = asked.communicate(timeout=ANSWER_LIMIT)[0]
    except subprocess.TimeoutExpired:
        return None
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(asked.pid, signal.SIGKILL)  # whatever it started, too
        asked.wait()
    if asked.returncode != DONE and (mistake := mistake_in(answer.decode(errors="replace"))):
        raise BadGuest(mistake)
    return asked.returncode == DONE and b"yes" in answer.split(b"\n")


def first_line(program):
    """What is wrong with how a script begins, where that may be why it cannot be started."""
    with open(program, "rb") as file:
        line = file.readline(200)
    if not line.startswith(b"#!"):
        return "; a script begins with a line as #!/usr/bin/python3"
    return f"; its first line is {line.decode(errors='replace')!r}"


def mistake_in(text):
    """FILE:LINE: error: WHAT of the last traceback in `text`, or what is said in the place of one; "" if there is none. The
    place is the last one that is neither in toryu nor in a package."""
    *_, told = re.split(r"^Traceback .*$", text, flags=re.MULTILINE)
    frames = list(FRAME.finditer(told))
    if not frames:
        found = OF_PYTHON.search(text)
        return found[0] if found else ""
    own = [frame for frame in frames if not frame[1].startswith(NOT_THE_USERS)]
    place = (own or frames)[-1]
    what = re.search(r"^\w.*$", told[frames[-1].end():], re.MULTILINE)
    return f"{place[1]}:{place[2]}: error: {what[0] if what else 'Python ended with a traceback'}"


def warn_without_checkpoints(guests, is_restart):
    """A run has no checkpoints if one of its programs cannot write them. Returns an exit code."""
    for program in guests:
        try:
            can = can_checkpoint(program)
        except BadGuest as fault:
            print(fault, file=sys.stderr)
            return BAD_INPUT
        if can is None:
            print(f"warning: {program} has not said within {ANSWER_LIMIT:g} s whether it can write checkpoints",
                  file=sys.stderr)
        elif not can and is_restart:
            print(f"--restart: error: {program} cannot write checkpoints, so it cannot go on from one", file=sys.stderr)
            return BAD_INPUT
        elif not can:
            print(f"warning: {program} cannot write checkpoints: this run goes on without them", file=sys.stderr)
    return DONE
