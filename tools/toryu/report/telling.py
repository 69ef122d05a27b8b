"""Which moment of a run tells most: where what is observed is largest; where it failed, and the particle that did."""

import contextlib
import math
import re

import h5py
import numpy as np

from toryu import results
from toryu.processes import DONE, INTERRUPTED
from toryu.report import data

FAILED = re.compile(r"\b(\w+) particle (\d+) at t = ")


def moment(out, case, comparisons, found, state):
    """The time [s] at which the page opens, and the mark of the particle that failed, if any."""
    if state["code"] not in (DONE, INTERRUPTED, None):
        return {"time": math.inf, "mark": mark(found, state["words"])}
    for series, column in observed(case, comparisons):
        columns = results.read_series(out, series)
        for name, values in columns.items():
            if column(name) and any(map(math.isfinite, values)):
                return {"time": results.peak(columns["time[s]"], values)[0], "mark": None}
    return {"time": 0.0, "mark": None}


def observed(case, comparisons):
    """Series and a test of column names, what matters most first: what has a reference, then what the case observes."""
    for comparison in comparisons:
        yield comparison.series, comparison.column.__eq__
    for series in ("solid", "fluid"):
        for observer in data.tables_of(data.table(case, series), "observer"):
            name = str(observer.get("name", ""))
            yield series, re.compile(rf"{re.escape(name)}(_displacement_[xy])?\[.*\]").fullmatch


def mark(found, words):
    """Where the particle that `words` blame was in the last frame of its body; None if that is not to be found."""
    for body_name, number in FAILED.findall(words):
        for body in found:
            with contextlib.suppress(*results.DAMAGED):
                if body.name != body_name:
                    continue
                time, path = body.files[-1]
                with h5py.File(path) as file:
                    (places,) = np.nonzero(file["VTKHDF/PointData/particle"][:] == int(number))
                    x, y = file["VTKHDF/Points"][places[0], :2]
                if math.isfinite(x) and math.isfinite(y):
                    return {"body": body.name, "particle": int(number), "time": time, "x": float(x), "y": float(y)}
    return None
