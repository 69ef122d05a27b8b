"""How a passage opens under a constant pressure drop, by lubrication theory (Reynolds 1886): where its width w changes slowly
along x, the flow is everywhere that between two plates, or that in a tube of the radius R = w/2,

    Q = w^3 G(x)/(12 eta) (1 + 6 eta b_w/w),         tau_w = G w/2,
    Q = pi R^4 G(x)/(8 eta) (1 + 4 eta b_w/R),       tau_w = G R/2,
    integral_0^L G dx = P,    p(x) = integral_x^L G dx,

with Navier slip u_s = b_w tau_w at the walls (0: none), and each of them recedes by dh/dt = k p v, v = b tau_w. Both ways
in turn it opens evenly: a slit by w = w_0 exp(k b P^2 t/(2 L)), a tube by R = R_0 exp(k b P^2 t/(4 L)).

    python3 lubrication.py RESULTS/recession.csv [b_w]     # a study's last shape against it: of the slit,
    python3 lubrication.py RESULTS/recession.csv tube      # or the bore of cases/abrasive_bore
"""

import csv
import sys
from dataclasses import dataclass

import numpy as np


@dataclass
class Slit:
    width: float = 2e-3  # w_0 [m]
    length: float = 20e-3  # L [m]
    pressure: float = 3e6  # P [Pa]
    viscosity: float = 1000.0  # eta [Pa s]
    wall_slip: float = 0.0  # b_w, of the flow [m/(Pa s)]
    sliding: float = 3e-7  # b, of the wear [m/(Pa s)]
    preston_coefficient: float = 1e-12  # k [1/Pa]

    def opened_two_way(self, time):
        """Width [m] after a machining time [s]."""
        return self.width * np.exp(self.preston_coefficient * self.sliding * self.pressure**2 * time / (2 * self.length))

    def resistance(self, width):
        """Pressure gradient over flow rate [Pa s/m3], of a tube [Pa s/m4]."""
        return 12 * self.viscosity / (width**3 * (1 + 6 * self.viscosity * self.wall_slip / width))

    def wall_stress(self, G, width):
        return G * width / 2

    def flow(self, depth):
        """Flow rate [m2/s], of a tube [m3/s], pressure gradient and pressure [Pa/m], [Pa] at the middles of as many parts as
        `depth` has."""
        dx, resistance = self.length / len(depth), self.resistance(self.width + 2 * depth)
        rate = self.pressure / (resistance.sum() * dx)
        G = rate * resistance
        return rate, G, dx * (np.cumsum(G[::-1])[::-1] - G / 2)

    def opened_one_way(self, time, parts=400, steps=2000):
        """Places [m], the depth of each wall there [m], and the flow rate at the end."""
        def wear(depth):
            _, G, p = self.flow(depth)
            return self.preston_coefficient * self.sliding * p * self.wall_stress(G, self.width + 2 * depth)

        depth, dt = np.zeros(parts), time / steps
        for _ in range(steps):
            depth = depth + dt * wear(depth + dt / 2 * wear(depth))
        return (np.arange(parts) + 0.5) * self.length / parts, depth, self.flow(depth)[0]


@dataclass
class Tube(Slit):
    """Of cases/abrasive_bore; its width is the diameter."""

    wall_slip: float = 3e-7
    preston_coefficient: float = 2.5e-12

    def opened_two_way(self, time):
        return self.width * np.exp(self.preston_coefficient * self.sliding * self.pressure**2 * time / (4 * self.length))

    def resistance(self, width):
        R = width / 2
        return 8 * self.viscosity / (np.pi * R**4 * (1 + 4 * self.viscosity * self.wall_slip / R))

    def wall_stress(self, G, width):
        return G * width / 4


@dataclass
class PressedBore(Tube):
    """Of cases/abrasive_bore/pressed.toml: a bore between two lands of its first width, that stay, and two cylinders. The
    medium sticks, v = (tau_w/eta) l = b tau_w, and wears by k tau_w v, so that

        dR/dt = k b tau_w^2,   tau_w = G R/2,   P = G (L + (R/R_0)^4 (L_lands + 2 * 0.56 R_0))

    with what the lands and the ends of a tube in a wide cylinder take, 0.56 times 2 tau_w an end (a Stokes flow on a
    staggered grid: cases/axisymmetric_throat). Without them and for small changes it is R_0/(1 - k b P^2 R_0 t/(4 L^2))."""

    length: float = 16e-3
    lands: float = 4e-3
    end: float = 0.56
    wall_slip: float = 0.0
    preston_coefficient: float = 1e-10  # k of k tau_w v

    def opened_two_way(self, time, steps=1000):
        R_0 = self.width / 2

        def rate(R):
            G = self.pressure / (self.length + (R / R_0)**4 * (self.lands + 2 * self.end * R_0))
            return self.preston_coefficient * self.sliding * (G * R / 2)**2

        R, dt = R_0, time / steps
        for _ in range(steps):
            R += dt * rate(R + dt / 2 * rate(R))
        return 2 * R


def last_shape(path, wall, length):
    """Time [s], places up to `length` [m] and depths [m] of a wall in the last row of a recession.csv."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["wall"] == wall and float(row["position[m]"]) < length]
    time = max(float(row["machining_time[s]"]) for row in rows)
    last = [row for row in rows if float(row["machining_time[s]"]) == time]
    return time, *(np.array([float(row[name]) for row in last]) for name in ("position[m]", "depth[m]"))


if __name__ == "__main__":
    is_tube = sys.argv[2:] == ["tube"]
    slit = Tube() if is_tube else Slit(wall_slip=float(sys.argv[2]) if len(sys.argv) > 2 else 0.0)
    time, x, depth = last_shape(sys.argv[1], "bore" if is_tube else "lower", slit.length)
    places, exact, rate = slit.opened_one_way(time)
    exact = np.interp(x, places, exact)
    print(f"{time:g} s: mean depth {depth.mean() * 1e6:.2f} µm, one-way {exact.mean() * 1e6:.2f} µm with the flow rate "
          f"{rate:.5g} {'m3/s' if is_tube else 'm2/s'}, two-way {(slit.opened_two_way(time) - slit.width) * 0.5e6:.2f} µm")
    for share in np.arange(0.05, 1, 0.1):
        print(f"  x = {share * slit.length * 1e3:4.1f} mm  {np.interp(share * slit.length, x, depth) * 1e6:7.2f} µm  "
              f"one-way {np.interp(share * slit.length, x, exact) * 1e6:7.2f} µm")
    print(f"largest difference {np.abs(depth - exact).max() / exact.mean() * 100:.2f} % of the mean depth")
