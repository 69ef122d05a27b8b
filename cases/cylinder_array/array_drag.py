"""The drag of a square array of cylinders in creeping flow, and that of a run.

    PYTHONPATH=tools /usr/bin/python3 cases/cylinder_array/array_drag.py out/cylinder_array

The drag is told as K = F/(mu U), F per length of a cylinder and U the flow through a cell over its side (Sangani & Acrivos
1982). The stream function about a cylinder of radius a in a cell of side 1, for the flow along x, is a sum over odd n of

    [A r^n + B r^-n + C r^(n+2) + D r^(2-n)] sin(n theta),   r ln r in the place of D r for n = 1

that vanishes with its slope at r = a. On the sides of the cell, which are lines of symmetry, it is fitted to

    psi = 1/2, psi_yy = 0 at y = 1/2;   psi_x = 0, omega_x = 0 at x = 1/2

by least squares. The coefficient of r ln r sin(theta) tells the force on the fluid, K = 4 pi D_1.
"""

import math
import pathlib
import sys

import numpy as np

from toryu import results

SCALE = 0.7  # near the largest r of the cell: powers of r/SCALE stay of order 1


class Power:
    """c r^p, or c r^p ln r."""

    def __init__(self, c, p, log=False):
        self.c, self.p, self.log = c, p, log

    def at(self, r):
        """Value and first two derivatives."""
        c, p, ln = self.c, self.p, np.log(r) if self.log else 1.0
        more = 1.0 if self.log else 0.0
        return (c * r**p * ln, c * r**(p - 1) * (p * ln + more), c * r**(p - 2) * (p * (p - 1) * ln + (2 * p - 1) * more))

    def laplacian(self, n):
        """Of c r^p sin(n theta), as a power."""
        return Power(2 * self.c, self.p - 2) if self.log else Power(self.c * (self.p**2 - n**2), self.p - 2)


def modes(n, a):
    """Pairs of sums of powers, each zero with its slope at r = a, as lists (share, power); r ln r is the last power."""
    powers = [Power(SCALE**-n, n), Power(a**n, -n), Power(SCALE**-(n + 2), n + 2),
              Power(1.0, 1, log=True) if n == 1 else Power(a**(n - 1), 2 - n)]
    at_wall = np.array([[power.at(a)[0] for power in powers], [a * power.at(a)[1] for power in powers]])
    return [list(zip(shares, powers)) for shares in np.linalg.svd(at_wall)[2][2:]]


def derivatives(mode, n, x, y):
    """psi, psi_x, psi_yy and omega_x of a mode."""
    r, theta = np.hypot(x, y), np.arctan2(y, x)
    F, F1, F2 = sum(share * np.array(power.at(r)) for share, power in mode)
    G, G1, _ = sum(share * np.array(power.laplacian(n).at(r)) for share, power in mode)
    s, c, sin, cos = np.sin(n * theta), np.cos(n * theta), np.sin(theta), np.cos(theta)
    psi_x = cos * F1 * s - sin / r * F * n * c
    psi_yy = (sin**2 * F2 * s + 2 * sin * cos / r * (F1 - F / r) * n * c + cos**2 / r * (F1 - F * n**2 / r) * s)
    return F * s, psi_x, psi_yy, -(cos * G1 * s - sin / r * G * n * c)


def exact(concentration, terms=12, points=80):
    """K of a square array whose cylinders take this share of the space."""
    a = math.sqrt(concentration / math.pi)
    columns, of_force = [], []
    along = (np.arange(points) + 0.5) / (2 * points)
    for n in range(1, 2 * terms, 2):
        for mode in modes(n, a):
            psi, _, psi_yy, _ = derivatives(mode, n, along, np.full(points, 0.5))
            _, psi_x, _, omega_x = derivatives(mode, n, np.full(points, 0.5), along)
            columns.append(np.concatenate([psi, psi_yy, psi_x, omega_x]))
            of_force.append(mode[-1][0] if n == 1 else 0.0)
    matrix = np.array(columns).T
    size = np.linalg.norm(matrix, axis=0)
    wanted = np.concatenate([np.full(points, 0.5), np.zeros(3 * points)])
    solution = np.linalg.lstsq(matrix / size, wanted, rcond=1e-14)[0] / size
    return 4 * math.pi * float(np.dot(of_force, solution))


def of_run(out, side=0.02, force=1000.0, viscosity=1.0):
    """K of the last fifth of a run: the force [N/m3] on a cell of `side` [m] is borne by its cylinder."""
    rows = results.read_series(out, "fluid")
    time, flow = np.array(rows["time[s]"]), np.array(rows["flow[m2/s]"])
    return force * side**3 / (viscosity * float(flow[time > 0.8 * time[-1]].mean()))


if __name__ == "__main__":
    for folder in sys.argv[1:]:
        print(f"{folder}: K = {of_run(pathlib.Path(folder)):.2f}")
    print("exact:", ", ".join(f"{exact(c):.2f} at {c:g}" for c in (0.05, 0.1, 0.2, 0.3, 0.4)))
