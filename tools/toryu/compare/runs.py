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


def compare(first, second):
    columns, apart, alike, alone = [], [], 0, []
    for series in SERIES:
        runs = [results.read_series(out, series) for out in (first, second)]
        alone += [f"{series}.csv:{name}" for name in sorted(runs[0].keys() ^ runs[1].keys())]
        for name in sorted(runs[0].keys() & runs[1].keys() - {"time[s]"}):
            if runs[0]["time[s]"] == runs[1]["time[s]"] and same(runs[0][name], runs[1][name]):
                alike += 1
            elif column := column_of(series, name, runs):
                columns.append(column)
            else:
                apart.append(f"{series}.csv:{name}")
    cases = [case_of(out) for out in (first, second)]
    observed = tuple(f"{item.get('name')}_" for case in cases for series in SERIES
                     for item in data.tables_of(data.table(case, series), "observer"))
    columns.sort(key=lambda c: (not c.name.startswith(observed), -c.distance if math.isfinite(c.distance) else 1,
                                c.place))
    return Comparison(columns, apart, alike, alone, different_settings(*cases))


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
    return Column(series, name, times, values, peaks, distance)


def case_of(out):
    """The case as it was used; empty where the run did not leave it whole."""
    try:
        return tomllib.loads((out / "used_case.toml").read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return {}


def different_settings(first, second):
    """Keys that the cases have otherwise; "-" where one does not have it. None of a run without its case."""
    if not first or not second:
        return []
    cases = [dict(flat(case)) for case in (first, second)]
    keys = sorted(key for key in cases[0].keys() | cases[1].keys()
                  if cases[0].get(key) != cases[1].get(key) and not key.startswith(NOT_PHYSICS))
    return [(key, *(str(case.get(key, "-")) for case in cases)) for key in keys]


def flat(table, prefix=""):
    """section.key -> value; a section of a list goes by its name."""
    for key, value in table.items():
        place = f"{prefix}{key}"
        if isinstance(value, dict):
            yield from flat(value, f"{place}.")
        elif isinstance(value, list) and value and all(isinstance(item, dict) for item in value):
            for number, item in enumerate(value):
                yield from flat(item, f"{place}.{item.get('name', number)}.")
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
