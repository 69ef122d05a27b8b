"""Frames for the page: positions and fields as 16-bit codes, compressed, in as many frames as fit the size limit."""

import base64
import contextlib
import zlib
from dataclasses import dataclass

import h5py
import numpy as np

from toryu import results
from toryu.report import data

SIZE_LIMIT = 12e6  # bytes of all frames of all bodies in the page
SHARE_LEFT = 0.7  # what compression typically leaves of the codes
NOT_SHOWN = {"particle"}  # a name, not a quantity
NO_VALUE = 65535  # code of what is not finite; values take 0 to 65534
SAMPLED_FRAMES = 12  # enough to find the range of a field
OUTERMOST = 1.0  # per cent of the values, at either end, that do not count for it: shocks, corners


@dataclass
class Quantity:
    """A scalar to colour by, taken from a field of the frames."""

    label: str
    unit: str
    field: str
    component: int | None  # None: the field itself, -1: its magnitude
    low: float = 0.0
    high: float = 1.0

    @property
    def signed(self):
        """Whether the values are of either sign, so that the colours must show where they are zero."""
        return self.low < 0 < self.high and min(-self.low, self.high) > 0.1 * max(-self.low, self.high)

    @property
    def span(self):
        """The range of the colours."""
        largest = max(-self.low, self.high)
        return (-largest, largest) if self.signed else (self.low, self.high)

    def described(self):
        """Range and unit for the page, with a prefix: kPa."""
        factor, unit = data.scaled(self.unit, max(abs(self.low), abs(self.high)))
        return {"label": self.label, "unit": unit, "low": self.low * factor, "high": self.high * factor, "signed": self.signed}

    def values(self, point_data):
        field = point_data[self.field][:]
        if self.component is None:
            return field
        return np.linalg.norm(field, axis=1) if self.component == -1 else field[:, self.component]


class Body:
    """The frames of one participant, but for those that are damaged."""

    def __init__(self, out, name, faults=None, newest=False):
        self.name = name
        self.count = 0
        self.typical_displacement = 0.0  # [m], of 95 % of the particles, at the time when it is largest
        files = results.list_frames(out, name, faults)[-1 if newest else 0:]
        self.quantities = quantities_of_most(sampled([path for _, path in files]))
        self.files = [(time, path) for time, path in files if self.takes(path, faults)]

    def takes(self, path, faults):
        """Whether all that is drawn can be read from the frame."""
        try:
            with h5py.File(path) as file:
                points, fields = file["VTKHDF/Points"][:], file["VTKHDF/PointData"]
                shapes = [np.isfinite(points[:, :2]).shape, *(np.isfinite(q.values(fields)).shape for q in self.quantities)]
            if shapes[0][1] != 2 or any(shape != (len(points),) for shape in shapes[1:]):
                raise ValueError("its fields are of unequal sizes")
        except results.DAMAGED as error:
            results.note(faults, path, f"cannot be read: {error}")
            return False
        self.count = self.count or len(points)
        return len(points) > 0

    def bytes_per_frame(self):
        return self.count * (4 + 2 * len(self.quantities)) * SHARE_LEFT * 4 / 3


def read_bodies(out, faults=None, newest=False):
    """The bodies that left frames, with all of them or the `newest` alone."""
    names = [path.name.removesuffix(".hdf.series") for path in sorted(out.glob("*.hdf.series"))]
    names = [name for name in names if name != "walls"]  # drawn as they are, not as particles
    bodies = [Body(out, name, faults, newest) for name in names]
    return [body for body in bodies if body.files]


def quantities(point_data):
    """What can be drawn of the fields: scalars, magnitudes of vectors, components of tensors."""
    found = []
    for name, values in point_data.items():
        if name in NOT_SHOWN:
            continue
        unit = values.attrs.get("unit", b"").decode()
        label = name.replace("_", " ")
        if values.ndim == 1:
            found.append(Quantity(label, unit, name, None))
        elif values.shape[1] == 3:
            found.append(Quantity("speed" if name == "velocity" else label, unit, name, -1))
            if name == "displacement":
                found += [Quantity(f"{label} {axis}", unit, name, i) for i, axis in enumerate("xy")]
        else:
            parts = {4: ("xx", "xy", None, "yy")}.get(values.shape[1], ())
            found += [Quantity(f"{label} {part}", unit, name, i) for i, part in enumerate(parts) if part]
    first = ("von mises", "pressure", "stress", "speed")  # the page opens with the first that is there
    return sorted(found, key=lambda q: next((i for i, word in enumerate(first) if word in q.label.lower()), 9))


def quantities_of_most(paths):
    """What can be drawn of most of the frames: one that is damaged may still be read, and hold less."""
    found = {}
    for path in paths:
        with contextlib.suppress(*results.DAMAGED), h5py.File(path) as file:
            present = quantities(file["VTKHDF/PointData"])
            found.setdefault(tuple((q.field, q.component) for q in present), []).append(present)
    return max(found.values(), key=lambda alike: (len(alike), len(alike[0])), default=[[]])[0]


def sampled(values):
    return [values[i] for i in np.unique(np.linspace(0, len(values) - 1, SAMPLED_FRAMES).round().astype(int))] if values else []


def chosen_frames(bodies):
    """Every k-th frame, k the smallest that keeps the size limit; the last one always."""
    size = sum(len(body.files) * body.bytes_per_frame() for body in bodies)
    step = max(1, int(np.ceil(size / SIZE_LIMIT)))
    for body in bodies:
        body.files = body.files[:-1:step] + body.files[-1:]
    return step


def finite_box(points):
    points = points[np.isfinite(points).all(axis=1)]
    return (points.min(axis=0), points.max(axis=0)) if len(points) else None


def measure(body, domain):
    """Sets the ranges of the quantities (of the values of some frames, without the outermost) and returns the
    smallest box that holds all particles inside `domain` ((x, y) min, (x, y) max)."""
    chosen = sampled(range(len(body.files)))
    samples = [[] for _ in body.quantities]
    boxes = []
    for i, (_, path) in enumerate(body.files):
        with h5py.File(path) as file:
            boxes.append(finite_box(file["VTKHDF/Points"][:, :2]))
            for sample, quantity in zip(samples, body.quantities):
                if i in chosen or quantity.field == "displacement":
                    sample.append(quantity.values(file["VTKHDF/PointData"]))
    for sample, quantity in zip(samples, body.quantities):
        if quantity.field == "displacement" and quantity.component == -1:
            finite = [values[np.isfinite(values)] for values in sample]
            body.typical_displacement = max((float(np.percentile(v, 95)) for v in finite if len(v)), default=0.0)
        values = np.concatenate(sample)
        values = values[np.isfinite(values)]
        if len(values):
            # Components of the displacement are drawn as such, too: none may be cut off.
            outermost = 0 if quantity.field == "displacement" and quantity.component != -1 else OUTERMOST
            quantity.low, quantity.high = (float(v) for v in np.percentile(values, [outermost, 100 - outermost]))
        if quantity.high <= quantity.low:
            quantity.high = quantity.low + (abs(quantity.low) * 1e-3 or 1.0)
    boxes = [box for box in boxes if box] or [domain]
    low = np.maximum(np.min([b[0] for b in boxes], axis=0), domain[0])
    return low, np.maximum(np.minimum(np.max([b[1] for b in boxes], axis=0), domain[1]), low + 1e-9)


def codes(values, low, high):
    share = np.clip((values - low) / (high - low), 0, 1)
    return np.where(np.isfinite(values), np.round(np.nan_to_num(share) * (NO_VALUE - 1)), NO_VALUE).astype("<u2")


def encode(path, body, box):
    """One frame: codes of x, y, then of each quantity."""
    with h5py.File(path) as file:
        points = file["VTKHDF/Points"][:, :2]
        outside = (points < box[0] - 1e-12).any(axis=1) | (points > box[1] + 1e-12).any(axis=1)
        columns = [codes(points[:, axis], box[0][axis], box[1][axis]) for axis in range(2)]
        columns[0][outside] = NO_VALUE  # not drawn
        columns += [codes(q.values(file["VTKHDF/PointData"]), q.low, q.high) for q in body.quantities]
    return packed(columns)


def packed(columns):
    """Columns of codes as text: all low bytes before all high bytes, which compresses better; zlib, base64."""
    planes = np.concatenate(columns).view(np.uint8).reshape(-1, 2).T
    return base64.b64encode(zlib.compress(np.ascontiguousarray(planes).tobytes(), 6)).decode()


def spacing(case, body):
    """Typical distance of neighbours [m], as the case says, else the side of the square that a particle fills, if they
    filled their box."""
    told = data.table(case, body.name).get("spacing")
    if data.is_number(told) and told > 0:
        return told
    with h5py.File(body.files[0][1]) as file:
        points = file["VTKHDF/Points"][:, :2]
    box = finite_box(points)
    return float(np.sqrt(np.prod(np.maximum(box[1] - box[0], 1e-9)) / len(points))) if box else 1.0


def displacement_of(body):
    """Which columns of a frame are the displacement, and their values of codes 0 and NO_VALUE - 1 in metres."""
    found = [(2 + k, q) for k, q in enumerate(body.quantities) if q.field == "displacement" and q.component in (0, 1)]
    return {"columns": [k for k, _ in found], "low": [q.low for _, q in found], "high": [q.high for _, q in found],
            "typical": body.typical_displacement} if found else None


def start_of(bodies, name):
    """Undeformed positions of a participant's particles, None without frames or displacement."""
    body = next((body for body in bodies if body.name == name), None)
    if body is None or not any(q.field == "displacement" for q in body.quantities):
        return None
    with h5py.File(body.files[0][1]) as file:
        points = file["VTKHDF/Points"][:, :2]
        return points - file["VTKHDF/PointData/displacement"][:, :2]


def domain_of(case):
    """((x, y) min, (x, y) max) of the domain, boundless if the case has none."""
    domain = data.box_of(data.table(data.table(case, "case"), "domain")) or [-1e9, -1e9, 1e9, 1e9]
    return np.array(domain[:2]), np.array(domain[2:])


def collect(bodies, case):
    """All that the page's player needs: (bodies, view box, every how many frames)."""
    step = chosen_frames(bodies) if bodies else 1
    boxes = [measure(body, domain_of(case)) for body in bodies]
    return [content_of(body, box, case) for body, box in zip(bodies, boxes)], boxes, step


def content_of(body, box, case):
    """What the player needs of a measured body."""
    return {
        "name": body.name,
        "spacing": spacing(case, body),
        "box": [*map(float, box[0]), *map(float, box[1])],
        "times": [time for time, _ in body.files],
        "quantities": [q.described() for q in body.quantities],
        "displacement": displacement_of(body),
        "frames": [encode(path, body, box) for _, path in body.files],
    }
