"""The faces of the work pieces that recede: their points in surface.h5, how fast each wears, and the shape as the case
takes it, `wall.N.worn`."""

from dataclasses import dataclass, field

import numpy as np

from toryu import counted, surface
from toryu.report import along
from toryu.study.removed_depth import law_of
from toryu.surface import SIDES

OF_PRESSURE = ("preston_depth", "archard_depth")
MIRROR_TOLERANCE = 0.1  # spacings by which mirror images may miss each other


class NoRate(Exception):
    """Why a run tells no rate of removal."""


@dataclass
class Face:
    """The points on one side of a work piece, in order along it."""

    wall: str
    side: str
    rows: np.ndarray  # in surface.h5
    position: np.ndarray  # along the face at the start [m]
    length: np.ndarray  # that each point has of it [m]

    @property
    def axis(self):
        return SIDES[self.side][0]


@dataclass
class Surface:
    """All faces that the medium touches, one after the other."""

    faces: list[Face]
    place: np.ndarray  # n x 2 [m], at the start
    normal: np.ndarray = field(default=None)  # n x 2, of the face
    about_axis: bool = False  # y is the distance from it

    @property
    def length(self):
        return np.concatenate([face.length for face in self.faces])

    @property
    def circumference(self):
        """Of the ring of each point at the start [m]; 1 in the plane, of which a slice of a metre counts."""
        if not self.about_axis:
            return np.ones(len(self.length))
        return 2 * np.pi * (self.place[:, 1] + self.normal[:, 1] * self.length / 2)

    def mean(self, values):
        return float(np.average(values, weights=self.length * self.circumference))

    def removed(self, depth):
        """What is off of each point at a depth [m], as the volume of its ring [m3], or the area in the plane [m2]."""
        return self.length * depth * (self.circumference - self.about_axis * np.pi * self.normal[:, 1] * depth)

    def parts(self, values):
        """Of each face."""
        return np.split(values, np.cumsum([len(face.rows) for face in self.faces])[:-1])

    def worn(self, depth, walls):
        """Overrides of the case for the depth [m] of each point; `walls`: names in the order of the case."""
        found = {}
        for face, part in zip(self.faces, self.parts(depth)):
            rows = [[float(s), max(float(h), 0.0)] for s, h in zip(face.position, part)]
            found.setdefault(f"wall.{walls.index(face.wall)}.worn", []).append({"face": face.side, "depth": rows})
        return found

    def outline(self, depth):
        """Where the surface is once `depth` [m] is off, n x 2 [m]: its points are half a cell behind it at the start."""
        return self.place + self.normal * (self.length / 2 - depth)[:, None]

    def diameters(self, depth, counts):
        """Of bores about an axis at their points among `counts` [m], where there are none of pins."""
        outward = self.normal[:, 1]
        across = (outward < 0 if (outward < 0).any() else outward > 0) & counts
        return 2 * self.outline(depth)[across, 1], self.length[across]
    def along_normal(self, rate, depth):
        """How fast the depth grows [m/s] where the surface recedes along its own normal at `rate`: by sqrt(1 + p^2) of it, p
        the slope towards a deeper neighbour (Godunov's upwind scheme, Osher & Sethian 1988)."""
        slopes = []
        for face, h in zip(self.faces, self.parts(depth)):
            steps = np.diff(h) / np.maximum(np.diff(face.position), 1e-300)
            slopes.append(np.maximum(np.append(steps, 0.0), np.append(0.0, -steps)).clip(0.0))
        return rate * np.sqrt(1 + np.concatenate(slopes) ** 2)

    def gap(self, depth, along):
        """The narrowest distance across the flow between two faces that look at each other [m]; None where none do."""
        outline, looks = self.outline(depth), self.normal[:, 1 - along]
        near = 0.5 * float(np.median(self.length))
        widths = []
        for place in outline[looks > 0.5]:
            opposite = outline[(looks < -0.5) & (np.abs(outline[:, along] - place[along]) < near), 1 - along]
            widths.extend(opposite[opposite > place[1 - along]] - place[1 - along])
        return float(min(widths)) if widths else None

    def middle(self, axis):
        return (self.place[:, axis].min() + self.place[:, axis].max()) / 2

    def first_half(self, axis):
        """Whether each point lies before the middle."""
        return self.place[:, axis] < self.middle(axis)

    def mirrored(self, values, axis):
        """The values at the mirror image of each point, about the middle of the surface along the axis."""
        sign = np.where(np.arange(2) == axis, -1.0, 1.0)
        middle = self.middle(axis)
        image = self.place * sign + np.where(np.arange(2) == axis, 2 * middle, 0.0)
        found = []
        for place, normal in zip(image, self.normal * sign):
            distance = np.linalg.norm(self.place - place, axis=1) + 1e9 * (np.abs(self.normal - normal).max(axis=1) > 0.1)
            found.append(int(np.argmin(distance)))
            if distance[found[-1]] > MIRROR_TOLERANCE * np.median(self.length):
                raise NoRate(f"the work pieces are not symmetric about {'xy'[axis]} = {middle:.6g} m: nothing is opposite of "
                             f"({', '.join(f'{x:.6g}' for x in 2 * middle * (sign < 0) + sign * place)}) m")
        return values[found]


def open_file(folder):
    file = along.read(folder)
    if file is None:
        raise NoRate(surface.NO_SURFACE)
    return file


def wetted(file):
    """The Surface of an open surface.h5: the sides of work pieces of which the medium has touched a point."""
    place, normal, area = file["start_position"][:], file["normal"][:], file["area"][:]
    touched = file["contact_pressure"][:].max(axis=0) > 0
    faces = []
    for index, wall in enumerate(surface.names(file)):
        for side, (axis, _) in SIDES.items():
            rows, position = surface.points_on(file, index, side)
            if touched[rows].any():
                faces.append(Face(wall, side, rows, position, area[rows] * np.abs(normal[rows, axis])))
    if not faces:
        raise NoRate("the medium touches no work piece")
    rows = np.concatenate([face.rows for face in faces])
    outward = [np.tile(np.where(np.arange(2) == SIDES[f.side][0], SIDES[f.side][1], 0.0), (len(f.rows), 1)) for f in faces]
    return Surface(faces, place[rows], np.concatenate(outward), "circumference" in file)


def same_points(first, file):
    """The rows of `first`, a Surface, in another file: the same points, in the same order along each face."""
    now = {(face.wall, face.side): face for face in wetted(file).faces}
    rows = []
    for face in first.faces:
        other = now.get((face.wall, face.side))
        if other is None or len(other.rows) != len(face.rows):
            raise NoRate(f"the {face.side} face of '{face.wall}' has {counted(len(other.rows) if other else 0, 'point')}, and had "
                         f"{len(face.rows)}")
        rows.append(other.rows)
    return np.concatenate(rows)


def depth_read_back(first, file):
    """By how much the points have moved inward since the start [m], as the solver put them."""
    moved = file["start_position"][:][same_points(first, file)] - first.place
    return -(moved * first.normal).sum(axis=1)


@dataclass
class Pressure:
    """What the medium's pressure is at places along the flow, where a case gives it but for a constant and a gradient that
    a body force stands for."""

    rows: list  # of place [m] and pressure [Pa]
    axis: int
    gap: float  # [m]

    def missing(self, place, found):
        """What the pressures `found` lack at each place [Pa]: linear between the rows. At a row itself the passage may end or
        bend, so it is a line through what is found about one gap to its sides that tells the pressure there."""
        x, lacks = place[:, self.axis], []
        for where, pressure in self.rows:
            near = np.flatnonzero((np.abs(x - where) >= 0.25 * self.gap) & (np.abs(x - where) <= 1.25 * self.gap))
            if len(set(x[near])) < 3:
                raise NoRate(f"'pressure' has a row at {where:g} m, and no three points of the surface lie near it")
            lacks.append(pressure - np.polynomial.polynomial.polyfit(x[near] - where, found[near], 1)[0])
        return np.interp(x, [row[0] for row in self.rows], lacks)


def coefficient(file, law):
    """Depth over pressure times path [1/Pa]."""
    if law not in OF_PRESSURE:
        raise NoRate(f"'pressure' needs a law of pressure times speed, and {law} is none")
    whole = file["sliding_pressure"][:][-1].sum()
    return file[law][:][-1].sum() / whole if whole > 0 else 0.0


def rates(first, file, window, pressure=None):
    """Mean rate of removal [m/s] of each point within `window`, two shares of the run's time, and the relative change of
    the mean between its halves. `pressure`: a Pressure, where the contact pressure of the run is not the medium's."""
    rows = same_points(first, file)
    law = law_of(file)
    if law is None:
        raise NoRate("[fluid.removal] has no law: give a preston_coefficient, a shear_coefficient or [fluid.removal.archard]")
    time, depth = file["time"][:], file[law][:][:, rows]
    if len(time) < 3:
        raise NoRate("its surface.h5 has fewer than three rows: give a smaller 'series_interval'")
    ends = [int(np.argmin(np.abs(time - share * time[-1]))) for share in (window[0], sum(window) / 2, window[1])]
    if len(set(ends)) < 3:
        raise NoRate("'shares' holds fewer than three rows of its surface.h5: give a smaller 'series_interval'")
    if pressure:
        path = np.cumsum(file["sliding_speed"][:][:, rows] * np.diff(time, prepend=0.0)[:, None], axis=0)
        found = file["contact_pressure"][:][ends[0] + 1:ends[2] + 1][:, rows].mean(axis=0)
        depth = depth + coefficient(file, law) * pressure.missing(file["start_position"][:][rows], found) * path
    early, late = ((depth[b] - depth[a]) / (time[b] - time[a]) for a, b in zip(ends, ends[1:]))
    whole = (depth[ends[2]] - depth[ends[0]]) / (time[ends[2]] - time[ends[0]])
    mean = first.mean(whole)
    return whole, abs(first.mean(late - early) / mean) if mean else 0.0
