"""What a run left, read back: series, summaries, frames, and the figures taken from them. A file that is damaged is left
out, and said so where that is wanted. For scripts, `read` gives all of it as numpy arrays with units."""

import bisect
import csv
import difflib
import json
import math
import re
import tomllib
from dataclasses import dataclass

PARTICIPANTS = ("fluid", "solid", "coupler")
# Of h5py and json. A damaged size asks for any amount of memory.
DAMAGED = (OSError, KeyError, ValueError, TypeError, AttributeError, RuntimeError, IndexError, MemoryError)


def read(out):
    """What the run left in the folder `out`, as arrays.Results."""
    from toryu.arrays import Results  # needs numpy and h5py, which the launcher does without

    return Results(out)


def read_columns(path):
    """A CSV file as column name -> list of float; lines that start with # are comments, what is no number is nan."""
    def number(text):
        try:
            return float(text)
        except (TypeError, ValueError):
            return math.nan

    with open(path, newline="", encoding="utf-8", errors="replace") as file:
        rows = [row for row in csv.reader(line for line in file if not line.startswith("#")) if row]
    if not rows:
        return {}
    header, *body = rows
    body = [row for row in body if len(row) == len(header)]  # a run that was killed may leave half a row
    return {name.strip(): [number(row[i]) for row in body] for i, name in enumerate(header)}


def columns_of(path):
    """The names of the columns of a CSV file, of which no more is read."""
    with open(path, newline="", encoding="utf-8", errors="replace") as file:
        rows = csv.reader(line for line in file if not line.startswith("#"))
        return [name.strip() for name in next(filter(None, rows), [])]


def newest(path):
    """`path` or, if that is newer, what a run that was killed has left of it; None if there is neither. A run that went
    on and was killed leaves both."""
    found = [p for p in (path, path.with_name(path.name + ".part")) if p.is_file()]
    return max(found, key=lambda p: p.stat().st_mtime_ns, default=None)


def note(faults, path, why):
    """Adds that a file of the results is of no use, where that is wanted."""
    if faults is not None:
        faults.append(f"{path.name} {why}")


def read_series(out, name, faults=None):
    """Columns of `NAME.csv`, or of what an ended run left of it; {} if there is none. Only rows whose time goes on."""
    path = newest(out / f"{name}.csv")
    if path is None:
        return {}
    try:
        columns = read_columns(path)
    except (OSError, csv.Error) as error:
        note(faults, path, f"cannot be read: {error}")
        return {}
    if not columns.get("time[s]"):
        note(faults, path, "is empty" if not columns else "holds no row" if "time[s]" in columns else "has no column time[s]")
        return {}
    kept, last = [], -math.inf
    for i, time in enumerate(columns["time[s]"]):
        if last <= time < math.inf:
            kept.append(i)
            last = time
    if not kept:
        note(faults, path, "holds no time")
        return {}
    return {column: [values[i] for i in kept] for column, values in columns.items()}


def list_frames(out, name, faults=None):
    """(time, path) of the frames that NAME.hdf.series lists and that are there, in the order of time."""
    path = out / f"{name}.hdf.series"
    try:
        entries = json.loads(path.read_text(encoding="utf-8"))["files"]
        found = [(float(entry["time"]), out / entry["name"]) for entry in entries]
    except (*DAMAGED, RecursionError) as error:
        note(faults, path, f"cannot be read: {error}")
        return []
    missing = sum(not path.is_file() for _, path in found)
    if missing:
        note(faults, path, f"lists {missing} frames that are not there")
    return sorted((time, path) for time, path in found if path.is_file() and math.isfinite(time))


def read_summaries(out, faults=None):
    """Participant -> its summary, of those that left a sound one."""
    found = {}
    for participant in PARTICIPANTS:
        path = out / f"{participant}_summary.toml"
        if not path.is_file():
            continue
        try:
            summary = tomllib.loads(path.read_text(encoding="utf-8"))
        except (OSError, ValueError, RecursionError) as error:
            note(faults, path, f"cannot be read: {error}")
            continue
        if wrong := fault_of(summary, SUMMARY):
            note(faults, path, f"is damaged: {wrong}")
        else:
            found[participant] = OPTIONAL | summary
    return found


NUMBER = (int, float)
SUMMARY = {"exit_code": int, "wall_time": NUMBER, "waiting_time": NUMBER, "processor_time": NUMBER,
           "simulated_time": NUMBER, "steps": int, "smallest_time_step": NUMBER, "largest_time_step": NUMBER}
OPTIONAL = {"end_reason": "", "time_step_rule": "", "particles": {}, "figures": {}, "provenance": {}, "term": [], "part": []}
# of the values in a table, and of the tables in a list
VALUES = {"particles": int, "figures": NUMBER}
ITEMS = {"term": {"name": str, "formula": str, "parameters": str, "source": str},
         "part": {"name": str, "seconds": NUMBER, "calls": int}}


def fault_of(summary, kinds):
    """What a summary lacks, "" if it is whole."""
    def right(value, kind):
        return isinstance(value, kind) and not isinstance(value, bool)

    for key, kind in kinds.items():
        if not right(summary.get(key), kind):
            return f"'{key}' is missing or of another kind"
    for key, empty in OPTIONAL.items() if kinds is SUMMARY else ():
        if not isinstance(summary.get(key, empty), type(empty)):
            return f"'{key}' is of another kind"
    for key, kind in VALUES.items() if kinds is SUMMARY else ():
        if not all(right(value, kind) for value in summary.get(key, {}).values()):
            return f"'{key}' holds something of another kind"
    for key, inner in ITEMS.items() if kinds is SUMMARY else ():
        for item in summary.get(key, []):
            if wrong := fault_of(item, inner) if isinstance(item, dict) else "no table":
                return f"[[{key}]]: {wrong}"
    return ""


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


def compare(references, out):
    """The references of a case with the distance of the run to each; those with a fault are left out."""
    return [_compare(out, reference) for reference in references if "points" in reference]


def faults_of(references, out):
    """What is wrong with the references of a case, or with what they are drawn over, a sentence each."""
    found = [f"reference '{r['label']}': {r['fault']}" for r in references if "fault" in r]
    for comparison in compare(references, out):
        if fault := without_column(out, f"{comparison.series}.csv:{comparison.column}"):
            found.append(f"reference '{comparison.label}': {fault}")
    return found


def without_column(out, series):
    """That FILE.csv of FILE.csv:COLUMN lacks the column, and which is near to it; "" if it does not, or is not there."""
    file, _, column = series.partition(":")
    columns = read_series(out, file.removesuffix(".csv"))
    if not columns or column in columns:
        return ""
    near = difflib.get_close_matches(column, columns, n=1)
    return f"{file} has no column '{column}'" + (f"; did you mean '{near[0]}'?" if near else "")


def _compare(out, reference):
    file, _, column = reference["series"].partition(":")
    name = file.removesuffix(".csv")
    series = read_series(out, name)
    points = [tuple(point) for point in reference["points"]]
    distance = rms_share(points, series.get("time[s]", []), series.get(column, []))
    return Comparison(reference["label"], name, column, points, distance)


def rms_share(reference, times, values):
    if not times or not values:
        return math.nan
    peak = max(abs(v) for _, v in reference)
    differences = [interpolate(t, times, values) - v for t, v in reference if 0 < t <= times[-1]]
    return math.hypot(*differences) / math.sqrt(len(differences)) / peak if differences and peak > 0 else math.nan


def interpolate(time, times, values):
    """Linear between the samples, constant beyond; times ascend."""
    i = bisect.bisect_left(times, time)
    if i == 0:
        return values[0]
    if i == len(times):
        return values[-1]
    passed = times[i] - times[i - 1]
    share = (time - times[i - 1]) / passed if passed > 0 else 1.0
    return values[i - 1] + share * (values[i] - values[i - 1])


def peak(times, values):
    """Time and value of the largest magnitude."""
    return max(((t, v) for t, v in zip(times, values) if math.isfinite(v)), key=lambda point: abs(point[1]))
