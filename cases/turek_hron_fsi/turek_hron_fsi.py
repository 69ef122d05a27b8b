"""What Turek and Hron (2006) ask of a run: means over its end.

    PYTHONPATH=tools /usr/bin/python3 cases/turek_hron_fsi/turek_hron_fsi.py out/turek_hron_fsi [SINCE]
"""

import pathlib
import sys
from dataclasses import dataclass

import numpy as np

from toryu import results

BODIES = ("cylinder", "interface")  # the cylinder, and the beam in the stream


@dataclass
class Means:
    drag: float  # on cylinder and beam [N/m]
    lift: float
    u_x: float  # of the tip [m]
    u_y: float


def of_run(out, since):
    """Means from `since` [s] to the end of the run: forces by the impulse that both bodies gave, tip by its rows."""
    fluid, solid = (results.read_series(out, name) for name in ("fluid", "solid"))
    time = np.array(fluid["time[s]"])
    first = int(np.searchsorted(time, since))

    def force(axis):
        impulse = sum(np.array(fluid[f"impulse_from_{body}_{axis}[N.s/m]"]) for body in BODIES)
        return -(impulse[-1] - impulse[first]) / (time[-1] - time[first])

    late = np.array(solid["time[s]"]) > since
    tip = [float(np.array(solid[f"tip_displacement_{axis}[m]"])[late].mean()) for axis in "xy"]
    return Means(force("x"), force("y"), *tip)


if __name__ == "__main__":
    found = of_run(pathlib.Path(sys.argv[1]), float(sys.argv[2]) if len(sys.argv) > 2 else 6.0)
    print(f"drag {found.drag:.3f} N/m, lift {found.lift:.4f} N/m, u_x {1e3 * found.u_x:.4f} mm, u_y {1e3 * found.u_y:.4f} mm")
