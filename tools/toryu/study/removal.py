"""Abrasive removal of each run: depth along the work pieces a cycle, evenness, the pressure that the pistons need."""

import math
from dataclasses import dataclass, field, replace

import numpy as np

from toryu import results, surface
from toryu.case import resolve
from toryu.processes import DONE
from toryu.report import along
from toryu.study import calibrated, removed_depth
from toryu.study.answer import Answer
from toryu.study.calibrated import Calibrated
from toryu.study.removal_answer import Wanted, answer_of

WINDOWS_A_CYCLE = 20  # over each of them the force of a piston is averaged
UNITS = {"removed_per_cycle": "m", "removed_area_per_cycle": "m2", "evenness": "", "piston_pressure": "Pa"}
ERROR_UNITS = {"removed_per_cycle_error": "m", "removed_area_per_cycle_error": "m2", "piston_pressure_error": "Pa"}
ANSWER_UNITS = {"cycles_needed": "", "time_needed": "s", "evenness_then": "", "roughness_then": "m"}


@dataclass
class Removed:
    """What came off in one run: cumulative depth at the end of each cycle, over all contours one after the other."""

    contours: list[surface.Contour]
    depth: np.ndarray  # cycles x points [m]
    law: str  # which depth of surface.h5 that is
    period: float  # [s]
    roughness: dict[str, float] | None  # of the case: initial, final, decay_depth [m]

    @property
    def area(self):
        return np.concatenate([c.area for c in self.contours])

    def mean(self, depth):
        return float(np.average(depth, weights=self.area))

    def a_cycle(self):
        """Depth [m] that each point loses in a cycle after the first."""
        return removed_depth.a_cycle(self.depth)

    def after(self, cycles):
        """Depth [m] of each point after that many cycles."""
        return removed_depth.after(self.depth, cycles)

    def roughness_at(self, depth):
        """Mean roughness [m] once `depth` is off; nan without it."""
        return math.nan if self.roughness is None else self.mean(removed_depth.roughness(depth, self.roughness))


@dataclass
class Removal:
    """The table [removal]: a study's view of what comes off."""

    pistons: list[str]  # boundaries of the fluid
    piston_area: float  # [m2 per metre depth]
    cycle: float  # [s] period of the pistons' table of velocities, before their `motion.time`
    wanted: Wanted | None
    calibrated: Calibrated | None = None
    runs: dict[str, Removed] = field(default_factory=dict)  # run -> what came off, filled by `figures`
    errors: dict[str, np.ndarray] = field(default_factory=dict)  # run -> of the depth of each point [m], filled by `relate`

    def units(self):
        return UNITS | (ERROR_UNITS if self.calibrated else {}) | (ANSWER_UNITS if self.wanted else {}) | (
            {"depth_then_error": "m"} if self.wanted and self.calibrated else {})

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
        return figures | (self.wanted.figures(removed) if self.wanted and self.is_fitted(row) else {})

    def is_fitted(self, row):
        """Whether the row is a setting of the study, not one that tells the uncertainty of such."""
        return self.calibrated is None or row[calibrated.AXIS] == calibrated.FITTED

    def settings(self, table):
        """The table without the rows that tell the uncertainty of others."""
        return replace(table, rows=[row for row in table.rows if self.is_fitted(row)])

    def relate(self, study, rows):
        """Adds how uncertain the figures are by what the calibration leaves open."""
        for row in rows if self.calibrated else ():
            if not self.is_fitted(row) or row["record"].folder.name not in self.runs:
                continue
            others = [axis.name for axis in study.axes if axis.name != calibrated.AXIS]
            near = {r[calibrated.AXIS]: r for r in rows if all(r[name] == row[name] for name in others)}
            row |= self.uncertainty(row, {name: r for name, r in near.items() if r["record"].folder.name in self.runs})

    def uncertainty(self, row, near):
        """Standard errors of the figures of a row. `near`: value of the calibration's axis -> its neighbour."""
        removed = {name: self.runs[r["record"].folder.name] for name, r in near.items()}
        fitted = self.runs[row["record"].folder.name]

        def error(of, law=fitted.law):
            return self.calibrated.error(of(row, fitted), {name: of(near[name], removed[name]) for name in near}, law)

        cycles = row.get("cycles_needed")
        self.errors[row["record"].folder.name] = error(lambda _, r: r.after(cycles) if cycles else r.a_cycle())
        found = {f"{name}_error": float(error(lambda r, _, name=name: r[name], law)) for name, law in
                 (("removed_per_cycle", fitted.law), ("removed_area_per_cycle", fitted.law), ("piston_pressure", None))}
        return found | ({"depth_then_error": float(error(lambda _, r: r.mean(r.after(cycles))))} if cycles else {})

    def charts(self, study, table, folder):
        from toryu.study import removal_charts

        return removal_charts.draw(self, study, self.settings(table), folder)

    def answers(self, study, table, _) -> list[Answer]:
        return [answer_of(self.wanted, study, self.settings(table))] if self.wanted else []


def add_axes(table, study):
    """With a calibration one axis: the fitted values and a standard error to either side."""
    study.removal = Removal([], math.nan, math.nan, None, calibrated.read(table, study))
    if study.removal.calibrated:
        study.axes.append(study.removal.calibrated.axis(table.document.line(table.path, "calibration")))


def read(table, study):
    """The table [removal] of the file of `study`."""
    table.known.append("calibration")  # add_axes has read it
    area, cycle = table.get("piston_area", float), table.get("cycle", float)
    for key, value in (("piston_area", area), ("cycle", cycle)):
        if value is not None and not value > 0:
            table.fault(f"'{key}' must be above 0, found {value}", key)
    pistons = table.texts("pistons", allowed=study.names_in_case("wall", "name"))
    if table.has("pistons") and not pistons:
        table.fault("'pistons' needs at least one wall", "pistons")
    if study.about_axis:
        table.fault("[removal] is of the plane: a case with geometry = \"axisymmetric\" goes with [recession]")
    answer = table.table("answer")
    wanted = Wanted.read(answer) if answer else None
    table.close()
    return Removal(pistons, area, cycle, wanted, study.removal.calibrated)


def read_run(view, study, folder):
    """What came off in the run, or None if it has no work piece or holds fewer than two whole cycles."""
    file = along.read(folder)
    if file is None:
        return None
    with file:
        case = resolve(folder / "used_case.toml", study.coupler).content
        period = view.cycle * time_factor(case, view.pistons)
        contours = surface.contours(file)
        law = removed_depth.law_of(file)
        if law is None or not contours:
            return None
        rows = np.concatenate([contour.rows for contour in contours])
        at_ends = removed_depth.at_ends_of_cycles(file["time"][:], file[law][:][:, rows], period)
    if at_ends is None:
        return None
    return Removed(contours, at_ends, law, period, case.get("fluid", {}).get("removal", {}).get("roughness"))


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
