"""Charts of what comes off: depth along the work pieces, and the window of time, evenness and pressure."""

import math

import matplotlib.colors
import numpy as np

from toryu.report import data
from toryu.study import drawing, page
from toryu.study.removal_answer import ranked
from toryu.study.table import readable_size

NAMED = 3  # settings drawn in colour, the others in grey


def draw(view, study, table, folder):
    rows = [row for row in table.rows if row["record"].folder.name in view.runs]
    if not rows:
        return []
    best = ranked(view.wanted, table) if view.wanted else sorted(rows, key=lambda row: row["evenness"])
    drawn = [(f"Removed depth along the work pieces {'when the wanted depth is reached' if view.wanted else 'a cycle'}",
              drawing.save(along(view, study, rows, best), folder / "removed_depth"), "charts/removed_depth")]
    if view.wanted and best:
        drawn.append(("What each setting needs for the wanted depth", drawing.save(window(view.wanted, study, best),
                                                                                    folder / "window"), "charts/window"))
    return drawn


def label(study, row):
    return page.setting_text(study, row).replace(", ", "\n")


def depth_of(view, row):
    removed = view.runs[row["record"].folder.name]
    if not view.wanted:
        return removed, removed.a_cycle()
    return removed, removed.after(row["cycles_needed"]) if "cycles_needed" in row else None


def along(view, study, rows, best):
    """A panel a contour; the best settings in colour."""
    contours = view.runs[rows[0]["record"].folder.name].contours
    curves = [(row, *depth_of(view, row)) for row in rows]
    curves = [(row, removed, depth) for row, removed, depth in curves if depth is not None]
    factor, unit = data.scaled("m", max((float(depth.max()) for _, _, depth in curves), default=0))
    made, axes = drawing.figure(len(contours))
    rank = {row["record"].folder.name: i for i, row in enumerate(best)}
    for row, removed, depth in sorted(curves, key=lambda curve: -rank.get(curve[0]["record"].folder.name, 99)):
        start, run = 0, row["record"].folder.name
        place = rank.get(run, NAMED)
        for panel, contour in zip(axes, removed.contours):
            part = depth[start:start + len(contour.rows)]
            if place < NAMED and (error := view.errors.get(run)) is not None:  # one standard error of the calibration
                error = error[start:start + len(contour.rows)]
                panel.fill_between(contour.arc_length * 1e3, (part - error) * factor, (part + error) * factor,
                                   color=drawing.LINES[place], alpha=0.2, linewidth=0)
            start += len(contour.rows)
            panel.plot(contour.arc_length * 1e3, part * factor, gid=f"run-{run}",
                       **({"color": drawing.LINES[place], "label": label(study, row), "zorder": 3} if place < NAMED else
                          {"color": drawing.PALETTE["wall"], "linewidth": 0.9}))
    for panel, contour in zip(axes, contours):
        panel.set_title(contour.label.replace("_", " "))
        panel.set_xlabel("along the surface  [mm]")
        panel.set_ylim(bottom=0)
        for corner in contour.corners:
            panel.axvline(contour.arc_length[corner] * 1e3, color=drawing.PALETTE["soft"], linewidth=0.8, linestyle=":")
    axes[0].set_ylabel(f"removed depth  [{unit}]")
    if view.wanted:
        for panel in axes:
            panel.axhline(view.wanted.depth * factor, color=drawing.PALETTE["soft"], linewidth=0.8, linestyle="--")
    handles, labels = axes[0].get_legend_handles_labels()
    axes[-1].legend(handles[::-1], labels[::-1], title="the best, in order", alignment="left", loc="center left",
                    bbox_to_anchor=(1.0, 0.5), labelspacing=0.9)
    return made


def window(wanted, study, best):
    """Every setting by time and evenness; colour is the pressure."""
    made, (panel,) = drawing.figure()
    pressures = [row["piston_pressure"] for row in best]
    factor, unit = readable_size("Pa", pressures)
    scale = matplotlib.colors.Normalize(factor * np.nanmin(pressures), factor * np.nanmax(pressures))
    for row in best:
        mark = panel.scatter([row["time_needed"]], [row["evenness_then"]], c=[row["piston_pressure"] * factor],
                             norm=scale, cmap="viridis", s=46, marker="o" if wanted.met(row) else "X",
                             edgecolors=drawing.PALETTE["ink"], linewidths=0.6, zorder=3)
        mark.set_gid(f"run-{row['record'].folder.name}")
    drawing.logarithmic(panel, "x")
    panel.set_xlabel("time until the wanted depth is reached  [s]")
    panel.set_ylabel("largest depth over mean")
    if math.isfinite(wanted.evenness_at_most):
        panel.axhline(wanted.evenness_at_most, color=drawing.PALETTE["soft"], linestyle="--", linewidth=0.9)
    if wanted.met(best[0]):
        panel.annotate(label(study, best[0]), (best[0]["time_needed"], best[0]["evenness_then"]), xytext=(0.04, 0.94),
                       textcoords="axes fraction", va="top", fontsize=8.5, color=drawing.PALETTE["ink"],
                       arrowprops={"arrowstyle": "-", "color": drawing.PALETTE["soft"], "linewidth": 0.8})
    if not all(map(wanted.met, best)):
        panel.set_title(f"×: beyond the limits ({wanted.limits()})", fontsize=9)
    made.colorbar(mark, ax=panel, label=drawing.readable("pressure at the piston", unit))
    return made
