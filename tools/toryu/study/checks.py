"""What is checked before the first run: the programs are there, and take every value that the study sets."""

import concurrent.futures
import hashlib
import os
import pathlib
import re
import shutil
import subprocess

from toryu.case import PROGRAMS_OF
from toryu.processes import DONE
from toryu.study import timing
from toryu.study.document import BadStudy


LONGEST_FAULT = 1000  # characters


def programs(study, bin_folder):
    """The executables that the case needs."""
    names = PROGRAMS_OF[study.kind]
    for name in names:
        if not shutil.which(bin_folder / name):
            raise BadStudy(f"{bin_folder / name}: error: no such program, needed as {name}")
    if study.timing and not shutil.which(bin_folder / timing.PROGRAM):
        raise BadStudy(f"{bin_folder / timing.PROGRAM}: error: no such program, needed by [timing]")
    return [bin_folder / name for name in names]


def identity(executables):
    """Changes with any change of the programs, committed or not: what an earlier program has done is not taken over."""
    return [hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest() for path in executables]


def versions(executables):
    return [subprocess.run([path, "--version"], capture_output=True, text=True).stdout.strip() for path in executables]


def settings(study, runs, waiting, extra):
    """Runs `--check` on settings that hold every value of every axis once; lists all faults."""
    seen, chosen = set(), []
    for setting in waiting:
        values = set(setting.values.items())
        if not values <= seen:
            chosen.append(setting)
            seen |= values

    def fault(setting):
        try:
            done = subprocess.run(runs.command(setting, "--check"), capture_output=True, text=True, stdin=subprocess.DEVNULL)
        except OSError as error:  # more than a command line takes
            return f"{study.path}: error: the run with {setting}: {error.strerror}"[:LONGEST_FAULT]
        return "" if done.returncode == DONE else done.stdout + done.stderr

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        words = [text for text in pool.map(fault, chosen) if text]
    faults = dict.fromkeys(line for text in words for line in text.splitlines() if line.strip())
    if faults:
        raise BadStudy("\n".join(placed(study, line, extra) for line in faults))


def placed(study, line, extra):
    """A fault of `--set KEY=VALUE`, told where the study says so."""
    key = re.match(r"--set ([^=\s]+)=", line)
    if not key or any(pair.startswith(f"{key[1]}=") for pair in extra):
        return line
    for axis in study.axes:
        if any(key[1] in value.overrides for value in axis.values):
            return f"{study.path}{f':{axis.line}' if axis.line else ''}: error: [[axis]] '{axis.name}': {line}"
    return f"{study.path}{f':{study.set_line}' if study.set_line else ''}: error: [study] set: {line}"
