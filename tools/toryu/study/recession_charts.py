"""Charts of surfaces that recede: the depth along each face over machining time, and what comes of it."""

import matplotlib
import matplotlib.colors
import numpy as np

from toryu.report import data
from toryu.study import drawing, recession_edges, removed_depth

SCALE = "viridis"


def draw(view, study, folder):
    drawn, shown = [], [chain for chain in view.shown() if len(chain.states()) > 1]
    for number, chain in enumerate(shown, 1):
        of = f": {chain.label}" if chain.label else ""
        parts = [("The shape over time", "shape", shape), ("The profile over time", "profile", profile),
                 ("Depth over time", "depth", over_time)]
        parts += [("Radius of the edges over time", "edge_radius", edge_radius)] * bool(chain.edges)
        parts += [("Roughness over time", "roughness", roughness)] * bool(chain.roughness_law)
        for title, name, make in parts:
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
    """Mean, largest and smallest depth."""
    return lines(view, chain, "removed depth", "depth_mean", {
        "mean": chain.surface.mean, "largest": np.max, "smallest": np.min})


def edge_radius(view, chain):
    return lines(view, chain, "edge radius", "edge_radius", {
        edge.name: lambda depth, edge=edge: recession_edges.radius(chain.surface, depth, edge) for edge in chain.edges})


def roughness(view, chain):
    """Mean, and that of the places from which most and least is off."""
    def ra(depth):
        return removed_depth.roughness(depth, chain.roughness_law)

    return lines(view, chain, "roughness Ra", "roughness", {
        "mean": chain.shape["roughness"], "largest": lambda depth: ra(np.min(depth)),
        "smallest": lambda depth: ra(np.max(depth))})


def lines(view, chain, what, goal, figures):
    """Figures of the depth over the cycles, with the goal of that name as a line."""
    states = [solved.state for solved in chain.states()]
    values = {name: np.array([float(of(state.depth)) for state in states]) for name, of in figures.items()}
    goals = [g.value for g in view.until if g.name == goal]
    factor, unit = data.scaled("m", max(np.nanmax([0.0, *v]) for v in values.values()))
    made, (panel,) = drawing.figure()
    times = [moment(view, state.time)[0] for state in states]
    for number, (name, of) in enumerate(values.items()):
        panel.plot(times, of * factor, marker=drawing.MARKERS[number % len(drawing.MARKERS)], label=name)
    for value in goals:
        panel.axhline(value * factor, color=drawing.PALETTE["soft"], linestyle="--", linewidth=0.9)
    panel.set_xlabel(moment(view, 0.0)[1])
    panel.set_ylabel(f"{what}  [{unit}]")
    panel.legend()
    return made
