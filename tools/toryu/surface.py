"""The surface of the work pieces as contours: `surface.h5` keeps its points in no order, here each follows its
neighbour along the work piece, with the arc length [m] between."""

from dataclasses import dataclass

import numpy as np

SIDES = {"left": (0, -1.0), "right": (0, 1.0), "lower": (1, -1.0), "upper": (1, 1.0)}  # axis and sense of the normal
LEAST_NORMAL = 0.5  # a point with more of its normal along a side belongs to it: one of an edge to both
NO_SURFACE = "it left no surface.h5: the case needs [fluid.removal] and a [[wall]] with 'work_piece = true'"
REACH = 2.5  # spacings within which a contour goes on: past a corner whose particle has no face, across no gap
TURN = 0.8  # how much farther a neighbour seems that lies off the way the contour goes: the next face at a corner


@dataclass
class Contour:
    """One connected line of surface points, in the undeformed state."""

    work_piece: str
    label: str  # the work piece's name, numbered from left to right if it has several contours
    rows: np.ndarray  # of the points in surface.h5: preston_depth[:, rows] runs along the contour
    arc_length: np.ndarray  # [m] from the first point
    position: np.ndarray  # n x 2 [m], of the particles: the surface itself lies half a spacing outward
    normal: np.ndarray  # n x 2, outward, of unit length
    area: np.ndarray  # [m per metre depth]
    spacing: float  # [m], the typical distance of neighbours
    closed: bool

    @property
    def corners(self):
        """Indices along the contour where it turns by more than 30 degrees, each the middle of its turn."""
        sharp = (self.normal[1:] * self.normal[:-1]).sum(axis=1) < np.cos(np.pi / 6)
        starts = np.flatnonzero(np.diff(np.concatenate([[0], sharp, [0]])))
        return [int(first + last) // 2 for first, last in zip(starts[::2], starts[1::2])]


def points_on(surface, work_piece, side):
    """Rows of an open surface.h5 on one side of the work piece of that number, in order along it, and where they lie along
    it [m] at the start."""
    axis, sense = SIDES[side]
    rows = np.flatnonzero((surface["work_piece"][:] == work_piece) & (surface["area"][:] > 0)
                          & (sense * surface["normal"][:][:, axis] > LEAST_NORMAL))
    position = surface["start_position"][:][rows, 1 - axis]
    order = np.argsort(position, kind="stable")
    return rows[order], position[order]


def check(surface):
    """Raises ValueError if the arrays of an open surface.h5 do not belong together; what cannot be read raises too."""
    points = len(surface["area"][:])
    shapes = {"time": (len(surface["time"]),), "start_position": (points, 2), "normal": (points, 2),
              "area": (points,), "circumference": (points,), "work_piece": (points,)}
    names(surface)
    for name, values in surface.items():
        shape = shapes.get(name, (len(surface["time"]), points))
        if values.shape[:len(shape)] != shape or values.dtype.kind not in "fiu":
            raise ValueError(f"'{name}' is of another size or kind")
        values[:]


def contours(surface):
    """Contours of all work pieces of `surface`, an open surface.h5, longest first for each work piece. An open one
    starts at its lower end (left, if both are level), a closed one at its lowest point, anticlockwise. Points
    without a face (area 0) are on none."""
    position, area = surface["start_position"][:], surface["area"][:]
    normal, owner = surface["normal"][:], surface["work_piece"][:]
    found = []
    for index, name in enumerate(names(surface)):
        rows = np.flatnonzero((owner == index) & (area > 0))
        spacing = typical_spacing(position[rows], area[rows])
        chains = [(rows[chain], closed) for chain, closed in ordered(position[rows], normal[rows], spacing)]
        places = sorted(range(len(chains)), key=lambda k: tuple(position[chains[k][0]].mean(axis=0)))
        for k, (chain, closed) in sorted(enumerate(chains), key=lambda item: -len(item[1][0])):
            label = f"{name} {places.index(k) + 1}" if len(chains) > 1 else name
            steps = np.linalg.norm(np.diff(position[chain], axis=0), axis=1)
            found.append(Contour(name, label, chain, np.concatenate([[0], np.cumsum(steps)]), position[chain],
                                 normal[chain], area[chain], spacing, closed))
    return found


def names(surface):
    """Names of the work pieces, in the order of their index."""
    text = surface["work_piece"].attrs["names"]
    return (text.decode() if isinstance(text, bytes) else str(text)).split(";")


def typical_spacing(points, area):
    """Median distance [m] to the nearest other point; of a point alone its face."""
    if len(points) < 2:
        return float(area.sum())
    distance = np.linalg.norm(points[:, None] - points, axis=2)
    np.fill_diagonal(distance, np.inf)
    return float(np.median(distance.min(axis=1))) or float(np.median(area))


def ordered(points, normals, spacing):
    """Chains of indices and whether each is closed. A point's next one lies ahead, anticlockwise around the body,
    where `normals` point outward; the nearest pairs join first, each point to at most one on either side."""
    before, after = {}, {}
    for i, j in candidates(points, normals, spacing):
        if i not in after and j not in before:
            after[i], before[j] = j, i
    return [directed(chain, closed, points) for chain, closed in chains_of(before, after, len(points))]


def candidates(points, normals, spacing):
    """Pairs (i, j) of which j may follow i, the most fitting first."""
    tangent = np.column_stack([-normals[:, 1], normals[:, 0]])
    step = points[None, :] - points[:, None]
    distance = np.linalg.norm(step, axis=2)
    way = tangent[:, None] + tangent[None, :]  # nothing between opposite faces of a thin body
    length = np.maximum(np.linalg.norm(way, axis=2), 1e-12)
    ahead = (step * way).sum(axis=2) / np.maximum(distance * length, 1e-300)
    fits = (distance > 0) & (distance < REACH * spacing) & (ahead > 0.3) & (length > 0.3)
    i, j = np.nonzero(fits)
    cost = distance[i, j] * (1 + TURN * (1 - ahead[i, j]))
    order = np.argsort(cost, kind="stable")
    return zip(i[order].tolist(), j[order].tolist())


def chains_of(before, after, count):
    """Open chains from their first point, then closed ones."""
    seen = set()
    firsts = [i for i in range(count) if i not in before]
    for first in [*firsts, *range(count)]:
        if first in seen:
            continue
        chain = [first]
        while (following := after.get(chain[-1])) is not None and following != first:
            chain.append(following)
        seen.update(chain)
        yield chain, after.get(chain[-1]) == first


def directed(chain, closed, points):
    chain = np.array(chain)
    if closed:
        return np.roll(chain, -int(np.lexsort((points[chain, 0], points[chain, 1]))[0])), True
    ends = [tuple(points[i][::-1]) for i in (chain[0], chain[-1])]
    return (chain if ends[0] <= ends[1] else chain[::-1]), False
