"""Frequency and damping of the cylinder on its spring.

    PYTHONPATH=tools /usr/bin/python3 cases/mounted_cylinder/mounted_cylinder.py out/mounted_cylinder
"""

import pathlib
import sys
from dataclasses import dataclass

import numpy as np

from toryu import results

REST = 0.005  # about which it swings [m]


@dataclass
class Swing:
    frequency: float  # [Hz]
    damping: float  # over the critical one


def of_path(t, x):
    """Of the displacement x from rest at the times t: mean of whole periods, and decay from one extreme to the last."""
    k = np.nonzero(x[:-1] * x[1:] < 0)[0]
    crossings = t[k] - x[k] * (t[k + 1] - t[k]) / (x[k + 1] - x[k])
    extremes = [np.abs(x[a:b]).max() for a, b in zip(k[:-1], k[1:])]
    decrement = np.log(extremes[0] / extremes[-1]) / (len(extremes) - 1)  # in half a period
    return Swing(float(1 / np.mean(crossings[2:] - crossings[:-2])), float(decrement / np.pi))


def of_run(out):
    solid = results.read_series(out, "solid")
    return of_path(np.array(solid["time[s]"]), np.array(solid["body_displacement_x[m]"]) - REST)


if __name__ == "__main__":
    found = of_run(pathlib.Path(sys.argv[1]))
    print(f"{found.frequency:.4f} Hz, {100 * found.damping:.2f} % of critical damping")
