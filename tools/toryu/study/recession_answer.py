"""What a study of surfaces that recede says at its end: sentences and tables for each line, the shapes as a file, and how
uncertain they are by a calibration."""

import csv
import math
from functools import partial

import numpy as np

from toryu.program import whole_file
from toryu.report import tables
from toryu.study import calibrated, recession_edges, recession_goals
from toryu.study.answer import Answer
from toryu.study.recession_search import shape_figures
from toryu.study.removal_answer import in_words
from toryu.study.table import text


def uncertain(view):
    """The figures of which a calibration tells the error."""
    return ["depth_mean", view.removed, "removed_mass"] + ["diameter_mean"] * view.about_axis


def uncertainty(view, chain):
    """Standard errors of the figures of a line's last shape."""
    def figure(depth, name):
        return shape_figures(chain.surface, depth, view).get(name, math.nan)

    return {f"{name}_error": float(error_of(view, chain, partial(figure, name=name))) for name in uncertain(view)}


def error_of(view, chain, figure):
    """Standard error of `figure(depth)` of a line's last shape, to first order."""
    last = chain.states()[-1].state
    near = {name: figure(other.states()[-1].state.depth) for name, other in neighbours(view, chain).items()}

    def move(p):
        if not p.law:
            return calibrated.half_difference(near, p)
        # dh/dt = k f(h): with a larger k it is further on in time
        more = p.relative_error * (p.law == chain.law) * last.time * last.rate
        return (figure(last.depth + more) - figure(last.depth - more)) / 2

    return view.calibrated.error_of(figure(last.depth), move)


def neighbours(view, chain):
    """Value of the calibration's axis -> the line there, of those that went as far."""
    end = chain.states()[-1].state.time
    return {other.calibration: other for other in view.chains if other.line == chain.line
            and other.states() and abs(other.states()[-1].state.time - end) < 1e-9 * end}


def write(view, path):
    """The shape over time, a row a point."""
    with whole_file(path) as file:
        writer = csv.writer(file)
        errors = ["depth_error[m]"] if view.calibrated else []
        writer.writerow(["line", "solution", "machining_time[s]", "wall", "face", "position[m]", "depth[m]", "rate[m/s]",
                         "x[m]", "y[m]", *errors])
        for chain in view.shown():
            for solved in chain.states():
                write_shape(writer, view, chain, solved)


def write_shape(writer, view, chain, solved):
    """The error is that of the last shape alone."""
    surface, state = chain.surface, solved.state
    values = [state.depth, state.rate, *surface.outline(state.depth).T]
    if view.calibrated:
        is_last = solved is chain.states()[-1]
        values.append(error_of(view, chain, np.asarray) if is_last else np.full(len(state.depth), np.nan))
    for face, *of_face in zip(surface.faces, *map(surface.parts, values)):
        for row in zip(face.position, *of_face):
            writer.writerow([chain.label, solved.name, text(state.time), face.wall, face.side,
                             *("" if value != value else f"{float(value):.9g}" for value in row)])


def answer(view, study, chain):
    first, last = chain.states()[0], chain.states()[-1]
    figures = last.figures()
    errors = uncertainty(view, chain) if view.calibrated else {}
    when = f"After {figures['machining_time']:.4g} s" + (f", {figures['cycles']:.4g} cycles," if view.cycle else "")
    sentence = (f"{when} {with_error('depth_mean', 'm', figures, errors)} are off on the mean and "
                f"{in_words(figures['depth_largest'], 'm')} at most, {what_is_off(view, figures, errors)} in all; the "
                f"taper is {round(figures['taper'], 2) + 0.0:.2f} of the mean depth.{diameter(figures, errors)} It took "
                f"{len(chain.solved)} solutions of the flow")
    began = first.mean_rate()
    sentence += f"; the rate has changed by {(last.mean_rate() / began - 1) * 100:+.1f} %." if began else ": nothing comes off."
    if errors:
        sentence += " ±: one standard error by what the calibration leaves open."
    if chain.failure:
        sentence += f" There it ended: {chain.failure}"
    words = [sentence, *(recession_goals.sentence(goal, view, *chain.course(study, goal)) for goal in view.until)]
    names = [name for name in view.units() if not name.endswith("_error") or name in figures]
    rows = [[solved.name, *(text(solved.figures()[name]) for name in names)] for solved in chain.states()]
    html = tables.table(["solution", *(f"{n} [{u}]" if (u := view.units()[n]) else n for n in names)], rows)
    return Answer(f"The surface after wear{f': {chain.label}' if chain.label else ''}", "\n".join(words),
                  html + faces(view, chain, last.state.depth) + edges(chain, last.state.depth))


def faces(view, chain, depth):
    """What came off each face in the end."""
    surface, rows, counts = chain.surface, [], view.counts(chain.surface)
    removed, weight = surface.removed(depth) * counts, surface.length * surface.circumference * counts
    for face, *of_face in zip(surface.faces, *map(surface.parts, (depth * weight, weight, removed))):
        deep, ring, off = (float(part.sum()) for part in of_face)
        rows.append([face.wall, face.side, text(deep / ring if ring > 0 else 0.0), text(off),
                     text(off / float(removed.sum()) if removed.sum() > 0 else 0.0)])
    return tables.table(["wall", "face", "depth_mean [m]", f"{view.removed} [{view.units()[view.removed]}]", "share"], rows)


def edges(chain, depth):
    """The radius of each edge in the end."""
    rows = [[edge.name, text(float(recession_edges.radius(chain.surface, depth, edge)))] for edge in chain.edges]
    return tables.table(["edge", "edge_radius [m]"], rows) if rows else ""


def what_is_off(view, figures, errors):
    scale, unit = (1e9, "mm³") if view.about_axis else (1e6, "mm²")
    words = f"{figures[view.removed] * scale:.4g} {unit}"
    if errors:
        words += f" ± {errors[f'{view.removed}_error'] * scale:.2g} {unit}"
    if view.density:
        unit = "g" if view.about_axis else "g/m"
        words += f" or {figures['removed_mass'] * 1e3:.4g} {unit}"
    return words


def diameter(figures, errors):
    if "diameter_mean" not in figures:
        return ""
    mean, least, most = (f"{figures[f'diameter_{name}'] * 1e3:.4g}" for name in ("mean", "smallest", "largest"))
    error = f" ± {errors['diameter_mean_error'] * 1e3:.2g}" if errors else ""
    return f" The diameter is {mean}{error} mm on the mean, from {least} to {most} mm."


def with_error(name, unit, figures, errors):
    error = f" ± {in_words(errors[f'{name}_error'], unit)}" if errors else ""
    return in_words(figures[name], unit) + error
