"""The pictures of a map: edges of failure over x with the theory's curves, the runs by their verdicts, or cells."""

import math

import matplotlib.colors

from toryu.study import charts, drawing, map_results, verdicts

LOOK = {verdicts.STABLE: ("o", drawing.PALETTE["good"]), verdicts.UNSTABLE: ("X", drawing.PALETTE["bad"]),
        verdicts.WRONG: ("D", drawing.PALETTE["c4"]), verdicts.REFUSED: ("s", drawing.PALETTE["soft"]),
        verdicts.HANGS: ("*", drawing.PALETTE["c5"])}
DASHES = ("--", ":", "-.")


def draw(study, table, folder):
    if study.map.y is None:
        return [("Verdicts", drawing.save(cells(study, table), folder / "map"), "charts/map")]
    every = map_results.columns(study, table)
    drawn = []
    if study.map.edges:
        drawn.append(("The edge of failure", drawing.save(edges(study, every), folder / "edges"), "charts/edges"))
    drawn.append(("The runs and the edge", drawing.save(runs(study, every), folder / "map"), "charts/map"))
    return drawn


def edges_by_choice(study, every):
    """(value of the axis `edges`, its columns) in the order of the file."""
    names = dict.fromkeys(column.edge_of for column in every)
    return [(name, [column for column in every if column.edge_of == name]) for name in names]


def edges(study, every):
    """All edges in one picture."""
    made, (panel, *_) = drawing.figure()
    for number, (name, mine) in enumerate(edges_by_choice(study, every)):
        colour = drawing.LINES[number % 7]
        draw_edge(panel, study, mine, colour, str(name), drawing.MARKERS[number % 7])
        draw_theories(panel, study, every, colour, [t for t in study.map.theories if t.edge == name])
    draw_theories(panel, study, every, drawing.PALETTE["ink"], [t for t in study.map.theories if t.edge is None])
    finish(panel, study, every)
    panel.set_ylabel(drawing.readable(study.map.y.axis.name, study.map.y.axis.unit))
    panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return made


def runs(study, every):
    """Each run by its verdict, a panel for each edge."""
    groups = edges_by_choice(study, every)
    made, panels = drawing.figure(len(groups), height=drawing.HEIGHT if len(groups) < 4 else 4.2)
    seen = {}
    for panel, (name, mine) in zip(panels, groups):
        panel.set_title("" if name is None else str(name))
        draw_edge(panel, study, mine, drawing.PALETTE["ink"], "edge")
        draw_theories(panel, study, every, drawing.PALETTE["c0"],
                      [t for t in study.map.theories if t.edge in (None, name)])
        for column in mine:
            for row in column.rows:
                draw_run(panel, column, row, row[study.map.y.axis.name])
        finish(panel, study, every)
        for handle, label in zip(*panel.get_legend_handles_labels()):
            seen.setdefault(label, handle)
    for kind in dict.fromkeys(row["verdict"] for column in every for row in column.rows):
        marker, colour = LOOK[kind]
        seen[kind] = panels[-1].plot([], [], marker, color=colour)[0]
    panels[0].set_ylabel(drawing.readable(study.map.y.axis.name, study.map.y.axis.unit))
    panels[-1].legend(seen.values(), seen.keys(), loc="center left", bbox_to_anchor=(1.0, 0.5))
    return made


def draw_run(panel, column, row, value):
    marker, colour = LOOK[row["verdict"]]
    panel.plot([column.x], [value], marker, color=colour, zorder=3, markersize=9 if marker == "*" else 5,
               gid=f"run-{row['record'].folder.name}")
    if value in column.against:
        panel.plot([column.x], [value], "o", markersize=12, fillstyle="none", color=drawing.PALETTE["bad"], zorder=4)


def draw_edge(panel, study, mine, colour, label, marker=None):
    """The middle of each bracket with the bracket as a bar; columns without an edge leave a gap. One column alone is a
    mark, none nothing."""
    y = study.map.y
    middles = [column.edge(y) for column in mine]
    drawn = sum(map(math.isfinite, middles))
    if not drawn:
        return
    if drawn == 1:
        marker = marker or drawing.MARKERS[0]
    below = [abs(m - min(c.stable, c.unstable)) if math.isfinite(m) else 0 for m, c in zip(middles, mine)]
    above = [abs(max(c.stable, c.unstable) - m) if math.isfinite(m) else 0 for m, c in zip(middles, mine)]
    panel.errorbar([column.x for column in mine], middles, [below, above], color=colour, label=label, marker=marker,
                   capsize=2.5, zorder=2)


def draw_theories(panel, study, every, colour, theories):
    """The theory's curves, on a fine grid of x; none that lies beyond the picture."""
    low, high = limits(study.map.y)
    xs = sorted({column.x for column in every})
    fine = between(xs[0], xs[-1], "x" in study.map.log) if len(xs) > 1 else xs
    for number, theory in enumerate(theories):
        values = [theory(x) for x in fine]
        if any(low <= value <= high for value in values):
            panel.plot(fine, values, DASHES[number % 3], color=colour, linewidth=1.4, zorder=1, label=theory.label,
                       marker="_" if len(xs) == 1 else None, markersize=14)


def between(first, last, log, count=80):
    if log:
        return [first * (last / first) ** (k / count) for k in range(count + 1)]
    return [first + (last - first) * k / count for k in range(count + 1)]


def limits(y):
    """Of the picture along y: the range that was searched, and a little beyond."""
    low, high = sorted((y.stable, y.unstable))
    if y.log:
        return low / (high / low) ** 0.05, high * (high / low) ** 0.05
    return low - 0.05 * (high - low), high + 0.05 * (high - low)


def finish(panel, study, every):
    y, made = study.map.y, study.map
    if "x" in made.log:
        drawing.logarithmic(panel, "x")
    if y.log:
        drawing.logarithmic(panel, "y")
    panel.set_ylim(*limits(y))  # a curve of theory may leave the picture
    xs = sorted({column.x for column in every})
    if len(xs) <= 8:
        drawing.ticks(panel, xs, [f"{x:g}" for x in xs])
    axis = charts.axis_of(study, made.x_name)
    panel.set_xlabel(drawing.readable(axis.name, axis.unit))


def cells(study, table):
    """A map over two axes with listed values: a cell a run, coloured by its verdict."""
    made = study.map
    across, along, sheets = (charts.axis_of(study, name) for name in (made.x_name, made.y_name, made.edges))
    kinds = [kind for kind in verdicts.WORDS if any(row["verdict"] == kind for row in table.rows)]
    colours = matplotlib.colors.ListedColormap([LOOK[kind][1] for kind in kinds])
    names = [value.name for value in sheets.values] if sheets else [None]
    picture, panels = drawing.figure(len(names))
    for panel, name in zip(panels, names):
        panel.set_title("" if name is None else charts.value_text(name, sheets.unit))
        at = {(row[made.x_name], row[made.y_name]): row for row in table.rows if name is None or row[made.edges] == name}
        grid = [[kinds.index(at[a.name, b.name]["verdict"]) if (a.name, b.name) in at else math.nan for a in across.values]
                for b in along.values]
        panel.imshow(grid, origin="lower", aspect="auto", cmap=colours, vmin=-0.5, vmax=len(kinds) - 0.5, alpha=0.75)
        for j, b in enumerate(along.values):
            for i, a in enumerate(across.values):
                if (a.name, b.name) in at:
                    write_cell(panel, i, j, at[a.name, b.name], made.figure)
        panel.grid(False)
        drawing.choices(panel, [charts.value_text(v.name, "") for v in across.values])
        panel.set_yticks(range(len(along.values)), [charts.value_text(v.name, "") for v in along.values])
        panel.set_xlabel(drawing.readable(across.name, across.unit))
    panels[0].set_ylabel(drawing.readable(along.name, along.unit))
    handles = [panels[-1].plot([], [], "s", color=LOOK[kind][1], markersize=9)[0] for kind in kinds]
    panels[-1].legend(handles, kinds, loc="center left", bbox_to_anchor=(1.0, 0.5))
    return picture


def write_cell(panel, i, j, row, figure):
    value = row.get(figure, math.nan) if figure else math.nan
    text = f"{value:.3g}" if math.isfinite(value) else row["verdict"]
    if math.isfinite(row["detected_at"]) and row["detected_at"] > 0:
        text += f"\n{row['detected_at']:.3g} s"
    panel.text(i, j, text, ha="center", va="center", fontsize=8, color="white")
