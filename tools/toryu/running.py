"""Runs a case for a script, as run.sh does."""

import os
import signal
import subprocess

from toryu import PROGRAMS, program, results
from toryu.case import BadCase, resolve
from toryu.processes import BAD_INPUT, DONE, start
from toryu.study.settings import toml


class RunFailed(Exception):
    """A run ended with an exit code above 0; its words are what was printed."""

    def __init__(self, exit_code, words):
        super().__init__(words.strip() or f"exit code {exit_code}")
        self.exit_code = exit_code


def run(case, set={}, out=None, options=()):
    """Runs a case and returns its results (arrays.Results). `set`: other values for keys of the case; `out`: the folder of
    the results, by default out/<case name>; `options`: more of run.sh's, as ["--end-time=0.1", "--fluid=my_fluid.py"]. Raises
    RunFailed. An interruption is passed on and waited for, so that the programs end in order."""
    case = os.fspath(case)
    options = [options] if isinstance(options, str) else options
    if out is None:
        try:
            out = os.path.join("out", resolve(case, PROGRAMS / "coupler").name)
        except BadCase as fault:
            raise RunFailed(BAD_INPUT, str(fault)) from None
    settings = [f"--set={key}={toml(getattr(value, 'tolist', lambda: value)())}" for key, value in set.items()]
    process = start(program.python("launch", case, *settings, f"--out={os.fspath(out)}", *options), subprocess.PIPE)
    try:
        words = process.communicate()[0]
    except BaseException:
        process.send_signal(signal.SIGINT)
        process.communicate()
        raise
    if process.returncode != DONE:
        raise RunFailed(process.returncode, words.decode(errors="replace"))
    return results.read(out)
