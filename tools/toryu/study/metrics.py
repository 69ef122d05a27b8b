"""Figures of the runs: taken from series, summaries, times and references, computed from each other, or the difference
from another run."""

import math

from toryu import results
from toryu.processes import DONE
from toryu.study import oscillation
from toryu.study.metric_file import LAST, NEXT, OF_RUN


def fill(study, rows):
    """Adds all metrics to the rows, each of which holds its axes' values and "record"; nan where a run left none. A run
    that failed has its times only: what its series say of a process that did not come to its end would look like a
    result."""
    for row in rows:
        row["summaries"] = results.read_summaries(row["record"].folder)
        for name, value in times(row["summaries"]).items():
            row.setdefault(name, value)
    for metric in study.metrics:
        done = [row for row in rows if row["record"].exit_code == DONE or metric.run]
        taken = [related(metric, study, row, rows) for row in done]
        for row, value in zip(done, taken):
            row[metric.name] = metric.scale * value
    for row in rows:
        del row["summaries"]


def times(summaries):
    """What OF_RUN names. Wall time is that of the slowest process, processor time the sum over them."""
    if not summaries:
        return dict.fromkeys(OF_RUN, math.nan)
    every = summaries.values()
    return {"wall_time": max(s["wall_time"] for s in every), "processor_time": sum(s["processor_time"] for s in every),
            "simulated_time": min(s["simulated_time"] for s in every), "steps": max(s["steps"] for s in every)}


def related(metric, study, row, rows):
    """The figure itself, or its difference from what it is held against."""
    if metric.against is None:
        return take(metric, study, row)
    if not metric.needs_other_runs:
        return difference(metric, take(metric, study, row), metric.against)
    other = partner(metric.against, study, row, rows)
    if other is None or other is row or other["record"].exit_code != DONE:
        return math.nan
    if metric.take == "distance":
        return distance(metric, row, other)
    return difference(metric, take(metric, study, row), take(metric, study, other))


def difference(metric, value, reference):
    if not metric.relative:
        return value - reference
    return value / reference - 1 if reference else math.nan


def partner(against, study, row, rows):
    """The row that `against` means from `row`, or None."""
    wanted = {axis.name: row[axis.name] for axis in study.axes}
    for axis in study.axes:
        if axis.name not in against:
            continue
        value, names = against[axis.name], [v.name for v in axis.values]
        if value == NEXT:
            after = names.index(row[axis.name]) + 1
            value = names[after] if after < len(names) else None
        wanted[axis.name] = names[-1] if value == LAST else value
    return next((r for r in rows if all(r[name] == value for name, value in wanted.items())), None)


def distance(metric, row, other):
    """Root mean square distance of the series from that of the other run, as a share of its peak."""
    times, values = window(metric, other)
    points = list(zip(times, values))
    return results.rms_share(points, *window(metric, row)) if points else math.nan


def take(metric, study, row):
    if metric.run:
        return row[metric.run]
    if metric.summary:
        return of_summary(metric.summary, row["summaries"])
    if metric.reference:
        compared = results.compare(study.references, row["record"].folder)
        return next((c.distance for c in compared if c.label == metric.reference and
                     metric.of in (None, f"{c.series}.csv:{c.column}")), math.nan)
    if metric.formula:
        return metric.formula(**{name: row.get(name, math.nan) for name in metric.formula.names})
    times, values = window(metric, row)
    return of_series(metric.take, times, values, metric.level) if values else math.nan


def of_summary(path, summaries):
    """`fluid.figures.largest_speed` of fluid_summary.toml."""
    value = summaries
    for part in path.split("."):
        value = value.get(part, math.nan) if isinstance(value, dict) else math.nan
    return float(value) if isinstance(value, (int, float)) else math.nan


def window(metric, row):
    """Times and values of the series within the shares of the simulated time; only rows that hold a number."""
    file, _, column = metric.series.partition(":")
    series = results.read_series(row["record"].folder, file.removesuffix(".csv"))
    times, values = series.get("time[s]", []), series.get(column, [])
    end = times[-1] if times else 0
    kept = [(t, v) for t, v in zip(times, values)
            if metric.shares[0] * end <= t <= metric.shares[1] * end and math.isfinite(v)]
    return [t for t, _ in kept], [v for _, v in kept]


def of_series(kind, times, values, level=None):
    return {"last": lambda: values[-1], "first": lambda: values[0], "largest": lambda: max(values),
            "smallest": lambda: min(values), "peak": lambda: max(values, key=abs),
            "peak_time": lambda: results.peak(times, values)[0], "mean": lambda: sum(values) / len(values),
            "rms": lambda: math.sqrt(sum(v * v for v in values) / len(values)),
            "middle": lambda: oscillation.middle(values), "amplitude": lambda: oscillation.amplitude(values),
            "period": lambda: oscillation.period(times, values, level),
            "frequency": lambda: 1 / oscillation.period(times, values, level),
            "amplitude_loss": lambda: oscillation.amplitude_loss(times, values, level)}[kind]()


def absent(metric, record):
    """Why its series is not in the results of a run that is done; "" if it is, or may not be."""
    return results.without_column(record.folder, metric.series) if metric.series and record.exit_code == DONE else ""


def non_finite(study, record):
    """The first series of the metrics that holds a value that is no number, else ""."""
    for metric in study.metrics:
        if metric.series:
            file, _, column = metric.series.partition(":")
            values = results.read_series(record.folder, file.removesuffix(".csv")).get(column, [])
            if not all(map(math.isfinite, values)):
                return metric.series
    return ""
