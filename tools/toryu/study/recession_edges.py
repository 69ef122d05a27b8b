"""Edges at which two receding faces meet: the radius to which wear has rounded them.

Both faces are height profiles, and the body is what lies behind both. Its outline near the edge is held against two
straight flanks and an arc of radius R that touches both: R has the least sum of squares of the distances. The flanks are
lines through the outer half of the window about the edge, so R is at most half the window. Points stand a spacing apart:
of an arc of less than two spacings one or two of them tell."""

from dataclasses import dataclass

import numpy as np

from toryu.surface import SIDES

WINDOW = 40  # spacings to either side of an edge; less where a face is shorter: half of it
LEAST = 4  # points within it, without which there is no fit
ROUNDING = 1e-9
STEPS = 200  # of the search for R, before it is refined


@dataclass
class Edge:
    """Where two faces meet."""

    name: str
    faces: tuple[int, int]  # of Surface.faces
    corner: np.ndarray  # where they meet at the start [m]


def edges(surface):
    """All of them: at each stands a point that both faces have."""
    outlines, found = surface.parts(surface.outline(np.zeros(len(surface.place)))), []
    for j, g in enumerate(surface.faces):
        for i, f in enumerate(surface.faces[:j]):
            for row in np.intersect1d(f.rows, g.rows):
                corner = np.zeros(2)
                for face, line in ((f, outlines[i]), (g, outlines[j])):
                    corner[face.axis] = line[face.rows == row][0, face.axis]
                found.append(Edge(f"{f.wall}, {f.side} {g.side} edge", (i, j), corner))
    return found


def radius(surface, depth, edge):
    """Of the arc at the edge once `depth` [m] of each point is off [m]; nan if too few points stand there."""
    sides = [profile(surface, depth, edge, *pair) for pair in (edge.faces, edge.faces[::-1])]
    if min(len(s) for s, _, _ in sides) < LEAST:
        return np.nan
    points = []
    for (s, h, flank), (_, _, flank_other) in (sides, sides[::-1]):
        inward = np.column_stack([s - np.polyval(flank_other, h), h - np.polyval(flank, s)])
        points.append(inward[inward[:, 0] > -ROUNDING * s[-1]])  # others lie where the other face has been removed
    return fit(np.concatenate(points), min(s[-1] / 2 - max(flank[1], 0.0) for s, _, flank in sides))


def profile(surface, depth, edge, face, other):
    """Distance from the edge [m] of the points of `face` within the window, their depth [m], and the line through its outer
    half."""
    f, h = surface.faces[face], surface.parts(depth)[face]
    axis, sense = SIDES[surface.faces[other].side]
    s = sense * (edge.corner[axis] - f.position)
    spacing = float(np.median(f.length))
    near = np.flatnonzero(s < min(WINDOW * spacing, (s.max() + spacing) / 2))
    near = near[np.argsort(s[near])]
    s, h = s[near], h[near]
    outer = s > s[-1] / 2 if len(s) else []
    return s, h, np.polyfit(s[outer], h[outer], 1) if len(s) >= LEAST else None


def fit(points, largest):
    """The radius of the arc between the axes that the points, n x 2, lie nearest to; 0 where none is nearer than the
    sharp corner."""
    def misfit(arc):
        x, y = points.T
        on_arc = np.hypot(arc - x, arc - y) - arc
        flat = np.minimum(np.abs(x), np.abs(y))
        return float((np.where((x < arc) & (y < arc), on_arc, flat) ** 2).sum())

    arcs = np.linspace(0, largest, STEPS + 1)
    best = int(np.argmin([misfit(arc) for arc in arcs]))
    low, high = arcs[max(best - 1, 0)], arcs[min(best + 1, STEPS)]
    while high - low > 1e-6 * largest:
        inner = (2 * low + high) / 3, (low + 2 * high) / 3
        low, high = (low, inner[1]) if misfit(inner[0]) <= misfit(inner[1]) else (inner[0], high)
    return (low + high) / 2 if best > 0 or misfit((low + high) / 2) < misfit(0.0) else 0.0
