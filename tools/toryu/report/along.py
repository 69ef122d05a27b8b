"""What happened along the surface of the work pieces, from surface.h5: each quantity over arc length and time, as
16-bit codes."""

import h5py
import numpy as np

from toryu import results, surface
from toryu.report import data, frames

# What can be drawn: label, dataset, unit, and how it is taken over the time between two frames.
QUANTITIES = [
    ("removed depth (Preston)", "preston_depth", "m", "sum"),
    ("removed depth (Archard)", "archard_depth", "m", "sum"),
    ("removed depth (shear)", "shear_depth", "m", "sum"),
    ("contact pressure × sliding speed", "sliding_pressure", "W/m2", "rate"),
    ("contact pressure", "contact_pressure", "Pa", "mean"),
    ("sliding speed", "sliding_speed", "m/s", "mean"),
    ("shear stress", "shear_stress", "Pa", "mean"),
    ("friction work", "friction_work", "J/m2", "sum"),
]


def read(out, faults=None):
    """The open surface.h5 of a run, or None if there is none that is sound."""
    path = results.newest(out / "surface.h5")
    if path is None:
        return None
    try:
        file = h5py.File(path)
        surface.check(file)
        return file
    except results.DAMAGED as error:
        results.note(faults, path, f"cannot be read: {error}")
        return None


def collect(file, contours, times, start):
    """All that the page draws along the surface at the frames' `times`; {} if there is nothing. A contour of one point
    has no length to draw along. `start`: where the solid's particles were, or None."""
    contours = [contour for contour in contours if contour.arc_length[-1] > 0]
    if not contours or not times or not len(file["time"]):
        return {}
    rows = np.concatenate([contour.rows for contour in contours])
    ends = np.searchsorted(file["time"][:], np.array(times) * (1 + 1e-9) + 1e-12, side="right")
    time = file["time"][:]
    factor, unit = data.scaled("m", max(contour.arc_length[-1] for contour in contours))
    quantities = [encoded(label, unit, kind, taken(file[name][:][:, rows], time, ends, kind))
                  for label, name, unit, kind in QUANTITIES if name in file]
    return {"times": times, "unit": unit, "quantities": quantities,
            "contours": [described(contour, factor, start) for contour in contours]}


def taken(values, time, ends, kind):
    """Values at the frames, which end before rows `ends`: sums as they stand there; a mean, or the rate of a sum,
    over the time since the frame before."""
    last = np.maximum(ends, 1) - 1
    if kind == "sum":
        return values[last]
    before = np.concatenate([last[:1], last[:-1]])
    if kind == "rate":
        passed = np.maximum(time[last] - time[before], 1e-300)[:, None]
        return (values[last] - values[before]) / passed
    return np.array([values[min(b + 1, l):l + 1].mean(axis=0) for b, l in zip(before, last)])


def encoded(label, unit, kind, values):
    """Codes of the values between their extremes, zero included; of means and rates without the outermost 0.2 %."""
    finite = values[np.isfinite(values)]
    low, high = np.percentile(finite, [0, 100] if kind == "sum" else [0.2, 99.8]) if len(finite) else (0, 0)
    low, high = min(0.0, float(low)), max(0.0, float(high))
    factor, shown = data.scaled(unit, max(-low, high))
    if low == high:
        high = low + 1.0
    return {"label": label, "unit": shown, "kind": kind, "low": low * factor, "high": high * factor,
            "metres": 1 / factor if unit == "m" else None,  # that one unit is, of what can be drawn to scale
            "codes": frames.packed([frames.codes(values.ravel(), low, high)])}


def described(contour, factor, start):
    """A contour for the page, its arc length times `factor`. Its points lie on the surface: `offset`, half a cell,
    outward of the particles. `outward` is where a point comes if both faces of its corner move by one metre."""
    offset = contour.normal * contour.area[:, None] / 2
    return {"label": contour.label.replace("_", " "), "arc": (factor * contour.arc_length).tolist(),
            "corners": contour.corners, "closed": contour.closed, "point": (contour.position + offset).tolist(),
            "offset": offset.tolist(), "outward": (2 * offset / contour.spacing).tolist(),
            "particle": particles_of(contour, start)}


def particles_of(contour, start):
    """The solid's particles that are the contour's, in its order; None of a rigid work piece."""
    if start is None or not len(start):
        return None
    distances = [np.linalg.norm(start - place, axis=1) for place in contour.position]
    found = [int(distance.argmin()) for distance in distances]
    return found if all(d[k] < 0.1 * contour.spacing for d, k in zip(distances, found)) else None
