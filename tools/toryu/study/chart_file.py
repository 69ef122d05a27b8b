"""What a [[chart]] of a study file says. README.md describes the keys."""

import math
from dataclasses import dataclass, field

from toryu import results
from toryu.study.document import did_you_mean, is_number, one_of

KINDS = ("lines", "speed_accuracy")


@dataclass
class Chart:
    title: str
    x: str
    y: str
    colour: str | None  # the metric of a heat map
    lines: str | None
    panels: str | None
    at: dict[str, float | str]  # the other axes
    log: list[str]
    kind: str = "lines"


@dataclass
class Mark:
    """An error that others have published."""

    label: str
    value: float  # error
    time: float | None  # in the chart's unit; None: a line across
    source: str


@dataclass
class SpeedAccuracy:
    """A chart of error against time: a line for each combination of the axes `lines`, its points along `along`."""

    title: str
    error: str  # a metric; its magnitude counts
    time: str
    lines: list[str]
    along: str
    at: dict[str, float | str]
    wanted: list[float]  # errors for which the cheapest setting is named
    marks: list[Mark] = field(default_factory=list)
    kind: str = "speed_accuracy"


def read(table, study, extra):
    """`extra`: name -> unit of the metrics that special views add."""
    kind = table.get("kind", str, "lines", allowed=KINDS)
    chart = _speed_accuracy(table, study, extra) if kind == "speed_accuracy" else _lines(table, study, extra)
    table.close()
    return chart


def _lines(table, study, extra):
    axes = {axis.name: axis for axis in study.axes}
    all_names = [*study.units(), *extra]
    figures = [name for name in all_names if name not in axes]
    colour = table.get("colour", str, None, allowed=figures)
    x = table.get("x", str, allowed=axes if colour else all_names)
    y = table.get("y", str, allowed=axes if colour else figures)
    chart = Chart(table.get("title", str, None), x, y, colour,
                  None if colour else table.get("lines", str, None, allowed=axes),
                  table.get("panels", str, None, allowed=axes), conditions(table, axes),
                  table.texts("log", [], allowed=["x", "y", "colour"] if colour else ["x", "y"]))
    shown = (x, y, chart.lines, chart.panels)
    chart.at = {axis.name: axis.default for axis in study.axes if axis.default and axis.name not in shown} | chart.at
    free = [name for name in axes if name not in (*shown, *chart.at)]
    if x in axes and free:
        table.fault(f"the chart leaves the axis '{free[0]}' open: draw it as 'lines' or 'panels', or choose one value, "
                    f"at = {{ {free[0]} = ... }}")
    chart.title = chart.title or results.readable(colour or y or "")
    return chart


def conditions(table, axes):
    """`at` of a table: axis -> one of its values."""
    at = table.get("at", dict, {})
    for name, value in at.items():
        if name not in axes:
            table.fault(f"'at' names no axis '{name}'{did_you_mean(name, axes)}; there are {one_of(axes)}", "at")
        elif value not in (names := [v.name for v in axes[name].values]):
            table.fault(f"'at' must name a value of the axis '{name}', one of {names}, found {value}", "at")
    return at


def _speed_accuracy(table, study, extra):
    axes = {axis.name: axis for axis in study.axes}
    figures = [m.name for m in study.metrics] + list(extra)
    lines = table.content.get("lines", [])
    if isinstance(lines, str):
        lines = [table.get("lines", str, None, allowed=axes)]
    else:
        lines = table.texts("lines", [], allowed=axes)
    times = [name for name in study.of_run() if name.endswith("_time")]
    chart = SpeedAccuracy(table.get("title", str, None), table.get("error", str, allowed=figures),
                          table.get("time", str, "processor_time", allowed=times), lines,
                          table.get("along", str, allowed=axes), conditions(table, axes), table.get("wanted", list, []))
    for value in chart.wanted:
        if not is_number(value) or not 0 < value < math.inf:
            table.fault(f"'wanted' must be errors above 0, found {value}", "wanted")
            chart.wanted = []
            break
    shown = (chart.along, *lines)
    chart.at = {axis.name: axis.default for axis in study.axes if axis.default and axis.name not in shown} | chart.at
    free = [name for name in axes if name not in (*shown, *chart.at)]
    if free and chart.along:
        table.fault(f"the chart leaves the axis '{free[0]}' open: add it to 'lines', or choose one value, at = "
                    f"{{ {free[0]} = ... }}")
    chart.marks = [_mark(mark) for mark in table.tables("mark")]
    chart.title = chart.title or f"Error against time: {results.readable(chart.error or '')}"
    return chart


def _mark(table):
    mark = Mark(table.label("label"), table.get("value", float), table.get("time", float, None),
                table.get("source", str))
    for key, value in (("value", mark.value), ("time", mark.time)):
        if value is not None and not value > 0:
            table.fault(f"'{key}' must be above 0, found {value}", key)
    table.close()
    return mark
