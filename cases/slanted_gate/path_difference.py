"""How far the tip of the slanted gate departs from that of the gate: the path is turned back by 30 degrees.

    /usr/bin/python3 cases/slanted_gate/path_difference.py OUT_OF_GATE OUT_OF_SLANTED_GATE
"""

import argparse
import csv
import math
import pathlib
import sys
from dataclasses import dataclass

ANGLE = math.radians(30)
COLUMNS = ("time[s]", "tip_displacement_x[m]", "tip_displacement_y[m]")


class NoPath(Exception):
    """What a run lacks, ready to be shown."""


@dataclass
class Difference:
    """Of two paths over the times that both have."""

    peak: float  # of the distance from the start, less 1
    path: float  # root mean square of the distance between both, over the peak


def path_of(out, angle=0.0):
    """time [s] -> displacement [m] of the tip, turned by `angle` clockwise."""
    cosine, sine = math.cos(angle), math.sin(angle)
    path = pathlib.Path(out) / "solid.csv"
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = [tuple(float(row[name]) for name in COLUMNS) for row in csv.DictReader(file)]
    except OSError as error:
        raise NoPath(f"{path}: error: cannot be read: {error.strerror}; it takes a run that is done") from None
    except KeyError as error:
        raise NoPath(f"{path}: error: has no column {error}") from None
    except (TypeError, ValueError, csv.Error):
        raise NoPath(f"{path}: error: holds a row that is no row of numbers; it takes a run that is done") from None
    return {round(time, 6): (cosine * x + sine * y, cosine * y - sine * x) for time, x, y in rows}


def difference(gate, slanted):
    exact, found = path_of(gate), path_of(slanted, ANGLE)
    times = sorted(exact.keys() & found.keys())
    peak = max((math.hypot(*exact[time]) for time in times), default=0.0)
    if not peak > 0:
        raise NoPath(f"{gate}: error: its tip does not move at a time that {slanted} has too")
    squares = [math.dist(exact[time], found[time]) ** 2 for time in times]
    return Difference(max(math.hypot(*found[time]) for time in times) / peak - 1,
                      math.sqrt(sum(squares) / len(squares)) / peak)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("gate", type=pathlib.Path)
    parser.add_argument("slanted", type=pathlib.Path)
    options = parser.parse_args()
    try:
        found = difference(options.gate, options.slanted)
    except NoPath as error:
        print(error, file=sys.stderr)
        sys.exit(2)
    print(f"peak {100 * found.peak:+.2f} %, path {100 * found.path:.2f} % of the peak, root mean square")


if __name__ == "__main__":
    main()
