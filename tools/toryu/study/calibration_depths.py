"""The depth of a coupon that was worked longer than a run: at the places where it was measured."""

import csv
import functools
import math
import pathlib
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from toryu import surface
from toryu.report import along
from toryu.study import removed_depth
from toryu.study.document import found
from toryu.study.removed_depth import LAWS
from toryu.surface import SIDES

COLUMNS = ["place[m]", "depth[m]", "scatter[m]"]


class NoDepth(Exception):
    """Why a run tells no depth."""


@dataclass
class Coupon:
    """The table [[calibration.depth]]."""

    file: str  # of the measured depths
    work_piece: str
    face: str
    law: str | None  # the depth in surface.h5; None: the first that there is
    cycles: float | None  # how long it was worked: in cycles of
    cycle: float  # [s] in the run, of which the first starts from rest
    seconds: float | None  # or at the rate that the run has within
    shares: tuple[float, float]  # of its time
    line: Callable = None  # key -> line of the study

    def faults(self, case, place):
        """What a case lacks for the depth at a place, (key of the table, words)."""
        wall = next((wall for wall in case.get("wall", []) if wall.get("name") == self.work_piece), {})
        if not wall.get("work_piece"):
            yield "work_piece", f"the wall '{self.work_piece}' is no work piece: it needs 'work_piece = true'"
        if removed_depth.law_in(case, [self.law] if self.law else LAWS) is None:
            yield "law", f"the case tells no {(self.law or 'depth').replace('_', ' ')}: [fluid.removal] has no such law"
        end = case.get("case", {}).get("end_time", math.inf)
        if self.cycles and end < 2 * self.cycle * (1 - 1e-3):
            yield "cycle", f"the case ends at {end:g} s and holds fewer than two cycles of {self.cycle:g} s"
        if self.seconds and removed_depth.rows_inside(case, self.shares) < 0.5:
            yield "shares", "'shares' holds fewer than two rows of surface.h5: give the case a smaller 'series_interval'"
        axis = 1 - SIDES[self.face][0]
        low, high = (wall.get("box", {}).get(key, [default] * 2)[axis] for key, default in (("min", -math.inf),
                                                                                           ("max", math.inf)))
        if not low <= place <= high:
            yield "file", (f"{self.file}: the place {place:g} m lies beyond the {self.face} face of '{self.work_piece}', "
                           f"{low:g} to {high:g} m")

    def depths(self, folder, places):
        """[m] at the places [m] along the face, and the name of the depth."""
        file = along.read(folder)
        if file is None:
            raise NoDepth(surface.NO_SURFACE)
        with file:
            law = self.law or removed_depth.law_of(file)
            if law is None or law not in file:
                raise NoDepth(f"it tells no {(law or 'depth').replace('_', ' ')}: [fluid.removal] has no such law")
            rows, position = self.points(file)
            time, depth = file["time"][:], self.worked(file["time"][:], file[law][:][:, rows])
        reach = float(np.median(np.diff(position))) if len(position) > 1 else 0.0
        for place in places:
            if len(time) and not position[0] - reach <= place <= position[-1] + reach:
                raise NoDepth(f"{self.file}: the place {place:g} m lies beyond the {self.face} face of '{self.work_piece}', "
                              f"{position[0]:.6g} to {position[-1]:.6g} m")
        return np.interp(places, position, depth), law

    def points(self, file):
        """Rows of surface.h5 on the face, and where they lie along it [m] at the start, ascending."""
        names = surface.names(file)
        if self.work_piece not in names:
            raise NoDepth(f"it has no work piece '{self.work_piece}'")
        rows, position = surface.points_on(file, names.index(self.work_piece), self.face)
        if not len(rows):
            raise NoDepth(f"the {self.face} face of '{self.work_piece}' has no point")
        return rows, position

    def worked(self, time, depth):
        """Depth [m] of each point once the coupon is done. `depth`: times x points [m]."""
        if self.cycles:
            at_ends = removed_depth.at_ends_of_cycles(time, depth, self.cycle)
            if at_ends is None:
                raise NoDepth(f"it holds fewer than two cycles of {self.cycle:g} s")
            return removed_depth.after(at_ends, self.cycles)
        first, last = (int(np.argmin(np.abs(time - share * time[-1]))) for share in self.shares)
        if first == last:
            raise NoDepth("'shares' holds fewer than two rows of its surface.h5: give a smaller 'series_interval'")
        return (depth[last] - depth[first]) / (time[last] - time[first]) * self.seconds


def read_coupon(table, study):
    """The Coupon of a table, and the measured (place, depth, scatter) of its file."""
    name = table.get("file", str)
    laws = {law.removesuffix("_depth"): law for law in LAWS}
    law = table.get("law", str, None, allowed=laws)
    given = {key: _positive(table, key) for key in ("cycles", "cycle", "seconds")}
    shares = tuple(table.numbers("shares", 2, [0.5, 1.0]))
    if not 0 <= shares[0] < shares[1] <= 1:
        table.fault(f"'shares' must lie between 0 and 1, found {list(shares)}", "shares")
    if table.has("cycles") == table.has("seconds") or table.has("cycles") != table.has("cycle"):
        table.fault(f"{table.name} needs how long the coupon was worked: 'cycles' with the 'cycle' [s] of the run, or "
                    "'seconds'")
    coupon = Coupon(name, table.get("work_piece", str, allowed=study.names_in_case("wall", "name")),
                    table.get("face", str, allowed=SIDES), laws.get(law), given["cycles"], given["cycle"], given["seconds"],
                    shares, functools.partial(table.document.line, table.path))
    return coupon, _read_depths(table, study, name) if name is not None else []


def _positive(table, key):
    value = table.get(key, float, None)
    if value is not None and not value > 0:
        table.fault(f"'{key}' must be above 0, found {found(value)}", key)
        return None
    return value


def _read_depths(table, study, name):
    path = study.path.parent / name
    study.inputs.append(pathlib.Path(path))
    try:
        with open(path, newline="", encoding="utf-8") as file:
            lines = [(number, row) for number, row in enumerate(csv.reader(file), 1) if row and not row[0].startswith("#")]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        why = getattr(error, "strerror", None) or error
        table.fault(f"'file' must be a CSV file beside the study, found '{name}': {why}", "file")
        return []
    if not lines or [text.strip() for text in lines[0][1]] != COLUMNS:
        table.fault(f"{name}{f':{lines[0][0]}' if lines else ''}: the columns must be {','.join(COLUMNS)}, found "
                    f"{found(','.join(lines[0][1])) if lines else 'nothing'}", "file")
        return []
    rows = []
    for number, row in lines[1:]:
        try:
            place, depth, scatter = map(float, row)
        except ValueError:
            place = depth = scatter = math.nan
        if not all(map(math.isfinite, (place, depth, scatter))) or not scatter > 0:
            table.fault(f"{name}:{number}: a row must be a place, a depth and its scatter above 0, found "
                        f"{found(','.join(row))}", "file")
        else:
            rows.append((place, depth, scatter))
    if len(lines) == 1:
        table.fault(f"{name}: holds no measured depth", "file")
    return rows
