"""Surfaces that recede: what the table [recession] of a study file says, and what came of it. README.md describes the
keys."""

import functools
import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from toryu.study import calibrated, recession_answer, recession_faults, recession_goals, study_file
from toryu.study.calibrated import Calibrated
from toryu.study.document import found, is_number
from toryu.study.recession_steps import March
from toryu.study.recession_surface import Pressure

AXIS = "solution"  # of the study: the solutions of the flow
UNITS = {"machining_time": "s", "cycles": "", "depth_mean": "m", "depth_largest": "m", "gap": "m", "edge_radius": "m",
         "roughness": "m", "taper": "", "removed_area": "m2", "removed_mass": "kg/m", "balance_error": "",
         "removal_rate": "m/s", "jump_error": "", "unsteadiness": ""}
ABOUT_AXIS = {"removed_area": {"removed_volume": "m3"}, "removed_mass": {"removed_mass": "kg"},
              "depth_largest": {"depth_largest": "m", "diameter_mean": "m", "diameter_smallest": "m",
                                "diameter_largest": "m"}}  # in place of those
LONGEST = 8
WAYS = ("one_way", "first_half", "mirrored", "both")


@dataclass
class Recession:
    """The table [recession]."""

    axis: study_file.Axis  # its values are the solutions, in the end all that ran
    time: float = math.nan  # [s] of machining
    cycle: float | None = None  # [s] of a cycle, if cycles count
    gap: float = math.nan  # [m] of the narrowest passage
    jump: float = 0.1  # largest change of the gap in a jump, as a share of it
    edge_jump: float = 0.25  # most that comes off an edge in a jump [spacings]
    tolerance: float = 0.1  # of State.jump_error
    until: list = field(default_factory=list)  # recession_goals.Goal: at the first that is reached it ends
    way: str = "one_way"
    along: int = 0  # axis of the flow: 0 is x
    reverse: dict = field(default_factory=dict)  # overrides of the case that turn the flow
    pressure: Pressure | None = None  # where the contact pressure of a run is not the medium's
    window: tuple = (0.5, 1.0)  # shares of a run's time within which its rate is taken
    steady_within: float = 0.01
    longest: tuple = (LONGEST, "")  # times the case's end time within which a flow must become steady; what is against more
    line: Callable = None  # key -> line of the file
    walls: list[str] = field(default_factory=list)  # of the case
    density: float | None = None  # of the work pieces [kg/m3]
    about_axis: bool = False
    calibrated: Calibrated | None = None
    chains: list = field(default_factory=list)  # recession_search.Chain, a combination of the other axes each

    def march(self, chain):
        """Of a Chain, whose first run tells its surface."""
        def allowed(depth):
            surface = chain.surface
            across = 0.5 * self.jump * (self.gap + 2 * float(depth.min()))
            rows = np.concatenate([face.rows for face in surface.faces])
            edges = np.isin(rows, [row for row in set(rows) if (rows == row).sum() > 1])
            return np.where(edges, min(across, self.edge_jump * float(np.median(surface.length))), across)

        return March(self.time, allowed, self.tolerance, chain.missing)

    def is_new(self, setting):
        """Whether it is a case as it was given: others have the walls that the study wears."""
        return setting.values[AXIS].startswith("0")

    def faults(self, case):
        return [(self.line(key), words) for key, words in recession_faults.of(self, case)]

    def counts(self, surface):
        """Which points tell of the passage; the others are its image."""
        return surface.first_half(self.along) if self.way == "first_half" else np.full(len(surface.place), True)

    def take_all_values(self, _):
        """Makes all that ran values of the axis."""
        names = dict.fromkeys(name for chain in self.chains for name in chain.records)
        self.axis.values = [study_file.Value(name, {"wall.N.worn": "as far as it has come"}) for name in names]

    @property
    def removed(self):
        return "removed_volume" if self.about_axis else "removed_area"

    def units(self):
        units = {}
        for name, unit in UNITS.items():
            units |= ABOUT_AXIS.get(name, {name: unit}) if self.about_axis else {name: unit}
        if self.calibrated:
            units |= {f"{name}_error": units[name] for name in recession_answer.uncertain(self)}
        told = {"cycles": self.cycle, "removed_mass": self.density, "removed_mass_error": self.density,
                "edge_radius": any(chain.edges for chain in self.chains),
                "roughness": any(chain.roughness_law for chain in self.chains)}
        return {name: unit for name, unit in units.items() if told.get(name, True)}

    def shown(self):
        """The lines that are settings of the study, not ones that tell the uncertainty of such."""
        return [chain for chain in self.chains if chain.states() and (not self.calibrated or chain.is_fitted())]

    def figures(self, study, row):
        """Of a solution at the end of a jump; a predicted one has its rate alone."""
        run = row["record"].folder.name
        solved = next((chain.solved[run] for chain in self.chains if run in chain.solved), None)
        return solved.figures() if solved else {}

    def charts(self, study, table, folder):
        from toryu.study import recession_charts

        return recession_charts.draw(self, study, folder)

    def relate(self, study, rows):
        """Adds to the last row of each line how uncertain its figures are by what the calibration leaves open."""
        for chain in self.shown() if self.calibrated else ():
            run = chain.states()[-1].record.folder.name
            for row in rows:
                if row["record"].folder.name == run:
                    row |= recession_answer.uncertainty(self, chain)

    def answers(self, study, table, out):
        recession_answer.write(self, out / "recession.csv")
        if self.until:
            recession_goals.write(out / "goals.csv", self, study)
        return [recession_answer.answer(self, study, chain) for chain in self.shown()]


def add_axes(table, study):
    axis = study_file.Axis(AXIS, "", [study_file.Value("0", {})], table.document.line(table.path, ""))
    study.axes.append(axis)
    study.recession = Recession(axis, calibrated=calibrated.read(table, study))
    if study.recession.calibrated:
        study.axes.append(study.recession.calibrated.axis(table.document.line(table.path, "calibration")))


def read(table, study):
    made = study.recession
    table.known.append("calibration")  # add_axes has read it
    made.cycle = _positive(table, "cycle", None)
    made.time = _positive(table, "time") if not made.cycle else made.cycle * (_positive(table, "cycles") or math.nan)
    made.gap = _positive(table, "gap")
    for name, most in (("jump", 0.5), ("edge_jump", 1.0), ("tolerance", 1.0), ("steady_within", 1.0)):
        setattr(made, name, value := table.get(name, float, getattr(made, name)))
        if not 0 < value <= most:
            table.fault(f"'{name}' must be above 0 and at most {most:g}, found {value}", name)
    made.until = recession_goals.read(table, study, UNITS)
    if made.calibrated and made.until:
        table.fault("'calibration' tells how uncertain a depth is after a time: it does not go with 'until'", "until")
    made.density = _positive(table, "density", None)
    made.way = table.get("way", str, "one_way", allowed=WAYS)
    made.along = "xy".index(table.get("axis", str, "x", allowed=["x", "y"]) or "x")
    made.reverse = study_file.flat(table.get("reverse", dict, {}))
    if (made.way == "both") != bool(made.reverse):
        table.fault("'reverse', what turns the flow in the case, goes with way = \"both\" and with no other", "way")
    rows = _pressure(table)
    made.pressure = Pressure(rows, made.along, made.gap) if rows else None
    made.window = tuple(table.numbers("shares", 2, [0.5, 1.0]))
    if not 0 <= made.window[0] < made.window[1] <= 1:
        table.fault(f"'shares' must lie between 0 and 1, found {list(made.window)}", "shares")
    if study.timing or study.map:
        table.fault("[recession] goes with neither [timing] nor [map]")
    _read_case(table, study, made)
    table.close()
    return made


def _positive(table, key, *default):
    value = table.get(key, float, *default)
    if value is not None and not value > 0:
        table.fault(f"'{key}' must be above 0, found {value}", key)
    return value


def _pressure(table):
    rows = table.get("pressure", list, None)
    if rows is None:
        return None
    right = rows and all(isinstance(row, list) and len(row) == 2 and all(map(is_number, row)) for row in rows)
    if not right or [row[0] for row in rows] != sorted({row[0] for row in rows}):
        table.fault(f"'pressure' must be rows of place [m] and pressure [Pa], the places ascending, found {found(rows)}",
                    "pressure")
        return None
    if (lowest := min(row[1] for row in rows)) < 0:
        table.fault(f"pressures in 'pressure' must be at least 0, found {lowest}: under suction nothing comes off",
                    "pressure")
    return rows


def _read_case(table, study, made):
    """What the study needs of its case."""
    made.about_axis = study.about_axis
    made.walls = study.names_in_case("wall", "name")
    if study.kind == "coupled":
        table.fault("surfaces recede on rigid walls alone: the case has a [solid]")
    made.line = functools.partial(table.document.line, table.path)
