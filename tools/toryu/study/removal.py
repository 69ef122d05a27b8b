"""Abrasive removal of each run: depth along the work pieces a cycle, evenness, the pressure that the pistons need."""

import math
from dataclasses import dataclass, field

import numpy as np

from toryu import results, surface
from toryu.case import resolve
from toryu.processes import DONE
from toryu.report import along
from toryu.study import removal_charts
from toryu.study.answer import Answer
from toryu.study.removal_answer import Wanted, answer_of

WINDOWS_A_CYCLE = 20  # over each of them the force of a piston is averaged
DEPTHS = ("preston_depth", "archard_depth", "shear_depth")  # the first that a run has counts
UNITS = {"removed_per_cycle": "m", "removed_area_per_cycle": "m2", "evenness": "", "piston_pressure": "Pa"}
ANSWER_UNITS = {"cycles_needed": "", "time_needed": "s", "evenness_then": "", "roughness_then": "m"}


@dataclass
class Removed:
    """What came off in one run: cumulative depth at the end of each cycle, over all contours one after the other."""

    contours: list[surface.Contour]
    depth: np.ndarray  # cycles x points [m]
    period: float  # [s]
    roughness: dict[str, float] | None  # of the case: initial, final, decay_depth [m]

    @property
    def area(self):
        return np.concatenate([c.area for c in self.contours])

    def mean(self, depth):
        return float(np.average(depth, weights=self.area))

    def a_cycle(self):
        """Depth [m] that each point loses in a cycle after the first: with the first the medium starts from rest."""
        return (self.depth[-1] - self.depth[0]) / (len(self.depth) - 1)

    def after(self, cycles):
        """Depth [m] of each point after that many cycles."""
        return self.depth[0] + (cycles - 1) * self.a_cycle()

    def roughness_at(self, depth):
        """Mean roughness [m] once `depth` is off: each point decays as fluid_solver's removal says; nan without it."""
        if self.roughness is None:
            return math.nan
        first, last, decay = (self.roughness[name] for name in ("initial", "final", "decay_depth"))
        return self.mean(last + (first - last) * np.exp(-depth / decay))


@dataclass
class Removal:
    """The table [removal]: a study's view of what comes off."""

    pistons: list[str]  # boundaries of the fluid
    piston_area: float  # [m2 per metre depth]
    cycle: float  # [s] period of the pistons' table of velocities, before their `motion.time`
    wanted: Wanted | None
    runs: dict[str, Removed] = field(default_factory=dict)  # run -> what came off, filled by `figures`

    def units(self):
        return UNITS | (ANSWER_UNITS if self.wanted else {})

    def figures(self, study, row):
        """Name -> value; empty if the run failed or holds fewer than two whole cycles."""
        record = row["record"]
        removed = read_run(self, study, record.folder) if record.exit_code == DONE else None
        if removed is None:
            return {}
        self.runs[record.folder.name] = removed
        a_cycle = removed.a_cycle()
        figures = {"removed_per_cycle": removed.mean(a_cycle), "evenness": evenness(removed, a_cycle),
                   "removed_area_per_cycle": float(a_cycle @ removed.area),
                   "piston_pressure": piston_pressure(self, record.folder, removed.period)}
        return figures | (self.wanted.figures(removed) if self.wanted else {})

    def charts(self, study, table, folder):
        return removal_charts.draw(self, study, table, folder)

    def answers(self, study, table, _) -> list[Answer]:
        return [answer_of(self.wanted, study, table)] if self.wanted else []


def read(table, study):
    """The table [removal] of the file of `study`."""
    area, cycle = table.get("piston_area", float), table.get("cycle", float)
    for key, value in (("piston_area", area), ("cycle", cycle)):
        if value is not None and not value > 0:
            table.fault(f"'{key}' must be above 0, found {value}", key)
    pistons = table.texts("pistons", allowed=study.names_in_case("wall", "name"))
    if table.has("pistons") and not pistons:
        table.fault("'pistons' needs at least one wall", "pistons")
    answer = table.table("answer")
    wanted = Wanted.read(answer) if answer else None
    table.close()
    return Removal(pistons, area, cycle, wanted)


def read_run(view, study, folder):
    """What came off in the run, or None if it has no work piece or holds fewer than two whole cycles."""
    file = along.read(folder)
    if file is None:
        return None
    with file:
        case = resolve(folder / "used_case.toml", study.coupler).content
        period = view.cycle * time_factor(case, view.pistons)
        time = file["time"][:]
        ends = period * np.arange(1, math.floor(time[-1] / period + 1e-3) + 1) if len(time) else []
        if len(ends) < 2:
            return None
        contours = surface.contours(file)
        law = next((name for name in DEPTHS if name in file), None)
        if law is None or not contours:
            return None
        depth = file[law][:][:, np.concatenate([c.rows for c in contours])]
    at_ends = np.column_stack([np.interp(ends, time, column) for column in depth.T])
    return Removed(contours, at_ends, period, case.get("fluid", {}).get("removal", {}).get("roughness"))


def time_factor(case, pistons):
    """What multiplies the times of the pistons' table in this run."""
    factors = [wall.get("motion", {}).get("time", 1.0) for wall in case.get("wall", []) if wall.get("name") in pistons]
    return factors[0] if factors else 1.0


def evenness(removed, depth):
    """Largest over mean."""
    mean = removed.mean(depth)
    return float(depth.max()) / mean if mean > 0 else math.nan


def piston_pressure(view, folder, period):
    """Largest pressure [Pa] that a piston exerts after the first cycle, means over a share of a cycle: what rings faster
    is sound, and no pump would notice it."""
    series = results.read_series(folder, "fluid")
    time = np.array(series["time[s]"])
    window = np.floor(time / period * WINDOWS_A_CYCLE).astype(int)
    largest = math.nan
    for piston in view.pistons:
        names = [f"force_from_{piston}_{axis}[N/m]" for axis in "xy"]
        if not all(name in series for name in names):
            continue
        means = [np.hypot(*(np.mean(np.array(series[name])[window == k]) for name in names))
                 for k in np.unique(window[time >= period])[:-1]]  # the last one is hardly begun
        largest = np.fmax(largest, max(means) / view.piston_area)
    return float(largest)
