"""Speed against accuracy: which settings are on the Pareto front, how error falls with time, what to take for a wanted
error."""

import math
from dataclasses import dataclass

from toryu import counted
from toryu.report import tables
from toryu.study import oscillation, page
from toryu.study.answer import Answer
from toryu.study.progress import duration
from toryu.study.table import readable_size


FAR = 1.5  # from the power law, as a factor: beyond it there is none


@dataclass
class Point:
    """A setting that has an error and a time."""

    time: float  # as the table has it
    error: float  # magnitude
    row: dict


@dataclass
class Line:
    name: str
    points: list[Point]  # along the axis
    exponent: float  # k of error ~ time^-k, nan with fewer than two points
    factor: float  # largest distance of a point from that power law, as a factor


def lines_of(chart, study, table):
    """The lines of the chart, one for each combination of the axes that it names."""
    groups = {}
    for row in table.rows:
        if all(row[name] == value for name, value in chart.at.items()):
            groups.setdefault(tuple(row[name] for name in chart.lines), []).append(row)
    return [line_of(", ".join(named(study, axis, value) for axis, value in zip(chart.lines, values)), chart, rows)
            for values, rows in groups.items()]


def named(study, axis, value):
    """A choice speaks for itself, a number needs its axis."""
    unit = next(a.unit for a in study.axes if a.name == axis)
    return value if isinstance(value, str) else f"{axis.replace('_', ' ')} {value:g} {unit}".strip()


def line_of(name, chart, rows):
    points = [Point(row[chart.time], abs(row.get(chart.error, math.nan)), row) for row in rows]
    points = [p for p in points if math.isfinite(p.error) and p.error > 0 and math.isfinite(p.time) and p.time > 0]
    return Line(name, points, *power_law(points))


def power_law(points):
    """(k, factor): error ~ time^-k by least squares in logarithms, and how far the farthest point is from it."""
    logs = [(math.log(p.time), math.log(p.error)) for p in points]
    slope = oscillation.slope(logs) if len(logs) > 1 else math.nan
    if not math.isfinite(slope):
        return math.nan, math.nan
    mean_x, mean_y = (sum(values) / len(logs) for values in zip(*logs))
    return -slope, math.exp(max(abs(y - mean_y - slope * (x - mean_x)) for x, y in logs))


def front(points):
    """The points that no other beats in both time and error, the fastest first. Times that differ by less than the
    repetitions of a setting do are the same."""
    best, found = math.inf, []
    for point in sorted(points, key=lambda p: (p.time, p.error)):
        if point.error < best:
            best = point.error
            found.append(point)
    return [p for p, after in zip(found, [*found[1:], None]) if after is None or after.time > p.time * (1 + spread(p, after))]


def spread(*points):
    """How far the repetitions of these settings differ in time, as a share."""
    shares = [point.row.get("time_spread", 0.0) for point in points]
    return max((share for share in shares if math.isfinite(share)), default=0.0)


def answer(chart, study, table):
    lines = lines_of(chart, study, table)
    points = [point for line in lines for point in line.points]
    sentences = [sentence(chart, study, lines, wanted) for wanted in sorted(chart.wanted, reverse=True)]
    parts = [exponents(lines), front_table(chart, study, front(points)), left_out(chart, study, table, points),
             marks(chart)]
    return Answer(chart.title, "\n".join(sentences) or f"On the front: {counted(len(front(points)), 'setting')}.", "".join(parts))


def in_words(value, unit):
    return duration(value) if unit == "s" and value >= 10 else f"{value:.3g} {unit}".strip()


def time_unit(chart, table_units):
    return table_units[chart.time] or "times the reference loop"


def setting(chart, study, row):
    """The setting on a line of words: the axes that the chart moves."""
    return ", ".join(named(study, axis, row[axis]) for axis in [*chart.lines, chart.along])


def sentence(chart, study, lines, wanted):
    """Which setting to take for a wanted error: the cheapest from which on its line stays within it. An error that only
    passes through zero is told as such."""
    points = [point for line in lines for point in line.points]
    good = [p for p in points if p.error <= wanted]
    if not good:
        closest = min(points, key=lambda p: p.error, default=None)
        if closest is None:
            return "No setting has an error and a time."
        return (f"No setting has an error of {wanted:g}; the smallest, {closest.error:.3g}, has "
                f"{setting(chart, study, closest.row)}.")
    unit = time_unit(chart, study.units())

    def said(point):
        return f"{setting(chart, study, point.row)}: {point.error:.3g} in {in_words(point.time, unit)}"

    staying = [p for line in lines for p in line.points if stays(line, p, wanted)]
    cheapest, best = map(cheapest_of, (good, staying))
    if best is None:
        return (f"For an error of {wanted:g} take {said(cheapest)}, but at greater cost its error is larger again: it passes "
                "through zero.")
    passing = "" if best is cheapest else f" (Cheaper only in passing through zero: {said(cheapest)}.)"
    if any(changes_sign(line, best, chart.error) for line in lines):
        passing += " Beside it on its line the error has the other sign: it is small there by passing through zero."
    return f"For an error of {wanted:g} take {said(best)}.{passing}"


def cheapest_of(points):
    """Of those whose times are the same as the shortest, but for what repetitions differ by, the most accurate; None of
    none."""
    first = min(points, key=lambda p: p.time, default=None)
    same = [p for p in points if p.time <= first.time * (1 + spread(first, p))]
    return min(same, key=lambda p: p.error, default=None)


def stays(line, point, wanted):
    """Whether the error is within `wanted` there and wherever the line costs more."""
    return all(p.error <= wanted for p in line.points if p.time >= point.time)


def changes_sign(line, point, error):
    """Whether the error of a neighbour of the point on its line has the other sign."""
    ordered = sorted(line.points, key=lambda p: p.time)
    return any(point in pair and pair[0].row[error] * pair[1].row[error] < 0 for pair in zip(ordered, ordered[1:]))


def remark(line):
    """What is to be said of an exponent."""
    if not math.isfinite(line.exponent):
        return ""
    if line.exponent <= 0:
        return "the error does not fall with time"
    if len(line.points) == 2:
        return "two points: any power law fits"
    return "no power law: the points lie far from it" if line.factor > FAR else ""


def exponents(lines):
    rows = []
    for line in lines:
        k = f"{line.exponent:.2f}" if math.isfinite(line.exponent) else "–"
        near = f"{line.factor:.2f}" if len(line.points) > 2 else "–"
        rows.append([line.name or "all", k, str(len(line.points)), near, remark(line)])
    return ("<h3>How the error falls with time: error ~ time<sup>−k</sup></h3>" +
            tables.table(["choice", "k", "rests on points", "farthest point, as a factor", ""], rows, (1, 2, 3)))


def front_table(chart, study, points):
    unit = study.units()[chart.time]
    rows = [[setting(chart, study, p.row), f"{p.error:.4g}", in_words(p.time, unit)] for p in points]
    return ("<h3>The Pareto front: no other setting is both faster and more accurate</h3>" +
            tables.table(["setting", chart.error.replace("_", " "), chart.time.replace("_", " ")], rows, (1, 2)))


def left_out(chart, study, table, points):
    """Settings without a point, and why."""
    drawn = {id(p.row) for p in points}
    no_error = "has no error above 0: it is what the others are held against, or the figure is missing"
    rows = [[page.setting_text(study, row), row["cause"] or no_error] for row in table.rows
            if id(row) not in drawn and all(row[name] == value for name, value in chart.at.items())]
    return "<h3>Not drawn</h3>" + tables.table(["setting", "why"], rows) if rows else ""


def marks(chart):
    rows = [[mark.label, f"{mark.value:g}", mark.source] for mark in chart.marks]
    return "<h3>Published errors</h3>" + tables.table(["", "error", "source"], rows, (1,)) if rows else ""


def draw(chart, study, table):
    from toryu.study import speed_accuracy_chart

    factor, unit = readable_size(table.units[chart.time], table.column(chart.time))
    lines = lines_of(chart, study, table)
    return speed_accuracy_chart.draw(chart, lines, front([p for line in lines for p in line.points]), factor,
                                     unit or "reference loops", table.units.get(chart.error, ""))
