"""What is checked before the first run: the programs are there, and take every value that the study sets."""

import concurrent.futures
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
from dataclasses import replace

from toryu import guests, results
from toryu.case import PROGRAMS_OF, BadCase, resolve
from toryu.processes import DONE
from toryu.study import timing
from toryu.study.document import BadStudy, did_you_mean, is_number


LONGEST_FAULT = 1000  # characters
COLUMN = re.compile(r"\w+\.csv:.+")  # as --columns tells it


def others(options):
    """Side -> program of a user in the place of its solver."""
    return {side: guests.located(path) for side in ("fluid", "solid") if (path := getattr(options, side))}


def programs(study, options):
    """The executables that the case needs."""
    found = {name: options.bin / name for name in PROGRAMS_OF[study.kind]}
    for side, path in others(options).items():
        if f"{side}_solver" not in found:
            raise BadStudy(f"--{side} {path}: error: the case has no {side}")
        found[f"{side}_solver"] = path
    for name, path in found.items():
        is_here = not any(place.startswith(name.partition("_")[0] + "=") for place in options.host)
        if is_here and (fault := guests.fault_of(str(path), name)):
            raise BadStudy(fault)
    if study.timing and not shutil.which(options.bin / timing.PROGRAM):
        raise BadStudy(f"{options.bin / timing.PROGRAM}: error: no such program, needed by [timing]")
    return list(found.values())


def identity(executables):
    """Changes with any change of the programs, committed or not: what an earlier program has done is not taken over. One of
    a user on another host is known by its path alone."""
    found = [shutil.which(path) for path in executables]
    return [hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest() if path else str(named)
            for path, named in zip(found, executables)]


def versions(executables):
    """A program of a user is not asked: one that does not know the question may do anything."""
    return [subprocess.run([path, "--version"], capture_output=True, text=True).stdout.strip()
            if isinstance(path, pathlib.Path) else path for path in executables]


def settings(study, runs, waiting, done, extra):
    """Runs `--check` on settings that hold every value of every axis once; lists all faults. `done`: records of those that
    need none."""
    refuse(study, waiting)
    seen, chosen = set(), []
    for setting in waiting:
        values = set(setting.values.items())
        if not values <= seen:
            chosen.append(setting)
            seen |= values
    told = check(study, runs, chosen, extra)
    if not told or missing_columns(study, told, runs):  # which may come with several values together
        told |= {f"{path.name}:{column}" for record in done for path in record.folder.glob("*.csv")
                 for column in results.columns_of(path)}
        told |= check(study, runs, [setting for setting in of_each_kind(waiting) if setting not in chosen], extra)
    if faults := missing_columns(study, told, runs):
        raise BadStudy("\n".join(faults))


def check(study, runs, chosen, extra):
    """FILE.csv:COLUMN of all series that runs of these settings would write; raises BadStudy with all that is wrong."""
    def ask(setting):
        try:
            done = subprocess.run(runs.command(setting, "--check", "--columns"), capture_output=True, text=True,
                                  stdin=subprocess.DEVNULL)
        except OSError as error:  # more than a command line takes
            return f"{study.path}: error: the run with {setting}: {error.strerror}"[:LONGEST_FAULT], ""
        return ("", done.stdout) if done.returncode == DONE else (done.stdout + done.stderr, "")

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        answers = list(pool.map(ask, chosen))
    faults = dict.fromkeys(line for words, _ in answers for line in words.splitlines()
                           if line.strip() and not COLUMN.fullmatch(line))
    if faults:
        raise BadStudy("\n".join(placed(study, line, extra) for line in faults))
    return {line for _, words in answers for line in words.splitlines() if COLUMN.fullmatch(line)}


def of_each_kind(waiting):
    """One of each combination of values that are no numbers: a term that is there or not, a scheme, a shape."""
    return {tuple(v for v in setting.values.values() if not is_number(v)): setting for setting in waiting}.values()


def missing_columns(study, told, runs):
    """Of the metrics, what of their series no run will write, if anything is known of that. Programs of a user, and those on
    other hosts, are not asked for theirs."""
    faults = []
    for metric in study.metrics if told else ():
        if metric.series in told or not metric.series:
            continue
        file, _, column = metric.series.partition(":")
        files = {series.partition(":")[0] for series in told}
        columns = [series.partition(":")[2] for series in told if series.startswith(f"{file}:")]
        if runs.passed_on and not columns:
            continue
        what = (f"{file} will have no column '{column}'{did_you_mean(column, sorted(columns))}" if columns else
                f"no run writes '{file}'{did_you_mean(file, sorted(files))}")
        faults.append(f"{study.path}{f':{metric.line}' if metric.line else ''}: error: [[metric]] '{metric.name}': {what}")
    return faults


def content(study, setting):
    """The case as a setting runs it; None where the programs' own check tells what is wrong."""
    try:
        return resolve(study.case, study.coupler, tuple(f"{key}={value}" for key, value in setting.overrides.items())).content
    except BadCase:
        return None


def refuse(study, waiting):
    """What the special views cannot do with the case as it will run, and say before it does."""
    views = [view for view in (study.recession, study.calibration) if view]
    told = dict.fromkeys(fault for view in views for setting in waiting if view.is_new(setting)
                         if (case := content(study, setting)) for fault in view.faults(case))
    if told:
        raise BadStudy("\n".join(f"{study.path}{f':{line}' if line else ''}: error: {words}" for line, words in sorted(
            told, key=lambda fault: fault[0] or 0)))


def longest(study, runs, setting, most):
    """How many times as long as its end time the case may run, 1, 2, 4 to `most`, and what is against more."""
    end = ((content(study, setting) or {}).get("case", {})).get("end_time")
    factor = 1
    while isinstance(end, (int, float)) and factor < most:
        longer = replace(setting, overrides=setting.overrides | {"case.end_time": repr(2.0 * factor * end)})
        done = subprocess.run(runs.command(longer, "--check"), capture_output=True, text=True, stdin=subprocess.DEVNULL)
        if done.returncode != DONE:
            return factor, "; ".join((done.stdout + done.stderr).split("\n")).strip("; ")[:LONGEST_FAULT]
        factor *= 2
    return most, ""


def placed(study, line, extra):
    """A fault of `--set KEY=VALUE`, told where the study says so."""
    key = re.match(r"--set ([^=\s]+)=", line)
    if not key or any(pair.startswith(f"{key[1]}=") for pair in extra):
        return line
    for axis in study.axes:
        if any(key[1] in value.overrides for value in axis.values):
            return f"{study.path}{f':{axis.line}' if axis.line else ''}: error: [[axis]] '{axis.name}': {line}"
    return f"{study.path}{f':{study.set_line}' if study.set_line else ''}: error: [study] set: {line}"
