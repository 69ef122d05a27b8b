"""The edge of failure in each column of a map, found by bisection from its stable side."""

import itertools
import math

from toryu.study.settings import left_out


def ordered(y, tried):
    """The values that were tried, from the stable side on. `tried`: value -> whether it is stable."""
    return sorted(tried, reverse=y.unstable < y.stable)


def bracket(y, tried):
    """The last stable value before the first failure, and that failure; None where all are stable or none is."""
    values = ordered(y, tried)
    first = next((k for k, value in enumerate(values) if not tried[value]), None)
    return (values[first - 1], values[first]) if first else None


def middle(y, a, b):
    """Between two values, in the sense of the axis; with as many digits as anyone wants to read."""
    exact = math.copysign(math.sqrt(a * b), a) if y.log else (a + b) / 2
    rounded = float(f"{exact:.6g}")
    return rounded if min(a, b) < rounded < max(a, b) else exact


def narrow(y, a, b):
    """Whether the bracket is as narrow as asked: as a share of the value, on a linear axis of the whole range."""
    return abs(a - b) <= y.resolution * (max(abs(a), abs(b)) if y.log else abs(y.unstable - y.stable))


def next_values(y, tried):
    """What is to run next in a column: both sides and the grid first, then the middle of the bracket until it is
    narrow."""
    missing = [value for value in y.first_values() if value not in tried]
    if missing:
        return missing
    found = bracket(y, tried)
    return [middle(y, *found)] if found and not narrow(y, *found) else []


def contradictions(y, tried):
    """Values beyond the first failure that are stable all the same."""
    values = ordered(y, tried)
    first = next((k for k, value in enumerate(values) if not tried[value]), len(values))
    return [value for value in values[first:] if tried[value]]


def longest(y):
    """At most so many values are tried in a column."""
    share = abs(math.log(y.unstable / y.stable)) / -math.log1p(-y.resolution) if y.log else 1 / y.resolution
    return len(y.first_values()) + max(0, math.ceil(math.log2(max(1.0, share))))


class Columns:
    """The columns of a bisected map: every combination of its other axes."""

    def __init__(self, study, make):
        self.y, self.make = study.map.y, make
        others = [axis.values for axis in study.axes if axis is not self.y.axis]
        self.place = study.axes.index(self.y.axis)
        any_y = self.y.axis.values[0]
        self.columns = [column for column in itertools.product(*others)
                        if not any(left_out(study, rule, self.values(column, any_y)) for rule in study.leave_out)]

    def setting(self, column, value):
        return self.make(self.values(column, self.y.axis.value_of(value)))

    def values(self, column, y_value):
        """One of each axis of the study."""
        return [*column[:self.place], y_value, *column[self.place:]]

    def waiting(self, tried):
        """(column number, value, setting) of all that can run now. `tried`: for each column value -> whether stable."""
        return [(k, value, self.setting(column, value)) for k, column in enumerate(self.columns)
                for value in next_values(self.y, tried[k])]


def most_runs(study, make):
    return len(Columns(study, make).columns) * longest(study.map.y)


def search(study, make, judge, run):
    """Runs wave after wave, in each wave the columns side by side; returns all records in the order of the columns.
    `judge(record)`: whether it is stable. `run(settings)`: their records, or None to stop before this wave."""
    columns = Columns(study, make)
    tried = [{} for _ in columns.columns]
    records = [{} for _ in columns.columns]
    while waiting := columns.waiting(tried):
        made = run([setting for _, _, setting in waiting])
        if made is None:
            break
        for (k, value, _), record in zip(waiting, made):
            tried[k][value] = judge(record)
            records[k][value] = record
    return [column[value] for column in records for value in ordered(study.map.y, column)]
