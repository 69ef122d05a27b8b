"""Figures of a run: taken from its series, its summaries, its times, or the distance to a reference."""

import math

import results
from processes import DONE
from study_file import OF_RUN


def of_run(study, record):
    """Name -> value of all metrics; nan where the run left none. A run that failed has its times only: what its series
    say of a process that did not come to its end would look like a result."""
    summaries = results.read_summaries(record.folder)
    figures = times(summaries)
    for metric in study.metrics:
        if record.exit_code == DONE or metric.run:
            figures[metric.name] = metric.scale * take(metric, study, record, summaries, figures)
    return figures


def times(summaries):
    """What OF_RUN names. Wall time is that of the slowest process, processor time the sum over them."""
    if not summaries:
        return dict.fromkeys(OF_RUN, math.nan)
    every = summaries.values()
    return {"wall_time": max(s["wall_time"] for s in every), "processor_time": sum(s["processor_time"] for s in every),
            "simulated_time": min(s["simulated_time"] for s in every), "steps": max(s["steps"] for s in every)}


def take(metric, study, record, summaries, figures):
    if metric.run:
        return figures[metric.run]
    if metric.summary:
        return of_summary(metric.summary, summaries)
    if metric.reference:
        compared = results.compare(study.case, record.folder)
        return next((c.distance for c in compared if c.label == metric.reference), math.nan)
    file, _, column = metric.series.partition(":")
    series = results.read_series(record.folder, file.removesuffix(".csv"))
    return of_series(metric.take, metric.shares, series.get("time[s]", []), series.get(column, []))


def of_summary(path, summaries):
    """`fluid.figures.largest_speed` of fluid_summary.toml."""
    value = summaries
    for part in path.split("."):
        value = value.get(part, math.nan) if isinstance(value, dict) else math.nan
    return float(value) if isinstance(value, (int, float)) else math.nan


def of_series(kind, shares, times, values):
    """The last, largest, ... of the values within the shares of the simulated time."""
    end = times[-1] if times else 0
    kept = [v for t, v in zip(times, values) if shares[0] * end <= t <= shares[1] * end and math.isfinite(v)]
    if not kept:
        return math.nan
    return {"last": lambda: kept[-1], "largest": lambda: max(kept), "smallest": lambda: min(kept),
            "peak": lambda: max(kept, key=abs), "mean": lambda: sum(kept) / len(kept),
            "rms": lambda: math.sqrt(sum(v * v for v in kept) / len(kept))}[kind]()
