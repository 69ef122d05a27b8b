"""The table of a study: one row a run, its values, its figures, how it ended."""

import csv
import math
from dataclasses import dataclass

from toryu import results
from toryu.program import whole_file
from toryu.report import data
from toryu.study import metrics, timing


@dataclass
class Table:
    units: dict[str, str]  # column -> unit, in order; the first are the axes
    rows: list[dict]  # column -> value, and "record", "cause"

    def column(self, name):
        return [row.get(name, math.nan) for row in self.rows]


def build(study, records, views):
    """`records`: of all runs; the repetitions of a setting become one row, that of the first."""
    units = study.units()
    for view in views:
        units |= view.units()
    groups = {}
    for record in records:
        groups.setdefault(tuple(record.setting.values.items()), []).append(record)
    rows = [row_of(study, group) for group in groups.values()]
    metrics.fill(study, rows)
    for row in rows:
        for view in views:
            row |= view.figures(study, row)
    for view in views:
        if hasattr(view, "relate"):
            view.relate(study, rows)
    return Table(units, rows)


def row_of(study, group):
    """Of the repetitions of one setting."""
    row = group[0].setting.values | {"record": group[0], "cause": group[0].cause}
    if study.timing:
        row |= timing.figures(group, [metrics.times(results.read_summaries(record.folder)) for record in group])
    return row


def readable_size(unit, values):
    """Factor and unit that bring figures to a readable size, such as 1e6 and µm; seconds stay seconds."""
    largest = max((abs(v) for v in values if not isinstance(v, str) and math.isfinite(v)), default=0)
    return (1, "s") if unit == "s" else data.scaled(unit, largest)


def text(value):
    if isinstance(value, float):
        return f"{value:.6g}" if math.isfinite(value) else ""
    return str(value)


def write(table, path):
    with whole_file(path) as file:
        writer = csv.writer(file)
        writer.writerow([f"{name}[{unit}]" if unit else name for name, unit in table.units.items()] +
                        ["exit_code", "cause", "run"])
        for row in table.rows:
            record = row["record"]
            writer.writerow([text(row.get(name, math.nan)) for name in table.units] +
                            [record.exit_code, row["cause"], f"runs/{record.folder.name}"])
