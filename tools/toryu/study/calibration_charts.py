"""Charts of a calibration: what was measured, with its scatter, against what the fitted case computes."""

import numpy as np

from toryu.report import data
from toryu.study import drawing
from toryu.study.table import readable_size


def draw(view, folder):
    """A chart of measured over computed for each unit, and one of the depths along each face."""
    drawn = []
    for number, unit in enumerate(dict.fromkeys(datum.unit for datum in view.data), 1):
        made = against(view, [k for k, datum in enumerate(view.data) if datum.unit == unit], unit)
        name = f"measured_{number}"
        drawn.append(("Measured against computed", drawing.save(made, folder / name), f"charts/{name}"))
    coupons = {id(datum.coupon): datum.coupon for datum in view.data if datum.coupon}
    for number, coupon in enumerate(coupons.values(), 1):
        made = along(view, [k for k, datum in enumerate(view.data) if datum.coupon is coupon], coupon)
        name = f"depth_{number}"
        drawn.append((f"Depth along the {coupon.face} face of {coupon.work_piece.replace('_', ' ')}",
                      drawing.save(made, folder / name), f"charts/{name}"))
    return drawn


def taken(view, numbers):
    """Measured, scatter, computed."""
    chosen = [view.data[k] for k in numbers]
    return (np.array([d.measured for d in chosen]), np.array([d.scatter for d in chosen]),
            np.asarray(view.computed)[numbers])


def against(view, numbers, unit):
    measured, scatter, computed = taken(view, numbers)
    factor, shown = readable_size(unit, [*measured, *computed])
    made, (panel,) = drawing.figure()
    every = np.concatenate([measured - scatter, measured + scatter, computed])
    ends = np.array([every.min(), every.max()]) * factor
    panel.plot(ends, ends, color=drawing.PALETTE["soft"], linewidth=0.9, linestyle="--", label="equal")
    panel.errorbar(computed * factor, measured * factor, scatter * factor, fmt="o", color=drawing.LINES[0], capsize=3,
                   linewidth=1.2, label="measured ± scatter")
    panel.set_xlabel(drawing.readable("computed", shown))
    panel.set_ylabel(drawing.readable("measured", shown))
    panel.legend()
    return made


def along(view, numbers, coupon):
    measured, scatter, computed = taken(view, numbers)
    place = np.array([view.data[k].place for k in numbers])
    order = np.argsort(place, kind="stable")
    factor, unit = data.scaled("m", float(np.abs(measured).max()))
    made, (panel,) = drawing.figure()
    panel.errorbar(place * 1e3, measured * factor, scatter * factor, fmt="o", color=drawing.LINES[0], capsize=3,
                   linewidth=1.2, label="measured ± scatter")
    panel.plot(place[order] * 1e3, computed[order] * factor, color=drawing.LINES[1], label="computed")
    panel.set_xlabel("along the face  [mm]")
    panel.set_ylabel(f"depth  [{unit}]")
    panel.set_ylim(bottom=0)
    panel.legend()
    return made
