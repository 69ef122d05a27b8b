"""What a study of surfaces that recede leaves: the shape over time as a file, and what is said of it."""

import csv

import numpy as np

from toryu.program import whole_file
from toryu.report import tables
from toryu.study import recession_edges, recession_goals
from toryu.study.answer import Answer
from toryu.study.removal_answer import in_words
from toryu.study.table import text


def write(path, view):
    """The shape over time, a row a point."""
    with whole_file(path) as file:
        writer = csv.writer(file)
        writer.writerow(["line", "solution", "machining_time[s]", "wall", "face", "position[m]", "depth[m]", "rate[m/s]",
                         "x[m]", "y[m]"])
        for chain in view.chains:
            for solved in chain.states():
                outline = chain.surface.outline(solved.state.depth)
                columns = map(chain.surface.parts, (solved.state.depth, solved.state.rate, *outline.T))
                for face, *values_of in zip(chain.surface.faces, *columns):
                    for values in zip(face.position, *values_of):
                        writer.writerow([chain.label, solved.name, text(solved.state.time), face.wall, face.side,
                                         *(f"{float(value):.9g}" for value in values)])


def answer(view, study, chain):
    first, last = chain.states()[0], chain.states()[-1]
    figures = last.figures()
    when = f"After {figures['machining_time']:.4g} s" + (f", {figures['cycles']:.4g} cycles," if view.cycle else "")
    sentence = (f"{when} {in_words(figures['depth_mean'], 'm')} are off on the mean and "
                f"{in_words(figures['depth_largest'], 'm')} at most, {figures['removed_area'] * 1e6:.4g} mm² in all; the "
                f"taper is {round(figures['taper'], 2) + 0.0:.2f} of the mean depth. It took {len(chain.solved)} solutions of "
                "the flow")
    began = first.mean_rate()
    sentence += f"; the rate has changed by {(last.mean_rate() / began - 1) * 100:+.1f} %." if began else ": nothing comes off."
    if chain.failure:
        sentence += f" There it ended: {chain.failure}"
    words = [sentence, *(recession_goals.sentence(goal, view, *chain.course(study, goal)) for goal in view.until)]
    rows = [[solved.name, *(text(value) for value in solved.figures().values())] for solved in chain.states()]
    headings = ["solution", *(f"{name} [{unit}]" if unit else name for name, unit in view.units().items())]
    html = tables.table(headings, rows) + faces(view, chain, last.state.depth) + edges(chain, last.state.depth)
    return Answer(f"The surface after wear{f': {chain.label}' if chain.label else ''}", "\n".join(words), html)


def faces(view, chain, depth):
    """What came off each face in the end."""
    surface, rows = chain.surface, []
    whole = float((depth * surface.length)[counts := view.counts(surface)].sum())
    for face, h, part in zip(surface.faces, surface.parts(depth), surface.parts(counts)):
        area = float((h * face.length)[part].sum())
        rows.append([face.wall, face.side, text(area / float(face.length[part].sum())), text(area),
                     text(area / whole if whole > 0 else 0.0)])
    return tables.table(["wall", "face", "depth_mean [m]", "removed_area [m2]", "share"], rows)


def edges(chain, depth):
    """The radius of each edge in the end."""
    rows = [[edge.name, text(float(recession_edges.radius(chain.surface, depth, edge)))] for edge in chain.edges]
    return tables.table(["edge", "edge_radius [m]"], rows) if np.size(rows) else ""
