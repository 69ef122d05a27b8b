"""Stress along the ring at 24 places about the bore, the middle and the outside, against Lame's: mean and root mean square.

    python3 cases/pressed_ring/around.py --observers          # what a run needs to know of them, for --set
    python3 cases/pressed_ring/around.py out/pressed_ring ...
"""
import csv
import math
import pathlib
import sys

INNER, OUTER, PRESSURE = 0.05, 0.1, 10e6  # [m], [m], [Pa]
RADII = {"bore": INNER, "middle": 0.075, "outside": OUTER}  # [m]
ANGLES = [2 * math.pi * (k + 0.37) / 24 for k in range(24)]  # not along the axes of a lattice


def observers():
    places = [f'{{name = "{name}{k}", point = [{r * math.cos(a):.15g}, {r * math.sin(a):.15g}], stress = true}}'
              for name, r in RADII.items() for k, a in enumerate(ANGLES)]
    return f"solid.observer=[{', '.join(places)}]"


def lame(r):
    """Along the ring [Pa]."""
    return PRESSURE * INNER**2 / (OUTER**2 - INNER**2) * (1 + (OUTER / r) ** 2)


def errors(row, name):
    """At each place, as a share of the exact stress."""
    found = []
    for k, a in enumerate(ANGLES):
        xx, yy, xy = (float(row[f"{name}{k}_stress_{part}[Pa]"]) for part in ("xx", "yy", "xy"))
        along = xx * math.sin(a) ** 2 + yy * math.cos(a) ** 2 - 2 * xy * math.sin(a) * math.cos(a)
        found.append(along / lame(RADII[name]) - 1)
    return found


def tell(run):
    with open(pathlib.Path(run) / "solid.csv", newline="", encoding="utf-8") as file:
        last = list(csv.DictReader(file))[-1]
    for name in RADII:
        off = errors(last, name)
        rms = math.sqrt(sum(e * e for e in off) / len(off))
        print(f"{run}: {name} {100 * sum(off) / len(off):+.2f} % on the mean, {100 * rms:.2f} % root mean square")


if __name__ == "__main__":
    if sys.argv[1:] == ["--observers"]:
        print(observers())
    for run in sys.argv[1:]:
        if run != "--observers":
            tell(run)
