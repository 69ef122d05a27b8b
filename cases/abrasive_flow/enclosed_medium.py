"""Whether a medium between pistons stayed whole: its volume, voids, particles in walls, flow through a throat and
the symmetry of the pressures; read from the frames (every 25 ms, say) and series of a run.

    PYTHONPATH=tools /usr/bin/python3 cases/abrasive_flow/enclosed_medium.py OUT --cycle SECONDS

The throat is the box of the first [[fluid.observer]] with quantity = "flow_rate"; the flow is along y. The medium
fills at first the boxes of [[fluid.region]] less the holes. A side of their hull that touches a moving wall moves with
it. Solid are the boxes of walls and, undeformed, of the solid's regions."""

import argparse
import json
import pathlib
import sys
from dataclasses import dataclass

HERE = pathlib.Path(__file__).resolve().parent

import h5py
import numpy as np

from toryu import PROGRAMS, results
from toryu.case import resolve
from toryu.report import scene

CELLS = 10  # points of the grid, across a spacing, on which voids are looked for
AVERAGE = 0.1  # [s] over which flow and pressures are averaged


@dataclass
class Conditions:
    """The worst of a run."""

    volume: float  # |sum m/rho / space - 1|
    void: float  # distance of a point of the space from the nearest particle, in spacings
    depth: float  # of a particle's centre in a wall or past it, in spacings; negative: how far the nearest stayed off
    flow: float  # |flow through the throat - piston's velocity times area|, mean over AVERAGE, share of the largest
    asymmetry: float  # root mean square of dp(t + half a cycle) + dp(t), of that of dp; dp between the pistons

    def text(self):
        return "\n".join([
            f"medium's volume against the space      {100 * self.volume:.3f} % at most",
            f"farthest point from a particle         {self.void:.2f} spacings",
            f"deepest particle in a wall             {self.depth:+.2f} spacings (negative: outside)",
            f"flow against the pistons', {AVERAGE} s mean  {100 * self.flow:.2f} % at most",
            f"pressures' asymmetry over half a cycle {100 * self.asymmetry:.1f} %, root mean square"])


class Space:
    """Where the medium may be, over time; `motions` as `--resolved` tells them."""

    def __init__(self, case, motions):
        regions = np.array([[r["box"]["min"], r["box"]["max"]] for r in case["fluid"]["region"]])
        self.low, self.high = regions[:, 0].min(axis=0), regions[:, 1].max(axis=0)
        self.walls = scene.walls_of(case, motions=motions)
        self.solids = [r["box"] for r in case.get("solid", {}).get("region", [])]
        holes = case["fluid"].get("hole", [])
        area = sum(np.prod(np.subtract(box["max"], box["min"])) for box in (r["box"] for r in case["fluid"]["region"]))
        self.area = area - sum(np.prod(np.subtract(hole["max"], hole["min"])) for hole in holes)
        self.width = self.high[0] - self.low[0]
        self.below = self._touching(1, self.low[1], 3)
        self.above = self._touching(1, self.high[1], 1)

    def _touching(self, axis, level, side):
        """The moving wall whose side (index into x0, y0, x1, y1) is at `level`."""
        found = [w for w in self.walls if w["poses"] and abs(w["box"][side] - level) < 1e-9]
        if not found:
            raise ValueError(f"no moving wall bounds the medium at {'xy'[axis]} = {level} m")
        return found[0]

    @staticmethod
    def shift(wall, time):
        if not wall["poses"]:
            return np.zeros(2)
        times, x, y = np.array(wall["poses"]).T[:3]
        return np.array([np.interp(time, times, x), np.interp(time, times, y)]) - wall["about"]

    def hull(self, time):
        return (self.low + [0, self.shift(self.below, time)[1]], self.high + [0, self.shift(self.above, time)[1]])

    def area_at(self, time):
        """[m2] between the pistons, less the holes: it changes where they do not move alike."""
        return self.area + self.width * (self.shift(self.above, time)[1] - self.shift(self.below, time)[1])

    def boxes(self, time):
        """Lower and upper corner of all that is solid."""
        boxes = [(np.array(w["box"][:2]) + self.shift(w, time), np.array(w["box"][2:]) + self.shift(w, time))
                 for w in self.walls]
        return boxes + [(np.array(b["min"]), np.array(b["max"])) for b in self.solids]


def depth_in(boxes, points):
    """How deep each point is in the box it is deepest in, negative outside all."""
    return np.max([np.min([points - low, high - points], axis=(0, 2)) for low, high in boxes], axis=0)


def distance_outside(low, high, points):
    """How far each point is outside the box, negative inside."""
    return np.max([low - points, points - high], axis=(0, 2))


def farthest_point(points, low, high, boxes, spacing):
    """Largest distance [spacings] of a point of the space from the nearest particle, at most 2."""
    step = spacing / CELLS
    counts = np.round((high - low) / step).astype(int)
    axes = [low[a] + (np.arange(counts[a]) + 0.5) * step for a in (0, 1)]
    nearest = np.full(counts, 2.0 * spacing)
    reach = 2 * CELLS
    for x, y in points:
        i, j = int((x - low[0]) / step), int((y - low[1]) / step)
        a, b = slice(max(i - reach, 0), max(i + reach, 0)), slice(max(j - reach, 0), max(j + reach, 0))
        distance = np.hypot((axes[0][a] - x)[:, None], (axes[1][b] - y)[None, :])
        np.minimum(nearest[a, b], distance, out=nearest[a, b])
    for box_low, box_high in boxes:
        inside = [(axes[a] > box_low[a]) & (axes[a] < box_high[a]) for a in (0, 1)]
        nearest[np.ix_(*inside)] = 0
    return nearest.max() / spacing


def mean_over(times, impulses, span):
    """Mean force over the `span` before each time, from impulses since the start; nan before the first span."""
    before = np.interp(times - span, times, impulses)
    return np.where(times >= span, (impulses - before) / span, np.nan)


def volume_beyond(box, points, volumes, spacing):
    """Volume [m2] above a plane y across the box, plus that of the box below the plane: the mean over planes along
    the box. A particle that a plane cuts counts by its share above. The change over time is what has passed."""
    planes = np.linspace(box["min"][1], box["max"][1], 2 * round((box["max"][1] - box["min"][1]) / spacing) + 1)
    width = box["max"][0] - box["min"][0]
    above = [(volumes * np.clip((points[:, 1] - y) / spacing + 0.5, 0, 1)).sum() + width * y for y in planes]
    return np.mean(above)


def flow_error(times, passed, space):
    """Of the volume that has passed the throat, against that which the pistons have pushed."""
    pushed = space.width * np.array([space.shift(space.below, t)[1] for t in times])
    fastest = np.abs(np.diff(pushed) / np.diff(times)).max()
    return np.nanmax(np.abs(mean_over(times, passed - pushed, AVERAGE))) / fastest


def asymmetry(series, space, cycle):
    times = np.array(series["time[s]"])
    pressure = [mean_over(times, np.array(series[f"impulse_from_{w['name']}_y[N.s/m]"]), AVERAGE) / space.width
                for w in (space.below, space.above)]
    dp = pressure[0] + pressure[1]  # the upper piston pushes downwards
    later = np.interp(times + cycle / 2, times, dp, right=np.nan)
    residual = later + dp
    return np.sqrt(np.nanmean(residual ** 2) / np.nanmean(dp[np.isfinite(residual)] ** 2))


def conditions(out, cycle):
    used = resolve(out / "used_case.toml", PROGRAMS / "fluid_solver")
    case = used.content
    space, spacing = Space(case, used.motions), case["fluid"]["spacing"]
    throat = next(o["box"] for o in case["fluid"]["observer"] if o["quantity"] == "flow_rate")
    mass = case["fluid"]["density"] * spacing ** 2
    worst = {"volume": 0.0, "void": 0.0, "depth": -np.inf}
    times, passed = [], []
    for frame in json.loads((out / "fluid.hdf.series").read_text(encoding="utf-8"))["files"]:
        with h5py.File(out / frame["name"]) as file:
            points = file["VTKHDF/Points"][:, :2]
            volumes = mass / file["VTKHDF/PointData/density"][:]
        boxes, hull = space.boxes(frame["time"]), space.hull(frame["time"])
        worst["volume"] = max(worst["volume"], abs(volumes.sum() / space.area_at(frame["time"]) - 1))
        worst["void"] = max(worst["void"], farthest_point(points, *hull, boxes, spacing))
        depth = max(depth_in(boxes, points).max(), distance_outside(*hull, points).max())
        worst["depth"] = max(worst["depth"], depth / spacing)
        times.append(frame["time"])
        passed.append(volume_beyond(throat, points, volumes, spacing))
    flow = flow_error(np.array(times), np.array(passed), space)
    return Conditions(**worst, flow=flow, asymmetry=asymmetry(results.read_series(out, "fluid"), space, cycle))


def main():
    parser = argparse.ArgumentParser(prog="enclosed_medium", description=__doc__.split("\n\n")[0])
    parser.add_argument("out", metavar="OUT", type=pathlib.Path)
    parser.add_argument("--cycle", metavar="SECONDS", type=float, required=True, help="period of the pistons")
    options = parser.parse_args()
    for name in ("used_case.toml", "fluid.hdf.series", "fluid.csv"):
        if not (options.out / name).is_file():
            print(f"{options.out}: error: holds no {name}: it takes a run that is done, with frames", file=sys.stderr)
            sys.exit(2)
    print(conditions(options.out, options.cycle).text())


if __name__ == "__main__":
    main()
