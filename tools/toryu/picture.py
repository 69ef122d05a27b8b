"""Draws the scene of a case before anything runs: bodies, particles, clamps, loads, observers, and what moves."""

from dataclasses import dataclass

import h5py
import matplotlib
import matplotlib.figure
import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from toryu import results
from toryu.report import data
from toryu.study.drawing import PALETTE

ENDINGS = (".svg", ".png")
WIDTH, LEAST_HEIGHT, MOST_HEIGHT, LEGEND, DPI = 11.0, 4.0, 11.0, 0.9, 160  # [in], the last [1/in]
MARGIN = 0.04  # of the larger side, around all that is drawn
MOST_VECTORS = 4000  # particles that an SVG holds one by one; more are drawn as an image in it
GHOSTS = 5  # positions of what moves
ARROW = 26  # [pt] of gravity
INK, SOFT = PALETTE["ink"], PALETTE["soft"]
COLOURS = {"wall": PALETTE["wall"], "moving": "#9db4c9", "work_piece": PALETTE["piece"], "walls": SOFT, "fluid": "#2c728e",
           "solid": PALETTE["c1"], "clamp": INK, "load": PALETTE["bad"], "observer": PALETTE["c3"], "inlet": PALETTE["good"],
           "outlet": PALETTE["c4"]}


@dataclass
class Particles:
    """Those of one body, "fluid", "walls" or "solid"."""

    name: str
    points: np.ndarray  # n x 2 [m]
    spacing: float  # [m]

    @property
    def count(self):
        return f"{len(self.points):,} particles".replace(",", " ")


def fault_of(path):
    """What is wrong with where the picture should go; "" if nothing."""
    if path.suffix.lower() not in ENDINGS:
        return f"--picture {path}: error: must end in {' or '.join(ENDINGS)}"
    if path.is_dir():
        return f"--picture {path}: error: is a folder"
    return ""


def particles_at_start(case, frames):
    """As the programs filled the scene and left it in the folder `frames`."""
    found = []
    for name in ("walls", "fluid", "solid"):
        for _, path in results.list_frames(frames, name)[:1]:
            with h5py.File(path) as file:
                points = file["VTKHDF/Points"][:, :2]
            spacing = data.table(case.content, "solid" if name == "solid" else "fluid").get("spacing")
            found.append(Particles(name, points, spacing if data.is_number(spacing) else 0.0))
    return found


def bounds_of(case, particles):
    """Of all that is drawn: (low, high) [m]."""
    points = [p.points for p in particles] + [np.array(ring) for shape in case.shapes for ring in shape["rings"]]
    for number, motion in case.motions.items():
        points += [placed(ring, motion, pose) for ring in rings_of(case, number) for pose in ghosts(motion)]
    points += [np.array([observer["point"]]) for observer in point_observers(case)]
    points = np.concatenate(points) if points else np.zeros((1, 2))
    low, high = points.min(axis=0), points.max(axis=0)
    margin = MARGIN * max(high - low) or 1.0
    return low - margin, high + margin


def point_observers(case):
    return [observer for side in ("fluid", "solid") for observer in
            data.tables_of(data.table(case.content, side), "observer") if data.numbers(observer.get("point"), 2)]


def rings_of(case, wall):
    return next((s["rings"] for s in case.shapes if s["list"] == "wall" and s["number"] == wall), [])


def placed(ring, motion, pose):
    """A ring of corners as a moving wall has it in a pose."""
    x, y, angle = pose[1:4]
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    return (np.array(ring) - motion["about"]) @ turn.T + [x, y]


def ghosts(motion):
    """Poses that show where a wall comes: some over time, and those that are farthest along x, y and the angle."""
    poses = np.array(motion["poses"])
    chosen = set(np.linspace(0, len(poses) - 1, GHOSTS).round().astype(int))
    for column in (1, 2, 3):
        chosen |= {int(poses[:, column].argmin()), int(poses[:, column].argmax())}
    return poses[sorted(chosen)]


class Drawing:
    """One pair of axes in metres."""

    def __init__(self, case, particles):
        self.case, self.particles = case, particles
        low, high = bounds_of(case, particles)
        height = WIDTH * (high - low)[1] / (high - low)[0]
        self.figure = matplotlib.figure.Figure(figsize=(WIDTH, min(max(height, LEAST_HEIGHT), MOST_HEIGHT) + LEGEND),
                                               layout="constrained")
        self.axes, self.below = self.figure.subplots(2, 1, height_ratios=[self.figure.get_figheight() - LEGEND, LEGEND])
        self.axes.grid(False)
        self.below.set_axis_off()
        self.axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal", xlabel="x [m]", ylabel="y [m]")
        self.figure.draw_without_rendering()  # settles the scale
        box = self.axes.get_window_extent()
        self.points_per_metre = box.width / (high - low)[0] * 72 / self.figure.dpi
        self.legend = {}  # label -> handle

    def fill(self, rings, label, **style):
        codes = [code for ring in rings for code in [Path.MOVETO, *[Path.LINETO] * (len(ring) - 1), Path.CLOSEPOLY]]
        corners = [corner for ring in rings for corner in [*ring, ring[0]]]
        patch = self.axes.add_patch(PathPatch(Path(corners, codes), **style))
        if label:
            self.legend.setdefault(label, patch)

    def write_name(self, rings, name, colour):
        corners = np.concatenate([np.array(ring) for ring in rings])
        x, y = (corners.min(axis=0) + corners.max(axis=0)) / 2
        self.axes.text(x, y, name.replace("_", " "), ha="center", va="center", fontsize=8, color=colour,
                       clip_on=True, zorder=9, bbox={"facecolor": "white", "alpha": 0.75, "linewidth": 0, "pad": 1.0})

    def walls(self):
        walls = data.tables_of(self.case.content, "wall")
        for shape in (s for s in self.case.shapes if s["list"] == "wall"):
            motion = self.case.motions.get(shape["number"])
            piece = walls[shape["number"]].get("work_piece") is True
            kind = "work_piece" if piece else "moving" if motion else "wall"
            self.fill(shape["rings"], {"work_piece": "work piece", "moving": "wall that moves", "wall": "wall"}[kind],
                      facecolor=COLOURS[kind], edgecolor=INK, linewidth=0.6, zorder=1)
            for pose in ghosts(motion) if motion else ():
                self.fill([placed(ring, motion, pose) for ring in shape["rings"]], "where it comes", fill=False,
                          edgecolor=SOFT, linewidth=0.8, linestyle=(0, (3, 2)), zorder=2)
            self.write_name(shape["rings"], shape["name"], INK)

    def dots(self):
        for body in self.particles:
            size = (0.8 * body.spacing * self.points_per_metre) ** 2
            self.axes.scatter(*body.points.T, s=size, color=COLOURS[body.name], linewidths=0, alpha=0.85, zorder=3,
                              rasterized=len(body.points) > MOST_VECTORS)
            self.legend[f"{body.name}, {body.count}"] = Line2D([], [], marker="o", markersize=5, linestyle="",
                                                                    color=COLOURS[body.name])

    def bodies(self):
        styles = {"solid.clamp": ("clamp", {"hatch": "////", "edgecolor": COLOURS["clamp"], "linewidth": 0.8}),
                  "solid.load": ("load", {"edgecolor": COLOURS["load"], "linewidth": 1.4}),
                  "fluid.observer": ("observer", {"edgecolor": COLOURS["observer"], "linewidth": 1.2,
                                                  "linestyle": (0, (4, 2))})}
        for shape in self.case.shapes:
            if shape["list"] not in styles:
                continue
            label, style = styles[shape["list"]]
            self.fill(shape["rings"], label, fill=False, zorder=5, **style)
            if label == "observer":
                self.write_name(shape["rings"], shape["name"], COLOURS["observer"])
        for observer in point_observers(self.case):
            place = observer["point"]
            self.legend["observer"] = self.axes.scatter(*place, marker="x", s=45, color=COLOURS["observer"], zorder=6)
            self.axes.annotate(str(observer.get("name", "")).replace("_", " "), place, xytext=(5, 5),
                               textcoords="offset points", fontsize=8, color=COLOURS["observer"], zorder=9)

    def open_ends(self):
        for kind, colour in (("inlet", COLOURS["inlet"]), ("outlet", COLOURS["outlet"])):
            for end in data.tables_of(data.table(self.case.content, "fluid"), kind):
                line = [end.get("from"), end.get("to")]
                if not all(data.numbers(point, 2) for point in line):
                    continue
                self.legend[kind] = self.axes.plot(*np.array(line).T, color=colour, linewidth=2.4, zorder=6)[0]
                self.write_name([line], str(end.get("name", "")), colour)

    def frame(self):
        content = data.table(self.case.content, "case")
        if domain := data.box_of(data.table(content, "domain")):
            x0, y0, x1, y1 = domain
            self.axes.plot([x0, x1, x1, x0, x0], [y0, y0, y1, y1, y0], color=INK, linewidth=0.7,
                           linestyle=(0, (6, 4)), zorder=0)
        gravity = content.get("gravity")
        if data.numbers(gravity, 2) and any(gravity):
            way = np.array(gravity, float) / np.hypot(*gravity)
            self.axes.annotate("", (0.97, 0.9), xycoords="axes fraction", xytext=tuple(-ARROW * way),
                               textcoords="offset points", arrowprops={"arrowstyle": "-|>", "color": INK}, zorder=9)
            self.axes.text(0.98, 0.9, "g", transform=self.axes.transAxes, fontsize=10, style="italic", zorder=9)
        title = str(content.get("title") or self.case.name)
        self.axes.set_title(title, loc="left", fontsize=12)
        self.below.legend(self.legend.values(), self.legend.keys(), loc="upper left", ncols=4, fontsize=9)

    def save(self, path):
        path.parent.mkdir(parents=True, exist_ok=True)
        with matplotlib.rc_context({"svg.hashsalt": path.name}):  # the same scene gives the same file
            undated = {"metadata": {"Date": None}} if path.suffix.lower() == ".svg" else {}
            self.figure.savefig(path, dpi=DPI, facecolor="white", **undated)


def draw(case, frames, path):
    """Makes the picture of the particles in the folder `frames` and returns what to say of the scene. Raises OSError where
    it cannot be written."""
    particles = particles_at_start(case, frames)
    drawing = Drawing(case, particles)
    drawing.walls()
    drawing.dots()
    drawing.bodies()
    drawing.open_ends()
    drawing.frame()
    drawing.save(path)
    return "\n".join(summary(body) for body in particles)


def summary(body):
    low, high = body.points.min(axis=0), body.points.max(axis=0)
    return (f"{body.name}: {body.count}, x {low[0]:.4g} to {high[0]:.4g} m, y {low[1]:.4g} to {high[1]:.4g} m")
