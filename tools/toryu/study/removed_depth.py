"""The depth that comes off: the laws that a run can have, and what they take off in more cycles than the run holds."""

import math

import numpy as np

# Depth in surface.h5 -> the key of the case to which it is proportional: it is this coefficient times what contact and
# sliding make of it (fluid_solver/terms/removal.hpp), and nothing else in a run reads the coefficient or the depth. The
# first that a run has counts.
LAWS = {"preston_depth": "fluid.removal.preston_coefficient", "archard_depth": "fluid.removal.archard.wear_coefficient",
        "shear_depth": "fluid.removal.shear_coefficient"}


def law_in(case, laws=LAWS):
    """The depth that counts in the runs of a case, None if it has none of the laws."""
    def value(key):
        found = case
        for part in key.split("."):
            found = found.get(part) if isinstance(found, dict) else None
        return found

    return next((law for law in laws if value(LAWS[law])), None)


def law_of(file):
    """The depth that counts in an open surface.h5, None if it has none."""
    return next((name for name in LAWS if name in file), None)


def rows_inside(case, shares):
    """How many intervals of the series the shares of the run's time hold."""
    end, interval = (case.get("case", {}).get(key, 0.0) for key in ("end_time", "series_interval"))
    return (shares[1] - shares[0]) * end / interval if interval > 0 else float("inf")


def roughness(depth, law):
    """Ra [m] where `depth` [m] is off: it decays as fluid_solver/terms/removal.hpp says, by [fluid.removal.roughness]."""
    return law["final"] + (law["initial"] - law["final"]) * np.exp(-depth / law["decay_depth"])


def at_ends_of_cycles(time, depth, period):
    """Cumulative depth of each point at the end of each cycle, cycles x points [m]; None if there are fewer than two.
    `depth`: times x points."""
    ends = period * np.arange(1, math.floor(time[-1] / period + 1e-3) + 1) if len(time) else []
    return np.column_stack([np.interp(ends, time, column) for column in depth.T]) if len(ends) >= 2 else None


def a_cycle(at_ends):
    """Depth [m] that each point loses in a cycle after the first: with the first the medium starts from rest."""
    return (at_ends[-1] - at_ends[0]) / (len(at_ends) - 1)


def after(at_ends, cycles):
    """Depth [m] of each point after that many cycles."""
    return at_ends[0] + (cycles - 1) * a_cycle(at_ends)
