"""How parallel slits share the flow of a power-law medium, and how the shares change as both open: between plates w apart

    gdot_w = (G w/(2 K))^(1/n),    Q = n/(2 (2 n + 1)) w^2 gdot_w,

so that flow rates are as w^(2 + 1/n). Each wall recedes by dh/dt = k p v with the sliding speed v = gdot_w l of a medium
that sticks, and to and fro the pressure is P/2 in the mean: dw/dt = k P l (G/(2 K))^(1/n) w^(1/n), of which for n = 1/2

    w = w_0/(1 - k P l (G/(2 K))^2 w_0 t).

    python3 shares.py RESULTS     # a study's folder against it
"""

import csv
import pathlib
import sys
from dataclasses import dataclass


@dataclass
class Slits:
    widths: tuple = (2.0e-3, 1.6e-3)  # at the start [m]
    gradient: float = 1.5e8  # G [Pa/m]
    pressure: float = 3e6  # P, over both passages [Pa]
    consistency: float = 1.5e4  # K [Pa s^n]
    preston_coefficient: float = 1e-12  # k [1/Pa]
    grain_length: float = 3e-4  # l [m]

    n = 0.5

    def opened(self, time):
        """Widths [m] after a machining time [s]."""
        rate = self.preston_coefficient * self.pressure * self.grain_length * (self.gradient / (2 * self.consistency)) ** 2
        return [width / (1 - rate * width * time) for width in self.widths]

    def flows(self, widths):
        """Flow rates [m2/s]."""
        return [self.n / (2 * (2 * self.n + 1)) * w**2 * (self.gradient * w / (2 * self.consistency)) ** (1 / self.n)
                for w in widths]

    def time_of(self, flow):
        """When the first one's flow rate has grown to `flow` [m2/s]: [s]."""
        width, first = self.widths[0], self.flows(self.widths)[0]
        rate = 1 - width / self.opened(1.0)[0]  # by which w_0/w falls [1/s]
        return (1 - (first / flow) ** 0.25) / rate


def depths(folder):
    """Machining time [s] -> mean depth [m] of the walls of each slit, from recession.csv."""
    sides = {("lower", "upper"): 0, ("between", "lower"): 0, ("between", "upper"): 1, ("upper", "lower"): 1}
    found = {}
    with open(pathlib.Path(folder) / "recession.csv", newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            both = found.setdefault(float(row["machining_time[s]"]), ([], []))
            both[sides[row["wall"], row["face"]]].append(float(row["depth[m]"]))
    return {time: [sum(values) / len(values) for values in both] for time, both in found.items()}


def main(folder):
    slits = Slits()
    with open(pathlib.Path(folder) / "table.csv", newline="", encoding="utf-8") as file:
        rows = {float(row["machining_time[s]"]): row for row in csv.DictReader(file) if row["machining_time[s]"]}
    for time, found in depths(folder).items():
        widths = slits.opened(time)
        wide, narrow = slits.flows(widths)
        exact = [(width - first) / 2 for width, first in zip(widths, slits.widths)]
        print(f"{time:6.0f} s: share of the wide one {float(rows[time]['share_of_wide']):.4f}, exact {wide / (wide + narrow):.4f}; "
              f"depth {found[0] * 1e6:.2f} and {found[1] * 1e6:.2f} µm, exact {exact[0] * 1e6:.2f} and {exact[1] * 1e6:.2f} µm")
    print(f"7.5e-5 m2/s through the wide one: exact after {slits.time_of(7.5e-5) / 27:.2f} cycles")


if __name__ == "__main__":
    main(sys.argv[1])
