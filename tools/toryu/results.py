"""What a run left, read back: series, summaries, references, and the figures taken from them."""

import bisect
import csv
import functools
import math
import os
import pathlib
import re
import subprocess
import tomllib
from dataclasses import dataclass

from toryu.processes import DONE

PARTICIPANTS = ("fluid", "solid", "coupler")


def case_file(case):
    """The case.toml of CASE, a folder or the file itself."""
    path = pathlib.Path(case)
    return path / "case.toml" if os.path.isdir(path) else path  # of a path that cannot be one, too


class BadCase(Exception):
    """What the program says is wrong with a case, a line each."""


@functools.cache
def case_content(case, program, overrides=()):
    """What the case says, with its base merged and `overrides` ("key=value") applied, as the program prints it."""
    done = subprocess.run([program, case, "--print-case", *(f"--set={pair}" for pair in overrides)],
                          capture_output=True, text=True, stdin=subprocess.DEVNULL)
    if done.returncode != DONE:
        raise BadCase((done.stdout + done.stderr).strip() or f"{program} --print-case ended with {done.returncode}")
    return tomllib.loads(done.stdout)


def case_name(case):
    """cases/gate and cases/gate/case.toml -> gate; cases/gate/fine.toml -> gate_fine"""
    path = case_file(case).resolve()
    return path.parent.name if path.stem == "case" else f"{path.parent.name}_{path.stem}"


def read_columns(path):
    """A CSV file as column name -> list of float; lines that start with # are comments, what is no number is nan."""
    def number(text):
        try:
            return float(text)
        except (TypeError, ValueError):
            return math.nan

    with open(path, newline="", encoding="utf-8") as file:
        rows = [row for row in csv.reader(line for line in file if not line.startswith("#")) if row]
    if not rows:
        return {}
    header, *body = rows
    body = [row for row in body if len(row) == len(header)]  # a run that was killed may leave half a row
    return {name.strip(): [number(row[i]) for row in body] for i, name in enumerate(header)}


def newest(path):
    """`path` or, if that is newer, what a run that was killed has left of it; None if there is neither. A run that went
    on and was killed leaves both."""
    found = [p for p in (path, path.with_name(path.name + ".part")) if p.is_file()]
    return max(found, key=lambda p: p.stat().st_mtime_ns, default=None)


def read_series(out, name):
    """Columns of `NAME.csv`, or of what an ended run left of it; {} if there is none."""
    path = newest(out / f"{name}.csv")
    return read_columns(path) if path else {}


def read_summaries(out):
    """Participant -> its summary, of those that left one."""
    paths = {p: out / f"{p}_summary.toml" for p in PARTICIPANTS}
    return {p: tomllib.loads(path.read_text(encoding="utf-8")) for p, path in paths.items() if path.is_file()}


@dataclass
class Comparison:
    """A reference curve and the series that belongs to it."""

    label: str
    series: str  # "solid"
    column: str  # "tip_displacement_x[m]"
    reference: list[tuple[float, float]]  # time [s], value
    distance: float  # root mean square distance at the reference's times 0 < t <= end of the series, as a share of
    # the largest reference value; nan if there is no such time

    @property
    def unit(self):
        return unit_of(self.column)

    @property
    def quantity(self):
        return readable(self.column)


def readable(column):
    """tip_displacement_x[m] -> tip displacement x"""
    return re.sub(r"\[.*\]$", "", column).replace("_", " ")


def unit_of(column):
    found = re.search(r"\[(.*)\]$", column)
    return found[1] if found else ""


def compare(case, content, out):
    """The [[reference]] curves in the content of the case with the distance of the run to each."""
    folder = case_file(case).parent
    return [_compare(folder, out, reference) for reference in content.get("reference", [])]


def _compare(folder, out, reference):
    file, _, column = reference["series"].partition(":")
    columns = read_columns(folder / reference["file"])
    times = next(iter(columns.values()))
    points = [(t, v) for t, v in zip(times, columns[reference["column"]]) if math.isfinite(t) and math.isfinite(v)]
    name = file.removesuffix(".csv")
    series = read_series(out, name)
    distance = rms_share(points, series.get("time[s]", []), series.get(column, []))
    return Comparison(reference["label"], name, column, points, distance)


def rms_share(reference, times, values):
    if not times or not values:
        return math.nan
    peak = max(abs(v) for _, v in reference)
    squares = [(interpolate(t, times, values) - v) ** 2 for t, v in reference if 0 < t <= times[-1]]
    return math.sqrt(sum(squares) / len(squares)) / peak if squares and peak > 0 else math.nan


def interpolate(time, times, values):
    """Linear between the samples, constant beyond; times ascend."""
    i = bisect.bisect_left(times, time)
    if i == 0:
        return values[0]
    if i == len(times):
        return values[-1]
    share = (time - times[i - 1]) / (times[i] - times[i - 1])
    return values[i - 1] + share * (values[i] - values[i - 1])


def peak(times, values):
    """Time and value of the largest magnitude."""
    return max(((t, v) for t, v in zip(times, values) if math.isfinite(v)), key=lambda point: abs(point[1]))
