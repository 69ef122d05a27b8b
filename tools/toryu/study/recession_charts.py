"""Charts of surfaces that recede: the depth along each face over machining time, and what comes of it."""

import math

import matplotlib
import matplotlib.colors
import numpy as np

from toryu.report import data
from toryu.study import drawing

SCALE = "viridis"


def draw(view, study, folder):
    drawn, shown = [], [chain for chain in view.shown() if len(chain.states()) > 1]
    for number, chain in enumerate(shown, 1):
        of = f": {chain.label}" if chain.label else ""
        for title, name, make in (("The shape over time", "shape", shape), ("The profile over time", "profile", profile),
                                  ("Depth over time", "depth", over_time)):
            name = name if len(view.shown()) == 1 else f"{name}_{number:02}"
            drawn.append((title + of, drawing.save(make(view, chain), folder / name), f"charts/{name}"))
    return drawn


def moment(view, time):
    """A machining time as the charts count it, and what it is called."""
    return (time / view.cycle, "cycles") if view.cycle else (time, "machining time  [s]")


def shape(view, chain):
    """A panel a face: the removed depth along it at the end of each jump, by colour."""
    states = [solved.state for solved in chain.states()]
    deepest = max(float(state.depth.max()) for state in states)
    factor, unit = data.scaled("m", deepest)
    made, panels = drawing.figure(len(chain.surface.faces))
    counts = chain.surface.parts(view.counts(chain.surface))
    colours, scale = by_time(view, states)
    for state, colour in zip(states, colours):
        for panel, face, part, depth in zip(panels, chain.surface.faces, counts, chain.surface.parts(state.depth)):
            panel.plot(face.position[part] * 1e3, depth[part] * factor, color=colour, linewidth=1.2)
    for panel, face in zip(panels, chain.surface.faces):
        panel.set_title(f"{face.wall.replace('_', ' ')}, {face.side} face")
        panel.set_xlabel(f"{'yx'[face.axis]}  [mm]")
    panels[0].set_ylabel(f"removed depth  [{unit}]")
    panels[0].set_ylim(bottom=0)
    made.colorbar(scale, ax=panels, label=moment(view, 0.0)[1])
    return made


def by_time(view, states):
    """A colour for each state, and the scale of them."""
    times = [moment(view, state.time)[0] for state in states]
    scale = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(0, max(times)), matplotlib.colormaps[SCALE].reversed())
    return scale.to_rgba(times), scale


def profile(view, chain):
    """The faces where they are at the end of each jump, by colour; the height is stretched."""
    states, counts = [solved.state for solved in chain.states()], chain.surface.parts(view.counts(chain.surface))
    made, (panel,) = drawing.figure()
    colours, scale = by_time(view, states)
    for state, colour in zip(states, colours):
        outline = chain.surface.outline(state.depth) * 1e3
        for part, x, y in zip(counts, *map(chain.surface.parts, outline.T)):
            panel.plot(x[part], y[part], color=colour, linewidth=1.2)
    panel.set_xlabel("x  [mm]")
    panel.set_ylabel("y  [mm]")
    made.colorbar(scale, ax=panel, label=moment(view, 0.0)[1])
    return made


def over_time(view, chain):
    """Mean, largest and smallest depth; where a target is set, the line."""
    states = [solved.state for solved in chain.states()]
    depths = np.array([[chain.surface.mean(s.depth), s.depth.max(), s.depth.min()] for s in states])
    factor, unit = data.scaled("m", float(depths.max()))
    made, (panel,) = drawing.figure()
    times = [moment(view, state.time)[0] for state in states]
    for column, name, marker in zip(depths.T, ("mean", "largest", "smallest"), drawing.MARKERS):
        panel.plot(times, column * factor, marker=marker, label=name)
    if math.isfinite(view.target):
        panel.axhline(view.target * factor, color=drawing.PALETTE["soft"], linestyle="--", linewidth=0.9)
    panel.set_xlabel(moment(view, 0.0)[1])
    panel.set_ylabel(f"removed depth  [{unit}]")
    panel.legend()
    return made
