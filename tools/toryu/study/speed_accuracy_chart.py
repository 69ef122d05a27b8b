"""The picture of speed against accuracy: error over time, both logarithmic, the Pareto front and published errors."""

import math

from toryu import counted
from toryu.study import drawing, page

DASHES = ("-", "--", ":")


def draw(chart, lines, front, factor, time_unit, error_unit):
    made, (panel, *_) = drawing.figure(1, height=4.6)
    made.set_figwidth(2 * drawing.WIDTH)
    for number, line in enumerate(lines):
        if not line.points:
            continue
        look = {"color": drawing.LINES[number % 7], "marker": drawing.MARKERS[number % 7]}
        panel.plot([p.time * factor for p in line.points], [p.error for p in line.points], DASHES[number // 7 % 3],
                   label=legend_of(line), zorder=3, **look)
    draw_front(panel, chart, front, factor)
    draw_marks(panel, chart, factor)
    for which in "xy":
        drawing.logarithmic(panel, which)
    panel.set_xlabel(drawing.readable(chart.time, time_unit))
    panel.set_ylabel(drawing.readable(chart.error, error_unit))
    panel.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    return made


def legend_of(line):
    words = line.name or "all"
    if not math.isfinite(line.exponent):
        return words
    if line.exponent <= 0:
        return f"{words}  (does not fall)"
    return f"{words}  (k = {line.exponent:.2f}, {counted(len(line.points), 'point')})"


def draw_front(panel, chart, front, factor):
    """Steps: for a time up to the next point, the error of the last."""
    if not front:
        return
    times, errors = [p.time * factor for p in front], [p.error for p in front]
    panel.step(times, errors, where="post", color=drawing.PALETTE["soft"], linewidth=6, alpha=0.28, zorder=1,
               label="Pareto front", solid_joinstyle="round")
    for number, point in enumerate(front, 1):
        panel.annotate(f"{number}: {value_of(chart, point)}", (point.time * factor, point.error), xytext=(5, 6),
                       textcoords="offset points", fontsize=7.5, color=drawing.PALETTE["ink"])


def value_of(chart, point):
    value = point.row[chart.along]
    return page.text(value)


def draw_marks(panel, chart, factor):
    for mark in chart.marks:
        if mark.time is None:
            panel.axhline(mark.value, color=drawing.PALETTE["soft"], linewidth=1, linestyle=(0, (4, 3)), zorder=0)
            panel.annotate(mark.label, (0.995, mark.value), xycoords=("axes fraction", "data"), xytext=(0, 2),
                           textcoords="offset points", ha="right", va="bottom", fontsize=7.5, color=drawing.PALETTE["soft"])
        else:
            panel.plot([mark.time * factor], [mark.value], "*", color=drawing.PALETTE["ink"], markersize=9, zorder=4)
            panel.annotate(mark.label, (mark.time * factor, mark.value), xytext=(6, 4), textcoords="offset points",
                           fontsize=7.5, color=drawing.PALETTE["soft"])
