"""A participant's own code beside this project's: where a mistake lies in it, a sum over its text, threads that it leaves."""

import hashlib
import os
import pathlib
import sys
import threading
import time
import traceback

from toryu import counted
from toryu.processes import PATIENCE, QUIET


def is_own(path):
    """Whether code is not that of a package."""
    return not path.startswith((sys.prefix + "/lib/", sys.base_prefix + "/lib/")) and "-packages/" not in path


def sources():
    """A sum over all own code that is loaded, which tells a program from one whose text was changed."""
    found = hashlib.sha256()
    for name, module in sorted(sys.modules.items()):
        path = getattr(module, "__file__", None)
        if path and is_own(path) and os.path.isfile(path):
            found.update(name.encode() + pathlib.Path(path).read_bytes())
    return found.hexdigest()[:16]


def mistake_of(error, caller):
    """What an exception says, after file, line and function: the last that are neither in `caller` nor in a package."""
    frames = traceback.extract_tb(error.__traceback__)
    own = [frame for frame in frames if frame.line and frame.filename != caller and is_own(frame.filename)]
    place = "".join(f"{frame.filename}:{frame.lineno}: in {frame.name}: " for frame in (own or frames)[-1:])
    return place + traceback.format_exception_only(error)[-1].strip()


def give_up_threads(name, code):
    """Tells for which own threads Python waits at the end of a run, and ends it where they go on: it would wait for ever."""
    def tell(what):
        print(f"{name}: warning: the run is over, and {what}", file=sys.stderr, flush=True)

    time.sleep(QUIET)
    if going_on := [t.name for t in threading.enumerate() if not t.daemon and t is not threading.main_thread()]:
        tell(f"{counted(len(going_on), 'thread')} of this program, {', '.join(map(repr, going_on))}, "
             f"{'is' if len(going_on) == 1 else 'are'} waited for, for {PATIENCE:g} s at most; one with daemon=True ends with "
             "the run")
    time.sleep(max(0, PATIENCE - QUIET))
    tell(f"a thread of this program goes on after {PATIENCE:g} s: it is ended")
    os._exit(code)
