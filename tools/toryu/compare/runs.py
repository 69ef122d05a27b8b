"""Two runs, as far as both tell: settings of which they differ, and the distance of each column of their series."""

import csv
import math
import tomllib
from dataclasses import dataclass

from toryu import results
from toryu.program import whole_file
from toryu.report import data

SERIES = ("fluid", "solid")  # the coupler's tells of the machine, and of them again
NOT_PHYSICS = ("case.title", "reference.")  # how the keys of such settings begin


@dataclass
class Column:
    """A column that both runs have, over the times that both reached."""

    series: str  # "solid"
    name: str  # "tip_displacement_x[m]"
    times: list[list[float]]  # [s], of each run
    values: list[list[float]]
    peaks: list[float]  # of the largest magnitude
    distance: float  # root mean square of the difference at the times of the first, over its peak; nan without a peak
    apart_at: float  # the time of the largest difference [s]

    @property
    def place(self):
        return f"{self.series}.csv:{self.name}"

    @property
    def change(self):
        """Of the peak, against that of the first."""
        return self.peaks[1] / self.peaks[0] - 1 if self.peaks[0] else math.nan


@dataclass
class Comparison:
    columns: list[Column]  # that differ: of observers first, each by its distance, the farthest apart first
    apart: list[str]  # FILE.csv:COLUMN without a number at the times that both reached
    alike: int  # columns that are the same, value by value
    alone: list[str]  # FILE.csv:COLUMN of one run only
    settings: list[tuple[str, str, str]]  # key of the case, value of either run
    faults: list[str]  # of files that are damaged, and left out


def compare(first, second):
    columns, apart, alike, alone, faults = [], [], 0, [], []
    for series in SERIES:
        runs = [of_run(results.read_series, out, series, faults=faults) for out in (first, second)]
        alone += [f"{series}.csv:{name}" for name in sorted(runs[0].keys() ^ runs[1].keys())]
        for name in sorted(runs[0].keys() & runs[1].keys() - {"time[s]"}):
            if runs[0]["time[s]"] == runs[1]["time[s]"] and same(runs[0][name], runs[1][name]):
                alike += 1
            elif column := column_of(series, name, runs):
                columns.append(column)
            else:
                apart.append(f"{series}.csv:{name}")
    cases = [of_run(case_of, out, faults=faults) for out in (first, second)]
    observed = tuple(f"{item.get('name')}_" for case in cases for series in SERIES
                     for item in data.tables_of(data.table(case, series), "observer"))
    columns.sort(key=lambda c: (not c.name.startswith(observed), -c.distance if math.isfinite(c.distance) else 1,
                                c.place))
    return Comparison(columns, apart, alike, alone, different_settings(*cases), faults)


def of_run(read, out, *arguments, faults):
    """What `read` finds in a folder of results; its faults are told with that folder."""
    own = []
    found = read(out, *arguments, faults=own)
    faults += [f"{out}: {fault}" for fault in own]
    return found


def same(first, second):
    """Value by value; what is no number in both is the same."""
    return all(a == b or a != a and b != b for a, b in zip(first, second))


def column_of(series, name, runs):
    """The column, or None if a run has no number in it where both are."""
    begin, end = (limit(run["time[s]"][place] for run in runs) for limit, place in ((max, 0), (min, -1)))
    times, values = [], []
    for run in runs:
        points = [(t, v) for t, v in zip(run["time[s]"], run[name]) if begin <= t <= end and math.isfinite(v)]
        if not points:
            return None
        times.append([t for t, _ in points])
        values.append([v for _, v in points])
    peaks = [results.peak(*run)[1] for run in zip(times, values)]
    # rows of the second before and after the window count for what lies between
    whole = [[x for x, v in zip(runs[1][key], runs[1][name]) if math.isfinite(v)] for key in ("time[s]", name)]
    differences = [results.interpolate(t, *whole) - v for t, v in zip(times[0], values[0])]
    distance = math.hypot(*differences) / math.sqrt(len(differences)) / abs(peaks[0]) if peaks[0] else math.nan
    apart_at = results.peak(times[0], differences)[0] if any(map(math.isfinite, differences)) else times[0][0]
    return Column(series, name, times, values, peaks, distance, apart_at)


def case_of(out, faults=None):
    """The case as it was used; empty where the run did not leave it whole."""
    path = out / "used_case.toml"
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        results.note(faults, path, "is not there")
    except (OSError, ValueError, RecursionError) as error:
        results.note(faults, path, f"cannot be read: {error}")
    return {}


def different_settings(first, second):
    """Keys that the cases have otherwise; "-" where one does not have it. None of a run without its case."""
    if not first or not second:
        return []
    cases = [dict(flat(case)) for case in (first, second)]
    keys = sorted(key for key in cases[0].keys() | cases[1].keys()
                  if cases[0].get(key) != cases[1].get(key) and not key.startswith(NOT_PHYSICS)
                  and not any(is_empty_beside(key, *pair) for pair in (cases, cases[::-1])))
    return [(key, *(text_of(case.get(key)) for case in cases)) for key in keys]


def is_empty_beside(key, case, other):
    """Whether a table is empty in one case, of which the other one has keys: these tell the difference."""
    return case.get(key) == {} and any(name.startswith(f"{key}.") for name in other)


def text_of(value):
    return "-" if value is None else "present, empty" if value in ({}, []) else str(value)


def flat(table, prefix=""):
    """section.key -> value, {} of a table without keys; a section of a list goes by its name, with a number where several
    have it."""
    for key, value in table.items():
        place = f"{prefix}{key}"
        if isinstance(value, dict) and value:
            yield from flat(value, f"{place}.")
        elif isinstance(value, list) and value and all(isinstance(item, dict) for item in value):
            names = [str(item.get("name", number)) for number, item in enumerate(value, 1)]
            for number, (name, item) in enumerate(zip(names, value)):
                nth = f" ({names[:number].count(name) + 1})" if names.count(name) > 1 else ""
                yield from flat({f"{name}{nth}": item}, f"{place}.")
        else:
            yield place, value


def percent(share):
    return f"{100 * share:.2f} %" if math.isfinite(share) else "-"


def write_table(comparison, names, path):
    with whole_file(path) as file:
        writer = csv.writer(file)
        peaks = [f"peak of {name}" for name in names]
        writer.writerow(["series", *peaks, "change of the peak", "distance over the peak"])
        for column in comparison.columns:
            writer.writerow([column.place, *(f"{v:.6g}" for v in (*column.peaks, column.change, column.distance))])
