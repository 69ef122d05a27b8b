"""Until when a surface recedes: the key `until` of [recession], and after how long each of its goals is reached."""

import csv
import math
from dataclasses import dataclass

import numpy as np

from toryu.program import whole_file
from toryu.study import metrics, table
from toryu.study.document import did_you_mean, found, is_number, one_of
from toryu.study.recession_steps import first_zero

OF_SHAPE = ("depth_mean", "depth_largest", "gap", "edge_radius", "roughness")  # known from the depth alone
ROUNDING = 1e-9


@dataclass
class Goal:
    """A figure of the shape or a metric of the study, and the value at which the surface has receded far enough."""

    name: str
    value: float
    unit: str

    @property
    def of_shape(self):
        return self.name in OF_SHAPE

    def missing(self, now, first):
        """How far the figure still is from the goal, as a share of the goal: 0 or less once it is reached or passed.
        `first`: the figure at the start."""
        return math.copysign(1.0, self.value - first) * (self.value - now) / self.value - ROUNDING


def read(table, study, units):
    """The goals of `until`; `units` of the figures of the shape."""
    alone = {metric.name: metric.unit for metric in study.metrics if not metric.needs_other_runs}
    known, goals = {name: units[name] for name in OF_SHAPE} | alone, []
    for name, value in (table.get("until", dict, {}) or {}).items():
        if name not in known:
            table.fault(f"'until' names no figure '{name}'{did_you_mean(name, known)}; there are {one_of(known)}", "until")
        elif not is_number(value) or not value > 0:
            table.fault(f"'{name}' of 'until' must be a number above 0, found {found(value)}", "until")
        else:
            goals.append(Goal(name, value, known[name]))
    return goals


def metric(study, goal, record):
    """A metric of the study in the run of `record`."""
    row = table.row_of(study, [record])
    metrics.fill(study, [row])
    return row[goal.name]


def time_of(goal, times, values):
    """When the values come to the goal [s]: on the parabola through the three that lie about it, of two on the line; nan if
    they do not."""
    for k in range(1, len(values)):
        if goal.missing(values[k], values[0]) <= 0:
            t, v = np.array(times[max(k - 2, 0):k + 1]), np.array(values[max(k - 2, 0):k + 1])
            curve = np.polyfit((t - t[-2]) / (t[-1] - t[-2]), v, len(t) - 1)
            share = first_zero(lambda x: goal.missing(np.polyval(curve, x), values[0]), 1.0)
            return float(t[-2] + share * (t[-1] - t[-2]))
    return math.nan


def write(path, view, study):
    """goals.csv: when each goal is reached, a row a goal of each line."""
    with whole_file(path) as file:
        writer = csv.writer(file)
        writer.writerow(["line", "figure", "goal", "unit", "machining_time[s]", *["cycles"] * bool(view.cycle)])
        for chain in view.chains:
            for goal in view.until:
                time = time_of(goal, *chain.course(study, goal))
                writer.writerow([chain.label, goal.name, table.text(float(goal.value)), goal.unit, table.text(time),
                                 *([table.text(time / view.cycle)] if view.cycle else [])])


def sentence(goal, view, times, values):
    """When a goal is reached, or how near it came."""
    aim, time = f"{goal.value:.4g} {goal.unit}".strip(), time_of(goal, times, values)
    name = goal.name.replace("_", " ")
    if math.isnan(time):
        return f"The {name} does not come to {aim}: it is {values[-1]:.4g} {goal.unit}".strip() + " in the end."
    when = f"{time / view.cycle:.4g} cycles" if view.cycle else f"{time:.4g} s"
    return f"The {name} comes to {aim} after {when}."
