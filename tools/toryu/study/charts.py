"""The charts that a study file declares: lines over an axis or a figure, bars over named choices, heat maps over two
axes."""

import math

import matplotlib.colors
import matplotlib.ticker

from toryu.study import drawing, speed_accuracy
from toryu.study.table import readable_size, text

HEAT = "viridis"


def draw(study, table, folder):
    """(title, SVG for the page, where it lies) of every [[chart]]."""
    drawn = []
    for number, chart in enumerate(study.charts, 1):
        make = speed_accuracy.draw if chart.kind == "speed_accuracy" else kind_of(chart, study)
        made = make(chart, study, table)
        name = f"chart_{number:02}"
        drawn.append((chart.title, drawing.save(made, folder / name), f"charts/{name}"))
    return drawn


def answers(study, table):
    return [speed_accuracy.answer(chart, study, table) for chart in study.charts if chart.kind == "speed_accuracy"]


def kind_of(chart, study):
    if chart.colour:
        return heat_map
    axis = axis_of(study, chart.x)
    return bar_chart if axis and any(isinstance(value.name, str) for value in axis.values) else line_chart


def axis_of(study, name):
    return next((axis for axis in study.axes if axis.name == name), None)


def panels_of(chart, study, table):
    """(title, rows) of each panel."""
    rows = [row for row in table.rows if all(row[name] == value for name, value in chart.at.items())]
    axis = axis_of(study, chart.panels)
    if axis is None:
        return [("", rows)]
    return [(f"{label(axis)} {value_text(value.name, axis.unit)}", [r for r in rows if r[axis.name] == value.name])
            for value in axis.values]


def label(axis):
    return axis.name.replace("_", " ")


def value_text(value, unit):
    return f"{text(value) if isinstance(value, str) else f'{value:g}'} {unit}".strip()


def line_chart(chart, study, table):
    panels = panels_of(chart, study, table)
    made, axes = drawing.figure(len(panels))
    (x_factor, x_label), (y_factor, y_label) = (factor_and_label(name, study, table) for name in (chart.x, chart.y))
    for panel, (title, rows) in zip(axes, panels):
        panel.set_title(title)
        for number, (name, points) in enumerate(lines_of(chart, study, rows, x_factor, y_factor)):
            panel.plot(*zip(*points), marker=drawing.MARKERS[number % 7], color=drawing.LINES[number % 7],
                       label=named(name, points, chart), linestyle="-" if one_parameter(chart, study) else "none")
        scale(chart, study, panel)
        panel.set_xlabel(x_label)
    axes[0].set_ylabel(y_label)
    add_legend(chart, study, axes[-1])
    return made


def named(name, points, chart):
    """The name of a line in the legend, which says so where no run of it has the figure."""
    log = ["x" in chart.log, "y" in chart.log]
    drawn = any(all(math.isfinite(v) and (v > 0 or not of_log) for v, of_log in zip(point, log)) for point in points)
    return name if drawn else f"{name} (none)"


def add_legend(chart, study, panel):
    if chart.lines:
        axis = axis_of(study, chart.lines)
        panel.legend(title=drawing.readable(axis.name, axis.unit), alignment="left", loc="center left",
                     bbox_to_anchor=(1.0, 0.5))


def bar_chart(chart, study, table):
    """A bar for each named choice, from above; a run without the figure has none."""
    panels = panels_of(chart, study, table)
    names = [value_text(value.name, "") for value in axis_of(study, chart.x).values]
    made, axes = drawing.figure(len(panels), height=0.9 + 0.24 * len(names))
    factor, label_of_figure = factor_and_label(chart.y, study, table)
    for panel, (title, rows) in zip(axes, panels):
        panel.set_title(title)
        lines = lines_of(chart, study, rows, 1, factor)
        thickness = 0.8 / len(lines)
        for number, (name, points) in enumerate(lines):
            places = [names.index(value_text(x, "")) + (number + 0.5) * thickness - 0.4 for x, _ in points]
            panel.barh(places, [y for _, y in points], thickness * 0.9, color=drawing.LINES[number % 7],
                       label=name if any(math.isfinite(y) for _, y in points) else f"{name} (none)")
        panel.set_yticks(range(len(names)), names)
        panel.grid(axis="y", visible=False)
        if "y" in chart.log:
            drawing.logarithmic(panel, "x")
        panel.set_xlabel(label_of_figure)
    axes[0].invert_yaxis()  # all panels share it
    add_legend(chart, study, axes[-1])
    return made


def factor_and_label(name, study, table):
    """Of an axis as the study gives it, of a figure in a readable size."""
    if axis_of(study, name):
        return 1, drawing.readable(name, table.units[name])
    factor, unit = readable_size(table.units[name], table.column(name))
    return factor, drawing.readable(name, unit)


def lines_of(chart, study, rows, x_factor, y_factor):
    """(name, [(x, y), ...]) of each line; runs without the figure leave a gap."""
    axis = axis_of(study, chart.lines)
    groups = {value_text(v.name, ""): [r for r in rows if r[axis.name] == v.name] for v in axis.values} if axis \
        else {"": rows}
    def point(row):
        return (row.get(chart.x, math.nan) * x_factor if x_factor != 1 else row.get(chart.x, math.nan),
                row.get(chart.y, math.nan) * y_factor)

    return [(name, [point(row) for row in group]) for name, group in groups.items() if group]


def one_parameter(chart, study):
    """Whether the points of a line follow each other along one axis."""
    named = {chart.lines, chart.panels, *chart.at}
    return sum(axis.name not in named for axis in study.axes) <= 1


def scale(chart, study, panel):
    """Logarithmic where asked for; the marks of an axis of the study stand at its values."""
    axis = axis_of(study, chart.x)
    for which in chart.log:
        drawing.logarithmic(panel, which)
    if axis and len(axis.values) <= 8:
        drawing.ticks(panel, [v.name for v in axis.values], [value_text(v.name, "") for v in axis.values])


def heat_map(chart, study, table):
    """A cell a run, with its figure written in; a failed run is hatched."""
    across, along = axis_of(study, chart.x), axis_of(study, chart.y)
    panels = panels_of(chart, study, table)
    factor, label_of_colour = factor_and_label(chart.colour, study, table)
    values = [v * factor for v in table.column(chart.colour) if math.isfinite(v)]
    norm_of = matplotlib.colors.LogNorm if "colour" in chart.log else matplotlib.colors.Normalize
    norm = norm_of(min(values), max(values)) if values else matplotlib.colors.Normalize()
    made, axes = drawing.figure(len(panels))
    for panel, (title, rows) in zip(axes, panels):
        cells = {(row[chart.x], row[chart.y]): row.get(chart.colour, math.nan) * factor for row in rows}
        grid = [[cells.get((a.name, b.name), math.nan) for a in across.values] for b in along.values]
        image = panel.imshow(grid, origin="lower", aspect="auto", cmap=HEAT, norm=norm)
        for j, line in enumerate(grid):
            for i, value in enumerate(line):
                if (across.values[i].name, along.values[j].name) in cells:
                    write_cell(panel, i, j, value, norm)
        panel.set_title(title)
        panel.grid(False)
        drawing.choices(panel, [value_text(v.name, "") for v in across.values])
        panel.set_yticks(range(len(along.values)), [value_text(v.name, "") for v in along.values])
        panel.set_xlabel(drawing.readable(chart.x, across.unit))
    axes[0].set_ylabel(drawing.readable(chart.y, along.unit))
    bar = made.colorbar(image, ax=axes, label=label_of_colour, format="%g")
    bar.minorformatter = matplotlib.ticker.NullFormatter()  # a logarithmic one would write mathematics
    return made


def write_cell(panel, i, j, value, norm):
    if math.isfinite(value):
        panel.text(i, j, f"{value:.3g}", ha="center", va="center", fontsize=8.5,
                   color="black" if norm(value) > 0.6 else "white")
    else:
        panel.fill_between([i - 0.5, i + 0.5], j - 0.5, j + 0.5, facecolor="none", hatch="////",
                           edgecolor=drawing.PALETTE["soft"], linewidth=0)
        panel.text(i, j, "failed", ha="center", va="center", fontsize=8.5, color=drawing.PALETTE["bad"])
